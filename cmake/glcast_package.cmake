# glcast_package(TARGET HEADERS ...)
# The library is part of the CMake package: glcast_NAME is installed as glcast::NAME, and HEADERS as <glcast/HEADER>, in
# one folder, so that what we include by its path in the tree is found by others too.
set(GLCAST_PUBLIC_HEADERS ${PROJECT_BINARY_DIR}/public/glcast)

function(glcast_package target)
    cmake_parse_arguments(P "" "" "HEADERS" ${ARGN})
    string(REGEX REPLACE "^glcast_" "" name ${target})
    foreach(header ${P_HEADERS})
        set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${header})
        file(READ ${header} text)
        string(REGEX REPLACE "#include \"[a-z_/]+/([a-z_]+\\.h)\"" "#include <glcast/\\1>" text "${text}")
        file(CONFIGURE OUTPUT ${GLCAST_PUBLIC_HEADERS}/${header} CONTENT "${text}" @ONLY)
        install(FILES ${GLCAST_PUBLIC_HEADERS}/${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/glcast
            COMPONENT development)
    endforeach()
    set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
    target_compile_features(${target} PUBLIC cxx_std_20)
    install(TARGETS ${target} EXPORT glcast
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development
        INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
endfunction()
