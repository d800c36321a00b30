#include "window.h"

#include <stdlib.h>

Display* display;
XVisualInfo* visual;
int stencil_size;

Window make_window(int width, int height) {
    if (!display && !(display = XOpenDisplay(0))) exit(10);
    int attributes[] = {GLX_RGBA, GLX_DOUBLEBUFFER, GLX_DEPTH_SIZE, 16, GLX_STENCIL_SIZE, stencil_size, None};
    if (!visual && !(visual = glXChooseVisual(display, DefaultScreen(display), attributes))) exit(11);
    const Window root = RootWindow(display, visual->screen);
    XSetWindowAttributes looks = {0};
    looks.colormap = XCreateColormap(display, root, visual->visual, AllocNone);
    looks.event_mask = ExposureMask | StructureNotifyMask | KeyPressMask;
    const Window window = XCreateWindow(display, root, 0, 0, width, height, 0, visual->depth, InputOutput,
                                        visual->visual, CWColormap | CWBorderPixel | CWEventMask, &looks);
    XMapWindow(display, window);
    XSync(display, False);
    return window;
}

GLXContext make_context(GLXContext share) {
    GLXContext context = glXCreateContext(display, visual, share, True);
    if (!context) exit(12);
    return context;
}

void draw_box(const float lo[3], const float hi[3]) {
    static const int faces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    static const float normals[6][3] = {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}};
    glBegin(GL_QUADS);
    for (int face = 0; face < 6; ++face) {
        glNormal3fv(normals[face]);
        for (int i = 0; i < 4; ++i) {
            const int c = faces[face][i];
            glVertex3f(c & 1 ? hi[0] : lo[0], c & 2 ? hi[1] : lo[1], c & 4 ? hi[2] : lo[2]);
        }
    }
    glEnd();
}

const float chiral_boxes[3][2][3] = {
    {{0, 0, 0}, {1, 1, 3}}, {{1, 0, 0}, {3, 1, 1}}, {{0, 1, 2}, {1, 2, 3}}};

void draw_chiral(void) {
    for (int i = 0; i < 3; ++i) draw_box(chiral_boxes[i][0], chiral_boxes[i][1]);
}

void look_at_chiral(int size) {
    glViewport(0, 0, size, size);
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glFrustum(-1, 1, -1, 1, 2, 40);
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    glTranslatef(-1, -1, -9);
    glEnable(GL_DEPTH_TEST);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}
