#include "swirl/math/unit_circle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "random_cases.hpp"

namespace swirl {
namespace {

constexpr double ulp_of_one = std::numeric_limits<double>::epsilon();  // 2⁻⁵²

TEST(UnitCircle, QuarterTurnsAreExact) {
    for (int turns = -3; turns <= 3; ++turns) {
        const double u = turns;
        EXPECT_EQ(unit_circle(u).x, 1.0);
        EXPECT_EQ(unit_circle(u).y, 0.0);
        EXPECT_EQ(unit_circle(u + 0.25).x, 0.0);
        EXPECT_EQ(unit_circle(u + 0.25).y, 1.0);
        EXPECT_EQ(unit_circle(u + 0.5).x, -1.0);
        EXPECT_EQ(unit_circle(u + 0.5).y, 0.0);
        EXPECT_EQ(unit_circle(u + 0.75).x, 0.0);
        EXPECT_EQ(unit_circle(u + 0.75).y, -1.0);
    }
}

RC_GTEST_PROP(UnitCircle, AgreesWithCosineAndSine, ()) {
    const double u = draw(-1.0, 1.0);
    const long double angle = 2.0L * 3.14159265358979323846264338327950288L * u;
    const Vec2 found = unit_circle(u);
    RC_ASSERT(std::abs(static_cast<double>(std::cos(angle) - found.x)) <= ulp_of_one);
    RC_ASSERT(std::abs(static_cast<double>(std::sin(angle) - found.y)) <= ulp_of_one);
}

RC_GTEST_PROP(QuickUnitCircle, AgreesWithCosineAndSine, ()) {
    const double u = draw(-1.0, 1.0);
    const long double angle = 2.0L * 3.14159265358979323846264338327950288L * u;
    const Vec2 found = quick_unit_circle(u);
    RC_ASSERT(std::abs(static_cast<double>(std::cos(angle) - found.x)) <= 2.0 * ulp_of_one);
    RC_ASSERT(std::abs(static_cast<double>(std::sin(angle) - found.y)) <= 2.0 * ulp_of_one);
}

// 1 − cos φ = 2 sin² φ/2, in which nothing cancels. In φ − sin φ the rounded quantities are φ², φ³
// and its product with the sum, by half a unit each, and the sum by about one. (The largest error
// in 3·10⁶ angles was 2.53 units.)
RC_GTEST_PROP(TurnBy, HasFullPrecisionForSmallAngles, ()) {
    const double phi = draw(-2.0, 2.0) * std::exp2(-draw(0.0, 100.0));
    const Turn turn = turn_by(phi);
    const long double half = std::sin(0.5L * phi);
    RC_ASSERT(std::abs(static_cast<double>(std::sin(static_cast<long double>(phi)) - turn.sine)) <=
              2.0 * ulp_of_one * std::abs(phi));
    RC_ASSERT(std::abs(static_cast<double>(2.0L * half * half - turn.versine)) <=
              2.0 * ulp_of_one * turn.versine);
    // φ − sin φ = φ³/6 − φ⁵/120 …
    const long double q = static_cast<long double>(phi) * phi;
    long double lag = 0.0L;
    for (int n = 33; n >= 3; n -= 2) lag = q / (n * (n - 1.0L)) * (1.0L - lag);
    lag *= phi;
    RC_ASSERT(std::abs(static_cast<double>(lag - turn.lag)) <=
              3.0 * ulp_of_one * std::abs(turn.lag));
}

RC_GTEST_PROP(TurnBy, AgreesWithUnitCircleForLargeAngles, ()) {
    const double phi = draw(-7.0, 7.0);
    const Turn turn = turn_by(phi);
    RC_ASSERT(std::abs(turn.sine - std::sin(phi)) <= 8.0 * ulp_of_one);
    RC_ASSERT(std::abs(turn.versine - (1.0 - std::cos(phi))) <= 8.0 * ulp_of_one);
}

RC_GTEST_PROP(UnitCircle, IsBitwiseSymmetric, ()) {
    const double u = *rc::gen::inRange(0, 1 << 20) * 0x1p-22;  // u + k/4 is exact
    const Vec2 a = unit_circle(u), back = unit_circle(-u), quarter = unit_circle(u + 0.25);
    RC_ASSERT(back.x == a.x && back.y == -a.y);
    RC_ASSERT(quarter.x == -a.y && quarter.y == a.x);
}

RC_GTEST_PROP(UnitCircle, IsInvertedByTurnsOf, ()) {
    const double u = *rc::gen::inRange(0, 1000000) * 1e-6, length = draw(0.001, 1000.0);
    // u < 1; each of the two has an error below 2⁻⁵², which is 2⁻⁵²/2π turns in the first.
    const double back = turns_of(length * unit_circle(u));
    const double error = std::abs(back - u);
    RC_ASSERT(std::min(error, 1.0 - error) <= 2.0 * ulp_of_one);
    RC_ASSERT(back >= 0.0 && back < 1.0);
}

TEST(TurnsOf, AxesAndDiagonalsAreExact) {
    EXPECT_EQ(turns_of({1, 0}), 0.0);
    EXPECT_EQ(turns_of({1, 1}), 0.125);
    EXPECT_EQ(turns_of({0, 2}), 0.25);
    EXPECT_EQ(turns_of({-3, 0}), 0.5);
    EXPECT_EQ(turns_of({0, -1}), 0.75);
    EXPECT_EQ(turns_of({1, -1}), 0.875);
}

TEST(TurnsOf, IsZeroForTheNullVectorAndNaNForNaN) {
    EXPECT_EQ(turns_of({0, 0}), 0.0);
    EXPECT_TRUE(std::isnan(turns_of({std::nan(""), 1.0})));
    EXPECT_TRUE(std::isnan(turns_of({1.0, std::nan("")})));
}

}  // namespace
}  // namespace swirl
