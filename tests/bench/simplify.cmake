# Simplification by itself and by others (tools/install-packages bench). Not a test: run tests/bench/bench-simplify by hand.
find_package(CGAL REQUIRED)
find_package(TBB REQUIRED)
pkg_check_modules(OPENMESH REQUIRED IMPORTED_TARGET openmesh)
find_path(GLCAST_MESHOPTIMIZER_HEADER meshoptimizer.h)
find_library(GLCAST_MESHOPTIMIZER_LIBRARY meshoptimizer)
find_path(GLCAST_EIGEN Eigen/Dense PATH_SUFFIXES eigen3) # CGAL's quadrics need it
if(GLCAST_MESHOPTIMIZER_HEADER AND GLCAST_MESHOPTIMIZER_LIBRARY AND GLCAST_EIGEN)
    add_executable(bench-simplify simplify_bench.cpp simplify_peers.cpp peers.cpp)
    target_link_libraries(bench-simplify PRIVATE glcast_options glcast_paper glcast_simplify glcast_reconstruct
        glcast_deviation glcast_test_bodies PkgConfig::OPENMESH CGAL::CGAL TBB::tbb ${GLCAST_MESHOPTIMIZER_LIBRARY})
    target_include_directories(bench-simplify SYSTEM PRIVATE ${GLCAST_EIGEN})
    # Headers that are not ours to warn about.
    set_source_files_properties(simplify_peers.cpp PROPERTIES COMPILE_OPTIONS "-Wno-all;-Wno-extra;-Wno-conversion")
endif()
