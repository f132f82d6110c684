#include "swirl/physics/orientation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "swirl/physics/floor.hpp"

namespace swirl {
namespace {

double apart(const Quaternion& a, const Quaternion& b) {
    return std::hypot(std::hypot(a.w - b.w, a.x - b.x), std::hypot(a.y - b.y, a.z - b.z));
}

// Rolling along +x it turns about +y: what was on top goes forwards, and after a quarter turn lies
// in front.
TEST(Orientation, ARollingSpheresTopGoesForwards) {
    const double speed = 0.7, quarter = 0.5 * pi / speed;
    const Vec2 spin = spin_of_rolling({speed, 0.0}, 1.0);
    const Direction top =
        turned(turned_for({}, quarter, spin, 0.0, {0.0, 0.0}), Direction{0.0, 0.0, 1.0});
    // unit_circle within 2⁻⁵², a few roundings besides.
    EXPECT_NEAR(top.x, 1.0, 1e-15);
    EXPECT_NEAR(top.y, 0.0, 1e-15);
    EXPECT_NEAR(top.z, 0.0, 1e-15);
}

TEST(Orientation, AboutTheVerticalItIsTheAngleOfADisc) {
    const Direction d = turned(turned_for({}, 2.0, {0.0, 0.0}, 0.3, {0.0, 0.0}), {1.0, 0.0, 0.0});
    EXPECT_NEAR(d.x, std::cos(0.6), 1e-15);
    EXPECT_NEAR(d.y, std::sin(0.6), 1e-15);
}

// While it slides the axis moves: against ten thousand small turns about the axis of the middle.
TEST(Orientation, WhileItSlidesTheTurnIsThatOfManySmallOnes) {
    const Vec2 spin{0.9, -1.3}, rate{4.0, 2.5};
    const double vertical = 1.7;
    for (const double h : {0.02, 0.075, 0.3}) {
        constexpr int parts = 10'000;
        Quaternion q;
        for (int k = 0; k < parts; ++k) {
            const double t = (k + 0.5) * h / parts, step = h / parts;
            q = turn_by(step * (spin.x + t * rate.x), step * (spin.y + t * rate.y),
                        step * vertical) *
                q;
        }
        // Those are off by their step squared, 10⁻⁹; the series by 4·10⁻⁸ for each step of 0.05.
        EXPECT_LT(apart(turned_for({}, h, spin, vertical, rate), q), 5e-8 * std::ceil(h / 0.05))
            << h;
    }
}

TEST(Orientation, StaysOfLengthOne) {
    Quaternion q;
    for (int k = 0; k < 100'000; ++k) q = turned_for(q, 0.01, {1.0, 2.0}, -3.0, {0.5, 0.1});
    EXPECT_NEAR(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z, 1.0, 1e-15);
}

}  // namespace
}  // namespace swirl
