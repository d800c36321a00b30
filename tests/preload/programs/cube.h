// A window with a cube in all frames but the first.
#ifdef __cplusplus
extern "C" {
#endif

// 0, or what failed. `before_frame` may be null.
int draw_cubes(int frames, void (*before_frame)(int frame));

// How draw_cubes() ends its frames; "swap" until set. A name with "front " or "single " before it draws to the front buffer
// of a window that has two, or to the only one (GLX; Mesa's EGL gives every window two). Both know swap, flush, finish and
// wait; GLX msc and copy; EGL damage-khr, damage-ext and wait-client.
extern const char* frame_end;

#ifdef __cplusplus
}
#endif
