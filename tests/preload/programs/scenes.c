/* Frames as toolkits, CAD programs and games make them, around the body of window.c. argv[1] names the kind. */
#define GL_GLEXT_PROTOTYPES
#include <math.h>
#include <pthread.h>
#include <semaphore.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "window.h"

static const char* kind;
static Window window, other_window;
static GLXContext context, other_context;
enum { size = 200, frames = 4 };
#define IS(name) (strcmp(kind, name) == 0)

static void camera(int perspective) {
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    perspective ? glFrustum(-1, 1, -1, 1, 2, 40) : glOrtho(-4, 4, -4, 4, 2, 40);
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    glTranslatef(-1, -1, -9);
    glEnable(GL_DEPTH_TEST);
}

static void lit(int on) {
    on ? glEnable(GL_LIGHTING) : glDisable(GL_LIGHTING);
    glEnable(GL_LIGHT0);
    glEnable(GL_COLOR_MATERIAL);
}

static void clear(void) { glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT); }

/* Over all of the viewport, by identity matrices. */
static void backdrop(void) {
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    glBegin(GL_TRIANGLE_STRIP);
    for (int i = 0; i <= 40; ++i) {
        glTexCoord2f(i / 40.0f, 0), glVertex3f(i / 20.0f - 1, -1, 0.9f);
        glTexCoord2f(i / 40.0f, 1), glVertex3f(i / 20.0f - 1, 1, 0.9f);
    }
    glEnd();
}

static void ball(float radius) {
    for (int j = 0; j < 20; ++j) {
        glBegin(GL_TRIANGLE_STRIP);
        for (int i = 0; i <= 40; ++i)
            for (int k = 0; k < 2; ++k) {
                const double a = i * M_PI / 20, b = (j + k) * M_PI / 20;
                glNormal3d(cos(a) * sin(b), sin(a) * sin(b), cos(b));
                glVertex3d(radius * cos(a) * sin(b), radius * sin(a) * sin(b), radius * cos(b));
            }
        glEnd();
    }
}

static void cad(void) {
    clear();
    glDisable(GL_DEPTH_TEST);
    lit(0);
    glViewport(0, 0, size, size);
    glColor3f(0.2f, 0.2f, 0.6f);
    backdrop();
    lit(1);
    for (int view = 0; view < 4; ++view) {
        glViewport(view % 2 * size / 2, view / 2 * size / 2, size / 2, size / 2);
        camera(view == 2);
        if (view == 1) glRotatef(90, 1, 0, 0);
        if (view == 3) glRotatef(90, 0, 1, 0);
        glColor3f(0, 1, 0);
        draw_chiral();
    }
    glViewport(0, 0, size / 16, size / 16); /* a navigation ball: more triangles than the model */
    glClear(GL_DEPTH_BUFFER_BIT);
    camera(1);
    glColor3f(1, 0, 0);
    ball(2);
}

static void quad_of_texture(GLuint texture) {
    glBindTexture(GL_TEXTURE_2D, texture);
    glEnable(GL_TEXTURE_2D);
    glEnable(GL_DEPTH_TEST);
    glColor3f(1, 1, 1);
    backdrop();
    glDisable(GL_TEXTURE_2D);
}

static GLuint make_texture(void) {
    GLuint texture;
    glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, size, size, 0, GL_RGBA, GL_UNSIGNED_BYTE, 0);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    return texture;
}

static void bind_framebuffer(GLuint texture) {
    GLuint framebuffer, depth;
    glGenFramebuffers(1, &framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glGenRenderbuffers(1, &depth);
    glBindRenderbuffer(GL_RENDERBUFFER, depth);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, size, size);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
}

static void draw_offscreen(void) {
    glViewport(0, 0, size, size);
    clear();
    camera(1);
    lit(1);
    glColor3f(0, 1, 0);
    draw_chiral();
    glFlush();
}

/* As Qt 5 does it: the widget's context draws to a texture, the window's shows it. Only the first two frames
 * redraw it, if `still`. */
static void composite(int still) {
    glXMakeCurrent(display, window, context);
    const GLuint texture = make_texture();
    glXMakeCurrent(display, other_window, other_context);
    bind_framebuffer(texture);
    for (int frame = 0; frame < frames; ++frame) {
        if (!still || frame < 2) {
            glXMakeCurrent(display, other_window, other_context);
            draw_offscreen();
        }
        glXMakeCurrent(display, window, context);
        glViewport(0, 0, size, size);
        clear();
        quad_of_texture(texture);
        glXSwapBuffers(display, window);
    }
}

/* What is shown is drawn offscreen, after something richer that only helps to draw it. */
static void helper(void) {
    glXMakeCurrent(display, window, context);
    const GLuint mask = make_texture(), texture = make_texture();
    bind_framebuffer(mask);
    GLint mask_framebuffer = 0, framebuffer = 0;
    glGetIntegerv(GL_FRAMEBUFFER_BINDING, &mask_framebuffer);
    bind_framebuffer(texture);
    glGetIntegerv(GL_FRAMEBUFFER_BINDING, &framebuffer);
    for (int frame = 0; frame < frames; ++frame) {
        glBindFramebuffer(GL_FRAMEBUFFER, mask_framebuffer);
        glViewport(0, 0, size, size);
        clear();
        camera(1);
        lit(0);
        glColor3f(1, 0, 0);
        glScalef(2, 2, 2);
        for (int i = 0; i < 5; ++i) draw_chiral();
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
        draw_offscreen();
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
        clear();
        quad_of_texture(texture);
        glXSwapBuffers(display, window);
    }
}

