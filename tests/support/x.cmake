# For tests that run programs under an X server of their own.
add_library(glcast_test_x STATIC xvfb.cpp xvfb.h)
target_link_libraries(glcast_test_x PUBLIC glcast_options)
