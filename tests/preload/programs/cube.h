// A window with a cube in all frames but the first.
#ifdef __cplusplus
extern "C" {
#endif

// 0, or what failed. `before_frame` may be null.
int draw_cubes(int frames, void (*before_frame)(int frame));

#ifdef __cplusplus
}
#endif
