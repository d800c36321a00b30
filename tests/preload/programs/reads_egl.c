/* Pictures that are read, drawn in contexts of EGL that have no window: reads_egl pbuffer|surfaceless
 * [FRAMES]. */
#define GL_GLEXT_PROTOTYPES
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/gl.h>
#include <GL/glext.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "chiral.h"

enum { size = 100 };

static void make_framebuffer(void) {
    GLuint framebuffer, buffers[2];
    glGenFramebuffers(1, &framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glGenRenderbuffers(2, buffers);
    for (int i = 0; i < 2; ++i) {
        glBindRenderbuffer(GL_RENDERBUFFER, buffers[i]);
        glRenderbufferStorage(GL_RENDERBUFFER, i ? GL_DEPTH_COMPONENT16 : GL_RGBA8, size, size);
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, i ? GL_DEPTH_ATTACHMENT : GL_COLOR_ATTACHMENT0,
                                  GL_RENDERBUFFER, buffers[i]);
    }
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) exit(15);
}

int main(int argc, char** argv) {
    const int has_surface = argc < 2 || strcmp(argv[1], "pbuffer") == 0;
    EGLDisplay display = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, 0);
    if (!eglInitialize(display, 0, 0) || !eglBindAPI(EGL_OPENGL_API)) return 11;
    const EGLint wanted[] = {
        EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_DEPTH_SIZE, 16, EGL_NONE};
    EGLConfig config;
    EGLint count = 0;
    if (!eglChooseConfig(display, wanted, &config, 1, &count) || count == 0) return 12;
    EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, 0);
    const EGLint sizes[] = {EGL_WIDTH, size, EGL_HEIGHT, size, EGL_NONE};
    EGLSurface surface = has_surface ? eglCreatePbufferSurface(display, config, sizes) : EGL_NO_SURFACE;
    if (!eglMakeCurrent(display, surface, surface, context)) return 13;
    if (!has_surface) make_framebuffer();
    static unsigned char pixels[4 * size * size];
    for (int frame = argc > 2 ? atoi(argv[2]) : 3; frame > 0; --frame) {
        look_at_chiral(size);
        draw_chiral();
        glReadPixels(0, 0, size, size, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
    }
    unsigned long sum = 0;
    for (size_t p = 0; p < sizeof pixels; ++p) sum = sum * 31 + pixels[p];
    printf("error %x, pixels %lx\n", glGetError(), sum);
    eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglTerminate(display);
    return 0;
}
