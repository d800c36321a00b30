// glcast view as a user runs it. What the page does in a browser is browser_test's.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/file/file_tools.h"
#include "tests/file/sphere_capture.h"
#include "tests/view/ball.h"

using namespace glcast;
using namespace glcast::samples;
using Json = nlohmann::json;

namespace {

Ran view(const std::string& arguments) { return run(GLCAST_COMMAND " view " + arguments); }

[[maybe_unused]] Json json_of(const std::string& arguments) {
    const Ran ran = view(arguments + " --json 2>/dev/null");
    EXPECT_EQ(ran.status, 0) << ran.output;
    return ran.status == 0 ? Json::parse(ran.output) : Json();
}

void expect_one_line(const Ran& ran, int status, const std::string& part) {
    EXPECT_EQ(ran.status, status) << ran.output;
    EXPECT_TRUE(ran.output.starts_with("glcast: ")) << ran.output;
    EXPECT_EQ(std::count(ran.output.begin(), ran.output.end(), '\n'), 1) << ran.output;
    EXPECT_NE(ran.output.find(part), std::string::npos) << ran.output;
}

[[maybe_unused]] std::size_t occurrences(const std::string& text, const std::string& what) {
    std::size_t found = 0;
    for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; ++at) ++found;
    return found;
}

class ViewCommand : public testing::Test {
  protected:
    void SetUp() override { write_balls(file("s.glb")); }
    std::string file(const std::string& name) const { return (folder / name).string(); }
    Folder folder;
};

} // namespace

#ifndef GLCAST_PAGE
TEST_F(ViewCommand, SaysWhatIsMissing) {
    expect_one_line(view(file("s.glb") + " -o " + file("s.html")), 1, "npm ci");
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"s.glb", "s_LOD1.glb", "s_LOD2.glb"}));
}
#else
TEST_F(ViewCommand, LevelsOfOneSet) {
    const Json told = json_of(file("s.glb") + " -o " + file("s.html"));
    EXPECT_EQ(told["bytes"], std::filesystem::file_size(file("s.html")));
    EXPECT_EQ(told["views"], 0);
    ASSERT_EQ(told["levels"].size(), 3u);
    EXPECT_EQ(told["levels"][0]["triangles"], 16128);
    EXPECT_EQ(told["levels"][0]["maxError"], 0);
    EXPECT_GT(told["levels"][1]["maxError"], 0) << "measured, as the file does not tell";
    EXPECT_LT(told["levels"][1]["maxError"], 0.02);
    EXPECT_EQ(told["levels"][2]["maxError"], 0.2) << "as the file tells";
    EXPECT_LT(told["levels"][0]["pageBytes"], told["levels"][0]["glbBytes"]);
    write_levels(file("one.glb"), std::vector<Level>(1, read_levels(file("s.glb"))[0]));
    EXPECT_EQ(told["levels"][0]["glbBytes"], std::filesystem::file_size(file("one.glb")));
}

TEST_F(ViewCommand, LevelsOfASetAreThoseOfOneFile) {
    write_balls(file("one.glb"), true);
    const Json set = json_of(file("s.glb") + " -o " + file("s.html"));
    const Json one = json_of(file("one.glb") + " -o " + file("one.html"));
    ASSERT_EQ(set["levels"].size(), 3u);
    for (std::size_t k = 0; k < 3; ++k)
        for (const char* what : {"name", "triangles", "maxError", "pageBytes"})
            EXPECT_EQ(set["levels"][k][what], one["levels"][k][what]) << k << what;
    const Json alone = json_of(file("s_LOD1.glb") + " -o " + file("alone.html"));
    ASSERT_EQ(alone["levels"].size(), 1u) << "named alone it is that level alone";
    EXPECT_EQ(alone["levels"][0]["triangles"], 960);
    ASSERT_EQ(view(file("s") + "*.glb -o " + file("all.html")).status, 0);
    EXPECT_TRUE(read_text(file("all.html")) == read_text(file("s.html")))
        << "named too, they are not there twice";
}

TEST_F(ViewCommand, FilesAreLevelsFinestFirst) {
    const std::vector<Level> levels = read_all_levels(file("s.glb"));
    ASSERT_EQ(levels.size(), 3u);
    write_levels(file("fine.ply"), std::span(&levels[0], 1));
    write_levels(file("coarse.off"), std::span(&levels[2], 1));
    const Json told = json_of(file("coarse.off") + " " + file("fine.ply") + " -o " + file("s.html"));
    ASSERT_EQ(told["levels"].size(), 2u);
    EXPECT_EQ(told["levels"][0]["triangles"], 16128);
    EXPECT_EQ(told["levels"][1]["triangles"], 224);
    EXPECT_GT(told["levels"][1]["maxError"], 0.1);
    EXPECT_LT(told["levels"][1]["maxError"], 0.25);
}

