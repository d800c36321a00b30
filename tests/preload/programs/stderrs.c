/* Draws six frames while its descriptor 2 is something that no message of others may touch. Usage: stderrs
   CASE Prints what it found at the end, and ends with 0 where that is what it had made itself. Descriptor 20
   is the other end of 2, where there is one. The cases are the table at the end: what descriptor 2 is when
   the program begins (set up before an exec of itself), and what the program does once it runs. */
#define _GNU_SOURCE
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include "window.h"

enum { frames = 6, peer = 20 };
static const char data[] = "DATA";
static char all[1 << 20];

static void must(int done, const char* what) {
    if (done) return;
    printf("%s: %s\n", what, strerror(errno));
    fflush(stdout);
    _exit(70);
}

/* Before the exec. */
static void put(int two, int other) {
    must(dup2(two, 2) == 2, "dup2");
    close(two);
    if (other < 0) return;
    must(dup2(other, peer) == peer, "dup2");
    close(other);
}

static void put_pipe(int size) {
    int ends[2];
    must(pipe(ends) == 0, "pipe");
    if (size) must(fcntl(ends[1], F_SETPIPE_SZ, size) > 0, "F_SETPIPE_SZ");
    put(ends[1], ends[0]);
}

/* Through a description of its own, so that the flags of 2 stay. */
static void fill(void) {
    memset(all, 'x', sizeof all);
    const int own = open("/proc/self/fd/2", O_WRONLY | O_NONBLOCK | O_NOCTTY);
    must(own >= 0, "open again");
    struct pollfd room = {own, POLLOUT, 0}; // a terminal makes some a little later, once
    do {
        while (write(own, all, 4096) > 0 || write(own, all, 1) > 0) {
        }
    } while (poll(&room, 1, 300) > 0);
    close(own);
}

static void closed(void) { close(2); }
/* Single writes cannot be non-blocking here, as before Linux 6.4: vmsplice takes that away from a pipe. */
static void pipe_before_6_4(void) {
    struct iovec one = {"x", 1};
    put_pipe(0);
    must(vmsplice(2, &one, 1, SPLICE_F_NONBLOCK) == 1, "vmsplice");
}
static void full_pipe_before_6_4(void) { pipe_before_6_4(), fill(); }
static void full_pipe(void) { put_pipe(0), fill(); }
static void small_full_pipe(void) { put_pipe(4096), fill(); }
static void empty_pipe(void) { put_pipe(0); }
static void pipe_without_reader(void) { put_pipe(0), close(peer); }
static void socket_pair(void) {
    int ends[2];
    must(socketpair(AF_UNIX, SOCK_STREAM, 0, ends) == 0, "socketpair");
    put(ends[0], ends[1]);
}
static void socket_without_peer(void) { socket_pair(), close(peer); }
static void put_terminal(int raw) {
    int master = 0, slave = 0;
    must(openpty(&master, &slave, NULL, NULL, NULL) == 0, "openpty");
    struct termios modes;
    must(tcgetattr(slave, &modes) == 0, "tcgetattr");
    if (raw) cfmakeraw(&modes);
    must(tcsetattr(slave, TCSANOW, &modes) == 0, "tcsetattr");
    put(slave, master);
}
static void terminal(void) { put_terminal(1); }
static void full_terminal(void) { put_terminal(0), fill(); }
static void stopped_terminal(void) { put_terminal(0), must(tcflow(2, TCOOFF) == 0, "tcflow"); }
/* Goes on in a child that leads the terminal's session; ends as that ends. */
static void lead_terminal(void) {
    put_terminal(0);
    const pid_t leader = fork();
    if (leader > 0) {
        int status = 0;
        waitpid(leader, &status, 0);
        _exit(WIFEXITED(status) ? WEXITSTATUS(status) : 71);
    }
    setsid();
    must(ioctl(2, TIOCSCTTY, 0) == 0, "TIOCSCTTY");
}
/* In the background of a terminal that stops those who write from there. */
static void background_terminal(void) {
    lead_terminal();
    struct termios modes;
    tcgetattr(2, &modes);
    modes.c_lflag |= TOSTOP;
    must(tcsetattr(2, TCSANOW, &modes) == 0, "tcsetattr");
    const pid_t drawing = fork();
    if (drawing == 0) {
        setpgid(0, 0);
        return;
    }
    setpgid(drawing, drawing);
    int status = 0;
    waitpid(drawing, &status, WUNTRACED);
    if (WIFSTOPPED(status)) {
        printf("stopped\n"), fflush(stdout);
        kill(drawing, SIGKILL);
    }
    _exit(WIFEXITED(status) ? WEXITSTATUS(status) : 72);
}
static void put_file(int flags) {
    char name[] = "/tmp/glcast-stderrs-XXXXXX";
    const int made = mkstemp(name);
    must(made >= 0, "mkstemp");
    const int file = open(name, flags);
    must(file >= 0, "open");
    put(file, made);
    unlink(name);
}
static void some_file(void) { put_file(O_WRONLY); }
/* The limit also holds for a capture, so it is large, and the file as large. */
static void file_at_its_limit(void) {
    put_file(O_WRONLY | O_APPEND);
    const struct rlimit limit = {64 << 20, 64 << 20};
    must(ftruncate(peer, 64 << 20) == 0, "ftruncate");
    must(setrlimit(RLIMIT_FSIZE, &limit) == 0, "setrlimit");
}
static void full_device(void) { put(open("/dev/full", O_WRONLY), -1); }
static void only_readable(void) { put_pipe(0), put(peer, -1); }

