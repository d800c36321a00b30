// Images: textures, bitmaps, pixels. Pixels are unpacked from the program's layout when the call is made.
//
// Textures with a name are shared, so the program's upload is there at replay. The texture objects named 0
// have stand-ins there (default_textures.h): uploads and parameters are played for these alone, whatever was
// bound when they were recorded.
#include <algorithm>
#include <vector>

#include "shim/record/buffers.h"
#include "shim/record/packets.h"
#include "shim/record/snapshot.h"
#include "shim/record/textures.h"

namespace glcast::record {

namespace {

struct Unpack {
    GLint alignment, row_length, skip_rows, skip_pixels, image_height = 0, skip_images = 0;
    bool swap_bytes, lsb_first;
    GLuint buffer = 0;
};

Unpack read_unpack(Context& context) {
    const GlTable& gl = context.real;
    Unpack unpack{get_int(gl, GL_UNPACK_ALIGNMENT, 4),
                  get_int(gl, GL_UNPACK_ROW_LENGTH),
                  get_int(gl, GL_UNPACK_SKIP_ROWS),
                  get_int(gl, GL_UNPACK_SKIP_PIXELS),
                  0,
                  0,
                  get_int(gl, GL_UNPACK_SWAP_BYTES) != 0,
                  get_int(gl, GL_UNPACK_LSB_FIRST) != 0,
                  0};
    if (context.get_limits().has(12)) {
        unpack.image_height = get_int(gl, GL_UNPACK_IMAGE_HEIGHT);
        unpack.skip_images = get_int(gl, GL_UNPACK_SKIP_IMAGES);
    }
    if (context.get_limits().has(21)) unpack.buffer = GLuint(get_int(gl, GL_PIXEL_UNPACK_BUFFER_BINDING));
    return unpack;
}

struct Image {
    GLsizei width, height, depth;
    GLenum format, type;
    bool is_3d = false;
};

/// Where the rows of an image lie in the program's memory.
struct Layout {
    std::size_t bits, row_stride, image_stride, start, bit_start, row_bytes, total;
};

Layout lay_out(const Unpack& unpack, const Image& image) {
    Layout layout{};
    layout.bits = sizes::pixel_size(image.format, image.type).bits;
    const auto row_pixels = std::size_t(unpack.row_length > 0 ? unpack.row_length : image.width);
    const auto alignment = std::size_t(unpack.alignment);
    layout.row_stride = ((layout.bits * row_pixels + 7) / 8 + alignment - 1) / alignment * alignment;
    const auto rows =
        std::size_t(image.is_3d && unpack.image_height > 0 ? unpack.image_height : image.height);
    layout.image_stride = layout.row_stride * rows;
    const std::size_t skipped_bits = layout.bits * std::size_t(unpack.skip_pixels);
    layout.start = layout.row_stride * std::size_t(unpack.skip_rows) + skipped_bits / 8;
    if (image.is_3d) layout.start += layout.image_stride * std::size_t(unpack.skip_images);
    layout.bit_start = skipped_bits % 8;
    layout.row_bytes = (layout.bits * std::size_t(image.width) + 7) / 8;
    layout.total = layout.start + layout.image_stride * std::size_t(image.depth - 1) +
                   layout.row_stride * std::size_t(image.height - 1) +
                   (layout.bit_start + layout.bits * std::size_t(image.width) + 7) / 8;
    return layout;
}

void copy_bits(const Unpack& unpack, const Layout& layout, GLsizei width, const std::byte* from,
               std::byte* to) {
    for (std::size_t i = 0; i < std::size_t(width); ++i) {
        const std::size_t at = layout.bit_start + i;
        const unsigned shift = unsigned(unpack.lsb_first ? at % 8 : 7 - at % 8);
        if (std::to_integer<unsigned>(from[at / 8]) >> shift & 1) to[i / 8] |= std::byte(0x80u >> i % 8);
    }
}

void swap_elements(std::vector<std::byte>& pixels, std::size_t element) {
    for (std::size_t i = 0; i + element <= pixels.size(); i += element)
        std::reverse(pixels.begin() + std::ptrdiff_t(i), pixels.begin() + std::ptrdiff_t(i + element));
}

std::vector<std::byte> pack_tightly(const Unpack& unpack, const Layout& layout, const Image& image,
                                    const std::byte* from) {
    std::vector<std::byte> pixels(layout.row_bytes * std::size_t(image.height) * std::size_t(image.depth));
    std::byte* to = pixels.data();
    for (GLsizei z = 0; z < image.depth; ++z)
        for (GLsizei y = 0; y < image.height; ++y, to += layout.row_bytes) {
            const std::byte* row = from + layout.start + layout.image_stride * std::size_t(z) +
                                   layout.row_stride * std::size_t(y);
            if (image.type == GL_BITMAP)
                copy_bits(unpack, layout, image.width, row, to);
            else
                std::memcpy(to, row, layout.row_bytes);
        }
    const std::size_t element = sizes::pixel_size(image.format, image.type).element;
    if (unpack.swap_bytes && element > 1) swap_elements(pixels, element);
    return pixels;
}

/// The image in client memory, in the program's layout; `read` holds it where it came from a buffer.
const std::byte* find_pixels(Context& context, GLuint buffer, const void* pixels, std::size_t bytes,
                             std::vector<std::byte>& read) {
    if (!buffer) return static_cast<const std::byte*>(pixels);
    read.resize(bytes);
    const auto offset = reinterpret_cast<std::uintptr_t>(pixels);
    return read_buffer(context, buffer, offset, read.data(), bytes) ? read.data() : nullptr;
}

/// Writes a packet with the image packed tightly. `write(stream, pixels)`, with null where there are none.
template <class Write>
void record_image(Context& context, const Image& image, const void* pixels, Write&& write) {
    try {
        const Unpack unpack = read_unpack(context);
        const bool is_empty = image.width <= 0 || image.height <= 0 || image.depth <= 0 ||
                              sizes::pixel_size(image.format, image.type).bits == 0;
        std::vector<std::byte> packed, read;
        if (!is_empty && (pixels || unpack.buffer)) {
            const Layout layout = lay_out(unpack, image);
            const std::byte* from = find_pixels(context, unpack.buffer, pixels, layout.total, read);
            if (!from) return context.count("an image in a buffer that cannot be read");
            packed = pack_tightly(unpack, layout, image, from);
        }
        const void* data = packed.empty() ? nullptr : packed.data();
        context.emit(true, [&](Stream& stream) { write(stream, data); });
    } catch (const std::exception&) {
        if (context.compilation) context.give_up_list();
        context.give_up_frame("out of memory");
    }
}

/// Before an upload. The context, if it has to be kept: for a list, or for the texture named 0.
Context* context_of_upload(GLenum target) {
    Context* context = listening_context();
    if (!context || !context->can_query()) return nullptr;
    copy_before_change(*context, target);
    return note_default_filled(*context, target) || context->compilation ? context : nullptr;
}

} // namespace
} // namespace glcast::record

