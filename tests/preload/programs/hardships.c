// Cubes, and on the way to them what programs do to a recorder. Usage: hardships WHAT
//   exit      leaves by _exit in its third frame
//   deep      16,384 pushes, attributes and lists deep, vertices outside of glBegin
//   tiny      a million draws in its second frame
//   starved   little address space is left before its second frame, which is long
//   narrow    the same, but its frame is short: there is no room for the capture
//   threads   three threads, each with a connection, a window and a context of its own
//   forks     the same, and a fourth forks all the while
#include <GL/gl.h>
#include <GL/glx.h>
#include <X11/Xlib.h>
#include <pthread.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "cube.h"

enum { depth = 16384, draws = 1000000 };

static void leave(int frame) {
    if (frame == 3) _exit(7);
}

static void go_deep(int frame) {
    if (frame != 2) return;
    for (int i = 0; i < depth; ++i) glPushMatrix(), glPushAttrib(GL_ALL_ATTRIB_BITS);
    for (int i = 0; i < depth; ++i) glVertex3f(0, 0, (float)i), glEnd();
    for (GLuint i = 1; i <= depth; ++i) {
        glNewList(i, GL_COMPILE);
        glColor3f(1, 0.5f, 0);
        glCallList(i + 1);
        glEndList();
    }
    glCallList(1);
    for (int i = 0; i < depth; ++i) glPopAttrib(), glPopMatrix();
    while (glGetError() != GL_NO_ERROR) {
    }
}

static void draw_tiny(int frame) {
    if (frame != 2) return;
    static const float corners[] = {0, 0, 0, 0.001f, 0, 0, 0, 0.001f, 0};
    glVertexPointer(3, GL_FLOAT, 0, corners);
    glEnableClientState(GL_VERTEX_ARRAY);
    for (int i = 0; i < draws; ++i) glDrawArrays(GL_TRIANGLES, 0, 3);
    glDisableClientState(GL_VERTEX_ARRAY);
}

static void leave_room(rlim_t room) {
    long pages = 0;
    FILE* file = fopen("/proc/self/statm", "r");
    if (!file || fscanf(file, "%ld", &pages) != 1) _exit(20);
    fclose(file);
    const rlim_t most = (rlim_t)pages * (rlim_t)sysconf(_SC_PAGESIZE) + room;
    const struct rlimit limit = {most, most};
    if (setrlimit(RLIMIT_AS, &limit) != 0) _exit(21);
}

static void starve(int frame) {
    if (frame != 2) return;
    leave_room(48u << 20);
    for (int i = 0; i < 8 * draws; ++i) glColor3f(1, 1, 1);
}

static void narrow(int frame) {
    if (frame == 2) leave_room(300u << 20);
}

static void* draw_in_thread(void* result) {
    *(int*)result = draw_cubes(25, 0);
    return 0;
}

static volatile int forking = 1;
static void* fork_all_the_while(void* failed) {
    while (forking) {
        const pid_t child = fork();
        int status = 0;
        if (child == 0) _exit(0); // Mesa's own exit handlers wait for threads that a child has not
        if (child < 0 || waitpid(child, &status, 0) != child || status != 0) *(int*)failed = 31;
        usleep(5000);
    }
    return 0;
}

static int draw_in_threads(int with_forks) {
    enum { count = 3 };
    pthread_t threads[count];
    int results[count] = {0}, sum = 0, fork_failed = 0;
    pthread_t forker;
    XInitThreads();
    if (with_forks && pthread_create(&forker, 0, fork_all_the_while, &fork_failed) != 0) return 30;
    for (int i = 0; i < count; ++i)
        if (pthread_create(&threads[i], 0, draw_in_thread, &results[i]) != 0) return 30;
    for (int i = 0; i < count; ++i) pthread_join(threads[i], 0), sum += results[i];
    forking = 0;
    if (with_forks) pthread_join(forker, 0);
    return sum ? sum : fork_failed;
}

int main(int argc, char** argv) {
    const char* what = argc > 1 ? argv[1] : "";
    if (strcmp(what, "exit") == 0) return draw_cubes(4, leave);
    if (strcmp(what, "deep") == 0) return draw_cubes(3, go_deep);
    if (strcmp(what, "tiny") == 0) return draw_cubes(3, draw_tiny);
    if (strcmp(what, "starved") == 0) return draw_cubes(3, starve);
    if (strcmp(what, "narrow") == 0) return draw_cubes(3, narrow);
    if (strcmp(what, "threads") == 0) return draw_in_threads(0);
    if (strcmp(what, "forks") == 0) return draw_in_threads(1);
    return 2;
}
