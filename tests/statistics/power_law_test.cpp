#include "swirl/statistics/power_law.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace swirl {
namespace {

TEST(PowerLaw, RecoversExponentAndFactor) {
    std::vector<PowerLawPoint> points;
    for (const double x : {6.0, 12.0, 24.0, 60.0})
        points.push_back({x, 3.0 * std::pow(x, -0.7), 0.01 * std::pow(x, -0.2)});
    const PowerLaw law = fit_power_law(points);
    EXPECT_EQ(law.points, 4u);
    EXPECT_NEAR(law.exponent, -0.7, 1e-9);  // round-off
    EXPECT_NEAR(law.factor, 3.0, 1e-9);
    EXPECT_NEAR(law.chi_square, 0.0, 1e-9);
}

// Equal relative errors e at ln x = −1, 0, 1: the error of the slope is e/√2.
TEST(PowerLaw, ErrorOfThreePoints) {
    const double e = 0.02;
    std::vector<PowerLawPoint> points;
    for (const double lx : {-1.0, 0.0, 1.0})
        points.push_back({std::exp(lx), std::exp(2.0 * lx), e * std::exp(2.0 * lx)});
    EXPECT_NEAR(fit_power_law(points).error, e / std::sqrt(2.0), 1e-12);
}

TEST(PowerLaw, ScatterEnlargesTheError) {
    std::vector<PowerLawPoint> points{{1, 1, 0.01}, {2, 1.5, 0.01}, {4, 1, 0.01}, {8, 1.5, 0.01}};
    const PowerLaw law = fit_power_law(points);
    // Weighted residuals of 0.2/0.01: the errors alone would give an error below 0.01.
    EXPECT_GT(law.chi_square, 100.0);
    EXPECT_GT(law.error, 0.1);
}

TEST(PowerLaw, TwoPointsAreNoLaw) {
    const std::vector<PowerLawPoint> points{
        {1, 1, 0.1}, {2, 2, 0.1}, {3, -1, 0.1}, {4, 1, 0}, {5, not_available, 0.1}};
    const PowerLaw law = fit_power_law(points);
    EXPECT_EQ(law.points, 2u);
    EXPECT_TRUE(std::isnan(law.exponent));
    EXPECT_TRUE(std::isnan(law.error));
}

}  // namespace
}  // namespace swirl
