/* The body of window.c, each of its boxes by matrices of its own: red, green, blue. argv[1] names the way in which the
 * program looks at them. */
#define GL_GLEXT_PROTOTYPES
#include <math.h>
#include <string.h>

#include "window.h"

enum { size = 160 };
static const char* way;
#define IS(name) (strcmp(way, name) == 0)

static void view(void) {
    glTranslated(0.3, -0.7, -12);
    glRotated(25, 1, 0, 0);
    glRotated(-35, 0, 1, 0);
}

/* Planes that differ from box to box. */
static double near_of(int box) { return 5.0 / (1 + 4 * box); }
static double far_of(int box) { return 20 + 30 * box; }

/* Half a frame high at distance 1. */
static void perspective(int box, double half) {
    const double n = near_of(box), h = half * n;
    glFrustum(-h, h, -h, h, n, far_of(box));
}

/* z_ndc is 1 at the near plane and -1 at no end. */
static void reversed(int box) {
    const double m[16] = {4, 0, 0, 0, 0, 4, 0, 0, 0, 0, 1, -1, 0, 0, 2 * near_of(box), 0};
    glMultMatrixd(m);
}

/* z goes into the screen. */
static void left_handed(int box) {
    const double n = near_of(box), f = far_of(box);
    const double m[16] = {4, 0, 0, 0, 0, 4, 0, 0, 0, 0, (f + n) / (f - n), 1, 0, 0, -2 * f * n / (f - n), 0};
    glMultMatrixd(m);
    glScaled(1, 1, -1);
}

static void colour(int box) { glColor3f(box == 0, box == 1, box == 2); }

static void draw(int box) {
    colour(box);
    draw_box(chiral_boxes[box][0], chiral_boxes[box][1]);
}

/* projection and modelview as one, for what is drawn next. */
static void product(double* m) {
    double p[16], v[16];
    glGetDoublev(GL_PROJECTION_MATRIX, p);
    glGetDoublev(GL_MODELVIEW_MATRIX, v);
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r) {
            m[4 * c + r] = 0;
            for (int k = 0; k < 4; ++k) m[4 * c + r] += p[4 * k + r] * v[4 * c + k];
        }
}

/* A plane in eye space that cuts nothing of this box, and would cut all in another box's space. */
static void keep_with_a_plane(int box) {
    const double plane[4] = {0, 0, -1, chiral_boxes[box][1][2] - chiral_boxes[box][0][2] + 0.01};
    glClipPlane(GL_CLIP_PLANE0, plane);
    glEnable(GL_CLIP_PLANE0);
}

/* The box at its corner, of its own size or of size 1 and scaled. */
static void whole_matrix(int box, int scaled) {
    const float *lo = chiral_boxes[box][0], *hi = chiral_boxes[box][1], zero[3] = {0, 0, 0}, one[3] = {1, 1, 1};
    const float edges[3] = {hi[0] - lo[0], hi[1] - lo[1], hi[2] - lo[2]};
    double m[16];
    glTranslatef(lo[0], lo[1], lo[2]);
    if (scaled) glScalef(edges[0], edges[1], edges[2]);
    product(m);
    glMatrixMode(GL_PROJECTION);
    glLoadMatrixd(m);
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    if (IS("clipped_whole")) keep_with_a_plane(box);
    colour(box);
    draw_box(zero, scaled ? one : edges);
}

/* Corners that the program has taken to clip space. `bend`: depths that no projection makes. */
static void clip_positions(int box, int arrays, int bend) {
    double m[16];
    float corners[24][4];
    int count = 0;
    product(m);
    for (int a = 0; a < 3; ++a)
        for (int side = 0; side < 2; ++side)
            for (int k = 0; k < 4; ++k) {
                const int q = side ? k : 3 - k, b = (a + 1) % 3, c = (a + 2) % 3;
                double x[4] = {0, 0, 0, 1};
                x[a] = chiral_boxes[box][side][a];
                x[b] = chiral_boxes[box][q == 1 || q == 2][b];
                x[c] = chiral_boxes[box][q >= 2][c];
                for (int r = 0; r < 4; ++r) {
                    corners[count][r] = 0;
                    for (int j = 0; j < 4; ++j) corners[count][r] += m[4 * j + r] * x[j];
                }
                if (bend) corners[count][2] = 0.01 * x[0] * x[1];
                ++count;
            }
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    colour(box);
    glVertexPointer(4, GL_FLOAT, 0, corners);
    arrays ? glEnableClientState(GL_VERTEX_ARRAY) : glDisableClientState(GL_VERTEX_ARRAY);
    if (arrays) {
        glDrawArrays(GL_QUADS, 0, count);
        return;
    }
    glBegin(GL_QUADS);
    for (int i = 0; i < count; ++i) glVertex4fv(corners[i]);
    glEnd();
}