static GLuint shared_texture;
static sem_t drawn, shown;
static void* draw_in_thread(void* unused) {
    glXMakeCurrent(display, other_window, other_context);
    bind_framebuffer(shared_texture);
    for (int frame = 0; frame < frames; ++frame) {
        draw_offscreen();
        sem_post(&drawn);
        sem_wait(&shown);
    }
    glXMakeCurrent(display, None, 0);
    return unused;
}

static void composite_of_thread(void) {
    glXMakeCurrent(display, window, context);
    shared_texture = make_texture();
    glFinish();
    sem_init(&drawn, 0, 0);
    sem_init(&shown, 0, 0);
    pthread_t thread;
    pthread_create(&thread, 0, draw_in_thread, 0);
    for (int frame = 0; frame < frames; ++frame) {
        sem_wait(&drawn);
        clear();
        quad_of_texture(shared_texture);
        glXSwapBuffers(display, window);
        sem_post(&shown);
    }
    pthread_join(thread, 0);
}

/* Another context is made current in the middle of the frame. */
static void interrupted(void) {
    for (int i = 0; i < 3; ++i) {
        glXMakeCurrent(display, window, context);
        if (i == 0) clear();
        camera(1);
        lit(1);
        draw_box(chiral_boxes[i][0], chiral_boxes[i][1]);
        glXMakeCurrent(display, other_window, other_context);
        glClear(GL_COLOR_BUFFER_BIT);
    }
    glXMakeCurrent(display, window, context);
}

/* Drawn in false colours to be picked from, cleared, drawn as it looks. */
static void picking(void) {
    clear();
    camera(1);
    lit(0);
    glColor3f(1, 0, 1);
    draw_chiral();
    glFinish();
    clear();
    lit(1);
    glColor3f(0, 1, 0);
    draw_chiral();
}

/* As Open Inventor's ivview: an empty swap, then to the front buffer, which is flushed when the back is chosen again. */
static void front(void) {
    glClear(GL_COLOR_BUFFER_BIT);
    glXSwapBuffers(display, window);
    glDrawBuffer(GL_FRONT);
    clear();
    camera(1);
    lit(1);
    draw_chiral();
    glDrawBuffer(GL_BACK);
    glFlush();
}

/* The front buffer was drawn to before the last swap: a flush in the middle of this frame ends nothing. */
static void after_front(void) {
    glDrawBuffer(GL_FRONT);
    glClear(GL_COLOR_BUFFER_BIT);
    glDrawBuffer(GL_BACK);
    glXSwapBuffers(display, window);
    clear();
    camera(1);
    lit(1);
    for (int i = 0; i < 3; ++i) {
        draw_box(chiral_boxes[i][0], chiral_boxes[i][1]);
        glFlush();
    }
}

static void sky(void) {
    const float lo[3] = {-15, -15, -15}, hi[3] = {15, 15, 15};
    clear();
    camera(1);
    lit(0);
    glDepthMask(GL_FALSE);
    glColor3f(0.5f, 0.7f, 1);
    draw_box(lo, hi);
    glDepthMask(GL_TRUE);
    lit(1);
    glColor3f(0, 1, 0);
    draw_chiral();
    glDisable(GL_DEPTH_TEST); /* a label in front */
    const float corner[3] = {5, 5, 5}, end[3] = {6, 6, 6};
    draw_box(corner, end);
}

/* Two shells round the body, a faint one and one that is nearly opaque. */
static void glass(void) {
    const float faint[2][3] = {{-2, -2, -2}, {5, 4, 5}}, thick[2][3] = {{-1, -1, -1}, {4, 3, 4}};
    clear();
    camera(1);
    lit(0);
    glDisable(GL_BLEND);
    glColor3f(0, 1, 0);
    draw_chiral();
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    glColor4f(1, 1, 1, 0.8f);
    draw_box(thick[0], thick[1]);
    glColor4f(1, 1, 1, 0.3f);
    draw_box(faint[0], faint[1]);
}

/* A round mark on each face of a cube, pulled forward by a polygon offset that a display list of the first
 * frame set. */
