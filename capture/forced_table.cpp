#include "capture/forced_table.h"

#include "capture/forced_calls.h"
#include "capture/gl/call_classes.h"

namespace glcast {

namespace {

struct ForForced {
    using Owner = ForcedTable;
};

/// Matrix calls for the current stack, but for the projection, which holds P'.
struct UnlessProjection : ForForced {
    static constexpr const char* what = "not on the projection";
    static void call(auto below, auto... args) {
        if (ForcedTable::current().state.program.matrix_mode != GL_PROJECTION) below(args...);
    }
};
/// The same for calls that name their stack.
struct UnlessNamedProjection : ForForced {
    static constexpr const char* what = "not on the projection";
    static void call(auto below, GLenum stack, auto... args) {
        if (stack != GL_PROJECTION) below(stack, args...);
    }
};
/// Draws of faces.
struct Noted : ForForced {
    static constexpr const char* what = "noted, then made";
    static void call(auto below, auto... args) {
        ForcedTable::current().state.note_faces();
        below(args...);
    }
};
/// Draws that say what they draw.
struct NotedFaces : ForForced {
    static constexpr const char* what = "faces are noted, then made";
    static void call(auto below, GLenum mode, auto... args) {
        if (mode >= GL_TRIANGLES) ForcedTable::current().state.note_faces(); // points and lines are less
        below(mode, args...);
    }
};

/// Peel and stencil passes force what colour passes do, and more or less. The first pass of all learns what
/// there is.
enum Passes : unsigned {
    in_colour = 1,
    in_normal = 2,
    in_both = 3,
    in_peel = 4,
    in_learning = 8,
    in_stencil = 16
};

constexpr const char* pass_names[] = {"colour", "normal", "peel", "learning", "stencil"};

using G = GlTable;

// Calls that are not here are kept: geometry, modelview and texture matrices, clip planes, textures, texgen,
// shade model, client arrays, evaluators, lists, queries of state. Caps of glEnable have their own table
// (forced_caps.cpp).
constexpr OverrideRule rules[] = {
    // Where and how it is rasterised: ours.
    {in_both, drop(calls::viewports), "n x n"},
    {in_both, drop(calls::scissors), "all of the lattice"},
    {in_both, replace<forced::depth_range>(only<&G::DepthRange, &G::DepthRangedNV>),
     "depth runs 0..1 through the box; the program's among coplanar surfaces"},
    {in_both, replace<forced::depth_range_f>(only<&G::DepthRangef, &G::DepthRangefOES>),
     "depth runs 0..1 through the box; the program's among coplanar surfaces"},
    {in_both, drop(only<&G::DepthRangeArrayv, &G::DepthRangeIndexed, &G::ClipControl>),
     "depth runs 0..1 through the box"},
    {in_both, drop(only<&G::DepthBoundsEXT, &G::DepthBoundsdNV>), "one test for each side"},
    {in_both, replace<forced::depth_func>(only<&G::DepthFunc>),
     "one test for each side; the program's among equals"},
    {in_both, replace<forced::depth_mask>(only<&G::DepthMask>),
     "one test for each side; the program's among equals"},
    {in_both, replace<forced::stencil_func>(only<&G::StencilFunc>), "a shadow is not a colour"},
    {in_both, replace<forced::stencil_func_separate>(only<&G::StencilFuncSeparate>),
     "a shadow is not a colour"},
    {in_both,
     drop(only<&G::StencilFuncSeparateATI, &G::StencilOp, &G::StencilOpSeparate, &G::StencilOpSeparateATI,
               &G::StencilMask, &G::StencilMaskSeparate, &G::ActiveStencilFaceEXT>),
     "it tells which of the fragments at one depth count"},
    {in_both, drop(only<&G::PolygonMode, &G::EdgeFlag, &G::EdgeFlagv>),
     "filled; points while the box is found"},
    {in_both, replace<forced::polygon_offset>(only<&G::PolygonOffset>),
     "exact depth; which of coplanar surfaces is seen"},
    {in_both, replace<forced::polygon_offset_ext>(only<&G::PolygonOffsetEXT>),
     "exact depth; which of coplanar surfaces is seen"},
    {in_both, replace<forced::polygon_offset_clamp>(only<&G::PolygonOffsetClamp, &G::PolygonOffsetClampEXT>),
     "exact depth; which of coplanar surfaces is seen"},
    {in_both, drop(calls::sample_masks), "one sample a pixel"},
    {in_both, replace<forced::front_face>(only<&G::FrontFace>), "winding is reversed in mirrored views"},

    // What the fragment becomes: its own colour, or nothing.
    {in_both, replace<forced::colour_mask>(only<&G::ColorMask>),
     "drawn without a colour is not shown; the program's among equals"},
    {in_both, drop(only<&G::ColorMaski, &G::ColorMaskIndexedEXT, &G::IndexMask>), "our framebuffer"},
    {in_both, replace<forced::alpha_func>(only<&G::AlphaFunc>), "holes stay holes"},
    {in_both, replace<forced::blend_func>(only<&G::BlendFunc>),
     "what lets half of the background through is not solid; the program's among equals"},
    {in_both,
     replace<forced::blend_func_separate>(
         only<&G::BlendFuncSeparate, &G::BlendFuncSeparateEXT, &G::BlendFuncSeparateINGR>),
     "what lets half of the background through is not solid; the program's among equals"},
    {in_both, replace<forced::blend_func_indexed>(only<&G::BlendFunci, &G::BlendFunciARB>),
     "the same for our one buffer"},
    {in_both, replace<forced::blend_equation>(only<&G::BlendEquation, &G::BlendEquationEXT>),
     "the program's among equals"},
    {in_both,
     replace<forced::blend_equation_separate>(only<&G::BlendEquationSeparate, &G::BlendEquationSeparateEXT>),
     "the program's among equals"},
    {in_both,
     drop(only<&G::BlendFuncSeparatei, &G::BlendFuncSeparateiARB, &G::BlendEquationi, &G::BlendEquationiARB,
               &G::BlendEquationSeparatei, &G::BlendEquationSeparateiARB>),
     "one buffer"},
    {in_both, replace<forced::logic_op>(only<&G::LogicOp>),
     "colour of the surface; what it mixes is not solid"},
    {in_both, replace<forced::blend_colour>(only<&G::BlendColor, &G::BlendColorEXT>),
     "the program's among equals; how much of the background it lets through"},
    {in_both, drop(calls::fog), "colour of the surface"},
    {in_both, drop(only<&G::ClampColor, &G::ClampColorARB>), "colours are 0..1, normals have signs"},

    // Framebuffers: ours stays bound, whole and unread.
    {in_both, replace<forced::draw_buffer>(only<&G::DrawBuffer>), "our framebuffer; GL_NONE is not shown"},
    {in_both, replace<forced::draw_buffers>(only<&G::DrawBuffers, &G::DrawBuffersARB, &G::DrawBuffersATI>),
     "our framebuffer; GL_NONE is not shown"},
    {in_both, drop(calls::framebuffers), "our framebuffer, which may have the same name"},
    {in_both, drop(calls::renderbuffers), "our framebuffer"},
    {in_both, drop(calls::clears + calls::clear_values), "cleared once, by the pass"},
    {in_both, replace<forced::clear>(only<&G::Clear>),
     "cleared once, by the pass; what depth was there among equals"},
    {in_both, replace<forced::clear_color>(only<&G::ClearColor>), "cleared once, by the pass"},
    {in_both, drop(calls::pixels + only<&G::Accum>), "flat drawing is not solid"},
    {in_both, drop(calls::pixel_reads), "only we read"},
    {in_both, drop(calls::texture_copies), "would copy our images into shared textures"},
    {in_both, drop(calls::queries), "everything is drawn, whatever could be seen"},
    {in_both, replace<forced::render_mode>(only<&G::RenderMode>), "selection draws nothing"},
    {in_both, drop(only<&G::SelectBuffer, &G::FeedbackBuffer>), "the program's memory"},
    {in_both, drop(calls::waits), "we wait for what we read"},

    // The projection stack holds P'.
    {in_both, replace<forced::matrix_mode>(only<&G::MatrixMode>), "tells which stack is meant"},
    {in_both, handle<UnlessProjection>(calls::matrices), "P'"},
    {in_both, handle<UnlessNamedProjection>(calls::named_matrices), "P'"},

    // Light and material.
    {in_both, drop(calls::lights), "ambient light only; six lights of ours"},
    {in_both, replace<forced::light_model_f>(only<&G::LightModelf>), "only two-sidedness is the program's"},
    {in_both, replace<forced::light_model_fv>(only<&G::LightModelfv>), "only two-sidedness is the program's"},
    {in_both, replace<forced::light_model_i>(only<&G::LightModeli>), "only two-sidedness is the program's"},
    {in_both, replace<forced::light_model_iv>(only<&G::LightModeliv>), "only two-sidedness is the program's"},
    {in_colour, replace<forced::material_f>(only<&G::Materialf>),
     "diffuse is what a colour is; it is delivered as ambient"},
    {in_colour, replace<forced::material_fv>(only<&G::Materialfv>),
     "diffuse is what a colour is; it is delivered as ambient"},
    {in_colour, replace<forced::material_i>(only<&G::Materiali>),
     "diffuse is what a colour is; it is delivered as ambient"},
    {in_colour, replace<forced::material_iv>(only<&G::Materialiv>),
     "diffuse is what a colour is; it is delivered as ambient"},
    {in_colour, replace<forced::colour_material>(only<&G::ColorMaterial>), "mapped as materials are"},
    {in_normal, drop(calls::materials + only<&G::ColorMaterial>), "white"},
    {in_normal, drop(calls::program_bindings), "a shader's colours are not normals"},

    // Our fragment shader, and what it reads.
    {in_peel, replace<forced::use_program>(only<&G::UseProgram>), "our shader stays"},
    {in_peel, replace<forced::use_program_object>(only<&G::UseProgramObjectARB>), "our shader stays"},
    {in_peel, drop(only<&G::BindProgramPipeline>), "our shader stays"},
    {in_peel, replace<forced::bind_texture>(only<&G::BindTexture, &G::BindTextureEXT>),
     "our texture stays bound"},
    {in_peel,
     drop(only<&G::BindTextures, &G::BindTextureUnit, &G::BindMultiTextureEXT, &G::BindSampler,
               &G::BindSamplers>),
     "our texture stays bound"},

    // The program's own stencil test, and nothing to be seen.
    {in_stencil, keep(calls::stencil), "it is worked out in this view"},

    // Which offsets faces are drawn with.
    {in_learning, handle<NotedFaces>(calls::array_draws + only<&G::Begin, &G::EvalMesh2>),
     "an offset that nothing is drawn with is none"},
    {in_learning, handle<Noted>(calls::rectangles), "an offset that nothing is drawn with is none"},

    // Where tracked state comes from.
    {in_both, replace<forced::enable>(only<&G::Enable>), "table of caps"},
    {in_both, replace<forced::disable>(only<&G::Disable>), "table of caps"},
    {in_both, replace<forced::enable_indexed>(only<&G::Enablei, &G::EnableIndexedEXT>), "table of caps"},
    {in_both, replace<forced::disable_indexed>(only<&G::Disablei, &G::DisableIndexedEXT>), "table of caps"},
    {in_both, replace<forced::push_attrib>(only<&G::PushAttrib>), "tracked state has GL's stack"},
    {in_both, replace<forced::pop_attrib>(only<&G::PopAttrib>), "tracked state has GL's stack"},
};

} // namespace

constinit const OverrideRules forced_rules = {
    "A pass of a view", "What every image of a view forces on the program's calls (design, section 3)", rules,
    pass_names};

ForcedTable::ForcedTable(const GlTable& real, const PassFacts& pass, bool mirrored)
    : real(real), kind(pass.kind), mirrored(mirrored), state(real, pass), forced(real) {
    unsigned passes = kind == PassKind::normal    ? in_normal
                      : kind == PassKind::peel    ? in_colour | in_peel
                      : kind == PassKind::stencil ? in_colour | in_stencil
                                                  : in_colour;
    if (pass.learnt) passes |= in_learning;
    table_owner<ForcedTable> = this;
    override_calls(forced, real, rules, passes);
    state.apply();
    real.FrontFace(mirrored ? GL_CW : GL_CCW);
}

ForcedTable::~ForcedTable() { table_owner<ForcedTable> = nullptr; }

ForcedTable& ForcedTable::current() { return *table_owner<ForcedTable>; }

GLenum mirrored_winding(GLenum mode) {
    if (mode == GL_CW) return GL_CCW;
    if (mode == GL_CCW) return GL_CW;
    return mode;
}

} // namespace glcast
