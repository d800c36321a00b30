// A mesh drawn by OpenGL (OSMesa), captured by the engine and reconstructed: what the shim and `glcast mesh`
// do, in one process.
#pragma once
#include <memory>

#include "capture/engine.h"
#include "tools/reconstruct/reconstruct.h"

namespace glcast::paper {

struct Capture {
    int n = 0;
    Box box;
    std::vector<ViewImage> images; ///< all layers
    bool complete_layers = false;
    double seconds = 0;
};

/// Draws triangles in immediate mode, with the mesh's normals (or those of the triangles) and colours (or
/// white), in a context of its own.
Capture capture_mesh(const Mesh& mesh, int n);

struct Cast {
    Mesh mesh;
    ReconstructReport report;
    double seconds = 0;
};
/// With all layers where the capture has them, or by the paper's rule of six views, which cubes always go by.
enum class Views { all_layers, six };
Cast reconstruct_capture(const Capture& capture, SurfaceMethod method, Views views = Views::all_layers,
                         bool geometric_normals = false);

} // namespace glcast::paper
