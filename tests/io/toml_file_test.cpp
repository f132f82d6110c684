#include "swirl/io/toml_file.hpp"

#include <gtest/gtest.h>

#include "swirl/io/file_error.hpp"

namespace swirl {
namespace {

std::string rejection_of_text(std::string text) {
    try {
        parse_config(std::move(text), "a.toml");
    } catch (const FileError& error) {
        return error.what();
    }
    return "";
}

TEST(Config, ReadsNumbersTextsAndLists) {
    const std::string text =
        "# a study\ndiscs = 40\nmu_wall = 0.1\nevents = 1e6\ninertia = \"ring\"\n"
        "seed = 18446744073709551\nmu-disc = [0.1, 1]\nquiet = true\n";
    const Config config = parse_config(text, "a.toml");
    EXPECT_EQ(config.text, text);
    ASSERT_EQ(config.entries.size(), 7u);
    const auto one = [&](const char* name) { return config.entries.at(name).values.at(0); };
    EXPECT_EQ(one("discs"), "40");
    EXPECT_EQ(one("mu_wall"), "0.1");
    EXPECT_EQ(std::stod(one("events")), 1e6);
    EXPECT_EQ(one("inertia"), "ring");
    EXPECT_EQ(one("seed"), "18446744073709551");
    EXPECT_EQ(one("quiet"), "true");
    const ConfigEntry& list = config.entries.at("mu_disc");
    EXPECT_TRUE(list.is_list);
    EXPECT_EQ(list.values, (std::vector<std::string>{"0.1", "1"}));
    EXPECT_EQ(list.line, 7);
    EXPECT_TRUE(parse_config("", "a.toml").entries.empty());
}

TEST(Config, AcceptsByteOrderMarkAndWindowsLineEnds) {
    const Config config = parse_config(
        "\xef\xbb\xbf"
        "discs = 40\r\nmu = 0.5\r\n",
        "a.toml");
    EXPECT_EQ(config.entries.at("discs").values.at(0), "40");
    EXPECT_EQ(config.entries.at("mu").values.at(0), "0.5");
}

TEST(Config, InvalidConfigurationIsRejectedWithTheLine) {
    EXPECT_EQ(rejection_of_text("discs = 1\nmu = = 2\n").substr(0, 17), "'a.toml', line 2,");
    EXPECT_NE(rejection_of_text("[run]\ndiscs = 1\n").find("is a table"), std::string::npos);
    EXPECT_NE(rejection_of_text("mu = [[1]]\n").find("must be a number"), std::string::npos);
    EXPECT_NE(rejection_of_text("mu = 1979-05-27\n").find("must be a number"), std::string::npos);
    EXPECT_NE(rejection_of_text("mu_wall = 1\nmu-wall = 2\n").find("is given twice"),
              std::string::npos);
    EXPECT_NE(rejection_of_text("mu = 1\nmu = 2\n"), "");
}

std::string repeated(const std::string& text, int count) {
    std::string all;
    for (int k = 0; k < count; ++k) all += text;
    return all;
}

// The parser follows each of these by recursion, and would exhaust the stack.
TEST(Config, DeepNestingIsRejected) {
    constexpr int deep = 40000;
    for (const std::string& before :
         {std::string("discs = 1\n"), std::string("a = \"\"\"b\"\"\"\"\n"),
          std::string("a = '\\'\n"), std::string("a = [\"\"\"b\"\"\"\"\", "),
          std::string("a = [\"\\\"\", {"), std::string("# \"\n[")})
        EXPECT_NE(rejection_of_text(before + repeated("a.", deep) + "a = 1\n")
                      .find("a key has more than 16 parts"),
                  std::string::npos)
            << before;
    EXPECT_NE(
        rejection_of_text("[" + repeated("\"=\" . ", deep) + "a]\n").find("more than 16 parts"),
        std::string::npos);
    EXPECT_NE(rejection_of_text("x = " + repeated("[", deep) + "\n"), "");
    EXPECT_NE(rejection_of_text("x = " + repeated("{a.b.c.d.e.f.g.h = ", deep) + "\n"), "");
    EXPECT_NE(rejection_of_text(repeated("a.", 15) + "a = 1\n").find("[a] is a table"),
              std::string::npos);
    // Dots in texts, comments and numbers are no keys.
    const std::string dots = repeated(".", deep);
    EXPECT_EQ(parse_config("# " + dots + "\nmu = [" + repeated("0.5, ", 100) + "1]\nout = \"" +
                               dots + "\"\njson = '" + dots + "'\n",
                           "a.toml")
                  .entries.size(),
              3u);
}

TEST(Config, BytesThatAreNotTextAreRejected) {
    using namespace std::string_literals;
    for (const std::string& bytes :
         {"mu = 1\0"s, "mu = \"\xff\""s, "mu = \"\xc0\xaf\""s, "mu = \"\xed\xa0\x80\""s,
          "mu = \"\xf4\x90\x80\x80\""s, "mu = \"\xe2\x82"s, "mu = 1\x1b"s, "\xc3"s, "\xf0\x9f"s})
        EXPECT_NE(rejection_of_text("discs = 1\n" + bytes).find("line 2: byte 0x"),
                  std::string::npos)
            << rejection_of_text("discs = 1\n" + bytes);
    EXPECT_EQ(rejection_of_text("# \xcf\x96 \xe2\x89\xa4 \xf0\x9f\x8c\x80\n"), "");
    EXPECT_NE(rejection_of_text(std::string(2 << 20, '#')).find("longer than 1048576 bytes"),
              std::string::npos);
}

TEST(Config, SyntaxErrorsNameLineAndColumn) {
    const std::string rule =
        " is not valid TOML.\nhint: write NAME = VALUE, each name once, with texts in quotation "
        "marks "
        "and lists in square brackets.";
    EXPECT_EQ(rejection_of_text("discs = 1\nmu = = 2\n"),
              "'a.toml', line 2, column 6: 'mu = = 2'" + rule);
    EXPECT_EQ(rejection_of_text("discs = 5 6\r\n"),
              "'a.toml', line 1, column 11: 'discs = 5 6'" + rule);
    EXPECT_EQ(rejection_of_text("mu = 1\nmu = 2"), "'a.toml', line 2, column 6: 'mu = 2'" + rule);
    const std::string longer = "out = \"" + std::string(100, 'x');
    EXPECT_EQ(rejection_of_text(longer), "'a.toml', line 1, column 108: this" + rule);
    for (const char* text : {"discs = \n", "[x\n", "a = 01\n", "x = [1, 2\n", "x = \"\\q\"\n"})
        EXPECT_EQ(rejection_of_text(text).find("rror"), std::string::npos)
            << rejection_of_text(text);
}

TEST(Config, RandomTextDoesNotCrash) {
    std::uint64_t state = 12345;
    const std::string alphabet = "[]{}=\"'.,#\n\t x1-+eE:TZ\\\xc3\xa9_";
    for (int round = 0; round < 3000; ++round) {
        std::string text;
        for (int k = 0; k < 40; ++k) {
            state = state * 6364136223846793005u + 1442695040888963407u;
            text += alphabet[(state >> 33) % alphabet.size()];
        }
        rejection_of_text(text);
    }
}

}  // namespace
}  // namespace swirl
