# The CMake package; the libraries in it are named by glcast_package().
include(CMakePackageConfigHelpers)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/glcast)
install(EXPORT glcast FILE glcast-targets.cmake NAMESPACE glcast:: DESTINATION ${package_folder} COMPONENT development)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/packaging/glcast-config-version.cmake
    COMPATIBILITY SameMinorVersion)
install(FILES glcast-config.cmake ${PROJECT_BINARY_DIR}/packaging/glcast-config-version.cmake
    DESTINATION ${package_folder} COMPONENT development)
