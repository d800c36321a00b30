// Options of `glcast mesh` that glcast-run takes too, when -o names a mesh, and passes on as they are.
//
// Left out are those that glcast-run has itself (-o, --json, --verbose). --normals is of both: signed and six
// are of the capture, drawn and geometric of the mesh. What values they may have `glcast mesh` says, asked
// before the program starts.
#pragma once

namespace glcast::run {

struct MeshOption {
    const char* name;
    bool takes_value;
};

inline constexpr MeshOption mesh_options[] = {
    {"--method", true},  {"--exterior", true},  {"--sheet-thickness", true}, {"--close-gaps", true},
    {"--edges", true},   {"--triangles", true}, {"--ratio", true},           {"--max-error", true},
    {"--texture", true}, {"--compress", true},  {"--pm", true},
    {"--check", false},  {"--units", true},     {"--pixels", true},          {"--full", false},
    {"--levels", true},
};

} // namespace glcast::run
