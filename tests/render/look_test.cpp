// The colours with a meaning have one table, that of color.hpp and theme.hpp. The least number of
// turns that is drawn is in scene.hpp. The browser page, the Python module and the figures read
// copies of both, which this test writes:
//
//     SWIRL_WRITE_DOCS=1 build/tests/tests/test_render --gtest_filter='Look.*'
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <ranges>
#include <span>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "swirl/math/unit_circle.hpp"
#include "swirl/render/color.hpp"
#include "swirl/render/scene.hpp"
#include "swirl/render/theme.hpp"

namespace swirl {
namespace {

const std::string sources = SWIRL_SOURCE_DIR;

using Names = std::vector<std::pair<const char*, Color>>;

Names signals(const Theme& theme) {
    return {{"with", theme.with},         {"against", theme.against},
            {"pinned", theme.pinned},     {"loose", theme.loose},
            {"neutral", theme.neutral},   {"centrifugal", theme.centrifugal},
            {"coriolis", theme.coriolis}, {"accent", theme.accent}};
}

std::string hex(const Color& c) {
    const auto part = [](double x) { return static_cast<int>(std::lround(255.0 * x)); };
    return fmt::format("#{:02x}{:02x}{:02x}", part(c.red), part(c.green), part(c.blue));
}

std::string quoted(std::span<const Color> colors) {
    std::string text;
    for (const Color& c : colors) text += fmt::format("{}\"{}\"", text.empty() ? "" : ", ", hex(c));
    return text;
}

std::string json() {
    std::string text = "{\n";
    for (const auto& [name, theme] : themes) {
        std::string rows;
        for (const auto& [meaning, color] : signals(theme()))
            rows +=
                fmt::format("{}    \"{}\": \"{}\"", rows.empty() ? "" : ",\n", meaning, hex(color));
        text += fmt::format("  \"{}\": {{\n{}\n  }},\n", name, rows);
    }
    return text + fmt::format(
                      "  \"sectors\": [{}],\n  \"ids\": [{}],\n  \"sequential\": [{}],\n"
                      "  \"leastTurns\": {}\n}}\n",
                      quoted(sector_colors), quoted(distinct_colors), quoted(sequential_stops),
                      least_turns);
}

std::string python() {
    std::string text =
        "\"\"\"The colours with a meaning, on paper: the light theme of movies and images.\n\n"
        "tests/render/look_test.cpp writes this file.\n\"\"\"\n\n";
    for (const auto& [meaning, color] : signals(light_theme())) {
        std::string name = meaning;
        std::ranges::transform(name, name.begin(), [](unsigned char c) { return std::toupper(c); });
        text += fmt::format("{} = \"{}\"\n", name, hex(color));
    }
    return text;
}

TEST(Look, TheCopiesAreUpToDate) {
    const std::pair<const char*, std::string> copies[]{
        {"/web/src/drawing/look.json", json()},
        {"/bindings/python/swirl/_look.py", python()},
        {"/paper/look.py", python()}};
    for (const auto& [file, wanted] : copies) {
        if (std::getenv("SWIRL_WRITE_DOCS")) {
            std::ofstream(sources + file) << wanted;
            continue;
        }
        std::ostringstream there;
        there << std::ifstream(sources + file).rdbuf();
        EXPECT_TRUE(there.str() == wanted)
            << file
            << " differs from the table. This command writes it: SWIRL_WRITE_DOCS=1 "
               "build/tests/tests/test_render --gtest_filter='Look.*'";
    }
}

/// Hue in degrees, and the share of it: 0 for grey, 1 for a pure hue.
std::pair<double, double> hue_of(const Color& c) {
    const double x = c.red - 0.5 * (c.green + c.blue), y = std::sqrt(0.75) * (c.green - c.blue);
    return {std::atan2(y, x) * 180.0 / pi, std::hypot(x, y)};
}

/// Relative luminance of WCAG 2.
double luminance(const Color& c) {
    const auto linear = [](double x) {
        return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
    };
    return 0.2126 * linear(c.red) + 0.7152 * linear(c.green) + 0.0722 * linear(c.blue);
}

double contrast(const Color& a, const Color& b) {
    const double one = luminance(a), other = luminance(b);
    return (std::max(one, other) + 0.05) / (std::min(one, other) + 0.05);
}

TEST(Look, HuesOfDirectionsMeanNothingElse) {
    constexpr double apart = 25.0;  // degrees; 30° lie between orange and yellow
    constexpr double grey = 0.15;
    for (const Theme& theme : {light_theme(), dark_theme()}) {
        std::vector<Color> others(sector_colors.begin(), sector_colors.end());
        others.push_back(theme.pinned);
        others.push_back(theme.loose);
        for (const Color& other : others)
            for (const bool with_swirl : {true, false}) {
                const auto [hue, share] = hue_of(other);
                const double from = hue_of(theme.direction(with_swirl)).first;
                EXPECT_TRUE(share < grey || std::abs(std::remainder(hue - from, 360.0)) > apart)
                    << hex(other) << " is like " << hex(theme.direction(with_swirl));
            }
    }
}

TEST(Look, TextInTheColourOfADirectionIsLegible) {
    for (const Theme& theme : {light_theme(), dark_theme()})
        for (const bool with_swirl : {true, false})
            EXPECT_GT(contrast(theme.direction(with_swirl), theme.page), 4.5);
}

TEST(Look, ScaleOfSpinsEndsAtTheColoursOfTheDirections) {
    for (const Theme& theme : {light_theme(), dark_theme()}) {
        EXPECT_EQ(hex(theme.diverging(1.0)), hex(theme.with));
        EXPECT_EQ(hex(theme.diverging(0.0)), hex(theme.neutral));
        EXPECT_EQ(hex(theme.diverging(-1.0)), hex(theme.against));
    }
}

}  // namespace
}  // namespace swirl