static void decals(void) {
    const float lo[3] = {-1, -1, -1}, hi[3] = {1, 1, 1};
    static GLuint offset, marks;
    clear();
    camera(1);
    lit(0);
    glRotatef(40, 1, 2, 3);
    glColor3f(1, 1, 1);
    draw_box(lo, hi);
    if (!offset) {
        glNewList(offset = glGenLists(1), GL_COMPILE_AND_EXECUTE);
        glPolygonOffset(-1, -1);
        glEndList();
        glNewList(marks = glGenLists(1), GL_COMPILE);
        for (int face = 0; face < 6; ++face) {
            glPushAttrib(GL_ENABLE_BIT);
            glEnable(GL_POLYGON_OFFSET_FILL);
            glBegin(GL_TRIANGLE_FAN);
            for (int i = -1; i <= 64; ++i) {
                const double a = i * M_PI / 32, r = i < 0 ? 0 : 0.5;
                double p[3];
                p[face / 2] = face % 2 ? 1 : -1;
                p[(face / 2 + 1) % 3] = r * cos(a), p[(face / 2 + 2) % 3] = r * sin(a);
                glVertex3dv(p);
            }
            glEnd();
            glPopAttrib();
        }
        glEndList();
    }
    glColor3f(1, 0, 0);
    glCallList(marks);
}

static void wires(void) {
    clear();
    camera(1);
    lit(0);
    glColor3f(1, 1, 0);
    glBegin(GL_LINES);
    for (int axis = 0; axis < 3; ++axis)
        for (int edge = 0; edge < 4; ++edge)
            for (int end = 0; end < 2; ++end) {
                float v[3];
                v[axis] = end * 2.0f, v[(axis + 1) % 3] = edge % 2 * 2.0f, v[(axis + 2) % 3] = edge / 2 * 2.0f;
                glVertex3fv(v);
            }
    glEnd();
}

static void cloud(void) {
    clear();
    camera(1);
    lit(0);
    glColor3f(0, 1, 1);
    glBegin(GL_POINTS);
    for (int i = 0; i < 4000; ++i) {
        const double z = (2 * i + 1) / 4000.0 - 1, a = i * 2.399963, r = sqrt(1 - z * z);
        glVertex3d(1 + r * cos(a), 1 + r * sin(a), 1 + z);
    }
    glEnd();
}

static void textured_box(float x) {
    const float lo[3] = {x, 0, 0}, hi[3] = {x + 0.5f, 1, 1};
    draw_box(lo, hi);
}

static void fill_texture(GLubyte r, GLubyte g, GLubyte b) {
    const GLubyte texel[] = {r, g, b, 255};
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 1, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, texel);
}

/* Boxes at x = 0, 1 and 2 in red, green and blue: one texture filled twice, and another that is deleted once used.
 * The program counts on its names. */
static void refilled(void) {
    static GLuint first;
    GLuint last = 0;
    clear();
    lit(0);
    camera(1);
    glColor3f(1, 1, 1);
    glEnable(GL_TEXTURE_2D);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    if (!first) glGenTextures(1, &first);
    glBindTexture(GL_TEXTURE_2D, first);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    fill_texture(255, 0, 0);
    textured_box(0);
    fill_texture(0, 255, 0);
    textured_box(1);
    glGenTextures(1, &last);
    glBindTexture(GL_TEXTURE_2D, last);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    fill_texture(0, 0, 255);
    textured_box(2);
    glDeleteTextures(1, &last);
    GLubyte pixels[4 * size] = {0};
    glReadPixels(0, size / 2, size, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
    unsigned sum = 0;
    for (int i = 0; i < 4 * size; ++i) sum = sum * 31 + pixels[i];
    printf("%x %x %d\n", sum, glGetError(), glIsTexture(last));
}

/* Waits for a key as a program with a window does, drawing all the while; a few frames later it ends. */
static void keys(void) {
    int left = 2000, pressed = 0;
    XSync(display, False);
    XSetInputFocus(display, window, RevertToParent, CurrentTime);
    while (left-- > 0) {
        while (XPending(display)) {
            XEvent event;
            XNextEvent(display, &event);
            if (event.type == KeyPress && !pressed) pressed = 1, left = 5;
        }
        sky();
        glXSwapBuffers(display, window);
        usleep(10000);
    }
    printf("pressed %d\n", pressed);
}

static volatile int handled;
static void handle(int number) { handled += number == SIGUSR1; }

int main(int argc, char** argv) {
    kind = argc > 1 ? argv[1] : "cad";
    XInitThreads();
    window = make_window(size, size);
    other_window = make_window(size, size);
    context = make_context(0);
    other_context = make_context(context);
    if (IS("composite") || IS("composite_still")) return composite(IS("composite_still")), 0;
    if (IS("helper")) return helper(), 0;
    if (IS("composite_of_thread")) return composite_of_thread(), 0;
    glXMakeCurrent(display, window, context);
    if (IS("keys")) return keys(), 0;
    if (IS("front")) return front(), 0;
    if (IS("signals")) signal(SIGUSR1, handle);
    for (int frame = 1; frame <= frames; ++frame) {
        if (IS("cad")) cad();
        if (IS("interrupted")) interrupted();
        if (IS("picking")) picking();
        if (IS("after_front")) after_front();
        if (IS("sky") || IS("signals")) sky();
        if (IS("glass")) glass();
        if (IS("decals")) decals();
        if (IS("wires")) wires();
        if (IS("cloud")) cloud();
        if (IS("refilled")) refilled();
        if (IS("signals") && frame == 2) raise(SIGUSR1);
        glXSwapBuffers(display, window);
    }
    if (IS("signals")) printf("handled %d\n", handled);
    return 0;
}
