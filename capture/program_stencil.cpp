#include "capture/program_stencil.h"

#include <algorithm>

#include "capture/engine_target.h"
#include "capture/forced_table.h"
#include "capture/gl/gl_query.h"
#include "capture/stencil_rule.h"

namespace glcast {

namespace {

const GlTable& real() { return ForcedTable::current().real; }

/// The program's pixel paths are not for our mask.
void reset_pixel_paths(const GlTable& gl) {
    constexpr GLenum zero[] = {GL_UNPACK_SWAP_BYTES, GL_UNPACK_LSB_FIRST, GL_UNPACK_ROW_LENGTH,
                               GL_UNPACK_SKIP_PIXELS, GL_UNPACK_SKIP_ROWS};
    for (const GLenum name : zero) gl.PixelStorei(name, 0);
    gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    for (const GLenum name : {GL_MAP_STENCIL, GL_INDEX_SHIFT, GL_INDEX_OFFSET}) gl.PixelTransferi(name, 0);
    gl.PixelZoom(1, 1);
    if (gl.BindBuffer) gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
}

bool same_box(const Box& a, const Box& b) { return a.lo == b.lo && a.size == b.size; }

} // namespace

bool passes_stencil(int function, int reference, unsigned bits, int value) {
    const auto a = static_cast<unsigned>(reference) & bits, b = static_cast<unsigned>(value) & bits;
    switch (function) {
    case GL_NEVER:
        return false;
    case GL_LESS:
        return a < b;
    case GL_LEQUAL:
        return a <= b;
    case GL_GREATER:
        return a > b;
    case GL_GEQUAL:
        return a >= b;
    case GL_EQUAL:
        return a == b;
    case GL_NOTEQUAL:
        return a != b;
    default:
        return true;
    }
}

void ProgramStencil::look(const View& now) {
    const bool is_same =
        view && same_box(view->box, now.box) && view->axis == now.axis && view->size == now.size;
    if (is_same) return;
    view = now;
    known = {};
    for (Masks& masks : of_side) masks.clear();
    of_both.clear();
}

void ProgramStencil::begin_finding(const Target& to, Side side) {
    work = Work::finding;
    target = &to;
    viewer = side;
    of_side[static_cast<std::size_t>(side)].clear();
    last_test.reset();
}

void ProgramStencil::begin_pass(const std::optional<Side>& side, const std::optional<PixelRect>& only) {
    work = Work::passing;
    viewer = side;
    scissor = only;
    next = 0;
}

void ProgramStencil::end() {
    if (work == Work::finding) known[static_cast<std::size_t>(*viewer)] = true;
    work = Work::none;
    open = nullptr;
}

bool ProgramStencil::begin_draw(const StencilUse& use, bool is_solid) {
    if (work == Work::finding) {
        find(use);
        return use.marks;
    }
    if (work == Work::none || !use.is_kept) return is_solid;
    const Masks& masks = masks_of_pass();
    const std::size_t number = next++;
    if (!is_solid || number >= masks.size()) return is_solid;
    const Mask& mask = *masks[number];
    if (mask.rect.empty()) return false;
    open = &mask;
    if (!mask.is_all) write(mask);
    ForcedTable::current().state.keep_to_mask(true, !mask.is_all);
    return true;
}

void ProgramStencil::end_draw() {
    if (!open) return;
    ForcedTable::current().state.keep_to_mask(false, false);
    if (!open->is_all) wipe(*open);
    open = nullptr;
}

void ProgramStencil::find(const StencilUse& use) {
    const GlTable& gl = real();
    if (use.cleared_to) {
        const GLint mask = get_int(gl, GL_STENCIL_WRITEMASK);
        gl.StencilMask(~0u);
        gl.ClearStencil(*use.cleared_to);
        gl.Clear(GL_STENCIL_BUFFER_BIT);
        gl.StencilMask(static_cast<GLuint>(mask));
        last_test.reset();
    }
    if (use.is_kept) {
        const Test test{get_int(gl, GL_STENCIL_FUNC), get_int(gl, GL_STENCIL_REF),
                        get_int(gl, GL_STENCIL_VALUE_MASK)};
        Masks& masks = of_side[static_cast<std::size_t>(*viewer)];
        masks.push_back(last_test == test ? masks.back() : read_mask(test));
        last_test = test;
    }
    if (use.marks) last_test.reset();
}

std::shared_ptr<const ProgramStencil::Mask> ProgramStencil::read_mask(const Test& test) const {
    std::vector<std::uint8_t> stencil;
    target->read_stencil(stencil);
    std::array<std::uint8_t, 256> bit_of{};
    for (int value = 0; value < 256; ++value)
        if (passes_stencil(test.function, test.reference, static_cast<unsigned>(test.bits), value))
            bit_of[static_cast<std::size_t>(value)] = stencil_mask_bit;
    const int n = target->size();
    const auto mask = std::make_shared<Mask>();
    mask->rect = bounds_of(PixelRect::whole(n), n, [&](std::size_t p) { return bit_of[stencil[p]] != 0; });
    for_each_pixel(mask->rect, n, [&](std::size_t p) { mask->bits.push_back(bit_of[stencil[p]]); });
    const auto is_set = [](std::uint8_t bit) { return bit != 0; };
    mask->is_all =
        mask->bits.size() == stencil.size() && std::all_of(mask->bits.begin(), mask->bits.end(), is_set);
    return mask;
}

const ProgramStencil::Masks& ProgramStencil::masks_of_pass() {
    if (viewer) return of_side[static_cast<std::size_t>(*viewer)];
    const auto& [minus, plus] = of_side;
    for (std::size_t i = of_both.size(); i < std::min(minus.size(), plus.size()); ++i) {
        const bool is_shared = i > 0 && minus[i] == minus[i - 1] && plus[i] == plus[i - 1];
        of_both.push_back(is_shared ? of_both.back() : either(*minus[i], *plus[i]));
    }
    return of_both;
}

std::shared_ptr<const ProgramStencil::Mask> ProgramStencil::either(const Mask& a, const Mask& b) {
    const auto mask = std::make_shared<Mask>();
    PixelRect& rect = mask->rect;
    if (a.rect.empty() || b.rect.empty())
        rect = a.rect.empty() ? b.rect : a.rect;
    else
        rect = {std::min(a.rect.x0, b.rect.x0), std::min(a.rect.y0, b.rect.y0),
                std::max(a.rect.x1, b.rect.x1), std::max(a.rect.y1, b.rect.y1)};
    mask->is_all = a.is_all || b.is_all;
    const auto width = static_cast<std::size_t>(rect.x1 - rect.x0);
    mask->bits.resize(width * static_cast<std::size_t>(rect.y1 - rect.y0));
    for (const Mask* from : {&a, &b}) {
        auto bit = from->bits.begin();
        for (int y = from->rect.y0; y < from->rect.y1; ++y)
            for (int x = from->rect.x0; x < from->rect.x1; ++x)
                mask->bits[static_cast<std::size_t>(y - rect.y0) * width +
                           static_cast<std::size_t>(x - rect.x0)] |= *bit++;
    }
    return mask;
}

/// glDrawPixels heeds the stencil's write mask, and neither its test nor depth, texture or fragment program.
void ProgramStencil::write(const Mask& mask) const {
    const GlTable& gl = real();
    reset_pixel_paths(gl);
    gl.StencilMask(stencil_mask_bit);
    gl.WindowPos2i(mask.rect.x0, mask.rect.y0);
    gl.DrawPixels(mask.rect.x1 - mask.rect.x0, mask.rect.y1 - mask.rect.y0, GL_STENCIL_INDEX,
                  GL_UNSIGNED_BYTE, mask.bits.data());
    gl.StencilMask(stencil_count_bits);
}

void ProgramStencil::wipe(const Mask& mask) const {
    const GlTable& gl = real();
    gl.StencilMask(stencil_mask_bit);
    gl.Enable(GL_SCISSOR_TEST);
    gl.Scissor(mask.rect.x0, mask.rect.y0, mask.rect.x1 - mask.rect.x0, mask.rect.y1 - mask.rect.y0);
    gl.ClearStencil(0);
    gl.Clear(GL_STENCIL_BUFFER_BIT);
    gl.StencilMask(~0u);
    if (!scissor) return gl.Disable(GL_SCISSOR_TEST);
    gl.Scissor(scissor->x0, scissor->y0, scissor->x1 - scissor->x0, scissor->y1 - scissor->y0);
}

} // namespace glcast
