/* Display lists to the letter, each way of using them a program that ends one frame. What they draw are boxes in the
 * cells of a grid of 4 x 4, so that a cast tells which were called, where and in which colour. argv[1] names the way. */
#define GL_GLEXT_PROTOTYPES
#include <stdio.h>
#include <string.h>

#include "window.h"

static Window window;
static GLXContext first, other; /* other: shares with first, made when a way needs it */

static void cell(int column, int row) {
    const float x = column - 1.5f, y = row - 1.5f;
    const float lo[3] = {x - 0.4f, y - 0.4f, -0.4f}, hi[3] = {x + 0.4f, y + 0.4f, 0.4f};
    draw_box(lo, hi);
}
static void red(void) { glColor3f(1, 0, 0); }
static void green(void) { glColor3f(0, 1, 0); }
static void blue(void) { glColor3f(0, 0, 1); }
static void right(void) { glTranslatef(1, 0, 0); }
static void up(void) { glTranslatef(0, 1, 0); }

/* Lists base + 1 ... base + 4: a box in the corner's cell and a step to the right, red, green, blue, white. */
static void make_row(GLuint base) {
    for (int i = 0; i < 4; ++i) {
        glNewList(base + 1 + i, GL_COMPILE);
        glColor3f(i == 0 || i == 3, i == 1 || i == 3, i == 2 || i == 3);
        cell(0, 0);
        right();
        glEndList();
    }
}

/* A list of one box. */
static void make_cell(GLuint list, int column, int row, void (*colour)(void)) {
    glNewList(list, GL_COMPILE);
    if (colour) colour();
    cell(column, row);
    glEndList();
}

static void make_call(GLuint list, GLuint inner) {
    glNewList(list, GL_COMPILE);
    glCallList(inner);
    glEndList();
}

static void share(void) { other = make_context(first); }
static void use(GLXContext context) { glXMakeCurrent(display, window, context); }

/* --- ways: before the frame, and in it */
static void compile_before(void) { make_cell(1, 1, 1, red); }
static void call_one(void) { glCallList(1); }

static void compile_in_frame(void) {
    make_cell(1, 1, 1, red);
    glCallList(1);
}
static void compile_and_execute(void) {
    glNewList(1, GL_COMPILE_AND_EXECUTE);
    red(), cell(0, 0), right();
    glEndList(); /* drawn at 0 */
    glCallList(1); /* at 1 */
    up();
    glCallList(1); /* at 2, one up */
}
static void execute_calls_inner_before(void) { make_cell(2, 0, 0, green); }
static void execute_calls_inner(void) {
    glNewList(1, GL_COMPILE_AND_EXECUTE), glCallList(2), right(), glEndList();
    glCallList(1), glCallList(1);
}
static void nested_before(void) {
    make_cell(1, 0, 0, 0);
    glNewList(2, GL_COMPILE);
    for (int i = 0; i < 3; ++i) {
        glPushMatrix();
        glTranslatef(i, 0, 0);
        glCallList(1);
        glPopMatrix();
    }
    glEndList();
    glNewList(3, GL_COMPILE), glCallList(2), up(), glCallList(2), glEndList();
}
static void nested(void) { blue(), glCallList(3); }
static void late_bound_before(void) {
    make_call(1, 2);
    make_cell(2, 3, 3, red);
}
static void redefined_between_before(void) {
    make_cell(1, 0, 0, red);
    make_call(2, 1);
    make_cell(1, 2, 1, green);
}
static void call_two(void) { glCallList(2); }
static void redefined_in_frame_before(void) {
    make_cell(1, 0, 0, red);
    make_call(2, 1);
}
static void redefined_in_frame(void) {
    glCallList(2);
    make_cell(1, 2, 1, green);
    glCallList(2);
}
static void deleted_between_before(void) {
    make_cell(1, 0, 0, red);
    glNewList(2, GL_COMPILE), cell(1, 0), glCallList(1), cell(2, 0), glEndList();
    glDeleteLists(1, 1);
}
static void deleted_between(void) { green(), glCallList(2); }
static void deleted_in_frame(void) {
    glCallList(1);
    glDeleteLists(1, 1000000);
    up();
    glCallList(1);
}
static void replaced_while_executed(void) {
    glNewList(1, GL_COMPILE_AND_EXECUTE);
    glCallList(1); /* the one before */
    green(), cell(3, 0);
    glEndList();
}
static void calls_itself_before(void) { /* GL stops at 64: one step to the right each, four in the grid */
    glNewList(7, GL_COMPILE);
    glRectf(-1.9f, -1.9f, -1.1f, -1.1f), right(), glCallList(7);
    glEndList();
}
static void calls_itself(void) { red(), glCallList(7); }
static void nested_64_before(void) { /* every one counts by a sixteenth of a cell: 64 are four cells */
    for (GLuint i = 80; i > 0; --i) {
        glNewList(i, GL_COMPILE);
        glTranslatef(1 / 32.0f, 0, 0);
        if (i == 64) blue(), cell(0, 2); /* the last that GL calls */
        if (i == 65) red(), cell(-2, 3); /* too deep */
        glCallList(i + 1);
        glEndList();
    }
}
static void state_left_before(void) { glNewList(1, GL_COMPILE), green(), right(), up(), glEndList(); }
static void state_left(void) {
    red();
    glCallList(1);
    cell(0, 0), glCallList(1), cell(0, 0);
}
static void attributes_before(void) {
    glNewList(1, GL_COMPILE);
    glPushAttrib(GL_ALL_ATTRIB_BITS);
    green();
    glListBase(40);
    cell(0, 0);
    glPopAttrib();
    glEndList();
    make_cell(5, 1, 0, 0);
    make_cell(45, 2, 0, 0);
}
static void attributes(void) {
    const GLubyte five = 5;
    red(), glCallList(1), glCallLists(1, GL_UNSIGNED_BYTE, &five);
}
static void list_base_in_list_before(void) {
    make_row(100);
    glNewList(1, GL_COMPILE), glListBase(100), glEndList();
}
static void list_base_in_list(void) { glCallList(1), glCallLists(3, GL_UNSIGNED_BYTE, "\1\3\2"); }
static void base_before(void) { make_row(98), glListBase(100); }
static void base_late_before(void) {
    make_row(200);
    glNewList(1, GL_COMPILE), glCallLists(2, GL_UNSIGNED_BYTE, "\1\2"), glEndList();
    glListBase(200); /* bound at the call, not at compile time */
}

