#include "asks.h"

#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>
#include <GL/glext.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "chiral.h"

static const char* text(const GLubyte* t) { return t ? (const char*)t : "none"; }

/* Of glGetString or glGetStringi. */
static void count_extensions(const char* where, int index_count) {
    int all = 0, shading = 0, plain = 0;
    char* list = strdup(index_count < 0 ? text(glGetString(GL_EXTENSIONS)) : "");
    for (char* name = strtok(list, " "); index_count < 0 && name; name = strtok(0, " ")) {
        ++all;
        shading += strstr(name, "shader") || strstr(name, "program") || strstr(name, "shading_language");
        plain += strcmp(name, "GL_ARB_vertex_buffer_object") == 0;
    }
    for (int i = 0; i < index_count; ++i) {
        const char* name = text(glGetStringi(GL_EXTENSIONS, i));
        ++all;
        shading += strstr(name, "shader") || strstr(name, "program") || strstr(name, "shading_language");
        plain += strcmp(name, "GL_ARB_vertex_buffer_object") == 0;
    }
    free(list);
    printf("%s: extensions %s, shading %s, buffers %d\n", where, all > 0 ? "some" : "none",
           shading ? "some" : "none", plain);
}

void ask(GetFunction get) {
    printf("version %.3s%s\n", text(glGetString(GL_VERSION)),
           strstr(text(glGetString(GL_VERSION)), "Mesa") ? " of Mesa" : "");
    printf("error %x\n", glGetError());
    printf("language %.4s", text(glGetString(GL_SHADING_LANGUAGE_VERSION)));
    printf(" error %x\n", glGetError());
    GLint major = -1, minor = -1, count = 0;
    glGetIntegerv(GL_MAJOR_VERSION, &major);
    glGetIntegerv(GL_MINOR_VERSION, &minor);
    glGetIntegerv(GL_NUM_EXTENSIONS, &count);
    GLfloat f = -1;
    GLdouble d = -1;
    GLint64 l = -1;
    GLboolean b = 7;
    glGetFloatv(GL_MAJOR_VERSION, &f);
    glGetDoublev(GL_MINOR_VERSION, &d);
    glGetInteger64v(GL_MINOR_VERSION, &l);
    glGetBooleanv(GL_MINOR_VERSION, &b);
    printf("numbers %d %d %g %g %ld %d error %x\n", major, minor, f, d, (long)l, b, glGetError());
    count_extensions("whole", -1);
    count_extensions("one by one", count);
    printf("beyond the last %s", text(glGetStringi(GL_EXTENSIONS, count)));
    printf(" error %x\n", glGetError());
    static const char* const names[] = {"glCreateShader",     "glCreateShaderObjectARB",  "glUniform1f",
                                        "glProgramStringARB", "glVertexAttribPointerARB", "glAttachObjectARB",
                                        "glBindBuffer",       "glBindBufferARB",          "glActiveTexture",
                                        "glGetStringi",       "glGenFramebuffers"};
    for (unsigned i = 0; i < sizeof names / sizeof *names; ++i)
        printf("%s %s\n", names[i], get(names[i]) ? "there" : "not there");
}

static const char* const vertex = "varying vec4 c; void main() { c = gl_Color; gl_Position = ftransform(); }";
static const char* const fragment = "varying vec4 c; void main() { gl_FragColor = c; }";

static void use_shaders(GetFunction get) {
    PFNGLCREATESHADERPROC create = (PFNGLCREATESHADERPROC)get("glCreateShader");
    PFNGLSHADERSOURCEPROC source = (PFNGLSHADERSOURCEPROC)get("glShaderSource");
    PFNGLUSEPROGRAMPROC use = (PFNGLUSEPROGRAMPROC)get("glUseProgram");
    if (!create || !source || !use || atof(text(glGetString(GL_VERSION))) < 2) return;
    GLuint program = glCreateProgram();
    for (int i = 0; i < 2; ++i) {
        GLuint shader = create(i ? GL_FRAGMENT_SHADER : GL_VERTEX_SHADER);
        source(shader, 1, i ? &fragment : &vertex, 0);
        glCompileShader(shader);
        glAttachShader(program, shader);
    }
    glLinkProgram(program);
    use(program);
}

void draw_as_told(GetFunction get, int size) {
    static int asked = 0;
    if (!asked++) use_shaders(get);
    look_at_chiral(size);
    draw_chiral();
}
