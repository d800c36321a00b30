// A window with a cube in it, by GLX (or by EGL: CUBE_EGL) and immediate mode: as small as such a program can
// be.
#include "cube.h"

#include <GL/gl.h>
#include <stdint.h>
#include <string.h>
#ifdef CUBE_EGL
#include <EGL/egl.h>
#else
#include <GL/glx.h>
#endif
#include <X11/Xlib.h>
#include <X11/Xutil.h>

static void draw_cube(void) {
    static const float corners[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                        {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
    static const int faces[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                    {3, 7, 6, 2}, {0, 4, 7, 3}, {1, 2, 6, 5}};
    static const float normals[6][3] = {{0, 0, -1}, {0, 0, 1}, {0, -1, 0}, {0, 1, 0}, {-1, 0, 0}, {1, 0, 0}};
    glBegin(GL_QUADS);
    for (int face = 0; face < 6; ++face) {
        glNormal3fv(normals[face]);
        for (int corner = 0; corner < 4; ++corner) glVertex3fv(corners[faces[face][corner]]);
    }
    glEnd();
}

static void set_camera(void) {
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_LIGHTING);
    glEnable(GL_LIGHT0);
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glFrustum(-1, 1, -1, 1, 2, 20);
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    glTranslatef(0, 0, -6);
}

const char* frame_end = "swap";

static int draws_to(const char* buffer) { return strncmp(frame_end, buffer, strlen(buffer)) == 0; }

static const char* end_call(void) {
    const char* space = strchr(frame_end, ' ');
    return space ? space + 1 : frame_end;
}

typedef struct {
    Display* display;
    Window window;
    void* context;
#ifdef CUBE_EGL
    EGLDisplay egl;
    EGLConfig config;
    EGLSurface surface;
#endif
} Place;

static void open_window(Place* s, const XVisualInfo* visual) {
    const Window root = RootWindow(s->display, visual->screen);
    XSetWindowAttributes looks = {0};
    looks.colormap = XCreateColormap(s->display, root, visual->visual, AllocNone);
    s->window = XCreateWindow(s->display, root, 0, 0, 100, 100, 0, visual->depth, InputOutput, visual->visual,
                              CWColormap | CWBorderPixel, &looks);
    XMapWindow(s->display, s->window);
}

#ifdef CUBE_EGL
static int open_gl(Place* s) {
    const EGLint wanted[] = {
        EGL_SURFACE_TYPE, EGL_WINDOW_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_DEPTH_SIZE, 16, EGL_NONE};
    EGLint count = 0, id = 0;
    s->egl = eglGetDisplay((EGLNativeDisplayType)s->display);
    if (!eglInitialize(s->egl, 0, 0) || !eglBindAPI(EGL_OPENGL_API)) return 11;
    if (!eglChooseConfig(s->egl, wanted, &s->config, 1, &count) || count == 0) return 11;
    eglGetConfigAttrib(s->egl, s->config, EGL_NATIVE_VISUAL_ID, &id);
    XVisualInfo like = {0};
    like.visualid = (VisualID)id;
    XVisualInfo* visual = XGetVisualInfo(s->display, VisualIDMask, &like, &count);
    if (!visual) return 11;
    open_window(s, visual);
    XFree(visual);
    s->surface = eglCreateWindowSurface(s->egl, s->config, s->window, 0);
    s->context = eglCreateContext(s->egl, s->config, EGL_NO_CONTEXT, 0);
    return eglMakeCurrent(s->egl, s->surface, s->surface, s->context) ? 0 : 12;
}

/// False when it cannot be called.
static int end_by_system(Place* s, const char* how) {
    typedef EGLBoolean (*WithDamage)(EGLDisplay, EGLSurface, const EGLint*, EGLint);
    const EGLint all[] = {0, 0, 100, 100};
    const int khr = strcmp(how, "damage-khr") == 0;
    if (strcmp(how, "swap") == 0) return eglSwapBuffers(s->egl, s->surface);
    if (strcmp(how, "wait") == 0) return eglWaitGL();
    if (strcmp(how, "wait-client") == 0) return eglWaitClient();
    if (khr || strcmp(how, "damage-ext") == 0) {
        const WithDamage swap = (WithDamage)eglGetProcAddress(khr ? "eglSwapBuffersWithDamageKHR"
                                                                  : "eglSwapBuffersWithDamageEXT");
        return swap && swap(s->egl, s->surface, all, 1);
    }
    return 0;
}
static void close_gl(Place* s) {
    eglMakeCurrent(s->egl, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(s->egl, s->context);
    eglTerminate(s->egl);
}
#else
static int open_gl(Place* s) {
    int attributes[] = {GLX_RGBA, GLX_DEPTH_SIZE, 16, GLX_DOUBLEBUFFER, None};
    if (draws_to("single ")) attributes[3] = None;
    XVisualInfo* visual = glXChooseVisual(s->display, DefaultScreen(s->display), attributes);
    if (!visual) return 11;
    open_window(s, visual);
    s->context = glXCreateContext(s->display, visual, 0, True);
    XFree(visual);
    return s->context && glXMakeCurrent(s->display, s->window, s->context) ? 0 : 12;
}

/// False when it cannot be called.
static int end_by_system(Place* s, const char* how) {
    typedef int64_t (*Msc)(Display*, GLXDrawable, int64_t, int64_t, int64_t);
    typedef void (*Copy)(Display*, GLXDrawable, int, int, int, int);
    if (strcmp(how, "swap") == 0) return glXSwapBuffers(s->display, s->window), 1;
    if (strcmp(how, "wait") == 0) return glXWaitGL(), 1;
    if (strcmp(how, "msc") == 0) {
        const Msc swap = (Msc)glXGetProcAddressARB((const GLubyte*)"glXSwapBuffersMscOML");
        return swap && swap(s->display, s->window, 0, 0, 0) != -1;
    }
    if (strcmp(how, "copy") == 0) {
        const Copy copy = (Copy)glXGetProcAddressARB((const GLubyte*)"glXCopySubBufferMESA");
        if (copy) copy(s->display, s->window, 0, 0, 100, 100);
        return copy != 0;
    }
    return 0;
}
static void close_gl(Place* s) {
    glXMakeCurrent(s->display, None, 0);
    glXDestroyContext(s->display, s->context);
}
#endif

static int end_of_frame(Place* s) {
    const char* how = end_call();
    if (strcmp(how, "flush") == 0) return glFlush(), 1;
    if (strcmp(how, "finish") == 0) return glFinish(), 1;
    return end_by_system(s, how);
}

int draw_cubes(int frames, void (*before_frame)(int frame)) {
    Place screen = {0};
    screen.display = XOpenDisplay(0);
    if (!screen.display) return 10;
    const int failed = open_gl(&screen);
    if (failed) return failed;
    set_camera();
    if (draws_to("front ")) glDrawBuffer(GL_FRONT);
    for (int frame = 1; frame <= frames; ++frame) {
        if (before_frame) before_frame(frame);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        if (frame > 1) draw_cube();
        if (!end_of_frame(&screen)) return 13;
    }
    close_gl(&screen);
    XCloseDisplay(screen.display);
    return 0;
}
