#include "shim/preload/census.h"

#include <initializer_list>

namespace glcast::preload {

Census& Census::operator+=(const Census& other) {
    frames += other.frames;
    foreign_frames += other.foreign_frames;
    solid += other.solid;
    flat += other.flat;
    see_through += other.see_through;
    masked += other.masked;
    lines += other.lines;
    points += other.points;
    pixels += other.pixels;
    shaders += other.shaders;
    told_of_older |= other.told_of_older;
    if (!other.refused.empty()) refused = other.refused;
    if (!other.no_such_group.empty()) no_such_group = other.no_such_group;
    if (!other.other_windows.empty()) other_windows = other.other_windows;
    return *this;
}

unsigned Census::kinds() const {
    unsigned bits = 0, bit = 1;
    for (const bool is : {foreign_frames > 0, solid > 0, flat > 0, lines > 0, points > 0, pixels > 0,
                          shaders > 0, !refused.empty(), !other_windows.empty(), !no_such_group.empty()}) {
        bits |= is ? bit : 0;
        bit <<= 1;
    }
    return bits;
}

namespace {

std::string counted(long number, const char* what) { return std::to_string(number) + " " + what; }

/// "12 lines, 3 points and 4 flat triangles"
std::string enumerate(const Census& seen) {
    struct Kind {
        long number;
        const char* what;
    };
    std::string text;
    for (const auto& [number, what] :
         {Kind{seen.shaders, "draws by shaders"}, Kind{seen.lines, "lines"}, Kind{seen.points, "points"},
          Kind{seen.flat, "flat triangles (no depth test)"}, Kind{seen.pixels, "pixel rectangles"},
          Kind{seen.solid, "triangles that leave no mark in a view from outside"}})
        if (number > 0) text += (text.empty() ? "" : ", ") + counted(number, what);
    return text;
}

/// What --include would add; empty when nothing.
std::string strokes(const Census& seen) {
    return seen.lines > 0 && seen.points > 0 ? "lines,points"
           : seen.lines > 0                  ? "lines"
           : seen.points > 0                 ? "points"
                                             : "";
}

/// The kind that explains most comes first; empty when a frame was refused, which says enough.
std::string advice(const Census& seen) {
    if (seen.foreign_frames > 0 && seen.foreign_frames == seen.frames)
        return "it draws with OpenGL ES, which has no fixed functions: only fixed-function drawing of "
               "desktop OpenGL can "
               "be cast";
    const std::string more = strokes(seen),
                      kinds = seen.lines > 0 && seen.points > 0 ? "lines and points" : more;
    if (seen.shaders > 0)
        return "it draws with shaders of its own (GLSL or ARB programs)" +
               std::string(seen.told_of_older ? ", whatever it is told" : "") +
               ": only fixed-function drawing can be cast" +
               (seen.told_of_older ? "" : "; --pretend 1.5 lets it draw without them if it can") +
               (more.empty() ? "" : "; --include " + more + " casts its " + kinds);
    if (!seen.refused.empty()) return {};
    if (seen.masked > 0 && seen.masked == seen.solid)
        return "its faces are drawn with masked colours, into the depth buffer alone, and nobody sees them" +
               (more.empty() ? "" : "; --include " + more + " casts its " + kinds);
    if (!more.empty() && seen.see_through == 0) return "--include " + more + " casts these";
    if (seen.see_through > 0)
        return "all that is solid of it is blended so that what is behind shows: --transparent keep casts it";
    if (seen.solid > 0) return "--box can say where to look";
    if (seen.flat > 0) return "--list shows the groups, and --group K casts one";
    if (seen.pixels > 0) return "it paints pictures, no geometry";
    return "nothing was drawn; if it draws only when its window is touched, --nudge helps";
}

} // namespace

std::string explain(const Census& seen) {
    if (!seen.other_windows.empty()) return seen.other_windows;
    if (!seen.no_such_group.empty()) return seen.no_such_group;
    std::string text = enumerate(seen);
    if (!seen.refused.empty())
        text += (text.empty() ? "" : "; ") + std::string("a frame could not be recorded: ") + seen.refused;
    if (const std::string what = advice(seen); !what.empty()) text += (text.empty() ? "" : "; ") + what;
    return text;
}

} // namespace glcast::preload
