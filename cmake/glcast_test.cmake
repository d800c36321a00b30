# glcast_test(NAME LABEL <unit|preload|real|paper|fuzz|hostile> SOURCES ... [LIBS ...] [TIMEOUT seconds] [SERIAL] [LOCK name])
# A GoogleTest program whose cases are CTest tests with the label. SERIAL: never beside another test of ours.
# LOCK: never beside one with the same lock.
include(GoogleTest)
find_package(GTest REQUIRED)

# Under AddressSanitizer: Mesa 22.3 asks for sizes it does not need, and OSMesa never frees its screen; what else is Mesa's
# stands in sanitize.asan. None of that is ours to mend.
set(GLCAST_TEST_ENVIRONMENT "")
if(GLCAST_SANITIZE MATCHES "address")
    set(GLCAST_TEST_ENVIRONMENT
        "ASAN_OPTIONS=suppressions=${PROJECT_SOURCE_DIR}/tests/sanitize.asan:allocator_may_return_null=1:detect_leaks=0:detect_odr_violation=0")
endif()

function(glcast_test name)
    cmake_parse_arguments(T "SERIAL" "LABEL;TIMEOUT;LOCK" "SOURCES;LIBS" ${ARGN})
    if(NOT T_TIMEOUT)
        set(T_TIMEOUT 120)
    endif()
    set(lock "")
    if(T_LOCK)
        set(lock RESOURCE_LOCK ${T_LOCK})
    endif()
    add_executable(${name} ${T_SOURCES})
    target_link_libraries(${name} PRIVATE glcast_options ${T_LIBS} GTest::gtest_main)
    gtest_discover_tests(${name} TEST_PREFIX "${name}." DISCOVERY_TIMEOUT 60
        PROPERTIES LABELS ${T_LABEL} TIMEOUT ${T_TIMEOUT} RUN_SERIAL $<BOOL:${T_SERIAL}> ${lock}
        ENVIRONMENT "${GLCAST_TEST_ENVIRONMENT}")
endfunction()

# glcast_missing(NAME LABEL <label> NEEDS text): the suite NAME cannot be built here. It is skipped with the reason; under
# tests/run, which installs all that tests need, it fails. OPTIONAL: not even there, for what tests/run does not install.
function(glcast_missing name)
    cmake_parse_arguments(T "OPTIONAL" "LABEL;NEEDS" "" ${ARGN})
    set(environment "")
    if(T_OPTIONAL)
        set(environment ${CMAKE_COMMAND} -E env --unset=GLCAST_ALL_TESTS)
    endif()
    add_test(NAME ${name}.missing COMMAND ${environment} ${PROJECT_SOURCE_DIR}/tests/support/missing ${name} "${T_NEEDS}")
    set_tests_properties(${name}.missing PROPERTIES LABELS ${T_LABEL} SKIP_RETURN_CODE 77)
endfunction()
