# glcast_test(NAME LABEL <unit|preload|real|paper|fuzz> SOURCES ... [LIBS ...] [TIMEOUT seconds] [SERIAL])
# A GoogleTest program whose cases are CTest tests with the label. SERIAL: never beside another test of ours.
include(GoogleTest)
find_package(GTest REQUIRED)
function(glcast_test name)
    cmake_parse_arguments(T "SERIAL" "LABEL;TIMEOUT" "SOURCES;LIBS" ${ARGN})
    if(NOT T_TIMEOUT)
        set(T_TIMEOUT 120)
    endif()
    add_executable(${name} ${T_SOURCES})
    target_link_libraries(${name} PRIVATE glcast_options ${T_LIBS} GTest::gtest_main)
    gtest_discover_tests(${name} TEST_PREFIX "${name}." DISCOVERY_TIMEOUT 60
        PROPERTIES LABELS ${T_LABEL} TIMEOUT ${T_TIMEOUT} RUN_SERIAL $<BOOL:${T_SERIAL}>)
endfunction()
