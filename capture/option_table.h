// The one table of what a cast can be told. Options of glcast-run, variables of the library, --help, the
// manual, the completion of the shell and the tables of docs/reference/options.md are made of it.
#pragma once
#include <span>
#include <string_view>

namespace glcast {

struct CastOption {
    const char* names;    ///< of glcast-run, "-o,--output"; empty: a variable alone
    const char* variable; ///< of the library; empty: glcast-run's own
    const char* value;    ///< what stands for the value on the page; empty: a switch
    const char* meaning;  ///< one line without a full stop
    const char* expected; ///< what the variable may hold, for the message where it holds something else
    const char* see = ""; ///< page that says more, beside docs/reference/options.md
};

inline constexpr CastOption cast_options[] = {
    {"-o,--output", "GLCAST_OUT", "FILE",
     "Capture (.exr), or mesh to make of it (.glb, .obj, .ply, .off, .stl or .3mf); default: PROGRAM.exr "
     "here",
     "a file name"},
    {"-n,--resolution", "GLCAST_N", "512", "Samples along each axis", "a whole number from 8 to 8192"},
    {"--frame", "GLCAST_FRAME", "N", "Cast frame N, counted from 1 (default: the first with solid geometry)",
     "a whole number from 1"},
    {"--after", "GLCAST_AFTER", "SECONDS",
     "Cast what stands in the window after so many seconds, or the next frame", "seconds, 0 or more"},
    {"--key", "GLCAST_KEY", "F12", "Cast a frame each time this key (F12, Print, x, ...) is pressed",
     "a key, like F12, Print or x"},
    {"--signal", "GLCAST_SIGNAL", "USR1", "Cast a frame each time this signal (USR1, ...) comes to PROGRAM",
     "a signal that does not end programs, like USR1 or RTMIN+1"},
    {"--nudge", "GLCAST_NUDGE", "", "Expose, resize and remap the window while no frame comes", "0 or 1"},
    {"--every", "GLCAST_EVERY", "N", "Cast every Nth frame from then on (%f in -o is the frame's number)",
     "a whole number from 1"},
    {"--captures", "GLCAST_CAPTURES", "N",
     "Cast so many frames (default: 1; with --every, --key and --signal no limit, but 1 with --quit)",
     "a whole number from 0"},
    {"--normals", "GLCAST_NORMALS", "signed|six",
     "signed: one render; six: the paper's six renders; of a mesh also drawn or geometric", "signed or six"},
    {"--layers", "GLCAST_LAYERS", "auto|K|slab",
     "auto: all hits of each ray; K: at most K, 1 for the six views alone; slab: by clip planes",
     "auto, slab, or a whole number from 1 to 256"},
    {"--box", "GLCAST_BOX", "x0,y0,z0,x1,y1,z1",
     "x0,y0,z0,x1,y1,z1 in the capture frame (default: found by drawing)",
     "x0,y0,z0,x1,y1,z1 with x0 < x1, y0 < y1, z0 < z1, none beyond 1e30, and a millionth of that apart"},
    {"--frame-matrix", "GLCAST_FRAME_MATRIX", "eye|base|...",
     "eye, base or 16 numbers, column by column: eye space to capture frame",
     "eye, base, or the 16 numbers of a similarity, column by column"},
    {"--group", "GLCAST_GROUP", "K", "Cast group K of --list (default: the one with most triangles)",
     "a whole number from 1", "../guide/choosing.md"},
    {"--window", "GLCAST_WINDOW", "K|TITLE|0xID",
     "Cast this window alone: its number or title in --list, or its X id, 0x...; default: the one that shows "
     "most",
     "a window's number, its id with 0x, or a part of its title", "../guide/choosing.md"},
    {"--list", "GLCAST_LIST", "[FILE.png]",
     "Print the groups of the frame instead of casting it, then end the program; --list FILE.png also shows "
     "them",
     "0, 1 or the name of a .png"},
    {"--include", "GLCAST_INCLUDE", "lines,points", "Also cast lines, points or lines,points, a sample thick",
     "lines, points or lines,points"},
    {"--transparent", "GLCAST_TRANSPARENT", "keep|skip",
     "What is blended: keep or skip all of it (default: keep it where half or less of what is behind shows)",
     "keep or skip", "../guide/limits.md"},
    {"--backdrop", "GLCAST_BACKDROP", "keep",
     "keep: cast skies, pictures behind the scene and outlines too (default: left out, with a line that says "
     "so)",
     "keep", "../guide/limits.md"},
    {"--fov", "GLCAST_FOV", "DEGREES",
     "Field of view from bottom to top, in degrees, of a program that hands over clip coordinates "
     "(default: 45, with a warning)",
     "degrees, more than 0 and less than 180"},
    {"--pretend", "GLCAST_PRETEND", "1.5",
     "Tell PROGRAM of this version of OpenGL (1.0 to 2.1) and of no shaders: some draw without them then",
     "a version of OpenGL, 1.0 to 1.5, 2.0 or 2.1", "../guide/limits.md"},
    {"--direct3d", "", "",
     "Of Wine: let Direct3D 8 and 9 draw by fixed functions (by itself with --quit or --headless, where "
     "nothing else is drawn)",
     "", "../guide/limits.md"},
    {"--headless", "", "", "Run under an X server of its own, with software GL", ""},
    {"--quit", "GLCAST_QUIT", "", "End the program after the capture", "0 or 1"},
    {"--timeout", "", "SECONDS",
     "Give up and end the program after so many seconds (default: 120 with --quit or --headless, else never)",
     ""},
    {"--max-seconds", "GLCAST_MAX_SECONDS", "SECONDS",
     "Give up a cast that takes longer, and let the program run on (default: never)", "seconds, more than 0"},
    {"--keep-capture", "", "", "Of a mesh: keep the capture too, beside it, as .exr", ""},
    {"--verbose", "GLCAST_VERBOSE", "", "Say also how, with figures", "0 or 1"},
    {"--json", "", "",
     "Print one JSON object on standard output; what PROGRAM prints there goes to standard error", ""},

    {"", "GLCAST_MEMORY", "4096", "Most that a recorded frame may take, in MiB",
     "MiB, a whole number from 1"},
    {"", "GLCAST_LIBRARY", "FILE", "The library that glcast-run preloads, in place of its own",
     "a file name"},
    {"", "GLCAST_SHADERS", "0", "Peel by slabs, as if the driver had no shaders", "0 or 1"},
    {"", "GLCAST_MASK", "float,fbo,glsl,queries", "As if the driver lacked these",
     "float, fbo, glsl or queries, with commas between"},
    {"", "GLCAST_REPLAY", "calls", "Each recorded call is made again in each replay", "arrays or calls"},
    {"", "GLCAST_READ_ENDS", "1", "glReadPixels, glFlush and glFinish end a frame too", "0 or 1"},
    {"", "GLCAST_REFERENCE_VIEWS", "36", "Further views of the same frame, to measure with",
     "a whole number from 1 to 36, and no GLCAST_BOX with it", "capture-format.md"},
    {"", "GLCAST_REFERENCE_N", "1024", "Samples along each axis of those views",
     "a whole number from 8 to 8192", "capture-format.md"},
};

/// By variable, or by the long name of the option. Not a constant expression where there is none: the build
/// fails.
consteval const CastOption& cast_option(std::string_view name) {
    for (const CastOption& option : cast_options) {
        const std::string_view names = option.names;
        if (name == option.variable || name == names || names.ends_with(name)) return option;
    }
    throw "no such option in cast_options";
}

} // namespace glcast
