/* The three boxes of chiral.h by the fixed functions of Direct3D 8 or 9 (-DVERSION). Direct3D is left-handed:
 * the camera looks along +z at the mirror image of boxes whose z is turned round, so that the picture is that
 * of the OpenGL program. */
#define COBJMACROS
#include <windows.h>
#if VERSION == 8
#include <d3d8.h>
#define CALL(what) IDirect3DDevice8_##what
typedef IDirect3DDevice8 Device;
typedef D3DLIGHT8 Light;
#else
#include <d3d9.h>
#define CALL(what) IDirect3DDevice9_##what
typedef IDirect3DDevice9 Device;
typedef D3DLIGHT9 Light;
#endif
#include <string.h>

static const float boxes[3][2][3] = {{{0, 0, 0}, {1, 1, 3}}, {{1, 0, 0}, {3, 1, 1}}, {{0, 1, 2}, {1, 2, 3}}};

typedef struct {
    float x, y, z, nx, ny, nz;
    DWORD colour;
} Vertex;
static Vertex vertices[3 * 36];
static int count;

static void add_box(const float box[2][3]) {
    static const int faces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                    {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    static const int corners[6] = {0, 1, 2, 0, 2, 3};
    for (int face = 0; face < 6; ++face)
        for (int i = 0; i < 6; ++i) {
            const int c = faces[face][corners[i]];
            Vertex v = {box[c & 1][0], box[c >> 1 & 1][1], -box[c >> 2 & 1][2], 0, 0, 0, 0xff40c0ff};
            const float side = face & 1 ? 1 : -1;
            if (face / 2 == 0) v.nx = side;
            if (face / 2 == 1) v.ny = side;
            if (face / 2 == 2) v.nz = -side;
            vertices[count++] = v;
        }
}

static LRESULT CALLBACK take_message(HWND window, UINT message, WPARAM a, LPARAM b) {
    if (message == WM_DESTROY) PostQuitMessage(0);
    return DefWindowProc(window, message, a, b);
}

static Device* make_device(HWND window) {
    D3DPRESENT_PARAMETERS wanted = {0};
    wanted.Windowed = TRUE;
    wanted.SwapEffect = D3DSWAPEFFECT_DISCARD;
    wanted.EnableAutoDepthStencil = TRUE;
    wanted.AutoDepthStencilFormat = D3DFMT_D24S8;
    wanted.hDeviceWindow = window;
    Device* device = 0;
#if VERSION == 8
    /* mingw has no library to link with */
    typedef IDirect3D8*(WINAPI * Create)(UINT);
    Create create = (Create)(void*)GetProcAddress(LoadLibrary("d3d8.dll"), "Direct3DCreate8");
    IDirect3D8* direct3d = create ? create(D3D_SDK_VERSION) : 0;
    D3DDISPLAYMODE mode;
    if (!direct3d || FAILED(IDirect3D8_GetAdapterDisplayMode(direct3d, 0, &mode))) return 0;
    wanted.BackBufferFormat = mode.Format;
    IDirect3D8_CreateDevice(direct3d, 0, D3DDEVTYPE_HAL, window, D3DCREATE_HARDWARE_VERTEXPROCESSING, &wanted,
                            &device);
#else
    IDirect3D9* direct3d = Direct3DCreate9(D3D_SDK_VERSION);
    if (!direct3d) return 0;
    wanted.BackBufferFormat = D3DFMT_UNKNOWN;
    IDirect3D9_CreateDevice(direct3d, 0, D3DDEVTYPE_HAL, window, D3DCREATE_HARDWARE_VERTEXPROCESSING, &wanted,
                            &device);
#endif
    return device;
}

static void look(Device* device) {
    const float near_plane = 2, far_plane = 40;
    D3DMATRIX view = {0}, lens = {0};
    view._11 = view._22 = view._33 = view._44 = 1;
    view._41 = view._42 = -1;
    view._43 = 9;
    lens._11 = lens._22 = 2; /* as glFrustum(-1, 1, -1, 1, 2, 40) */
    lens._33 = far_plane / (far_plane - near_plane);
    lens._34 = 1;
    lens._43 = -near_plane * lens._33;
    CALL(SetTransform)(device, D3DTS_VIEW, &view);
    CALL(SetTransform)(device, D3DTS_PROJECTION, &lens);
    Light light;
    memset(&light, 0, sizeof light);
    light.Type = D3DLIGHT_DIRECTIONAL;
    light.Diffuse.r = light.Diffuse.g = light.Diffuse.b = 1;
    light.Direction.z = 1;
    CALL(SetLight)(device, 0, &light);
    CALL(LightEnable)(device, 0, TRUE);
    CALL(SetRenderState)(device, D3DRS_AMBIENT, 0xff404040);
    CALL(SetRenderState)(device, D3DRS_CULLMODE, D3DCULL_NONE);
}

static void draw(Device* device) {
    CALL(Clear)(device, 0, 0, D3DCLEAR_TARGET | D3DCLEAR_ZBUFFER, 0xff203040, 1, 0);
    CALL(BeginScene)(device);
    look(device);
    const DWORD format = D3DFVF_XYZ | D3DFVF_NORMAL | D3DFVF_DIFFUSE;
#if VERSION == 8
    CALL(SetVertexShader)(device, format);
#else
    CALL(SetFVF)(device, format);
#endif
    CALL(DrawPrimitiveUP)(device, D3DPT_TRIANGLELIST, count / 3, vertices, sizeof *vertices);
    CALL(EndScene)(device);
    CALL(Present)(device, 0, 0, 0, 0);
}

int WINAPI WinMain(HINSTANCE instance, HINSTANCE before, LPSTR way, int show) {
    (void)before, (void)show, (void)way;
    WNDCLASS kind = {0, take_message, 0, 0, instance, 0, 0, 0, 0, "boxes"};
    RegisterClass(&kind);
    HWND window =
        CreateWindow("boxes", "boxes", WS_OVERLAPPEDWINDOW | WS_VISIBLE, 50, 50, 320, 340, 0, 0, 0, 0);
    Device* device = make_device(window);
    if (!device) return 11;
    for (int i = 0; i < 3; ++i) add_box(boxes[i]);
    for (MSG message;;) {
        while (PeekMessage(&message, 0, 0, 0, PM_REMOVE)) {
            if (message.message == WM_QUIT) return 0;
            DispatchMessage(&message);
        }
        draw(device);
        Sleep(10);
    }
}
