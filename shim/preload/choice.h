// Which group of draws is the scene.
#pragma once
#include <functional>
#include <span>
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

    // What `judge` found.
    bool castable = false; ///< drawn in space, with something that may be solid
    bool backdrop = false; ///< fills its viewport at one depth, not in perspective: a gradient, a picture, a
                           ///< toolkit's own frame
    bool inset = false;    ///< small on the screen beside another: axes in a corner, a navigation cube
    bool helper = false;   ///< in another framebuffer than the one that is shown
    bool rich = false;     ///< has at least half as many triangles as the richest of those in front
};

/// One reason to take a group and not another. The first rule of the table by which two groups differ
/// decides, for the group with the higher score.
struct ChoiceRule {
    const char* name;
    long (*score)(const Candidate&, const Include&);
};
std::span<const ChoiceRule> choice_rules();

/// The rule that takes `a` before `b`, or `b` before `a`; null where none tells them apart.
const ChoiceRule* deciding_rule(const Candidate& a, const Candidate& b, const Include& include);

/// Groups of all parts; what two parts draw to the same place is one group where `may_join(part, part)`.
std::vector<Candidate> merge(const std::vector<Scene>& scenes, const std::function<bool(int, int)>& may_join);

/// Of the richest that are castable, or of all with `pictures_of_all`.
void draw_pictures(std::vector<Candidate>& candidates, const Include& include, bool pictures_of_all,
                   const std::function<Thumbnail(const Candidate&)>& draw_picture);

/// What their counts, their pictures and the others tell of each.
void judge(std::vector<Candidate>& candidates, const Include& include);

/// Puts what people mean first, by the rules. Pictures are drawn already.
void rank(std::vector<Candidate>& candidates, const Include& include);

/// Triangles and what else of it may become solid.
long substance(const Group& group, const Include& include);

/// May it be cast when nobody asks for it by number?
bool is_scene(const Candidate& candidate);

} // namespace glcast::preload