#define CALLS(NAME, ENUM, TYPE, ...)                                                                                   \
    static void NAME(void) {                                                                                           \
        const TYPE names[] = {__VA_ARGS__};                                                                            \
        glCallLists(4, ENUM, names);                                                                                   \
    }
CALLS(calls_byte, GL_BYTE, GLbyte, -1, 0, 1, 2)
CALLS(calls_short, GL_SHORT, GLshort, -1, 0, 1, 2)
CALLS(calls_int, GL_INT, GLint, -1, 0, 1, 2)
CALLS(calls_float, GL_FLOAT, GLfloat, -1, 0.9f, 1, 2)
static void no_base_before(void) { make_row(200); }
CALLS(calls_ubyte, GL_UNSIGNED_BYTE, GLubyte, 201, 202, 203, 204)
static void ushort_before(void) { make_row(60000); }
CALLS(calls_ushort, GL_UNSIGNED_SHORT, GLushort, 60001, 60002, 60003, 60004)
static void uint_before(void) { make_row(100000); }
CALLS(calls_uint, GL_UNSIGNED_INT, GLuint, 100001, 100002, 100003, 100004)
static void bytes_before(void) { make_row(0x1FE); }
CALLS(calls_2_bytes, GL_2_BYTES, GLubyte, 1, 0xFF, 2, 0, 2, 1, 2, 2)
CALLS(calls_3_bytes, GL_3_BYTES, GLubyte, 0, 1, 0xFF, 0, 2, 0, 0, 2, 1, 0, 2, 2)
CALLS(calls_4_bytes, GL_4_BYTES, GLubyte, 0, 0, 1, 0xFF, 0, 0, 2, 0, 0, 0, 2, 1, 0, 0, 2, 2)

/* A square in the cell (0, 0), as arrays. */
static GLfloat square[] = {-1.9f, -1.9f, -1.1f, -1.9f, -1.1f, -1.1f, -1.9f, -1.1f};
static void move_square(float by) {
    for (int i = 0; i < 8; i += 2) square[i] += by;
}
static void arrays_before(void) {
    glVertexPointer(2, GL_FLOAT, 0, square);
    glEnableClientState(GL_VERTEX_ARRAY);
    glNewList(1, GL_COMPILE), green(), glDrawArrays(GL_QUADS, 0, 4), glEndList();
    move_square(2); /* too late */
}
static void element_before(void) {
    const GLubyte indices[] = {0, 1, 2, 3};
    glVertexPointer(2, GL_FLOAT, 0, square);
    glEnableClientState(GL_VERTEX_ARRAY);
    glNewList(1, GL_COMPILE);
    red(), glDrawElements(GL_QUADS, 4, GL_UNSIGNED_BYTE, indices);
    right(), green();
    glBegin(GL_QUADS);
    for (int i = 0; i < 4; ++i) glArrayElement(i);
    glEnd();
    glEndList();
    move_square(2);
    glDisableClientState(GL_VERTEX_ARRAY);
}
static void buffer_before(void) {
    GLuint name = 0;
    glGenBuffers(1, &name);
    glBindBuffer(GL_ARRAY_BUFFER, name);
    glBufferData(GL_ARRAY_BUFFER, sizeof square, square, GL_STATIC_DRAW);
    glVertexPointer(2, GL_FLOAT, 0, 0);
    glEnableClientState(GL_VERTEX_ARRAY);
    glNewList(1, GL_COMPILE), blue(), glDrawArrays(GL_QUADS, 0, 4), glEndList();
    glDisableClientState(GL_VERTEX_ARRAY);
    glDeleteBuffers(1, &name);
}
static void vertices_inside_before(void) {
    glNewList(1, GL_COMPILE);
    red();
    glVertex2f(-1.9f, -1.9f), glVertex2f(-1.1f, -1.9f), glVertex2f(-1.1f, -1.1f), glVertex2f(-1.9f, -1.1f);
    glEndList();
}
static void vertices_inside(void) { glBegin(GL_QUADS), glCallList(1), glEnd(); }
static void begin_inside_before(void) {
    glNewList(1, GL_COMPILE), glBegin(GL_QUADS), green(), glVertex2f(-1.9f, -1.9f), glEndList();
}
static void begin_inside(void) {
    glCallList(1);
    glVertex2f(-1.1f, -1.9f), glVertex2f(-1.1f, -1.1f), glVertex2f(-1.9f, -1.1f);
    glEnd();
    cell(2, 2);
}
static void material_before(void) {
    static const GLfloat colour[] = {0, 0, 1, 1};
    glNewList(1, GL_COMPILE);
    glEnable(GL_LIGHTING), glMaterialfv(GL_FRONT_AND_BACK, GL_DIFFUSE, colour), cell(0, 0), glDisable(GL_LIGHTING);
    glEndList();
}

