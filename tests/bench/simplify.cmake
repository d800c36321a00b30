# Simplification by itself and by others. Not a test: run tests/bench/bench-simplify by hand.
find_package(TBB REQUIRED)
add_executable(bench-simplify simplify_bench.cpp peers.cpp)
target_link_libraries(bench-simplify PRIVATE glcast_options glcast_paper glcast_simplify glcast_reconstruct
    glcast_deviation glcast_simplify_peers glcast_test_bodies TBB::tbb)
