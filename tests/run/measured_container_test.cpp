// The measurements on runs of the engine: results that hold for every trajectory and, with the
// label `slow`, the ranges in which the paper's claims must lie.
#include <gtest/gtest.h>

#include <cmath>

#include "measure/snapshots.hpp"
#include "swirl/engine/placement.hpp"
#include "swirl/engine/simulation.hpp"
#include "swirl/measure/angular_profile.hpp"
#include "swirl/measure/cluster_rotation.hpp"
#include "swirl/measure/collision_rates.hpp"
#include "swirl/measure/energy_budget.hpp"
#include "swirl/measure/pinned_loose.hpp"
#include "swirl/measure/slip.hpp"
#include "swirl/measure/spin_frustration.hpp"
#include "swirl/measure/torque_budget.hpp"
#include "swirl/measure/wall_stress.hpp"

namespace swirl {
namespace {

constexpr double R = paper_container_radius;
constexpr int frames = 511;

InitialState container(std::size_t discs, const Surface& disc_surface,
                       const Surface& wall_surface) {
    const auto positions = place_discs(std::vector<double>(discs, 1.0), R, 3);
    InitialState scene{.path = polygon_path(paper_amplitude, paper_period, paper_sides),
                       .container_radius = R,
                       .disc_surface = disc_surface,
                       .wall_surface = wall_surface};
    const Segment& segment = scene.path.segments.front();
    for (const Vec2& p : *positions)
        scene.discs.push_back(
            {segment.start + p, segment.velocity, 0.0, 0.0, 0.0, 1.0, 1.0, paper_inertia});
    return scene;
}

TEST(MeasuredContainer, TheEnergyBudgetClosesToRounding) {
    for (const Surface& surface :
         {Surface{.mu = 1.0},
          Surface{.mu = 0.5, .restitution = 0.97, .tangential_restitution = 0.3}}) {
        Simulation simulation(container(30, surface, surface));
        Snapshot s = simulation.snapshot();
        const double before = kinetic_energy(s);
        EnergyBudget budget;
        for (int k = 0; k < 100000; ++k) {
            const Event event = simulation.step();
            simulation.refresh(s, event);
            budget.sample_event(event, s);
        }
        // 10⁵ additions to sums of order 10⁴, each wrong by half an ulp of that: 10⁻¹² · √10⁵.
        EXPECT_NEAR(budget.accounted(), kinetic_energy(s) - before, 1e-8);
        EXPECT_GT(budget.total_work(), 100.0);
        EXPECT_GT(budget.total_loss(), 100.0);
    }
}

// Over each block of a period: the sums of the torques, times the period, are the changes of the
// angular momenta between the snapshots.
TEST(MeasuredContainer, TheTorqueBudgetClosesToRoundingInEveryBlock) {
    for (const bool circle : {false, true}) {
        InitialState scene =
            container(40, {.mu = 0.5, .restitution = 0.97, .tangential_restitution = 0.3},
                      {.mu = 0.7, .restitution = 0.97, .tangential_restitution = 0.3});
        if (circle) scene.path = circular_path(paper_amplitude, paper_period);
        Simulation simulation(scene);
        Snapshot s = simulation.snapshot();
        while (simulation.periods() < 1) simulation.refresh(s, simulation.step());
        TorqueBudget whole;
        whole.sample_event({1, 0.0, EventKind::path_vertex, 0, 0, {}, {}, 0.0}, s);
        for (int block = 0; block < 5; ++block) {
            TorqueBudget budget;
            budget.sample_event({1 + block, 0.0, EventKind::path_vertex, 0, 0, {}, {}, 0.0}, s);
            const AngularMomentum before = angular_momentum(s);
            for (Event event{}; simulation.periods() < 2 + block;) {
                event = simulation.step();
                simulation.refresh(s, event);
                budget.sample_event(event, s);
                whole.sample_event(event, s);
            }
            budget.close_event_block(s.period);
            whole.close_event_block(s.period);
            const AngularMomentum after = angular_momentum(s);
            const auto change = [&](const char* name) {
                return row_of(budget, name).mean * s.period;
            };
            // Some 10⁴ additions to sums of order 10³, each wrong by half an ulp: 10⁻¹³ · √10⁴.
            constexpr double rounding = 1e-10;
            EXPECT_NEAR(change("wall_normal") + change("wall_tangential") + change("transfer"),
                        after.orbital - before.orbital, rounding);
            EXPECT_NEAR(change("orbital"), after.orbital - before.orbital, rounding);
            EXPECT_NEAR(change("wall_on_spins") + change("discs_on_spins"),
                        after.spins - before.spins, rounding);
            EXPECT_NEAR(
                change("wall_about_centre") + change("container_torque") + change("transfer"),
                after.about_centre - before.about_centre, rounding);
            EXPECT_GT(std::abs(change("transfer")), 1.0);
            EXPECT_GT(std::abs(change("container_torque")), 1.0);
        }
        EXPECT_LT(whole.unaccounted_share(), 1e-13);
        EXPECT_GT(whole.unaccounted_share(), 0.0);
    }
}

TEST(MeasuredContainer, TractionObeysCoulombAndRatesAddUp) {
    const double mu = 0.3;
    Simulation simulation(container(40, {.mu = mu}, {.mu = mu}));
    simulation.advance_to(3, 0.0);
    Snapshot s = simulation.snapshot();
    WallStress stress(R, 36);
    CollisionRates rates;
    const EventCounts before = simulation.events();
    while (simulation.periods() < 23) {
        const Event event = simulation.step();
        simulation.refresh(s, event);
        stress.sample_event(event, s);
        rates.sample_event(event);
        if (simulation.periods() == event.periods) continue;
        stress.close_event_block(s.period);
        rates.close_event_block(s.period, s.size());
    }
    for (std::size_t k = 0; k < stress.slices(); ++k)
        EXPECT_LE(std::abs(stress.traction(k).mean), mu * stress.pressure(k).mean + 1e-14);
    EXPECT_GT(stress.mean_pressure().mean, 0.1);
    // M is at 3π/2: there the discs are pressed against the wall, opposite they are not.
    EXPECT_GT(stress.pressure(26).mean, 10.0 * stress.pressure(8).mean);
    const double per_disc_and_time = 40.0 * 20.0 * paper_period;
    const EventCounts after = simulation.events();
    EXPECT_NEAR(row_of(rates, "disc_disc_rate").mean,
                2.0 * static_cast<double>(after.disc_disc - before.disc_disc) / per_disc_and_time,
                1e-12);
    EXPECT_NEAR(row_of(rates, "disc_wall_rate").mean,
                static_cast<double>(after.disc_wall - before.disc_wall) / per_disc_and_time, 1e-12);
}

double nearest_to_the_centre_of_mass(const Snapshot& s) {
    Vec2 centre{0.0, 0.0};
    double mass = 0.0, nearest = R * R;
    for (std::size_t i = 0; i < s.size(); ++i) {
        centre = centre + s.mass[i] * s.position(i);
        mass += s.mass[i];
    }
    for (std::size_t i = 0; i < s.size(); ++i) {
        const Vec2 r = s.position(i) - (1.0 / mass) * centre;
        nearest = std::fmin(nearest, dot(r, r));
    }
    return std::sqrt(nearest);
}

// The centre of mass followed from event to event equals the one summed over the discs.
TEST(MeasuredContainer, FollowedRotationEqualsThatOfAllDiscs) {
    InitialState mixture = container(30, Surface{.mu = 0.7}, Surface{.mu = 0.4});
    for (std::size_t i = 0; i < mixture.discs.size(); ++i) mixture.discs[i].mass = 0.3 + double(i);
    InitialState circle = container(28, Surface{.mu = 1.0}, Surface{.mu = 1.0});
    circle.path = circular_path(paper_amplitude, paper_period);
    const Surface dissipates{
        .mu = 0.5, .restitution = 0.97, .tangential_restitution = 0.3, .contact_duration = 1e-3};
    const InitialState scenes[] = {container(48, Surface{.mu = 1.0}, Surface{.mu = 1.0}),
                                   container(5, Surface{.mu = 1.0}, Surface{.mu = 1.0}),
                                   container(30, dissipates, dissipates), mixture, circle};
    for (const InitialState& scene : scenes) {
        Simulation simulation(scene);
        Snapshot s = simulation.snapshot();
        ClusterRotation rotation;
        double worst = 0.0, worst_rigid = 0.0;
        for (int k = 0; k < 100000; ++k) {
            const Event event = simulation.step();
            simulation.refresh(s, event);
            const RotationSample seen = rotation.sample(s, event), found = cluster_rotation(s);
            const double near = nearest_to_the_centre_of_mass(s);
            worst = std::fmax(worst, std::fabs(seen.individual - found.individual) * near * near);
            worst_rigid = std::fmax(worst_rigid, std::fabs(seen.rigid - found.rigid));
        }
        // Between two vertices of the path (on a circle, within a period) the velocity of the
        // centre is the sum of up to a thousand impulses. They are rounded, like the velocities of
        // the discs and their mean: √1000 · 10⁻¹⁷ and, after a period of 12, δ = 4·10⁻¹⁵ in
        // position. At the distance r this gives an error of the angular velocity of about δ u/r²,
        // with speeds u of order 1.
        EXPECT_LT(worst, 1e-14);
        EXPECT_LT(worst_rigid, 1e-14);
    }
}

struct Seen {
    ClusterRotation rotation;
    PinnedLoose tracks;
    PinnedByCollisions collisions;
    Slip slip{8};
    SpinFrustration frustration{0.1, 8};
    AngularProfile profile{36};
    /// The discs that the profile omits, within their radius of the centre of mass: their number
    /// and the sum of their ϖ_i/Ω.
    double near = 0.0, near_rotation = 0.0;
};

Seen watch(std::size_t discs, const Surface& surface, int periods) {
    const InitialState scene = container(discs, surface, surface);
    Simulation simulation(scene);
    simulation.advance_to(40, 0.0);
    Snapshot s = simulation.snapshot();
    MFrameView view;
    Seen seen;
    int next = 0;
    while (simulation.periods() < 40 + periods) {
        const Event event = simulation.step();
        for (; next < frames && paper_period * next / frames <= event.clock; ++next) {
            s.clock = paper_period * next / frames;
            const Segment& segment = scene.path.segment_at(s.clock);
            s.container_centre = segment.position_at(s.clock);
            s.container_velocity = segment.velocity_at(s.clock);
            view.update(s);
            seen.rotation.sample_by_time(s);
            seen.tracks.sample(view);
            seen.slip.sample(view, seen.tracks.pinned());
            seen.frustration.sample(view, seen.tracks.pinned());
            seen.profile.sample(view);
            const CentreOfMass centre = view.centre_of_mass();
            for (std::size_t i = 0; i < view.size(); ++i) {
                const Vec2 d = view.position(i) - centre.position;
                if (!(dot(d, d) < 1.0)) continue;
                seen.near += 1.0;
                seen.near_rotation +=
                    centre.varpi(view.position(i), view.relative_velocity(i)) / view.frame.omega;
            }
        }
        simulation.refresh(s, event);
        seen.rotation.sample(s, event);
        seen.collisions.sample_event(event, s);
        seen.frustration.sample_event(event, s);
        if (simulation.periods() == event.periods) continue;
        next = 0;
        seen.rotation.close_block();
        seen.tracks.close_block();
        seen.collisions.close_block();
        seen.slip.close_block();
        seen.frustration.close_block();
        seen.profile.close_block();
    }
    return seen;
}

TEST(MeasuredContainer, MeanOfTheProfileIsRotationMinusOmega) {
    const Seen seen = watch(28, {}, 10);
    double sum = 0.0, visits = 0.0;
    for (std::size_t k = 0; k < seen.profile.slices(); ++k) {
        if (seen.profile.visits(k) == 0.0) continue;
        sum += seen.profile.visits(k) * seen.profile.plain(k).mean;
        visits += seen.profile.visits(k);
    }
    const double all = 28.0 * frames * 10.0;
    EXPECT_EQ(visits + seen.near, all);
    EXPECT_LT(seen.near, 0.03 * all);
    const double rotation = (sum + visits + seen.near_rotation) / all;
    EXPECT_NEAR(rotation, seen.rotation.estimates().mean_by_time.mean, 1e-12);
}

TEST(MeasuredContainer, Slow_PinnedDiscsBehaveAsInThePaper) {
    const Seen few = watch(24, {}, 300), many = watch(48, {}, 300);
    // "The slip parameter of the particles in the pinned region approaches 1 as N is increased."
    EXPECT_GT(row_of(many.slip, "pinned_region").mean, 0.95);
    EXPECT_LT(row_of(many.slip, "pinned_region").mean, 1.02);
    EXPECT_LT(row_of(few.slip, "pinned_region").mean,
              row_of(many.slip, "pinned_region").mean - 0.05);
    // "The local rotation of individual particles along the wall in the pinned area decreases."
    EXPECT_LT(row_of(many.frustration, "pinned_wall_spin").mean,
              0.7 * row_of(few.frustration, "pinned_wall_spin").mean);
    // More of the discs are pinned, and they are earlier in their clockwise cycle (larger θ).
    EXPECT_GT(many.tracks.share().mean, 2.0 * few.tracks.share().mean);
    EXPECT_GT(many.tracks.pinning().angle().mean, few.tracks.pinning().angle().mean + 0.5);
    // The differences are far larger than the errors from the blocks of periods.
    const auto apart = [](const Estimate& a, const Estimate& b) {
        return std::abs(a.mean - b.mean) / std::hypot(a.error, b.error);
    };
    EXPECT_GT(apart(row_of(few.slip, "pinned_region"), row_of(many.slip, "pinned_region")), 10.0);
    EXPECT_GT(apart(row_of(few.frustration, "pinned_wall_spin"),
                    row_of(many.frustration, "pinned_wall_spin")),
              10.0);
    EXPECT_GT(apart(few.tracks.share(), many.tracks.share()), 10.0);
    EXPECT_GT(apart(few.tracks.pinning().angle(), many.tracks.pinning().angle()), 10.0);
    // More contacts are frustrated at larger N.
    EXPECT_GT(apart(row_of(few.frustration, "triangles"), row_of(many.frustration, "triangles")),
              10.0);
    EXPECT_GT(row_of(many.frustration, "triangles").mean,
              row_of(few.frustration, "triangles").mean);
    // Rotation at low N, counterrotation at high N, in both averages and both estimators.
    for (const Estimate& e :
         {few.rotation.estimates().mean_by_event, few.rotation.estimates().rigid_by_time})
        EXPECT_GT(e.mean, 5.0 * e.error);
    for (const Estimate& e :
         {many.rotation.estimates().mean_by_event, many.rotation.estimates().rigid_by_time})
        EXPECT_LT(e.mean, -5.0 * e.error);
}

}  // namespace
}  // namespace swirl
