# The capture file, for the shim: no shared library of its own, so zlib is the static one. Debian's libz.a is not
# position independent throughout; --exclude-libs hides its symbols, and then it links into a shared object all the same.
find_library(GLCAST_ZLIB_STATIC libz.a REQUIRED)

add_library(glcast_capture_file STATIC
    band_writer.cpp band_writer.h
    capture_file.cpp capture_file.h
    exr_compress.cpp exr_compress.h
    exr_header.cpp exr_header.h
    output_file.cpp output_file.h)
target_link_libraries(glcast_capture_file PUBLIC $<BUILD_INTERFACE:glcast_options> glcast_view
    $<BUILD_INTERFACE:${GLCAST_ZLIB_STATIC}> $<INSTALL_INTERFACE:ZLIB::ZLIB>)
target_link_options(glcast_capture_file INTERFACE $<BUILD_INTERFACE:LINKER:--exclude-libs,libz.a>)
glcast_package(glcast_capture_file HEADERS capture_file.h)
set_target_properties(glcast_capture_file PROPERTIES CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
# tinyexr is not ours: no warnings from it, and no assert may end the host program.
set_source_files_properties(exr_compress.cpp PROPERTIES COMPILE_OPTIONS "-w"
    COMPILE_DEFINITIONS "TINYEXR_USE_OPENMP=0;TINYEXR_USE_THREAD=0;TINYEXR_USE_MINIZ=0;NDEBUG")

# Names of keys, signals and captures, which glcast-run understands as the shim does.
add_library(glcast_names STATIC key_names.cpp key_names.h output_name.cpp output_name.h)
target_link_libraries(glcast_names PUBLIC glcast_options)
set_target_properties(glcast_names PROPERTIES CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
