// A GlTable that forces what a pass needs on whatever is drawn through it (design, section 3).
#pragma once
#include "capture/forced_state.h"
#include "capture/gl/override_table.h"

namespace glcast {

/// Entry points are plain functions, so the table that is alive on a thread is that thread's current one: one
/// at a time. Make it for one draw, after the pass has set its state, in a context that is then at GL's
/// defaults for what is tracked.
class ForcedTable {
  public:
    /// `mirrored`: images of this view are mirror images of what a viewer on its side would see, so winding
    /// is reversed.
    ForcedTable(const GlTable& real, const PassFacts& pass, bool mirrored);
    ~ForcedTable();
    ForcedTable(const ForcedTable&) = delete;
    ForcedTable& operator=(const ForcedTable&) = delete;

    const GlTable& table() const { return forced; }
    const GlTable& below() const { return real; }

    static ForcedTable& current();

    const GlTable& real;
    const PassKind kind;
    const bool mirrored;
    ForcedState state;

  private:
    GlTable forced;
};

extern const OverrideRules forced_rules;

/// GL_CW for GL_CCW and the other way round; anything else unchanged.
GLenum mirrored_winding(GLenum mode);

} // namespace glcast
