// Forks between two frames; the child ends as programs do, through exit().
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

int main(void) { return draw_cubes(3, fork_once); }
