#include "capture/forced_table.h"

#include <tuple>

#include "capture/forced_calls.h"

namespace glcast {

namespace {

thread_local constinit ForcedTable* current_table = nullptr;

template <auto Member, class Function = decltype(Member)> struct Stand;
template <auto Member, class R, class... Args> struct Stand<Member, R (APIENTRYP GlTable::*)(Args...)> {
    static R APIENTRY in_drop(Args...) { return R(); }
    static R APIENTRY in_unless_projection(Args... args) {
        const ForcedTable& self = ForcedTable::current();
        if (self.state.program.matrix_mode != GL_PROJECTION) (self.real.*Member)(args...);
    }
};
template <auto Member, class Function = decltype(Member)> struct Watched;
template <auto Member, class R, class... Args> struct Watched<Member, R (APIENTRYP GlTable::*)(Args...)> {
    static R APIENTRY call(Args... args) {
        ForcedTable::current().state.note_faces();
        return (ForcedTable::current().real.*Member)(args...);
    }
    static R APIENTRY call_faces(Args... args) {
        const GLenum mode = std::get<0>(std::tie(args...)); // points and lines of all kinds are less
        if (mode >= GL_TRIANGLES) ForcedTable::current().state.note_faces();
        return (ForcedTable::current().real.*Member)(args...);
    }
};
template <auto Member, class Function = decltype(Member)> struct NamedStack;
template <auto Member, class... Args>
struct NamedStack<Member, void (APIENTRYP GlTable::*)(GLenum, Args...)> {
    static void APIENTRY call(GLenum mode, Args... args) {
        if (mode != GL_PROJECTION) (ForcedTable::current().real.*Member)(mode, args...);
    }
};

// Entry points that the driver has not stay null, so that a program which looks still finds them missing.
template <auto... Members> void drop(GlTable& table) {
    ((table.*Members = table.*Members ? Stand<Members>::in_drop : nullptr), ...);
}
/// Matrix calls for the current stack, but for the projection, which holds P'.
template <auto... Members> void unless_projection(GlTable& table) {
    ((table.*Members = table.*Members ? Stand<Members>::in_unless_projection : nullptr), ...);
}
/// The same for calls that name their stack.
template <auto... Members> void unless_named_projection(GlTable& table) {
    ((table.*Members = table.*Members ? NamedStack<Members>::call : nullptr), ...);
}
/// Draws; of those that name what they draw, faces.
template <auto... Members> void watch(GlTable& table) {
    ((table.*Members = table.*Members ? Watched<Members>::call : nullptr), ...);
}
template <auto... Members> void watch_faces(GlTable& table) {
    ((table.*Members = table.*Members ? Watched<Members>::call_faces : nullptr), ...);
}
template <auto Function, auto... Members> void replace(GlTable& table) {
    ((table.*Members = table.*Members ? Function : nullptr), ...);
}

template <auto... Members> void keep(GlTable& table) {
    ((table.*Members = ForcedTable::current().real.*Members), ...);
}

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

struct Rule {
    Passes passes;
    void (*install)(GlTable&);
    const char* why;
};

using G = GlTable;

// Calls that are not here are kept: geometry, modelview and texture matrices, clip planes, textures, texgen,
// shade model, client arrays, evaluators, lists, queries of state. Caps of glEnable have their own table
// (forced_caps.cpp).
constexpr Rule rules[] = {
    // Where and how it is rasterised: ours.
    {in_both, drop<&G::Viewport, &G::ViewportArrayv, &G::ViewportIndexedf, &G::ViewportIndexedfv>, "n x n"},
    {in_both, drop<&G::Scissor, &G::ScissorArrayv, &G::ScissorIndexed, &G::ScissorIndexedv>,
     "all of the lattice"},
    {in_both, replace<forced::depth_range, &G::DepthRange, &G::DepthRangedNV>,
     "depth runs 0..1 through the box; the program's among coplanar surfaces"},
    {in_both, replace<forced::depth_range_f, &G::DepthRangef, &G::DepthRangefOES>,
     "depth runs 0..1 through the box; the program's among coplanar surfaces"},
    {in_both, drop<&G::DepthRangeArrayv, &G::DepthRangeIndexed, &G::ClipControl>,
     "depth runs 0..1 through the box"},
    {in_both, drop<&G::DepthBoundsEXT, &G::DepthBoundsdNV>, "one test for each side"},
    {in_both, replace<forced::depth_func, &G::DepthFunc>,
     "one test for each side; the program's among equals"},
    {in_both, replace<forced::depth_mask, &G::DepthMask>,
     "one test for each side; the program's among equals"},
    {in_both, replace<forced::stencil_func, &G::StencilFunc>, "a shadow is not a colour"},
    {in_both, replace<forced::stencil_func_separate, &G::StencilFuncSeparate>, "a shadow is not a colour"},
    {in_both,
     drop<&G::StencilFuncSeparateATI, &G::StencilOp, &G::StencilOpSeparate, &G::StencilOpSeparateATI,
          &G::StencilMask, &G::StencilMaskSeparate, &G::ActiveStencilFaceEXT>,
     "it tells which of the fragments at one depth count"},
    {in_both, drop<&G::PolygonMode, &G::EdgeFlag, &G::EdgeFlagv>, "filled; points while the box is found"},
    {in_both, replace<forced::polygon_offset, &G::PolygonOffset>,
     "exact depth; which of coplanar surfaces is seen"},
    {in_both, replace<forced::polygon_offset_ext, &G::PolygonOffsetEXT>,
     "exact depth; which of coplanar surfaces is seen"},
    {in_both, replace<forced::polygon_offset_clamp, &G::PolygonOffsetClamp, &G::PolygonOffsetClampEXT>,
     "exact depth; which of coplanar surfaces is seen"},
    {in_both,
     drop<&G::SampleCoverage, &G::SampleCoverageARB, &G::SampleMaski, &G::SampleMaskSGIS, &G::SampleMaskEXT,
          &G::MinSampleShading, &G::MinSampleShadingARB>,
     "one sample a pixel"},
    {in_both, replace<forced::front_face, &G::FrontFace>, "winding is reversed in mirrored views"},

    // What the fragment becomes: its own colour, or nothing.
    {in_both, replace<forced::colour_mask, &G::ColorMask>,
     "drawn without a colour is not shown; the program's among equals"},
    {in_both, drop<&G::ColorMaski, &G::ColorMaskIndexedEXT, &G::IndexMask>, "our framebuffer"},
    {in_both, replace<forced::alpha_func, &G::AlphaFunc>, "holes stay holes"},
    {in_both, replace<forced::blend_func, &G::BlendFunc>,
     "what lets half of the background through is not solid; the program's among equals"},
    {in_both,
     replace<forced::blend_func_separate, &G::BlendFuncSeparate, &G::BlendFuncSeparateEXT,
             &G::BlendFuncSeparateINGR>,
     "what lets half of the background through is not solid; the program's among equals"},
    {in_both, replace<forced::blend_func_indexed, &G::BlendFunci, &G::BlendFunciARB>,
     "the same for our one buffer"},
    {in_both, replace<forced::blend_equation, &G::BlendEquation, &G::BlendEquationEXT>,
     "the program's among equals"},
    {in_both,
     replace<forced::blend_equation_separate, &G::BlendEquationSeparate, &G::BlendEquationSeparateEXT>,
     "the program's among equals"},
    {in_both,
     drop<&G::BlendFuncSeparatei, &G::BlendFuncSeparateiARB, &G::BlendEquationi, &G::BlendEquationiARB,
          &G::BlendEquationSeparatei, &G::BlendEquationSeparateiARB>,
     "one buffer"},
    {in_both, replace<forced::logic_op, &G::LogicOp>, "colour of the surface; what it mixes is not solid"},
    {in_both, replace<forced::blend_colour, &G::BlendColor, &G::BlendColorEXT>,
     "the program's among equals; how much of the background it lets through"},
    {in_both, drop<&G::Fogf, &G::Fogfv, &G::Fogi, &G::Fogiv>, "colour of the surface"},
    {in_both, drop<&G::ClampColor, &G::ClampColorARB>, "colours are 0..1, normals have signs"},

    // Framebuffers: ours stays bound, whole and unread.
    {in_both, replace<forced::draw_buffer, &G::DrawBuffer>, "our framebuffer; GL_NONE is not shown"},
    {in_both, replace<forced::draw_buffers, &G::DrawBuffers, &G::DrawBuffersARB, &G::DrawBuffersATI>,
     "our framebuffer; GL_NONE is not shown"},
    {in_both,
     drop<&G::BindFramebuffer, &G::BindFramebufferEXT, &G::DeleteFramebuffers, &G::DeleteFramebuffersEXT,
          &G::FramebufferRenderbuffer, &G::FramebufferRenderbufferEXT, &G::FramebufferTexture,
          &G::FramebufferTextureARB, &G::FramebufferTextureEXT, &G::FramebufferTexture1D,
          &G::FramebufferTexture1DEXT, &G::FramebufferTexture2D, &G::FramebufferTexture2DEXT,
          &G::FramebufferTexture3D, &G::FramebufferTexture3DEXT, &G::FramebufferTextureLayer,
          &G::FramebufferTextureLayerARB, &G::FramebufferTextureLayerEXT, &G::FramebufferTextureFaceARB,
          &G::FramebufferTextureFaceEXT, &G::FramebufferParameteri, &G::FramebufferDrawBufferEXT,
          &G::FramebufferDrawBuffersEXT, &G::FramebufferReadBufferEXT, &G::InvalidateFramebuffer,
          &G::InvalidateSubFramebuffer, &G::BlitFramebuffer, &G::BlitFramebufferEXT,
          &G::BlitNamedFramebuffer>,
     "our framebuffer"},
    {in_both,
     drop<&G::NamedFramebufferDrawBuffer, &G::NamedFramebufferDrawBuffers, &G::NamedFramebufferReadBuffer,
          &G::NamedFramebufferRenderbuffer, &G::NamedFramebufferRenderbufferEXT, &G::NamedFramebufferTexture,
          &G::NamedFramebufferTexture1DEXT, &G::NamedFramebufferTexture2DEXT,
          &G::NamedFramebufferTexture3DEXT, &G::NamedFramebufferTextureEXT, &G::NamedFramebufferTextureLayer,
          &G::NamedFramebufferTextureLayerEXT, &G::NamedFramebufferTextureFaceEXT,
          &G::InvalidateNamedFramebufferData, &G::InvalidateNamedFramebufferSubData>,
     "our framebuffer, which may have the same name"},
    {in_both,
     drop<&G::BindRenderbuffer, &G::BindRenderbufferEXT, &G::DeleteRenderbuffers, &G::DeleteRenderbuffersEXT,
          &G::RenderbufferStorage, &G::RenderbufferStorageEXT, &G::RenderbufferStorageMultisample,
          &G::RenderbufferStorageMultisampleEXT>,
     "our framebuffer"},
    {in_both,
     drop<&G::ClearBufferfi, &G::ClearBufferfv, &G::ClearBufferiv, &G::ClearBufferuiv,
          &G::ClearNamedFramebufferfi, &G::ClearNamedFramebufferfv, &G::ClearNamedFramebufferiv,
          &G::ClearNamedFramebufferuiv, &G::ClearColorIiEXT, &G::ClearColorIuiEXT, &G::ClearIndex,
          &G::ClearDepth, &G::ClearDepthf, &G::ClearDepthfOES, &G::ClearDepthdNV, &G::ClearStencil,
          &G::ClearAccum>,
     "cleared once, by the pass"},
    {in_both, replace<forced::clear, &G::Clear>,
     "cleared once, by the pass; what depth was there among equals"},
    {in_both, replace<forced::clear_color, &G::ClearColor>, "cleared once, by the pass"},
    {in_both, drop<&G::Accum, &G::Bitmap, &G::DrawPixels, &G::CopyPixels>, "flat drawing is not solid"},
    {in_both, drop<&G::ReadBuffer, &G::ReadPixels, &G::ReadnPixels, &G::ReadnPixelsARB>, "only we read"},
    {in_both,
     drop<&G::CopyTexImage1D, &G::CopyTexImage1DEXT, &G::CopyTexImage2D, &G::CopyTexImage2DEXT,
          &G::CopyTexSubImage1D, &G::CopyTexSubImage1DEXT, &G::CopyTexSubImage2D, &G::CopyTexSubImage2DEXT,
          &G::CopyTexSubImage3D, &G::CopyTexSubImage3DEXT>,
     "would copy our images into shared textures"},
    {in_both,
     drop<&G::CopyTextureImage1DEXT, &G::CopyTextureImage2DEXT, &G::CopyTextureSubImage1D,
          &G::CopyTextureSubImage1DEXT, &G::CopyTextureSubImage2D, &G::CopyTextureSubImage2DEXT,
          &G::CopyTextureSubImage3D, &G::CopyTextureSubImage3DEXT, &G::CopyMultiTexImage1DEXT,
          &G::CopyMultiTexImage2DEXT, &G::CopyMultiTexSubImage1DEXT, &G::CopyMultiTexSubImage2DEXT,
          &G::CopyMultiTexSubImage3DEXT>,
     "would copy our images into shared textures"},
    {in_both,
     drop<&G::BeginQuery, &G::BeginQueryARB, &G::BeginQueryIndexed, &G::EndQuery, &G::EndQueryARB,
          &G::EndQueryIndexed, &G::QueryCounter, &G::BeginOcclusionQueryNV, &G::EndOcclusionQueryNV,
          &G::BeginConditionalRender, &G::EndConditionalRender, &G::BeginConditionalRenderNV,
          &G::EndConditionalRenderNV>,
     "everything is drawn, whatever could be seen"},
    {in_both, replace<forced::render_mode, &G::RenderMode>, "selection draws nothing"},
    {in_both, drop<&G::SelectBuffer, &G::FeedbackBuffer>, "the program's memory"},
    {in_both, drop<&G::Finish, &G::Flush>, "we wait for what we read"},

    // The projection stack holds P'.
    {in_both, replace<forced::matrix_mode, &G::MatrixMode>, "tells which stack is meant"},
    {in_both,
     unless_projection<&G::LoadIdentity, &G::LoadMatrixf, &G::LoadMatrixd, &G::MultMatrixf, &G::MultMatrixd,
                       &G::LoadTransposeMatrixf, &G::LoadTransposeMatrixd, &G::LoadTransposeMatrixfARB,
                       &G::LoadTransposeMatrixdARB, &G::MultTransposeMatrixf, &G::MultTransposeMatrixd,
                       &G::MultTransposeMatrixfARB, &G::MultTransposeMatrixdARB>,
     "P'"},
    {in_both,
     unless_projection<&G::Ortho, &G::Frustum, &G::Rotatef, &G::Rotated, &G::Scalef, &G::Scaled,
                       &G::Translatef, &G::Translated, &G::PushMatrix, &G::PopMatrix>,
     "P'"},
    {in_both,
     unless_named_projection<&G::MatrixLoadIdentityEXT, &G::MatrixLoadfEXT, &G::MatrixLoaddEXT,
                             &G::MatrixMultfEXT, &G::MatrixMultdEXT, &G::MatrixLoadTransposefEXT,
                             &G::MatrixLoadTransposedEXT, &G::MatrixMultTransposefEXT,
                             &G::MatrixMultTransposedEXT, &G::MatrixOrthoEXT, &G::MatrixFrustumEXT,
                             &G::MatrixRotatefEXT, &G::MatrixRotatedEXT, &G::MatrixScalefEXT,
                             &G::MatrixScaledEXT, &G::MatrixTranslatefEXT, &G::MatrixTranslatedEXT,
                             &G::MatrixPushEXT, &G::MatrixPopEXT>,
     "P'"},

    // Light and material.
    {in_both, drop<&G::Lightf, &G::Lightfv, &G::Lighti, &G::Lightiv>,
     "ambient light only; six lights of ours"},
    {in_both, replace<forced::light_model_f, &G::LightModelf>, "only two-sidedness is the program's"},
    {in_both, replace<forced::light_model_fv, &G::LightModelfv>, "only two-sidedness is the program's"},
    {in_both, replace<forced::light_model_i, &G::LightModeli>, "only two-sidedness is the program's"},
    {in_both, replace<forced::light_model_iv, &G::LightModeliv>, "only two-sidedness is the program's"},
    {in_colour, replace<forced::material_f, &G::Materialf>,
     "diffuse is what a colour is; it is delivered as ambient"},
    {in_colour, replace<forced::material_fv, &G::Materialfv>,
     "diffuse is what a colour is; it is delivered as ambient"},
    {in_colour, replace<forced::material_i, &G::Materiali>,
     "diffuse is what a colour is; it is delivered as ambient"},
    {in_colour, replace<forced::material_iv, &G::Materialiv>,
     "diffuse is what a colour is; it is delivered as ambient"},
    {in_colour, replace<forced::colour_material, &G::ColorMaterial>, "mapped as materials are"},
    {in_normal, drop<&G::Materialf, &G::Materialfv, &G::Materiali, &G::Materialiv, &G::ColorMaterial>,
     "white"},
    {in_normal, drop<&G::UseProgram, &G::UseProgramObjectARB, &G::BindProgramPipeline>,
     "a shader's colours are not normals"},

    // Our fragment shader, and what it reads.
    {in_peel, replace<forced::use_program, &G::UseProgram>, "our shader stays"},
    {in_peel, replace<forced::use_program_object, &G::UseProgramObjectARB>, "our shader stays"},
    {in_peel, drop<&G::BindProgramPipeline>, "our shader stays"},
    {in_peel, replace<forced::bind_texture, &G::BindTexture, &G::BindTextureEXT>, "our texture stays bound"},
    {in_peel,
     drop<&G::BindTextures, &G::BindTextureUnit, &G::BindMultiTextureEXT, &G::BindSampler, &G::BindSamplers>,
     "our texture stays bound"},

    // The program's own stencil test, and nothing to be seen.
    {in_stencil,
     keep<&G::StencilFunc, &G::StencilFuncSeparate, &G::StencilFuncSeparateATI, &G::StencilOp,
          &G::StencilOpSeparate, &G::StencilOpSeparateATI, &G::StencilMask, &G::StencilMaskSeparate,
          &G::ActiveStencilFaceEXT>,
     "it is worked out in this view"},

    // Which offsets faces are drawn with.
    {in_learning,
     watch_faces<&G::Begin, &G::DrawArrays, &G::DrawArraysEXT, &G::DrawElements, &G::DrawRangeElements,
                 &G::DrawRangeElementsEXT, &G::DrawElementsBaseVertex, &G::DrawRangeElementsBaseVertex>,
     "an offset that nothing is drawn with is none"},
    {in_learning,
     watch_faces<&G::DrawArraysInstanced, &G::DrawArraysInstancedARB, &G::DrawArraysInstancedEXT,
                 &G::DrawArraysInstancedBaseInstance, &G::DrawElementsInstanced, &G::DrawElementsInstancedARB,
                 &G::DrawElementsInstancedEXT, &G::DrawElementsInstancedBaseVertex,
                 &G::DrawElementsInstancedBaseInstance, &G::DrawElementsInstancedBaseVertexBaseInstance,
                 &G::DrawArraysIndirect, &G::DrawElementsIndirect>,
     "an offset that nothing is drawn with is none"},
    {in_learning,
     watch_faces<&G::MultiDrawArrays, &G::MultiDrawArraysEXT, &G::MultiDrawElements, &G::MultiDrawElementsEXT,
                 &G::MultiDrawElementsBaseVertex, &G::EvalMesh2>,
     "an offset that nothing is drawn with is none"},
    {in_learning,
     watch<&G::Rectd, &G::Rectf, &G::Recti, &G::Rects, &G::Rectdv, &G::Rectfv, &G::Rectiv, &G::Rectsv>,
     "an offset that nothing is drawn with is none"},

    // Where tracked state comes from.
    {in_both, replace<forced::enable, &G::Enable>, "table of caps"},
    {in_both, replace<forced::disable, &G::Disable>, "table of caps"},
    {in_both, replace<forced::enable_indexed, &G::Enablei, &G::EnableIndexedEXT>, "table of caps"},
    {in_both, replace<forced::disable_indexed, &G::Disablei, &G::DisableIndexedEXT>, "table of caps"},
    {in_both, replace<forced::push_attrib, &G::PushAttrib>, "tracked state has GL's stack"},
    {in_both, replace<forced::pop_attrib, &G::PopAttrib>, "tracked state has GL's stack"},
};

} // namespace

ForcedTable::ForcedTable(const GlTable& real, const PassFacts& pass, bool mirrored)
    : real(real), kind(pass.kind), mirrored(mirrored), state(real, pass), forced(real) {
    unsigned passes = kind == PassKind::normal    ? in_normal
                      : kind == PassKind::peel    ? in_colour | in_peel
                      : kind == PassKind::stencil ? in_colour | in_stencil
                                                  : in_colour;
    if (pass.learnt) passes |= in_learning;
    current_table = this;
    for (const Rule& rule : rules)
        if (rule.passes & passes) rule.install(forced);
    state.apply();
    real.FrontFace(mirrored ? GL_CW : GL_CCW);
}

ForcedTable::~ForcedTable() { current_table = nullptr; }

ForcedTable& ForcedTable::current() { return *current_table; }

GLenum mirrored_winding(GLenum mode) {
    if (mode == GL_CW) return GL_CCW;
    if (mode == GL_CCW) return GL_CW;
    return mode;
}

} // namespace glcast
