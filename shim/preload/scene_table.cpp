#include "shim/preload/scene_table.h"

#include <algorithm>
#include <cstring>
#include <tuple>
#include <utility>

#include "capture/gl/call_classes.h"
#include "shim/preload/join_parts.h"

namespace glcast::preload {
namespace {

DrawGate& gate() { return *table_owner<DrawGate>; }

struct ForGate {
    using Owner = DrawGate;
};

/// Draws from arrays, one or many.
struct Counted : ForGate {
    static constexpr const char* what = "counted; made if the owner keeps it";
    static void call(auto below, auto... arguments) {
        constexpr DrawArguments places = draw_arguments<below.member>;
        const auto all = std::tie(arguments...);
        const GLenum mode = std::get<0>(all);
        long primitives = 1;
        if constexpr (places.number >= 0) {
            primitives = 0;
            for (GLsizei i = 0; i < std::get<places.number>(all); ++i)
                primitives += primitive_count(mode, std::get<places.count>(all)[i]);
        } else if constexpr (places.count >= 0) {
            primitives = primitive_count(mode, std::get<places.count>(all));
        }
        if constexpr (places.instances >= 0) primitives *= std::max<long>(0, std::get<places.instances>(all));
        if (!gate().keep(mode, primitives)) return;
        below(arguments...);
        gate().drawn();
    }
};

struct Rectangle : ForGate {
    static constexpr const char* what = "counted as two triangles; made if the owner keeps it";
    static void call(auto below, auto... arguments) {
        if (!gate().keep(GL_TRIANGLES, 2)) return;
        below(arguments...);
        gate().drawn();
    }
};

/// Between glBegin and glEnd.
struct Vertex : ForGate {
    static constexpr const char* what = "counted; made if its draw is kept";
    static void call(auto below, auto... arguments) {
        ++gate().vertices;
        if (!gate().swallowing) below(arguments...);
    }
};
struct VertexWithW : Vertex {
    static void call(auto below, auto... arguments) {
        gate().gives_w = true;
        Vertex::call(below, arguments...);
    }
};
struct Attribute : ForGate {
    static constexpr const char* what = "number 0 is counted as a vertex, and made if its draw is kept";
    static void call(auto below, GLuint index, auto... arguments) {
        if (index == 0)
            Vertex::call(below, index, arguments...);
        else
            below(index, arguments...);
    }
};

struct Colour : ForGate {
    static constexpr const char* what = "left out of draws in one colour";
    static void call(auto below, auto... arguments) {
        if (!gate().fixes_colour()) return below(arguments...);
        gate().late_colour = [=] { below(arguments...); }; // pointers are the frame's
    }
};

struct Pixels : ForGate {
    static constexpr const char* what = "told to the owner and left out";
    static void call(auto, auto...) { gate().pixels_drawn(); }
};

struct Bound : ForGate {
    static constexpr const char* what = "told to the owner, then made if anything is drawn";
    static void call(auto below, GLenum target, GLuint name) {
        gate().framebuffer_bound(target, name);
        if (!gate().draws_nothing()) below(target, name);
    }
};

void APIENTRY begin(GLenum mode) {
    gate().mode = mode;
    gate().vertices = 0;
    gate().gives_w = false;
    gate().swallowing = !gate().keep(mode, 0);
    if (!gate().swallowing) gate().inner.Begin(mode);
}

void APIENTRY end() {
    gate().add_primitives(primitive_count(gate().mode, gate().vertices));
    const bool kept = !std::exchange(gate().swallowing, false);
    if (!kept) return;
    gate().inner.End();
    gate().drawn();
    if (const auto set = std::exchange(gate().late_colour, nullptr))
        set(); // it goes on to be the current one
}

/// A draw whose parts may be left out: `one(mode, first, count)` draws some of it, counted from its first
/// element, `many(mode, firsts, counts)` several such, `joined(mode, elements)` single ones.
template <class One, class Many, class Joined>
void draw_parts(GLenum mode, GLsizei count, const One& one, const Many& many, const Joined& joined) {
    if (!gate().keep(mode, primitive_count(mode, count))) return;
    const GLenum drawn = gate().as_points ? GL_POINTS : mode;
    if (!gate().parts) {
        one(drawn, 0, count);
    } else if (gate().parts->size() == 1) {
        one(drawn, static_cast<GLint>(gate().parts->front().first),
            static_cast<GLsizei>(gate().parts->front().count));
    } else if (are_to_be_joined(*gate().parts)) {
        joined(drawn, join_parts(drawn, *gate().parts));
    } else {
        std::vector<GLint> firsts;
        std::vector<GLsizei> counts;
        for (const auto& part : *gate().parts)
            firsts.push_back(static_cast<GLint>(part.first)),
                counts.push_back(static_cast<GLsizei>(part.count));
        many(drawn, firsts, counts);
    }
    gate().drawn();
}

void draw_elements_of(GLenum mode, const std::vector<GLuint>& elements) {
    gate().inner.DrawElements(mode, static_cast<GLsizei>(elements.size()), GL_UNSIGNED_INT, elements.data());
}

void APIENTRY draw_arrays(GLenum mode, GLint first, GLsizei count) {
    const GlTable& gl = gate().inner;
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
    const GlTable& gl = gate().inner;
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
    if (!gate().keep(drawn_as(mode), std::max(0, i2 - i1))) return;
    gate().inner.EvalMesh1(mode, i1, i2);
    gate().drawn();
}

void APIENTRY eval_mesh_2(GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2) {
    const long primitives = 2L * std::max(0, i2 - i1) * std::max(0, j2 - j1);
    if (!gate().keep(drawn_as(mode), primitives)) return;
    gate().inner.EvalMesh2(mode, i1, i2, j1, j2);
    gate().drawn();
}

void APIENTRY clear(GLbitfield buffers) {
    gate().cleared(buffers);
    if (!gate().draws_nothing()) gate().inner.Clear(buffers);
}

void APIENTRY blit_framebuffer(GLint x0, GLint y0, GLint x1, GLint y1, GLint to_x0, GLint to_y0, GLint to_x1,
                               GLint to_y1, GLbitfield buffers, GLenum) {
    if (buffers & GL_COLOR_BUFFER_BIT) gate().blitted({x0, y0, x1, y1}, {to_x0, to_y0, to_x1, to_y1});
}

void switch_cap(GLenum cap, bool on) {
    if (cap == GL_BLEND) {
        gate().blend = on;
        if (!gate().blends(on)) return;
    }
    on ? gate().inner.Enable(cap) : gate().inner.Disable(cap);
}
void APIENTRY enable(GLenum cap) { switch_cap(cap, true); }
void APIENTRY disable(GLenum cap) { switch_cap(cap, false); }

void APIENTRY push_attrib(GLbitfield mask) {
    gate().saved_blends.push_back({(mask & (GL_ENABLE_BIT | GL_COLOR_BUFFER_BIT)) != 0, gate().blend});
    gate().inner.PushAttrib(mask);
}

void APIENTRY pop_attrib() {
    gate().inner.PopAttrib();
    if (gate().saved_blends.empty()) return;
    const DrawGate::SavedBlend saved = gate().saved_blends.back();
    gate().saved_blends.pop_back();
    if (!saved.is_saved) return;
    gate().blend = saved.blend;
    if (gate().blending_restored()) gate().blends(saved.blend);
}

void APIENTRY push_matrix() {
    gate().before_push();
    gate().inner.PushMatrix();
}

enum When : unsigned { each_time = 1, with_colours = 2, drawing_nothing = 4 };
constexpr const char* when_names[] = {"always", "some draws are in one colour", "nothing is drawn"};

using G = GlTable;

constexpr OverrideRule rules[] = {
    {each_time, handle<Counted>(calls::array_draws), "the owner says which draws are the scene"},
    {each_time, replace<draw_arrays>(only<&G::DrawArrays>), "parts of a draw may be left out"},
    {each_time, replace<draw_elements>(only<&G::DrawElements>), "parts of a draw may be left out"},
    {each_time, handle<Rectangle>(calls::rectangles), "the owner says which draws are the scene"},
    {each_time, replace<begin>(only<&G::Begin>), "the owner says which draws are the scene"},
    {each_time, replace<end>(only<&G::End>), "only here it is known how much was drawn"},
    {each_time, replace<eval_mesh_1>(only<&G::EvalMesh1>), "the owner says which draws are the scene"},
    {each_time, replace<eval_mesh_2>(only<&G::EvalMesh2>), "the owner says which draws are the scene"},

    {each_time, handle<Vertex>(calls::vertices), "how much is drawn between glBegin and glEnd"},
    {each_time, handle<VertexWithW>(calls::vertices_with_w), "and whether a vertex has a w of its own"},
    {each_time, handle<Attribute>(calls::attributes), "attribute 0 is the vertex"},
    {with_colours, handle<Colour>(calls::colours),
     "faces that a view must hide are in the background's colour"},

    {each_time, handle<Pixels>(calls::pixels), "pixels are never solid"},
    {drawing_nothing, drop(calls::clears + calls::waits + only<&G::Accum>), "what must not happen then"},
    {each_time, replace<clear>(only<&G::Clear>), "the owner follows what is wiped"},
    {each_time, replace<blit_framebuffer>(only<&G::BlitFramebuffer, &G::BlitFramebufferEXT>),
     "the owner follows the way to the window; the images are ours"},
    {each_time, handle<Bound>(calls::framebuffer_bindings), "draws are grouped by where they go"},
    {each_time, replace<enable>(only<&G::Enable>), "the owner follows blending"},
    {each_time, replace<disable>(only<&G::Disable>), "the owner follows blending"},
    {each_time, replace<push_attrib>(only<&G::PushAttrib>), "blending has GL's stack"},
    {each_time, replace<pop_attrib>(only<&G::PopAttrib>), "blending has GL's stack"},
    {each_time, replace<push_matrix>(only<&G::PushMatrix>), "the base of a camera is what is pushed first"},
};

} // namespace

constinit const OverrideRules gate_rules = {
    "Draws by number", "Which draws are the scene, asked of an owner draw by draw", rules, when_names};

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
    table_owner<DrawGate> = &new_gate;
    GlTable table = new_gate.inner;
    override_calls(table, new_gate.inner, rules,
                   each_time | (new_gate.may_fix_colour() ? with_colours : 0u) |
                       (new_gate.draws_nothing() ? drawing_nothing : 0u));
    return table;
}

} // namespace glcast::preload
