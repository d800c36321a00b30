/* sleep, as a 32-bit program. */
#include <stdlib.h>
#include <unistd.h>

int main(int count, char** arguments) {
    sleep(count > 1 ? (unsigned)atoi(arguments[1]) : 1);
    return 0;
}
