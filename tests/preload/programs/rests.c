/* Programs that draw, and then rest for ever, or until they have been cast: rests WAY [then]. The body is
 * that of chiral.h. then: signals TIMES (and for each a new cast is waited for), exit, close, draw What comes
 * of it is printed. */
#define GL_GLEXT_PROTOTYPES
#include <EGL/egl.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "window.h"

enum { size = 200 };
static Window window;

static void wait_for(int type) {
    XEvent event;
    do XNextEvent(display, &event);
    while (event.type != type);
}

static double seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void make(void) {
    window = make_window(size, size);
    glXMakeCurrent(display, window, make_context(0));
}

static void body(void) {
    look_at_chiral(size);
    glColor3f(1, 0.5f, 0);
    draw_chiral();
}

static void body_and_swap(void) {
    body();
    glXSwapBuffers(display, window);
}

/* On the picture that is there. */
static void marks(void) {
    glDisable(GL_DEPTH_TEST);
    glMatrixMode(GL_PROJECTION), glLoadIdentity();
    glMatrixMode(GL_MODELVIEW), glLoadIdentity();
    glColor3f(1, 1, 1);
    glBegin(GL_LINES);
    for (int i = 0; i < 200; ++i) glVertex2f(-0.9f, -0.9f), glVertex2f(0.9f, 0.9f);
    glEnd();
}

static void swap_once(void) { make(), body_and_swap(); }

static void expose(void) {
    window = make_window(size, size);
    wait_for(Expose);
    glXMakeCurrent(display, window, make_context(0));
    body_and_swap();
}

static void front(void) {
    make();
    glDrawBuffer(GL_FRONT);
    body();
    glFlush();
}

/* Rubber bands in the front buffer, over the scene. */
static void front_marks(void) {
    make(), body_and_swap();
    glDrawBuffer(GL_FRONT);
    for (int i = 0; i < 12; ++i) marks(), glFlush();
    glDrawBuffer(GL_BACK);
}

/* The scene is kept as a picture, and shown again under marks. */
static void picture_marks(void) {
    GLuint picture;
    make(), body();
    glGenTextures(1, &picture);
    glBindTexture(GL_TEXTURE_2D, picture);
    glCopyTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 0, 0, size, size, 0);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glXSwapBuffers(display, window);
    for (int i = 0; i < 3; ++i) {
        glClear(GL_COLOR_BUFFER_BIT);
        glDisable(GL_DEPTH_TEST);
        glMatrixMode(GL_PROJECTION), glLoadIdentity();
        glMatrixMode(GL_MODELVIEW), glLoadIdentity();
        glEnable(GL_TEXTURE_2D);
        glColor3f(1, 1, 1);
        glBegin(GL_QUADS);
        glTexCoord2f(0, 0), glVertex2f(-1, -1), glTexCoord2f(1, 0), glVertex2f(1, -1);
        glTexCoord2f(1, 1), glVertex2f(1, 1), glTexCoord2f(0, 1), glVertex2f(-1, 1);
        glEnd();
        glDisable(GL_TEXTURE_2D);
        marks();
        glXSwapBuffers(display, window);
    }
}

/* As toolkits do: the scene in a framebuffer object, put on the window by a shader; then that alone again. */
static void composite_times(int times) {
    static const char text[] = "uniform sampler2D picture;"
                               "void main() { gl_FragColor = texture2D(picture, gl_FragCoord.xy / 200.); }";
    const char* source = text;
    GLuint framebuffer, picture, depth;
    make();
    glGenFramebuffers(1, &framebuffer), glGenTextures(1, &picture), glGenRenderbuffers(1, &depth);
    glBindTexture(GL_TEXTURE_2D, picture);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, size, size, 0, GL_RGBA, GL_UNSIGNED_BYTE, 0);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glBindRenderbuffer(GL_RENDERBUFFER, depth);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT16, size, size);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, picture, 0);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth);
    const GLuint shader = glCreateShader(GL_FRAGMENT_SHADER), program = glCreateProgram();
    glShaderSource(shader, 1, &source, 0), glCompileShader(shader);
    glAttachShader(program, shader), glLinkProgram(program);
    glBindTexture(GL_TEXTURE_2D, 0);
    body();
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glBindTexture(GL_TEXTURE_2D, picture);
    double last = 0;
    for (int i = 0, told = 0; i < times; ++i) {
        /* On a slow machine every frame is recorded, and nothing is missing. */
        if (i > 40 && !told && seconds() - last < 0.05)
            told = 1, fprintf(stderr, "too fast to be recorded\n");
        last = seconds();
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        glUseProgram(program);
        glMatrixMode(GL_PROJECTION), glLoadIdentity();
        glMatrixMode(GL_MODELVIEW), glLoadIdentity();
        glBegin(GL_QUADS);
        glVertex2f(-1, -1), glVertex2f(1, -1), glVertex2f(1, 1), glVertex2f(-1, 1);
        glEnd();
        glUseProgram(0);
        glXSwapBuffers(display, window);
    }
}

static void composite(void) { composite_times(4); }
static void composites(void) { composite_times(1000000); }

/* Nothing of the body is seen any more. */
static void cleared(void) {
    make(), body_and_swap();
    glClear(GL_COLOR_BUFFER_BIT);
    glXSwapBuffers(display, window);
}

