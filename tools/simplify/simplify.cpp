#include "tools/simplify/simplify.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "tools/mesh/check.h"
#include "tools/simplify/attributes.h"
#include "tools/simplify/collapser.h"
#include "tools/simplify/refit.h"

namespace glcast {
namespace {

/// The most triangles that fulfil the target, and edges. A closed mesh has three edges to two triangles.
Collapser::Limit limit_of(const SimplifyTarget& target, const MeshCheck& have) {
    using Unit = SimplifyTarget::Unit;
    if (!(target.value >= 0) || (target.unit == Unit::ratio && target.value > 1))
        throw std::runtime_error("cannot simplify: the target must be 0 or more, and a ratio 1 or less");
    const auto whole = [](double value, std::size_t most) {
        return value >= double(most) ? most : std::size_t(value);
    };
    if (target.unit == Unit::edges) return {have.triangles, whole(target.value, have.edges)};
    const bool ratio = target.unit == Unit::ratio;
    return {whole(ratio ? target.value * double(have.triangles) : target.value, have.triangles), have.edges};
}

bool keeps(const MeshCheck& check, const Collapser::Limit& limit) {
    return check.triangles <= limit.triangles && check.edges <= limit.edges;
}

/// Empty when the mesh is such a surface.
std::string fault(const MeshCheck& check, const SimplifyOptions& options) {
    const bool good = !options.allow_boundaries
                          ? check.closed_manifold()
                          : check.triangles > 0 && check.non_manifold_edges == 0 &&
                                check.non_manifold_vertices == 0 && check.degenerate_triangles == 0;
    if (good) return "";
    return std::string(options.allow_boundaries ? "not a two-manifold" : "not a closed two-manifold") + " (" +
           describe(check) + ")";
}

/// Calls for whoever waits for it, once; the mesh's normals are theirs from then on.
class LastStretch {
  public:
    LastStretch(const Mesh& mesh, const std::function<void()>& waiting) : mesh(mesh), waiting(waiting) {}
    void begin() {
        if (begun || !waiting) return;
        own = mesh.normals;
        begun = true;
        waiting();
    }
    const std::vector<glm::vec3>& normals() const { return begun ? own : mesh.normals; }

  private:
    const Mesh& mesh;
    const std::function<void()>& waiting;
    std::vector<glm::vec3> own;
    bool begun = false;
};

Mesh finished(Collapser::Remainder&& remainder, const SurfaceWalk& walk,
              const std::vector<glm::vec3>& normals, const SimplifyOptions& options) {
    Mesh mesh;
    mesh.positions = std::move(remainder.positions);
    mesh.triangles = std::move(remainder.triangles);
    walk.take_attributes(mesh, remainder.sources, normals);
    if (const std::string wrong = fault(check_mesh(mesh), options); !wrong.empty())
        throw std::logic_error("simplify made a mesh that is " + wrong + ": a bug in glcast");
    return mesh;
}

CollapseLog finished(Collapser::Log&& from, const SurfaceWalk& walk, const std::vector<glm::vec3>& normals) {
    Mesh points;
    for (const Collapse& collapse : from.collapses) points.positions.push_back(collapse.position);
    walk.take_attributes(points, from.sources, normals);
    for (std::size_t k = 0; k < from.collapses.size(); ++k) {
        if (!points.colours.empty()) from.collapses[k].colour = points.colours[k];
        if (!points.normals.empty()) from.collapses[k].normal = points.normals[k];
    }
    return std::move(from.collapses);
}

AttributeWeights weights_of(const SimplifyOptions& options) {
    constexpr double fitted = 0.00003, as_collapsed = 0.0006;
    return {options.colour_weight, options.normal_weight.value_or(options.refit ? fitted : as_collapsed)};
}

} // namespace

std::vector<Mesh> simplify_levels(const Mesh& mesh, std::span<const SimplifyTarget> targets,
                                  const SimplifyOptions& options, CollapseLog* log) {
    const MeshCheck have = options.checked ? *options.checked : check_mesh(mesh);
    std::vector<Collapser::Limit> limits(targets.size());
    std::transform(targets.begin(), targets.end(), limits.begin(),
                   [&](const SimplifyTarget& t) { return limit_of(t, have); });
    if (const std::string wrong = fault(have, options); !wrong.empty())
        throw std::runtime_error("cannot simplify: " + wrong);
    // From fine to coarse; for a surface with boundaries edges and triangles are nearly in the same order.
    std::vector<std::size_t> order(targets.size());
    std::iota(order.begin(), order.end(), 0);
    const auto size = [&](std::size_t k) { return std::min(limits[k].triangles * 3, limits[k].edges * 2); };
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return size(a) > size(b); });

    std::vector<Mesh> levels(targets.size(), Mesh{});
    if (log) log->clear();
    std::erase_if(order, [&](std::size_t level) {
        const bool kept = keeps(have, limits[level]);
        if (kept) levels[level] = mesh;
        return kept;
    });
    LastStretch last_stretch(mesh, options.last_stretch);
    if (!order.empty()) {
        const auto collapser =
            Collapser::make(mesh, {have.triangles, have.edges}, weights_of(options), log != nullptr);
        std::optional<SurfaceWalk> walk;
        std::optional<SurfaceArea> area;
        for (const std::size_t level : order) {
            if (collapser->run_rounds(limits[level])) last_stretch.begin();
            collapser->reduce_to(limits[level]);
            Collapser::Remainder remainder = collapser->remainder();
            if (options.refit && !area) area.emplace(mesh);
            if (!walk) walk.emplace(mesh);
            if (options.refit) refit(remainder, *area, *walk);
            levels[level] = finished(std::move(remainder), *walk, last_stretch.normals(), options);
        }
        if (log) *log = finished(collapser->take_log(), *walk, last_stretch.normals());
    }
    last_stretch.begin();
    return levels;
}

