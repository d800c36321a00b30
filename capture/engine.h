// The capture engine: draw a scene under views and lights of our own, and read what was seen.
// Method: Natvig 2006, "Simplified Mesh Generation from Renders", sections 2-4.
#pragma once
#include <array>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include "capture/gl/gl_table.h"
#include "capture/sought.h"
#include "capture/view.h"
#include "capture/view_image.h"

namespace glcast {

class ProgramStencil;

/// Draws the whole scene once through the table it is given, and through nothing else. It may set any state,
/// clear and change matrices: the table forces what a pass needs (capture/forced_table.h). It is called many
/// times and must draw the same each time. State it relies on, it must set (a replayed frame starts with its
/// own prologue).
class DrawFunction {
  public:
    DrawFunction() = default;
    /// Of a function that always draws everything, or of one that is also told what the pass looks for.
    template <class Function>
    requires(!std::is_same_v<std::remove_cvref_t<Function>, DrawFunction>) DrawFunction(Function function) {
        if constexpr (std::is_invocable_v<Function&, const GlTable&, const Sought&>)
            draw = std::move(function);
        else
            draw = [function = std::move(function)](const GlTable& gl, const Sought&) { function(gl); };
    }
    void operator()(const GlTable& gl, const Sought& sought = {}) const { draw(gl, sought); }

  private:
    std::function<void(const GlTable& gl, const Sought& sought)> draw;
};

enum class NormalMethod {
    signed_lights, ///< one render, lights of positive and negative colour
    six_lights,    ///< the paper's: six renders, one white light each
};

struct EngineOptions {
    int n = 512; ///< samples per axis, min_resolution..max_resolution
    NormalMethod normals = NormalMethod::signed_lights;
    std::optional<Box> box;         ///< given, or found by drawing
    glm::dmat4 eye_to_capture{1.0}; ///< C: from the scene's eye space to the capture frame, a similarity
    /// Where the box search starts, capture frame; it grows while the scene touches its sides.
    Box search{glm::dvec3(-1.0), 2.0};
    bool mirrored_projection = false; ///< the program's own projection mirrors, so its winding is reversed
    /// False: 8-bit colour, ambient 1/2 and lights +-1/2 (also taken when the driver has no float targets).
    bool use_float_targets = true;

    int most_layers = 32; ///< parts of an axis and its minus side, layer 0 counted; 1: only the six views
    /// How the layers beyond are found. Slabs are taken too where this OpenGL has no fragment shaders.
    LayerMethod layer_method = LayerMethod::peel;
    bool use_shaders = true; ///< false: as if this OpenGL had none

    /// Hits are shown as either side sees them (ViewImage::other_colour); `culls`: without the faces that the
    /// program culls for a viewer on that side, where others are there too.
    bool both_sides = false, culls = false;

    /// Where draws are kept to places by the program's stencil test: what the draw function tells of each
    /// draw.
    ProgramStencil* stencil = nullptr;
};

struct EngineReport {
    bool ok = false;
    std::string error; ///< one line when not ok: "nothing solid was drawn", "no framebuffer objects", ...
    Box box;
    bool float_targets = false;
    int draws = 0;                  ///< how often the draw function was called
    long pixels_without_normal = 0; ///< covered pixels whose draw was unlit or whose normal pass missed
    Layers layers = Layers::outer;  ///< complete only if all axes are
    LayerMethod layer_method = LayerMethod::none;
    std::array<int, 3> layer_count{1, 1, 1}; ///< of each axis, layer 0 counted
    std::array<bool, 3> axis_complete{};     ///< no hit of the axis is missing
    int layer_draws = 0;                     ///< of `draws`, those for layers beyond layer 0
    double layer_seconds = 0;                ///< all that those layers took, reading and normals too
    double box_seconds = 0, colour_seconds = 0, normal_seconds = 0, read_seconds = 0;
};

/// Takes each finished image in the order -x.0 +x.0 -x.1 -x.2 ... -y.0 ...; false stops the capture.
using ImageSink = std::function<bool(ViewImage&&)>;

/// Capture in the current context. `gl` are its real entry points, compatibility profile, framebuffer objects
/// needed. The context's state is not restored: give it one of ours (a sibling of the program's, or OSMesa).
/// Never throws; errors are in the report. GL errors raised by the scene are swallowed in this context.
EngineReport run_capture(const GlTable& gl, const DrawFunction& draw, const EngineOptions& options,
                         const ImageSink& sink);

/// Find the smallest cube (2 samples of margin at n) around all that is drawn; nothing when nothing is.
std::optional<Box> find_box(const GlTable& gl, const DrawFunction& draw, const EngineOptions& options);

/// Whether the current context can draw into a framebuffer object of any format: without, no capture can be
/// made.
bool can_make_target(const GlTable& gl);

} // namespace glcast
