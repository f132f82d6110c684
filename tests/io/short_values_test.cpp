#include "swirl/io/short_values.hpp"

#include <gtest/gtest.h>

#include <string>

#include "swirl/io/file_error.hpp"

namespace swirl {
namespace {

TEST(ShortValues, LongValuesKeepTheirBeginningAndTheirEnd) {
    const std::string digits = "12345" + std::string(10'000, '0') + "67890";
    const std::string kept =
        "12345" + std::string(53, '0') + "..." + std::string(14, '0') + "67890";
    ASSERT_EQ(kept.size(), max_quoted);
    for (const auto& [before, after] : {std::pair("--discs is '", "', but it must be a number."),
                                        {"there is no option --", "."},
                                        {"'a.csv', line 2: column 'x' is '", "'"},
                                        {"(", ")."},
                                        {"", ""}})
        EXPECT_NE(with_short_values(before + digits + after).find("..."), std::string::npos);
    EXPECT_EQ(with_short_values("--discs is '" + digits + "', but it must be 5.\nhint: give 5."),
              "--discs is '" + kept + "', but it must be 5.\nhint: give 5.");
    EXPECT_EQ(
        with_short_values("--motion is 'points " + digits + " 1:0:1', but it is not closed."),
        "--motion is '" + shortened("points " + digits + " 1:0:1") + "', but it is not closed.");
}

TEST(ShortValues, OrdinaryMessagesAndPathsStay) {
    const std::string path = "/tmp/" + std::string(200, 'x') + "/a.json";
    for (const std::string& message :
         {std::string("--mu is 'it's', but it must be a number.\nhint: did you mean '1'?"),
          "'" + path + "' already exists.", "see `swirl run --out '" + path + "'`.",
          std::string("the period's end  is\n\nlate."), std::string("'"), std::string("' '"),
          std::string("ϖ is 'ϖϖϖ'."), std::string()})
        EXPECT_EQ(with_short_values(message), message);
    EXPECT_LT(with_short_values("'" + std::string(5000, '/') + "' is no file.").size(), 450u);
}

TEST(ShortValues, CharactersAreNotSplit) {
    std::string umlauts;
    for (int k = 0; k < 500; ++k) umlauts += "ä";
    const std::string kept = shortened(umlauts);
    EXPECT_EQ(kept.size(), 2 * (max_quoted - 3) + 3);
    for (std::size_t k = 0; k < kept.size() - 1; ++k)
        EXPECT_EQ(kept[k] == '\xc3', kept[k + 1] == '\xa4') << k;
}

TEST(ShortValues, MessagesAboutFilesAreShort) {
    const std::string text = "column 'x' is '" + std::string(100'000, '3') + "', but it must be 1.";
    EXPECT_LT(std::string(FileError(text).what()).size(), 200u);
    EXPECT_LT(std::string(FileChanged(text).what()).size(), 200u);
}

}  // namespace
}  // namespace swirl
