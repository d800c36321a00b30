/* Stands where libglcast.so would, and tells glcast-run what TOY_LINES says: one status line after each
 * semicolon. A line that begins with "captured" also makes the capture. "cast N" does as the shim does: it copies
 * TOY_CAPTURE to where GLCAST_OUT says, and tells its name. Only the process called TOY_PROCESS (or all) speaks. */
#define _GNU_SOURCE
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/sendfile.h>
#include <unistd.h>

static void append(const char* path, const char* line, int flags) {
    char text[4096];
    const int length = snprintf(text, sizeof text, "%s\n", line);
    const int file = open(path, O_WRONLY | O_APPEND | O_NONBLOCK | flags, 0600);
    if (file >= 0) {
        if (write(file, text, (size_t)length) < 0) {
            perror("toy_shim");
        }
        close(file);
    }
}

/* As capture/output_name.h has it. */
static void expand(const char* pattern, long frame, char* name) {
    for (; *pattern; ++pattern) {
        if (pattern[0] == '%' && (pattern[1] == 'f' || pattern[1] == 'p')) {
            name += sprintf(name, "%ld", *++pattern == 'f' ? frame : (long)getpid());
        } else {
            *name++ = *pattern;
        }
    }
    *name = 0;
}

static void cast(const char* status, long frame) {
    char name[2048], line[2100];
    expand(getenv("GLCAST_OUT"), frame, name);
    const int from = open(getenv("TOY_CAPTURE"), O_RDONLY), to = open(name, O_WRONLY | O_CREAT | O_TRUNC, 0600);
    while (sendfile(to, from, NULL, 1 << 20) > 0) {
    }
    close(from);
    close(to);
    sprintf(line, "captured %ld %s", frame, name);
    append(status, line, 0);
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
        if (strncmp(line, "cast ", 5) == 0) {
            cast(status, strtol(line + 5, NULL, 10));
            continue;
        }
        if (strncmp(line, "captured", 8) == 0) {
            append(getenv("GLCAST_OUT"), "capture", O_CREAT);
        }
        append(status, line, 0);
    }
    free(copy);
}
