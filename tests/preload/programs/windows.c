/* Programs with several windows, each with a context of its own. argv[1] names the kind:
 * two         a box of 2 in "Tool box", then the body of 3 in "Model", in turn
 * late        the same, but the model's first frame is empty
 * threads     the same, each in a thread of its own, over a connection of its own
 * quad        a CAD program: the body in "Top", "Front" and "Side", orthographic, and in "Perspective"
 * grabs       as two, and holds the X server for itself while it swaps
 * grabs_alone the same with the model's window alone
 * idle        the box in "Tool box"; "Model" is on the screen and is never drawn to
 * nested      the body in a window without a title, in one that is called "Main window" */
#include <pthread.h>
#include <string.h>
#include <unistd.h>

#include "window.h"

static const struct timespec pause_between = {0, 10000000};
static int grabs;

static void set_camera(int perspective) {
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_LIGHTING);
    glEnable(GL_LIGHT0);
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    if (perspective)
        glFrustum(-1, 1, -1, 1, 2, 40);
    else
        glOrtho(-4, 4, -4, 4, 2, 40);
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    glTranslatef(-1, -1, -12);
}

typedef struct {
    Display* display;
    Window window;
    GLXContext context;
} View;

static View make_view(const char* title, GLXContext share) {
    View view = {0};
    view.window = make_window(120, 120);
    view.display = display;
    if (title) XStoreName(display, view.window, title);
    view.context = make_context(share);
    glXMakeCurrent(display, view.window, view.context);
    return view;
}

static void draw(const View* view, int what, int perspective) {
    static const float lo[3] = {0, 0, 0}, hi[3] = {2, 2, 2};
    glXMakeCurrent(view->display, view->window, view->context);
    set_camera(perspective);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    if (what == 1) draw_box(lo, hi);
    if (what == 2) draw_chiral();
    if (grabs) {
        XGrabServer(view->display);
        XSync(view->display, False);
    }
    glXSwapBuffers(view->display, view->window);
    if (grabs) {
        XUngrabServer(view->display);
        XSync(view->display, False);
        nanosleep(&pause_between, 0);
    }
}

static void* draw_on(void* given) {
    View* view = given;
    for (int frame = 0; frame < 60; ++frame) {
        draw(view, view->display == display ? 1 : 2, 1);
        nanosleep(&pause_between, 0);
    }
    glXMakeCurrent(view->display, None, 0);
    return 0;
}

static int threads(void) {
    XInitThreads();
    View first = make_view("Tool box", 0);
    glXMakeCurrent(display, None, 0);
    Display* const kept = display;
    display = 0, visual = 0;
    View second = make_view("Model", 0);
    glXMakeCurrent(display, None, 0);
    display = kept;
    pthread_t one, two;
    if (pthread_create(&one, 0, draw_on, &first) || pthread_create(&two, 0, draw_on, &second)) return 13;
    pthread_join(one, 0);
    pthread_join(two, 0);
    return 0;
}

static int quad(void) {
    static const char* const titles[] = {"Top", "Front", "Side", "Perspective"};
    View views[4];
    for (int i = 0; i < 4; ++i) views[i] = make_view(titles[i], i ? views[0].context : 0);
    for (int frame = 0; frame < 4; ++frame)
        for (int i = 0; i < 4; ++i) draw(&views[i], 2, i == 3);
    return 0;
}

static int nested(void) {
    const Window outer = make_window(160, 160);
    XStoreName(display, outer, "Main window");
    View view = make_view(0, 0);
    XReparentWindow(display, view.window, outer, 10, 10);
    XSync(display, False);
    for (int frame = 0; frame < 3; ++frame) draw(&view, 2, 1);
    return 0;
}

int main(int argc, char** argv) {
    const char* kind = argc > 1 ? argv[1] : "two";
    if (strcmp(kind, "threads") == 0) return threads();
    if (strcmp(kind, "quad") == 0) return quad();
    if (strcmp(kind, "nested") == 0) return nested();
    const int late = strcmp(kind, "late") == 0, idle = strcmp(kind, "idle") == 0;
    grabs = strncmp(kind, "grabs", 5) == 0;
    if (strcmp(kind, "grabs_alone") == 0) {
        const View only = make_view("Model", 0);
        for (int frame = 0; frame < 4; ++frame) draw(&only, 2, 1);
        return 0;
    }
    const View small = make_view("Tool box", 0), large = make_view("Model", 0);
    for (int frame = 0; frame < (idle ? 1 : 4); ++frame) {
        draw(&small, 1, 1);
        if (!idle) draw(&large, late && frame == 0 ? 0 : 2, 1);
    }
    if (idle) sleep(20);
    return 0;
}
