#include "swirl/physics/orientation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "swirl/physics/floor.hpp"

namespace swirl {
namespace {

double apart(const Quaternion& a, const Quaternion& b) {
    return std::hypot(std::hypot(a.w - b.w, a.x - b.x), std::hypot(a.y - b.y, a.z - b.z));
}

// Rolling along +x it turns about +y, so after a quarter turn the top is in front.
TEST(Orientation, TopOfARollingSphereMovesForwards) {
    const double speed = 0.7, quarter = 0.5 * pi / speed;
    const Vec2 spin = spin_of_rolling({speed, 0.0}, 1.0);
    const Direction top =
        turned(turned_for({}, quarter, spin, 0.0, {0.0, 0.0}), Direction{0.0, 0.0, 1.0});
    // unit_circle is exact to 2⁻⁵²; a few more roundings.
    EXPECT_NEAR(top.x, 1.0, 1e-15);
    EXPECT_NEAR(top.y, 0.0, 1e-15);
    EXPECT_NEAR(top.z, 0.0, 1e-15);
}

TEST(Orientation, RotationAboutTheVerticalIsTheAngleOfADisc) {
    const Direction d = turned(turned_for({}, 2.0, {0.0, 0.0}, 0.3, {0.0, 0.0}), {1.0, 0.0, 0.0});
    EXPECT_NEAR(d.x, std::cos(0.6), 1e-15);
    EXPECT_NEAR(d.y, std::sin(0.6), 1e-15);
}

// While it slides the axis moves. Compares with ten thousand small rotations, each about the axis
// at its middle.
TEST(Orientation, OfASlidingSphereIsThatOfManySmallRotations) {
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
        // Their error is the step squared, 10⁻⁹; that of the series 4·10⁻⁸ per step of 0.05.
        EXPECT_LT(apart(turned_for({}, h, spin, vertical, rate), q), 5e-8 * std::ceil(h / 0.05))
            << h;
    }
}

TEST(Orientation, StaysNormalised) {
    Quaternion q;
    for (int k = 0; k < 100'000; ++k) q = turned_for(q, 0.01, {1.0, 2.0}, -3.0, {0.5, 0.1});
    EXPECT_NEAR(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z, 1.0, 1e-15);
}

// The steps of a sphere that slides are for the change of its spin; here there is none.
TEST(Orientation, SphereThatRollsTurnsInOneStep) {
    const Quaternion from = unit({0.5, -0.3, 0.7, 0.1});
    const Quaternion found = turned_for(from, 2.0, {0.4, -0.6}, 0.3, {0.0, 0.0}),
                     once = unit(turn_by(0.8, -1.2, 0.6) * from);
    EXPECT_EQ(found.w, once.w);
    EXPECT_EQ(found.x, once.x);
    EXPECT_EQ(found.y, once.y);
    EXPECT_EQ(found.z, once.z);
}

}  // namespace
}  // namespace swirl
