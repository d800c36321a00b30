// The least that a preload can do: two lines a call. What idle glcast is compared with.
#define _GNU_SOURCE
#include <dlfcn.h>

static void (*real_vertex)(float, float, float);
static void (*real_normal)(float, float, float);

void glVertex3f(float x, float y, float z) {
    if (!real_vertex) real_vertex = (void (*)(float, float, float))dlsym(RTLD_NEXT, "glVertex3f");
    real_vertex(x, y, z);
}

void glNormal3f(float x, float y, float z) {
    if (!real_normal) real_normal = (void (*)(float, float, float))dlsym(RTLD_NEXT, "glNormal3f");
    real_normal(x, y, z);
}
