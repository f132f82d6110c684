#include "swirl/render/plot.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "pixels.hpp"

namespace swirl {
namespace {

TEST(Plot, StepsAreRoundAndLimitedInNumber) {
    EXPECT_DOUBLE_EQ(round_step(10.0, 5), 2.0);
    EXPECT_DOUBLE_EQ(round_step(0.07, 4), 0.02);
    EXPECT_DOUBLE_EQ(round_step(3.0, 1), 5.0);
    EXPECT_DOUBLE_EQ(round_step(6.0, 1), 10.0);
    for (double span = 1e-6; span < 1e6; span *= 1.37)
        for (int count : {1, 2, 5, 9}) EXPECT_LE(span / round_step(span, count), count + 1e-6);
}

TEST(Plot, RangeContainsZeroAndTheCurve) {
    Curve curve;
    curve.time = {0.0, 1.0, 2.0, 3.0};
    curve.smooth = {-50.0, -0.04, -0.05, std::nan("")};
    curve.raw = curve.smooth;
    PlotStyle style{.from = 0.5, .to = 3.0, .lowest = 0.0, .highest = 0.0, .em = 10.0};
    fit_range(style, std::vector<Curve>{curve});
    EXPECT_LT(style.lowest, -0.05);
    EXPECT_GT(style.lowest, -0.1);  // values before the start are ignored
    EXPECT_GT(style.highest, 0.0);
}

TEST(Plot, RangeContainsTheRawCurveWithoutRareSpikes) {
    Curve curve;
    for (int k = 0; k < 200; ++k) {
        curve.time.push_back(0.01 * k);
        curve.smooth.push_back(0.05);
        curve.raw.push_back(k % 2 ? 0.3 : -0.2);
    }
    curve.raw[50] = 5.0;
    curve.raw[60] = -5.0;
    curve.raw[70] = std::nan("");
    PlotStyle style{.from = 0.0, .to = 2.0, .lowest = 0.0, .highest = 0.0, .em = 10.0};
    fit_range(style, std::vector<Curve>{curve});
    EXPECT_LT(style.lowest, -0.2);
    EXPECT_GT(style.highest, 0.3);
    // Spikes that would flatten the smooth curve are cut.
    EXPECT_GT(style.lowest, -0.3);
    EXPECT_LT(style.highest, 0.4);
}

TEST(Plot, CurvesDoNotReachTheNameOfTheQuantity) {
    // A curve that fills the whole range, drawn with and without the name.
    Curve curve;
    for (int k = 0; k < 400; ++k) {
        curve.time.push_back(0.01 * k);
        curve.smooth.push_back(0.5);
        curve.raw.push_back(k % 2 ? 1.0 : 0.0);
    }
    const Theme theme = dark_theme();
    curve.color = {1.0, 0.0, 0.0};
    const auto ink = [&](const std::string& name) {
        PlotStyle style{.from = 0.0, .to = 4.0, .lowest = 0.0, .highest = 1.0, .em = 20.0};
        style.vertical_label = name;
        Canvas canvas(Size{600, 300});
        canvas.fill_page(theme.page);
        draw_plot_frame(canvas, {0, 0, 600, 300}, theme, style);
        draw_plot_curves(canvas, {0, 0, 600, 300}, theme, style, std::vector<Curve>{curve}, 4.0);
        int count = 0;
        for (int y = 0; y < 300; ++y)
            for (int x = 0; x < 600; ++x) {
                const Pixel p = pixel(canvas, x, y);
                count += p.red > p.green + 30 ? 1 : 0;
            }
        return count;
    };
    const int without = ink("");
    EXPECT_GT(without, 1000);
    EXPECT_EQ(ink("$ϖ$/$Ω$"), without);
}

TEST(Plot, CurveEndsAtThePresent) {
    Curve curve;
    for (int k = 0; k <= 100; ++k) {
        curve.time.push_back(0.1 * k);
        curve.smooth.push_back(0.5);
        curve.raw.push_back(0.5);
    }
    const Theme theme = dark_theme();
    curve.color = {1.0, 0.0, 0.0};
    const PlotStyle style{.from = 0.0, .to = 10.0, .lowest = 0.0, .highest = 1.0, .em = 12.0};
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
    // The left margin is 3.6 and the right margin 0.6 times the font size of 12 pixels. The
    // tolerance is the radius of the dot, 3 pixels, and one pixel of rounding.
    EXPECT_NEAR(at_end, 600 - 0.6 * 12, 4);
    EXPECT_NEAR(at_half, 3.6 * 12 + 0.5 * (600 - 4.2 * 12), 4);
}

struct Rows {
    int first = 1000, last = -1;
};

TEST(Plot, NamesOfCurvesDoNotOverlap) {
    const Theme theme = dark_theme();
    for (const double height : {0.05, 0.5, 0.97})
        for (const double now : {0.0, 3.0, 10.0}) {
            std::vector<Curve> curves(2);
            curves[0].color = {1.0, 0.0, 0.0};
            curves[1].color = {0.0, 1.0, 0.0};
            for (Curve& curve : curves) {
                curve.time = {0.0, now};
                curve.raw = curve.smooth = {height, height};
                curve.label = "XXXX";
            }
            const PlotStyle style{
                .from = 0.0, .to = 10.0, .lowest = 0.0, .highest = 1.0, .em = 12.0};
            Canvas canvas(Size{600, 200});
            canvas.fill_page(theme.page);
            draw_plot_curves(canvas, {0, 0, 600, 200}, theme, style, curves, now);
            // The names are to the right of the dot.
            const double inner = 3.6 * 12, width = 600 - 4.2 * 12;
            const int dot = int(inner + width * now / 10.0);
            Rows rows[2];
            for (int k = 0; k < 2; ++k)
                for (int y = 0; y < 200; ++y) {
                    int found = 0;
                    for (int x = dot + 5; x < std::min(600, dot + 60); ++x) {
                        const Pixel p = pixel(canvas, x, y);
                        const int own = k == 0 ? p.red : p.green, other = k == 0 ? p.green : p.red;
                        found += own > 110 && 2 * other < own ? 1 : 0;
                    }
                    if (found == 0) continue;
                    rows[k].first = std::min(rows[k].first, y);
                    rows[k].last = std::max(rows[k].last, y);
                }
            if (now == 10.0) continue;  // the names are on the left, on top of the lines
            ASSERT_GE(rows[0].last, 0);
            ASSERT_GE(rows[1].last, 0);
            EXPECT_TRUE(rows[0].last < rows[1].first || rows[1].last < rows[0].first)
                << height << " at " << now;
            // They do not reach the name of the quantity above the plot.
            EXPECT_GT(std::min(rows[0].first, rows[1].first), 1.4 * 12);
        }
}

// Numbers such as 20.0000001 and 20.0000002 must neither look equal nor leave the page.
TEST(Plot, NumbersOfATinyTimeAxisStayOnThePageAndDiffer) {
    const Theme theme = dark_theme();
    for (const double span : {5e-10, 5e-7, 3e-4, 0.02, 5.0}) {
        const PlotStyle style{
            .from = 20.0, .to = 20.0 + span, .lowest = -1.0, .highest = 1.0, .em = 12.0};
        Canvas canvas(Size{700, 200});
        canvas.fill_page(theme.page);
        // Drawn in the middle of a larger page, to detect what would be cut off.
        draw_plot_frame(canvas, {100, 0, 500, 200}, theme, style);
        for (int y = 0; y < 200; ++y)
            for (const int x : {99, 601}) {
                EXPECT_TRUE(is(pixel(canvas, x, y), theme.page)) << span << ": " << x << ", " << y;
            }
        // The first and the last number below the plot must look different.
        const auto ink = [&](int from, int to) {
            double sum = 0.0;
            for (int x = from; x < to; ++x)
                for (int y = 172; y < 187; ++y) sum += pixel(canvas, x, y).green;
            return sum;
        };
        EXPECT_NE(ink(120, 170), ink(560, 601)) << span;
    }
}

}  // namespace
}  // namespace swirl
