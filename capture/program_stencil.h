// What the program's stencil buffer holds in each of our views, and what its stencil test lets through there:
// caps of cut solids, concave faces filled by parity, decals.
//
// Before the first pass of a view the draws that write the stencil buffer are played under that view, with
// the program's own stencil state and face culling. At each draw that a stencil test keeps to places the
// buffer is read, and the test worked out for each pixel: a mask. Every pass of the view then draws that draw
// through its mask, which lies in a bit of the stencil buffer that the engine does not need (stencil_rule.h).
//
// The marks are played without a depth test, so what lies on a ray marks it, be it hidden or not. So one mask
// holds for all layers, and shows in none of them what another layer hides. Where the direction of the view
// matters, as it does for a count of fronts and backs that stops at 0, an inner layer shows what either side
// lets through.
#pragma once
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "capture/pixel_rect.h"
#include "capture/view.h"

namespace glcast {

class Target;
struct GlTable;

/// What a draw has to do with the stencil buffer.
struct StencilUse {
    std::optional<int> cleared_to; ///< since the draw before that had to do with it
    bool marks = false;            ///< it may write to it
    bool is_kept = false;          ///< it is cast only where its stencil test passes

    bool any() const { return cleared_to || marks || is_kept; }
};

/// Shared by whoever plays the scene, which tells of each draw, and the engine.
class ProgramStencil {
  public:
    /// Before a draw, outside of glBegin; the state of the draw is set. `is_solid`: it is to be drawn at all.
    /// False: it is not to be played now.
    bool begin_draw(const StencilUse& use, bool is_solid);
    /// After it, if it was played.
    void end_draw();

    struct View {
        Box box;
        Axis axis = Axis::x;
        int size = 0;
    };
    /// Another scene, or another frame of it, is looked at.
    void forget() { look({}); }
    /// From here on this is the view; what was known of another is forgotten.
    void look(const View& view);
    bool knows(Side viewer) const { return known[static_cast<std::size_t>(viewer)]; }
    /// The draws are played to find the masks of a viewer on this side; to the target that is bound.
    void begin_finding(const Target& target, Side viewer);
    /// The draws are played for a pass. `viewer`: whose masks hold; none: either's. `only`: the scissor that
    /// is set.
    void begin_pass(const std::optional<Side>& viewer, const std::optional<PixelRect>& only);
    void end();

  private:
    /// 0 or stencil_mask_bit for each pixel of the rectangle, row by row.
    struct Mask {
        PixelRect rect;
        std::vector<std::uint8_t> bits;
        bool is_all = false;
    };
    using Masks = std::vector<std::shared_ptr<const Mask>>; ///< of each kept draw, in the order of the frame
    struct Test {
        int function = 0, reference = 0, bits = 0;
        bool operator==(const Test&) const = default;
    };

    void find(const StencilUse& use);
    std::shared_ptr<const Mask> read_mask(const Test& test) const;
    const Masks& masks_of_pass();
    static std::shared_ptr<const Mask> either(const Mask& a, const Mask& b);
    void write(const Mask& mask) const;
    void wipe(const Mask& mask) const;

    enum class Work { none, finding, passing } work = Work::none;
    std::optional<View> view;
    std::array<Masks, 2> of_side;
    std::array<bool, 2> known{};
    Masks of_both;
    std::optional<Side> viewer;
    std::optional<PixelRect> scissor;
    const Target* target = nullptr;
    std::size_t next = 0;          ///< kept draw of the playing
    const Mask* open = nullptr;    ///< of the draw that is being played
    std::optional<Test> last_test; ///< of the kept draw before, where the buffer is still the same
};

/// GL's stencil test of a value that the buffer holds.
bool passes_stencil(int function, int reference, unsigned bits, int value);

} // namespace glcast
