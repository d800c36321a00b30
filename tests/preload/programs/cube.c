// A window with a cube in it, by GLX and immediate mode: as small as such a program can be.
#include "cube.h"

#include <GL/gl.h>
#include <GL/glx.h>
#include <X11/Xlib.h>

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

int draw_cubes(int frames, void (*before_frame)(int frame)) {
    Display* display = XOpenDisplay(0);
    if (!display) return 10;
    int attributes[] = {GLX_RGBA, GLX_DOUBLEBUFFER, GLX_DEPTH_SIZE, 16, None};
    XVisualInfo* visual = glXChooseVisual(display, DefaultScreen(display), attributes);
    if (!visual) return 11;
    const Window root = RootWindow(display, visual->screen);
    XSetWindowAttributes looks = {0};
    looks.colormap = XCreateColormap(display, root, visual->visual, AllocNone);
    const Window window = XCreateWindow(display, root, 0, 0, 100, 100, 0, visual->depth, InputOutput,
                                        visual->visual, CWColormap | CWBorderPixel, &looks);
    XMapWindow(display, window);
    GLXContext context = glXCreateContext(display, visual, 0, True);
    if (!context || !glXMakeCurrent(display, window, context)) return 12;
    set_camera();
    for (int frame = 1; frame <= frames; ++frame) {
        if (before_frame) before_frame(frame);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        if (frame > 1) draw_cube();
        glXSwapBuffers(display, window);
    }
    glXMakeCurrent(display, None, 0);
    glXDestroyContext(display, context);
    XFree(visual);
    XCloseDisplay(display);
    return 0;
}
