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
