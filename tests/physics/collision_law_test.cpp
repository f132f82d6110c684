#include "swirl/physics/collision_law.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "random_cases.hpp"
#include "swirl/math/unit_circle.hpp"

namespace swirl {
namespace {

// A dozen roundings of numbers of order 10 (velocities up to 3, masses and inertias up to 5).
constexpr double rounding = 1e-12;

struct Collision {
    Body i, j;
    Vec2 separation;
    Surface surface;
};

Body draw_body() {
    const Vec2 velocity = draw_vector(2.0);
    const double spin = draw(-2.0, 2.0), radius = draw(0.3, 2.0);
    const double mass = draw(0.2, 5.0), inertia = draw(0.1, 10.0);
    return {velocity, spin, radius, 1.0 / mass, 1.0 / inertia};
}

/// Two discs that touch and approach.
Collision draw_collision() {
    const Body i = draw_body(), j = draw_body();
    const Vec2 separation = (i.radius + j.radius) * unit_circle(draw(0.0, 1.0));
    const double mu = draw(0.0, 1.5), e = draw(0.0, 1.0), beta = draw(0.0, 1.0);
    Collision c{i, j, separation, {.mu = mu, .restitution = e, .tangential_restitution = beta}};
    const double closing = -dot(separation, c.j.velocity - c.i.velocity);
    RC_PRE(std::abs(closing) > 1e-3);
    if (closing < 0.0) {
        c.i.velocity = -1.0 * c.i.velocity;
        c.j.velocity = -1.0 * c.j.velocity;
    }
    return c;
}

/// A disc that touches and approaches the wall of a moving container.
Collision draw_wall_collision() {
    Collision c = draw_collision();
    c.j = wall_body(c.j.velocity);
    c.separation = c.i.radius * 5.0 * c.separation;
    return c;
}

Impulse apply(Collision& c) { return collide(c.i, c.j, c.separation, c.surface); }

struct Axes {
    Vec2 normal, tangent;
};
Axes axes(const Collision& c) {
    const Vec2 n = (1.0 / std::hypot(c.separation.x, c.separation.y)) * c.separation;
    return {n, {n.y, -n.x}};
}

/// The velocity of j's surface relative to i's at the contact, computed from the points: +R_i n
/// from i and −R_j n from j, each with velocity v + ω ẑ × (its position).
Vec2 surface_velocity(const Collision& c) {
    const Vec2 n = axes(c).normal;
    const Vec2 of_i = c.i.velocity + c.i.spin * perpendicular(c.i.radius * n);
    const Vec2 of_j = c.j.velocity + c.j.spin * perpendicular(-c.j.radius * n);
    return of_j - of_i;
}
double slip(const Collision& c) { return dot(surface_velocity(c), axes(c).tangent); }
double closing_speed(const Collision& c) { return -dot(surface_velocity(c), axes(c).normal); }

Vec2 momentum(const Collision& c) {
    return (1.0 / c.i.inverse_mass) * c.i.velocity + (1.0 / c.j.inverse_mass) * c.j.velocity;
}
/// Orbital and spin angular momentum about a point from which i is at `at`.
double angular_momentum(const Collision& c, const Vec2& at) {
    return cross(at, c.i.velocity) / c.i.inverse_mass +
           cross(at + c.separation, c.j.velocity) / c.j.inverse_mass +
           c.i.spin / c.i.inverse_inertia + c.j.spin / c.j.inverse_inertia;
}
double energy_of(const Body& b, const Vec2& frame) {
    const Vec2 v = b.velocity - frame;
    return 0.5 * (dot(v, v) / b.inverse_mass + b.spin * b.spin / b.inverse_inertia);
}

void expect_equal_bits(double a, double b) { RC_ASSERT(std::memcmp(&a, &b, sizeof a) == 0); }

Body paper_body(Vec2 velocity) { return {velocity, 0.0, 1.0, 1.0, 0.1}; }

TEST(CollisionLaw, GoldenSlidingCollisionOfTwoDiscs) {
    Body i = paper_body({0, 1}), j = paper_body({0.5, -1});
    const Impulse J = collide(i, j, {0, 2}, {.mu = 0.1});
    EXPECT_NEAR(i.velocity.x, 0.2, 1e-15);
    EXPECT_NEAR(i.velocity.y, -1.0, 1e-15);
    EXPECT_NEAR(j.velocity.x, 0.3, 1e-15);
    EXPECT_NEAR(j.velocity.y, 1.0, 1e-15);
    EXPECT_NEAR(i.spin, -0.02, 1e-16);
    EXPECT_NEAR(j.spin, -0.02, 1e-16);
    EXPECT_FALSE(J.sticks);
}

TEST(CollisionLaw, GoldenStickingCollisionOfTwoDiscs) {
    Body i = paper_body({0, 1}), j = paper_body({0.5, -1});
    const double before = energy_of(i, {0, 0}) + energy_of(j, {0, 0});
    const Impulse J = collide(i, j, {0, 2}, {.mu = 1.0});
    // J_stick = 0.5 / (2 + 2/10) = 5/22.
    EXPECT_NEAR(i.velocity.x, 5.0 / 22.0, 1e-15);
    EXPECT_NEAR(i.velocity.y, -1.0, 1e-15);
    EXPECT_NEAR(j.velocity.x, 6.0 / 22.0, 1e-15);
    EXPECT_NEAR(j.velocity.y, 1.0, 1e-15);
    EXPECT_NEAR(i.spin, -1.0 / 44.0, 1e-16);
    EXPECT_NEAR(j.spin, -1.0 / 44.0, 1e-16);
    EXPECT_NEAR(before - energy_of(i, {0, 0}) - energy_of(j, {0, 0}), 0.25 / 4.4, 1e-15);
    EXPECT_TRUE(J.sticks);
}

TEST(CollisionLaw, GoldenCollisionWithTheWall) {
    Body disc = paper_body({1, 0.3}), wall = wall_body({0, 0});
    collide(disc, wall, {7.6, 0}, {.mu = 1.0});
    EXPECT_NEAR(disc.velocity.x, -1.0, 1e-15);
    EXPECT_NEAR(disc.velocity.y, 0.3 / 11.0, 1e-15);
    EXPECT_NEAR(disc.spin, -0.3 / 11.0, 1e-15);
    EXPECT_EQ(wall.velocity.x, 0.0);
    EXPECT_EQ(wall.velocity.y, 0.0);
    EXPECT_EQ(wall.spin, 0.0);
}

TEST(CollisionLaw, SpinningDiscRollsAlongTheWallLikeAWheel) {
    // With counter-clockwise spin at the right-hand side of the wall, the outer point moves up, so
    // friction pushes the disc down.
    Body disc = paper_body({1, 0}), wall = wall_body({0, 0});
    disc.spin = 1.0;
    collide(disc, wall, {7.6, 0}, {.mu = 1.0});
    EXPECT_LT(disc.velocity.y, 0.0);
    EXPECT_LT(disc.spin, 1.0);
}

TEST(CollisionLaw, ConservesSpinWithoutFriction) {
    Body i = paper_body({0, 1}), j = paper_body({0.5, -1});
    i.spin = 0.7;
    collide(i, j, {0, 2}, {.mu = 0.0});
    EXPECT_EQ(i.spin, 0.7);
    EXPECT_EQ(j.spin, 0.0);
    EXPECT_EQ(i.velocity.x, 0.0);
    EXPECT_EQ(j.velocity.x, 0.5);
}

RC_GTEST_PROP(CollisionLaw, ConservesMomentum, ()) {
    Collision c = draw_collision();
    const Vec2 before = momentum(c);
    apply(c);
    RC_ASSERT(std::abs(momentum(c).x - before.x) < rounding);
    RC_ASSERT(std::abs(momentum(c).y - before.y) < rounding);
}

RC_GTEST_PROP(CollisionLaw, ConservesAngularMomentumAboutEveryPoint, ()) {
    Collision c = draw_collision();
    const Vec2 at = draw_vector(10.0);
    const double before = angular_momentum(c, at);
    apply(c);
    RC_ASSERT(std::abs(angular_momentum(c, at) - before) < 100 * rounding);
}

RC_GTEST_PROP(CollisionLaw, DissipatesTheEnergyOfTheClosedForm, ()) {
    Collision c = draw_collision();
    const double u = closing_speed(c), s = slip(c);
    const double before = energy_of(c.i, {0, 0}) + energy_of(c.j, {0, 0});
    const Impulse J = apply(c);
    const double normal_mass = 1.0 / (c.i.inverse_mass + c.j.inverse_mass);
    const double tangential_mass =
        1.0 / (c.i.inverse_mass + c.j.inverse_mass + c.i.radius * c.i.radius * c.i.inverse_inertia +
               c.j.radius * c.j.radius * c.j.inverse_inertia);
    // The work of each impulse is J (speed before + speed after)/2.
    const double Jt = std::abs(J.tangential), e = c.surface.restitution;
    const double loss =
        0.5 * normal_mass * (1.0 - e * e) * u * u + Jt * (std::abs(s) - 0.5 * Jt / tangential_mass);
    const double after = energy_of(c.i, {0, 0}) + energy_of(c.j, {0, 0});
    RC_ASSERT(std::abs(before - after - loss) < 100 * rounding);
    RC_ASSERT(loss >= -100 * rounding);
}

RC_GTEST_PROP(CollisionLaw, EnergyNeverGrowsInTheFrameOfTheWall, ()) {
    Collision c = draw_wall_collision();
    const Vec2 frame = c.j.velocity;
    const double before = energy_of(c.i, frame);
    apply(c);
    RC_ASSERT(energy_of(c.i, frame) <= before + 100 * rounding);
    RC_ASSERT(c.j.velocity.x == frame.x && c.j.velocity.y == frame.y && c.j.spin == 0.0);
}

RC_GTEST_PROP(CollisionLaw, RestitutionReversesTheApproach, ()) {
    Collision c = *rc::gen::element(0, 1) ? draw_collision() : draw_wall_collision();
    const double before = closing_speed(c);
    apply(c);
    RC_ASSERT(std::abs(closing_speed(c) + c.surface.restitution * before) < rounding);
}

RC_GTEST_PROP(CollisionLaw, StickingContactReversesTheFractionBetaOfItsSlip, ()) {
    Collision c = *rc::gen::element(0, 1) ? draw_collision() : draw_wall_collision();
    c.surface.mu = 1e6;
    const double before = slip(c);
    const Impulse J = apply(c);
    RC_ASSERT(J.sticks);
    RC_ASSERT(std::abs(slip(c) + c.surface.tangential_restitution * before) < rounding);
}

RC_GTEST_PROP(CollisionLaw, StickingContactWithoutBetaStopsItsSlip, ()) {
    Collision c = *rc::gen::element(0, 1) ? draw_collision() : draw_wall_collision();
    c.surface = {.mu = 1e6};
    apply(c);
    RC_ASSERT(std::abs(slip(c)) < rounding);
}

RC_GTEST_PROP(CollisionLaw, FrictionObeysCoulombsLawAndOpposesTheSlip, ()) {
    Collision c = *rc::gen::element(0, 1) ? draw_collision() : draw_wall_collision();
    const double before = slip(c);
    const Impulse J = apply(c);
    RC_ASSERT(J.normal > 0.0);
    RC_ASSERT(std::abs(J.tangential) <= c.surface.mu * J.normal);
    // The impulse on j is along r, so it opposes the slip of j past i.
    RC_ASSERT(J.tangential * before <= 0.0);
    if (!J.sticks) {
        RC_ASSERT(std::abs(J.tangential) == c.surface.mu * J.normal);
        // A sliding contact does not reverse its slip by more than the fraction β.
        RC_ASSERT(slip(c) * before >= -c.surface.tangential_restitution * before * before - 1e-12);
    }
}

RC_GTEST_PROP(CollisionLaw, IsBitwiseSymmetric, ()) {
    Collision c = draw_collision();
    Collision swapped{c.j, c.i, -1.0 * c.separation, c.surface};
    const Impulse J = apply(c), K = apply(swapped);
    expect_equal_bits(J.normal, K.normal);
    expect_equal_bits(J.tangential, K.tangential);
    expect_equal_bits(c.i.velocity.x, swapped.j.velocity.x);
    expect_equal_bits(c.i.velocity.y, swapped.j.velocity.y);
    expect_equal_bits(c.j.velocity.x, swapped.i.velocity.x);
    expect_equal_bits(c.i.spin, swapped.j.spin);
    expect_equal_bits(c.j.spin, swapped.i.spin);
}

RC_GTEST_PROP(CollisionLaw, IsCovariantUnderBoosts, ()) {
    Collision c = draw_collision(), boosted = c;
    const Vec2 boost = draw_vector(3.0);
    boosted.i.velocity = boosted.i.velocity + boost;
    boosted.j.velocity = boosted.j.velocity + boost;
    apply(c);
    apply(boosted);
    RC_ASSERT(std::abs(boosted.i.velocity.x - boost.x - c.i.velocity.x) < rounding);
    RC_ASSERT(std::abs(boosted.j.velocity.y - boost.y - c.j.velocity.y) < rounding);
    RC_ASSERT(std::abs(boosted.i.spin - c.i.spin) < rounding);
}

RC_GTEST_PROP(CollisionLaw, IsCovariantUnderRotations, ()) {
    Collision c = draw_collision(), turned = c;
    const Vec2 u = unit_circle(draw(0.0, 1.0));
    const auto turn = [&](const Vec2& v) {
        return Vec2{u.x * v.x - u.y * v.y, u.y * v.x + u.x * v.y};
    };
    turned.i.velocity = turn(c.i.velocity);
    turned.j.velocity = turn(c.j.velocity);
    turned.separation = turn(c.separation);
    apply(c);
    apply(turned);
    RC_ASSERT(std::abs(turned.i.velocity.x - turn(c.i.velocity).x) < rounding);
    RC_ASSERT(std::abs(turned.j.velocity.y - turn(c.j.velocity).y) < rounding);
    RC_ASSERT(std::abs(turned.i.spin - c.i.spin) < rounding);
    RC_ASSERT(std::abs(turned.j.spin - c.j.spin) < rounding);
}

RC_GTEST_PROP(CollisionLaw, IsCovariantUnderReflections, ()) {
    Collision c = draw_collision();
    const auto mirror = [](const Vec2& v) { return Vec2{-v.x, v.y}; };
    Collision mirrored = c;
    mirrored.i.velocity = mirror(c.i.velocity);
    mirrored.j.velocity = mirror(c.j.velocity);
    mirrored.i.spin = -c.i.spin;
    mirrored.j.spin = -c.j.spin;
    mirrored.separation = mirror(c.separation);
    apply(c);
    apply(mirrored);
    RC_ASSERT(std::abs(mirrored.i.velocity.x + c.i.velocity.x) < rounding);
    RC_ASSERT(std::abs(mirrored.j.velocity.y - c.j.velocity.y) < rounding);
    RC_ASSERT(std::abs(mirrored.i.spin + c.i.spin) < rounding);
    RC_ASSERT(std::abs(mirrored.j.spin + c.j.spin) < rounding);
}

RC_GTEST_PROP(CollisionLaw, DependsOnTheDirectionOfTheSeparationOnly, ()) {
    Collision c = draw_collision(), farther = c;
    farther.separation = 3.7 * c.separation;
    apply(c);
    apply(farther);
    RC_ASSERT(std::abs(farther.i.velocity.x - c.i.velocity.x) < rounding);
    RC_ASSERT(std::abs(farther.j.spin - c.j.spin) < rounding);
}

RC_GTEST_PROP(CollisionLaw, WallIsTheLimitOfAHeavyDisc, ()) {
    Collision wall = draw_wall_collision(), heavy = wall;
    heavy.j.radius = 1.0;
    heavy.j.inverse_mass = heavy.j.inverse_inertia = 1e-14;
    apply(wall);
    apply(heavy);
    RC_ASSERT(std::abs(heavy.i.velocity.x - wall.i.velocity.x) < 1e-10);
    RC_ASSERT(std::abs(heavy.i.velocity.y - wall.i.velocity.y) < 1e-10);
    RC_ASSERT(std::abs(heavy.i.spin - wall.i.spin) < 1e-10);
}

TEST(TcModel, CollisionWithinTheContactDurationIsElastic) {
    Surface surface;
    surface.restitution = 0.5;
    surface.contact_duration = 0.1;
    EXPECT_TRUE(is_elastic_by_tc_model(surface, 0.0));
    EXPECT_TRUE(is_elastic_by_tc_model(surface, 0.099));
    EXPECT_FALSE(is_elastic_by_tc_model(surface, 0.1));
    EXPECT_FALSE(is_elastic_by_tc_model(surface, 3.0));
    EXPECT_EQ(at_contact(surface, 0.099).restitution, 1.0);
    EXPECT_EQ(at_contact(surface, 0.1).restitution, 0.5);
    // Nothing else changes.
    surface.mu = 0.3;
    surface.tangential_restitution = 0.2;
    const Surface elastic = at_contact(surface, 0.0);
    EXPECT_EQ(elastic.mu, 0.3);
    EXPECT_EQ(elastic.tangential_restitution, 0.2);
    EXPECT_EQ(elastic.contact_duration, 0.1);
}

TEST(TcModel, HasNoEffectWithoutDurationOrDissipation) {
    Surface surface;
    surface.restitution = 0.5;
    EXPECT_FALSE(is_elastic_by_tc_model(surface, 0.0));
    EXPECT_EQ(at_contact(surface, 0.0).restitution, 0.5);
    surface = {};
    surface.contact_duration = 0.1;
    EXPECT_FALSE(is_elastic_by_tc_model(surface, 0.0));
    EXPECT_EQ(at_contact(surface, 0.0).restitution, 1.0);
}

}  // namespace
}  // namespace swirl
