/* The three boxes of chiral.h by WGL: boxes_gl [child|two|thread|launcher]
 *   child     in a child window
 *   two       two windows, a context for each, that share their lists
 *   thread    on a thread of its own
 *   launcher  starts itself again, and waits */
#include <windows.h>

#include <GL/gl.h>
#include <string.h>

#include "tests/preload/programs/chiral.h"

static LRESULT CALLBACK take_message(HWND window, UINT message, WPARAM a, LPARAM b) {
    if (message == WM_DESTROY) PostQuitMessage(0);
    return DefWindowProc(window, message, a, b);
}

static HWND make_window(const char* title, HWND parent, int size) {
    const DWORD style = parent ? WS_CHILD | WS_VISIBLE : WS_OVERLAPPEDWINDOW | WS_VISIBLE | WS_CLIPCHILDREN;
    return CreateWindow("boxes", title, style, parent ? 10 : 50, parent ? 10 : 50, size, size, parent, 0, 0,
                        0);
}

typedef struct {
    HWND window;
    HDC device;
    HGLRC context;
} Picture;

static Picture make_picture(HWND window) {
    Picture p = {window, GetDC(window), 0};
    PIXELFORMATDESCRIPTOR wanted = {sizeof wanted, 1,
                                    PFD_DRAW_TO_WINDOW | PFD_SUPPORT_OPENGL | PFD_DOUBLEBUFFER};
    wanted.iPixelType = PFD_TYPE_RGBA;
    wanted.cColorBits = 24;
    wanted.cDepthBits = 24;
    SetPixelFormat(p.device, ChoosePixelFormat(p.device, &wanted), &wanted);
    p.context = wglCreateContext(p.device);
    return p;
}

static void draw(const Picture* p, GLuint list) {
    wglMakeCurrent(p->device, p->context);
    look_at_chiral(300);
    if (list)
        glCallList(list);
    else
        draw_chiral();
    SwapBuffers(p->device);
}

static DWORD WINAPI draw_for_ever(void* picture) {
    for (;; Sleep(10)) draw((Picture*)picture, 0);
    return 0;
}

static int launch(void) {
    char command[MAX_PATH + 8] = "\"";
    GetModuleFileName(0, command + 1, MAX_PATH);
    strcat(command, "\"");
    STARTUPINFO start = {sizeof start};
    PROCESS_INFORMATION process;
    if (!CreateProcess(0, command, 0, 0, FALSE, 0, 0, 0, &start, &process)) return 10;
    WaitForSingleObject(process.hProcess, INFINITE);
    return 0;
}

int WINAPI WinMain(HINSTANCE instance, HINSTANCE before, LPSTR way, int show) {
    (void)before, (void)show;
    if (strcmp(way, "launcher") == 0) return launch();
    WNDCLASS kind = {CS_OWNDC, take_message, 0, 0, instance, 0, 0, 0, 0, "boxes"};
    RegisterClass(&kind);
    HWND window = make_window("boxes", 0, 340);
    if (strcmp(way, "child") == 0) window = make_window("inner", window, 300);
    Picture first = make_picture(window), second = {0};
    GLuint list = 0;
    if (strcmp(way, "two") == 0) {
        second = make_picture(make_window("second", 0, 340));
        wglShareLists(first.context, second.context);
        wglMakeCurrent(first.device, first.context);
        list = glGenLists(1);
        glNewList(list, GL_COMPILE);
        draw_chiral();
        glEndList();
    }
    if (strcmp(way, "thread") == 0) CreateThread(0, 0, draw_for_ever, &first, 0, 0);
    for (MSG message;;) {
        while (PeekMessage(&message, 0, 0, 0, PM_REMOVE)) {
            if (message.message == WM_QUIT) return 0;
            DispatchMessage(&message);
        }
        if (strcmp(way, "thread") != 0) draw(&first, list);
        if (second.context) draw(&second, list);
        Sleep(10);
    }
}
