// A program that measures its own immediate-mode calls: prints the median over its frames of nanoseconds per
// call. The triangles lie outside of the view, so that software GL fills no pixels.
//
//     overhead_calls [FRAMES]
//     overhead_calls list       compiles a display list of a million vertices with normals instead, and prints by how many
//                               bytes the process has grown
#include <GL/gl.h>
#include <GL/glx.h>
#include <X11/Xlib.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <unistd.h>
#include <vector>

namespace {

constexpr int triangles = 5'000, calls_per_triangle = 6;

double nanoseconds_per_call() {
    const auto start = std::chrono::steady_clock::now();
    glBegin(GL_TRIANGLES);
    for (int i = 0; i < triangles; ++i) {
        const float x = 10 + 1e-3f * i;
        for (int corner = 0; corner < 3; ++corner) {
            glNormal3f(0, 0, 1);
            glVertex3f(x + corner, corner == 1, 0);
        }
    }
    glEnd();
    const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - start;
    return time.count() / (triangles * calls_per_triangle);
}

long resident_bytes() {
    long pages = 0, resident = 0;
    if (std::FILE* file = std::fopen("/proc/self/statm", "r")) {
        if (std::fscanf(file, "%ld %ld", &pages, &resident) != 2) resident = 0;
        std::fclose(file);
    }
    return resident * sysconf(_SC_PAGESIZE);
}

long bytes_of_list() {
    const long before = resident_bytes();
    glNewList(1, GL_COMPILE);
    glBegin(GL_POINTS);
    for (int i = 0; i < 1'000'000; ++i) glNormal3f(0, 0, 1), glVertex3f(10, 0, 1e-3f * float(i));
    glEnd();
    glEndList();
    return resident_bytes() - before;
}

Window make_window(Display* display, XVisualInfo* visual) {
    XSetWindowAttributes looks{};
    looks.colormap = XCreateColormap(display, DefaultRootWindow(display), visual->visual, AllocNone);
    const Window window = XCreateWindow(display, DefaultRootWindow(display), 0, 0, 64, 64, 0, visual->depth,
                                        InputOutput, visual->visual, CWColormap | CWBorderPixel, &looks);
    XMapWindow(display, window);
    return window;
}

} // namespace

int main(int argc, char** argv) {
    const int frames = argc > 1 ? std::atoi(argv[1]) : 60;
    Display* display = XOpenDisplay(nullptr);
    if (!display) return 1;
    int attributes[] = {GLX_RGBA, GLX_DOUBLEBUFFER, GLX_DEPTH_SIZE, 16, None};
    XVisualInfo* visual = glXChooseVisual(display, DefaultScreen(display), attributes);
    if (!visual) return 1;
    const Window window = make_window(display, visual);
    const GLXContext context = glXCreateContext(display, visual, nullptr, True);
    if (!context || !glXMakeCurrent(display, window, context)) return 1;
    if (argc > 1 && std::strcmp(argv[1], "list") == 0) return std::printf("%ld\n", bytes_of_list()) < 0;
    std::vector<double> times;
    for (int frame = 0; frame < frames; ++frame) {
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        times.push_back(nanoseconds_per_call());
        glXSwapBuffers(display, window);
    }
    times.erase(times.begin(), times.begin() + frames / 5); // warming up
    std::nth_element(times.begin(), times.begin() + times.size() / 2, times.end());
    std::printf("%.3f\n", times[times.size() / 2]);
}
