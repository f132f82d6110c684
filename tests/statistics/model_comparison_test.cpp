#include "swirl/statistics/model_comparison.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "math/deviate.hpp"
#include "swirl/math/random.hpp"

namespace swirl {
namespace {

/// ϖ = 0.3 − p N/40: straight in N and in p, as between the points of curves.
double model(double parameter, double discs) { return 0.3 - parameter * discs / 40.0; }

ModelCurve curve_of(double parameter, double error = 0.0) {
    ModelCurve curve{parameter, {}};
    for (double n = 8.0; n <= 48.0; n += 8.0)
        curve.points.push_back({n, model(parameter, n), error});
    return curve;
}

TEST(ModelComparison, TheModelIsTheLineBetweenItsPoints) {
    const ModelCurve curve{0.0, {{10.0, 1.0, 0.3}, {20.0, 3.0, 0.4}}};
    EXPECT_EQ(model_at(curve, 10.0)->mean, 1.0);
    EXPECT_DOUBLE_EQ(model_at(curve, 15.0)->mean, 2.0);
    EXPECT_DOUBLE_EQ(model_at(curve, 15.0)->error, 0.25);  // √(0.15² + 0.2²)
    EXPECT_FALSE(model_at(curve, 9.0));
    EXPECT_FALSE(model_at(curve, 21.0));
    EXPECT_DOUBLE_EQ(chi_square_of(curve, std::vector<RotationPoint>{{10.0, 2.0, 0.4}}), 4.0);
}

TEST(ModelComparison, PointsOfTheModelGiveItsParameter) {
    const std::vector<ModelCurve> curves{curve_of(0.2), curve_of(0.4), curve_of(0.8)};
    for (const double truth : {0.25, 0.4, 0.61}) {
        std::vector<RotationPoint> points;
        for (const double n : {9.0, 20.0, 31.0, 48.0}) points.push_back({n, model(truth, n), 0.01});
        points.push_back({60.0, 5.0, 0.01});  // lies outside the curves
        const auto best = best_parameter(curves, points);
        ASSERT_TRUE(best);
        EXPECT_NEAR(best->value, truth, 4e-4);  // the step of the search
        EXPECT_NEAR(best->chi_square, 0.0, 1e-2);
        EXPECT_EQ(best->freedom, 3u);
        // d²χ²/dp² = 2 Σ (N/40)²/e².
        const double curvature = (81.0 + 400.0 + 961.0 + 2304.0) / 1600.0 / 1e-4;
        EXPECT_NEAR(best->error(), 1.0 / std::sqrt(curvature), 6e-4);
        EXPECT_FALSE(best->open_below || best->open_above);
    }
    EXPECT_FALSE(best_parameter(curves, std::vector<RotationPoint>{{9.0, 0.1, 0.1}}));
}

TEST(ModelComparison, AParameterOutsideTheCurvesLeavesTheIntervalOpen) {
    const std::vector<ModelCurve> curves{curve_of(0.2), curve_of(0.4)};
    const std::vector<RotationPoint> points{{16.0, model(0.6, 16.0), 0.01},
                                            {32.0, model(0.6, 32.0), 0.01}};
    const auto best = best_parameter(curves, points);
    ASSERT_TRUE(best);
    EXPECT_EQ(best->value, 0.4);
    EXPECT_TRUE(best->open_above);
    EXPECT_GT(best->chi_square, 10.0);
}

// With normal errors the interval contains the true value in 68 of 100 cases; the tolerance is
// three standard deviations of 500 cases. Scaled errors make it a little wider.
TEST(ModelComparison, TheIntervalIsOneStandardError) {
    Random random(5);
    const std::vector<ModelCurve> curves{curve_of(0.2), curve_of(0.4), curve_of(0.6)};
    int inside = 0;
    constexpr int cases = 500;
    for (int k = 0; k < cases; ++k) {
        std::vector<RotationPoint> points;
        for (const double n : {8.0, 16.0, 24.0, 32.0, 40.0, 48.0})
            points.push_back({n, model(0.4, n) + 0.02 * deviate(random), 0.02});
        const auto best = best_parameter(curves, points);
        inside += best->lower <= 0.4 && best->upper >= 0.4;
    }
    EXPECT_NEAR(inside / double(cases), 0.72, 0.08);
}

}  // namespace
}  // namespace swirl
