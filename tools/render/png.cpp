#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <string>
#include <unistd.h>

#include "tools/render/render.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#include <stb_image_write.h>
#pragma GCC diagnostic pop

namespace glcast {
namespace {

/// Written beside its destination, then renamed; gone again if anything fails.
struct TemporaryFile {
    std::filesystem::path path;
    std::FILE* file = nullptr;
    bool failed = false;

    ~TemporaryFile() {
        if (file) std::fclose(file);
        std::error_code ignored;
        if (!path.empty()) std::filesystem::remove(path, ignored);
    }
};

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& why) {
    throw std::runtime_error("cannot write " + path.string() + ": " + why);
}

void append(void* context, void* data, int size) {
    auto& out = *static_cast<TemporaryFile*>(context);
    if (std::fwrite(data, 1, std::size_t(size), out.file) != std::size_t(size)) out.failed = true;
}

} // namespace

void write_png(const std::filesystem::path& path, const Picture& picture) {
    if (picture.width <= 0 || picture.height <= 0 ||
        picture.rgb.size() != std::size_t(picture.width) * std::size_t(picture.height) * 3)
        fail(path, "the picture is empty");
    TemporaryFile out;
    out.path = path;
    out.path += ".tmp" + std::to_string(getpid());
    out.file = std::fopen(out.path.c_str(), "wbx");
    if (!out.file) {
        const int error = errno;
        out.path.clear(); // not ours
        fail(path, std::strerror(error));
    }
    const int done = stbi_write_png_to_func(append, &out, picture.width, picture.height, 3,
                                            picture.rgb.data(), picture.width * 3);
    const bool closed = std::fclose(out.file) == 0;
    out.file = nullptr;
    if (!done || out.failed || !closed) fail(path, "the disk is full or gone");
    std::error_code error;
    std::filesystem::rename(out.path, path, error);
    if (error) fail(path, error.message());
    out.path.clear();
}

} // namespace glcast