/* More frames at once than are kept, and the last of them is another one. */
static void burst(void) {
    make();
    for (int i = 0; i < 100; ++i) body_and_swap();
    glXSwapBuffers(display, window);
}

static void egl(void) {
    window = make_window(size, size);
    EGLDisplay with = eglGetDisplay((EGLNativeDisplayType)display);
    const EGLint wanted[] = {EGL_SURFACE_TYPE,     EGL_WINDOW_BIT,   EGL_RENDERABLE_TYPE,
                             EGL_OPENGL_BIT,       EGL_DEPTH_SIZE,   16,
                             EGL_NATIVE_VISUAL_ID, visual->visualid, EGL_NONE};
    EGLConfig configs[64];
    EGLint count = 0, at = 0, id = 0;
    if (!eglInitialize(with, 0, 0) || !eglBindAPI(EGL_OPENGL_API)) exit(13);
    if (!eglChooseConfig(with, wanted, configs, 64, &count) || count == 0) exit(14);
    while (at < count - 1 && eglGetConfigAttrib(with, configs[at], EGL_NATIVE_VISUAL_ID, &id) &&
           (VisualID)id != visual->visualid)
        ++at;
    EGLSurface surface = eglCreateWindowSurface(with, configs[at], (EGLNativeWindowType)window, 0);
    if (!eglMakeCurrent(with, surface, surface, eglCreateContext(with, configs[at], EGL_NO_CONTEXT, 0)))
        exit(15);
    body();
    eglSwapBuffers(with, surface);
}

/* Only when it comes back to the screen. */
static void mapped(void) {
    window = make_window(size, size);
    wait_for(MapNotify);
    glXMakeCurrent(display, window, make_context(0));
    glXSwapBuffers(display, window);
    wait_for(MapNotify);
    body_and_swap();
}

static const struct Way {
    const char* name;
    void (*draw)(void);
} ways[] = {{"swap", swap_once},
            {"expose", expose},
            {"front", front},
            {"front-marks", front_marks},
            {"picture-marks", picture_marks},
            {"composite", composite},
            {"composites", composites},
            {"cleared", cleared},
            {"burst", burst},
            {"egl", egl},
            {"mapped", mapped}};

static ino_t cast_so_far(void) {
    struct stat status;
    const char* out = getenv("GLCAST_OUT");
    return out && stat(out, &status) == 0 ? status.st_ino : 0;
}
static void pause_a_moment(void) {
    const struct timespec moment = {0, 10000000};
    nanosleep(&moment, 0);
}

static void* send_signals(void* times) {
    int done = 0;
    for (; done < *(int*)times; ++done) {
        const ino_t before = cast_so_far();
        kill(getpid(), SIGUSR1);
        for (int i = 0; i < 2000 && cast_so_far() == before; ++i) pause_a_moment();
        if (cast_so_far() == before) break;
    }
    printf("cast %d times\n", done);
    fflush(stdout);
    _exit(0);
}

static int has_told(const char* what) {
    char text[4096] = "";
    FILE* told = fopen(getenv("GLCAST_STATUS") ? getenv("GLCAST_STATUS") : "/dev/null", "r");
    const size_t length = told ? fread(text, 1, sizeof text - 1, told) : 0;
    if (told) fclose(told);
    text[length] = 0;
    return strstr(text, what) != 0;
}
static void in_a_cast(void) {
    kill(getpid(), SIGUSR1);
    for (int i = 0; i < 2000 && !has_told("casting@"); ++i) pause_a_moment();
}

int main(int argc, char** argv) {
    const char* then = argc > 2 ? argv[2] : "";
    pthread_t thread;
    int times = argc > 3 ? atoi(argv[3]) : 1;
    const struct Way* way = ways;
    while (argc > 1 && way < ways + sizeof ways / sizeof *ways && strcmp(way->name, argv[1]) != 0) ++way;
    if (argc < 2 || way == ways + sizeof ways / sizeof *ways) return 9;
    if (*then) {
        signal(SIGUSR1, SIG_IGN); /* without us it is nothing */
    }
    way->draw();
    if (strcmp(then, "signals") == 0) pthread_create(&thread, 0, send_signals, &times);
    if (strcmp(then, "told") == 0) { /* why it cannot be cast now */
        for (int i = 0; i < 4000 && !has_told("its last frames"); ++i) pause_a_moment();
        return 0;
    }
    if (strcmp(then, "exit") == 0) {
        in_a_cast();
        return 0;
    }
    if (strcmp(then, "close") == 0) {
        in_a_cast();
        XCloseDisplay(display);
        return 0;
    }
    if (strcmp(then, "draw") == 0) {
        in_a_cast();
        for (int i = 0; i < 20; ++i) {
            GLuint texture;
            glGenTextures(1, &texture), glBindTexture(GL_TEXTURE_2D, texture);
            glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, size, size, 0, GL_RGBA, GL_UNSIGNED_BYTE, 0);
            body_and_swap();
            glDeleteTextures(1, &texture);
            printf("error %x\n", glGetError());
        }
        return 0;
    }
    wait_for(DestroyNotify);
    return 0;
}
