/* The body of chiral.h drawn by OSMesa into memory of the program's own: reads_osmesa HOW [FRAMES]. With
   OPENED nothing is linked, and OSMesa opened by dlopen, beside whatever GL there is. */
#include <GL/osmesa.h>
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef OPENED
#define EACH_CALL(X)                                                                                         \
    X(OSMesaCreateContextExt)                                                                                \
    X(OSMesaCreateContextAttribs)                                                                            \
    X(OSMesaMakeCurrent) X(OSMesaGetColorBuffer) X(OSMesaDestroyContext) X(glReadPixels) X(glFinish)         \
        X(glGetError) X(glBegin) X(glNormal3fv) X(glVertex3f) X(glEnd) X(glViewport) X(glMatrixMode)         \
            X(glLoadIdentity) X(glFrustum) X(glTranslatef) X(glEnable) X(glClear)
#define DECLARE(NAME) static __typeof__(NAME)* opened_##NAME;
EACH_CALL(DECLARE)
#define OSMesaCreateContextExt opened_OSMesaCreateContextExt
#define OSMesaCreateContextAttribs opened_OSMesaCreateContextAttribs
#define OSMesaMakeCurrent opened_OSMesaMakeCurrent
#define OSMesaGetColorBuffer opened_OSMesaGetColorBuffer
#define OSMesaDestroyContext opened_OSMesaDestroyContext
#define glReadPixels opened_glReadPixels
#define glFinish opened_glFinish
#define glGetError opened_glGetError
#define glBegin opened_glBegin
#define glNormal3fv opened_glNormal3fv
#define glVertex3f opened_glVertex3f
#define glEnd opened_glEnd
#define glViewport opened_glViewport
#define glMatrixMode opened_glMatrixMode
#define glLoadIdentity opened_glLoadIdentity
#define glFrustum opened_glFrustum
#define glTranslatef opened_glTranslatef
#define glEnable opened_glEnable
#define glClear opened_glClear
#include "chiral.c"
/* Macros that are operands of # and ## are not replaced: these are the names themselves. */
static int open_osmesa(void) {
    void* library = dlopen("libOSMesa.so.8", RTLD_LAZY | RTLD_LOCAL);
    static const struct {
        const char* name;
        void** function;
    } calls[] = {
#define ENTRY(NAME) {#NAME, (void**)&opened_##NAME},
        EACH_CALL(ENTRY)};
    for (size_t i = 0; library && i < sizeof calls / sizeof *calls; ++i)
        if (!(*calls[i].function = dlsym(library, calls[i].name))) return 0;
    return library != 0;
}
#else
static int open_osmesa(void) { return 1; }
#endif

#include "chiral.h"

enum { size = 100 };
static unsigned char memory[4 * size * size], pixels[4 * size * size];

int main(int argc, char** argv) {
    const char* how = argc > 1 ? argv[1] : "finish";
    if (!open_osmesa()) return 10;
    OSMesaContext context =
        strcmp(how, "attributes") != 0 ? OSMesaCreateContextExt(OSMESA_BGRA, 24, 8, 0, 0) : 0;
    if (!context) {
        const int wanted[] = {OSMESA_FORMAT,
                              OSMESA_RGBA,
                              OSMESA_DEPTH_BITS,
                              24,
                              OSMESA_PROFILE,
                              OSMESA_COMPAT_PROFILE,
                              OSMESA_CONTEXT_MAJOR_VERSION,
                              2,
                              OSMESA_CONTEXT_MINOR_VERSION,
                              1,
                              0,
                              0};
        context = OSMesaCreateContextAttribs(wanted, 0);
    }
    if (!context || !OSMesaMakeCurrent(context, memory, GL_UNSIGNED_BYTE, size, size)) return 11;
    for (int frame = argc > 2 ? atoi(argv[2]) : 3; frame > 0; --frame) {
        look_at_chiral(size);
        draw_chiral();
        if (strcmp(how, "read") == 0) glReadPixels(0, 0, size, size, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
        if (strcmp(how, "finish") == 0 || strcmp(how, "attributes") == 0) glFinish();
        if (strcmp(how, "leave") == 0) {
            OSMesaMakeCurrent(0, 0, GL_UNSIGNED_BYTE, 0, 0);
            OSMesaMakeCurrent(context, memory, GL_UNSIGNED_BYTE, size, size);
        }
        if (strcmp(how, "buffer") == 0) {
            void* buffer;
            int width, height, format;
            if (!OSMesaGetColorBuffer(context, &width, &height, &format, &buffer) || width != size) return 12;
        }
    }
    const unsigned error = glGetError();
    glFinish();
    unsigned long sum = 0;
    for (size_t p = 0; p < sizeof memory; ++p) sum = sum * 31 + memory[p] + pixels[p];
    OSMesaDestroyContext(context);
    printf("error %x, pixels %lx\n", error, sum);
    return 0;
}
