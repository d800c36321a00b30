/* Faces that nobody sees, and what is drawn over or under them: hidden WAY. The body is that of chiral.h. */
#define GL_GLEXT_PROTOTYPES
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "window.h"

static Window window;

static void mask(GLboolean on) { glColorMask(on, on, on, on); }

static void outlines(void) {
    glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
    glColor3f(1, 1, 1);
    draw_chiral();
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
}

static void edges_in_that_colour(void) {
    glBegin(GL_LINES);
    for (int box = 0; box < 3; ++box)
        for (int edge = 0; edge < 12; ++edge) {
            const int along = edge % 3, a = (along + 1) % 3, b = (along + 2) % 3;
            float from[3], to[3];
            from[a] = to[a] = chiral_boxes[box][edge / 3 & 1][a];
            from[b] = to[b] = chiral_boxes[box][edge / 6][b];
            from[along] = chiral_boxes[box][0][along], to[along] = chiral_boxes[box][1][along];
            glVertex3fv(from), glVertex3fv(to);
        }
    glEnd();
}

static void edges(void) {
    glColor3f(1, 1, 1);
    edges_in_that_colour();
}

static void behind(void (*faces)(void)) {
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(1, 1);
    mask(GL_FALSE);
    faces();
    mask(GL_TRUE);
    glDisable(GL_POLYGON_OFFSET_FILL);
}

static void mask_and_outlines(void) { behind(draw_chiral), outlines(); }
static void mask_and_lines(void) { behind(draw_chiral), edges(); }
/* No offset: lines pass where the depth is equal. */
static void equal_and_lines(void) {
    mask(GL_FALSE);
    draw_chiral();
    mask(GL_TRUE);
    glDepthFunc(GL_LEQUAL);
    outlines();
    glDepthFunc(GL_LESS);
}
static void lit_and_textured(void) {
    static GLuint texture;
    const unsigned char red[] = {255, 0, 0, 255};
    if (!texture) {
        glGenTextures(1, &texture);
        glBindTexture(GL_TEXTURE_2D, texture);
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 1, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, red);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    }
    glEnable(GL_TEXTURE_2D), glEnable(GL_LIGHTING), glEnable(GL_LIGHT0);
    behind(draw_chiral);
    glDisable(GL_TEXTURE_2D), glDisable(GL_LIGHTING);
    edges();
}
/* The colours of vertices, in arrays. */
static void coloured_arrays(void) {
    static float vertices[72 * 3], colours[72 * 3];
    int count = 0;
    for (int box = 0; box < 3; ++box)
        for (int axis = 0; axis < 3; ++axis)
            for (int side = 0; side < 2; ++side)
                for (int corner = 0; corner < 4; ++corner, ++count) {
                    const int a = (axis + 1) % 3, b = (axis + 2) % 3, k = side ? corner : 3 - corner;
                    vertices[3 * count + axis] = chiral_boxes[box][side][axis];
                    vertices[3 * count + a] = chiral_boxes[box][k == 1 || k == 2][a];
                    vertices[3 * count + b] = chiral_boxes[box][k >= 2][b];
                    colours[3 * count + axis] = 1;
                }
    glEnableClientState(GL_VERTEX_ARRAY), glEnableClientState(GL_COLOR_ARRAY);
    glVertexPointer(3, GL_FLOAT, 0, vertices), glColorPointer(3, GL_FLOAT, 0, colours);
    glDrawArrays(GL_QUADS, 0, count);
    glDisableClientState(GL_VERTEX_ARRAY), glDisableClientState(GL_COLOR_ARRAY);
}
static void arrays_and_lines(void) { behind(coloured_arrays), edges(); }
static void red_in_between(void) {
    for (int box = 0; box < 3; ++box) {
        glBegin(GL_QUADS);
        glColor3f(1, 0, 0);
        glEnd();
        draw_box(chiral_boxes[box][0], chiral_boxes[box][1]);
    }
}
static void colours_and_lines(void) { behind(red_in_between), edges(); }
/* First the depths, then colours where these are equal: the faces are seen. */
static void depth_first(void) {
    mask(GL_FALSE);
    draw_chiral();
    mask(GL_TRUE);
    glDepthFunc(GL_EQUAL);
    glColor3f(1, 0.5f, 0);
    draw_chiral();
    glDepthFunc(GL_LEQUAL);
    edges();
    glDepthFunc(GL_LESS);
}
/* The same by glDrawBuffer. */
static void mask_buffer(GLboolean on) { glDrawBuffer(on ? GL_BACK : GL_NONE); }
static void no_buffer_and_lines(void) {
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(1, 1);
    mask_buffer(GL_FALSE);
    draw_chiral();
    mask_buffer(GL_TRUE);
    glDisable(GL_POLYGON_OFFSET_FILL);
    edges();
}
static void depth_first_no_buffer(void) {
    mask_buffer(GL_FALSE);
    draw_chiral();
    mask_buffer(GL_TRUE);
    glDepthFunc(GL_LEQUAL);
    glColor3f(1, 0.5f, 0);
    draw_chiral();
    glDepthFunc(GL_LESS);
}
/* A box that only hides what is behind it, beside the body. */
static void box_beside(void (*hide)(GLboolean on)) {
    const float lo[3] = {1.2f, 1.2f, 1}, hi[3] = {1.8f, 1.8f, 4};
    hide(GL_FALSE);
    draw_box(lo, hi);
    hide(GL_TRUE);
    glDepthFunc(GL_LEQUAL); /* as many have it always */
    glColor3f(1, 0.5f, 0);
    draw_chiral();
    glDepthFunc(GL_LESS);
}
static void mask_beside(void) { box_beside(mask); }
static void no_buffer_beside(void) { box_beside(mask_buffer); }
/* Lines, and faces that write no depth, have the colour that the last vertex of the hidden faces left. */
static void colour_left(void) {
    glColor3f(1, 1, 1);
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(1, 1);
    mask(GL_FALSE);
    for (int box = 0; box < 3; ++box) {
        draw_box(chiral_boxes[box][0], chiral_boxes[box][1]);
        glBegin(GL_TRIANGLES);
        for (int corner = 0; corner < 3; ++corner) {
            glVertex3fv(chiral_boxes[box][0]);
            glColor3f(1, 0, 0);
        }
        glEnd();
    }
    mask(GL_TRUE);
    glDisable(GL_POLYGON_OFFSET_FILL);
    edges_in_that_colour();
    glDepthMask(GL_FALSE), glDepthFunc(GL_LEQUAL);
    draw_chiral();
    glDepthMask(GL_TRUE), glDepthFunc(GL_LESS);
}
static void mask_alone(void) { behind(draw_chiral); }

