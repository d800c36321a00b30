/* Pictures that are read and never swapped, and programs that read before they swap: reads WAY [FRAMES]. The
   body is that of chiral.h; PARTS of it are drawn before a read in the middle. */
#define GL_GLEXT_PROTOTYPES
#include <X11/Xutil.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "window.h"

enum { size = 100 };
static Window window;
static GLXContext context;
static unsigned char pixels[4 * size * size];

static void draw_part(int first, int end) {
    for (int i = first; i < end; ++i) draw_box(chiral_boxes[i][0], chiral_boxes[i][1]);
}

static void draw(void) {
    look_at_chiral(size);
    draw_chiral();
}

static void read_all(void) { glReadPixels(0, 0, size, size, GL_RGBA, GL_UNSIGNED_BYTE, pixels); }

static void read_rows(void) {
    for (int y = 0; y < size; ++y) glReadPixels(0, y, size, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
}

static void read_one(void) {
    float depth;
    glReadPixels(size / 2, size / 2, 1, 1, GL_DEPTH_COMPONENT, GL_FLOAT, &depth);
}

static GLXFBConfig config(int type, int doubled) {
    const int wanted[] = {GLX_DRAWABLE_TYPE,
                          type,
                          GLX_RENDER_TYPE,
                          GLX_RGBA_BIT,
                          GLX_DEPTH_SIZE,
                          16,
                          GLX_DOUBLEBUFFER,
                          doubled,
                          GLX_X_RENDERABLE,
                          True,
                          None};
    int count = 0;
    if (!display) display = XOpenDisplay(0);
    GLXFBConfig* all = display ? glXChooseFBConfig(display, DefaultScreen(display), wanted, &count) : 0;
    for (int i = 0; i < count; ++i)
        if (glXGetVisualFromFBConfig(display, all[i])) return all[i];
    exit(13);
}

static void make_current(GLXDrawable drawable) {
    if (!glXMakeContextCurrent(display, drawable, drawable, context)) exit(14);
}

static void open_window(void) {
    window = make_window(size, size);
    context = make_context(0);
    glXMakeCurrent(display, window, context);
}

static void open_pbuffer(void) {
    const int sizes[] = {GLX_PBUFFER_WIDTH, size, GLX_PBUFFER_HEIGHT, size, None};
    const GLXFBConfig with = config(GLX_PBUFFER_BIT, False);
    context = glXCreateNewContext(display, with, GLX_RGBA_TYPE, 0, True);
    make_current(glXCreatePbuffer(display, with, sizes));
}

static Pixmap pixmap;
static GLXPixmap glx_pixmap;
static void open_pixmap(void) {
    const GLXFBConfig with = config(GLX_PIXMAP_BIT, False);
    XVisualInfo* looks = glXGetVisualFromFBConfig(display, with);
    pixmap = XCreatePixmap(display, DefaultRootWindow(display), size, size, looks->depth);
    context = glXCreateNewContext(display, with, GLX_RGBA_TYPE, 0, True);
    make_current(glx_pixmap = glXCreatePixmap(display, with, pixmap, 0));
}

static void open_nothing(void) {
    context = glXCreateNewContext(display, config(GLX_WINDOW_BIT, True), GLX_RGBA_TYPE, 0, True);
    make_current(None);
}

static GLuint colour, framebuffer;
static void make_framebuffer(void) {
    GLuint depth;
    glGenTextures(1, &colour);
    glBindTexture(GL_TEXTURE_2D, colour);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, size, size, 0, GL_RGBA, GL_UNSIGNED_BYTE, 0);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glGenRenderbuffers(1, &depth);
    glBindRenderbuffer(GL_RENDERBUFFER, depth);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT16, size, size);
    glGenFramebuffers(1, &framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colour, 0);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) exit(15);
}

static void framebuffer_and_window(void) { open_window(), make_framebuffer(); }
static void framebuffer_and_nothing(void) { open_nothing(), make_framebuffer(); }

