/* A program without a loader. With an argument it waits to be ended. */
#include <unistd.h>

int main(int count, char** arguments) {
    (void)arguments;
    return count > 1 ? pause() : 0;
}
