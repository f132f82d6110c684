// The chapters against published theory and experiments: the mean-field theory of rough discs, the
// fit of paths, and the plans of the figures.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <nlohmann/json.hpp>

#include "swirl/math/random.hpp"
#include "swirl/paper/chapters.hpp"
#include "swirl/paper/hypocycloid.hpp"
#include "swirl/paper/rough_gas.hpp"
#include "swirl/paper/swirled_state.hpp"
#include "swirl/physics/collision_law.hpp"

namespace swirl {
namespace {

/// A normal deviate as the sum of twelve uniform ones: its variance is exactly 1.
double deviate(Random& random) {
    double sum = -6.0;
    for (int k = 0; k < 12; ++k) sum += random.uniform();
    return sum;
}

/// The mean change of the two energies in a collision, by the engine's law. Pairs have the
/// velocities and spins of a gas, and the weight of a pair is its speed of approach.
Temperatures mean_changes(const RoughGas& gas, double beta, const Temperatures& T) {
    Random random(1);
    const Surface surface{1e6, gas.restitution, beta};
    const double speed = std::sqrt(T.translation), turn = std::sqrt(T.spins / gas.inertia);
    double weight = 0.0, translation = 0.0, spins = 0.0;
    for (int k = 0; k < 200'000; ++k) {
        Body i{{speed * deviate(random), speed * deviate(random)},
               turn * deviate(random),
               1.0,
               1.0,
               1.0 / gas.inertia};
        Body j = i;
        j.velocity = {speed * deviate(random), speed * deviate(random)};
        j.spin = turn * deviate(random);
        const double u = i.velocity.x - j.velocity.x;
        if (u <= 0.0) continue;
        const auto energies = [&] {
            return Temperatures{0.5 * (dot(i.velocity, i.velocity) + dot(j.velocity, j.velocity)),
                                0.5 * gas.inertia * (i.spin * i.spin + j.spin * j.spin)};
        };
        const Temperatures before = energies();
        collide(i, j, {1.0, 0.0}, surface);
        const Temperatures after = energies();
        weight += u;
        translation += u * (after.translation - before.translation);
        spins += u * (after.spins - before.spins);
    }
    return {translation / weight, spins / weight};
}

// N/2 collisions per unit of τ change N T + N T_s/2 by the mean changes: dT/dτ is half of the
// first, dT_s/dτ is the second.
TEST(RoughGas, CoefficientsAreTheMeanChangesOfTheCollisionLaw) {
    struct Case {
        double e, beta, q;
        Temperatures T;
    };
    for (const Case& c : {Case{0.9, 0.0, 0.5, {1.0, 0.3}}, Case{0.8, 0.5, 10.0, {1.0, 2.0}},
                          Case{1.0, 1.0, 0.5, {0.5, 1.0}}}) {
        const RoughGas gas = RoughGas::of(c.e, c.beta, c.q);
        const Temperatures found = mean_changes(gas, c.beta, c.T);
        const double T = c.T.translation, S = c.T.spins;
        // The changes scatter by about T_s + T, and 100 000 pairs approach: an error of
        // 0.003 (T + T_s), and the tolerance is four of them.
        const double tolerance = 0.012 * (T + S);
        EXPECT_NEAR(0.5 * found.translation, -gas.a() * T + gas.b() * S, tolerance);
        EXPECT_NEAR(found.spins, 2.0 * gas.b() * T - 2.0 * gas.c() * S, tolerance);
    }
}

TEST(RoughGas, SmoothDiscsCoolByHaffsLaw) {
    const RoughGas gas = RoughGas::of(0.9, -1.0, 0.5);
    for (const double tau : {0.5, 3.0, 20.0}) {
        const Temperatures now = gas.after(tau, {2.0, 0.7});
        EXPECT_NEAR(now.translation, 2.0 * std::exp(-0.5 * 0.19 * tau), 1e-12);
        EXPECT_NEAR(now.spins, 0.7, 1e-12);
        // √(T₀/T) = 1 + (1 − e²) ν₀ t/4; Simpson's rule with steps of 1/40.
        EXPECT_NEAR(std::sqrt(2.0 / now.translation),
                    1.0 + 0.19 / 4.0 * gas.time_of(tau, {2.0, 0.7}), 1e-8);
    }
}

TEST(RoughGas, PerfectlyRoughElasticDiscsKeepTheirEnergyAndShareIt) {
    const RoughGas gas = RoughGas::of(1.0, 1.0, 0.5);
    for (const double tau : {0.1, 1.0, 10.0}) {
        const Temperatures now = gas.after(tau, {1.0, 0.0});
        EXPECT_NEAR(now.translation + 0.5 * now.spins, 1.0, 1e-12);
    }
    const Temperatures last = gas.after(200.0, {1.0, 0.0});
    EXPECT_NEAR(last.translation, 2.0 / 3.0, 1e-12);
    EXPECT_NEAR(last.spins, 2.0 / 3.0, 1e-12);
}

TEST(RoughGas, SolutionObeysItsEquations) {
    const RoughGas gas = RoughGas::of(0.85, 0.4, 2.0);
    constexpr double tau = 1.7, step = 1e-5;
    const Temperatures start{1.0, 0.2}, now = gas.after(tau, start),
                                        later = gas.after(tau + step, start),
                                        sooner = gas.after(tau - step, start);
    // Central differences: an error of step², and rounding of 10⁻¹⁶/step.
    EXPECT_NEAR((later.translation - sooner.translation) / (2.0 * step),
                -gas.a() * now.translation + gas.b() * now.spins, 1e-9);
    EXPECT_NEAR((later.spins - sooner.spins) / (2.0 * step),
                2.0 * gas.b() * now.translation - 2.0 * gas.c() * now.spins, 1e-9);
}

// 2.39952 collisions per disc and unit of time at φ = 0.3, for σ = m = kT = 1
// (Kolafa and Rottner 2006). Henderson's g is good to 0.3 % there.
TEST(RoughGas, EnskogsRateIsThatOfTheHardDiscGas) {
    EXPECT_NEAR(2.0 * enskog_collision_rate(0.3) / 2.39952, 1.0, 0.003);
}

using Paths = std::vector<std::vector<std::complex<double>>>;

TEST(Hypocycloids, FitFindsAPlantedRotationAndDistance) {
    Random random(3);
    for (const double rotation : {-0.2, 0.3}) {
        Paths paths(10);
        for (std::size_t i = 0; i < paths.size(); ++i)
            for (int k = 0; k < 240; ++k) {
                const Vec2 noise = random.in_disc(0.1);
                const double turns = k / 60.0, start = double(i);
                paths[i].push_back(
                    std::polar(2.0, 2.0 * pi * turns) +
                    std::polar(0.5 * double(i), 2.0 * pi * rotation * turns + start) +
                    std::complex<double>(noise.x, noise.y));
            }
        const HypocycloidFit fit = fit_hypocycloids(paths, 60);
        EXPECT_NEAR(fit.rotation, rotation, 0.0051);  // a step of the search
        // In a disc of radius 0.1 the root mean square is 0.1/√2. The fit removes 4 of 480 numbers,
        // and a wrong ϖ by half a step adds less than 0.01.
        EXPECT_NEAR(fit.distance, 0.1 / std::sqrt(2.0), 0.01);
    }
}

Snapshot still_snapshot(const std::vector<Vec2>& positions, double clock) {
    Snapshot s;
    s.period = 10.0;
    s.clock = clock;
    s.container_radius = 10.0;
    s.resize(positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i)
        s.set(i, {positions[i], {0.0, 0.0}, 0.0, 0.0, clock, 1.0, 1.0, 0.5});
    return s;
}

// Two discs at rest relative to the swirl: their centre of mass turns with it, at the distance 3.1.
TEST(SwirledState, CentreThatTurnsWithTheSwirlIsSteady) {
    SwirledState state(10.0, 0.0);
    for (int k = 0; k < 60; ++k) {
        const double angle = 2.0 * pi * k / 60.0;
        const Vec2 radial{std::cos(angle), std::sin(angle)};
        state.sample(still_snapshot({2.0 * radial, 4.2 * radial}, 10.0 * k / 60.0));
    }
    const Json found = state.json();
    EXPECT_NEAR(found["distance"].get<double>(), 0.31, 1e-12);
    EXPECT_NEAR(found["steady"].get<double>(), 0.31, 1e-12);
    EXPECT_NEAR(found["advance"].get<double>(), 1.0, 1e-12);
    // One disc at the distance 1.1 from the centre of mass on each side, in a ring of 1 to 1.2.
    EXPECT_NEAR(found["about_centre_of_mass"][5].get<double>() * pi * (1.44 - 1.0), 2.0, 1e-9);
}

// A uniform layer that the floor carries by 2/7 of the container's motion is where it is expected.
TEST(SwirledState, FreelyCarriedLayerHasNoDistance) {
    SwirledState state(10.0, 2.0 / 7.0);
    for (int k = 0; k < 60; ++k) {
        const double angle = 2.0 * pi * k / 60.0;
        const Vec2 C{1.4 * std::cos(angle), 1.4 * std::sin(angle)};
        const Vec2 carried = (2.0 / 7.0) * C;
        Snapshot s =
            still_snapshot({carried + Vec2{3.0, 0.0}, carried - Vec2{3.0, 0.0}}, 10.0 * k / 60.0);
        s.container_centre = C;
        state.sample(s);
    }
    EXPECT_NEAR(state.json()["distance"].get<double>(), 0.0, 1e-12);
    RunConfig config;
    EXPECT_EQ(carried_share(config), 0.0);
    config.floor = true;
    config.inertia = 0.4;
    EXPECT_NEAR(carried_share(config), 2.0 / 7.0, 1e-15);
}

// A core that turns with 0.3 and a wall layer that turns with −0.1, about the centre.
TEST(SwirledState, CoreAndLayerHaveTheirOwnRotation) {
    const std::vector<Vec2> positions{{2.0, 0.0}, {-2.0, 0.0}, {9.0, 0.0}, {-9.0, 0.0}};
    Snapshot s = still_snapshot(positions, 0.0);
    for (std::size_t i = 0; i < 4; ++i) {
        const Vec2 v = (i < 2 ? 0.3 : -0.1) * perpendicular(positions[i]);
        s.set(i, {positions[i], v, 0.0, 0.0, 0.0, 1.0, 1.0, 0.5});
    }
    SwirledState state(10.0, 0.0);
    state.sample(s);
    const double omega = 2.0 * pi / 10.0;
    EXPECT_NEAR(state.json()["core"].get<double>(), 0.3 / omega, 1e-12);
    EXPECT_NEAR(state.json()["layer"].get<double>(), -0.1 / omega, 1e-12);
}

TEST(ChapterPublished, FullFiguresHaveEightSeeds) {
    for (const auto& chapter : {chapter_cooling(), chapter_experiments()})
        for (const PaperFigure& figure : chapter)
            EXPECT_EQ(figure.plan(PaperSettings{}).points.size() % 8, 0u) << figure.name;
}

}  // namespace
}  // namespace swirl
