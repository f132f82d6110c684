#include "swirl/math/elementary.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "swirl/math/median.hpp"
#include "swirl/math/normal_deviate.hpp"

namespace swirl {
namespace {

// The standard library's functions are accurate to one unit in the last place, 2⁻⁵².
TEST(Elementary, ExponentialAndLogarithmAreAccurate) {
    Random random(1);
    for (int k = 0; k < 20000; ++k) {
        const double x = 1400.0 * (random.uniform() - 0.5);
        EXPECT_NEAR(exponential(x) / std::exp(x), 1.0, 1e-15 + 2e-16 * std::fabs(x)) << x;
        const double y = std::exp(x);
        EXPECT_NEAR(logarithm(y), std::log(y), 1e-15 * (1.0 + std::fabs(x))) << y;
    }
    for (const double x : {-1e-9, 1e-9, 0.3, -0.3}) {
        EXPECT_NEAR(exponential(x), std::exp(x), 3e-16);
        EXPECT_NEAR(logarithm(1.0 + x), std::log(1.0 + x), 3e-16);
    }
    EXPECT_EQ(exponential(0.0), 1.0);
    EXPECT_EQ(logarithm(1.0), 0.0);
    EXPECT_NEAR(power(2.0, 0.5), std::sqrt(2.0), 1e-15);
}

// Evaluated by the compiler, without any library.
static_assert(exponential(1.0) > 2.7182818284590446 && exponential(1.0) < 2.7182818284590458);
static_assert(logarithm(2.0) > 0.69314718055994519 && logarithm(2.0) < 0.69314718055994545);

// For n = 10⁶ the standard errors are 1/√n of the mean, √2/√n of the variance, and √24/√n of the
// excess kurtosis. The tolerances are four of them.
TEST(NormalDeviate, HasTheMomentsAndTailsOfTheNormalDistribution) {
    Random random(7);
    constexpr int n = 1'000'000;
    double sum = 0.0, squares = 0.0, fourths = 0.0;
    int beyond_one = 0, beyond_three = 0;
    for (int k = 0; k < n; ++k) {
        const double z = normal_deviate(random);
        sum += z;
        squares += z * z;
        fourths += z * z * z * z;
        beyond_one += std::fabs(z) > 1.0;
        beyond_three += std::fabs(z) > 3.0;
    }
    const double error = 4.0 / std::sqrt(double(n));
    EXPECT_NEAR(sum / n, 0.0, error);
    EXPECT_NEAR(squares / n, 1.0, 1.42 * error);
    EXPECT_NEAR(fourths / n - 3.0, 0.0, 9.8 * error);  // error of the fourth moment, √96/√n
    const double one = std::erfc(1.0 / std::sqrt(2.0)), three = std::erfc(3.0 / std::sqrt(2.0));
    EXPECT_NEAR(double(beyond_one) / n, one, error * std::sqrt(one));
    EXPECT_NEAR(double(beyond_three) / n, three, error * std::sqrt(three));
}

TEST(NormalDeviate, HappensWithExpOfMinusP) {
    Random random(3);
    for (const double p : {0.0, 0.1, 0.5, 1.0}) {
        int count = 0;
        constexpr int n = 100'000;
        for (int k = 0; k < n; ++k) count += happens_with_exp(p, random);
        EXPECT_NEAR(double(count) / n, std::exp(-p), 2.0 / std::sqrt(double(n))) << p;
    }
}

TEST(Median, IsTheMiddleNumberOrTheLargerOfTwo) {
    EXPECT_EQ(median({3.0, 1.0, 2.0}), 2.0);
    EXPECT_EQ(median({4.0, 1.0, 3.0, 2.0}), 3.0);
    EXPECT_EQ(median({}), 0.0);
}

}  // namespace
}  // namespace swirl
