// The engine's stencil test. Its seven lower bits count what was drawn; the highest is set where a draw that
// the program's own stencil test keeps to places may be drawn (program_stencil.h), while it is.
#pragma once
#include "capture/gl/gl_table.h"

namespace glcast {

inline constexpr GLuint stencil_mask_bit = 0x80, stencil_count_bits = 0x7f;

struct StencilRule {
    bool tests = false;          ///< there is a rule at all
    bool uncounted_only = false; ///< drawn where nothing was counted yet
    GLenum hidden = GL_KEEP,
           shown = GL_KEEP; ///< what becomes of the count where the depth test fails or passes

    /// `masked`: only where the highest bit is set, too.
    void apply(const GlTable& gl, bool masked) const {
        tests || masked ? gl.Enable(GL_STENCIL_TEST) : gl.Disable(GL_STENCIL_TEST);
        const GLuint bits = uncounted_only ? ~0u : masked ? stencil_mask_bit : 0;
        gl.StencilFunc(bits ? GL_EQUAL : GL_ALWAYS, masked ? GLint(stencil_mask_bit) : 0, bits ? bits : ~0u);
        gl.StencilOp(GL_KEEP, hidden, shown);
    }
};

} // namespace glcast
