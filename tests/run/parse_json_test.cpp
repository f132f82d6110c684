#include "swirl/run/parse_json.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

namespace swirl {
namespace {

TEST(ParseJson, DeepNestingIsRejected) {
    // At half a million levels, even copying the value exhausts the stack.
    for (const int depth : {101, 500000})
        for (const std::string open : {"[", "{\"a\":"}) {
            std::string text;
            for (int k = 0; k < depth; ++k) text += open;
            text += '1';
            for (int k = 0; k < depth; ++k) text += open == "[" ? ']' : '}';
            EXPECT_TRUE(parse_json(text).is_discarded());
        }
    EXPECT_TRUE(parse_json(std::string(500000, '[')).is_discarded());
    EXPECT_TRUE(parse_json("").is_discarded());
    EXPECT_TRUE(parse_json("[1, 2").is_discarded());
    const std::string brackets(1000, '[');
    EXPECT_EQ(parse_json("[\"\\\"" + brackets + "\", \"\\\\\"]").at(0), "\"" + brackets);
    std::string wide = "[0";  // many values, but two levels
    for (int k = 0; k < 1000; ++k) wide += ",[{}]";
    EXPECT_EQ(parse_json(wide + "]").size(), 1001u);
}

TEST(ParseJson, RepeatedNamesAreNoted) {
    const auto repeated = [](const char* text) {
        std::string name;
        EXPECT_FALSE(parse_json(text, name).is_discarded());
        return name;
    };
    EXPECT_EQ(repeated(R"({"a": {"b": 1}, "b": [{"a": 1}, {"a": 1}]})"), "");
    EXPECT_EQ(repeated(R"({"a": {"b": 1, "c": 1, "b": 2, "c": 2}})"), "b");
}

}  // namespace
}  // namespace swirl
