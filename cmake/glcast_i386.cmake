# The same library for 32-bit programs, built beside the 64-bit one where the compiler and a static zlib can (Debian: g++-multilib, lib32z1-dev).
# Both lie as they are installed, lib/TRIPLET/glcast, so that the loader of each process finds its own by $LIB.
function(glcast_preload_link lib library target)
    set(folder ${PROJECT_BINARY_DIR}/${lib}/glcast)
    add_custom_command(OUTPUT ${folder}/libglcast.so
        COMMAND ${CMAKE_COMMAND} -E make_directory ${folder}
        COMMAND ${CMAKE_COMMAND} -E create_symlink ${library} ${folder}/libglcast.so
        VERBATIM)
    add_custom_target(${target} ALL DEPENDS ${folder}/libglcast.so)
endfunction()
if(CMAKE_LIBRARY_ARCHITECTURE)
    glcast_preload_link(lib/${CMAKE_LIBRARY_ARCHITECTURE} $<TARGET_FILE:glcast_preload> glcast_preload_place)
endif()

if(NOT CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64" OR GLCAST_SANITIZE)
    return()
endif()
include(CheckCXXSourceCompiles)
set(CMAKE_REQUIRED_FLAGS -m32)
set(CMAKE_REQUIRED_LINK_OPTIONS -m32 -static-libstdc++)
check_cxx_source_compiles("#include <string>\nint main(int n, char** a) { return std::string(a[0]).empty() + n; }" GLCAST_COMPILES_I386)
unset(CMAKE_REQUIRED_FLAGS)
unset(CMAKE_REQUIRED_LINK_OPTIONS)
find_file(GLCAST_ZLIB_I386 libz.a PATHS /usr/lib32 NO_DEFAULT_PATH)
if(NOT GLCAST_COMPILES_I386 OR NOT GLCAST_ZLIB_I386)
    message(STATUS "No library for 32-bit programs: g++-multilib and lib32z1-dev are not installed")
    return()
endif()

include(ExternalProject)
set(launchers)
if(CMAKE_CXX_COMPILER_LAUNCHER)
    list(APPEND launchers -DCMAKE_C_COMPILER_LAUNCHER=${CMAKE_C_COMPILER_LAUNCHER} -DCMAKE_CXX_COMPILER_LAUNCHER=${CMAKE_CXX_COMPILER_LAUNCHER})
endif()
set(GLCAST_I386_BUILD ${PROJECT_BINARY_DIR}/i386)
set(programs)
if(GLCAST_TESTS)
    set(programs i386_programs) # built where they cannot run, too
endif()
ExternalProject_Add(glcast_i386
    SOURCE_DIR ${PROJECT_SOURCE_DIR}
    BINARY_DIR ${GLCAST_I386_BUILD}
    PREFIX ${PROJECT_BINARY_DIR}/i386-steps
    CMAKE_ARGS -DCMAKE_TOOLCHAIN_FILE=${PROJECT_SOURCE_DIR}/cmake/i386.cmake -DGLCAST_LIBRARY_ALONE=ON -DGLCAST_TESTS=${GLCAST_TESTS} -DCMAKE_BUILD_TYPE=${CMAKE_BUILD_TYPE}
        -DCMAKE_CXX_FLAGS_RELEASE=${CMAKE_CXX_FLAGS_RELEASE} -DGLCAST_GL_XML=${GLCAST_GL_XML} ${launchers}
    BUILD_COMMAND ${CMAKE_COMMAND} --build <BINARY_DIR> --target glcast_preload ${programs}
    BUILD_ALWAYS ON
    BUILD_BYPRODUCTS ${GLCAST_I386_BUILD}/shim/preload/libglcast.so
    INSTALL_COMMAND ""
    USES_TERMINAL_BUILD ON) # one after the other: the processors are shared with this build
# Debian has two loaders for 32-bit programs: of the architecture i386, and of libc6-i386, which puts lib32 for $LIB.
glcast_preload_link(lib/i386-linux-gnu ${GLCAST_I386_BUILD}/shim/preload/libglcast.so glcast_i386_place)
glcast_preload_link(lib32 ${GLCAST_I386_BUILD}/shim/preload/libglcast.so glcast_lib32_place)
add_dependencies(glcast_i386_place glcast_i386)
add_dependencies(glcast_lib32_place glcast_i386)
install(FILES ${GLCAST_I386_BUILD}/shim/preload/libglcast.so DESTINATION lib/i386-linux-gnu/glcast COMPONENT i386)
install(CODE "if(CMAKE_INSTALL_DO_STRIP)
    execute_process(COMMAND ${CMAKE_STRIP} \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/lib/i386-linux-gnu/glcast/libglcast.so\")
endif()
file(MAKE_DIRECTORY \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/lib32/glcast\")
file(CREATE_LINK ../../lib/i386-linux-gnu/glcast/libglcast.so \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/lib32/glcast/libglcast.so\" SYMBOLIC)"
    COMPONENT i386)
