/* What a program can ask of its OpenGL, printed; and a body drawn as it is answered: by GLSL where there is
 * any. */
#pragma once

typedef void (*Function)(void);
typedef Function (*GetFunction)(const char* name);

/* Of the current context, a line a question. */
void ask(GetFunction get);
/* The three boxes of chiral.h, in a square window. */
void draw_as_told(GetFunction get, int size);
