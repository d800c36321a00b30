/* What culling makes of a picture: outlines about a red box, rooms with red furniture, and the eye inside or
 * outside. argv[1] is outline or room, argv[2] names the way. Walls are blue, outlines black or yellow. */
#include <math.h>
#include <string.h>

#include "window.h"

enum { size = 200, strips = 16, sectors = 32 };
static const char* way;
#define IS(name) (strcmp(way, name) == 0)
#define PI 3.14159265358979

static void box(double x0, double y0, double z0, double x1, double y1, double z1) {
    const float lo[3] = {x0, y0, z0}, hi[3] = {x1, y1, z1};
    draw_box(lo, hi);
}
static void cube(double half) { box(-half, -half, -half, half, half, half); }

/* Counter-clockwise from outside. */
static void ball(double radius) {
    for (int j = 0; j < strips; ++j) {
        glBegin(GL_QUAD_STRIP);
        for (int i = 0; i <= sectors; ++i)
            for (int k = 1; k >= 0; --k) {
                const double a = PI * ((j + k) / (double)strips - .5), b = 2 * PI * i / sectors;
                glVertex3d(radius * cos(a) * sin(b), radius * sin(a), radius * cos(a) * cos(b));
            }
        glEnd();
    }
}

static void red(void) { glColor3f(1, 0, 0); }
static void blue(void) { glColor3f(0, 0, 1); }
static void black(void) { glColor3f(0, 0, 0); }
static void cull(GLenum faces) { glEnable(GL_CULL_FACE), glCullFace(faces); }

static void from_outside(double distance) {
    glFrustum(-.2, .2, -.2, .2, 1, 100);
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    glTranslated(0, 0, -distance);
    glRotated(25, 1, 0, 0);
    glRotated(-35, 0, 1, 0);
}
/* The eye at 1.3 0 1.5, looking along -x -z. */
static void from_inside(void) {
    glFrustum(-.1, .1, -.1, .1, .1, 100);
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    glRotated(-40, 0, 1, 0);
    glTranslated(-1.3, 0, -1.5);
}

static void outlined(void) {
    from_outside(14);
    cull(GL_BACK);
    if (IS("drawn_first")) black(), cull(GL_FRONT), cube(1.1), cull(GL_BACK);
    if (IS("other_way_round")) glFrontFace(GL_CW), black(), cube(1.1), glFrontFace(GL_CCW);
    red();
    if (IS("round"))
        ball(1);
    else
        cube(1);
    if (IS("far_faces")) black(), cull(GL_FRONT), cube(1.1);
    if (IS("round")) black(), cull(GL_FRONT), ball(1.06);
    if (IS("halo")) glColor3f(1, 1, 0), cull(GL_FRONT), cube(1.25);
    if (IS("halo_without_depth"))
        glColor3f(1, 1, 0), cull(GL_FRONT), glDepthMask(0), cube(1.2), glDepthMask(1);
    if (IS("lines"))
        black(), cull(GL_FRONT), glPolygonMode(GL_BACK, GL_LINE), glDepthFunc(GL_LEQUAL), cube(1);
    if (IS("same_faces")) black(), cull(GL_FRONT), glDepthFunc(GL_LEQUAL), cube(1);
    if (IS("nothing_shown")) black(), cull(GL_FRONT_AND_BACK), cube(1.5);
    if (IS("solid")) cube(.5);
    if (IS("solid_on_floor")) blue(), box(-4, -1.2, -4, 4, -1, 4);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    glDepthFunc(GL_LESS);
}

static void walls(void) { box(-2, -1.5, -2, 2, 1.5, 2); }
static void furniture(void) { red(), box(-.5, -1.5, -.5, .5, -.5, .5); }

/* Two rooms and a door between them, walls of no thickness. */
static void two_rooms(void) {
    const float x[2][2] = {{-2, 2}, {-6, -2}};
    for (int room = 0; room < 2; ++room) {
        glBegin(GL_QUADS);
        for (int end = 0; end < 2; ++end)
            for (int k = 0; k < 2; ++k) {
                const double at = end ? 2 : -2, y = end ? 1.5 : -1.5, c = k ? y : at;
                const int up = k ? 2 : 1; /* walls along x, then floor and ceiling */
                const double h = k ? 2 : 1.5;
                for (int i = 0; i < 4; ++i) {
                    double v[3];
                    v[0] = x[room][i == 1 || i == 2];
                    v[up] = i >= 2 ? h : -h;
                    v[k ? 1 : 2] = c;
                    glVertex3dv(v);
                }
            }
        glEnd();
    }
    glBegin(GL_QUADS);
    for (int end = 0; end < 2; ++end)
        for (int i = 0; i < 4; ++i) glVertex3d(end ? 2 : -6, i >= 2 ? 1.5 : -1.5, i == 1 || i == 2 ? 2 : -2);
    /* the door is 1 wide and 2 high */
    const double parts[3][4] = {{-2, -.5, -1.5, 1.5}, {.5, 2, -1.5, 1.5}, {-.5, .5, .5, 1.5}};
    for (int part = 0; part < 3; ++part)
        for (int i = 0; i < 4; ++i)
            glVertex3d(-2, parts[part][i >= 2 ? 3 : 2], parts[part][i == 1 || i == 2]);
    glEnd();
}

static void room(void) {
    if (IS("culled_from_outside")) {
        from_outside(12);
        blue(), cull(GL_FRONT), walls(), cull(GL_BACK), furniture();
    } else if (IS("clockwise_from_outside")) {
        from_outside(12);
        blue(), cull(GL_BACK), glFrontFace(GL_CW), walls(), glFrontFace(GL_CCW), furniture();
    } else {
        from_inside();
        blue();
        if (IS("cavern"))
            ball(2.8);
        else if (IS("two_rooms"))
            two_rooms();
        else if (IS("culled_room"))
            cull(GL_FRONT), walls(), cull(GL_BACK);
        else
            walls();
        if (IS("cavern"))
            red(), box(-.5, -2, -.5, .5, -1, .5);
        else
            furniture();
        if (IS("two_rooms")) red(), box(-4.5, -1.5, -.5, -3.5, -.5, .5);
    }
}

int main(int argc, char** argv) {
    way = argc > 2 ? argv[2] : "";
    const Window window = make_window(size, size);
    glXMakeCurrent(display, window, make_context(NULL));
    for (int frame = 0; frame < 3; ++frame) {
        glViewport(0, 0, size, size);
        glClearColor(.5f, .6f, .7f, 1);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        glEnable(GL_DEPTH_TEST);
        glDisable(GL_CULL_FACE);
        glMatrixMode(GL_PROJECTION);
        glLoadIdentity();
        if (argc > 1 && strcmp(argv[1], "outline") == 0)
            outlined();
        else
            room();
        glXSwapBuffers(display, window);
    }
    return 0;
}
