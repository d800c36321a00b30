/* One odd body, and the ways in which programs set up view and model: the cast must have the model's own axes, and
 * never be mirrored against the screen. argv[1] names the way. */
#include <math.h>
#include <string.h>

#include "window.h"

static void look_at(void) { /* gluLookAt(6, 5, 8, 1, 1, 1, 0, 1, 0) */
    const double eye[3] = {6, 5, 8}, f0[3] = {-5, -4, -7};
    const double fl = sqrt(25 + 16 + 49.0), f[3] = {f0[0] / fl, f0[1] / fl, f0[2] / fl};
    const double sl = sqrt(f[2] * f[2] + f[0] * f[0]), s[3] = {-f[2] / sl, 0, f[0] / sl};
    const double u[3] = {s[1] * f[2] - s[2] * f[1], s[2] * f[0] - s[0] * f[2], s[0] * f[1] - s[1] * f[0]};
    const double m[16] = {s[0], u[0], -f[0], 0, s[1], u[1], -f[1], 0, s[2], u[2], -f[2], 0, 0, 0, 0, 1};
    glMultMatrixd(m);
    glTranslated(-eye[0], -eye[1], -eye[2]);
}

static void model(void) {
    glTranslatef(0.5f, 0, 0);
    glRotatef(25, 0.3f, 1, 0.2f);
}

/* What another graphics system would call a perspective: z goes into the screen. */
static void left_handed_projection(void) {
    const float n = 1, f = 40, m[16] = {n, 0, 0, 0, 0, n, 0, 0, 0, 0, (f + n) / (f - n), 1, 0, 0, -2 * f * n / (f - n), 0};
    glMultMatrixf(m);
}

static void set_view(const char* way) {
#define IS(name) (strcmp(way, name) == 0)
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    if (IS("mirrored_projection")) glScalef(-1, 1, 1);
    if (IS("left_handed"))
        left_handed_projection();
    else
        glFrustum(-1, 1, -1, 1, 1, 40);
    if (IS("view_in_projection")) look_at();
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    if (IS("look_at_pushed")) glPushMatrix();
    if (IS("look_at") || IS("look_at_pushed") || IS("mirrored_projection")) look_at();
    if (IS("look_at")) glPushMatrix();
    if (IS("own_product")) { /* view times model, loaded as one */
        double product[16];
        glPushMatrix();
        look_at();
        model();
        glGetDoublev(GL_MODELVIEW_MATRIX, product);
        glPopMatrix();
        glLoadMatrixd(product);
    }
    if (IS("view_in_projection")) model();
    if (IS("stretched")) { /* the same size in space, from a model that is squeezed */
        look_at();
        model();
        glScalef(1, 2, 0.5f);
    }
    if (IS("mirrored_modelview")) {
        look_at();
        glScalef(1, 1, -1);
    }
    if (IS("left_handed")) {
        glTranslatef(-1, -1, 8);
        glRotatef(40, 0, 1, 0);
    }
}

int main(int argc, char** argv) {
    const char* way = argc > 1 ? argv[1] : "look_at";
    const Window window = make_window(160, 160);
    GLXContext context = make_context(0);
    glXMakeCurrent(display, window, context);
    for (int frame = 0; frame < 2; ++frame) {
        glEnable(GL_DEPTH_TEST);
        glEnable(GL_LIGHTING);
        glEnable(GL_LIGHT0);
        glEnable(GL_NORMALIZE);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        set_view(way);
        draw_chiral();
        glMatrixMode(GL_MODELVIEW);
        if (strcmp(way, "look_at_pushed") == 0 || strcmp(way, "look_at") == 0) glPopMatrix();
        glXSwapBuffers(display, window);
    }
    return 0;
}
