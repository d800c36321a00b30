/* Sheets that look different from their two sides; argv[1] names the way. Fronts are red, backs green. */
#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>
#include <math.h>
#include <string.h>

#include "window.h"

static const float red[4] = {1, 0, 0, 1}, green[4] = {0, 1, 0, 1};

/* 2 x 2, at some x, its front to +x, or turned round. */
static void plate(float x, int turned) {
    static const float y[4] = {-1, -1, 1, 1}, z[4] = {-1, 1, 1, -1};
    glBegin(GL_QUADS), glNormal3f(turned ? -1 : 1, 0, 0);
    for (int k = 0; k < 4; ++k) {
        const int corner = turned ? k : 3 - k;
        glVertex3f(x, y[corner], z[corner]);
    }
    glEnd();
}
static void two_plates(void) { plate(-1, 1), plate(1, 0); }
static void four_plates(void) { plate(-1.5f, 1), plate(-.5f, 0), plate(.5f, 1), plate(1.5f, 0); }

/* A quarter of a cylinder, radius 2, length 4, front outwards. */
static void bent_sheet(void) {
    enum { parts = 24 };
    glBegin(GL_QUAD_STRIP);
    for (int k = 0; k <= parts; ++k) {
        const float angle = (float)(M_PI / 2 * k / parts), c = cosf(angle), s = sinf(angle);
        glNormal3f(c, s, 0), glVertex3f(2 * c, 2 * s, 2), glVertex3f(2 * c, 2 * s, -2);
    }
    glEnd();
}

/* Without its side towards +z. */
static void open_box(void) {
    static const float corners[5][4][3] = {{{-1, -1, -1}, {-1, -1, 1}, {-1, 1, 1}, {-1, 1, -1}},
                                           {{1, -1, -1}, {1, 1, -1}, {1, 1, 1}, {1, -1, 1}},
                                           {{-1, -1, -1}, {1, -1, -1}, {1, -1, 1}, {-1, -1, 1}},
                                           {{-1, 1, -1}, {-1, 1, 1}, {1, 1, 1}, {1, 1, -1}},
                                           {{-1, -1, -1}, {-1, 1, -1}, {1, 1, -1}, {1, -1, -1}}};
    static const float normals[5][3] = {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}};
    glBegin(GL_QUADS);
    for (int face = 0; face < 5; ++face) {
        glNormal3fv(normals[face]);
        for (int k = 0; k < 4; ++k) glVertex3fv(corners[face][k]);
    }
    glEnd();
}

static void light(void) {
    glEnable(GL_LIGHTING), glEnable(GL_LIGHT0), glLightModeli(GL_LIGHT_MODEL_TWO_SIDE, GL_TRUE);
}
static void by_materials(void (*sheet)(void)) {
    light(), glMaterialfv(GL_FRONT, GL_AMBIENT_AND_DIFFUSE, red),
        glMaterialfv(GL_BACK, GL_AMBIENT_AND_DIFFUSE, green);
    sheet();
}
/* Fronts by glColor, backs by a material. */
static void by_colour_material(void (*sheet)(void)) {
    light(), glColorMaterial(GL_FRONT, GL_AMBIENT_AND_DIFFUSE), glEnable(GL_COLOR_MATERIAL), glColor4fv(red);
    glMaterialfv(GL_BACK, GL_AMBIENT_AND_DIFFUSE, green), sheet();
}
static void by_two_passes(void (*sheet)(void)) {
    glEnable(GL_CULL_FACE), glCullFace(GL_BACK), glColor4fv(red), sheet();
    glCullFace(GL_FRONT), glColor4fv(green), sheet(), glDisable(GL_CULL_FACE);
}
static void in_one_colour(void (*sheet)(void)) {
    light(), glMaterialfv(GL_FRONT_AND_BACK, GL_AMBIENT_AND_DIFFUSE, red), sheet();
}
static void lit_as_fronts(void (*sheet)(void)) {
    light(), glLightModeli(GL_LIGHT_MODEL_TWO_SIDE, GL_FALSE);
    glMaterialfv(GL_FRONT_AND_BACK, GL_AMBIENT_AND_DIFFUSE, red), sheet();
}
/* Above, lit on both sides; below, lit as fronts. */
static void two_of_each(void (*sheet)(void)) {
    glPushMatrix(), glTranslatef(0, 1.5f, 0), in_one_colour(sheet);
    glTranslatef(0, -3, 0), lit_as_fronts(sheet), glPopMatrix();
}

static const struct Way {
    const char* name;
    void (*colours)(void (*)(void));
    void (*sheet)(void);
} ways[] = {
    {"plates", by_materials, two_plates},
    {"plates_by_colour_material", by_colour_material, two_plates},
    {"plates_by_two_passes", by_two_passes, two_plates},
    {"four_plates", by_materials, four_plates},
    {"four_plates_by_two_passes", by_two_passes, four_plates},
    {"bent_sheet", by_materials, bent_sheet},
    {"bent_sheet_by_two_passes", by_two_passes, bent_sheet},
    {"open_box", by_materials, open_box},
    {"open_box_by_two_passes", by_two_passes, open_box},
    {"four_plates_in_one_colour", in_one_colour, four_plates},
    {"bent_sheet_in_one_colour", in_one_colour, bent_sheet},
    {"open_box_in_one_colour", in_one_colour, open_box},
    {"plates_lit_as_fronts", lit_as_fronts, four_plates},
    {"two_of_each", two_of_each, two_plates},
};

int main(int argc, char** argv) {
    const char* name = argc > 1 ? argv[1] : "plates";
    const struct Way* way = 0;
    for (unsigned i = 0; i < sizeof ways / sizeof *ways; ++i)
        if (strcmp(ways[i].name, name) == 0) way = &ways[i];
    if (!way) return 2;
    const Window window = make_window(160, 160);
    glXMakeCurrent(display, window, make_context(0));
    for (int frame = 0; frame < 2; ++frame) {
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        glMatrixMode(GL_PROJECTION), glLoadIdentity(), glFrustum(-.2, .2, -.2, .2, .5, 40);
        glMatrixMode(GL_MODELVIEW), glLoadIdentity();
        glTranslatef(0, 0, -14), glRotatef(25, 1, 0, 0), glRotatef(-35, 0, 1, 0);
        glEnable(GL_DEPTH_TEST);
        way->colours(way->sheet);
        glXSwapBuffers(display, window);
    }
    return 0;
}
