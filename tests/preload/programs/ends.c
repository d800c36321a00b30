// Cubes in frames that end as asked: ends "HOW" (cube.h).
#include "cube.h"

int main(int argc, char** argv) {
    if (argc > 1) frame_end = argv[1];
    return draw_cubes(3, 0);
}
