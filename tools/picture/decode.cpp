// PNG and JPEG by stb_image.
#include <memory>
#include <stdexcept>

#include "tools/picture/png.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
#define STBI_MAX_DIMENSIONS glcast::largest_picture
#include <stb_image.h>
#pragma GCC diagnostic pop

namespace glcast {
namespace {

constexpr std::size_t most_pixels = 64u << 20;
constexpr std::size_t best_ratio = 1032; ///< of deflate, which no JPEG reaches

} // namespace

Picture decode_picture(std::string_view bytes) {
    const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
    if (bytes.size() > 0x7fffffff) throw std::runtime_error("a texture is too large");
    const int size = static_cast<int>(bytes.size());
    Picture picture;
    int channels = 0;
    if (!stbi_info_from_memory(data, size, &picture.width, &picture.height, &channels))
        throw std::runtime_error("a texture is no PNG or JPEG");
    if (picture.width < 1 || picture.height < 1 || picture.width > largest_picture ||
        picture.height > largest_picture)
        throw std::runtime_error("a texture is too large");
    const std::size_t pixels = std::size_t(picture.width) * std::size_t(picture.height);
    // A bit a pixel is the least that a PNG can take before it is deflated.
    if (pixels > most_pixels || pixels / 8 > best_ratio * bytes.size() + 4096)
        throw std::runtime_error("a texture is larger than its bytes can explain");
    const std::unique_ptr<stbi_uc, void (*)(void*)> rgb(
        stbi_load_from_memory(data, size, &picture.width, &picture.height, &channels, 3), stbi_image_free);
    if (!rgb) throw std::runtime_error("a texture is damaged");
    picture.rgb.assign(rgb.get(), rgb.get() + pixels * 3);
    return picture;
}

} // namespace glcast
