#include "swirl/physics/floor.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "random_cases.hpp"
#include "swirl/physics/collision_law.hpp"
#include "swirl/physics/container_path.hpp"

namespace swirl {
namespace {

// A dozen roundings of numbers of order 10.
constexpr double floor_rounding = 1e-13;

Disc sphere(const Vec2& velocity, const Vec2& rolling_spin = {0.0, 0.0}) {
    return {{0, 0}, velocity, 0, 0, 0, 1.0, 1.0, solid_sphere_inertia(1.0, 1.0), rolling_spin};
}
Disc rolling_sphere(const Vec2& velocity) {
    return sphere(velocity, spin_of_rolling(velocity, 1.0));
}
/// The sphere after sliding until it rolls.
Disc settled(const Disc& d, const Floor& floor, const Vec2& u = {0.0, 0.0}) {
    const FloorMotion motion = floor_motion(d, floor, u);
    return motion.begins_to_roll == never ? d : set_rolling(d, motion, floor, u);
}

Disc draw_sphere() {
    const Vec2 velocity = draw_vector(2.0), spin = draw_vector(3.0);
    const double m = draw(0.2, 5.0), r = draw(0.3, 2.0), I = draw(0.05, 1.0) * m * r * r;
    return {draw_vector(5.0), velocity, 0.0, draw(-2.0, 2.0), draw(0.0, 3.0), r, m, I, spin};
}

TEST(Floor, SlidingSphereRollsAtFiveSeventhsOfItsSpeed) {
    const double v = 1.4, deceleration = 0.3;
    const Disc start = sphere({v, 0.0});
    const Floor floor{.deceleration = deceleration};
    const FloorMotion motion = floor_motion(start, floor, {0.0, 0.0});
    EXPECT_NEAR(motion.begins_to_roll, 2.0 * v / (7.0 * deceleration), floor_rounding);
    const Disc rolls = set_rolling(start, motion, floor, {0.0, 0.0});
    EXPECT_NEAR(rolls.velocity.x, 5.0 / 7.0 * v, floor_rounding);
    EXPECT_NEAR(rolls.position.x, 12.0 * v * v / (49.0 * deceleration), floor_rounding);
    EXPECT_NEAR(rolls.rolling_spin.y, 5.0 / 7.0 * v, floor_rounding);
}

TEST(Floor, RollingSphereContinuesToRoll) {
    const Vec2 u{0.3, -0.7};
    const Disc rolls = settled(sphere({1.234567, 0.345678}, {0.9, 0.1}), {.deceleration = 1.92}, u);
    const FloorMotion motion = floor_motion(rolls, {.deceleration = 1.92}, u);
    EXPECT_EQ(motion.begins_to_roll, never);
    EXPECT_EQ(motion.acceleration.x, 0.0);
    EXPECT_EQ(motion.acceleration.y, 0.0);
}

TEST(Floor, RollingSphereGainsTwoSeventhsOfAVelocityJumpOfTheFloor) {
    const ContainerPath path = polygon_path(paper_amplitude, paper_period, paper_sides);
    Disc d = rolling_sphere({0.1, 0.2});
    d = settled(d, {.deceleration = 1.92}, path.segments[0].velocity);
    for (std::size_t k = 1; k < path.segments.size(); ++k) {
        const Vec2 jump = path.segments[k].velocity - path.segments[k - 1].velocity;
        const Disc before = d;
        d = settled(moved_to(d, {}, path.segments[k].begin), {.deceleration = 1.92},
                    path.segments[k].velocity);
        EXPECT_LT(d.time, path.segments[k].end);
        EXPECT_NEAR(d.velocity.x, before.velocity.x + 2.0 / 7.0 * jump.x, floor_rounding);
        EXPECT_NEAR(d.velocity.y, before.velocity.y + 2.0 / 7.0 * jump.y, floor_rounding);
    }
}

// The collision law combined with the floor.
TEST(Floor, RollingSphereGivesARestingOneFiveSeventhsOfItsSpeed) {
    const Floor floor{.deceleration = 0.7};
    const Disc moving = rolling_sphere({1.0, 0.0}), resting = sphere({0.0, 0.0});
    SphereBody i{{moving.velocity, 0.0, 1.0, 1.0, 1.0 / moving.inertia}, moving.rolling_spin};
    SphereBody j{{resting.velocity, 0.0, 1.0, 1.0, 1.0 / resting.inertia}, resting.rolling_spin};
    collide(i, j, {2.0, 0.0}, {.mu = 0.0});
    EXPECT_NEAR(settled(sphere(i.velocity, i.rolling_spin), floor).velocity.x, 2.0 / 7.0,
                floor_rounding);
    EXPECT_NEAR(settled(sphere(j.velocity, j.rolling_spin), floor).velocity.x, 5.0 / 7.0,
                floor_rounding);
}

TEST(Floor, RollingSpheresHeadOnReturnWithFiveEMinusTwoSevenths) {
    const Floor floor{.deceleration = 0.7};
    for (const double e : {1.0, 0.9, 0.4, 0.1, 0.0}) {
        const Disc right = rolling_sphere({1.0, 0.0}), left = rolling_sphere({-1.0, 0.0});
        SphereBody i{{right.velocity, 0.0, 1.0, 1.0, 1.0 / right.inertia}, right.rolling_spin};
        SphereBody j{{left.velocity, 0.0, 1.0, 1.0, 1.0 / left.inertia}, left.rolling_spin};
        collide(i, j, {2.0, 0.0}, {.mu = 0.0, .restitution = e});
        EXPECT_NEAR(settled(sphere(i.velocity, i.rolling_spin), floor).velocity.x,
                    -(5.0 * e - 2.0) / 7.0, floor_rounding);
        EXPECT_NEAR(settled(sphere(j.velocity, j.rolling_spin), floor).velocity.x,
                    (5.0 * e - 2.0) / 7.0, floor_rounding);
    }
}

RC_GTEST_PROP(Floor, FrictionOpposesTheSlipAndStopsIt, ()) {
    const Disc d = draw_sphere();
    const Vec2 u = draw_vector(1.0);
    const Floor floor{.deceleration = draw(0.01, 3.0)};
    const FloorMotion motion = floor_motion(d, floor, u);
    const Vec2 c = slip_on_floor(d, u);
    RC_PRE(dot(c, c) > 1e-6);
    const double wait = motion.begins_to_roll - d.time;
    for (const double part : {0.25, 0.5, 0.9}) {
        const Vec2 later = slip_on_floor(moved_to(d, motion, d.time + part * wait), u);
        RC_ASSERT(std::abs(later.x - (1.0 - part) * c.x) < 1e-11);
        RC_ASSERT(std::abs(later.y - (1.0 - part) * c.y) < 1e-11);
    }
    RC_ASSERT(std::abs(std::hypot(motion.acceleration.x, motion.acceleration.y) -
                       floor.deceleration) < 1e-12);
}

// A coin stops like a sliding block, after the time v/(μ_f g) and the distance v²/(2 μ_f g).
TEST(Floor, SlidingCoinStopsAndKeepsItsSpin) {
    const double v = 1.4, deceleration = 0.3;
    const Vec2 u{0.25, -0.5};
    Disc start = sphere({u.x + v, u.y});
    start.spin = 0.7;
    const Floor floor{.deceleration = deceleration, .bodies_lie_flat = true};
    const FloorMotion motion = floor_motion(start, floor, u);
    EXPECT_NEAR(motion.begins_to_roll, v / deceleration, floor_rounding);
    const Disc rests = set_rolling(start, motion, floor, u);
    EXPECT_EQ(rests.velocity.x, u.x);
    EXPECT_EQ(rests.velocity.y, u.y);
    EXPECT_EQ(rests.spin, 0.7);
    EXPECT_EQ(dot(rests.rolling_spin, rests.rolling_spin), 0.0);
    const double time = motion.begins_to_roll;
    EXPECT_NEAR(rests.position.x, u.x * time + v * v / (2.0 * deceleration), 20.0 * floor_rounding);
    EXPECT_NEAR(rests.position.y, u.y * time, 20.0 * floor_rounding);
    EXPECT_EQ(floor_motion(rests, floor, u).begins_to_roll, never);
}

/// Rolling resistance as strong as friction, so that both effects are visible.
Floor resisting_floor(double resistance) {
    return {.deceleration = 0.9, .rolling_resistance = resistance};
}

// a = μ_r g / (1 + I/(m R²)), 5/7 μ_r g for a solid sphere. It stops after the time w/a and the
// distance w²/2a.
TEST(Floor, RollingResistanceStopsASphere) {
    const double w = 0.8, a = 5.0 / 7.0 * 0.02;
    const Vec2 u{0.25, -0.5};
    const Floor floor = resisting_floor(0.02);
    Disc start = sphere({u.x + w, u.y}, spin_of_rolling({w, 0.0}, 1.0));
    start.spin = 0.7;
    const FloorMotion motion = floor_motion(start, floor, u);
    EXPECT_NEAR(motion.begins_to_roll, w / a, 1e3 * floor_rounding);  // 56
    const Disc rests = set_rolling(start, motion, floor, u);
    EXPECT_EQ(rests.velocity.x, u.x);
    EXPECT_EQ(rests.velocity.y, u.y);
    EXPECT_EQ(dot(rests.rolling_spin, rests.rolling_spin), 0.0);
    EXPECT_EQ(rests.spin, 0.7);
    EXPECT_NEAR(rests.position.x, u.x * (w / a) + w * w / (2.0 * a), 1e3 * floor_rounding);
    EXPECT_NEAR(rests.position.y, u.y * (w / a), 1e3 * floor_rounding);
    EXPECT_EQ(floor_motion(rests, floor, u).begins_to_roll, never);
}
// I = 2/3 m r²: 3/5 μ_r g.
TEST(Floor, RollingResistanceStopsAShellLater) {
    Disc start = rolling_sphere({0.8, 0.0});
    start.inertia = shell_inertia(1.0, 1.0);
    EXPECT_NEAR(floor_motion(start, resisting_floor(0.02), {0.0, 0.0}).begins_to_roll,
                0.8 / (3.0 / 5.0 * 0.02), 1e3 * floor_rounding);
}
// It does not act on a sliding sphere, which slows down as soon as it rolls.
TEST(Floor, RollingResistanceActsOnlyWhileASphereRolls) {
    const Vec2 u{0.1, 0.2};
    const Disc start = sphere({1.4, -0.3}, {0.2, 0.3});
    const Floor without{.deceleration = 0.9}, with = resisting_floor(0.05);
    const FloorMotion a = floor_motion(start, without, u), b = floor_motion(start, with, u);
    EXPECT_EQ(a.begins_to_roll, b.begins_to_roll);
    EXPECT_EQ(a.acceleration.x, b.acceleration.x);
    EXPECT_EQ(a.spin_rate.y, b.spin_rate.y);
    const Disc rolls = set_rolling(start, b, with, u);
    const FloorMotion slows = floor_motion(rolls, with, u);
    EXPECT_NEAR(std::hypot(slows.acceleration.x, slows.acceleration.y), 5.0 / 7.0 * 0.05,
                floor_rounding);
    EXPECT_LT(dot(slows.acceleration, rolls.velocity - u), 0.0);
}
// While it slows down it rolls exactly. Its energy in the frame of the floor decreases by the work
// of the torque, μ_r m g R times the angle.
RC_GTEST_PROP(Floor, RollingResistanceDissipatesTheWorkOfItsTorque, ()) {
    Disc d = draw_sphere();
    const Vec2 u = draw_vector(1.0);
    d.rolling_spin = spin_of_rolling(d.velocity - u, d.radius);
    const Floor floor = resisting_floor(draw(0.001, 0.9));
    const FloorMotion motion = floor_motion(d, floor, u);
    RC_PRE(motion.begins_to_roll != never);
    const double t = d.time + draw(0.0, 1.0) * (motion.begins_to_roll - d.time);
    const Disc later = moved_to(d, motion, t);
    const Vec2 rolls = spin_of_rolling(later.velocity - u, d.radius);
    RC_ASSERT(later.rolling_spin.x == rolls.x && later.rolling_spin.y == rolls.y);
    // The constant rate of the spin gives the same.
    const Vec2 spin = d.rolling_spin + (t - d.time) * motion.spin_rate;
    RC_ASSERT(std::hypot(spin.x - rolls.x, spin.y - rolls.y) < 1e-11);
    const auto energy = [&](Disc s) {
        s.velocity = s.velocity - u;
        return kinetic_energy(s);
    };
    const Vec2 way = later.position - d.position - (t - d.time) * u;
    const double loss = d.mass * floor.rolling_resistance * std::hypot(way.x, way.y);
    // With small resistance distances are up to 10⁴.
    RC_ASSERT(std::abs(energy(d) - energy(later) - loss) < 1e-11 * (1.0 + energy(d)));
}
TEST(Floor, RollingSphereWithoutResistanceIsNotAccelerated) {
    const FloorMotion motion =
        floor_motion(rolling_sphere({0.5, 0.1}), resisting_floor(0.0), {0, 0});
    EXPECT_EQ(motion.begins_to_roll, never);
    EXPECT_FALSE(motion.slows_down);
}

// The force acts at the contact point, so it conserves the angular momentum about lines on the
// floor through that point: m R v + I ω for both directions.
RC_GTEST_PROP(Floor, ConservesAngularMomentumAboutTheContactPoint, ()) {
    const Disc d = draw_sphere();
    const Vec2 u = draw_vector(1.0);
    const Floor floor{.deceleration = draw(0.01, 3.0)};
    const FloorMotion motion = floor_motion(d, floor, u);
    RC_PRE(motion.begins_to_roll != never);
    const Disc rolls = set_rolling(d, motion, floor, u);
    const auto about_floor = [](const Disc& s) {
        return Vec2{s.mass * s.radius * s.velocity.x + s.inertia * s.rolling_spin.y,
                    s.mass * s.radius * s.velocity.y - s.inertia * s.rolling_spin.x};
    };
    const Vec2 before = about_floor(d), after = about_floor(rolls);
    RC_ASSERT(std::abs(before.x - after.x) < 1e-11);
    RC_ASSERT(std::abs(before.y - after.y) < 1e-11);
    RC_ASSERT(rolls.spin == d.spin);
}

RC_GTEST_PROP(Floor, SlidingDissipatesTheWorkOfFriction, ()) {
    const Disc d = draw_sphere();
    const Vec2 u = draw_vector(1.0);
    const Floor floor{.deceleration = draw(0.01, 3.0)};
    const FloorMotion motion = floor_motion(d, floor, u);
    RC_PRE(motion.begins_to_roll != never);
    const auto energy = [&](Disc s) {
        s.velocity = s.velocity - u;
        return kinetic_energy(s);
    };
    const Vec2 c = slip_on_floor(d, u);
    const double way = 0.5 * std::hypot(c.x, c.y) * (motion.begins_to_roll - d.time);
    const double loss = d.mass * floor.deceleration * way;
    RC_ASSERT(std::abs(energy(d) - energy(set_rolling(d, motion, floor, u)) - loss) <
              1e-12 * (1.0 + energy(d)));
}

TEST(Floor, WithoutFloorSpheresMoveLikeDiscs) {
    const Disc d = sphere({0.3, 0.4}, {1.0, 2.0});
    const FloorMotion motion = floor_motion(d, {}, {1.0, 0.0});
    EXPECT_EQ(motion.begins_to_roll, never);
    EXPECT_EQ(motion.acceleration.x, 0.0);
    const Disc later = moved_to(d, motion, 0.7), disc = d.at(0.7);
    EXPECT_EQ(later.position.x, disc.position.x);
    EXPECT_EQ(later.position.y, disc.position.y);
    EXPECT_EQ(later.velocity.x, disc.velocity.x);
    EXPECT_EQ(later.rolling_spin.y, d.rolling_spin.y);
}

}  // namespace
}  // namespace swirl
