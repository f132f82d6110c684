#include "swirl/render/canvas.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "pixels.hpp"
#include "swirl/render/label.hpp"
#include "swirl/render/scene.hpp"

namespace swirl {
namespace {

/// Removes the number of the surface, which cairo counts per process and writes into SVG files.
std::string without_number(std::string text) {
    const std::size_t id = text.find("id=\"surface");
    if (id == text.npos) return text;
    const std::size_t digits = id + 11;
    return text.erase(digits, text.find('"', digits) - digits);
}

std::string drawn(ImageFormat format) {
    Snapshot s = container(0.2);
    add_disc(s, {1.0, 1.0}, 0.4);
    Canvas canvas(Size{320, 240}, format);
    canvas.fill_page(dark_theme().page);
    draw_scene(canvas, fitting_view({0, 0, 320, 240}, Frame::m, 8.6, 1.892), {}, {s});
    draw_label(canvas, "$ϖ$/$Ω$ = 1", {10, 20}, {.size = 12, .color = {1, 1, 1}});
    return canvas.finish();
}

TEST(CanvasFiles, EveryFormatIsReproducible) {
    const std::pair<ImageFormat, std::string> formats[] = {
        {ImageFormat::png, "\x89PNG"}, {ImageFormat::svg, "<?xml"}, {ImageFormat::pdf, "%PDF"}};
    for (const auto& [format, signature] : formats) {
        const std::string one = drawn(format);
        EXPECT_EQ(one.substr(0, signature.size()), signature);
        EXPECT_TRUE(without_number(one) == without_number(drawn(format))) << signature;
        EXPECT_GT(one.size(), 1000u);
    }
}

TEST(Label, WidthIgnoresMarkup) {
    const Canvas canvas(Size{100, 100});
    const LabelStyle style{.size = 20.0, .color = {1, 1, 1}};
    EXPECT_EQ(label_width(canvas, "", style), 0.0);
    EXPECT_EQ(label_width(canvas, "$$", style), 0.0);
    EXPECT_GT(label_width(canvas, "mm", style), label_width(canvas, "m", style));
    EXPECT_LT(label_width(canvas, "$μ_{d}$", style), label_width(canvas, "$μ$$d$", style));
    EXPECT_NEAR(label_width(canvas, "abc", {.size = 40.0, .color = {1, 1, 1}}),
                2.0 * label_width(canvas, "abc", style), 1e-9 * 100.0);
}

TEST(Label, EvenDigitsHaveOneWidth) {
    const Canvas canvas(Size{100, 100});
    const LabelStyle style{.size = 20.0, .color = {1, 1, 1}, .even_digits = true};
    EXPECT_DOUBLE_EQ(label_width(canvas, "period 11.11", style),
                     label_width(canvas, "period 28.70", style));
}

TEST(Label, EscapedTextIsLiteral) {
    Canvas plain(Size{200, 40}), dollars(Size{200, 40});
    const LabelStyle style{.size = 20.0, .color = {1, 1, 1}};
    EXPECT_GT(label_width(plain, escaped("a$b$c\\d"), style), label_width(plain, "abcd", style));
    EXPECT_EQ(escaped("48 discs"), "48 discs");
}

TEST(Label, FittingSizeIsNotTooWide) {
    const Canvas canvas(Size{100, 100});
    LabelStyle style{.size = 40.0, .color = {1, 1, 1}};
    style.size = fitting_size(canvas, "a long headline", style, 100.0);
    EXPECT_LE(label_width(canvas, "a long headline", style), 100.0 * (1 + 1e-9));
    EXPECT_GT(style.size, 5.0);
}

}  // namespace
}  // namespace swirl
