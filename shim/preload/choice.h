// Which group of draws is the scene.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "shim/preload/options.h"
#include "shim/preload/scene.h"
#include "shim/preload/scene_thumbnail.h"

namespace glcast::preload {

/// A group, with what each part of the frame draws of it.
struct Candidate {
    Group group;              ///< counts of all parts together
    std::vector<int> in_part; ///< index into the groups of each part; -1: it has none of it
    Thumbnail picture;        ///< drawn where the choice needs it

    int number = 0;     ///< in the list, where it is listed
    std::string window; ///< likewise: what the window is called, empty where there is but one

    // What `rank` found.
    bool castable = false; ///< drawn in space, with something that may be solid
    bool backdrop = false; ///< fills its viewport at one depth, not in perspective: a gradient, a picture, a
                           ///< toolkit's own frame
    bool inset = false;    ///< small on the screen beside another: axes in a corner, a navigation cube
};

/// Groups of all parts; what two parts draw to the same place is one group where `may_join(part, part)`.
std::vector<Candidate> merge(const std::vector<Scene>& scenes, const std::function<bool(int, int)>& may_join);

/// Puts what people mean first: castable, not painted over, no backdrop, no inset; then of those with at
/// least half as many triangles as the richest, what is drawn to the window itself, then what is seen in
/// perspective (of the four views of a CAD program that one); then most triangles. `draw_picture` is called
/// for what is castable, or for all with `pictures_of_all`.
void rank(std::vector<Candidate>& candidates, const Include& include, bool pictures_of_all,
          const std::function<Thumbnail(const Candidate&)>& draw_picture);

/// Triangles and what else of it may become solid.
long substance(const Group& group, const Include& include);

/// May it be cast when nobody asks for it by number?
bool is_scene(const Candidate& candidate);

} // namespace glcast::preload
