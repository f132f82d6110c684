// The statistics of the chapters about mechanism and material, and the plans of their figures.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "swirl/paper/chapters.hpp"
#include "swirl/paper/coarse_zero.hpp"
#include "swirl/paper/rank_correlation.hpp"

namespace swirl {
namespace {

TEST(CoarseZero, IsThatOfTheParabolaThroughThreePoints) {
    const CoarseZero zero = last_zero({{20, 0.5, 0.01}, {30, 0.3, 0.03}, {40, -0.1, 0.01}});
    EXPECT_TRUE(zero.falls);
    // At 30 + u the parabola is 0.3 − 0.03 u − 0.001 u². The straight line has its zero at 37.5;
    // the distance is the error of the interpolation. The errors of the points have the weights ¼
    // and ¾ and are divided by the slope of 0.04.
    const double u = (std::sqrt(0.0009 + 0.0012) - 0.03) / 0.002;
    EXPECT_NEAR(zero.discs, 30.0 + u, 1e-9);
    EXPECT_NEAR(zero.error, std::hypot(std::hypot(0.25 * 0.03, 0.75 * 0.01) / 0.04, u - 7.5), 1e-9);
    EXPECT_FALSE(last_zero({{20, -0.5, 0.01}, {30, 0.3, 0.03}}).falls);
    EXPECT_FALSE(last_zero({{20, 0.5, 0.01}, {30, -0.1, 0.1}}).exists());
    EXPECT_FALSE(last_zero({}).exists());
    // The last of two changes. By symmetry the parabola 1 − (x − 20)²/50 has it at 20 + √50.
    EXPECT_NEAR(last_zero({{10, -1, 0.1}, {20, 1, 0.1}, {30, -1, 0.1}}).discs,
                20.0 + std::sqrt(50.0), 1e-9);
}

TEST(CoarseZero, TwoPointsHaveTheErrorOfAUniformDistribution) {
    const CurveZero zero = zero_of_curve({{20, 0.3, 0.0}, {32, -0.1, 0.0}}, 0);
    EXPECT_NEAR(zero.discs, 29.0, 1e-12);
    EXPECT_NEAR(zero.error(), 12.0 / std::sqrt(12.0), 1e-12);
}

// A parabola has no error of interpolation. The zero of a cubic is within the error.
TEST(CoarseZero, OfASmoothCurveLiesWithinTheErrorOfTheInterpolation) {
    constexpr double at[] = {28, 32, 36, 44, 48};
    for (const double truth : {33.0, 37.0, 43.9})
        for (const double cubic : {0.0, 1e-5, -3e-5}) {
            const auto value = [&](double x) {
                const double d = x - truth;
                return -0.01 * d - 1e-4 * d * d + cubic * d * d * d;
            };
            std::vector<RotationPoint> curve;
            for (const double x : at) curve.push_back({x, value(x), 1e-9});
            const std::size_t k = truth < 36.0 ? 1 : 2;
            const CurveZero zero = zero_of_curve(curve, k);
            EXPECT_LE(std::fabs(zero.discs - truth), zero.interpolation + 1e-9) << truth;
            if (cubic == 0.0) {
                EXPECT_NEAR(zero.interpolation, 0.0, 1e-9);
            }
        }
}

TEST(RankCorrelation, HasTheClosedFormsOfSmallSamples) {
    const Values x{1, 2, 3, 4, 5};
    EXPECT_NEAR(rank_correlation_of(x, {1, 4, 9, 16, 25}), 1.0, 1e-15);
    EXPECT_NEAR(rank_correlation_of(x, {5, 3, 2, 1, -9}), -1.0, 1e-15);
    // Without equal values: 1 − 6 Σ d²/(n (n² − 1)), here Σ d² = 1 + 1 + 0 + 1 + 1.
    EXPECT_NEAR(rank_correlation_of(x, {20, 10, 30, 50, 40}), 1.0 - 6.0 * 4.0 / 120.0, 1e-15);
    EXPECT_EQ(ranks_of({3.0, 1.0, 3.0}), (Values{2.5, 1.0, 2.5}));
    EXPECT_TRUE(std::isnan(rank_correlation_of(x, {1, 1, 1, 1, 1})));
}

TEST(RankCorrelation, TheJackknifeGivesTheStandardErrorOfAMean) {
    const Values values{1.0, 4.0, 2.0, 7.0, 3.0, 1.0};
    const Estimate found = jackknife(values.size(), [&](const std::vector<std::size_t>& points) {
        double sum = 0.0;
        for (const double value : chosen(values, points)) sum += value;
        return sum / static_cast<double>(points.size());
    });
    double square = 0.0;
    for (const double value : values) square += (value - 3.0) * (value - 3.0);
    EXPECT_NEAR(found.mean, 3.0, 1e-14);
    EXPECT_NEAR(found.error, std::sqrt(square / 30.0), 1e-14);
    EXPECT_TRUE(std::isnan(jackknife(3, [](const auto&) { return 1.0; }).mean));
}

TEST(ChapterMechanism, FullFiguresHaveEightSeedsAndEachRunItsOwnConfiguration) {
    std::set<std::string> keys, configurations;
    for (const auto& chapter : {chapter_mechanism(), chapter_material()})
        for (const PaperFigure& figure : chapter) {
            const FigurePlan plan = figure.plan(PaperSettings{});
            for (const PaperPoint& point : plan.points) {
                EXPECT_EQ(point.runs.size(), 8u) << point.name;
                for (const PaperTask& task : point.runs) {
                    EXPECT_TRUE(keys.insert(task.key).second) << task.key;
                    EXPECT_NE(task.description, "");
                    configurations.insert(std::string(figure.name) + task.description);
                }
            }
        }
    EXPECT_EQ(configurations.size(), keys.size());
}

}  // namespace
}  // namespace swirl
