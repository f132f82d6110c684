#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "random_cases.hpp"
#include "swirl/math/unit_circle.hpp"
#include "swirl/physics/collision_law.hpp"

namespace swirl {
namespace {

// A dozen roundings of numbers of order 10 (velocities up to 3, masses up to 5).
constexpr double sphere_rounding = 1e-12;

struct Vec3 {
    double x, y, z;
};
Vec3 cross3(const Vec3& a, const Vec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Vec3 spin_of(const SphereBody& b) { return {b.rolling_spin.x, b.rolling_spin.y, b.spin}; }

struct SpherePair {
    SphereBody i, j;
    Vec2 separation;
    Surface surface;
    Vec2 normal() const {
        const double d = std::hypot(separation.x, separation.y);
        return {separation.x / d, separation.y / d};
    }
    /// Velocity of the contact point of j relative to that of i, in three dimensions, from the spin
    /// vectors.
    Vec3 slip() const {
        const Vec2 n = normal();
        const Vec3 of_i = cross3(spin_of(i), {i.radius * n.x, i.radius * n.y, 0.0});
        const Vec3 of_j = cross3(spin_of(j), {-j.radius * n.x, -j.radius * n.y, 0.0});
        const Vec3 v{j.velocity.x - i.velocity.x + of_j.x - of_i.x,
                     j.velocity.y - i.velocity.y + of_j.y - of_i.y, of_j.z - of_i.z};
        const double along = v.x * n.x + v.y * n.y;
        return {v.x - along * n.x, v.y - along * n.y, v.z};
    }
    double energy() const {
        const Vec2 frame = j.inverse_mass == 0.0 ? j.velocity : Vec2{0.0, 0.0};
        double sum = 0.0;
        for (const SphereBody* b : {&i, &j}) {
            if (b->inverse_mass == 0.0) continue;
            const Vec2 v = b->velocity - frame;
            const Vec3 w = spin_of(*b);
            sum += 0.5 * dot(v, v) / b->inverse_mass +
                   0.5 * (w.x * w.x + w.y * w.y + w.z * w.z) / b->inverse_inertia;
        }
        return sum;
    }
};

/// The contribution of the lifted sphere to the vertical slip, and its vertical energy. The planar
/// state after the collision does not contain them.
struct Lifted {
    double inverse_mass, slip, energy;
    Lifted(const SpherePair& c, const Impulse& J)
        : inverse_mass(J.vertical > 0.0 ? c.j.inverse_mass : c.i.inverse_mass),
          slip(J.vertical * inverse_mass),
          energy(0.5 * J.vertical * J.vertical * inverse_mass) {}
};

/// The slip along r = (n_y, −n_x) and z, with the effective masses of the two.
struct Slip {
    double t, z, m_t, m_z;
    explicit Slip(const SpherePair& c) {
        const Vec2 n = c.normal();
        const Vec3 s = c.slip();
        t = s.x * n.y - s.y * n.x;
        z = s.z;
        const double lever = c.i.radius * c.i.radius * c.i.inverse_inertia +
                             c.j.radius * c.j.radius * c.j.inverse_inertia;
        m_t = 1.0 / (c.i.inverse_mass + c.j.inverse_mass + lever);
        m_z = 1.0 / ((z > 0.0 ? c.i.inverse_mass : c.j.inverse_mass) + lever);
    }
    double sticking() const { return std::hypot(m_t * t, m_z * z); }
    double energy(const Impulse& J) const {
        return t * J.tangential + J.tangential * J.tangential / (2.0 * m_t) + z * J.vertical +
               J.vertical * J.vertical / (2.0 * m_z);
    }
};

SphereBody draw_sphere_body() {
    const Vec2 velocity = draw_vector(2.0);
    const double spin = draw(-2.0, 2.0), radius = draw(0.3, 2.0);
    const double mass = draw(0.2, 5.0), inertia = draw(0.05, 1.0) * mass * radius * radius;
    return {{velocity, spin, radius, 1.0 / mass, 1.0 / inertia}, draw_vector(2.0)};
}
/// Two spheres, or one and the wall, that touch and approach.
SpherePair draw_sphere_collision(bool wall) {
    const SphereBody i = draw_sphere_body(), j = draw_sphere_body();
    SpherePair c{i,
                 wall ? wall_for_spheres(j.velocity) : j,
                 (i.radius + j.radius) * unit_circle(draw(0.0, 1.0)),
                 {.mu = draw(0.0, 1.5),
                  .restitution = draw(0.0, 1.0),
                  .tangential_restitution = draw(0.0, 1.0)}};
    const double closing = -dot(c.separation, c.j.velocity - c.i.velocity);
    RC_PRE(std::abs(closing) > 1e-3);
    if (closing < 0.0) {
        c.i.velocity = -1.0 * c.i.velocity;
        c.j.velocity = -1.0 * c.j.velocity;
    }
    return c;
}
SpherePair draw_sphere_collision() { return draw_sphere_collision(*rc::gen::element(0, 1) == 1); }

RC_GTEST_PROP(SphereCollision, ImpulsesActAtTheContact, ()) {
    const SpherePair before = draw_sphere_collision(false);
    SpherePair after = before;
    const Impulse J = collide(after.i, after.j, after.separation, after.surface);
    const Vec2 n = before.normal();
    // On j: along n, along r = (n_y, −n_x), along z; at −R_j n. The floor takes J_z or −J_z.
    const Vec3 on_j{J.normal * n.x + J.tangential * n.y, J.normal * n.y - J.tangential * n.x,
                    J.vertical};
    const auto check = [&](const SphereBody& was, const SphereBody& is, double sign, double arm) {
        RC_ASSERT(std::abs(is.velocity.x - was.velocity.x - sign * on_j.x * was.inverse_mass) <
                  sphere_rounding);
        RC_ASSERT(std::abs(is.velocity.y - was.velocity.y - sign * on_j.y * was.inverse_mass) <
                  sphere_rounding);
        const Vec3 torque =
            cross3({arm * n.x, arm * n.y, 0.0}, {sign * on_j.x, sign * on_j.y, sign * on_j.z});
        const Vec3 a = spin_of(was), b = spin_of(is);
        const double k = was.inverse_inertia;
        // The inertia can be as small as 0.001, so spins can reach 1000.
        RC_ASSERT(std::abs(b.x - a.x - k * torque.x) < 1e3 * sphere_rounding);
        RC_ASSERT(std::abs(b.y - a.y - k * torque.y) < 1e3 * sphere_rounding);
        RC_ASSERT(std::abs(b.z - a.z - k * torque.z) < 1e3 * sphere_rounding);
    };
    check(before.i, after.i, -1.0, before.i.radius);
    check(before.j, after.j, 1.0, -before.j.radius);
}

// About vertical axes only: about horizontal ones the floor's reaction to J_z has a torque.
RC_GTEST_PROP(SphereCollision, ConservesMomentumAndVerticalAngularMomentum, ()) {
    SpherePair c = draw_sphere_collision(false);
    const Vec2 position = draw_vector(5.0);  // position of i
    const auto momentum = [&] {
        return (1.0 / c.i.inverse_mass) * c.i.velocity + (1.0 / c.j.inverse_mass) * c.j.velocity;
    };
    const auto angular_momentum = [&] {
        return cross(position, c.i.velocity) / c.i.inverse_mass +
               cross(position + c.separation, c.j.velocity) / c.j.inverse_mass +
               c.i.spin / c.i.inverse_inertia + c.j.spin / c.j.inverse_inertia;
    };
    const Vec2 p = momentum();
    const double L = angular_momentum();
    collide(c.i, c.j, c.separation, c.surface);
    const Vec2 lost = momentum() - p;
    RC_ASSERT(std::abs(lost.x) < 10.0 * sphere_rounding);
    RC_ASSERT(std::abs(lost.y) < 10.0 * sphere_rounding);
    // Momenta of up to 10 at distances of up to 10.
    RC_ASSERT(std::abs(angular_momentum() - L) < 100.0 * sphere_rounding);
}

// The energy includes the vertical energy of the lifted sphere.
RC_GTEST_PROP(SphereCollision, EnergyNeverGrowsInTheFrameOfTheWall, ()) {
    SpherePair c = draw_sphere_collision();
    const double before = c.energy();
    const Impulse J = collide(c.i, c.j, c.separation, c.surface);
    RC_ASSERT(c.energy() + Lifted(c, J).energy <= before * (1.0 + sphere_rounding));
}

RC_GTEST_PROP(SphereCollision, EnergyNeverGrowsWithLessVerticalFriction, ()) {
    SpherePair c = draw_sphere_collision();
    c.surface.vertical_friction = draw(0.0, 1.0);
    const double before = c.energy();
    const Vec3 slip = c.slip();
    const Impulse J = collide(c.i, c.j, c.separation, c.surface);
    RC_ASSERT(c.energy() <= before * (1.0 + sphere_rounding));
    RC_ASSERT(J.vertical * slip.z <= 0.0);
}

RC_GTEST_PROP(SphereCollision, WithoutVerticalFrictionKeepsTheRollingSpin, ()) {
    SpherePair c = draw_sphere_collision();
    c.surface.vertical_friction = 0.0;
    const Vec2 i = c.i.rolling_spin, j = c.j.rolling_spin;
    Body disc_i = c.i, disc_j = c.j;
    const Impulse of_discs = collide(disc_i, disc_j, c.separation, c.surface);
    const Impulse J = collide(c.i, c.j, c.separation, c.surface);
    RC_ASSERT(J.vertical == 0.0);
    RC_ASSERT(J.tangential == of_discs.tangential);
    RC_ASSERT(c.i.rolling_spin.x == i.x && c.i.rolling_spin.y == i.y);
    RC_ASSERT(c.j.rolling_spin.x == j.x && c.j.rolling_spin.y == j.y);
}

RC_GTEST_PROP(SphereCollision, ConservesEnergyIfElasticAndSmooth, ()) {
    SpherePair c = draw_sphere_collision();
    c.surface = {.mu = 0.0};
    const double before = c.energy();
    collide(c.i, c.j, c.separation, c.surface);
    RC_ASSERT(std::abs(c.energy() - before) <= before * sphere_rounding);
}

RC_GTEST_PROP(SphereCollision, FrictionDissipatesTheDerivedEnergy, ()) {
    SpherePair c = draw_sphere_collision();
    const Slip slip(c);
    const double masses = c.i.inverse_mass + c.j.inverse_mass;
    const double u = dot(c.i.velocity - c.j.velocity, c.normal()), e = c.surface.restitution;
    const double before = c.energy();
    const Impulse J = collide(c.i, c.j, c.separation, c.surface);
    const double loss = -slip.energy(J) + 0.5 * (1.0 - e * e) * u * u / masses;
    RC_ASSERT(std::abs(before - c.energy() - Lifted(c, J).energy - loss) <
              sphere_rounding * (1.0 + before));
}

RC_GTEST_PROP(SphereCollision, FrictionObeysCoulombsLawAndSticksIfItCan, ()) {
    SpherePair c = draw_sphere_collision();
    const Vec3 before = c.slip();
    const Slip slip(c);
    const double beta = c.surface.tangential_restitution;
    const Impulse J = collide(c.i, c.j, c.separation, c.surface);
    const double coulomb = c.surface.mu * J.normal;
    RC_ASSERT(std::hypot(J.tangential, J.vertical) <=
              coulomb * (1.0 + sphere_rounding) + sphere_rounding);
    RC_ASSERT(J.sticks == ((1.0 + beta) * slip.sticking() <= coulomb));
    if (!J.sticks) return;
    const Vec3 after = c.slip();
    // Spins may be 1000, as above.
    RC_ASSERT(std::abs(after.x + beta * before.x) < 1e3 * sphere_rounding);
    RC_ASSERT(std::abs(after.y + beta * before.y) < 1e3 * sphere_rounding);
    RC_ASSERT(std::abs(after.z + Lifted(c, J).slip + beta * before.z) < 1e3 * sphere_rounding);
}

// The direction of the impulse is between the direction against the slip and that of J*. Weak
// friction acts against the slip, up to k² = 10⁻⁸ of the angle between the two directions.
RC_GTEST_PROP(SphereCollision, FrictionTurnsFromOpposingTheSlipToSticking, ()) {
    SpherePair c = draw_sphere_collision();
    c.surface.tangential_restitution = 0.0;
    const Slip s(c);
    RC_PRE(s.sticking() > 1e-3);
    const auto friction = [&](double of_sticking) {
        SpherePair after = c;
        after.surface.mu = 1.0;
        const double normal = collide(after.i, after.j, after.separation, after.surface).normal;
        after = c;
        after.surface.mu = of_sticking * s.sticking() / normal;
        return collide(after.i, after.j, after.separation, after.surface);
    };
    const auto sine = [](double at, double az, double bt, double bz) {
        return (at * bz - az * bt) / (std::hypot(at, az) * std::hypot(bt, bz));
    };
    const auto against_slip = [&](const Impulse& J) {
        return sine(-s.t, -s.z, J.tangential, J.vertical);
    };
    const double apart = sine(-s.t, -s.z, -s.m_t * s.t, -s.m_z * s.z);
    RC_ASSERT(std::abs(against_slip(friction(1e-4))) <= 2e-8 * std::abs(apart) + sphere_rounding);
    const double at_half = against_slip(friction(0.5)), at_most = against_slip(friction(0.9999));
    RC_ASSERT(at_half * apart >= -rounding &&
              std::abs(at_half) <= std::abs(apart) + sphere_rounding);
    // The deviation is 1 − k² = 2·10⁻⁴ times an angle below 1. It may be larger, because m_s |s|
    // may be smaller than K.
    RC_ASSERT(std::abs(at_most - apart) < 1e-3);
}

/// The impulse of friction that opposes the slip at every instant, dJ/dK = −ŝ: midpoint steps.
Vec2 integrated_friction(const Slip& slip, double coulomb) {
    constexpr int steps = 1000;
    Vec2 s{slip.t, slip.z}, J{0.0, 0.0};
    const auto answer = [&](const Vec2& kick) {
        return Vec2{kick.x / slip.m_t, kick.y / slip.m_z};
    };
    for (int k = 0; k < steps; ++k) {
        const double step = coulomb / steps;
        const Vec2 half = s + answer((-0.5 * step / std::hypot(s.x, s.y)) * s);
        const Vec2 kick = (-step / std::hypot(half.x, half.y)) * half;
        // It sticks: the rest of the slip is stopped.
        if (dot(s, s + answer(kick)) <= 0.0) return J - Vec2{slip.m_t * s.x, slip.m_z * s.y};
        s = s + answer(kick);
        J = J + kick;
    }
    return J;
}

// Solid spheres and shells of unequal masses and sizes, with each other and at the wall, with slip
// in all directions, from weak friction to sticking. The bounds are those that collision_law.hpp
// states.
TEST(SphereCollision, SlidingFrictionIsCloseToTheIntegralOverTheContact) {
    const auto worst = [](double inertia_factor) {
        double maximum = 0.0;
        for (const double other_mass : {0.0, 1.0, 100.0, 0.01})
            for (int angle = 0; angle < 36; ++angle)
                for (double part = 0.1; part < 1.05; part += 0.1) {
                    const Vec2 turned = unit_circle((angle + 0.5) / 36.0);
                    const auto sphere = [&](double mass, double spin, double roll) {
                        return SphereBody{
                            {{0.0, 0.0}, spin, 1.0, 1.0 / mass, 1.0 / (inertia_factor * mass)},
                            {0.0, roll}};
                    };
                    SpherePair c{sphere(1.0, turned.x, turned.y),
                                 other_mass == 0.0 ? wall_for_spheres({0.0, 0.0})
                                                   : sphere(other_mass, 0.0, 0.0),
                                 {2.0, 0.0},
                                 {}};
                    c.i.velocity.x = 1.0;
                    const Slip slip(c);
                    const double masses = c.i.inverse_mass + c.j.inverse_mass;
                    c.surface.mu = part * slip.sticking() * masses / 2.0;
                    const Impulse J = collide(c.i, c.j, c.separation, c.surface);
                    const double coulomb = part * slip.sticking();
                    const Vec2 off =
                        Vec2{J.tangential, J.vertical} - integrated_friction(slip, coulomb);
                    maximum = std::max(maximum, std::hypot(off.x, off.y) / coulomb);
                }
        return maximum;
    };
    EXPECT_LT(worst(0.4), 0.02);
    EXPECT_LT(worst(2.0 / 3.0), 0.035);
}

SphereBody rolling_along_x(double v) { return {{{v, 0.0}, 0.0, 1.0, 1.0, 2.5}, {0.0, v}}; }

TEST(SphereCollision, SphereRollingIntoTheWallIsLiftedAndKeepsTwoSeventhsOfItsSpin) {
    // Rolling along +x: ω_y = v. Head-on, so nothing slips horizontally.
    SphereBody i = rolling_along_x(0.8), wall = wall_for_spheres({0.0, 0.0});
    const SpherePair c{i, wall, {7.6, 0.0}, {.mu = 100.0}};
    EXPECT_DOUBLE_EQ(c.slip().z, 0.8);
    const Impulse J = collide(i, wall, {7.6, 0.0}, {.mu = 100.0});
    EXPECT_EQ(J.tangential, 0.0);
    // 1/m_z = 1/m + R²/I = 3.5; it then rolls up the wall, with R ω = w = J/m.
    EXPECT_NEAR(J.vertical, -2.0 / 7.0 * 0.8, 1e-15);
    EXPECT_NEAR(i.rolling_spin.y, 2.0 / 7.0 * 0.8, 1e-15);
    EXPECT_EQ(i.velocity.x, -0.8);
}

TEST(SphereCollision, SphereSpinningBackwardsAtTheWallIsPushedDownAndStops) {
    SphereBody i = rolling_along_x(0.8), wall = wall_for_spheres({0.0, 0.0});
    i.rolling_spin.y = -0.5;
    const Impulse J = collide(i, wall, {7.6, 0.0}, {.mu = 100.0});
    // The floor holds it: 1/m_z = R²/I = 2.5.
    EXPECT_NEAR(J.vertical, 0.4 * 0.5, 1e-15);
    EXPECT_NEAR(i.rolling_spin.y, 0.0, 1e-15);
}

// One sphere rolls behind the other. The back of the front one moves up and the front of the rear
// one moves down, so the rear one is lifted. Its mass and both spins respond: m_z is a sixth of a
// mass.
TEST(SphereCollision, EffectiveVerticalMassOfEqualSolidSpheresIsASixth) {
    SphereBody i = rolling_along_x(1.0), j = rolling_along_x(0.5);
    const Impulse J = collide(i, j, {2.0, 0.0}, {.mu = 100.0});
    EXPECT_NEAR(J.vertical, -1.5 / 6.0, 1e-15);
    EXPECT_NEAR(i.rolling_spin.y, 1.0 - 2.5 * 0.25, 1e-15);
    EXPECT_NEAR(j.rolling_spin.y, 0.5 - 2.5 * 0.25, 1e-15);
    EXPECT_NEAR(i.velocity.x, 0.5, 1e-15);
    // In the reverse order j is lifted.
    i = rolling_along_x(-1.0);
    j = rolling_along_x(-1.2);
    EXPECT_NEAR(collide(i, j, {2.0, 0.0}, {.mu = 100.0}).vertical, 2.2 / 6.0, 1e-15);
}

// The front of a rolling sphere moves down, its back up. Two fronts do not slip; a front and a back
// slip with the sum of the speeds.
TEST(SphereCollision, RollingSpheresSlipWithTheSumOfTheirNormalVelocities) {
    const auto rolling = rolling_along_x;
    EXPECT_EQ((SpherePair{rolling(1.0), rolling(-1.0), {2.0, 0.0}, {}}).slip().z, 0.0);
    EXPECT_EQ(std::abs((SpherePair{rolling(1.0), rolling(0.5), {2.0, 0.0}, {}}).slip().z), 1.5);
}

RC_GTEST_PROP(SphereCollision, WithoutVerticalSlipEqualsThatOfDiscs, ()) {
    SpherePair c = draw_sphere_collision();
    c.i.rolling_spin = c.j.rolling_spin = {0.0, 0.0};
    Body i = c.i, j = c.j;
    const Impulse of_discs = collide(i, j, c.separation, c.surface);
    const Impulse of_spheres = collide(c.i, c.j, c.separation, c.surface);
    const auto same = [](double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; };
    RC_ASSERT(same(of_discs.normal, of_spheres.normal));
    RC_ASSERT(of_discs.tangential == of_spheres.tangential);
    RC_ASSERT(of_discs.sticks == of_spheres.sticks);
    RC_ASSERT(of_spheres.vertical == 0.0);
    for (const auto& [a, b] : {std::pair{i, c.i}, std::pair{j, c.j}}) {
        RC_ASSERT(a.velocity.x == b.velocity.x);
        RC_ASSERT(a.velocity.y == b.velocity.y);
        RC_ASSERT(a.spin == b.spin);
    }
}

// On a floor, a collision within t_c is elastic, or separates the two for a time t_c at least.
// Other collisions are unchanged.
TEST(SphereCollision, SpheresPressedTogetherSeparateForTheContactDuration) {
    const Surface surface{.mu = 0.0, .restitution = 0.5, .contact_duration = 1e-2};
    const Floor floor{.deceleration = 2.0};
    const auto speed_after = [&](double u, double since_last, const Floor& on) {
        SphereBody i{{{u, 0.0}, 0.0, 1.0, 1.0, 2.5}, {0.0, 0.0}};
        SphereBody wall = wall_for_spheres({0.0, 0.0});
        const Vec2 s{7.6, 0.0};
        collide(i, wall, s,
                at_contact_on_floor(surface, since_last, on, s, wall.velocity - i.velocity));
        return -i.velocity.x;
    };
    EXPECT_NEAR(speed_after(1e-9, 1e-3, floor), 1e-2, 1e-15);
    EXPECT_NEAR(speed_after(0.7, 1e-3, floor), 0.7, 1e-15);
    EXPECT_NEAR(speed_after(0.7, 1e-1, floor), 0.35, 1e-15);
    EXPECT_NEAR(speed_after(1e-9, 1e-3, {}), 1e-9, 1e-24);
}

}  // namespace
}  // namespace swirl
