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
    std::vector<ViewImage> images;
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
Cast reconstruct_capture(const Capture& capture, SurfaceMethod method, bool geometric_normals = false);

} // namespace glcast::paper
