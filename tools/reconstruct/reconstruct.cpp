#include "tools/reconstruct/reconstruct.h"

#include <chrono>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "tools/reconstruct/attributes.h"
#include "tools/reconstruct/cells.h"
#include "tools/reconstruct/frame.h"
#include "tools/reconstruct/manifold.h"
#include "tools/reconstruct/quads.h"
#include "tools/reconstruct/rays.h"
#include "tools/reconstruct/vertices.h"

namespace glcast {
namespace {

class Stopwatch {
  public:
    double lap() {
        const auto now = std::chrono::steady_clock::now();
        return std::chrono::duration<double>(now - std::exchange(last, now)).count();
    }

  private:
    std::chrono::steady_clock::time_point last = std::chrono::steady_clock::now();
};

void to_capture_frame(Mesh& mesh, const CaptureFrame& frame) {
    for (glm::dvec3& p : mesh.positions) p = frame(p);
}

} // namespace

Mesh reconstruct(std::span<const ViewImage> images, const Box& box, const ReconstructOptions& options,
                 ReconstructReport* report) {
    if (!(options.close_gaps >= 0) || !std::isfinite(options.close_gaps))
        throw std::runtime_error("the gap radius must be 0 samples or more");
    ReconstructReport made;
    Stopwatch watch;
    const Rays rays = make_rays(images, options.close_gaps);
    const CellGrid grid = find_cells(rays);
    made.carve_seconds = watch.lap();

    const bool cubes = options.method == SurfaceMethod::cubes;
    Mesh mesh;
    mesh.positions = cubes ? cube_vertices(grid) : contour_vertices(rays, grid);
    QuadReport quads;
    const CaptureFrame frame(box, rays.n);
    mesh.triangles = make_triangles(rays, grid, mesh.positions, frame.rounding(), quads);
    if (!cubes) made.mended = mend_intersections(rays, grid, quads, mesh.triangles, frame, mesh.positions);
    assert_manifold(mesh.triangles, mesh.positions.size());
    made.surface_seconds = watch.lap();

    made.vertices_without_pixel = cubes ? sample_squares(rays, mesh, options.geometric_normals)
                                        : sample_vertices(rays, mesh, options.geometric_normals);
    to_capture_frame(mesh, frame);
    made.attribute_seconds = watch.lap();

    made.filled_samples = grid.filled_samples;
    made.thin_samples = grid.sheet_samples;
    made.crossings = quads.crossings;
    made.unsupported_crossings = quads.unsupported;
    if (report) *report = made;
    return mesh;
}

} // namespace glcast
