// The balances of mass, momentum and spin at random points, with random widths and intervals, of
// exact runs; and gases whose fields are known.
#include "swirl/measure/field_balance.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/scenes.hpp"
#include "measure/snapshots.hpp"
#include "swirl/measure/fields.hpp"

namespace swirl {
namespace {

/// The densities, calculated again from the definition alone.
FieldDensities brute_densities(const Snapshot& s, const Vec2& x, double w) {
    FieldDensities sum;
    for (std::size_t i = 0; i < s.size(); ++i) {
        const Vec2 d = x - s.position(i), v = s.velocity(i);
        const double part = 1.0 - (d.x * d.x + d.y * d.y) / (w * w);
        const double value = part > 0.0 ? 3.0 * part * part / (pi * w * w) : 0.0;
        sum.mass += s.mass[i] * value;
        sum.momentum = sum.momentum + (s.mass[i] * value) * v;
        sum.spin += s.inertia[i] * s.spin[i] * value;
    }
    return sum;
}

/// The snapshot in the form in which a run passes it to observers.
Snapshot observed(const Snapshot& s) { return s.are_spheres() ? s.up_to_date() : s; }

struct BalanceSums {
    BalanceTerms terms;
    int intervals = 0;
};

// A disc that disappears from the point without a flight is the whole scale of mass, so the
// relative residual is 1, whatever the mass and the width.
TEST(FieldBalance, RelativeResidualIsOneForADiscThatDisappears) {
    for (const double width : {0.5, 3.0}) {
        Snapshot s = empty_container();
        add_disc(s, {0.0, 0.0}, {0.0, 0.0}, 0.0, 1.0, 7.0);
        add_disc(s, {9.0, 0.0}, {0.0, 0.0});
        FieldBalance balance({0.0, 0.0}, {width});
        balance.begin(s);
        s.x[0] = 6.0;
        balance.add({0, s.clock, EventKind::disc_disc, 0, 1, {1.0, 0.0}, {}, 0.0}, s);
        balance.finish();
        EXPECT_NEAR(balance.relative_residuals()[0], 1.0, 1e-15);
    }
}

BalanceSums expect_balances(const InitialState& scene, std::uint64_t seed) {
    Simulation simulation(scene);
    Snapshot stored = simulation.snapshot();
    Noise noise(seed);
    BalanceSums sums;
    const double R = scene.container_radius;
    for (; sums.intervals < 60; ++sums.intervals) {
        const double width = sums.intervals % 10 == 0 ? 0.4 : 4.0 + 3.5 * noise();
        FieldBalance balance({(R + 1.0) * noise(), (R + 1.0) * noise()}, {width});
        const Vec2 x = balance.point();
        balance.begin(observed(stored));
        const FieldDensities before = brute_densities(observed(stored), x, width);
        const int events = 1 + static_cast<int>(400.0 * (1.0 + noise()));
        for (int k = 0; k < events; ++k) {
            const Event event = simulation.step();
            simulation.refresh(stored, event);
            balance.add(event, observed(stored));
        }
        balance.finish();
        const FieldDensities change = brute_densities(observed(stored), x, width) - before;
        const BalanceTerms& t = balance.terms();
        const FieldDensities total = t.total();
        // The scale is the sum of about a thousand contributions, and their rounding errors are
        // random.
        constexpr double rounding = 1e-15;
        EXPECT_NEAR(change.mass, total.mass, rounding * t.scale_of_mass);
        EXPECT_NEAR(change.momentum.x, total.momentum.x, rounding * t.scale_of_momentum);
        EXPECT_NEAR(change.momentum.y, total.momentum.y, rounding * t.scale_of_momentum);
        EXPECT_NEAR(change.spin, total.spin, rounding * t.scale_of_spin);
        sums.terms.transport.mass += std::fabs(t.transport.mass);
        sums.terms.stress.x += std::fabs(t.stress.x);
        sums.terms.couple_stress += std::fabs(t.couple_stress);
        sums.terms.torque += std::fabs(t.torque);
        sums.terms.wall.x += std::fabs(t.wall.x);
        sums.terms.floor.x += std::fabs(t.floor.x);
    }
    return sums;
}
/// No term is zero, so an error of any of them would show.
void expect_all_terms(const BalanceSums& sums, bool floor) {
    EXPECT_GT(sums.terms.transport.mass, 1e-3);
    EXPECT_GT(sums.terms.stress.x, 1e-3);
    EXPECT_GT(sums.terms.couple_stress, 1e-3);
    EXPECT_GT(sums.terms.torque, 1e-3);
    EXPECT_GT(sums.terms.wall.x, 1e-3);
    EXPECT_EQ(sums.terms.floor.x > 1e-3, floor);
}

TEST(FieldBalance, HoldsForDiscsOnThePolygon) {
    expect_all_terms(expect_balances(paper_container(40), 1), false);
}
TEST(FieldBalance, HoldsForDiscsOnTheCircle) {
    InitialState scene = paper_container(48, 0.5, 0.2);
    scene.path = circular_path(paper_amplitude, paper_period);
    expect_all_terms(expect_balances(scene, 2), false);
}
TEST(FieldBalance, HoldsForAMixtureOfInelasticDiscs) {
    InitialState scene = mixture_container();
    scene.disc_surface = {
        .mu = 0.7, .restitution = 0.9, .tangential_restitution = 0.4, .contact_duration = 1e-3};
    scene.wall_surface = {.mu = 0.4, .restitution = 0.8, .contact_duration = 1e-3};
    expect_all_terms(expect_balances(scene, 3), false);
}
TEST(FieldBalance, HoldsIfEverySecondDiscCannotSpin) {
    expect_all_terms(expect_balances(with_held_spins(paper_container(40), 2), 7), false);
}
TEST(FieldBalance, HoldsForSpheresOnTheFloor) {
    expect_all_terms(expect_balances(sphere_container(30), 4), true);
}
TEST(FieldBalance, HoldsForSpheresWithRollingResistance) {
    expect_all_terms(expect_balances(resisting_container(40, 0.1), 5), true);
}
TEST(FieldBalance, HoldsForCoins) {
    expect_all_terms(expect_balances(coin_container(45, 0.3), 6), true);
}

/// A wrong impulse or a wrong spin breaks the balance.
TEST(FieldBalance, ShowsAMissingImpulse) {
    for (const bool tangential : {false, true}) {
        Simulation simulation(paper_container(48));
        Snapshot s = simulation.snapshot();
        FieldBalance balance({1.0, 0.5}, {6.0});
        balance.begin(s);
        bool is_wrong = false;
        for (int k = 0; k < 1000; ++k) {
            Event event = simulation.step();
            simulation.refresh(s, event);
            const Vec2 from_point = s.position(event.i) - Vec2{1.0, 0.5};
            if (k > 500 && !is_wrong && event.kind == EventKind::disc_disc &&
                dot(from_point, from_point) < 9.0) {
                (tangential ? event.impulse.tangential : event.impulse.normal) = 0.0;
                is_wrong = true;
            }
            balance.add(event, s);
        }
        balance.finish();
        EXPECT_GT(balance.relative_residuals()[1], 1e-9);
        EXPECT_EQ(balance.relative_residuals()[2] > 1e-9, tangential);
        EXPECT_TRUE(is_wrong);
        EXPECT_LT(balance.relative_residuals()[0], 1e-13);
    }
}

/// Fields of a gas, sampled for `blocks` blocks of `events` events.
Fields fields_of(Simulation& gas, double container_radius, int blocks, int events) {
    Fields fields(container_radius);
    Snapshot s = gas.snapshot();
    for (int block = 0; block < blocks; ++block) {
        const double begin = s.time();
        for (int k = 0; k < events; ++k) {
            const Event event = gas.step();
            gas.refresh(s, event);
            fields.sample_event(event, s);
            if (k % 200 == 0)
                for (int skip = 0; skip < Fields::samples_per_use; ++skip) fields.sample_in_lab(s);
        }
        fields.close_block();
        fields.close_event_block(s.time() - begin);
    }
    return fields;
}

struct InnerMean {
    double packing = 0.0, density = 0.0, temperature = 0.0, pressure = 0.0;
    double vorticity = 0.0, spin = 0.0, torque = 0.0, torque_square = 0.0, shear = 0.0;
};
/// The mean over the points within half of the container's radius.
InnerMean inner_mean(const FieldGrid& grid) {
    InnerMean mean;
    double n = 0.0;
    for (std::size_t cell = 0; cell < grid.grid().cells(); ++cell) {
        const Vec2 p = grid.grid().centre_of(cell);
        const double half = 0.5 * grid.grid().half_width;
        n += dot(p, p) < half * half ? 1.0 : 0.0;
    }
    const auto value = [&](const auto& fields, std::string_view name) {
        for (std::size_t k = 0; k < field_quantities.size(); ++k)
            if (name == field_quantities[k]->key()) return fields[k].mean / n;
        return not_available;
    };
    for (std::size_t cell = 0; cell < grid.grid().cells(); ++cell) {
        const Vec2 p = grid.grid().centre_of(cell);
        const double half = 0.5 * grid.grid().half_width;
        if (!(dot(p, p) < half * half)) continue;
        const auto f = grid.estimates(cell);
        mean.packing += value(f, "packing");
        mean.density += value(f, "density");
        mean.temperature += value(f, "temperature");
        mean.pressure += value(f, "pressure");
        mean.vorticity += value(f, "vorticity");
        mean.spin += value(f, "spin");
        mean.torque += value(f, "torque");
        mean.shear += 0.5 * (value(f, "collisional_xy") + value(f, "collisional_yx"));
    }
    return mean;
}

// Henderson 1975, doi:10.1080/00268977500102511: Z = 1 + 2 φ g(σ), g = (1 − 7φ/16)/(1 − φ)². It is
// within 0.6 % of Kolafa and Rottner up to φ = 0.5.
TEST(UniformGas, HasThePressureOfHardDiscs) {
    for (const double packing : {0.1, 0.3, 0.5}) {
        constexpr std::size_t n = 300;
        const InitialState scene = gas_at_rest(n, packing);
        Simulation gas(scene);
        gas.run(20 * n);
        const InnerMean mean =
            inner_mean(fields_of(gas, scene.container_radius, 10, 6000).grids()[1]);
        const double phi = mean.packing;
        EXPECT_NEAR(phi, packing, 0.06 * packing);
        EXPECT_NEAR(mean.density, phi / pi, 1e-12);
        const double Z = 1.0 + 2.0 * phi * (1.0 - 7.0 * phi / 16.0) / ((1.0 - phi) * (1.0 - phi));
        // 60,000 collisions, of which a quarter is in the inner half: 1 % of the virial.
        EXPECT_NEAR(mean.pressure / (mean.density * mean.temperature), Z, 0.03 * Z) << packing;
        EXPECT_NEAR(mean.torque, 0.0, 1e-17);  // smooth discs
    }
}

// Perfectly rough elastic discs in a smooth container at rest conserve energy and angular momentum.
// In equilibrium they rotate rigidly, spins included, and nothing drives the spin.
TEST(RigidRotation, IsTheEquilibriumOfPerfectlyRoughDiscs) {
    constexpr std::size_t n = 200;
    InitialState scene = gas_at_rest(n, 0.4);
    scene.disc_surface = {.mu = 1e9, .tangential_restitution = 1.0};
    constexpr double rate = 0.08;
    for (Disc& d : scene.discs) {
        d.inertia = 0.5;
        d.velocity = d.velocity + rate * perpendicular(d.position);
        d.spin = rate;
    }
    Simulation gas(scene);
    gas.run(100 * n);
    const Fields fields = fields_of(gas, scene.container_radius, 10, 12000);
    const InnerMean mean = inner_mean(fields.grids()[1]);
    // The inner half has 600 samples of 50 discs, with T = ½ and I = ½. If they were independent,
    // the mean spin would have an error of 0.006; the tolerance is four times that.
    EXPECT_NEAR(2.0 * mean.spin, mean.vorticity, 0.025);
    EXPECT_NEAR(mean.vorticity, 2.0 * rate, 0.04);
    // A contact transfers ± a few tenths of the pressure, so the error of the mean of 30,000 is
    // about a hundredth of it.
    EXPECT_NEAR(mean.torque, 0.0, 0.02 * mean.pressure);
    EXPECT_LT(row_of(fields, "spin_residual").mean, 1e-13);
}

}  // namespace
}  // namespace swirl
