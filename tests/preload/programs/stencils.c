/* Bodies drawn by way of the stencil buffer; argv[1] names the way. Bodies are red, caps blue, faces filled
 * by parity and decals green, outlines yellow. */
#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>
#include <GL/glext.h>
#include <stdio.h>
#include <string.h>

#include "window.h"

static const float unit[2][3] = {{-1, -1, -1}, {1, 1, 1}};
static const float hull[2][3] = {{-1.1f, -1.1f, -1.1f}, {1.1f, 1.1f, 1.1f}};

static void red(void) { glColor3f(1, 0, 0); }
static void green(void) { glColor3f(0, 1, 0); }
static void blue(void) { glColor3f(0, 0, 1); }
static void yellow(void) { glColor3f(1, 1, 0); }
static void box(const float b[2][3]) { draw_box(b[0], b[1]); }
static void solid(void) { box(unit); }
static void bare_quad(float x0, float y0, float x1, float y1, float z) {
    glVertex3f(x0, y0, z), glVertex3f(x1, y0, z), glVertex3f(x1, y1, z), glVertex3f(x0, y1, z);
}
static void quad(float x0, float y0, float x1, float y1, float z) {
    glBegin(GL_QUADS), glNormal3f(0, 0, 1), bare_quad(x0, y0, x1, y1, z), glEnd();
}

/* Marks alone: seen by nobody. */
static void begin_marks(int tests_depth) {
    glEnable(GL_STENCIL_TEST), glColorMask(0, 0, 0, 0), glDepthMask(0), glStencilFunc(GL_ALWAYS, 0, ~0u);
    if (!tests_depth) glDisable(GL_DEPTH_TEST);
}
static void end_marks(void) {
    glColorMask(1, 1, 1, 1), glDepthMask(1), glEnable(GL_DEPTH_TEST), glDisable(GL_CULL_FACE);
    glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
}
static void count_culled(void (*body)(void)) {
    begin_marks(0), glEnable(GL_CULL_FACE);
    glCullFace(GL_FRONT), glStencilOp(GL_KEEP, GL_KEEP, GL_INCR), body();
    glCullFace(GL_BACK), glStencilOp(GL_KEEP, GL_KEEP, GL_DECR), body();
    end_marks();
}
static void invert(void (*body)(void)) {
    begin_marks(0), glStencilOp(GL_INVERT, GL_INVERT, GL_INVERT), body(), end_marks();
}
static void count_two_sided(void (*body)(void)) {
    begin_marks(1);
    glStencilOpSeparate(GL_BACK, GL_KEEP, GL_INCR_WRAP, GL_INCR_WRAP);
    glStencilOpSeparate(GL_FRONT, GL_KEEP, GL_DECR_WRAP, GL_DECR_WRAP);
    body(), end_marks();
}
static void count_two_sided_by_extension(void (*body)(void)) {
    void (*active_face)(GLenum) =
        (void (*)(GLenum))glXGetProcAddress((const GLubyte*)"glActiveStencilFaceEXT");
    begin_marks(1), glEnable(GL_STENCIL_TEST_TWO_SIDE_EXT);
    active_face(GL_BACK), glStencilFunc(GL_ALWAYS, 0, ~0u), glStencilOp(GL_KEEP, GL_INCR_WRAP, GL_INCR_WRAP);
    active_face(GL_FRONT), glStencilOp(GL_KEEP, GL_DECR_WRAP, GL_DECR_WRAP);
    body(), glDisable(GL_STENCIL_TEST_TWO_SIDE_EXT), end_marks();
}
static void plane(int which, double x, double y, double z) {
    const double equation[4] = {x, y, z, 0};
    glClipPlane(GL_CLIP_PLANE0 + which, equation), glEnable(GL_CLIP_PLANE0 + which);
}
/* Cut by plane 0, the cut at z = 0 closed by what was marked. */
static void capped(void (*mark)(void (*)(void)), void (*body)(void), GLuint bits) {
    plane(0, 0, 0, -1), mark(body);
    glDisable(GL_CLIP_PLANE0), glStencilFunc(GL_NOTEQUAL, 0, bits), blue(), quad(-3, -3, 3, 3, 0);
    glDisable(GL_STENCIL_TEST), glEnable(GL_CLIP_PLANE0), red(), body(), glDisable(GL_CLIP_PLANE0);
}
static void cap_by_two_passes(void) { capped(count_culled, solid, ~0u); }
static void cap_by_invert(void) { capped(invert, solid, 1); }
static void cap_by_two_sides(void) { capped(count_two_sided, solid, ~0u); }
static void cap_by_extension(void) { capped(count_two_sided_by_extension, solid, ~0u); }
static void hollow(void) {
    static const float inner[2][3] = {{-.5f, -.5f, -.5f}, {.5f, .5f, .5f}};
    solid(), glFrontFace(GL_CW), box(inner), glFrontFace(GL_CCW);
}
static void cap_of_a_hollow_box(void) { capped(count_culled, hollow, ~0u); }
static void cap_beside_others(void) {
    static const float other[2][3] = {{2, -1, -1}, {3, 1, 1}};
    red(), box(other), capped(count_two_sided, solid, ~0u);
}
static void cap_askew(void) {
    plane(0, -1, 0, -1), count_culled(solid);
    glDisable(GL_CLIP_PLANE0), glStencilFunc(GL_NOTEQUAL, 0, ~0u), blue();
    glPushMatrix(), glRotatef(45, 0, 1, 0), quad(-3, -3, 3, 3, 0), glPopMatrix();
    glDisable(GL_STENCIL_TEST), glEnable(GL_CLIP_PLANE0), red(), solid(), glDisable(GL_CLIP_PLANE0);
}
/* Each cut has its own marks, and its cap is cut by the other plane. */
static void two_caps(void) {
    plane(0, 0, 0, -1), plane(1, -1, 0, 0);
    for (int i = 0; i < 2; ++i) {
        glClear(GL_STENCIL_BUFFER_BIT);
        glDisable(GL_CLIP_PLANE1 - i), glEnable(GL_CLIP_PLANE0 + i), invert(solid);
        glEnable(GL_CLIP_PLANE1 - i), glDisable(GL_CLIP_PLANE0 + i);
        glStencilFunc(GL_EQUAL, 1, 1), blue();
        glPushMatrix(), glRotatef(i ? 90 : 0, 0, 1, 0), quad(-3, -3, 3, 3, 0), glPopMatrix();
    }
    glDisable(GL_STENCIL_TEST), glEnable(GL_CLIP_PLANE0), glEnable(GL_CLIP_PLANE1), red(), solid();
    glDisable(GL_CLIP_PLANE0), glDisable(GL_CLIP_PLANE1);
}

