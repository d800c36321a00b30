// Forks between two frames; the child ends as programs do, through exit(). forks become: becomes this program
// again after its first frame.
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include "cube.h"

static void fork_once(int frame) {
    if (frame != 2) return;
    const pid_t child = fork();
    if (child == 0) exit(0);
    int status = 0;
    waitpid(child, &status, 0);
}

static void become(int frame) {
    if (frame == 2) execl("/proc/self/exe", "forks", (char*)0), _exit(9);
}

int main(int argc, char** argv) {
    (void)argv;
    return draw_cubes(3, argc > 1 ? become : fork_once);
}