struct Simplification::Impl {
    Impl(const Mesh& mesh, const SimplifyOptions& options)
        : mesh(mesh), options(options), have(options.checked ? *options.checked : check_mesh(mesh)) {
        if (const std::string wrong = fault(have, options); !wrong.empty())
            throw std::runtime_error("cannot simplify: " + wrong);
        collapser = Collapser::make(mesh, {have.triangles, have.edges}, weights_of(options), false);
        least = have.triangles;
    }

    const Mesh& mesh;
    const SimplifyOptions options;
    const MeshCheck have;
    std::unique_ptr<Collapser> collapser;
    std::size_t least; ///< triangles
    std::optional<SurfaceWalk> walk;
    std::optional<SurfaceArea> area;
};

Simplification::Simplification(const Mesh& mesh, const SimplifyOptions& options)
    : impl(std::make_unique<Impl>(mesh, options)) {}
Simplification::~Simplification() = default;

void Simplification::collapse_to(std::size_t triangles) {
    impl->collapser->reduce_to({triangles, SIZE_MAX});
    impl->least = impl->have.triangles - 2 * impl->collapser->collapses(); // closed: two a collapse
    if (!impl->walk) impl->walk.emplace(impl->mesh);
    if (!impl->area && impl->options.refit) impl->area.emplace(impl->mesh);
}

std::size_t Simplification::least() const { return impl->least; }

Mesh Simplification::level(std::size_t triangles, FitWork fit) const {
    if (triangles >= impl->have.triangles) return impl->mesh;
    SimplifyOptions own = impl->options;
    own.checked = &impl->have;
    std::optional<Collapser::Remainder> remainder = impl->collapser->remainder_at({triangles, SIZE_MAX});
    if (!remainder) {
        own.refit = own.refit && fit != FitWork::none;
        own.normal_weight = weights_of(impl->options).normal;
        return simplify(impl->mesh, {SimplifyTarget::Unit::triangles, double(triangles)}, own);
    }
    if (own.refit) refit(*remainder, *impl->area, *impl->walk, fit);
    return finished(std::move(*remainder), *impl->walk, impl->mesh.normals, own);
}

Mesh simplify(const Mesh& mesh, const SimplifyTarget& target, const SimplifyOptions& options) {
    return std::move(simplify_levels(mesh, {&target, 1}, options).front());
}

} // namespace glcast
