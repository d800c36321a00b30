/* One thread swaps, while another draws with contexts that live for a moment, to a window that is never
 * swapped. */
#include <pthread.h>
#include <time.h>

#include "window.h"

static const struct timespec moment = {0, 1000000};
static Window hidden;
static GLXContext lasting;
static volatile int drawing = 1;

static void draw(Window window, GLXContext context) {
    glXMakeCurrent(display, window, context);
    look_at_chiral(100);
    draw_chiral();
}

static void* draw_and_destroy(void* none) {
    while (drawing) {
        const GLXContext context = make_context(lasting);
        draw(hidden, context);
        glXMakeCurrent(display, None, 0);
        nanosleep(&moment, 0);
        glXDestroyContext(display, context);
    }
    return none;
}

int main(void) {
    XInitThreads();
    const Window shown = make_window(100, 100);
    hidden = make_window(100, 100);
    lasting = make_context(0);
    pthread_t other;
    if (pthread_create(&other, 0, draw_and_destroy, 0)) return 13;
    for (int frame = 0; frame < 100; ++frame) {
        draw(shown, lasting);
        glXSwapBuffers(display, shown);
    }
    drawing = 0;
    pthread_join(other, 0);
    return 0;
}
