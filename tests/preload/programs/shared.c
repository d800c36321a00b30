/* Objects that two contexts share, changed and deleted between frames while something still holds them. argv[1] names the kind. */
#define GL_GLEXT_PROTOTYPES
#include <stdio.h>
#include <string.h>

#include "window.h"

enum { size = 100, frames = 6 };
static const char* kind;
static Window window, other_window;
static GLXContext context, other;
#define IS(name) (strcmp(kind, name) == 0)

static void use_first(void) { glXMakeCurrent(display, window, context); }
static void use_other(void) { glXMakeCurrent(display, other_window, other); }

/* What the program can tell: the errors that it got, and a sum over the picture. */
static void tell(const char* when) {
    static unsigned char pixels[size * size * 4];
    unsigned sum = 0;
    glReadPixels(0, 0, size, size, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
    for (unsigned i = 0; i < sizeof pixels; ++i) sum = sum * 31 + pixels[i];
    printf("%s %s: pixels %08x, error %x\n", kind, when, sum, glGetError());
}

static void fill(GLenum target, GLuint name, unsigned char shade) {
    static unsigned char texels[16 * 16 * 4];
    for (unsigned i = 0; i < sizeof texels; ++i) texels[i] = (unsigned char)(shade + 3 * i);
    glBindTexture(target, name);
    glTexParameteri(target, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexImage2D(target, 0, GL_RGBA, 16, 16, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels);
}

static void draw_solid(void) {
    look_at_chiral(size);
    glEnable(GL_TEXTURE_2D);
    glTexGeni(GL_S, GL_TEXTURE_GEN_MODE, GL_OBJECT_LINEAR);
    glTexGeni(GL_T, GL_TEXTURE_GEN_MODE, GL_OBJECT_LINEAR);
    glEnable(GL_TEXTURE_GEN_S);
    glEnable(GL_TEXTURE_GEN_T);
    draw_chiral();
    glDisable(GL_TEXTURE_GEN_S);
    glDisable(GL_TEXTURE_GEN_T);
}

/* Nothing that would be cast. */
static void draw_flat(void) {
    glDisable(GL_DEPTH_TEST);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glEnable(GL_TEXTURE_2D);
    glRectf(-0.5f, -0.5f, 0.5f, 0.5f);
}

/* A frame leaves attributes pushed that hold textures; until the next one ends a texture has other parameters and
   one is gone. */
static void push_and_change(void) {
    GLuint names[2];
    glGenTextures(2, names);
    glActiveTexture(GL_TEXTURE1);
    fill(GL_TEXTURE_2D, names[1], 9);
    glActiveTexture(GL_TEXTURE0);
    fill(GL_TEXTURE_2D, names[0], 5);
    glXSwapBuffers(display, window);
    draw_flat();
    glPushAttrib(GL_ALL_ATTRIB_BITS);
    glBindTexture(GL_TEXTURE_2D, names[1]);
    draw_flat();
    glBindTexture(GL_TEXTURE_2D, names[0]);
    glXSwapBuffers(display, window);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glBindTexture(GL_TEXTURE_2D, 0);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP);
    glBindTexture(GL_TEXTURE_2D, names[0]);
    glDeleteTextures(1, &names[1]);
    draw_flat();
    glXSwapBuffers(display, window);
    draw_solid();
    glXSwapBuffers(display, window);
    GLint filter = 0, wrap = 0;
    glGetTexParameteriv(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, &filter);
    glBindTexture(GL_TEXTURE_2D, 0);
    glGetTexParameteriv(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, &wrap);
    printf("filter %x, wrap %x, deleted one is a texture: %d\n", filter, wrap, glIsTexture(names[1]));
    glPopAttrib();
}

/* A texture that both have drawn from is deleted, and then the context that made it is destroyed, in between two
   frames of the other. */
static void delete_and_destroy(void) {
    GLuint name;
    use_other();
    glGenTextures(1, &name);
    fill(GL_TEXTURE_2D, name, 7);
    draw_flat();
    glFinish();
    use_first();
    glXSwapBuffers(display, window);
    glBindTexture(GL_TEXTURE_2D, name);
    draw_flat();
    glXSwapBuffers(display, window);
    glDeleteTextures(1, &name);
    use_other();
    glBindTexture(GL_TEXTURE_2D, 0);
    use_first();
    glXDestroyContext(display, other);
    for (int i = 0; i < frames; ++i) {
        draw_solid();
        tell("frame");
        glXSwapBuffers(display, window);
    }
}

/* In every frame objects of each kind are drawn from, deleted while the other context has them bound or they are
   attached, drawn from once more there, and let go. */
static void keep_without_a_name(void) {
    static const float square[] = {-1, -1, 1, -1, 1, 1, -1, 1};
    for (int i = 0; i < frames; ++i) {
        GLuint textures[3], buffer, framebuffer, renderbuffer;
        use_first();
        glGenTextures(3, textures);
        for (int k = 0; k < 3; ++k) fill(GL_TEXTURE_2D, textures[k], (unsigned char)(i + k));
        glGenBuffers(1, &buffer);
        glBindBuffer(GL_ARRAY_BUFFER, buffer);
        glBufferData(GL_ARRAY_BUFFER, sizeof square, square, GL_STATIC_DRAW);
        glVertexPointer(2, GL_FLOAT, 0, 0);
        glEnableClientState(GL_VERTEX_ARRAY);
        glGenFramebuffers(1, &framebuffer);
        glGenRenderbuffers(1, &renderbuffer);
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
        glBindRenderbuffer(GL_RENDERBUFFER, renderbuffer);
        glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, 16, 16);
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, textures[2], 0);
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, renderbuffer);
        glBindTexture(GL_TEXTURE_2D, textures[0]);
        glDrawArrays(GL_QUADS, 0, 4);
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
        use_other();
        glBindTexture(GL_TEXTURE_2D, textures[1]);
        glBindBuffer(GL_ARRAY_BUFFER, buffer);
        glVertexPointer(2, GL_FLOAT, 0, 0);
        glEnableClientState(GL_VERTEX_ARRAY);
        glEnable(GL_TEXTURE_2D);
        glDrawArrays(GL_QUADS, 0, 4);
        use_first();
        for (int k = 0; k < 3; ++k) glBindTexture(GL_TEXTURE_2D, textures[k]), draw_solid();
        tell("drawn");
        if (i % 2) glDeleteTextures(3, textures), glDeleteBuffers(1, &buffer); /* within the frame */
        glXSwapBuffers(display, window);
        glDeleteTextures(3, textures);
        glDeleteBuffers(1, &buffer);
        glDeleteRenderbuffers(1, &renderbuffer);
        use_other(); /* it still has one of each */
        glDrawArrays(GL_QUADS, 0, 4);
        draw_solid();
        tell("without a name");
        glXSwapBuffers(display, other_window);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, i);
        glBindTexture(GL_TEXTURE_2D, 0);
        glBindBuffer(GL_ARRAY_BUFFER, 0);
        use_first();
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
        glDeleteFramebuffers(1, &framebuffer);
    }
}

int main(int argc, char** argv) {
    if (argc < 2) return 2;
    kind = argv[1];
    window = make_window(size, size);
    other_window = make_window(size, size);
    context = make_context(0);
    other = make_context(context);
    use_first();
    if (IS("pushed"))
        push_and_change();
    else if (IS("destroyed"))
        delete_and_destroy();
    else if (IS("nameless"))
        keep_without_a_name();
    else
        return 2;
    use_first();
    draw_solid();
    tell("at the end");
    glXMakeCurrent(display, None, 0);
    glXDestroyContext(display, context);
    return 0;
}
