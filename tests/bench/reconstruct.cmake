# Time and peak memory of reconstruction by itself, and of its peers where they are installed
# (tools/install-packages bench). Not a test: run tests/bench/bench-reconstruct by hand.
add_executable(bench-reconstruct ${PROJECT_SOURCE_DIR}/tests/bench/reconstruct_bench.cpp
    ${PROJECT_SOURCE_DIR}/tests/bench/peers.cpp)
target_link_libraries(bench-reconstruct PRIVATE glcast_options glcast_reconstruct glcast_test_bodies)

find_path(GLCAST_OPENVDB_HEADER openvdb/tools/VolumeToMesh.h)
find_library(GLCAST_OPENVDB_LIBRARY openvdb)
if(GLCAST_OPENVDB_HEADER AND GLCAST_OPENVDB_LIBRARY)
    find_package(TBB REQUIRED)
    pkg_check_modules(GLCAST_IMATH REQUIRED IMPORTED_TARGET Imath) # OpenVDB's headers use its half
    target_compile_definitions(bench-reconstruct PRIVATE GLCAST_OPENVDB)
    target_link_libraries(bench-reconstruct PRIVATE ${GLCAST_OPENVDB_LIBRARY} TBB::tbb PkgConfig::GLCAST_IMATH)
endif()

# By hand: VTK's own configuration wants Qt, MPI and more for the two libraries used here.
find_path(GLCAST_VTK_HEADERS vtkFlyingEdges3D.h PATH_SUFFIXES vtk-9.1 vtk-9)
foreach(part FiltersCore CommonExecutionModel CommonDataModel CommonMisc CommonCore)
    find_library(GLCAST_VTK_${part} NAMES vtk${part}-9.1 vtk${part}-9)
    list(APPEND GLCAST_VTK_LIBRARIES ${GLCAST_VTK_${part}})
endforeach()
if(GLCAST_VTK_HEADERS AND GLCAST_VTK_FiltersCore AND GLCAST_VTK_CommonCore)
    target_compile_definitions(bench-reconstruct PRIVATE GLCAST_VTK)
    target_include_directories(bench-reconstruct SYSTEM PRIVATE ${GLCAST_VTK_HEADERS})
    target_link_libraries(bench-reconstruct PRIVATE ${GLCAST_VTK_LIBRARIES})
endif()
