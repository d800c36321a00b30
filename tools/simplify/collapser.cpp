#include "tools/simplify/collapser.h"

#include <algorithm>
#include <limits>

#include "tools/simplify/round.h"

namespace glcast {
namespace {

constexpr std::size_t triangles_per_tile = 12'000;
// What has fewer triangles is one patch. No number here depends on a target, so a level is the same whatever
// else is asked for.
constexpr std::size_t one_patch = 250'000;
// Levels with fewer triangles are fitted (refit.cpp), which does better than keeping the volume. Quadrics are
// added up there: memoryless ones forget a small part, and where one is as large as a few triangles it goes
// (docs/design/method.md, "Levels").
constexpr std::size_t fitted_below = 33'000;
// With more triangles, each near the size of a sample, a surface hardly comes to pass through itself, and
// every collapse would have to be asked about.
constexpr std::size_t guarded_below = 100'000;
// With more, a round goes by place and colour alone, and the planes are those of what it leaves.
constexpr std::size_t thinned_above = 700'000;
// From round to round. The cost of a collapse grows with the third power of what one triangle stands for.
constexpr float price_grows = 4;
constexpr double least_progress = 0.9; // of the triangles left by a round; else the price must rise faster
constexpr float price_leaps = 1000;
constexpr int most_idle_rounds = 3;

template <int N> class RoundsCollapser final : public Collapser {
  public:
    RoundsCollapser(const Mesh& mesh, const Limit& have, const AttributeWeights& weights, bool keep_log)
        : mesh(mesh), cube(mesh), weights(weights), live(have),
          keep_log(keep_log), base{shape_of(mesh, cube, 2 * have.edges != 3 * have.triangles), {}} {
        became = base.id;
    }

    void reduce_to(const Limit& limit) override {
        if (run_rounds(limit))
            while (!meets(limit) && collapse_one()) {
            }
    }

    bool run_rounds(const Limit& limit) override {
        for (; !meets(limit) && (taken < steps.size() || !in_one_patch);)
            if (taken == steps.size())
                go_on();
            else
                take_steps(limit);
        return in_one_patch;
    }

    Remainder remainder() const override { return after(taken); }

    std::optional<Remainder> remainder_at(const Limit& limit) const override {
        if (!in_one_patch) return {};
        const auto met = [&](const Limit& left) { return left.triangles <= limit.triangles && left.edges <= limit.edges; };
        Limit left = patch_has;
        if (met(left) && made > taken) return {}; // it was kept earlier, perhaps by more
        std::size_t count = 0;
        while (count < taken && !met(left)) subtract(left, steps[count++]);
        if (!met(left)) return {};
        return after(count);
    }

    std::size_t collapses() const override { return made; }
    Log take_log() override { return std::move(log); }

  private:
    /// What the first `count` of the steps leave.
    Remainder after(std::size_t count) const {
        std::vector<std::uint32_t> of_base;
        Shape left = after_steps(base, std::span(steps).first(count), of_base);
        Remainder result;
        result.positions.reserve(left.position.size());
        for (std::size_t v = 0; v < left.position.size(); ++v)
            result.positions.push_back(left.moved[v] ? cube.outside(left.position[v])
                                                     : mesh.positions[left.id[v]]);
        result.sources = std::move(left.source);
        const std::size_t to_ghost = std::erase_if(left.triangles, [&](const Triangle& t) {
            return std::find(t.begin(), t.end(), left.ghost()) != t.end();
        });
        result.closed = to_ghost == 0;
        result.triangles = std::move(left.triangles);
        result.became.reserve(became.size());
        for (const std::uint32_t v : became) result.became.push_back(of_base[v]);
        return result;
    }

    bool meets(const Limit& limit) const {
        return live.triangles <= limit.triangles && live.edges <= limit.edges;
    }

    /// Until the limit is kept. They are put in order only where it matters: a level or a log lies among
    /// them.
    void take_steps(const Limit& limit) {
        if (!in_order && !keep_log) {
            const Limit before = live;
            for (const Step& step : steps) count(step);
            if (!meets(limit)) {
                taken = steps.size();
                return;
            }
            made -= steps.size();
            live = before;
        }
        if (!in_order) steps = by_cost(steps);
        in_order = true;
        while (!meets(limit) && taken < steps.size()) take(steps[taken++]);
    }

    static void subtract(Limit& from, const Step& step) {
        from.triangles -= step.at_boundary ? 1 : 2;
        from.edges -= step.at_boundary ? 2 : 3;
    }

    void count(const Step& step) {
        subtract(live, step);
        ++made;
    }

    void take(const Step& step) {
        count(step);
        if (!keep_log) return;
        log.collapses.push_back(
            {base.id[step.kept], base.id[step.removed], cube.outside(step.point), {}, {}});
        log.sources.push_back(step.source);
    }

    bool collapse_one() {
        Step step;
        whole.patch.keeps_volume = live.triangles > fitted_below;
        if (live.triangles <= guarded_below) whole.patch.keep_from_crossing();
        whole.patch.memoryless = live.triangles > fitted_below;
        while (!whole.patch.collapse_cheapest(step))
            if (!whole.patch.relax()) return false;
        steps.push_back(step);
        ++taken;
        take(step);
        return true;
    }

    /// The steps of the last round are all taken: another round, or all the rest in one patch.
    void go_on() {
        if (!next.left.position.empty()) {
            for (std::uint32_t& v : became) v = next.became[v];
            base = std::move(next.left);
            next = {};
        }
        steps.clear();
        taken = 0;
        if (live.triangles > thinned_above && base.beside.empty() && base.quadrics.empty() && idle == 0)
            return weights.colour > 0 ? thin<3>() : thin<0>();
        const TriangleQuadrics<N> of_triangles(mesh, base, weights);
        if (idle == most_idle_rounds || live.triangles <= one_patch) {
            whole = whole_patch(base, mesh, cube, of_triangles);
            base.quadrics = {};
            whole.patch.queue_edges(std::numeric_limits<float>::infinity());
            in_one_patch = true;
            patch_has = live;
            return;
        }
        RoundOptions options{triangles_per_tile, turn++, price};
        next = collapse_tiles(base, mesh, cube, of_triangles, options);
        end_round(options.price);
    }

    /// A round by place, and colour where M is 3, alone.
    template <int M> void thin() {
        Surface<M> surface{std::move(static_cast<Shape&>(base)), {}};
        const TriangleQuadrics<M> of_triangles(mesh, surface, {weights.colour, 0});
        RoundOptions options{triangles_per_tile, turn++, price, true};
        Round<M> round = collapse_tiles(surface, mesh, cube, of_triangles, options);
        static_cast<Shape&>(base) = std::move(surface);
        next = {std::move(round.steps), {std::move(round.left), {}}, std::move(round.became)};
        end_round(options.price);
    }

    void end_round(float paid) {
        const bool idled =
            double(next.left.triangles.size()) > least_progress * double(base.triangles.size());
        idle = idled ? idle + 1 : 0;
        price = paid * (idled ? price_leaps : price_grows);
        steps = std::move(next.steps);
        in_order = false;
    }

    const Mesh& mesh;
    UnitCube cube;
    AttributeWeights weights;
    Limit live; ///< triangles and edges that are left
    bool keep_log;
    Log log;
    std::size_t made = 0;
    std::vector<std::uint32_t> became; ///< for every vertex of the mesh, which one of `base`

    Surface<N> base;         ///< before `steps`
    std::vector<Step> steps; ///< in names of `base`
    std::size_t taken = 0;   ///< of them
    bool in_order = true;    ///< by cost
    Round<N> next;           ///< what all steps of a round leave
    unsigned turn = 0;
    float price = 0;
    int idle = 0;
    bool in_one_patch = false;
    Limit patch_has; ///< when it became one
    NamedPatch<N> whole;
};

/// Do values differ anywhere? What is the same everywhere needs no quadrics.
bool vary(const std::vector<glm::vec3>& values) {
    return std::any_of(values.begin(), values.end(), [&](const glm::vec3& v) { return v != values.front(); });
}

} // namespace

std::unique_ptr<Collapser> Collapser::make(const Mesh& mesh, const Limit& have, const AttributeWeights& asked,
                                           bool keep_log) {
    AttributeWeights weights = asked;
    if (!vary(mesh.colours)) weights.colour = 0;
    if (!vary(mesh.normals)) weights.normal = 0;
    switch ((weights.colour > 0) + (weights.normal > 0)) {
    case 0:
        return std::make_unique<RoundsCollapser<0>>(mesh, have, weights, keep_log);
    case 1:
        return std::make_unique<RoundsCollapser<3>>(mesh, have, weights, keep_log);
    default:
        return std::make_unique<RoundsCollapser<6>>(mesh, have, weights, keep_log);
    }
}

} // namespace glcast