namespace glcast::record::custom {

void APIENTRY Bitmap(GLsizei w, GLsizei h, GLfloat xo, GLfloat yo, GLfloat xm, GLfloat ym,
                     const GLubyte* bits) {
    if (Context* context = listening_context(); context && context->can_query())
        record_image(
            *context, {w, h, 1, GL_COLOR_INDEX, GL_BITMAP}, bits, [&](Stream& stream, const void* data) {
                packets::Bitmap::write(stream, w, h, xo, yo, xm, ym, static_cast<const GLubyte*>(data));
            });
    this_thread.real->Bitmap(w, h, xo, yo, xm, ym, bits);
}

void APIENTRY DrawPixels(GLsizei w, GLsizei h, GLenum format, GLenum type, const void* pixels) {
    if (Context* context = listening_context(); context && context->can_query())
        record_image(*context, {w, h, 1, format, type}, pixels, [&](Stream& stream, const void* data) {
            packets::DrawPixels::write(stream, w, h, format, type, data);
        });
    this_thread.real->DrawPixels(w, h, format, type, pixels);
}

void APIENTRY PolygonStipple(const GLubyte* mask) {
    if (Context* context = listening_context(); context && context->can_query())
        record_image(*context, {32, 32, 1, GL_COLOR_INDEX, GL_BITMAP}, mask,
                     [&](Stream& stream, const void* data) {
                         if (data) packets::PolygonStipple::write(stream, static_cast<const GLubyte*>(data));
                     });
    this_thread.real->PolygonStipple(mask);
}

void APIENTRY TexImage1D(GLenum target, GLint level, GLint internal, GLsizei w, GLint border, GLenum format,
                         GLenum type, const void* pixels) {
    if (Context* context = context_of_upload(target))
        record_image(*context, {w, 1, 1, format, type}, pixels, [&](Stream& stream, const void* data) {
            packets::TexImage1D::write(stream, target, level, internal, w, border, format, type, data);
        });
    this_thread.real->TexImage1D(target, level, internal, w, border, format, type, pixels);
}

void APIENTRY TexImage2D(GLenum target, GLint level, GLint internal, GLsizei w, GLsizei h, GLint border,
                         GLenum format, GLenum type, const void* pixels) {
    if (Context* context = context_of_upload(target))
        record_image(*context, {w, h, 1, format, type}, pixels, [&](Stream& stream, const void* data) {
            packets::TexImage2D::write(stream, target, level, internal, w, h, border, format, type, data);
        });
    this_thread.real->TexImage2D(target, level, internal, w, h, border, format, type, pixels);
}

void APIENTRY TexImage3D(GLenum target, GLint level, GLint internal, GLsizei w, GLsizei h, GLsizei d,
                         GLint border, GLenum format, GLenum type, const void* pixels) {
    if (Context* context = context_of_upload(target))
        record_image(*context, {w, h, d, format, type, true}, pixels, [&](Stream& stream, const void* data) {
            packets::TexImage3D::write(stream, target, level, internal, w, h, d, border, format, type, data);
        });
    this_thread.real->TexImage3D(target, level, internal, w, h, d, border, format, type, pixels);
}

void APIENTRY TexSubImage1D(GLenum target, GLint level, GLint x, GLsizei w, GLenum format, GLenum type,
                            const void* pixels) {
    if (Context* context = context_of_upload(target))
        record_image(*context, {w, 1, 1, format, type}, pixels, [&](Stream& stream, const void* data) {
            packets::TexSubImage1D::write(stream, target, level, x, w, format, type, data);
        });
    this_thread.real->TexSubImage1D(target, level, x, w, format, type, pixels);
}

void APIENTRY TexSubImage2D(GLenum target, GLint level, GLint x, GLint y, GLsizei w, GLsizei h, GLenum format,
                            GLenum type, const void* pixels) {
    if (Context* context = context_of_upload(target))
        record_image(*context, {w, h, 1, format, type}, pixels, [&](Stream& stream, const void* data) {
            packets::TexSubImage2D::write(stream, target, level, x, y, w, h, format, type, data);
        });
    this_thread.real->TexSubImage2D(target, level, x, y, w, h, format, type, pixels);
}

void APIENTRY TexSubImage3D(GLenum target, GLint level, GLint x, GLint y, GLint z, GLsizei w, GLsizei h,
                            GLsizei d, GLenum format, GLenum type, const void* pixels) {
    if (Context* context = context_of_upload(target))
        record_image(*context, {w, h, d, format, type, true}, pixels, [&](Stream& stream, const void* data) {
            packets::TexSubImage3D::write(stream, target, level, x, y, z, w, h, d, format, type, data);
        });
    this_thread.real->TexSubImage3D(target, level, x, y, z, w, h, d, format, type, pixels);
}

} // namespace glcast::record::custom