/* A prism over a polygon, its ends filled by parity: INVERT, then a quad that resets what it fills. */
static void end_of_prism(const float (*points)[2], const int* counts, int contours, float z) {
    begin_marks(1), glStencilMask(1), glStencilOp(GL_KEEP, GL_KEEP, GL_INVERT);
    for (int c = 0, at = 0; c < contours; at += counts[c++]) {
        glBegin(GL_TRIANGLE_FAN);
        for (int k = 0; k < counts[c]; ++k) glVertex3f(points[at + k][0], points[at + k][1], z);
        glEnd();
    }
    end_marks(), glStencilFunc(GL_NOTEQUAL, 0, 1), glStencilOp(GL_ZERO, GL_ZERO, GL_ZERO);
    green(), quad(-1, -1, 1, 1, z);
    glStencilMask(~0u), glDisable(GL_STENCIL_TEST);
}
static void prism(const float (*points)[2], const int* counts, int contours) {
    red(), glBegin(GL_QUADS);
    for (int c = 0, at = 0; c < contours; at += counts[c++])
        for (int k = 0; k < counts[c]; ++k) {
            const float *a = points[at + k], *b = points[at + (k + 1) % counts[c]];
            glNormal3f(b[1] - a[1], a[0] - b[0], 0);
            glVertex3f(a[0], a[1], -1), glVertex3f(b[0], b[1], -1), glVertex3f(b[0], b[1], 1),
                glVertex3f(a[0], a[1], 1);
        }
    glEnd();
    end_of_prism(points, counts, contours, -1), end_of_prism(points, counts, contours, 1);
}
static void concave_by_parity(void) {
    static const float ell[6][2] = {{1, -1}, {1, 0}, {0, 0}, {0, 1}, {-1, 1}, {-1, -1}};
    static const int counts[] = {6};
    prism(ell, counts, 1);
}
static void holed_by_parity(void) {
    static const float frame[8][2] = {{-1, -1},     {1, -1},     {1, 1},     {-1, 1},
                                      {-.5f, -.5f}, {-.5f, .5f}, {.5f, .5f}, {.5f, -.5f}};
    static const int counts[] = {4, 4};
    prism(frame, counts, 2);
}

