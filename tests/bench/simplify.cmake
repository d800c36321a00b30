# Simplification by itself and by others. Not a test: run tests/bench/bench-simplify by hand.
find_package(TBB REQUIRED)
add_executable(bench-simplify simplify_bench.cpp peers.cpp)
target_link_libraries(bench-simplify PRIVATE glcast_options glcast_paper glcast_simplify glcast_reconstruct
    glcast_deviation glcast_simplify_peers glcast_test_bodies TBB::tbb)
# How far levels are from the surface, each way, at every count. By hand too.
add_executable(bench-levels levels_bench.cpp)
target_link_libraries(bench-levels PRIVATE glcast_options glcast_paper glcast_simplify glcast_io glcast_shapes
    glcast_both_ways)
