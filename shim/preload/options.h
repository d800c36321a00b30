// What the environment asks for: each option of glcast-run is a variable.
#pragma once
#include <compare>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <optional>
#include <string>

#include "capture/engine.h"
#include "shim/preload/mask.h"

namespace glcast::preload {

/// Where the axes of the capture come from.
enum class FrameMatrix {
    automatic, ///< the base modelview's inverse where that is a similarity, else eye space
    base,      ///< the base modelview's inverse; refused where it is no similarity
    eye,       ///< eye space
    given,     ///< 16 numbers, column by column as in glLoadMatrix, from eye space to the capture frame
};

/// Of OpenGL, not of OpenGL ES.
struct GlVersion {
    int major = 0, minor = 0;
    auto operator<=>(const GlVersion&) const = default;
};

/// What is cast beside filled primitives.
struct Include {
    bool lines = false, points = false;
    bool any() const { return lines || points; }
};

/// When what the program blends is solid.
enum class Transparent {
    by_alpha, ///< where half or less of what is behind shows (capture/solidity.h)
    keep,     ///< always
    skip,     ///< never
};

struct Options {
    bool armed = false; ///< GLCAST_OUT or GLCAST_LIST is set, and nothing is wrong
    std::string out;    ///< GLCAST_OUT: file to write; %p is the process, %f the frame, %% a per cent sign
    int n = 512;        ///< GLCAST_N: samples per axis
    long frame = 1;     ///< GLCAST_FRAME: first frame that may be taken, from 1
    long every = 1;     ///< GLCAST_EVERY: of the frames of a window that may be taken, every so many-th
    long captures = -1; ///< GLCAST_CAPTURES: how many at most, 0: no limit; default 1; with
                        ///< GLCAST_EVERY, _KEY or _SIGNAL 0, but 1 with GLCAST_QUIT
    double after_seconds =
        0;           ///< GLCAST_AFTER: no frame that starts earlier than this after the first context
    std::string key; ///< GLCAST_KEY: "F12": a frame is cast when this key is pressed, none at the start
    std::uint32_t key_symbol = 0; ///< X keysym of it
    int signal = 0;               ///< GLCAST_SIGNAL: "USR1": likewise when this signal comes; 0: none
    bool nudge = false; ///< GLCAST_NUDGE: make a program draw that only does when it is exposed or resized
    NormalMethod normals = NormalMethod::signed_lights; ///< GLCAST_NORMALS: signed, six
    int most_layers = EngineOptions().most_layers;      ///< GLCAST_LAYERS: a number, auto, slab
    LayerMethod layer_method = LayerMethod::peel;       ///< GLCAST_LAYERS: slab
    bool use_shaders = true;                            ///< GLCAST_SHADERS: 0 as if the driver had none
    std::optional<Box>
        box; ///< GLCAST_BOX: x0,y0,z0,x1,y1,z1 in the capture frame; made a cube about its centre
    FrameMatrix frame_matrix = FrameMatrix::automatic; ///< GLCAST_FRAME_MATRIX: eye, base, or 16 numbers
    glm::dmat4 given_matrix{1.0};
    bool list = false;        ///< GLCAST_LIST: print the groups of the scene, capture nothing
    std::string list_picture; ///< GLCAST_LIST=FILE.png: also a picture of each
    Include include;          ///< GLCAST_INCLUDE: lines, points, or both with a comma between
    Transparent transparent = Transparent::by_alpha; ///< GLCAST_TRANSPARENT: keep, skip
    bool keep_backdrops = false; ///< GLCAST_BACKDROP: keep: skies, backgrounds are cast too (backdrop.h)
    std::optional<double>
        view_angle; ///< GLCAST_FOV: degrees from bottom to top, of what is drawn in clip coordinates
    int group =
        0; ///< GLCAST_GROUP: the group to take, as numbered by the list; 0: the one with most triangles
    int reference_views =
        0; ///< GLCAST_REFERENCE_VIEWS: so many further views beside the capture (capture/reference_views.h)
    int reference_n = 0; ///< GLCAST_REFERENCE_N: their resolution; 0: that of the capture
    std::string window; ///< GLCAST_WINDOW: the only one whose frames count: its number, 0x and its name, or a
                        ///< part of its title; empty: the one that shows most
    Mask mask; ///< GLCAST_MASK: float, fbo, glsl, queries with commas between: as if the driver lacked these
    std::size_t memory_mib = 4096; ///< GLCAST_MEMORY: most that a frame that is recorded may take, in MiB
    double most_seconds = 0;       ///< GLCAST_MAX_SECONDS: a cast that takes longer is given up; 0: no limit
    bool prepare_replay =
        true;               ///< GLCAST_REPLAY: calls: each is made again in each replay, as it was recorded
    bool read_ends = false; ///< GLCAST_READ_ENDS: glReadPixels, glFlush and glFinish end a frame too
    bool quit = false;      ///< GLCAST_QUIT: end the program with SIGTERM when the capture is on disk
    std::optional<GlVersion> pretend; ///< GLCAST_PRETEND: the most that the program is told of (pretence.h)
    std::string error;                ///< one line; not armed then
};

Options read_options();

} // namespace glcast::preload
