// What glcast-run was asked to do. Every option of the capture is also a GLCAST_ variable, which is how the
// shim gets it.
#pragma once
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace glcast::run {

struct Options {
    std::string output;      ///< absolute; empty with `list`; %p and %f are the shim's to fill in
    bool makes_mesh = false; ///< by its ending: `output` is a mesh, made of the capture
    std::vector<std::string> mesh_arguments; ///< for glcast mesh, as they were given
    bool keep_capture = false;               ///< beside the mesh
    int n = 512;
    long frame = 0;           ///< 0: the first with solid geometry
    double after_seconds = 0; ///< 0: at once
    std::string key, signal;  ///< what asks for a cast; empty: nothing has to
    bool nudge = false;
    long every = 0;     ///< cast every so many-th frame; 0: not asked for
    long captures = -1; ///< so many, 0: no limit; never negative after parse_options
    std::string normals = "signed";
    std::string layers = "auto";
    std::string box;          ///< x0,y0,z0,x1,y1,z1, or empty
    std::string frame_matrix; ///< eye, base, 16 numbers, or empty
    int group = 0;            ///< from 1; 0: the one with most triangles
    std::string window;       ///< number, title or X id; empty: the one that shows most
    bool direct3d = false;    ///< wined3d is to draw by fixed functions
    bool headless = false;
    bool quit = false; ///< end the program after the capture; `list` implies it
    bool list = false;
    std::string list_picture; ///< absolute; implies `list`
    std::string include, transparent, backdrop;
    double view_angle = 0;      ///< degrees; 0: not told
    std::string pretend;        ///< a version of OpenGL, or empty: the driver's
    double timeout_seconds = 0; ///< 0: no limit
    double most_seconds = 0;    ///< of one cast; 0: no limit
    bool verbose = false, json = false;
    std::vector<std::string> program; ///< name and arguments
};

enum class Parsed { run, done, usage_error };

/// Reads the command line, with GLCAST_ variables as defaults; prints help, version and usage errors itself.
/// Everything in `options` is in its range after `Parsed::run`; whether files and programs exist is not
/// looked at here.
Parsed parse_options(int argc, const char* const* argv, Options& options);

/// The GLCAST_ variables for the shim, which writes `capture`. An empty value means: unset it.
std::vector<std::pair<std::string, std::string>>
shim_variables(const Options& options, const std::string& capture, const std::filesystem::path& status_pipe);

} // namespace glcast::run
