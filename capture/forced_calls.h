// Entry points of the forced table that replace a call by another of the same kind.
#pragma once
#include "capture/gl/gl_table.h"

namespace glcast::forced {

void APIENTRY enable(GLenum cap);
void APIENTRY disable(GLenum cap);
void APIENTRY enable_indexed(GLenum cap, GLuint index);
void APIENTRY disable_indexed(GLenum cap, GLuint index);

void APIENTRY push_attrib(GLbitfield mask);
void APIENTRY pop_attrib();
void APIENTRY matrix_mode(GLenum mode);

void APIENTRY material_f(GLenum face, GLenum name, GLfloat value);
void APIENTRY material_fv(GLenum face, GLenum name, const GLfloat* values);
void APIENTRY material_i(GLenum face, GLenum name, GLint value);
void APIENTRY material_iv(GLenum face, GLenum name, const GLint* values);
void APIENTRY colour_material(GLenum face, GLenum mode);
void APIENTRY light_model_f(GLenum name, GLfloat value);
void APIENTRY light_model_fv(GLenum name, const GLfloat* values);
void APIENTRY light_model_i(GLenum name, GLint value);
void APIENTRY light_model_iv(GLenum name, const GLint* values);

void APIENTRY front_face(GLenum mode);
void APIENTRY alpha_func(GLenum function, GLclampf reference);
void APIENTRY blend_func(GLenum source, GLenum destination);
void APIENTRY blend_func_separate(GLenum source, GLenum destination, GLenum source_alpha,
                                  GLenum destination_alpha);
void APIENTRY blend_func_indexed(GLuint buffer, GLenum source, GLenum destination);
void APIENTRY blend_colour(GLclampf red, GLclampf green, GLclampf blue, GLclampf alpha);
void APIENTRY logic_op(GLenum operation);
void APIENTRY blend_equation(GLenum equation);
void APIENTRY blend_equation_separate(GLenum equation, GLenum equation_alpha);
void APIENTRY depth_func(GLenum function);
void APIENTRY depth_mask(GLboolean on);
void APIENTRY polygon_offset(GLfloat factor, GLfloat units);
void APIENTRY polygon_offset_ext(GLfloat factor, GLfloat bias);
void APIENTRY polygon_offset_clamp(GLfloat factor, GLfloat units, GLfloat clamp);
void APIENTRY depth_range(GLdouble near, GLdouble far);
void APIENTRY depth_range_f(GLfloat near, GLfloat far);
void APIENTRY stencil_func(GLenum function, GLint reference, GLuint mask);
void APIENTRY stencil_func_separate(GLenum face, GLenum function, GLint reference, GLuint mask);
void APIENTRY clear(GLbitfield buffers);
void APIENTRY clear_color(GLclampf red, GLclampf green, GLclampf blue, GLclampf alpha);
void APIENTRY colour_mask(GLboolean red, GLboolean green, GLboolean blue, GLboolean alpha);
void APIENTRY draw_buffer(GLenum buffer);
void APIENTRY draw_buffers(GLsizei count, const GLenum* buffers);
void APIENTRY use_program(GLuint program);
void APIENTRY use_program_object(GLhandleARB program);
void APIENTRY bind_texture(GLenum target, GLuint texture);
GLint APIENTRY render_mode(GLenum mode);

} // namespace glcast::forced
