// Every fixture in every way of drawing: recorded and replayed, the image is the one drawn directly.
#include "fixtures/shapes.h"
#include "tests/record/rig.h"

namespace glcast::test {
namespace {

struct Drawing {
    std::string shape;
    fixtures::Way way;
};

std::vector<Drawing> drawings() {
    std::vector<Drawing> all;
    for (const std::string& shape : fixtures::shape_names())
        for (std::size_t way = 0; way < fixtures::way_names().size(); ++way)
            if (fixtures::can_draw(shape, fixtures::Way(way))) all.push_back({shape, fixtures::Way(way)});
    return all;
}

void PrintTo(const Drawing& drawing, std::ostream* out) { *out << drawing.shape; }

class Shape : public testing::TestWithParam<Drawing> {};
TEST_P(Shape, replays_as_drawn) {
    Rig rig;
    fixtures::Scene scene(rig.gl(), GetParam().shape, GetParam().way);
    rig.begin();
    scene.draw_frame(Rig::size, Rig::size, 30);
    rig.end();
    const Picture direct = rig.direct();
    EXPECT_GT(Rig::covered(direct), 100u);
    EXPECT_EQ(different_pixels(rig.replayed(), direct, 0, last_bits_of_depth), 0u);
    EXPECT_TRUE(record::not_understood(*rig.frame).empty());
    rig.program.make_current();
    EXPECT_EQ(rig.gl().GetError(), GLenum(GL_NO_ERROR));
}
INSTANTIATE_TEST_SUITE_P(Shapes, Shape, testing::ValuesIn(drawings()), [](const auto& info) {
    return info.param.shape + "_" + fixtures::way_names()[std::size_t(info.param.way)];
});

} // namespace
} // namespace glcast::test
