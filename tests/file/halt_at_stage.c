// Preloaded by test_interrupt: the thread that tells of the stage GLCAST_TEST_STAGE goes no further, so that a signal finds
// glcast there however busy the machine is.
#define _GNU_SOURCE
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

int fprintf(FILE* file, const char* format, ...) {
    char text[4096];
    va_list arguments;
    va_start(arguments, format);
    const int length = vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    fputs(text, file);
    fflush(file);
    const char* stage = getenv("GLCAST_TEST_STAGE");
    while (stage != NULL && strstr(text, stage) != NULL) {
        pause();
    }
    return length;
}
