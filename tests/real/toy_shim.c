/* Stands where libglcast.so would, and tells glcast-run what TOY_LINES says: one status line after each
 * semicolon. A line that begins with "captured" also makes the capture. Only the process called TOY_PROCESS
 * (or all) speaks. */
#define _GNU_SOURCE
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static void append(const char* path, const char* line, int flags) {
    char text[512];
    const int length = snprintf(text, sizeof text, "%s\n", line);
    const int file = open(path, O_WRONLY | O_APPEND | O_NONBLOCK | flags, 0600);
    if (file >= 0) {
        if (write(file, text, (size_t)length) < 0) {
            perror("toy_shim");
        }
        close(file);
    }
}

__attribute__((constructor)) static void speak(void) {
    const char* lines = getenv("TOY_LINES");
    const char* process = getenv("TOY_PROCESS");
    const char* status = getenv("GLCAST_STATUS");
    if (lines == NULL || status == NULL ||
        (process != NULL && strcmp(process, program_invocation_short_name) != 0)) {
        return;
    }
    char* copy = strdup(lines);
    for (char* line = strtok(copy, ";"); line != NULL; line = strtok(NULL, ";")) {
        if (strncmp(line, "captured", 8) == 0) {
            append(getenv("GLCAST_OUT"), "capture", O_CREAT);
        }
        append(status, line, 0);
    }
    free(copy);
}
