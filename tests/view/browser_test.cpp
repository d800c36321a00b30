// The page of glcast view in Debian's Chromium: page_test.mjs clicks and looks at pixels.
#include <gtest/gtest.h>

#include "tests/file/file_tools.h"
#include "tests/file/sphere_capture.h"
#include "tests/view/ball.h"

using namespace glcast::samples;

TEST(Page, InChromium) {
    const Folder folder;
    const std::string ball = (folder / "s<i>&.glb").string(), capture = (folder / "s.exr").string(),
                      page = (folder / "page.html").string();
    write_balls(ball);
    ASSERT_EQ(write_sphere(capture, 48), "");
    const Ran made = run(GLCAST_COMMAND " view \"" + ball + "\" --capture " + capture + " --max-triangles 5000 -o " + page);
    ASSERT_EQ(made.status, 0) << made.output;
    const Ran ran = run(GLCAST_NODE " " GLCAST_PAGE_TEST " chromium " + page);
    EXPECT_EQ(ran.status, 0) << ran.output;
    EXPECT_NE(ran.output.find("all is well"), std::string::npos) << ran.output;
}