static void begin_seen_marks(GLint value) {
    glEnable(GL_STENCIL_TEST), glStencilFunc(GL_ALWAYS, value, ~0u),
        glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
}
static void begin_kept(GLenum function, GLint value) {
    glStencilFunc(function, value, ~0u), glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
}
static void outline(void) {
    begin_seen_marks(1), red(), solid(), begin_kept(GL_NOTEQUAL, 1), yellow(), box(hull);
}
static void outline_where_0(void) {
    begin_seen_marks(0), glStencilOp(GL_KEEP, GL_KEEP, GL_INCR), red(), solid();
    begin_kept(GL_EQUAL, 0), yellow(), box(hull);
}
static void outline_of_far_faces(void) {
    begin_seen_marks(1), red(), solid();
    glEnable(GL_CULL_FACE), glCullFace(GL_FRONT), begin_kept(GL_NOTEQUAL, 1), yellow(), box(hull),
        glDisable(GL_CULL_FACE);
}
static void outline_of_value_2(void) {
    static const float other[2][3] = {{2, -1, -1}, {3, 1, 1}};
    begin_seen_marks(1), red(), box(other), begin_seen_marks(2), solid();
    begin_kept(GL_NOTEQUAL, 2), yellow(), box(hull);
}
static void outline_before_its_body(void) {
    begin_marks(0), glStencilFunc(GL_ALWAYS, 1, ~0u), glStencilOp(GL_KEEP, GL_REPLACE, GL_REPLACE), solid(),
        end_marks();
    begin_kept(GL_NOTEQUAL, 1), yellow(), box(hull), glDisable(GL_STENCIL_TEST), red(), solid();
}
static void outline_of_marks_but_the_body(void) {
    begin_marks(0), glStencilFunc(GL_ALWAYS, 1, ~0u), glStencilOp(GL_KEEP, GL_REPLACE, GL_REPLACE), box(hull),
        end_marks();
    begin_seen_marks(2), red(), solid(), begin_kept(GL_EQUAL, 1), yellow(), box(hull);
}
static void floor_where_nothing_is(void) {
    static const float floor[2][3] = {{-2, -2, -2}, {2, 2, -1}};
    begin_seen_marks(1), red(), solid(), begin_kept(GL_NOTEQUAL, 1), red(), box(floor);
}

/* One face alone is marked. */
static void decal(void) {
    glDepthFunc(GL_LEQUAL), begin_seen_marks(2), red(), solid(), begin_seen_marks(1), quad(-1, -1, 1, 1, 1);
    begin_kept(GL_EQUAL, 1), glDisable(GL_DEPTH_TEST), green(), quad(-.5f, -.5f, 2, .5f, 1),
        glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
}
static void decal_at_equal_depth(void) {
    glDepthFunc(GL_LEQUAL), begin_seen_marks(1), red(), solid();
    begin_kept(GL_EQUAL, 1), glDepthMask(0), glEnable(GL_POLYGON_OFFSET_FILL), glPolygonOffset(-1, -1);
    green(), quad(-.5f, -.5f, 2, .5f, 1), glDisable(GL_POLYGON_OFFSET_FILL), glDepthMask(1),
        glDepthFunc(GL_LESS);
}
static void label_in_front(void) {
    begin_seen_marks(1), red(), solid();
    begin_kept(GL_EQUAL, 1), glDisable(GL_DEPTH_TEST), green(), quad(-.5f, -.5f, .5f, .5f, 2),
        glEnable(GL_DEPTH_TEST);
}
static void hole_in_a_wall(void) {
    begin_marks(1), glStencilFunc(GL_ALWAYS, 1, ~0u), glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
    quad(-1, -1, 1, 1, 0), end_marks(), begin_kept(GL_NOTEQUAL, 1), red(), quad(-2, -2, 2, 2, 0);
}
static void wall_of_four_parts(void) {
    red(), quad(-2, -2, 2, -1, 0), quad(-2, 1, 2, 2, 0), quad(-2, -1, -1, 1, 0), quad(1, -1, 2, 1, 0);
}