TEST_F(ViewCommand, LargeLevelsAreLeftOut) {
    const Json told = json_of(file("s.glb") + " --max-triangles 900 -o " + file("s.html"));
    ASSERT_EQ(told["levels"].size(), 3u) << "told all the same";
    EXPECT_FALSE(told["levels"][0]["inPage"]);
    EXPECT_FALSE(told["levels"][1]["inPage"]);
    EXPECT_TRUE(told["levels"][2]["inPage"]);
    EXPECT_EQ(occurrences(read_text(file("s.html")), "<script type=\"text/plain\""), 1u);
    const Ran ran = view(file("s.glb") + " --max-triangles 900 -o " + file("s.html"));
    EXPECT_NE(ran.output.find("left out"), std::string::npos);
}

TEST_F(ViewCommand, ACaptureIsMeshedAndShown) {
    ASSERT_EQ(write_nested(file("c.exr"), 64), "");
    const Json told = json_of(file("c.exr") + " -o " + file("c.html"));
    EXPECT_EQ(told["views"], 6) << "the six, and none of the layers behind them";
    EXPECT_GE(told["levels"].size(), 2u);
    const Json beside = json_of(file("s.glb") + " --capture " + file("c.exr") + " -o " + file("s.html"));
    EXPECT_EQ(beside["views"], 6);
    EXPECT_EQ(beside["levels"].size(), 3u);
}

TEST_F(ViewCommand, NamesCannotEndTheData) {
    ASSERT_EQ(view(file("s.glb") + " -o " + file("s.html")).status, 0);
    const std::string page = read_text(file("s.html"));
    EXPECT_EQ(occurrences(page, "throw 1"), 1u);
    EXPECT_EQ(occurrences(page, "<script>throw 1"), 0u);
    EXPECT_EQ(occurrences(page, "</script"), occurrences(page, "<script"));
}

TEST_F(ViewCommand, NothingIsFetched) {
    ASSERT_EQ(view(file("s.glb") + " -o " + file("s.html")).status, 0);
    const std::string page = read_text(file("s.html"));
    for (const char* reference : {" src=\"http", " href=\"http", "url(http", "@import"})
        EXPECT_EQ(occurrences(page, reference), 0u) << reference;
    EXPECT_NE(page.find("default-src 'none'"), std::string::npos) << "and the browser holds the page to it";
}

TEST_F(ViewCommand, SameInputSamePage) {
    ASSERT_EQ(view(file("s.glb") + " -o " + file("a.html")).status, 0);
    ASSERT_EQ(view(file("s.glb") + " -o " + file("b.html")).status, 0);
    EXPECT_TRUE(read_text(file("a.html")) == read_text(file("b.html")));
}

TEST_F(ViewCommand, RefusalsAreOneLineAndLeaveNothing) {
    write_text(file("bad.ply"), "nonsense");
    write_text(file("bad.exr"), "nonsense");
    const std::string good = file("s.glb"), out = " -o " + file("o.html");
    const std::vector<std::string> before = folder.names();
    expect_one_line(view(file("bad.ply") + out), 1, "bad.ply");
    expect_one_line(view(file("none.glb") + out), 1, "none.glb");
    expect_one_line(view(file("bad.exr") + out), 1, "bad.exr");
    expect_one_line(view(good + " " + file("bad.ply") + out), 1, "bad.ply");
    expect_one_line(view(good + " --capture " + file("bad.exr") + out), 1, "bad.exr");
    expect_one_line(view(good + " --capture " + good + out), 1, "s.glb");
    expect_one_line(view(good + " --max-triangles 100" + out), 1, "--max-triangles");
    expect_one_line(view(good + " -o " + file("o.htm")), 1, "name it .html");
    expect_one_line(view(good + " -o " + file("no/o.html")), 1, "No such file");
    expect_one_line(view(good), 2, "--help");
    expect_one_line(view(good + " --max-triangles 0" + out), 2, "--help");
    EXPECT_EQ(folder.names(), before);
    EXPECT_EQ(view("--help").status, 0);
}
#endif