/* Two contexts that share. */
static void made_elsewhere_before(void) {
    share(), use(other);
    make_cell(1, 1, 2, green);
    use(first);
}
static void redefined_elsewhere_before(void) {
    make_cell(1, 0, 0, red);
    make_call(2, 1);
    share(), use(other);
    make_cell(1, 1, 2, green);
    use(first);
}
static void deleted_elsewhere_before(void) {
    make_cell(1, 0, 0, red);
    glNewList(2, GL_COMPILE), blue(), cell(3, 3), glCallList(1), glEndList();
    share(), use(other);
    glDeleteLists(1, 1);
    use(first);
}
static void maker_is_gone_before(void) {
    share(), use(other);
    make_cell(1, 1, 2, green);
    use(first);
    glXDestroyContext(display, other);
}

static const struct {
    const char* name;
    void (*before)(void);
    void (*frame)(void);
} ways[] = {
    {"compile", compile_before, call_one},
    {"compile_in_frame", 0, compile_in_frame},
    {"compile_and_execute", 0, compile_and_execute},
    {"execute_calls_inner", execute_calls_inner_before, execute_calls_inner},
    {"nested", nested_before, nested},
    {"late_bound", late_bound_before, call_one},
    {"redefined_between", redefined_between_before, call_two},
    {"redefined_in_frame", redefined_in_frame_before, redefined_in_frame},
    {"deleted_between", deleted_between_before, deleted_between},
    {"deleted_in_frame", compile_before, deleted_in_frame},
    {"replaced_while_executed", compile_before, replaced_while_executed},
    {"calls_itself", calls_itself_before, calls_itself},
    {"nested_64", nested_64_before, call_one},
    {"state_left", state_left_before, state_left},
    {"attributes", attributes_before, attributes},
    {"list_base_in_list", list_base_in_list_before, list_base_in_list},
    {"list_base_is_bound_late", base_late_before, call_one},
    {"calls_byte", base_before, calls_byte},
    {"calls_ubyte", no_base_before, calls_ubyte},
    {"calls_short", base_before, calls_short},
    {"calls_ushort", ushort_before, calls_ushort},
    {"calls_int", base_before, calls_int},
    {"calls_uint", uint_before, calls_uint},
    {"calls_float", base_before, calls_float},
    {"calls_2_bytes", bytes_before, calls_2_bytes},
    {"calls_3_bytes", bytes_before, calls_3_bytes},
    {"calls_4_bytes", bytes_before, calls_4_bytes},
    {"arrays", arrays_before, call_one},
    {"elements", element_before, call_one},
    {"buffer_that_goes", buffer_before, call_one},
    {"vertices_inside", vertices_inside_before, vertices_inside},
    {"begin_inside", begin_inside_before, begin_inside},
    {"material", material_before, call_one},
    {"made_elsewhere", made_elsewhere_before, call_one},
    {"redefined_elsewhere", redefined_elsewhere_before, call_two},
    {"deleted_elsewhere", deleted_elsewhere_before, call_two},
    {"maker_is_gone", maker_is_gone_before, call_one},
};

int main(int argc, char** argv) {
    const char* name = argc > 1 ? argv[1] : "";
    for (unsigned i = 0; i < sizeof ways / sizeof *ways; ++i) {
        if (strcmp(ways[i].name, name) != 0) continue;
        window = make_window(120, 120);
        first = make_context(0);
        use(first);
        if (ways[i].before) ways[i].before();
        glXSwapBuffers(display, window); /* a frame of its own, and an empty one */
        glEnable(GL_DEPTH_TEST);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        glMatrixMode(GL_PROJECTION);
        glLoadIdentity();
        glFrustum(-1, 1, -1, 1, 2, 40);
        glMatrixMode(GL_MODELVIEW);
        glLoadIdentity();
        glTranslatef(0, 0, -10);
        ways[i].frame();
        glXSwapBuffers(display, window);
        return 0;
    }
    fprintf(stderr, "no way of this name\n");
    return 2;
}
