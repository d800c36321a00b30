/* A red box, and around it or beside it what the program mixes with what is there. argv[1] names the way: hulls that let
 * the box be seen, and boxes that are as solid as any. */
#define GL_GLEXT_PROTOTYPES
#include <stdio.h>
#include <string.h>

#include "window.h"

/* What a hull or box is drawn with. equation 0: a logic operation, function source. */
struct Way {
    const char* name;
    GLenum source, destination, equation;
    float colour[4], constant[4], clear[3];
    int solid; /* a blue box in the place of a hull */
};

static const struct Way ways[] = {
    {"constant_alpha", GL_CONSTANT_ALPHA, GL_ONE_MINUS_CONSTANT_ALPHA, GL_FUNC_ADD, {0, 0, 1, 1}, {0, 0, 0, .05f}, {0}, 0},
    {"constant_colour", GL_CONSTANT_COLOR, GL_ONE_MINUS_CONSTANT_COLOR, GL_FUNC_ADD, {0, 0, 1, 1}, {.1f, .1f, .1f, 1}, {0}, 0},
    {"transparency", GL_ONE_MINUS_SRC_ALPHA, GL_SRC_ALPHA, GL_FUNC_ADD, {0, 0, 1, .95f}, {0}, {0}, 0},
    {"glow", GL_ONE, GL_ONE, GL_FUNC_ADD, {0, 0, .2f, 1}, {0}, {0}, 0},
    {"glow_by_alpha", GL_SRC_ALPHA, GL_ONE, GL_FUNC_ADD, {0, 0, 1, .9f}, {0}, {0}, 0},
    {"premultiplied_glass", GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_FUNC_ADD, {0, 0, .1f, .1f}, {0}, {0}, 0},
    {"tint", GL_DST_COLOR, GL_ZERO, GL_FUNC_ADD, {1, 1, .5f, 1}, {0}, {0}, 0},
    {"xor", GL_XOR, 0, 0, {0, 0, 1, 1}, {0}, {0}, 0},
    {"noop", GL_NOOP, 0, 0, {0, 0, 1, 1}, {0}, {0}, 0},
    {"greatest_over_light", GL_ONE, GL_ONE, GL_MAX, {0, 0, 1, 1}, {0}, {1, 1, 1}, 0},
    {"least_over_dark", GL_ONE, GL_ONE, GL_MIN, {0, 0, 1, 1}, {0}, {0}, 0},
    {"opaque_without_alpha", GL_ONE, GL_ZERO, GL_FUNC_ADD, {0, 0, 1, 0}, {0}, {0}, 1},
    {"opaque_by_low_alpha", GL_ONE_MINUS_SRC_ALPHA, GL_SRC_ALPHA, GL_FUNC_ADD, {0, 0, 1, 0}, {0}, {0}, 1},
    {"opaque_premultiplied", GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_FUNC_ADD, {0, 0, 1, 1}, {0}, {0}, 1},
    {"opaque_by_constant", GL_CONSTANT_ALPHA, GL_ONE_MINUS_CONSTANT_ALPHA, GL_FUNC_ADD, {0, 0, 1, .1f}, {0, 0, 0, 1}, {0}, 1},
    {"copied", GL_COPY, 0, 0, {0, 0, 1, .1f}, {0}, {0}, 1},
    {"greatest_over_dark", GL_ONE, GL_ONE, GL_MAX, {0, 0, 1, 0}, {0}, {0}, 1},
    {"least_over_light", GL_ONE, GL_ONE, GL_MIN, {0, 0, 1, 0}, {0}, {1, 1, 1}, 1},
};

static void mix_as(const struct Way* way) {
    glEnable(GL_BLEND);
    glBlendColor(way->constant[0], way->constant[1], way->constant[2], way->constant[3]);
    if (way->equation) {
        glBlendFunc(way->source, way->destination);
        glBlendEquation(way->equation);
    } else {
        glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
        glEnable(GL_COLOR_LOGIC_OP);
        glLogicOp(way->source);
    }
}

int main(int argc, char** argv) {
    const char* name = argc > 1 ? argv[1] : "glow";
    const int alone = argc > 2; /* nothing but the hull */
    const struct Way* way = 0;
    for (unsigned i = 0; i < sizeof ways / sizeof *ways; ++i)
        if (strcmp(ways[i].name, name) == 0) way = &ways[i];
    if (!way) return 2;
    const float lo[3] = {0, 0, 0}, hi[3] = {2, 2, 2}, hull_lo[3] = {-1, -1, -1}, hull_hi[3] = {3, 3, 3};
    const float beside_lo[3] = {3, 0, 0}, beside_hi[3] = {5, 2, 2};
    const Window window = make_window(160, 160);
    glXMakeCurrent(display, window, make_context(0));
    glClearColor(way->clear[0], way->clear[1], way->clear[2], 1);
    for (int frame = 0; frame < 2; ++frame) {
        look_at_chiral(160);
        glTranslatef(0, 0, -6);
        glColor4f(1, 0, 0, 1);
        if (!alone) draw_box(lo, hi);
        glPushAttrib(GL_ALL_ATTRIB_BITS);
        mix_as(way);
        glColor4fv(way->colour);
        draw_box(way->solid ? beside_lo : hull_lo, way->solid ? beside_hi : hull_hi);
        glPopAttrib();
        glXSwapBuffers(display, window);
    }
    return 0;
}