static GLuint program(void) {
    const char* text = "void main() { gl_FragColor = vec4(1, 0, 0, 1); }";
    const GLuint shader = glCreateShader(GL_FRAGMENT_SHADER), made = glCreateProgram();
    glShaderSource(shader, 1, &text, 0);
    glCompileShader(shader);
    glAttachShader(made, shader);
    glLinkProgram(made);
    return made;
}
/* Display lists under a GLSL program, and lines with none. */
static void shaded_list(void) {
    static GLuint list, outer, made;
    if (!list) {
        made = program();
        glNewList(list = glGenLists(2), GL_COMPILE), draw_chiral(), glEndList();
        glNewList(outer = list + 1, GL_COMPILE), glCallList(list), glEndList();
    }
    glUseProgram(made);
    glCallList(list), glCallList(outer);
    glUseProgram(0);
    edges();
}
/* The list itself chooses the program. */
static void shading_list(void) {
    static GLuint list;
    if (!list) {
        const GLuint made = program();
        glNewList(list = glGenLists(1), GL_COMPILE);
        glUseProgram(made), draw_chiral(), glUseProgram(0);
        glEndList();
    }
    glCallList(list);
    edges();
}

static const struct {
    const char* name;
    void (*draw)(void);
} ways[] = {
    {"mask-outlines", mask_and_outlines},
    {"mask-lines", mask_and_lines},
    {"equal-outlines", equal_and_lines},
    {"lit-textured", lit_and_textured},
    {"arrays-lines", arrays_and_lines},
    {"colours-lines", colours_and_lines},
    {"depth-first", depth_first},
    {"mask-alone", mask_alone},
    {"no-buffer-lines", no_buffer_and_lines},
    {"no-buffer-first", depth_first_no_buffer},
    {"mask-beside", mask_beside},
    {"no-buffer-beside", no_buffer_beside},
    {"colour-left", colour_left},
    {"shaded-list", shaded_list},
    {"shading-list", shading_list},
};

int main(int argc, char** argv) {
    for (size_t i = 0; argc > 1 && i < sizeof ways / sizeof *ways; ++i) {
        if (strcmp(ways[i].name, argv[1]) != 0) continue;
        window = make_window(200, 200);
        glXMakeCurrent(display, window, make_context(0));
        glClearColor(0.125f, 0.25f, 0.5f, 1);
        for (int frame = 0; frame < 3; ++frame) {
            look_at_chiral(200);
            ways[i].draw();
            glXSwapBuffers(display, window);
        }
        printf("error %x\n", glGetError());
        return 0;
    }
    return 9;
}
