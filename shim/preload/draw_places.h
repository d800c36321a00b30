// Where the draws of a frame lie in the capture frame, so that a pass leaves out what it cannot find there. A
// frame is drawn hundreds of times, and most of these look for a few pixels.
#pragma once
#include <cmath>
#include <glm/mat4x4.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "capture/sought.h"
#include "shim/record/record.h"

namespace glcast::preload {

struct DrawPlace {
    struct Part : record::DrawParts::Part {
        Place place;
    };
    std::vector<Part> parts; ///< as in record::DrawParts
    bool is_whole;
    GLenum mode;
    glm::dmat4 to_capture{1.0},
        magnitude{1.0}; ///< from the draw's coordinates; and what its sums are made of
};

/// A draw in pieces that may have fragments in an image; the rest of it covers no pixel's centre.
struct DrawCover {
    struct Piece {
        record::DrawParts::Part part;
        OpenTiles::Cover cover;
    };
    std::vector<Piece> pieces;
};

/// Of the draw that is played. Nothing where it is not known. `to_eye`: from the draw's coordinates to eye
/// space.
std::optional<DrawPlace> find_place(const record::DrawParts& draw, const glm::dmat4& to_eye,
                                    const glm::dmat4& eye_to_capture);

/// Of the draw that is played.
DrawCover find_cover(const DrawPlace& place, const OpenTiles& tiles);

/// Primitives of a part of the draw that is played, or its vertices, as parts with places of their own.
std::vector<DrawPlace::Part> primitives_of(const DrawPlace& place, const record::DrawParts::Part& part);
std::vector<DrawPlace::Part> vertices_of(const DrawPlace& place, const record::DrawParts::Part& part);

inline constexpr Place nowhere{glm::dvec3(INFINITY), glm::dvec3(-INFINITY), glm::dvec3(0),
                               glm::dvec3(INFINITY)};

/// Of all draws of a frame, by number; found when they are first asked for, for they are the same in each
/// replay.
class DrawPlaces {
  public:
    /// Forgets all where the capture frame is another one.
    void begin(const glm::dmat4& eye_to_capture);

    /// Null where it is not known. `find()` gives a std::optional<DrawPlace>.
    template <class Find> const DrawPlace* of(std::size_t draw, const Find& find) {
        if (draw >= known.size()) known.resize(draw + 1);
        if (!known[draw]) note(known[draw] = std::make_unique<std::optional<DrawPlace>>(find()));
        return *known[draw] ? &**known[draw] : nullptr;
    }

    /// Of a draw whose place is known. Those of the tiles' grid are kept until it is another one.
    const DrawCover& cover_of(std::size_t draw, const DrawPlace& place, const OpenTiles& tiles);

    /// The replay is over.
    void end() { is_complete = true; }
    /// A box around all whose places are known. Null before the end of the first replay.
    const Place* around() const { return is_complete ? &all : nullptr; }

  private:
    void note(const std::unique_ptr<std::optional<DrawPlace>>& place);

    glm::dmat4 frame{1.0};
    bool is_complete = false;
    Place all = nowhere;
    std::vector<std::unique_ptr<std::optional<DrawPlace>>> known;
    OpenTiles::Grid grid;
    std::vector<std::unique_ptr<const DrawCover>> covers;
};

/// The parts of a draw that are drawn, in order, neighbours joined.
class Selection {
  public:
    void add(const record::DrawParts::Part& part) {
        if (!parts.empty() && parts.back().first + parts.back().count >= part.first)
            parts.back().count = part.first + part.count - parts.back().first;
        else
            parts.push_back(part);
    }
    std::vector<record::DrawParts::Part> parts;
};

/// Is all of it inside the box, so that nothing of it is clipped?
bool lies_inside(const DrawPlace& place, const Box& box);

} // namespace glcast::preload
