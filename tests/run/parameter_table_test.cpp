// The table in docs/reference/parameters.md is generated from the rows. This command updates it:
//
//     SWIRL_WRITE_DOCS=1 build/tests/tests/test_run --gtest_filter='ParameterTable.*'
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "swirl/run/parameters.hpp"

namespace swirl {
namespace {

const std::string page = std::string(SWIRL_SOURCE_DIR) + "/docs/reference/parameters.md";
constexpr std::string_view begin = "<!-- made of src/swirl/run/parameter_table.cpp -->\n";
constexpr std::string_view end = "<!-- end -->\n";

/// Escapes bars, which would end the cell.
std::string escaped(std::string text) {
    for (std::size_t at = 0; (at = text.find('|', at)) != text.npos; at += 2)
        text.insert(at, 1, '\\');
    return text;
}

std::string range_of(const Parameter& p) {
    return p.range.highest > 0.0 ? fmt::format("{:g} … {:g}", p.range.lowest, p.range.highest) : "";
}

std::string documentation_of(const Parameter& p) {
    std::string text = p.description;
    if (*p.details) text += fmt::format(". {}", p.details);
    if (user_name(p.name) != p.name)
        text += fmt::format("{} Its key in results is `{}`.", *p.details ? "" : ".", p.name);
    return text;
}

std::string row(const Parameter& p) {
    const std::string range = range_of(p), separator = range.empty() || !*p.unit ? "" : " ";
    return fmt::format("| `{}` | {} | {} | {}{}{} | {} |\n", user_name(p.name), p.symbol,
                       default_of(p), range, separator, p.unit, escaped(documentation_of(p)));
}

std::string table() {
    std::string text;
    std::string_view group;
    for (const Parameter& p : run_parameters) {
        if (group != p.group)
            text += fmt::format(
                "\n### {}\n\n| Name | Symbol | Default | Range | |\n|---|---|---|---|---|\n",
                p.group);
        group = p.group;
        text += row(p);
    }
    return text + "\n";
}

TEST(ParameterTable, InTheDocsIsUpToDate) {
    std::ostringstream text;
    text << std::ifstream(page).rdbuf();
    std::string docs = text.str();
    const std::size_t from = docs.find(begin), to = docs.find(end);
    ASSERT_NE(from, docs.npos);
    ASSERT_NE(to, docs.npos);
    const std::size_t first = from + begin.size();
    if (std::getenv("SWIRL_WRITE_DOCS")) {
        docs.replace(first, to - first, table());
        std::ofstream(page) << docs;
        return;
    }
    EXPECT_TRUE(docs.substr(first, to - first) == table())
        << "docs/reference/parameters.md differs from the rows. This command writes it: "
           "SWIRL_WRITE_DOCS=1 build/tests/tests/test_run --gtest_filter='ParameterTable.*'";
}

TEST(ParameterTable, DescriptionsFitIntoTheHelp) {
    constexpr std::size_t max_bytes = 62;  // 60 characters, and two bytes more for π
    for (const Parameter& p : run_parameters)
        EXPECT_LE(std::string_view(p.description).size(), max_bytes) << p.name;
}

// The page has a label for every control and a slider for every number, which includes the default.
TEST(ParameterTable, EveryNumberOnThePageHasASliderInsideItsRange) {
    for (const Parameter& p : run_parameters) {
        const bool is_number =
            p.is_settable() && (p.member.index() != 0 || std::string_view(p.form) == "NUMBER");
        EXPECT_EQ(p.page.group == nullptr, *p.page.label == '\0')
            << p.name << " needs both .group and .label in .page, or none of them.";
        if (!p.page.group) continue;
        const auto& [first, last, step] = p.page.slider;
        ASSERT_EQ(step > 0.0, is_number)
            << p.name << " needs a .slider in .page if it is a number, and only then.";
        if (!is_number) continue;
        EXPECT_LT(first, last) << p.name;
        EXPECT_GE(first, p.range.lowest) << p.name;
        EXPECT_LE(last, p.range.highest > 0.0 ? p.range.highest : last) << p.name;
        const double steps = (last - first) / step;
        EXPECT_NEAR(steps, std::round(steps), 1e-9) << p.name;  // rounding of a few divisions
        char* end_of_number = nullptr;
        const std::string default_text = default_of(p);
        const double value = std::strtod(default_text.c_str(), &end_of_number);
        if (default_text.empty() || *end_of_number != '\0') continue;  // a word, or nothing
        EXPECT_TRUE(first <= value && value <= last) << p.name;
    }
}

}  // namespace
}  // namespace swirl
