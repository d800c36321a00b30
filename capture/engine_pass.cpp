#include "capture/engine_pass.h"

#include <glm/glm.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <utility>

#include "capture/engine_peel.h"
#include "capture/forced_caps.h"
#include "capture/forced_table.h"
#include "capture/program_stencil.h"

namespace glcast {

namespace {

constexpr int light_count = 6;

bool at_known_depth(const Pass& pass) {
    return pass.depth == DepthRule::equal || pass.depth == DepthRule::blend;
}

StencilRule stencil_rule(const Pass& pass) {
    const bool count = pass.depth == DepthRule::count, equal = at_known_depth(pass);
    const bool missed = pass.depth == DepthRule::missed;
    return {.tests = equal || missed || count,
            .uncounted_only = equal || missed,
            .hidden = count ? GLenum(GL_INCR) : GLenum(GL_KEEP),
            .shown = equal || count ? GLenum(GL_INCR) : GLenum(GL_KEEP)};
}

GLenum depth_function(const Pass& pass) {
    if (at_known_depth(pass)) return GL_EQUAL;
    return pass.side == Side::minus ? GL_LESS : GL_GREATER;
}

void set_cap(const GlTable& gl, GLenum cap, bool on) { on ? gl.Enable(cap) : gl.Disable(cap); }

void unwind(const GlTable& gl, GLenum depth_name, GLint bottom, void(APIENTRYP pop)()) {
    GLint depth = bottom;
    gl.GetIntegerv(depth_name, &depth);
    for (; depth > bottom; --depth) pop();
}

/// Whatever the draw before left pushed.
void unwind_stacks(const GlTable& gl) {
    unwind(gl, GL_ATTRIB_STACK_DEPTH, 0, gl.PopAttrib);
    unwind(gl, GL_CLIENT_ATTRIB_STACK_DEPTH, 0, gl.PopClientAttrib);
    unwind(gl, GL_NAME_STACK_DEPTH, 0, gl.PopName);
}

void reset_matrix(const GlTable& gl, GLenum mode, GLenum depth_name) {
    gl.MatrixMode(mode);
    unwind(gl, depth_name, 1, gl.PopMatrix);
    gl.LoadIdentity();
}

void reset_texture_matrices(const GlTable& gl) {
    GLint units = 1;
    gl.GetIntegerv(GL_MAX_TEXTURE_UNITS, &units);
    for (GLint unit = gl.ActiveTexture ? units - 1 : 0; unit >= 0; --unit) {
        if (gl.ActiveTexture) gl.ActiveTexture(GL_TEXTURE0 + unit);
        reset_matrix(gl, GL_TEXTURE, GL_TEXTURE_STACK_DEPTH);
    }
}

/// What every pass has in common, at GL's defaults where the program may change it.
void reset_drawing_state(const GlTable& gl, const Pass& pass) {
    gl.DepthRange(0, 1);
    gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl.PolygonMode(GL_FRONT_AND_BACK, pass.polygon_mode);
    gl.PointSize(1);
    gl.ShadeModel(GL_SMOOTH);
    gl.Color4f(1, 1, 1, 1);
    gl.Normal3f(0, 0, 1);
    if (gl.UseProgram) gl.UseProgram(0);
    if (!gl.ClampColor) return;
    const bool has_signs = pass.lights == Lights::signed_colour;
    gl.ClampColor(GL_CLAMP_VERTEX_COLOR, has_signs ? GL_FALSE : GL_TRUE);
    gl.ClampColor(GL_CLAMP_FRAGMENT_COLOR, has_signs ? GL_FALSE : GL_TRUE);
    gl.ClampColor(GL_CLAMP_READ_COLOR, GL_FALSE);
}

/// Until the next pass: the program's own scissor calls are dropped.
void scissor(const GlTable& gl, const PixelRect& rect) {
    gl.Enable(GL_SCISSOR_TEST);
    gl.Scissor(rect.x0, rect.y0, rect.x1 - rect.x0, rect.y1 - rect.y0);
}

void clear(const GlTable& gl, const Pass& pass) {
    GLbitfield buffers = 0;
    if (pass.depth != DepthRule::blend) buffers |= GL_COLOR_BUFFER_BIT;
    if (!at_known_depth(pass)) buffers |= GL_DEPTH_BUFFER_BIT;
    if (pass.depth != DepthRule::missed) buffers |= GL_STENCIL_BUFFER_BIT;
    gl.DepthMask(GL_TRUE);
    gl.StencilMask(~0u);
    gl.ClearColor(0, 0, 0, missed_alpha);
    gl.ClearDepth(ViewImage::background(pass.side));
    gl.ClearStencil(0);
    gl.Clear(buffers);
}

/// Rotation part of a similarity.
glm::dmat3 rotation_of(const glm::dmat4& similarity) {
    const glm::dmat3 linear(similarity);
    return linear / std::cbrt(std::abs(glm::determinant(linear)));
}

void set_light(const GlTable& gl, GLenum light, const glm::vec4& towards, const glm::vec4& colour) {
    constexpr GLfloat black[] = {0, 0, 0, 1};
    gl.Lightfv(light, GL_POSITION, glm::value_ptr(towards));
    gl.Lightfv(light, GL_AMBIENT, black);
    gl.Lightfv(light, GL_DIFFUSE, glm::value_ptr(colour));
    gl.Lightfv(light, GL_SPECULAR, black);
    gl.Lightf(light, GL_SPOT_CUTOFF, 180);
    gl.Lightf(light, GL_CONSTANT_ATTENUATION, 1);
    gl.Lightf(light, GL_LINEAR_ATTENUATION, 0);
    gl.Lightf(light, GL_QUADRATIC_ATTENUATION, 0);
    gl.Enable(light);
}

OffsetClamp bounded_offset(const GlTable& gl) {
    if (has_extension(gl, "GL_ARB_polygon_offset_clamp")) return gl.PolygonOffsetClamp;
    if (has_extension(gl, "GL_EXT_polygon_offset_clamp")) return gl.PolygonOffsetClampEXT;
    return nullptr;
}

} // namespace

PassRunner::PassRunner(const GlTable& gl, const DrawFunction& draw, const EngineOptions& options)
    : gl(gl), draw(draw), eye_to_capture(options.eye_to_capture),
      mirrored_projection(options.mirrored_projection), stencil(options.stencil),
      offset_clamp(bounded_offset(gl)) {
    if (stencil) stencil->forget();
}

/// The first pass of all is drawn again where it met several offsets, which it then knows.
void PassRunner::run(const Pass& pass, const Target& target) {
    if (stencil) find_masks(pass, target);
    if (pass.outline && !std::exchange(has_noted_places, true)) note_places(pass, target);
    draw_once(pass, target, !offsets_known);
    if (!std::exchange(offsets_known, true) && offset_levels.several()) draw_once(pass, target, false);
}

/// Of the view of the pass, where they are not known; the target's images are lost then. The first pass of a
/// view needs none.
void PassRunner::find_masks(const Pass& pass, const Target& target) {
    stencil->look({pass.box, pass.axis, target.size()});
    for (const Side viewer : {Side::minus, Side::plus})
        if (!pass.outermost || viewer == pass.side) find_masks_of(viewer, pass, target);
}

/// However much lies outside the box: what is cut by its sides still has fronts and backs.
void PassRunner::find_masks_of(Side viewer, const Pass& pass, const Target& target) {
    constexpr double far_out = 1000; // boxes
    if (stencil->knows(viewer)) return;
    Pass marks;
    marks.kind = PassKind::stencil;
    marks.depth = DepthRule::unused;
    marks.box = pass.box, marks.axis = pass.axis, marks.side = viewer;
    marks.near = -far_out, marks.far = 1 + far_out;
    marks.offsets = false;
    stencil->begin_finding(target, viewer);
    draw_once(marks, target, false);
    stencil->end();
}

PassFacts PassRunner::facts(const Pass& pass, const Target& target, bool learning) {
    PassFacts facts;
    facts.kind = pass.kind;
    facts.depth = depth_function(pass);
    facts.stencil = stencil_rule(pass);
    facts.culls = pass.culls;
    facts.viewer_at_plus = pass.side == Side::plus;
    facts.outermost = pass.outermost;
    if (learning) facts.learnt = &offset_levels;
    if (learning || !pass.offsets || !offset_levels.several()) return facts;
    facts.levels = &offset_levels;
    const double towards = pass.side == Side::plus ? 1 : -1;
    facts.shift.projection = projection(pass);
    facts.shift.clip_step = towards * 2 * offset_step / target.size() / (pass.far - pass.near);
    facts.shift.slope_step = static_cast<float>(towards * offset_step);
    facts.shift.slope_most = static_cast<float>(facts.shift.clip_step / 2 * steepest);
    facts.shift.offset_clamp = offset_clamp;
    return facts;
}

void PassRunner::draw_once(const Pass& pass, const Target& target, bool learning) {
    set_state(pass, target);
    {
        ForcedTable forced(gl, facts(pass, target, learning), mirrored(pass));
        ++draw_count;
        const bool masked = stencil && pass.kind != PassKind::stencil;
        if (masked) stencil->begin_pass(pass.outermost ? std::optional(pass.side) : std::nullopt, pass.only);
        draw(forced.table(), sought(pass, learning));
        if (masked) stencil->end();
        own_program |= forced.state.saw_own_program;
        unblended = forced.state.saw_blending || forced.state.depth_clears > 1;
    }
    gl.RenderMode(GL_RENDER);
    gl.Finish();
    swallow_errors(gl);
}

/// Before the first pass that leaves out what lies inside of the rest.
void PassRunner::note_places(const Pass& pass, const Target& target) {
    set_state(pass, target);
    ForcedTable forced(gl, facts(pass, target, false), mirrored(pass));
    Sought sought;
    sought.eye_to_capture = eye_to_capture;
    sought.notes_places = sought.only_places = true;
    draw(forced.table(), sought);
    swallow_errors(gl);
}

/// What is drawn nearer by its offset lies at no depth of its own. A pass that learns of several offsets is
/// drawn again, and shows nothing where a stencil test keeps it to places.
Sought PassRunner::sought(const Pass& pass, bool learning) const {
    Sought sought;
    sought.eye_to_capture = eye_to_capture;
    sought.notes_places = pass.outline != nullptr;
    sought.shows_all = learning;
    if (learning && (stencil || !pass.outline)) return sought;
    const bool shifts = pass.offsets && offset_levels.several();
    if (!shifts) sought.open = pass.open, sought.outline = pass.outline;
    if (pass.polygon_mode == GL_POINT && !shifts) sought.corners = &pass.box;
    return sought;
}

void PassRunner::set_state(const Pass& pass, const Target& target) const {
    unwind_stacks(gl);
    reset_caps(gl);
    target.bind();
    if (pass.only) scissor(gl, *pass.only);
    reset_drawing_state(gl, pass);
    if (pass.depth != DepthRule::add) clear(gl, pass);
    set_depth_rule(pass);
    set_lights(pass);
    reset_texture_matrices(gl);
    set_matrices(pass);
    if (pass.kind == PassKind::peel) pass.shader->use();
    swallow_errors(gl);
}

void PassRunner::set_depth_rule(const Pass& pass) const {
    set_cap(gl, GL_DEPTH_TEST, pass.depth != DepthRule::unused);
    gl.DepthFunc(depth_function(pass));
    gl.DepthMask(at_known_depth(pass) ? GL_FALSE : GL_TRUE);
    stencil_rule(pass).apply(gl, false);
}

glm::dmat4 PassRunner::projection(const Pass& pass) const {
    return lattice_slab_projection(pass.box, pass.axis, pass.near, pass.far) * eye_to_capture;
}

void PassRunner::set_matrices(const Pass& pass) const {
    reset_matrix(gl, GL_PROJECTION, GL_PROJECTION_STACK_DEPTH);
    gl.LoadMatrixd(glm::value_ptr(projection(pass)));
    reset_matrix(gl, GL_MODELVIEW, GL_MODELVIEW_STACK_DEPTH);
}

/// Lights stand along the axes of the capture frame, so that what they paint is the normal in that frame.
void PassRunner::set_lights(const Pass& pass) const {
    constexpr GLfloat black[] = {0, 0, 0, 1}, grey[] = {0.8f, 0.8f, 0.8f, 1};
    gl.Materialfv(GL_FRONT_AND_BACK, GL_AMBIENT_AND_DIFFUSE, grey); // GL's default for diffuse
    gl.Materialfv(GL_FRONT_AND_BACK, GL_EMISSION, black);
    gl.Materialfv(GL_FRONT_AND_BACK, GL_SPECULAR, black);
    const GLfloat level = pass.lights == Lights::none          ? 1.0f
                          : pass.lights == Lights::half_colour ? 0.5f
                                                               : 0.0f;
    const GLfloat ambient[] = {level, level, level, 1};
    gl.LightModelfv(GL_LIGHT_MODEL_AMBIENT, ambient);
    gl.LightModeli(GL_LIGHT_MODEL_TWO_SIDE, GL_FALSE);
    gl.LightModeli(GL_LIGHT_MODEL_LOCAL_VIEWER, GL_FALSE);
    gl.LightModeli(GL_LIGHT_MODEL_COLOR_CONTROL, GL_SINGLE_COLOR);
    for (int i = 0; i < light_count; ++i) gl.Disable(GL_LIGHT0 + i);
    if (pass.lights == Lights::none) return;

    gl.Enable(GL_LIGHTING);
    gl.MatrixMode(GL_MODELVIEW);
    gl.LoadIdentity();
    const glm::dmat3 to_eye = glm::transpose(rotation_of(eye_to_capture));
    for (int i = 0; i < light_count; ++i) {
        if (pass.lights == Lights::single && i != pass.light) continue;
        const float sign = i % 2 ? -1.0f : 1.0f, strength = pass.lights == Lights::half_colour ? 0.5f : 1.0f;
        glm::vec4 colour(0, 0, 0, 1);
        if (pass.lights == Lights::single)
            colour = glm::vec4(1);
        else
            colour[i / 2] = sign * strength;
        set_light(gl, GL_LIGHT0 + i, glm::vec4(glm::dvec3(to_eye[i / 2]) * double(sign), 0), colour);
    }
}

/// A viewer on the view's side sees u to the right and v up only when u x v points at him; else his image is
/// the mirror image of ours, and what turns counter-clockwise for him turns clockwise for us.
bool PassRunner::mirrored(const Pass& pass) const {
    const ImageAxes axes = image_axes(pass.axis);
    const bool right_handed = (axes.u + 1) % 3 == axes.v; // u x v = +depth
    const bool viewer_at_plus = pass.viewer.value_or(pass.side) == Side::plus;
    const bool reflected = glm::determinant(glm::dmat3(eye_to_capture)) < 0;
    return (right_handed != viewer_at_plus) != (reflected != mirrored_projection);
}

} // namespace glcast