static void draw_under(int box) {
    const int in_modelview = IS("ortho_in_modelview") || IS("frustum_in_modelview");
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    if (in_modelview) glMatrixMode(GL_MODELVIEW), glLoadIdentity();
    if (IS("upside_down_blit") || IS("upside_down_quad") || IS("upside_down_unseen")) glScalef(1, -1, 1);
    if (IS("ortho_in_modelview"))
        glOrtho(-4, 4, -4, 4, 2, 40);
    else if (IS("parallel_planes") || IS("parallel_whole"))
        glOrtho(-4, 4, -4, 4, near_of(IS("parallel_whole") ? 2 : box), far_of(IS("parallel_whole") ? 0 : box));
    else if (IS("reversed"))
        reversed(box);
    else if (IS("left_handed"))
        left_handed(box);
    else if (IS("frustum_in_modelview"))
        perspective(0, 0.25);
    else
        perspective(IS("one_projection") || IS("one_cleared") || IS("stretched_whole") || IS("own_view") ? 0 : box,
                    IS("own_view") && box == 2 ? 0.5 : 0.25);
    if (IS("view_in_projection")) view();
    if (!in_modelview) glMatrixMode(GL_MODELVIEW), glLoadIdentity();
    if (!IS("view_in_projection")) view();
    if (IS("whole_matrix") || IS("parallel_whole")) return whole_matrix(box, 0);
    if (IS("stretched_whole")) return whole_matrix(box, 1);
    if (IS("clipped_whole")) return whole_matrix(box, 0);
    if (IS("clip_positions")) return clip_positions(box, 0, 0);
    if (IS("clip_arrays")) return clip_positions(box, 1, 0);
    if (IS("bent_positions")) return clip_positions(box, 0, 1);
    draw(box);
}

static GLuint framebuffer, texture;

static void make_framebuffer(void) {
    GLuint depth;
    glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, size, size, 0, GL_RGBA, GL_UNSIGNED_BYTE, 0);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glGenFramebuffers(1, &framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glGenRenderbuffers(1, &depth);
    glBindRenderbuffer(GL_RENDERBUFFER, depth);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, size, size);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
}

static void show_upside_down(void) {
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    if (IS("upside_down_blit")) {
        glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
        glBlitFramebuffer(0, 0, size, size, 0, size, size, 0, GL_COLOR_BUFFER_BIT, GL_NEAREST);
        glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
    }
    if (!IS("upside_down_quad")) return;
    glMatrixMode(GL_PROJECTION), glLoadIdentity();
    glMatrixMode(GL_MODELVIEW), glLoadIdentity();
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_TEXTURE_2D);
    glColor3f(1, 1, 1);
    glBegin(GL_QUADS);
    for (int k = 0; k < 4; ++k) {
        const int x = k == 1 || k == 2, y = k >= 2;
        glTexCoord2i(x, !y);
        glVertex2i(2 * x - 1, 2 * y - 1);
    }
    glEnd();
    glDisable(GL_TEXTURE_2D);
}

int main(int argc, char** argv) {
    way = argc > 1 ? argv[1] : "one_projection";
    const Window window = make_window(size, size);
    GLXContext context = make_context(0);
    glXMakeCurrent(display, window, context);
    const int offscreen = strncmp(way, "upside_down", 11) == 0;
    if (offscreen) make_framebuffer();
    if (IS("reversed")) glClearDepth(0), glDepthFunc(GL_GREATER);
    for (int frame = 0; frame < 2; ++frame) {
        if (offscreen) glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
        glEnable(GL_DEPTH_TEST);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        for (int box = 0; box < 3; ++box) {
            draw_under(box);
            if (!IS("one_projection")) glClear(GL_DEPTH_BUFFER_BIT);
        }
        if (IS("decal")) {
            double p[16];
            glMatrixMode(GL_PROJECTION);
            glGetDoublev(GL_PROJECTION_MATRIX, p);
            p[10] += 2e-4;
            glLoadMatrixd(p);
            glMatrixMode(GL_MODELVIEW);
            glColor3f(1, 1, 0);
            glRectd(0.25, 0.25, 0.75, 0.75);
        }
        if (offscreen) show_upside_down();
        glXSwapBuffers(display, window);
    }
    return 0;
}
