# Time and peak memory of reconstruction by itself, on the images of eight spheres.
find_package(benchmark REQUIRED)
add_executable(bench-reconstruct ${PROJECT_SOURCE_DIR}/tests/bench/reconstruct_bench.cpp)
target_link_libraries(bench-reconstruct PRIVATE glcast_options glcast_reconstruct glcast_test_bodies benchmark::benchmark)
