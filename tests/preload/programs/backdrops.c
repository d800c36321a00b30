/* The body of window.c, 3 wide, before or in something large. argv[1] names what: backdrops, and what is
 * none. */
#include <math.h>
#include <string.h>

#include "window.h"

enum { size = 200, strips = 12, sectors = 24 };
static const char* way;
#define IS(name) (strcmp(way, name) == 0)
#define PI 3.14159265358979

static void quad(const float corners[4][3]) {
    static const float st[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    glBegin(GL_QUADS);
    for (int i = 0; i < 4; ++i) glTexCoord2fv(st[i]), glVertex3fv(corners[i]);
    glEnd();
}

/* Parallel to an axis, at a place on it. */
static void plane(int axis, float at, float half) {
    float corners[4][3];
    for (int i = 0; i < 4; ++i) {
        corners[i][axis] = at;
        corners[i][(axis + 1) % 3] = i == 1 || i == 2 ? half : -half;
        corners[i][(axis + 2) % 3] = i >= 2 ? half : -half;
    }
    quad(corners);
}

/* Each face a draw of its own, as each has its own picture. */
static void six_planes(float half) {
    for (int i = 0; i < 6; ++i) {
        glColor3f(.2f, .3f + .1f * i, 1);
        plane(i / 2, i % 2 ? half : -half, half);
    }
}

/* With the body on its floor and the eye in it. */
static void room(void) {
    static const float lo[3] = {-6, 0, -3}, hi[3] = {7, 6.5f, 12};
    draw_box(lo, hi);
}

static void dome(float radius, int from) {
    for (int j = from; j < strips; ++j) {
        glBegin(GL_QUAD_STRIP);
        for (int i = 0; i <= sectors; ++i)
            for (int k = 0; k < 2; ++k) {
                const double a = PI * ((j + k) / (double)strips - .5), b = 2 * PI * i / sectors;
                glColor3f(.2f, .3f + .05f * j, 1);
                glTexCoord2d(a, b);
                glVertex3d(radius * cos(a) * cos(b), radius * sin(a), radius * cos(a) * sin(b));
            }
        glEnd();
    }
}

static void relief(float half) {
    enum { n = 20 };
    for (int j = 0; j < n; ++j) {
        glBegin(GL_TRIANGLE_STRIP);
        for (int i = 0; i <= n; ++i)
            for (int k = 0; k < 2; ++k) {
                const double x = half * (2.0 * i / n - 1), z = half * (2.0 * (j + k) / n - 1);
                glVertex3d(x, -8 + 8 * cos(x / 6) * cos(z / 6), z);
            }
        glEnd();
    }
}

static void lattice_of_walls(float half) {
    for (int i = -3; i <= 3; ++i) plane(0, half * i / 3, half), plane(2, half * i / 3, half);
}

static void picture_on(int on) {
    static const unsigned char texels[2][2][4] = {{{90, 90, 255, 255}, {80, 80, 255, 255}},
                                                  {{90, 90, 255, 255}, {80, 80, 255, 255}}};
    if (!on) return glDisable(GL_TEXTURE_2D);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 2, 2, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glEnable(GL_TEXTURE_2D);
}

/* Under the view; the eye is at 0 0 0 of `in_eye_space`. */
static void before(void) {
    glColor3f(0, 0, 1);
    if (IS("floor")) plane(1, 0, 15);
    if (IS("vast_floor")) plane(1, 0, 150);
    if (IS("room")) room();
    if (IS("relief")) relief(40);
    if (IS("walls")) lattice_of_walls(40);
    glPushMatrix();
    glLoadIdentity();
    if (IS("sky_box")) picture_on(1), six_planes(60), picture_on(0);
    if (IS("plain_sky_box")) six_planes(30);
    if (IS("near_sky_box")) picture_on(1), six_planes(13), picture_on(0);
    if (IS("dome")) dome(60, 0);
    if (IS("half_dome")) dome(60, strips / 2 - 1);
    if (IS("sky_plane")) plane(1, 25, 100);
    if (IS("photograph")) plane(2, -40, 30);
    if (IS("pinned")) glDepthRange(1, 1), six_planes(3), glDepthRange(0, 1);
    if (IS("masked")) glDepthMask(GL_FALSE), plane(2, -30, 20), glDepthMask(GL_TRUE);
    if (IS("untested")) glDisable(GL_DEPTH_TEST), plane(2, -30, 20), glEnable(GL_DEPTH_TEST);
    glPopMatrix();
    if (IS("dome_and_ground")) {
        glPushMatrix();
        glLoadIdentity();
        picture_on(1), dome(40, strips / 2 - 1), picture_on(0);
        glPopMatrix();
        glColor3f(0, 1, 0);
        plane(1, 0, 15);
    }
}

/* Some backdrops are drawn last. */
static void after(void) {
    glPushMatrix();
    glLoadIdentity();
    if (IS("last")) six_planes(60);
    if (IS("far_body")) glTranslatef(0, 0, -60), draw_chiral();
    glPopMatrix();
}

int main(int argc, char** argv) {
    way = argc > 1 ? argv[1] : "";
    const Window window = make_window(size, size);
    glXMakeCurrent(display, window, make_context(NULL));
    for (int frame = 0; frame < 3; ++frame) {
        glViewport(0, 0, size, size);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        glEnable(GL_DEPTH_TEST);
        glMatrixMode(GL_PROJECTION);
        glLoadIdentity();
        glFrustum(-.5, .5, -.5, .5, 1, 400);
        glMatrixMode(GL_MODELVIEW);
        glLoadIdentity();
        glTranslatef(-1, -1, -10);
        glRotatef(20, 1, 0, 0);
        before();
        if (!IS("alone")) draw_chiral();
        if (IS("alone")) six_planes(60);
        after();
        glXSwapBuffers(display, window);
    }
    return 0;
}
