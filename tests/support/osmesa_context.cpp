#include "tests/support/osmesa_context.h"

#include <GL/osmesa.h>

#include <stdexcept>

namespace glcast::test {

struct OsmesaContext::Impl {
    OSMesaContext context = nullptr;
    int width = 0, height = 0;
    std::vector<std::uint8_t> pixels; ///< OSMesa draws straight into it
    GlTable gl{};
};

OsmesaContext::OsmesaContext(int width, int height, OsmesaContext* share) : impl(std::make_unique<Impl>()) {
    const int attributes[] = {OSMESA_FORMAT,
                              OSMESA_RGBA,
                              OSMESA_DEPTH_BITS,
                              24,
                              OSMESA_STENCIL_BITS,
                              8,
                              OSMESA_PROFILE,
                              OSMESA_COMPAT_PROFILE,
                              0};
    impl->context = OSMesaCreateContextAttribs(attributes, share ? share->impl->context : nullptr);
    if (!impl->context) throw std::runtime_error("OSMesa gave no context");
    impl->width = width;
    impl->height = height;
    impl->pixels.resize(std::size_t(4) * width * height);
    make_current();
    impl->gl =
        load_gl_table([](const char* name) { return reinterpret_cast<GlProc>(OSMesaGetProcAddress(name)); });
}

OsmesaContext::~OsmesaContext() {
    if (OSMesaGetCurrentContext() == impl->context) release();
    OSMesaDestroyContext(impl->context);
}

void OsmesaContext::make_current() {
    if (!OSMesaMakeCurrent(impl->context, impl->pixels.data(), GL_UNSIGNED_BYTE, impl->width, impl->height))
        throw std::runtime_error("OSMesaMakeCurrent failed");
}

void OsmesaContext::release() { OSMesaMakeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0); }

const GlTable& OsmesaContext::gl() const { return impl->gl; }
int OsmesaContext::width() const { return impl->width; }
int OsmesaContext::height() const { return impl->height; }

std::vector<std::uint8_t> OsmesaContext::read_rgba() {
    make_current();
    const GlTable& gl = impl->gl;
    GLint draw = 0, read = 0;
    gl.GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &draw);
    gl.GetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &read);
    gl.BindFramebuffer(GL_FRAMEBUFFER, 0); // glFinish copies into our pixels only from there
    gl.Finish();
    gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, draw);
    gl.BindFramebuffer(GL_READ_FRAMEBUFFER, read);
    return impl->pixels;
}

} // namespace glcast::test
