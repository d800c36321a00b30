/* A window with a context, for the programs of this folder. */
#pragma once
#include <GL/gl.h>
#include <GL/glx.h>
#include <X11/Xlib.h>

#include "chiral.h"

extern Display* display;
extern XVisualInfo* visual;
/* Bits of stencil that windows are made with; 0 at first. */
extern int stencil_size;
Window make_window(int width, int height);
GLXContext make_context(GLXContext share);