/* Once it runs; those that return a descriptor write data into it after each frame. */
static volatile int broken_pipes;
static void count_broken(int number) { broken_pipes += number == SIGPIPE || number == SIGXFSZ; }
static int nothing(void) { return -1; }
static int catch_signals(void) { return signal(SIGPIPE, count_broken), signal(SIGXFSZ, count_broken), -1; }
static int ignore_signals(void) { return signal(SIGPIPE, SIG_IGN), signal(SIGXFSZ, SIG_IGN), -1; }
static int block_pipe(void) {
    sigset_t set;
    sigemptyset(&set), sigaddset(&set, SIGPIPE);
    sigprocmask(SIG_BLOCK, &set, NULL);
    return -1;
}
static int wait_with_pipe(void) { return block_pipe(), raise(SIGPIPE), -1; }
static int non_blocking(void) { return fcntl(2, F_SETFL, fcntl(2, F_GETFL) | O_NONBLOCK), -1; }
static int data_file(void) {
    char name[] = "/tmp/glcast-stderrs-XXXXXX";
    close(2);
    must(mkstemp(name) == 2, "mkstemp");
    must(dup2(2, peer) == peer, "dup2");
    unlink(name);
    return 2;
}
static int data_pipe(void) { return empty_pipe(), 2; }
static int data_socket(void) { return socket_pair(), 2; }
static int data_terminal(void) { return terminal(), 2; }
static int data_behind_stdio(void) {
    some_file(); // and the stderr of before lives on elsewhere
    return 2;
}
static int hold_lock(void) {
    const struct flock lock = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
    must(fcntl(2, F_SETLK, &lock) == 0, "F_SETLK");
    return -1;
}
/* As a server does that was started by root: the pipe is another user's, and /proc/self/fd is closed to it.
 */
static int other_user(void) {
    must(fchmod(2, 0) == 0, "fchmod");
    if (geteuid() == 0) must(setresuid(65534, 65534, 65534) == 0, "setresuid");
    return -1;
}

/* At the end. */
static long read_peer(void) {
    struct stat status;
    must(fstat(peer, &status) == 0, "fstat");
    if (S_ISREG(status.st_mode)) return pread(peer, all, sizeof all, 0);
    fcntl(peer, F_SETFL, O_NONBLOCK);
    long size = 0;
    for (ssize_t got; size < (long)sizeof all && (got = read(peer, all + size, sizeof all - size)) > 0;)
        size += got;
    return size;
}
static int is_as_written(void) {
    const long size = read_peer(), unit = (long)strlen(data);
    int same = size == frames * unit;
    for (long i = 0; same && i < size; i += unit) same = memcmp(all + i, data, unit) == 0;
    printf(same ? "as written\n" : "%ld bytes, not as written\n", size);
    return same;
}
static int is_full(void) {
    const long size = read_peer();
    long other = 0;
    for (long i = 0; i < size; ++i) other += all[i] != 'x';
    printf("%ld bytes that are not ours, non-blocking %d\n", other, (fcntl(2, F_GETFL) & O_NONBLOCK) != 0);
    return size > 0 && other == 0;
}
static int is_untold(void) {
    const long size = read_peer();
    return printf("%ld bytes\n", size), size == 0;
}
/* What is told there shows in descriptor 1, for the test to see. */
static int passes_on(void) {
    const long size = read_peer();
    return fwrite(all, 1, size, stdout) == (size_t)size;
}
static int is_quiet(void) {
    sigset_t pending;
    sigpending(&pending);
    const int waits = sigismember(&pending, SIGPIPE) || sigismember(&pending, SIGXFSZ);
    printf("%d caught, pending %d\n", broken_pipes, waits);
    return broken_pipes == 0 && !waits;
}
static int still_waits(void) {
    sigset_t pending;
    sigpending(&pending);
    return printf("pending %d\n", sigismember(&pending, SIGPIPE)), sigismember(&pending, SIGPIPE);
}
static int connection_is_two(void) { return XSync(display, False), ConnectionNumber(display) == 2; }
static int lives(void) { return 1; }
static int still_locked(void) {
    fflush(stdout);
    if (fork() == 0) {
        struct flock lock = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
        fcntl(2, F_GETLK, &lock);
        _exit(lock.l_type == F_WRLCK ? 0 : 1);
    }
    int status = 1;
    wait(&status);
    return printf("locked %d\n", status == 0), status == 0;
}

