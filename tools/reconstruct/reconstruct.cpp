#include "tools/reconstruct/reconstruct.h"

#include <chrono>
#include <cmath>
#include <glm/vector_relational.hpp>
#include <memory>
#include <stdexcept>
#include <utility>

#include "tools/reconstruct/attributes.h"
#include "tools/reconstruct/captured_surface.h"
#include "tools/reconstruct/carve.h"
#include "tools/reconstruct/cells.h"
#include "tools/reconstruct/crossings.h"
#include "tools/reconstruct/exterior.h"
#include "tools/reconstruct/frame.h"
#include "tools/reconstruct/manifold.h"
#include "tools/reconstruct/planes.h"
#include "tools/reconstruct/quads.h"
#include "tools/reconstruct/rays.h"
#include "tools/reconstruct/sides.h"
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

/// The samples nearest to places in the box.
std::vector<SampleId> samples_of(const std::vector<glm::dvec3>& places, const CaptureFrame& frame,
                                 const Rays& rays) {
    std::vector<SampleId> samples;
    for (const glm::dvec3& place : places) {
        const glm::dvec3 at = glm::round(frame.samples(place));
        const bool is_near = glm::all(glm::lessThan(glm::abs(at), glm::dvec3(2.0 * rays.n)));
        if (!is_near) continue;
        const std::array<int, 3> sample{int(at.x), int(at.y), int(at.z)};
        if (rays.inside(sample)) samples.push_back(id_of(sample, rays.n));
    }
    return samples;
}

/// Fills the rays' volume by the rule that can be followed.
void carve(Rays& rays, const CaptureFrame& frame, const ReconstructOptions& options,
           ReconstructReport& made) {
    if (options.exterior == ExteriorRule::layers && options.complete_layers) {
        Exterior found = find_exterior(rays, options.close_gaps, samples_of(options.eyes, frame, rays));
        made.exterior = ExteriorRule::layers;
        made.thin_samples = found.thin_samples;
        made.hidden_samples = found.hidden_samples;
        rays.volume = std::move(found.volume);
        rays.complete = true;
    } else {
        Carved carved = carve_along_axes(rays, options.close_gaps);
        made.exterior = ExteriorRule::axes;
        made.thin_samples = carved.thin_samples;
        rays.volume = std::move(carved.volume);
    }
    made.filled_samples = rays.volume.samples();
}

} // namespace

Mesh reconstruct(HitBuilder&& hits, const Box& box, const ReconstructOptions& options,
                 ReconstructReport* report, CapturedSurface* captured) {
    if (!(options.close_gaps >= 0) || !std::isfinite(options.close_gaps))
        throw std::runtime_error("the gap radius must be 0 samples or more");
    if (!(options.sheet_thickness >= 0.01 && options.sheet_thickness <= 1))
        throw std::runtime_error("the thickness of sheets must be 0.01 to 1 sample");
    ReconstructReport made;
    Stopwatch watch;
    Rays rays;
    rays.n = hits.resolution();
    rays.axis = hits.finish();
    rays.half_thickness = float(options.sheet_thickness / 2);
    const CaptureFrame frame(box, rays.n);
    carve(rays, frame, options, made);
    CellGrid grid = find_cells(rays);
    made.carve_seconds = watch.lap();

    const bool cubes = options.method == SurfaceMethod::cubes;
    for (int a = 0; a < 3; ++a) find_planes(rays.axis[a], Axis(a), rays.n);
    Mesh mesh;
    auto crossings = std::make_unique<const EdgeCrossings>(rays, grid);
    mesh.positions = cubes ? cube_vertices(grid) : contour_vertices(*crossings, grid);
    QuadReport quads;
    mesh.triangles = make_triangles(*crossings, grid, mesh.positions, frame.rounding(), quads);
    crossings.reset();
    if (!cubes) made.mended = mend_intersections(rays, grid, quads, mesh.triangles, frame, mesh.positions);
    if (captured) mark_sides(rays);
    grid = {}; // what is done with goes, for large lattices fill the memory
    assert_manifold(mesh.triangles, mesh.positions.size());
    made.surface_seconds = watch.lap();

    const Sampled sampled = cubes ? sample_squares(rays, mesh, options.geometric_normals)
                                  : sample_vertices(rays, mesh, options.geometric_normals);
    made.vertices_without_pixel = sampled.missing;
    made.disagreeing_normals_share = sampled.disagreeing_normals_share;
    if (!captured) rays.volume = {};
    to_capture_frame(mesh, frame);
    made.attribute_seconds = watch.lap();

    made.crossings = quads.crossings;
    made.unsupported_crossings = quads.unsupported;
    made.unsupported_area_share = quads.unsupported_area_share;
    if (captured) *captured = CapturedSurface(std::move(rays), box, options.geometric_normals);
    if (report) *report = made;
    return mesh;
}

Mesh reconstruct(std::span<const ViewImage> images, const Box& box, const ReconstructOptions& options,
                 ReconstructReport* report, CapturedSurface* captured) {
    HitBuilder hits;
    for (const ViewImage& image : images) hits.add(image);
    return reconstruct(std::move(hits), box, options, report, captured);
}

} // namespace glcast
