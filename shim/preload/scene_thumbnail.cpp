#include "shim/preload/scene_thumbnail.h"

#include <algorithm>

#include "capture/engine_target.h"
#include "capture/gl/call_classes.h"

namespace glcast::preload {
namespace {

using G = GlTable;
enum When : unsigned { each_time = 1, all_depths = 2, nearest_depths = 4 };
constexpr const char* when_names[] = {"always", "depths are read", "the nearest depths are"};
constexpr GLbitfield own_groups = GL_VIEWPORT_BIT | GL_SCISSOR_BIT | GL_STENCIL_BUFFER_BIT;

constexpr OverrideRule rules[] = {
    {each_time, drop(calls::viewports + calls::scissors), "the picture has a size of its own"},
    {each_time, drop(calls::stencil), "it marks what is drawn on"},
    {each_time, drop(calls::clears + calls::clear_values + only<&G::Clear, &G::ClearColor>),
     "cleared once, before"},
    {each_time, drop(calls::framebuffers + calls::draw_buffers), "our framebuffer"},
    {each_time, drop(only<&G::ColorMask, &G::Accum>), "all colours, of what is drawn"},
    {each_time, drop(calls::texture_copies), "would copy our picture into shared textures"},
    {each_time, drop(calls::pixel_reads), "only we read"},
    {each_time, drop(calls::waits), "we wait for what we read"},
    {each_time, drop(only<&G::RenderMode>), "selection and feedback draw nothing"},
    {each_time, handle<SwitchNotOwned<PictureTable>>(only<&G::Enable, &G::Disable>),
     "scissor, stencil and dither are the picture's; culling where all faces are wanted"},
    {each_time, handle<SaveWithout<PictureTable, own_groups>>(only<&G::PushAttrib>),
     "the picture's state stays as it is"},
    {all_depths, drop(only<&G::DepthMask>), "whatever is drawn has a depth"},
    {nearest_depths, drop(only<&G::DepthFunc>), "what is in front shows"},
};

} // namespace

constinit const OverrideRules picture_rules = {
    "A small picture", "What the program shows, in a picture of ours: thumbnails and questions to the scene",
    rules, when_names};

PictureTable::PictureTable(const GlTable& gl, PictureFaces faces, PictureDepths depths)
    : real(gl), culls(faces == PictureFaces::program), picture(gl) {
    table_owner<PictureTable> = this;
    override_calls(picture, real, rules,
                   each_time | (depths != PictureDepths::program ? all_depths : 0u) |
                       (depths == PictureDepths::nearest ? nearest_depths : 0u));
}

PictureTable::~PictureTable() { table_owner<PictureTable> = nullptr; }

bool PictureTable::owns(GLenum cap) const {
    return (cap == GL_CULL_FACE && !culls) || cap == GL_SCISSOR_TEST || cap == GL_STENCIL_TEST ||
           cap == GL_FRAMEBUFFER_SRGB || cap == GL_DITHER;
}

namespace {

void prepare(const GlTable& gl, const Target& target, int width, int height, bool depth_reversed) {
    target.bind();
    gl.Viewport(0, 0, width, height);
    for (const GLenum cap : {GL_SCISSOR_TEST, GL_DITHER}) gl.Disable(cap);
    gl.Enable(GL_STENCIL_TEST);
    gl.StencilFunc(GL_ALWAYS, 1, ~0u);
    gl.StencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
    gl.StencilMask(~0u);
    gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl.DepthMask(GL_TRUE);
    gl.ClearColor(0.5f, 0.5f, 0.5f, 0);
    gl.ClearDepth(depth_reversed ? 0 : 1);
    gl.ClearStencil(0);
    gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
}

void read(const GlTable& gl, const Target& target, Thumbnail& thumbnail) {
    const int n = target.size();
    std::vector<glm::vec4> colour;
    std::vector<float> depth;
    target.read_colour(colour);
    target.read_depth(depth);
    std::vector<GLubyte> drawn(std::size_t(n) * n);
    gl.ReadPixels(0, 0, n, n, GL_STENCIL_INDEX, GL_UNSIGNED_BYTE, drawn.data());
    float nearest = 1, furthest = 0;
    long covered = 0;
    for (int y = 0; y < thumbnail.height; ++y) {
        for (int x = 0; x < thumbnail.width; ++x) {
            const std::size_t at = std::size_t(y) * n + x;
            for (int channel = 0; channel < 3; ++channel)
                thumbnail.rgb.push_back(
                    std::uint8_t(std::clamp(colour[at][channel], 0.0f, 1.0f) * 255 + 0.5f));
            if (!drawn[at]) continue;
            ++covered;
            nearest = std::min(nearest, depth[at]), furthest = std::max(furthest, depth[at]);
        }
    }
    thumbnail.coverage = double(covered) / (double(thumbnail.width) * thumbnail.height);
    thumbnail.flat = covered > 0 && furthest - nearest < 1e-6f;
}

} // namespace

PictureSize::PictureSize(const std::array<GLint, 4>& viewport, int longer_side) {
    const int longer = std::max({viewport[2], viewport[3], 1});
    width = std::clamp(longer_side * viewport[2] / longer, 1, longer_side);
    height = std::clamp(longer_side * viewport[3] / longer, 1, longer_side);
}

Thumbnail draw_thumbnail(const GlTable& gl, const DrawFunction& draw, const std::array<GLint, 4>& viewport,
                         bool depth_reversed, int size) {
    Thumbnail thumbnail;
    const GlTable calls = with_framebuffer_calls(gl);
    if (!has_framebuffer_calls(calls)) return thumbnail;
    const PictureSize picture(viewport, size);
    thumbnail.width = picture.width;
    thumbnail.height = picture.height;
    const Target target(calls, size, false);
    if (!target.complete()) return thumbnail;
    prepare(calls, target, thumbnail.width, thumbnail.height, depth_reversed);
    draw(PictureTable(calls).table());
    gl.Finish();
    target.bind();
    read(calls, target, thumbnail);
    swallow_errors(gl);
    return thumbnail;
}

DepthPicture draw_depths(const GlTable& gl, const DrawFunction& draw, const std::array<GLint, 4>& viewport,
                         bool program_culls, int size, PictureDepths depths) {
    DepthPicture picture;
    const GlTable calls = with_framebuffer_calls(gl);
    const Target target(calls, size, false);
    if (!target.complete()) return picture;
    const PictureSize sides(viewport, size);
    picture.width = sides.width;
    picture.height = sides.height;
    picture.stride = size;
    prepare(calls, target, sides.width, sides.height, false);
    gl.Disable(GL_CULL_FACE);
    const auto faces = program_culls ? PictureFaces::program : PictureFaces::all;
    if (depths == PictureDepths::nearest) gl.DepthFunc(GL_LESS);
    draw(PictureTable(calls, faces, depths).table());
    gl.Finish();
    target.bind();
    target.read_depth(picture.depth);
    swallow_errors(gl);
    return picture;
}

} // namespace glcast::preload
