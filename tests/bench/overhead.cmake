# What a preload costs per GL call. Not a test: run tests/bench/overhead by hand.
find_package(X11 REQUIRED)
pkg_check_modules(OVERHEAD_GL REQUIRED IMPORTED_TARGET gl)

add_executable(overhead_calls overhead_calls.cpp)
target_link_libraries(overhead_calls PRIVATE glcast_options X11::X11 PkgConfig::OVERHEAD_GL)

add_library(overhead_pass_through MODULE overhead_pass_through.c)
target_link_libraries(overhead_pass_through PRIVATE ${CMAKE_DL_LIBS})
target_compile_options(overhead_pass_through PRIVATE -O2)

add_executable(overhead overhead.cpp overhead_gears.cpp overhead_gears.h)
target_link_libraries(overhead PRIVATE glcast_test_x)
target_compile_definitions(overhead PRIVATE
    GLCAST_SHIM="$<TARGET_FILE:glcast_preload>"
    OVERHEAD_CALLS="$<TARGET_FILE:overhead_calls>"
    OVERHEAD_PASS_THROUGH="$<TARGET_FILE:overhead_pass_through>")
add_dependencies(overhead glcast_preload overhead_calls overhead_pass_through)