static void in_part_of_the_window(void) {
    glEnable(GL_SCISSOR_TEST), glScissor(0, 0, 80, 160), glClearStencil(1), glClear(GL_STENCIL_BUFFER_BIT);
    glDisable(GL_SCISSOR_TEST), glClearStencil(0);
    glEnable(GL_STENCIL_TEST), begin_kept(GL_EQUAL, 1), red(), solid();
}
/* The body again, lit, where no shadow lies; its volume reaches down from a blade above it. */
static void lit_without_shadow(void) {
    static const float shadow[2][3] = {{-.5f, -5, -.5f}, {.5f, 5, .5f}};
    glDepthFunc(GL_LEQUAL), red(), solid();
    begin_marks(1), glEnable(GL_CULL_FACE);
    glCullFace(GL_BACK), glStencilOp(GL_KEEP, GL_KEEP, GL_INCR), box(shadow);
    glCullFace(GL_FRONT), glStencilOp(GL_KEEP, GL_KEEP, GL_DECR), box(shadow);
    end_marks(), begin_kept(GL_EQUAL, 0), red(), solid(), glDepthFunc(GL_LESS);
}

static const struct Way {
    const char* name;
    void (*draw)(void);
} ways[] = {
    {"cap_by_two_passes", cap_by_two_passes},
    {"cap_by_invert", cap_by_invert},
    {"cap_by_two_sides", cap_by_two_sides},
    {"cap_by_extension", cap_by_extension},
    {"cap_of_a_hollow_box", cap_of_a_hollow_box},
    {"cap_beside_others", cap_beside_others},
    {"cap_askew", cap_askew},
    {"two_caps", two_caps},
    {"concave_by_parity", concave_by_parity},
    {"holed_by_parity", holed_by_parity},
    {"outline", outline},
    {"outline_where_0", outline_where_0},
    {"outline_of_far_faces", outline_of_far_faces},
    {"outline_of_value_2", outline_of_value_2},
    {"outline_before_its_body", outline_before_its_body},
    {"outline_of_marks_but_the_body", outline_of_marks_but_the_body},
    {"floor_where_nothing_is", floor_where_nothing_is},
    {"decal", decal},
    {"decal_at_equal_depth", decal_at_equal_depth},
    {"label_in_front", label_in_front},
    {"hole_in_a_wall", hole_in_a_wall},
    {"wall_of_four_parts", wall_of_four_parts},
    {"in_part_of_the_window", in_part_of_the_window},
    {"lit_without_shadow", lit_without_shadow},
};

int main(int argc, char** argv) {
    const char* name = argc > 1 ? argv[1] : "outline";
    const struct Way* way = 0;
    for (unsigned i = 0; i < sizeof ways / sizeof *ways; ++i)
        if (strcmp(ways[i].name, name) == 0) way = &ways[i];
    if (!way) return 2;
    stencil_size = 8;
    const Window window = make_window(160, 160);
    glXMakeCurrent(display, window, make_context(0));
    for (int frame = 0; frame < 2; ++frame) {
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
        glMatrixMode(GL_PROJECTION), glLoadIdentity(), glFrustum(-.2, .2, -.2, .2, .5, 40);
        glMatrixMode(GL_MODELVIEW), glLoadIdentity();
        glTranslatef(0, 0, -10), glRotatef(25, 1, 0, 0), glRotatef(-35, 0, 1, 0);
        glEnable(GL_DEPTH_TEST);
        way->draw();
        glDisable(GL_STENCIL_TEST);
        glXSwapBuffers(display, window);
    }
    return 0;
}
