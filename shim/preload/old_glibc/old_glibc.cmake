# The library loads where old programs live: glibc 2.17 (CentOS 7, Debian 8) and later. The test `old_glibc` reads its symbol versions.
set(GLCAST_OLDEST_GLIBC 2.17 CACHE STRING "glibc that libglcast.so still loads with")
set(stubs ${CMAKE_CURRENT_BINARY_DIR}/old_glibc)
separate_arguments(stub_flags NATIVE_COMMAND "${CMAKE_C_FLAGS}")
add_custom_command(
    OUTPUT ${stubs}/made
    COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/old_glibc/make_stubs.py ${stubs} ${GLCAST_OLDEST_GLIBC} ${stubs}/made
            ${CMAKE_C_COMPILER} ${stub_flags}
    DEPENDS old_glibc/make_stubs.py
    VERBATIM)
add_custom_target(glcast_old_glibc DEPENDS ${stubs}/made)
add_dependencies(glcast_preload glcast_old_glibc)
target_sources(glcast_preload PRIVATE old_glibc/stand_ins.cpp)
target_link_options(glcast_preload BEFORE PRIVATE -L${stubs}) # target_link_directories would make it a RUNPATH too
target_link_libraries(glcast_preload PRIVATE pthread dl)
set_property(TARGET glcast_preload APPEND PROPERTY LINK_DEPENDS ${stubs}/made)
