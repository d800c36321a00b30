// What commands say: safe on a terminal, and plain.
#include <gtest/gtest.h>

#include "tools/words/closing.h"
#include "tools/words/text.h"

using namespace glcast;

TEST(Printable, ControlsAreWrittenOut) {
    EXPECT_EQ(printable("a\x1b[31mb\rc\nd\te\x07\x7f"), "a\\x1b[31mb\\x0dc\\x0ad\\x09e\\x07\\x7f");
    EXPECT_EQ(printable(std::string_view("a\0b", 3)), "a\\x00b");
    EXPECT_EQ(printable("\xc2\x9b"
                        "2J"),
              "\\xc2\\x9b2J")
        << "ISO 6429's one-letter ESC [";
}

TEST(Printable, WordsOfAnyLanguageStay) {
    for (const char* word : {"gears", "Zahnräder", "шестерни", "歯車", "😀", ""})
        EXPECT_EQ(printable(word), word);
}

TEST(Printable, WhatIsNoUtf8IsWrittenOut) {
    EXPECT_EQ(printable("\xff"), "\\xff");
    EXPECT_EQ(printable("\xc3"), "\\xc3") << "cut off";
    EXPECT_EQ(printable("\xc0\x9b"), "\\xc0\\x9b") << "ESC in two bytes";
    EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80") << "a surrogate";
    EXPECT_EQ(printable("\xf5\x80\x80\x80"), "\\xf5\\x80\\x80\\x80");
}

TEST(ShellWord, QuotesOnlyWhereItMust) {
    EXPECT_EQ(shell_word("/tmp/gears-1.%f.glb"), "/tmp/gears-1.%f.glb");
    EXPECT_EQ(shell_word("my gears.glb"), "'my gears.glb'");
    EXPECT_EQ(shell_word("it's"), "'it'\\''s'");
    EXPECT_EQ(shell_word(""), "''");
}

TEST(Nearest, FindsSlipsOfTheFinger) {
    const std::vector<std::string> names = {"mesh", "info", "compare", "refine", "render", "view"};
    EXPECT_EQ(nearest("mehs", names), "mesh");
    EXPECT_EQ(nearest("inof", names), "info");
    EXPECT_EQ(nearest("comapre", names), "compare");
    EXPECT_EQ(nearest("rendr", names), "render");
    EXPECT_EQ(nearest("views", names), "view");
    EXPECT_EQ(nearest("foo", names), "");
    EXPECT_EQ(nearest("convert", names), "");
}

TEST(Counted, InThousands) {
    EXPECT_EQ(counted(0, "level"), "0 levels");
    EXPECT_EQ(counted(1, "level"), "1 level");
    EXPECT_EQ(counted(999, "triangle"), "999 triangles");
    EXPECT_EQ(counted(1293944, "triangle"), "1,293,944 triangles");
}

TEST(ErrorInWords, AnEighthOfAPixelIsInvisible) {
    EXPECT_EQ(error_in_words(0.1, 512), "0.1 samples from what was drawn (invisible at 256 pixels)");
    EXPECT_EQ(error_in_words(0.25, 512), "0.25 samples from what was drawn (invisible at 256 pixels)");
    EXPECT_EQ(error_in_words(0.26, 512), "0.26 samples from what was drawn (invisible at 128 pixels)");
    EXPECT_EQ(error_in_words(1, 512), "1 sample from what was drawn (invisible at 64 pixels)");
    EXPECT_EQ(invisible_width(2, 512), 32);
    EXPECT_EQ(invisible_width(0, 96), 48);
    EXPECT_EQ(error_in_words(500, 512), "500 samples from what was drawn (visible at any size)");
}

TEST(ClosingLine, SaysWhatHowFineWhereAndHowToLook) {
    EXPECT_EQ(
        closing_line({"glxgears, frame 3", 44820, 0.1, 512, "out/my gears.glb", 3}),
        "glxgears, frame 3: 44,820 triangles, 0.1 samples from what was drawn (invisible at 256 pixels), in "
        "out/my gears.glb, with 3 coarser levels beside it; to look at it: glcast view 'out/my gears.glb' -o "
        "'out/my gears.html'");
    EXPECT_EQ(closing_line({"a\033]0;b\a", 4, 0, 8, "x.ply", 0}),
              "a\\x1b]0;b\\x07: 4 triangles, 0 samples from what was drawn (visible at any size), in x.ply; "
              "to look at it: "
              "glcast view x.ply -o x.html");
}
