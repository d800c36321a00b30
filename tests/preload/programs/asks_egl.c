/* asks_egl [es]: questions to EGL and GL in a pbuffer; es: in a context of OpenGL ES, about which all is said
 * as it is. */
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/gl.h>
#include <stdio.h>
#include <string.h>

#include "asks.h"

static Function get(const char* name) { return (Function)eglGetProcAddress(name); }

int main(int argc, char** argv) {
    const int es = argc > 1 && strcmp(argv[1], "es") == 0;
    EGLDisplay display = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, 0);
    if (!eglInitialize(display, 0, 0) || !eglBindAPI(es ? EGL_OPENGL_ES_API : EGL_OPENGL_API)) return 11;
    const EGLint wanted[] = {EGL_SURFACE_TYPE,
                             EGL_PBUFFER_BIT,
                             EGL_RENDERABLE_TYPE,
                             es ? EGL_OPENGL_ES2_BIT : EGL_OPENGL_BIT,
                             EGL_DEPTH_SIZE,
                             16,
                             EGL_NONE};
    EGLConfig config;
    EGLint count = 0;
    if (!eglChooseConfig(display, wanted, &config, 1, &count) || count == 0) return 12;
    const EGLint newer[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, es ? 0 : 2, EGL_NONE};
    EGLContext newest = eglCreateContext(display, config, EGL_NO_CONTEXT, newer);
    printf("newer %s", newest ? "made" : "refused");
    printf(" error %x\n", eglGetError());
    const EGLint old[] = {EGL_CONTEXT_MAJOR_VERSION, es ? 2 : 1, EGL_CONTEXT_MINOR_VERSION, es ? 0 : 4,
                          EGL_NONE};
    EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, old);
    printf("old %s\n", context ? "made" : "refused");
    const EGLint sizes[] = {EGL_WIDTH, 100, EGL_HEIGHT, 100, EGL_NONE};
    EGLSurface surface = eglCreatePbufferSurface(display, config, sizes);
    if (!eglMakeCurrent(display, surface, surface, context)) return 13;
    if (es) {
        printf("version %.13s\n", (const char*)glGetString(GL_VERSION));
        printf("shaders %s\n", get("glCreateShader") ? "there" : "not there");
        return 0;
    }
    ask(get);
    fflush(stdout);
    static unsigned char pixels[4 * 100 * 100];
    for (int frame = 0; frame < 3; ++frame) {
        draw_as_told(get, 100);
        glReadPixels(0, 0, 100, 100, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
    }
    return 0;
}