static void draw_and_read(void) { draw(), read_all(); }
static void draw_and_read_rows(void) { draw(), read_rows(); }
static void draw_and_get_texture(void) {
    draw();
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glGetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
}
/* As JOGL's GLJPanel does: turned over by a GLSL program into a second framebuffer, and read there. */
static void draw_turn_and_read(void) {
    static const char* const text = "uniform sampler2D picture; void main() { gl_FragColor = "
                                    "texture2D(picture, vec2(gl_FragCoord.x, 100.0 - "
                                    "gl_FragCoord.y) / 100.0); }";
    static GLuint scene, picture, turned, program;
    if (!program) {
        scene = framebuffer, picture = colour;
        make_framebuffer();
        turned = framebuffer;
        const GLuint shader = glCreateShader(GL_FRAGMENT_SHADER);
        glShaderSource(shader, 1, (const char**)&text, 0);
        glCompileShader(shader);
        glAttachShader(program = glCreateProgram(), shader);
        glLinkProgram(program);
    }
    glBindFramebuffer(GL_FRAMEBUFFER, scene);
    draw();
    glBindFramebuffer(GL_FRAMEBUFFER, turned);
    glBindTexture(GL_TEXTURE_2D, picture);
    glUseProgram(program);
    glDisable(GL_DEPTH_TEST);
    glMatrixMode(GL_PROJECTION), glLoadIdentity();
    glMatrixMode(GL_MODELVIEW), glLoadIdentity();
    glRectf(-1, -1, 1, 1);
    glUseProgram(0);
    read_all();
}
static int shows_something(void) {
    XImage* image = XGetImage(display, pixmap, 0, 0, size, size, AllPlanes, ZPixmap);
    int shown = 0;
    for (int i = 0; i < size; ++i) shown |= (XGetPixel(image, i, size / 2) & 0xffffff) != 0;
    XDestroyImage(image);
    return shown;
}
static void draw_and_get_image(void) {
    draw();
    glXWaitGL();
    if (!shows_something()) exit(16);
}
static void draw_and_leave(void) {
    draw();
    make_current(None);
    if (!shows_something()) exit(16);
    make_current(glx_pixmap);
}
/* Nothing, then the body: the first picture is empty. */
static void clear_and_read(void) {
    static int drawn;
    look_at_chiral(size);
    if (drawn++) draw_chiral();
    read_all();
}
/* Two pictures: the second is another body, twice as rich. */
static void two_pictures(void) {
    static int drawn;
    look_at_chiral(size);
    for (int i = drawn++ ? 0 : 2; i >= 0; --i) draw_chiral();
    if (drawn > 1) glTranslatef(5, 0, 0), draw_chiral();
    read_all();
}
static void look_in_between(void (*read)(void)) {
    look_at_chiral(size);
    draw_part(0, 2);
    read();
    draw_part(2, 3);
    glXSwapBuffers(display, window);
}
static void pick_and_swap(void) { look_in_between(read_one); }
static void read_and_swap(void) { look_in_between(read_all); }
/* Small pictures of a part beforehand, as of a list of files to choose from. */
static void preview_and_swap(void) {
    static int made;
    if (!made++) {
        make_framebuffer();
        for (int i = 0; i < 4; ++i) look_at_chiral(size), draw_part(i % 3, i % 3 + 1), read_all();
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
    }
    draw();
    glXSwapBuffers(display, window);
}
/* Draws the body in the first frames, and then nothing more; shows that until it is cast, for ten seconds at
 * most. */
static void draw_and_rest(void) {
    const char* out = getenv("GLCAST_OUT");
    draw();
    glXSwapBuffers(display, window);
    for (int i = 0; out && access(out, F_OK) != 0 && i < 100; ++i) {
        usleep(120000);
        glXSwapBuffers(display, window);
    }
}
static void draw_only(void) { draw(); }

static const struct Way {
    const char* name;
    void (*open)(void);
    void (*frame)(void);
} ways[] = {
    {"pbuffer", open_pbuffer, draw_and_read},
    {"pbuffer-rows", open_pbuffer, draw_and_read_rows},
    {"pbuffer-unread", open_pbuffer, draw_only},
    {"back-buffer", open_window, draw_and_read},
    {"framebuffer", framebuffer_and_window, draw_and_read},
    {"texture", framebuffer_and_window, draw_and_get_texture},
    {"surfaceless", framebuffer_and_nothing, draw_and_read},
    {"surfaceless-texture", framebuffer_and_nothing, draw_and_get_texture},
    {"surfaceless-turned", framebuffer_and_nothing, draw_turn_and_read},
    {"pixmap-wait", open_pixmap, draw_and_get_image},
    {"pixmap-leave", open_pixmap, draw_and_leave},
    {"empty-first", open_pbuffer, clear_and_read},
    {"two-pictures", open_pbuffer, two_pictures},
    {"rest", open_window, draw_and_rest},
    {"pick-swap", open_window, pick_and_swap},
    {"read-swap", open_window, read_and_swap},
    {"preview-swap", open_window, preview_and_swap},
};

int main(int argc, char** argv) {
    for (size_t i = 0; argc > 1 && i < sizeof ways / sizeof *ways; ++i) {
        if (strcmp(ways[i].name, argv[1]) != 0) continue;
        ways[i].open();
        for (int frame = argc > 2 ? atoi(argv[2]) : 3; frame > 0; --frame) ways[i].frame();
        const GLenum error = glGetError();
        unsigned long sum = 0;
        for (size_t p = 0; p < sizeof pixels; ++p) sum = sum * 31 + pixels[p];
        printf("error %x, pixels %lx\n", error, sum);
        return 0;
    }
    return 9;
}
