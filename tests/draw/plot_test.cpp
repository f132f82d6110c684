#include "swirl/draw/plot.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "pictures.hpp"

namespace swirl {
namespace {

TEST(Plot, StepsAreRoundAndNeverTooMany) {
    EXPECT_DOUBLE_EQ(round_step(10.0, 5), 2.0);
    EXPECT_DOUBLE_EQ(round_step(0.07, 4), 0.02);
    EXPECT_DOUBLE_EQ(round_step(3.0, 1), 5.0);
    EXPECT_DOUBLE_EQ(round_step(6.0, 1), 10.0);
    for (double span = 1e-6; span < 1e6; span *= 1.37)
        for (int count : {1, 2, 5, 9}) EXPECT_LE(span / round_step(span, count), count + 1e-6);
}

TEST(Plot, TheRangeHoldsZeroAndTheCurve) {
    Curve curve;
    curve.time = {0.0, 1.0, 2.0, 3.0};
    curve.smooth = {-50.0, -0.04, -0.05, std::nan("")};
    curve.raw = curve.smooth;
    PlotStyle style{.from = 0.5, .to = 3.0, .lowest = 0.0, .highest = 0.0, .type = 10.0};
    fit_range(style, std::vector<Curve>{curve});
    EXPECT_LT(style.lowest, -0.05);
    EXPECT_GT(style.lowest, -0.1);  // what lies before the start does not count
    EXPECT_GT(style.highest, 0.0);
}

TEST(Plot, TheCurveEndsAtThePresent) {
    Curve curve;
    for (int k = 0; k <= 100; ++k) {
        curve.time.push_back(0.1 * k);
        curve.smooth.push_back(0.5);
        curve.raw.push_back(0.5);
    }
    const Theme theme = dark_theme();
    curve.color = {1.0, 0.0, 0.0};
    const PlotStyle style{.from = 0.0, .to = 10.0, .lowest = 0.0, .highest = 1.0, .type = 12.0};
    const auto rightmost = [&](double now) {
        Canvas canvas(Size{600, 200});
        canvas.fill_page(theme.page);
        draw_plot_frame(canvas, {0, 0, 600, 200}, theme, style);
        draw_plot_curves(canvas, {0, 0, 600, 200}, theme, style, std::vector<Curve>{curve}, now);
        for (int x = 599; x >= 0; --x)
            for (int y = 0; y < 200; ++y)
                if (is(pixel(canvas, x, y), curve.color)) return x;
        return -1;
    };
    const int at_half = rightmost(5.0), at_end = rightmost(10.0);
    EXPECT_EQ(rightmost(-1.0), -1);
    // Left margin 3.6 and right margin 0.6 times the type of 12 pixels; the dot has 3 pixels.
    EXPECT_NEAR(at_end, 600 - 0.6 * 12, 4);
    EXPECT_NEAR(at_half, 3.6 * 12 + 0.5 * (600 - 4.2 * 12), 4);
}

}  // namespace
}  // namespace swirl