static const struct {
    const char* name;
    void (*before)(void);
    int (*during)(void);
    int (*after)(void);
} cases[] = {
    {"closed", closed, nothing, connection_is_two},
    {"full_pipe", full_pipe, nothing, is_full},
    {"small_full_pipe", small_full_pipe, nothing, is_full},
    {"non_blocking_full_pipe", full_pipe, non_blocking, is_full},
    {"pipe", empty_pipe, nothing, passes_on},
    {"pipe_of_another_user", empty_pipe, other_user, passes_on},
    {"full_pipe_of_another_user", full_pipe, other_user, is_full},
    {"pipe_before_6_4", pipe_before_6_4, other_user, passes_on},
    {"full_pipe_before_6_4", full_pipe_before_6_4, other_user, is_full},
    {"terminal", terminal, nothing, passes_on},
    {"file", some_file, nothing, passes_on},
    {"pipe_without_reader", pipe_without_reader, nothing, is_quiet},
    {"pipe_without_reader_handler", pipe_without_reader, catch_signals, is_quiet},
    {"pipe_without_reader_ignored", pipe_without_reader, ignore_signals, is_quiet},
    {"pipe_without_reader_blocked", pipe_without_reader, block_pipe, is_quiet},
    {"pipe_without_reader_of_another_user", pipe_without_reader, other_user, is_quiet},
    {"pipe_pending", empty_pipe, wait_with_pipe, still_waits},
    {"pipe_without_reader_pending", pipe_without_reader, wait_with_pipe, still_waits},
    {"socket", socket_pair, nothing, is_untold},
    {"socket_without_peer", socket_without_peer, catch_signals, is_quiet},
    {"full_terminal", full_terminal, nothing, lives},
    {"stopped_terminal", stopped_terminal, nothing, lives},
    {"terminal_of_another_user", lead_terminal, other_user, passes_on},
    {"background_terminal", background_terminal, nothing, passes_on},
    {"full_device", full_device, nothing, lives},
    {"only_readable", only_readable, nothing, lives},
    {"file_at_its_limit", file_at_its_limit, nothing, is_quiet},
    {"file_at_its_limit_handler", file_at_its_limit, catch_signals, is_quiet},
    {"locked_file", some_file, hold_lock, still_locked},
    {"data_file", NULL, data_file, is_as_written},
    {"data_file_behind_stdio", NULL, data_behind_stdio, is_as_written},
    {"data_file_for_file", some_file, data_file, is_as_written},
    {"data_pipe", NULL, data_pipe, is_as_written},
    {"data_pipe_for_pipe", empty_pipe, data_pipe, is_as_written},
    {"data_socket", NULL, data_socket, is_as_written},
    {"data_terminal", terminal, data_terminal, is_as_written},
};

static int draw(int which) {
    alarm(40);
    const Window window = make_window(120, 120);
    const GLXContext context = make_context(0);
    glXMakeCurrent(display, window, context);
    const int file = cases[which].during();
    for (int frame = 0; frame < frames; ++frame) {
        look_at_chiral(120);
        draw_chiral();
        glXSwapBuffers(display, window);
        if (file >= 0 && write(file, data, strlen(data)) != (ssize_t)strlen(data)) return 74;
    }
    return cases[which].after() ? 0 : 1;
}

int main(int argc, char** argv) {
    for (int i = 0; argc > 1 && i < (int)(sizeof cases / sizeof cases[0]); ++i) {
        if (strcmp(argv[1], cases[i].name) != 0) continue;
        if (argc > 2 || !cases[i].before) return draw(i);
        cases[i].before();
        execl("/proc/self/exe", argv[0], argv[1], "draw", (char*)NULL);
        return 75;
    }
    return 2;
}
