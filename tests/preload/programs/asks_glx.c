/* asks_glx [threads|core|none]: questions to GLX and GL; a thread with a context of its own asks the same;
 * core: a context of 3.2 or none. */
#include <dlfcn.h>
#include <pthread.h>
#include <stdio.h>
#include <string.h>

#include "asks.h"
#include "window.h"

typedef GLXContext (*CreateAttribs)(Display*, GLXFBConfig, GLXContext, Bool, const int*);

static Function get(const char* name) { return (Function)glXGetProcAddressARB((const GLubyte*)name); }

static Window window;

static void* ask_beside(void* context) {
    Display* own = XOpenDisplay(0);
    (void)own;
    glXMakeCurrent(display, window, (GLXContext)context);
    ask(get);
    glXMakeCurrent(display, None, NULL);
    return 0;
}

static int has(const char* list, const char* name) { return list && strstr(list, name) != 0; }

static int errors = 0;
static int count_error(Display* d, XErrorEvent* e) {
    (void)d, (void)e;
    ++errors;
    return 0;
}

/* As a program that has the function whatever it is told. */
static GLXContext newer(int major, int minor) {
    CreateAttribs create = (CreateAttribs)dlsym(RTLD_DEFAULT, "glXCreateContextAttribsARB");
    if (!create) create = (CreateAttribs)get("glXCreateContextAttribsARB");
    const int wanted[] = {GLX_DOUBLEBUFFER, True, GLX_DEPTH_SIZE, 16, GLX_X_VISUAL_TYPE,
                          GLX_TRUE_COLOR,   None};
    int count = 0;
    GLXFBConfig* configs = glXChooseFBConfig(display, DefaultScreen(display), wanted, &count);
    if (!create || count == 0) return 0;
    const int version[] = {0x2091, major, 0x2092, minor, None};
    int (*before)(Display*, XErrorEvent*) = XSetErrorHandler(count_error);
    GLXContext made = create(display, configs[0], 0, True, version);
    XSync(display, False);
    XSetErrorHandler(before);
    return made;
}

int main(int argc, char** argv) {
    const char* way = argc > 1 ? argv[1] : "";
    XInitThreads();
    window = make_window(100, 100);
    const int screen = DefaultScreen(display);
    printf("extension %d, of the client %d, of the server %d; of configurations %d\n",
           has(glXQueryExtensionsString(display, screen), "GLX_ARB_create_context"),
           has(glXGetClientString(display, GLX_EXTENSIONS), "GLX_ARB_create_context"),
           has(glXQueryServerString(display, screen, GLX_EXTENSIONS), "GLX_ARB_create_context"),
           has(glXQueryExtensionsString(display, screen), "GLX_SGIX_fbconfig"));
    printf("attributes %s, renderer %s\n", get("glXCreateContextAttribsARB") ? "there" : "not there",
           get("glXQueryCurrentRendererIntegerMESA") ? "there" : "not there");
    GLXContext first = make_context(0), second = make_context(first);
    GLXContext newest = newer(3, 2);
    printf("newer %s, errors %d\n", newest ? "made" : "refused", errors);
    errors = 0;
    printf("old %s, errors %d\n", newer(1, 4) ? "made" : "refused", errors);
    if (strcmp(way, "core") == 0 && newest) first = newest;
    glXMakeCurrent(display, window, first);
    ask(get);
    if (strcmp(way, "threads") == 0) {
        pthread_t thread;
        pthread_create(&thread, 0, ask_beside, second);
        pthread_join(thread, 0);
    }
    fflush(stdout);
    for (int frame = 0; frame < 3; ++frame) {
        draw_as_told(get, 100);
        glXSwapBuffers(display, window);
    }
    return 0;
}
