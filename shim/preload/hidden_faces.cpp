#include "shim/preload/hidden_faces.h"

namespace glcast::preload {

void HiddenFaces::enter(const std::array<GLfloat, 4>& background) {
    is_entered = true;
    gl.PushAttrib(GL_ENABLE_BIT | GL_CURRENT_BIT | GL_COLOR_BUFFER_BIT);
    gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl.DrawBuffer(GL_COLOR_ATTACHMENT0); // of ours: the program may have masked colours by GL_NONE
    for (const GLenum capability :
         {GL_LIGHTING, GL_TEXTURE_1D, GL_TEXTURE_2D, GL_BLEND, GL_ALPHA_TEST, GL_COLOR_LOGIC_OP})
        gl.Disable(capability);
    gl.DisableClientState(GL_COLOR_ARRAY); // set for this draw alone
    gl.Color4fv(background.data());
}

void HiddenFaces::leave() {
    if (!is_entered) return;
    is_entered = false;
    gl.PopAttrib();
}

} // namespace glcast::preload