namespace glcast::record {
namespace {

/// Compressed images need no unpacking: their last two arguments are the size and the bytes.
template <class Packet, class... A>
void record_compressed(GLenum target, GLsizei bytes, const void* pixels, A... before) {
    Context* context = context_of_upload(target);
    if (!context || bytes < 0) return;
    try {
        std::vector<std::byte> read;
        const std::byte* from =
            find_pixels(*context, read_unpack(*context).buffer, pixels, std::size_t(bytes), read);
        context->emit(true, [&](Stream& stream) { Packet::write(stream, target, before..., bytes, from); });
    } catch (const std::exception&) {
        if (context->compilation) context->give_up_list();
        context->give_up_frame("out of memory");
    }
}

} // namespace
} // namespace glcast::record

namespace glcast::record::custom {

void APIENTRY CompressedTexImage1D(GLenum target, GLint level, GLenum internal, GLsizei w, GLint border,
                                   GLsizei bytes, const void* data) {
    record_compressed<packets::CompressedTexImage1D>(target, bytes, data, level, internal, w, border);
    this_thread.real->CompressedTexImage1D(target, level, internal, w, border, bytes, data);
}

void APIENTRY CompressedTexImage2D(GLenum target, GLint level, GLenum internal, GLsizei w, GLsizei h,
                                   GLint border, GLsizei bytes, const void* data) {
    record_compressed<packets::CompressedTexImage2D>(target, bytes, data, level, internal, w, h, border);
    this_thread.real->CompressedTexImage2D(target, level, internal, w, h, border, bytes, data);
}

void APIENTRY CompressedTexImage3D(GLenum target, GLint level, GLenum internal, GLsizei w, GLsizei h,
                                   GLsizei d, GLint border, GLsizei bytes, const void* data) {
    record_compressed<packets::CompressedTexImage3D>(target, bytes, data, level, internal, w, h, d, border);
    this_thread.real->CompressedTexImage3D(target, level, internal, w, h, d, border, bytes, data);
}

void APIENTRY CompressedTexSubImage1D(GLenum target, GLint level, GLint x, GLsizei w, GLenum format,
                                      GLsizei bytes, const void* data) {
    record_compressed<packets::CompressedTexSubImage1D>(target, bytes, data, level, x, w, format);
    this_thread.real->CompressedTexSubImage1D(target, level, x, w, format, bytes, data);
}

void APIENTRY CompressedTexSubImage2D(GLenum target, GLint level, GLint x, GLint y, GLsizei w, GLsizei h,
                                      GLenum format, GLsizei bytes, const void* data) {
    record_compressed<packets::CompressedTexSubImage2D>(target, bytes, data, level, x, y, w, h, format);
    this_thread.real->CompressedTexSubImage2D(target, level, x, y, w, h, format, bytes, data);
}

void APIENTRY CompressedTexSubImage3D(GLenum target, GLint level, GLint x, GLint y, GLint z, GLsizei w,
                                      GLsizei h, GLsizei d, GLenum format, GLsizei bytes, const void* data) {
    record_compressed<packets::CompressedTexSubImage3D>(target, bytes, data, level, x, y, z, w, h, d, format);
    this_thread.real->CompressedTexSubImage3D(target, level, x, y, z, w, h, d, format, bytes, data);
}

} // namespace glcast::record::custom
