# Progressive meshes: bytes and processor time. Not a test: run tests/bench/bench-progressive MESH by hand.
add_executable(bench-progressive progressive_bench.cpp)
target_link_libraries(bench-progressive PRIVATE glcast_options glcast_io glcast_progressive glcast_simplify)
