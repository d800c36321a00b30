// Sets hostile state, ends a frame with it, and writes down before and after it everything that the context
// can be asked.
//
// Usage: state_program glx|egl FOLDER [empty_0]   writes before, after, second, stacks and names into the folder;
// empty_0: no image goes into a texture named 0
#include <EGL/egl.h>
#include <GL/glx.h>
#include <X11/Xlib.h>

#include <cstdio>
#include <cstring>
#include <fstream>
#include <functional>
#include <sstream>

#include "capture/gl/gl_table.h"
#include "tests/preload/state/every_query.h"
#include "tests/preload/state/hostile_state.h"

namespace glcast::test {
namespace {

int x_errors = 0;
int count_x_error(Display*, XErrorEvent*) { return ++x_errors; }

constexpr int size = 100;

/// What a program needs of its window system.
struct System {
    std::function<void()> swap;
    std::function<std::string()> ask; ///< what it says of this thread
    GlProc (*get_proc)(const char* name);
};

Window make_window(Display* display, const XVisualInfo& visual) {
    XSetWindowAttributes looks = {};
    const Window root = RootWindow(display, visual.screen);
    looks.colormap = XCreateColormap(display, root, visual.visual, AllocNone);
    const Window window = XCreateWindow(display, root, 0, 0, size, size, 0, visual.depth, InputOutput,
                                        visual.visual, CWColormap | CWBorderPixel, &looks);
    XMapWindow(display, window);
    return window;
}

System make_glx(Display* display) {
    int wanted[] = {GLX_RGBA, GLX_DOUBLEBUFFER,   GLX_RED_SIZE, 8,   GLX_DEPTH_SIZE, 24, GLX_STENCIL_SIZE,
                    8,        GLX_ACCUM_RED_SIZE, 16,           None};
    XVisualInfo* visual = glXChooseVisual(display, DefaultScreen(display), wanted);
    if (!visual) throw std::runtime_error("no GLX visual");
    const Window window = make_window(display, *visual);
    const GLXContext context = glXCreateContext(display, visual, nullptr, True);
    if (!glXMakeCurrent(display, window, context)) throw std::runtime_error("glXMakeCurrent failed");
    const auto ask = [=] {
        std::ostringstream text;
        text << "context " << (glXGetCurrentContext() == context) << " drawable "
             << (glXGetCurrentDrawable() == window) << " read " << (glXGetCurrentReadDrawable() == window)
             << " display " << (glXGetCurrentDisplay() == display);
        return text.str();
    };
    return {[=] { glXSwapBuffers(display, window); }, ask,
            [](const char* name) { return glXGetProcAddressARB(reinterpret_cast<const GLubyte*>(name)); }};
}

System make_egl(Display* x) {
    const EGLDisplay display = eglGetDisplay(reinterpret_cast<EGLNativeDisplayType>(x));
    eglInitialize(display, nullptr, nullptr);
    eglBindAPI(EGL_OPENGL_API);
    const EGLint wanted[] = {EGL_SURFACE_TYPE,
                             EGL_WINDOW_BIT,
                             EGL_RENDERABLE_TYPE,
                             EGL_OPENGL_BIT,
                             EGL_RED_SIZE,
                             8,
                             EGL_DEPTH_SIZE,
                             24,
                             EGL_STENCIL_SIZE,
                             8,
                             EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0, id = 0;
    if (!eglChooseConfig(display, wanted, &config, 1, &count) || count == 0)
        throw std::runtime_error("no EGL config");
    eglGetConfigAttrib(display, config, EGL_NATIVE_VISUAL_ID, &id);
    XVisualInfo like = {};
    like.visualid = VisualID(id);
    XVisualInfo* visual = XGetVisualInfo(x, VisualIDMask, &like, &count);
    if (!visual) throw std::runtime_error("no visual");
    const EGLSurface surface = eglCreateWindowSurface(display, config, make_window(x, *visual), nullptr);
    const EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, nullptr);
    if (!eglMakeCurrent(display, surface, surface, context))
        throw std::runtime_error("eglMakeCurrent failed");
    eglBindAPI(EGL_OPENGL_ES_API); // a thread may have another API bound than its context's
    const auto ask = [=] {
        std::ostringstream text;
        text << "error " << eglGetError() << " api " << eglQueryAPI();
        eglBindAPI(EGL_OPENGL_API);
        text << " context " << (eglGetCurrentContext() == context) << " draw "
             << (eglGetCurrentSurface(EGL_DRAW) == surface) << " read "
             << (eglGetCurrentSurface(EGL_READ) == surface) << " display "
             << (eglGetCurrentDisplay() == display);
        eglBindAPI(EGL_OPENGL_ES_API);
        return text.str();
    };
    const auto swap = [=] { eglSwapBuffers(display, surface); };
    return {swap, ask, eglGetProcAddress};
}

void draw_solid(const GlTable& gl) {
    gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    gl.PushAttrib(GL_ALL_ATTRIB_BITS);
    GLint program = 0;
    gl.GetIntegerv(GL_CURRENT_PROGRAM, &program);
    gl.UseProgram(0);
    for (const GLenum off : {GL_CULL_FACE, GL_ALPHA_TEST, GL_FRAGMENT_PROGRAM_ARB, GL_VERTEX_PROGRAM_ARB,
                             GL_SCISSOR_TEST, GL_STENCIL_TEST})
        gl.Disable(off);
    for (int i = 0; i < 6; ++i) gl.Disable(GLenum(GL_CLIP_PLANE0 + i));
    gl.DepthMask(GL_TRUE), gl.Enable(GL_DEPTH_TEST), gl.DepthFunc(GL_LESS),
        gl.PolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    gl.MatrixMode(GL_PROJECTION);
    gl.PushMatrix(), gl.LoadIdentity(), gl.Frustum(-1, 1, -1, 1, 2, 20);
    gl.MatrixMode(GL_MODELVIEW);
    gl.PushMatrix(), gl.LoadIdentity(), gl.Translatef(0, 0, -5);
    gl.Begin(GL_TRIANGLE_FAN);
    for (const auto& [x, y, z] :
         {std::tuple{0.f, 0.f, 1.f}, {-1.f, -1.f, 0.f}, {1.f, -1.f, 0.f}, {1.f, 1.f, 0.f}, {-1.f, -1.f, 0.f}})
        gl.Vertex3f(x, y, z);
    gl.End();
    gl.PopMatrix();
    gl.MatrixMode(GL_PROJECTION);
    gl.PopMatrix();
    gl.PopAttrib();
    gl.UseProgram(GLuint(program));
}

/// Names that the program would get next. Mesa counts framebuffers and renderbuffers on over the share
/// group's names that have gone, so these two may be higher than without us.
std::string next_names(const GlTable& gl) {
    GLuint names[3] = {};
    gl.GenTextures(1, &names[0]), gl.GenBuffers(1, &names[1]), gl.GenQueries(1, &names[2]);
    std::ostringstream text;
    for (const GLuint name : names) text << name << ' ';
    text << gl.GenLists(3) << ' ' << gl.CreateProgram() << ' ' << gl.CreateShader(GL_VERTEX_SHADER) << '\n';
    return text.str();
}

int run(const std::string& system_name, const std::string& folder, bool fill_0) {
    const auto write = [&](const char* name, const std::string& text) {
        std::ofstream(folder + '/' + name) << text;
    };
    Display* display = XOpenDisplay(nullptr);
    if (!display) return 10;
    XSetErrorHandler(count_x_error);
    const System system = system_name == "egl" ? make_egl(display) : make_glx(display);
    const GlTable gl = load_gl_table(system.get_proc);
    const auto ask = [&] {
        const GLenum pending = gl.GetError();
        XSync(display, False);
        std::ostringstream text;
        text << system.ask() << "\nGL error " << pending << "\nX errors " << x_errors << "\n";
        const bool own_handler = XSetErrorHandler(count_x_error) == count_x_error;
        text << "own handler " << own_handler << "\n" << every_query(gl, client_memory());
        return text.str();
    };
    draw_solid(gl);
    set_hostile_state(gl, fill_0);
    const std::string before = ask();
    write("before", before);
    gl.Enable(GL_TEXTURE_WRAP_S); // an error that is to be found after the swap
    system.swap();
    write("after", ask());
    draw_solid(gl);
    system.swap();
    write("second", ask());
    write("stacks", pop_every_stack(gl, client_memory()));
    write("names", next_names(gl));
    XCloseDisplay(display);
    return 0;
}

} // namespace
} // namespace glcast::test

int main(int argc, char** argv) {
    const bool empty_0 = argc == 4 && std::string(argv[3]) == "empty_0";
    if (argc != 3 && !empty_0) return 2;
    try {
        return glcast::test::run(argv[1], argv[2], !empty_0);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "state_program: %s\n", error.what());
        return 1;
    }
}
