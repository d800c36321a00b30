# What every target of ours has: the include root, warnings, the sanitizer of the preset.
add_library(glcast_options INTERFACE)
target_include_directories(glcast_options INTERFACE ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR}/generated)
target_compile_options(glcast_options INTERFACE -Wall -Wextra -fno-math-errno)
target_compile_definitions(glcast_options INTERFACE GLCAST_VERSION="${PROJECT_VERSION}")
if(GLCAST_SANITIZE)
    target_compile_options(glcast_options INTERFACE -fsanitize=${GLCAST_SANITIZE} -fno-omit-frame-pointer)
    target_link_options(glcast_options INTERFACE -fsanitize=${GLCAST_SANITIZE})
endif()
