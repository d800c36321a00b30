/* Draws six frames in a state of the thread that is rare and the program's right. Usage: hosts CASE [KIB]
   Prints what it finds changed at the end, and ends with 0 where that is nothing. */
#define _GNU_SOURCE
#include <errno.h>
#include <fenv.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/time.h>
#ifdef __x86_64__
#include <xmmintrin.h>
#endif

#include "window.h"

enum { frames = 6 };
static Window window;
static GLXContext context;

static void draw_frame(void) {
    look_at_chiral(120);
    draw_chiral();
    glXSwapBuffers(display, window);
}
static void draw_frames(void) {
    for (int i = 0; i < frames; ++i) draw_frame();
}
static int on_thread(void* (*work)(void*), char* stack, size_t size) {
    pthread_attr_t attributes;
    pthread_t thread;
    pthread_attr_init(&attributes);
    if (stack ? pthread_attr_setstack(&attributes, stack, size)
              : pthread_attr_setstacksize(&attributes, size))
        return 70;
    glXMakeCurrent(display, None, NULL);
    if (pthread_create(&thread, &attributes, work, NULL)) return 71;
    pthread_join(thread, NULL);
    return 0;
}
static void* draw_on_thread(void* unused) {
    glXMakeCurrent(display, window, context);
    draw_frames();
    glXMakeCurrent(display, None, NULL);
    return unused;
}

/* A stack that is painted before, with a page behind it that nothing may touch. */
static int stack(int kib) {
    const size_t size = (size_t)kib << 10, page = 4096;
    char* low = mmap(NULL, size + page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (low == MAP_FAILED || mprotect(low, page, PROT_NONE)) return 72;
    low += page;
    memset(low, 0x5a, size);
    const int failed = on_thread(draw_on_thread, low, size);
    size_t untouched = 0;
    while (untouched < size && low[untouched] == 0x5a) ++untouched;
    fprintf(stderr, "used %zu\n", size - untouched);
    return failed;
}

/* What of the floating-point environment can be seen from outside. */
static void print_arithmetic(const char* when) {
    unsigned short control = 0;
    unsigned vector = 0;
#ifdef __x86_64__
    __asm__ volatile("fnstcw %0" : "=m"(control));
    vector = _mm_getcsr();
#endif
    printf("%s: round %d, flags %x, traps %x, x87 %x, mxcsr %x, errno %d\n", when, fegetround(),
           fetestexcept(FE_ALL_EXCEPT), fegetexcept(), control, vector, errno);
}
/* The driver may raise flags of its own in its first frames; what matters is what a swap leaves. */
static int with_arithmetic(void (*set)(void)) {
    for (int i = 0; i < frames; ++i) {
        look_at_chiral(120);
        draw_chiral();
        glFinish();
        feclearexcept(FE_ALL_EXCEPT);
        set();
        errno = 42;
        glXSwapBuffers(display, window);
        if (i == 0) print_arithmetic("first");
        fesetenv(FE_DFL_ENV);
    }
    return 0;
}
static void trap_some(void) { feenableexcept(FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW); }
static void round_up(void) { fesetround(FE_UPWARD); }
static void round_to_zero(void) { fesetround(FE_TOWARDZERO); }
static void flush_to_zero(void) {
#ifdef __x86_64__
    _mm_setcsr(_mm_getcsr() | 0x8040);
#endif
}
static void single_x87(void) {
#ifdef __x86_64__
    const unsigned short control = 0x007f;
    __asm__ volatile("fldcw %0" : : "m"(control));
#endif
}
static void raise_flags(void) { feraiseexcept(FE_UNDERFLOW | FE_INEXACT); }
/* As numerical programs do: once, and for all that they draw. */
static int always_trap(int unused) {
    feenableexcept(FE_DIVBYZERO | FE_INVALID);
    draw_frames();
    printf("traps %x\n", fegetexcept());
    return unused * 0;
}
static int trap(int unused) { return (void)unused, with_arithmetic(trap_some); }
static int up(int unused) { return (void)unused, with_arithmetic(round_up); }
static int to_zero(int unused) { return (void)unused, with_arithmetic(round_to_zero); }
static int flushing(int unused) { return (void)unused, with_arithmetic(flush_to_zero); }
static int single(int unused) { return (void)unused, with_arithmetic(single_x87); }
static int flags(int unused) { return (void)unused, with_arithmetic(raise_flags); }

/* Its signal handler looks at the stack that it is on, as a garbage collector does. */
static char *low, *high;
static volatile sig_atomic_t strange, seen;
static void look(int number) {
    (void)number;
    char here;
    ++seen;
    if (&here < low || &here > high) ++strange;
}
static void find_stack(void) {
    pthread_attr_t attributes;
    void* start = NULL;
    size_t size = 0;
    pthread_getattr_np(pthread_self(), &attributes);
    pthread_attr_getstack(&attributes, &start, &size);
    low = start, high = low + size;
}
static void* draw_under_timer(void* unused) {
    find_stack();
    glXMakeCurrent(display, window, context);
    struct sigaction action = {.sa_handler = look, .sa_flags = SA_RESTART};
    sigset_t timer;
    sigemptyset(&timer), sigaddset(&timer, SIGALRM);
    sigaction(SIGALRM, &action, NULL);
    pthread_sigmask(SIG_UNBLOCK, &timer, NULL); // the other threads have it blocked
    const struct itimerval often = {{0, 500}, {0, 500}}, never = {{0, 0}, {0, 0}};
    setitimer(ITIMER_REAL, &often, NULL);
    draw_frames();
    setitimer(ITIMER_REAL, &never, NULL);
    pthread_sigmask(SIG_BLOCK, NULL, &timer);
    printf("%s, %d strange, blocked now %d\n", seen ? "interrupted" : "not interrupted", strange,
           sigismember(&timer, SIGALRM));
    return unused;
}
static int interrupted(int unused) {
    (void)unused;
    sigset_t timer;
    sigemptyset(&timer), sigaddset(&timer, SIGALRM);
    pthread_sigmask(SIG_BLOCK, &timer, NULL);
    const int failed = on_thread(draw_under_timer, NULL, 1 << 20);
    return failed ? failed : strange;
}

static const struct {
    const char* name;
    int (*run)(int kib);
} cases[] = {{"stack", stack},
             {"always_trap", always_trap},
             {"trap", trap},
             {"up", up},
             {"to_zero", to_zero},
             {"flushing", flushing},
             {"single", single},
             {"flags", flags},
             {"interrupted", interrupted}};

int main(int argc, char** argv) {
    XInitThreads();
    window = make_window(120, 120);
    context = make_context(0);
    glXMakeCurrent(display, window, context);
    for (int i = 0; argc > 1 && i < (int)(sizeof cases / sizeof cases[0]); ++i)
        if (strcmp(argv[1], cases[i].name) == 0) return cases[i].run(argc > 2 ? atoi(argv[2]) : 0);
    return 2;
}
