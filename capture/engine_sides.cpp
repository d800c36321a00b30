#include "capture/engine_sides.h"

#include "capture/engine_blend.h"
#include "capture/engine_normal.h"

namespace glcast {

namespace {

Side opposite(Side side) { return side == Side::minus ? Side::plus : Side::minus; }

ViewImage see(PassRunner& passes, const Target& target, Pass pass, Side viewer, NormalMethod normals,
              const ViewImage& hits) {
    const PixelRect part = pass.only.value_or(PixelRect::whole(hits.n));
    pass.kind = PassKind::colour;
    pass.depth = DepthRule::equal;
    pass.viewer = viewer;
    passes.run(pass, target);
    std::vector<std::uint8_t> marks;
    target.read_stencil(marks, part);
    blend_coincident(passes, target, pass);
    ViewImage seen;
    seen.view = {pass.axis, Side::minus, 1}; // no normal but at this depth
    seen.n = hits.n;
    read_blended(target, seen.colour, part);
    for_each_pixel(part, seen.n,
                   [&](std::size_t p) { seen.colour[p].a = hits.covered(p) && marks[p] != 0 ? 1.0f : 0.0f; });
    seen.normal.assign(seen.colour.size(), glm::vec4(0));
    capture_normals(passes, target, pass, normals, seen);
    return seen;
}

} // namespace

SeenSides see_sides(PassRunner& passes, const Target& target, const Pass& view, const SidesTask& task,
                    NormalMethod normals, const ViewImage& hits) {
    SeenSides seen;
    if (!task.both) return seen;
    Pass pass = view;
    pass.culls = task.culls;
    if (task.culls) seen.own = see(passes, target, pass, view.side, normals, hits);
    seen.other = see(passes, target, pass, opposite(view.side), normals, hits);
    return seen;
}

void take_sides(const SeenSides& seen, const PixelRect& part, ViewImage& image) {
    if (!seen.other) return;
    image.other_colour.resize(image.colour.size());
    image.other_normal.resize(image.normal.size());
    for_each_pixel(part, image.n, [&](std::size_t p) {
        if (!image.covered(p)) return;
        const ViewImage& other = seen.other->covered(p) ? *seen.other : image;
        image.other_colour[p] = other.colour[p];
        image.other_normal[p] = other.normal[p];
        if (!seen.own || !seen.own->covered(p)) return;
        image.colour[p] = seen.own->colour[p];
        image.normal[p] = seen.own->normal[p];
    });
}

} // namespace glcast
