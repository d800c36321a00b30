#include "shim/preload/scene_table.h"

#include <algorithm>
#include <cstring>
#include <tuple>
#include <type_traits>
#include <utility>

#include "shim/preload/ignored_calls.h"
#include "shim/preload/join_parts.h"

namespace glcast::preload {
namespace {

constinit thread_local DrawGate* gate = nullptr;

// Each family of calls is a template over the member of GlTable that it stands for, so that a family is
// written once and the calls are listed in a table below.

/// A draw whose vertex count is argument `Count`, times argument `Instances` where that is not -1. Count -1:
/// not known.
template <auto Member, int Count, int Instances,
          class = std::remove_reference_t<decltype(std::declval<GlTable&>().*Member)>>
struct PlainDraw;
template <auto Member, int Count, int Instances, class R, class... A>
struct PlainDraw<Member, Count, Instances, R (*)(A...)> {
    static R APIENTRY call(A... arguments) {
        const auto all = std::tie(arguments...);
        const GLenum mode = std::get<0>(all);
        long primitives = 1;
        if constexpr (Count >= 0) primitives = primitive_count(mode, std::get<Count>(all));
        if constexpr (Instances >= 0) primitives *= std::max<long>(0, std::get<Instances>(all));
        if (!gate->keep(mode, primitives)) return;
        (gate->inner.*Member)(arguments...);
        gate->drawn();
    }
};

/// Many draws in one: argument `Counts` holds as many counts as argument `Number` says.
template <auto Member, int Counts, int Number,
          class = std::remove_reference_t<decltype(std::declval<GlTable&>().*Member)>>
struct MultiDraw;
template <auto Member, int Counts, int Number, class R, class... A>
struct MultiDraw<Member, Counts, Number, R (*)(A...)> {
    static R APIENTRY call(A... arguments) {
        const auto all = std::tie(arguments...);
        const GLenum mode = std::get<0>(all);
        long primitives = 0;
        for (GLsizei i = 0; i < std::get<Number>(all); ++i)
            primitives += primitive_count(mode, std::get<Counts>(all)[i]);
        if (!gate->keep(mode, primitives)) return;
        (gate->inner.*Member)(arguments...);
        gate->drawn();
    }
};

/// glRect*: two triangles.
template <auto Member, class = std::remove_reference_t<decltype(std::declval<GlTable&>().*Member)>>
struct Rectangle;
template <auto Member, class R, class... A> struct Rectangle<Member, R (*)(A...)> {
    static R APIENTRY call(A... arguments) {
        if (!gate->keep(GL_TRIANGLES, 2)) return;
        (gate->inner.*Member)(arguments...);
        gate->drawn();
    }
};

/// A vertex between glBegin and glEnd, however it is given.
template <auto Member, bool GivesW,
          class = std::remove_reference_t<decltype(std::declval<GlTable&>().*Member)>>
struct Vertex;
template <auto Member, bool GivesW, class R, class... A> struct Vertex<Member, GivesW, R (*)(A...)> {
    static R APIENTRY call(A... arguments) {
        ++gate->vertices;
        if constexpr (GivesW) gate->gives_w = true;
        if (!gate->swallowing) (gate->inner.*Member)(arguments...);
    }
};

/// Generic attribute 0 is the vertex.
template <auto Member, class = std::remove_reference_t<decltype(std::declval<GlTable&>().*Member)>>
struct Attribute;
template <auto Member, class R, class... A> struct Attribute<Member, R (*)(A...)> {
    static R APIENTRY call(A... arguments) {
        const bool is_vertex = std::get<0>(std::tie(arguments...)) == 0;
        if (is_vertex) ++gate->vertices;
        if (!is_vertex || !gate->swallowing) (gate->inner.*Member)(arguments...);
    }
};

/// The colour of a vertex.
template <auto Member, class = std::remove_reference_t<decltype(std::declval<GlTable&>().*Member)>>
struct Colour;
template <auto Member, class R, class... A> struct Colour<Member, R (*)(A...)> {
    static R APIENTRY call(A... arguments) {
        if (!gate->fixes_colour()) (gate->inner.*Member)(arguments...);
    }
};

/// Pixels, which are never solid.
template <auto Member, class = std::remove_reference_t<decltype(std::declval<GlTable&>().*Member)>>
struct Dropped;
template <auto Member, class R, class... A> struct Dropped<Member, R (*)(A...)> {
    static R APIENTRY call(A...) { gate->pixels_drawn(); }
};

template <auto Member, class = std::remove_reference_t<decltype(std::declval<GlTable&>().*Member)>>
struct BindFramebuffer;
template <auto Member, class R, class... A> struct BindFramebuffer<Member, R (*)(A...)> {
    static R APIENTRY call(GLenum target, GLuint name) {
        gate->framebuffer_bound(target, name);
        if (!gate->draws_nothing()) (gate->inner.*Member)(target, name);
    }
};

void APIENTRY begin(GLenum mode) {
    gate->mode = mode;
    gate->vertices = 0;
    gate->gives_w = false;
    gate->swallowing = !gate->keep(mode, 0);
    if (!gate->swallowing) gate->inner.Begin(mode);
}

void APIENTRY end() {
    gate->add_primitives(primitive_count(gate->mode, gate->vertices));
    const bool kept = !std::exchange(gate->swallowing, false);
    if (!kept) return;
    gate->inner.End();
    gate->drawn();
}

/// A draw whose parts may be left out: `one(mode, first, count)` draws some of it, counted from its first
/// element, `many(mode, firsts, counts)` several such, `joined(mode, elements)` single ones.
template <class One, class Many, class Joined>
void draw_parts(GLenum mode, GLsizei count, const One& one, const Many& many, const Joined& joined) {
    if (!gate->keep(mode, primitive_count(mode, count))) return;
    const GLenum drawn = gate->as_points ? GL_POINTS : mode;
    if (!gate->parts) {
        one(drawn, 0, count);
    } else if (gate->parts->size() == 1) {
        one(drawn, static_cast<GLint>(gate->parts->front().first),
            static_cast<GLsizei>(gate->parts->front().count));
    } else if (are_to_be_joined(*gate->parts)) {
        joined(drawn, join_parts(drawn, *gate->parts));
    } else {
        std::vector<GLint> firsts;
        std::vector<GLsizei> counts;
        for (const auto& part : *gate->parts)
            firsts.push_back(static_cast<GLint>(part.first)),
                counts.push_back(static_cast<GLsizei>(part.count));
        many(drawn, firsts, counts);
    }
    gate->drawn();
}

void draw_elements_of(GLenum mode, const std::vector<GLuint>& elements) {
    gate->inner.DrawElements(mode, static_cast<GLsizei>(elements.size()), GL_UNSIGNED_INT, elements.data());
}

void APIENTRY draw_arrays(GLenum mode, GLint first, GLsizei count) {
    const GlTable& gl = gate->inner;
    draw_parts(
        mode, count,
        [&](GLenum drawn, GLint at, GLsizei number) { gl.DrawArrays(drawn, first + at, number); },
        [&](GLenum drawn, std::vector<GLint>& firsts, const std::vector<GLsizei>& counts) {
            for (GLint& at : firsts) at += first;
            gl.MultiDrawArrays(drawn, firsts.data(), counts.data(), static_cast<GLsizei>(counts.size()));
        },
        [&](GLenum drawn, std::vector<GLuint> elements) {
            for (GLuint& element : elements) element += static_cast<GLuint>(first);
            draw_elements_of(drawn, elements);
        });
}

GLuint index_at(const void* indices, GLint bytes, GLuint at) {
    GLuint index = 0; // of a little-endian machine
    std::memcpy(&index, static_cast<const std::byte*>(indices) + std::ptrdiff_t(at) * bytes,
                static_cast<std::size_t>(bytes));
    return index;
}

void APIENTRY draw_elements(GLenum mode, GLsizei count, GLenum type, const void* indices) {
    const GlTable& gl = gate->inner;
    const GLint bytes = type == GL_UNSIGNED_BYTE ? 1 : type == GL_UNSIGNED_SHORT ? 2 : 4;
    const auto from = [&](GLint at) -> const void* {
        return static_cast<const std::byte*>(indices) + std::ptrdiff_t(at) * bytes;
    };
    draw_parts(
        mode, count,
        [&](GLenum drawn, GLint at, GLsizei number) { gl.DrawElements(drawn, number, type, from(at)); },
        [&](GLenum drawn, const std::vector<GLint>& firsts, const std::vector<GLsizei>& counts) {
            for (std::size_t i = 0; i < counts.size(); ++i)
                gl.DrawElements(drawn, counts[i], type, from(firsts[i]));
        },
        [&](GLenum drawn, std::vector<GLuint> elements) {
            for (GLuint& element : elements) element = index_at(indices, bytes, element);
            draw_elements_of(drawn, elements);
        });
}

/// Mesh modes as those of glBegin.
GLenum drawn_as(GLenum mesh_mode) {
    return mesh_mode == GL_FILL ? GL_TRIANGLES : mesh_mode == GL_LINE ? GL_LINES : GL_POINTS;
}

void APIENTRY eval_mesh_1(GLenum mode, GLint i1, GLint i2) {
    if (!gate->keep(drawn_as(mode), std::max(0, i2 - i1))) return;
    gate->inner.EvalMesh1(mode, i1, i2);
    gate->drawn();
}

void APIENTRY eval_mesh_2(GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    const long primitives = 2L * std::max(0, i2 - i1) * std::max(0, j2 - j1);
    if (!gate->keep(drawn_as(mode), primitives)) return;
    gate->inner.EvalMesh2(mode, i1, i2, j1, j2);
    gate->drawn();
}

void APIENTRY clear(GLbitfield buffers) {
    gate->cleared(buffers);
    if (!gate->draws_nothing()) gate->inner.Clear(buffers);
}

void APIENTRY blit_framebuffer(GLint x0, GLint y0, GLint x1, GLint y1, GLint to_x0, GLint to_y0, GLint to_x1,
                               GLint to_y1, GLbitfield buffers, GLenum) {
    if (buffers & GL_COLOR_BUFFER_BIT) gate->blitted({x0, y0, x1, y1}, {to_x0, to_y0, to_x1, to_y1});
}

void switch_cap(GLenum cap, bool on) {
    if (cap == GL_BLEND) {
        gate->blend = on;
        if (!gate->blends(on)) return;
    }
    on ? gate->inner.Enable(cap) : gate->inner.Disable(cap);
}
void APIENTRY enable(GLenum cap) { switch_cap(cap, true); }
void APIENTRY disable(GLenum cap) { switch_cap(cap, false); }

void APIENTRY push_attrib(GLbitfield mask) {
    gate->saved_blends.push_back({(mask & (GL_ENABLE_BIT | GL_COLOR_BUFFER_BIT)) != 0, gate->blend});
    gate->inner.PushAttrib(mask);
}

void APIENTRY pop_attrib() {
    gate->inner.PopAttrib();
    if (gate->saved_blends.empty()) return;
    const DrawGate::SavedBlend saved = gate->saved_blends.back();
    gate->saved_blends.pop_back();
    if (!saved.is_saved) return;
    gate->blend = saved.blend;
    if (gate->blending_restored()) gate->blends(saved.blend);
}

void APIENTRY push_matrix() {
    gate->before_push();
    gate->inner.PushMatrix();
}

// name, argument with the number of vertices, argument with the number of instances
#define GLCAST_PLAIN_DRAWS(X)                                                                                \
    X(DrawArraysEXT, 2, -1)                                                                                  \
    X(DrawRangeElements, 3, -1)                                                                              \
    X(DrawRangeElementsEXT, 3, -1)                                                                           \
    X(DrawElementsBaseVertex, 1, -1)                                                                         \
    X(DrawRangeElementsBaseVertex, 3, -1)                                                                    \
    X(DrawArraysInstanced, 2, 3)                                                                             \
    X(DrawArraysInstancedARB, 2, 3)                                                                          \
    X(DrawArraysInstancedEXT, 2, 3)                                                                          \
    X(DrawArraysInstancedBaseInstance, 2, 3)                                                                 \
    X(DrawElementsInstanced, 1, 4)                                                                           \
    X(DrawElementsInstancedARB, 1, 4)                                                                        \
    X(DrawElementsInstancedEXT, 1, 4)                                                                        \
    X(DrawElementsInstancedBaseVertex, 1, 4)                                                                 \
    X(DrawElementsInstancedBaseInstance, 1, 4)                                                               \
    X(DrawElementsInstancedBaseVertexBaseInstance, 1, 4)                                                     \
    X(DrawArraysIndirect, -1, -1)                                                                            \
    X(DrawElementsIndirect, -1, -1)                                                                          \
    X(MultiDrawArraysIndirect, -1, -1)                                                                       \
    X(MultiDrawElementsIndirect, -1, -1)                                                                     \
    X(DrawTransformFeedback, -1, -1)                                                                         \
    X(DrawTransformFeedbackStream, -1, -1)                                                                   \
    X(DrawTransformFeedbackInstanced, -1, 2)                                                                 \
    X(DrawTransformFeedbackStreamInstanced, -1, 3)

// name, argument with the counts, argument with how many there are
#define GLCAST_MULTI_DRAWS(X)                                                                                \
    X(MultiDrawArrays, 2, 3)                                                                                 \
    X(MultiDrawArraysEXT, 2, 3)                                                                              \
    X(MultiDrawElements, 1, 4)                                                                               \
    X(MultiDrawElementsEXT, 1, 4)                                                                            \
    X(MultiDrawElementsBaseVertex, 1, 4)

#define GLCAST_FOUR_TYPES(X, NAME) X(NAME##d) X(NAME##f) X(NAME##i) X(NAME##s)
#define GLCAST_FOUR_TYPES_V(X, NAME) X(NAME##dv) X(NAME##fv) X(NAME##iv) X(NAME##sv)

#define GLCAST_VERTICES(X)                                                                                   \
    GLCAST_FOUR_TYPES(X, Vertex2)                                                                            \
    GLCAST_FOUR_TYPES(X, Vertex3)                                                                            \
    GLCAST_FOUR_TYPES_V(X, Vertex2)                                                                          \
    GLCAST_FOUR_TYPES_V(X, Vertex3)                                                                          \
    X(EvalCoord1d)                                                                                           \
    X(EvalCoord1f)                                                                                           \
    X(EvalCoord1dv)                                                                                          \
    X(EvalCoord1fv)                                                                                          \
    X(EvalCoord2d)                                                                                           \
    X(EvalCoord2f)                                                                                           \
    X(EvalCoord2dv) X(EvalCoord2fv) X(EvalPoint1) X(EvalPoint2) X(ArrayElement) X(ArrayElementEXT)

#define GLCAST_VERTICES_WITH_W(X) GLCAST_FOUR_TYPES(X, Vertex4) GLCAST_FOUR_TYPES_V(X, Vertex4)

#define GLCAST_SCALARS_AND_ARRAYS(X, NAME, SUFFIX)                                                           \
    X(NAME##d##SUFFIX)                                                                                       \
    X(NAME##f##SUFFIX) X(NAME##s##SUFFIX) X(NAME##dv##SUFFIX) X(NAME##fv##SUFFIX) X(NAME##sv##SUFFIX)

#define GLCAST_ATTRIBUTES(X)                                                                                 \
    GLCAST_SCALARS_AND_ARRAYS(X, VertexAttrib1, )                                                            \
    GLCAST_SCALARS_AND_ARRAYS(X, VertexAttrib2, )                                                            \
    GLCAST_SCALARS_AND_ARRAYS(X, VertexAttrib3, )                                                            \
    GLCAST_SCALARS_AND_ARRAYS(X, VertexAttrib4, )                                                            \
    GLCAST_SCALARS_AND_ARRAYS(X, VertexAttrib1, ARB)                                                         \
    GLCAST_SCALARS_AND_ARRAYS(X, VertexAttrib2, ARB)                                                         \
    GLCAST_SCALARS_AND_ARRAYS(X, VertexAttrib3, ARB)                                                         \
    GLCAST_SCALARS_AND_ARRAYS(X, VertexAttrib4, ARB)                                                         \
    X(VertexAttrib4bv)                                                                                       \
    X(VertexAttrib4iv)                                                                                       \
    X(VertexAttrib4ubv)                                                                                      \
    X(VertexAttrib4uiv)                                                                                      \
    X(VertexAttrib4usv)                                                                                      \
    X(VertexAttrib4Nbv)                                                                                      \
    X(VertexAttrib4Niv) X(VertexAttrib4Nsv) X(VertexAttrib4Nub) X(VertexAttrib4Nubv) X(VertexAttrib4Nuiv)    \
        X(VertexAttrib4Nusv)

#define GLCAST_EIGHT_TYPES(X, NAME)                                                                          \
    X(NAME##b)                                                                                               \
    X(NAME##d)                                                                                               \
    X(NAME##f) X(NAME##i) X(NAME##s) X(NAME##ub) X(NAME##ui) X(NAME##us) X(NAME##bv) X(NAME##dv) X(NAME##fv) \
        X(NAME##iv) X(NAME##sv) X(NAME##ubv) X(NAME##uiv) X(NAME##usv)
#define GLCAST_COLOURS(X) GLCAST_EIGHT_TYPES(X, Color3) GLCAST_EIGHT_TYPES(X, Color4)

#define GLCAST_RECTANGLES(X) GLCAST_FOUR_TYPES(X, Rect) GLCAST_FOUR_TYPES_V(X, Rect)
#define GLCAST_PIXELS(X) X(Bitmap) X(DrawPixels) X(CopyPixels)
#define GLCAST_CLEARS(X)                                                                                     \
    X(ClearBufferfv)                                                                                         \
    X(ClearBufferiv)                                                                                         \
    X(ClearBufferuiv) X(ClearBufferfi) X(Accum) X(Flush) X(Finish)

void install_draws(GlTable& table) {
#define GLCAST_INSTALL(NAME, COUNT, INSTANCES) table.NAME = PlainDraw<&GlTable::NAME, COUNT, INSTANCES>::call;
    GLCAST_PLAIN_DRAWS(GLCAST_INSTALL)
#undef GLCAST_INSTALL
#define GLCAST_INSTALL(NAME, COUNTS, NUMBER) table.NAME = MultiDraw<&GlTable::NAME, COUNTS, NUMBER>::call;
    GLCAST_MULTI_DRAWS(GLCAST_INSTALL)
#undef GLCAST_INSTALL
#define GLCAST_INSTALL(NAME) table.NAME = Rectangle<&GlTable::NAME>::call;
    GLCAST_RECTANGLES(GLCAST_INSTALL)
#undef GLCAST_INSTALL
    table.Begin = begin;
    table.End = end;
    table.DrawArrays = draw_arrays;
    table.DrawElements = draw_elements;
    table.EvalMesh1 = eval_mesh_1;
    table.EvalMesh2 = eval_mesh_2;
}

void install_vertices(GlTable& table) {
#define GLCAST_INSTALL(NAME) table.NAME = Vertex<&GlTable::NAME, false>::call;
    GLCAST_VERTICES(GLCAST_INSTALL)
#undef GLCAST_INSTALL
#define GLCAST_INSTALL(NAME) table.NAME = Vertex<&GlTable::NAME, true>::call;
    GLCAST_VERTICES_WITH_W(GLCAST_INSTALL)
#undef GLCAST_INSTALL
#define GLCAST_INSTALL(NAME) table.NAME = Attribute<&GlTable::NAME>::call;
    GLCAST_ATTRIBUTES(GLCAST_INSTALL)
#undef GLCAST_INSTALL
}

void install_colours(GlTable& table) {
#define GLCAST_INSTALL(NAME) table.NAME = Colour<&GlTable::NAME>::call;
    GLCAST_COLOURS(GLCAST_INSTALL)
#undef GLCAST_INSTALL
}

void install_others(GlTable& table, bool draws_nothing) {
#define GLCAST_INSTALL(NAME) table.NAME = Dropped<&GlTable::NAME>::call;
    GLCAST_PIXELS(GLCAST_INSTALL)
#undef GLCAST_INSTALL
#define GLCAST_INSTALL(NAME) table.NAME = Ignored<&GlTable::NAME>::call;
    if (draws_nothing) { // what must not happen then
        GLCAST_CLEARS(GLCAST_INSTALL)
    }
#undef GLCAST_INSTALL
    table.Clear = clear;
    table.BlitFramebuffer = table.BlitFramebufferEXT = blit_framebuffer;
    table.Enable = enable;
    table.Disable = disable;
    table.PushAttrib = push_attrib;
    table.PopAttrib = pop_attrib;
    table.BindFramebuffer = BindFramebuffer<&GlTable::BindFramebuffer>::call;
    table.BindFramebufferEXT = BindFramebuffer<&GlTable::BindFramebufferEXT>::call;
    table.PushMatrix = push_matrix;
}

} // namespace

bool has_faces(GLenum mode) {
    switch (mode) {
    case GL_POINTS:
    case GL_LINES:
    case GL_LINE_LOOP:
    case GL_LINE_STRIP:
    case GL_LINES_ADJACENCY:
    case GL_LINE_STRIP_ADJACENCY:
        return false;
    default:
        return true;
    }
}

long primitive_count(GLenum mode, long vertices) {
    switch (mode) {
    case GL_POINTS:
        return vertices;
    case GL_LINES:
        return vertices / 2;
    case GL_LINE_LOOP:
        return vertices > 1 ? vertices : 0;
    case GL_LINE_STRIP:
        return std::max(0L, vertices - 1);
    case GL_LINES_ADJACENCY:
        return vertices / 4;
    case GL_LINE_STRIP_ADJACENCY:
        return std::max(0L, vertices - 3);
    case GL_TRIANGLES:
    case GL_PATCHES:
        return vertices / 3;
    case GL_QUADS:
        return vertices / 4 * 2;
    case GL_TRIANGLE_STRIP:
    case GL_TRIANGLE_FAN:
    case GL_QUAD_STRIP:
    case GL_POLYGON:
        return std::max(0L, vertices - 2);
    case GL_TRIANGLES_ADJACENCY:
        return vertices / 6;
    case GL_TRIANGLE_STRIP_ADJACENCY:
        return std::max(0L, vertices / 2 - 2);
    default:
        return 0;
    }
}

GlTable gated_table(DrawGate& new_gate) {
    gate = &new_gate;
    GlTable table = new_gate.inner;
    install_draws(table);
    install_vertices(table);
    if (new_gate.may_fix_colour()) install_colours(table);
    install_others(table, new_gate.draws_nothing());
    return table;
}

} // namespace glcast::preload
