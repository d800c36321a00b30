# Debian packages by CPack: glcast (programs, manuals, completion), libglcast0 (the preloaded library, for each width that
# is built) and libglcast-dev (static libraries, headers, CMake package). cmake --build --preset release --target package
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "the glcast authors <glcast@localhost>" CACHE STRING "Maintainer of the Debian packages")
set(CPACK_PACKAGE_NAME glcast)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS # whatever the umask of who builds
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_COMPONENTS_ALL runtime library development)
if(TARGET glcast_i386)
    list(APPEND CPACK_COMPONENTS_ALL i386)
endif()
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME glcast)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS ON)
# OSMesa is loaded when a picture is drawn, so dpkg-shlibdeps cannot see it; Xvfb serves --headless alone.
set(CPACK_DEBIAN_RUNTIME_PACKAGE_DEPENDS "libglcast0 (= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}), libosmesa6")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_RECOMMENDS "xvfb, libgl1-mesa-dri")
set(CPACK_COMPONENT_RUNTIME_DESCRIPTION "closed, coloured 3-D models out of any OpenGL program that can draw them
 A preloaded library records one frame of an unmodified program, draws it again
 under views and lights of its own, and writes what it saw as images; an offline
 tool turns the images into a closed, coloured mesh with levels of detail.")

# One package for each width; their files lie apart, and those in /usr/share are the same, so that both can be installed.
# The library needs nothing but the C library (a test reads which version), so that no dpkg-shlibdeps of i386 is needed.
foreach(component IN ITEMS LIBRARY I386)
    set(CPACK_DEBIAN_${component}_PACKAGE_NAME libglcast0)
    set(CPACK_DEBIAN_${component}_PACKAGE_SECTION "libs\nMulti-Arch: same") # CPack before 3.31 has no variable for the second line
    set(CPACK_DEBIAN_${component}_PACKAGE_DEPENDS "libc6 (>= 2.17)")
    set(CPACK_COMPONENT_${component}_DESCRIPTION "preloaded library of glcast
 What glcast-run loads into the programs that it casts. Programs of 32 bits take
 the package for i386: dpkg --add-architecture i386, then libglcast0:i386.")
endforeach()
set(CPACK_DEBIAN_I386_PACKAGE_ARCHITECTURE i386)

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libglcast-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libtbb-dev, libglm-dev, libembree-dev, libimath-dev, libopenmesh-dev, lib3mf-dev, libmeshoptimizer-dev, \
libtinygltf-dev, nlohmann-json3-dev, zlib1g-dev, pkg-config")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "library of glcast (static)
 Capture files, or six depth, colour and normal images of an object, become a
 closed two-manifold mesh, its levels of detail and their files. For programs that
 link it by CMake: find_package(glcast), glcast::pipeline or glcast::reconstruct.")

# What Debian wants to find in /usr/share/doc.
string(TIMESTAMP changelog_date "%a, %d %b %Y %H:%M:%S +0000" UTC)
file(READ ${PROJECT_SOURCE_DIR}/LICENSE expat_text)
string(REGEX REPLACE "^MIT License\n\nCopyright[^\n]*\n\n" "" expat_text "${expat_text}")
string(STRIP "${expat_text}" expat_text)
string(REGEX REPLACE "\n\n" "\n.\n" expat_text "${expat_text}")
string(REGEX REPLACE "\n" "\n " expat_text " ${expat_text}")
set(debian_folder ${PROJECT_BINARY_DIR}/packaging)
configure_file(copyright.in ${debian_folder}/copyright @ONLY)
configure_file(changelog.debian.in ${debian_folder}/changelog.Debian @ONLY)
add_custom_command(
    OUTPUT ${debian_folder}/changelog.gz ${debian_folder}/changelog.Debian.gz
    COMMAND gzip -9nc ${PROJECT_SOURCE_DIR}/CHANGELOG.md > changelog.gz
    COMMAND gzip -9nc ${debian_folder}/changelog.Debian > changelog.Debian.gz
    DEPENDS ${PROJECT_SOURCE_DIR}/CHANGELOG.md ${debian_folder}/changelog.Debian
    WORKING_DIRECTORY ${debian_folder})
add_custom_target(changelogs ALL DEPENDS ${debian_folder}/changelog.gz ${debian_folder}/changelog.Debian.gz)
foreach(package IN ITEMS runtime:glcast library:libglcast0 i386:libglcast0 development:libglcast-dev)
    string(REPLACE ":" ";" package ${package})
    list(GET package 0 component)
    list(GET package 1 name)
    install(FILES ${debian_folder}/copyright ${debian_folder}/changelog.gz ${debian_folder}/changelog.Debian.gz
        DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/${name} COMPONENT ${component})
endforeach()
include(CPack)
