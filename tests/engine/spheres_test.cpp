#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/same_trajectory.hpp"
#include "engine/scenes.hpp"

namespace swirl {
namespace {

/// More spheres than the search of all pairs handles, dense or dilute.
InitialState many_spheres(std::size_t n, double packing, double deceleration) {
    const double R = std::sqrt(static_cast<double>(n) / packing),
                 scale = R / paper_container_radius;
    InitialState scene = state_of(
        {unit_disc(solid_sphere_inertia(1.0, 1.0)), {{0, 0}, {0, 0}, 0, 0, 0, 0.8, 0.5, 0.128}}, n,
        R, polygon_path(scale * paper_amplitude, scale * paper_period, paper_sides), 0.2, 0.3);
    scene.disc_surface =
        scene.wall_surface = {.mu = 0.2, .restitution = 0.9, .contact_duration = 1e-3};
    scene.shape = Shape::sphere;
    scene.floor.deceleration = deceleration;
    return scene;
}
TEST(SpheresEqualReference, InThePaperContainer) {
    for (const std::size_t n : {1u, 2u, 5u, 16u, 17u, 28u, 33u, 48u, 55u})
        expect_same_for_every_width(sphere_container(n), 4000, tuning());
}
TEST(SpheresEqualReference, ForAMixture) {
    expect_same_for_every_width(sphere_mixture(), 10000, tuning());
}
TEST(SpheresEqualReference, WithWeakAndStrongFrictionAgainstTheFloor) {
    for (const double deceleration : {0.0, 1e-3, 0.1, 50.0})
        expect_same_for_every_width(sphere_container(28, deceleration), 4000, tuning());
}
TEST(SpheresEqualReference, WithCells) {
    for (const std::size_t n : {1u, 2u, 5u, 28u, 55u})
        expect_same_for_every_width(sphere_container(n), 3000, tuning(SearchMethod::cells));
    expect_same_for_every_width(sphere_mixture(), 5000, tuning(SearchMethod::cells));
    expect_same_for_every_width(sphere_container(28, 0.0), 3000, tuning(SearchMethod::cells));
    for (const double packing : {0.6, 0.1})
        for (const double deceleration : {0.0, 0.5})
            expect_same_for_every_width(many_spheres(90, packing, deceleration), 2000, tuning());
}
TEST(SpheresEqualReference, ForSpheresAndCoinsThatCannotSpin) {
    for (const std::size_t step : {1u, 3u}) {
        expect_same_for_every_width(with_held_spins(sphere_container(28), step), 10000, tuning());
        expect_same_for_every_width(with_held_spins(sphere_mixture(), step), 10000, tuning());
        expect_same_for_every_width(with_held_spins(coin_container(36), step), 10000, tuning());
    }
}
TEST(SpheresEqualReference, ForCoins) {
    for (const SearchMethod search : {SearchMethod::best, SearchMethod::cells})
        for (const double deceleration : {0.1, 1.92})
            for (const std::size_t n : {1u, 5u, 48u})
                expect_same_for_every_width(coin_container(n, deceleration), 3000, tuning(search));
}
TEST(SpheresEqualReference, WithRollingResistance) {
    for (const SearchMethod search : {SearchMethod::best, SearchMethod::cells})
        for (const double resistance : {0.01, 1.5})
            for (const std::size_t n : {1u, 5u, 28u, 48u})
                expect_same_for_every_width(resisting_container(n, resistance), 3000,
                                            tuning(search));
    InitialState mixture = sphere_mixture();
    mixture.floor.rolling_resistance = 0.1;
    expect_same_for_every_width(mixture, 5000, tuning());
}
TEST(SpheresEqualReference, Slow_OverAHundredThousandEvents) {
    for (const SearchMethod search : {SearchMethod::all_pairs, SearchMethod::cells}) {
        for (const std::size_t n : {1u, 2u, 5u, 28u, 48u})
            expect_same_for_every_width(sphere_container(n), 100000, tuning(search));
        expect_same_for_every_width(sphere_mixture(), 100000, tuning(search));
    }
}

/// Spheres and discs of the same masses and moments of inertia must have bitwise identical
/// positions, velocities and vertical spins.
void expect_spheres_equal_discs(const InitialState& spheres, int events) {
    InitialState discs = spheres;
    discs.shape = Shape::disc;
    Simulation a(discs), b(spheres);
    for (int k = 0; k < fewer_if_sanitized(events); ++k) {
        const Event expected = a.step(), found = b.step();
        ASSERT_TRUE(same_bits(expected.clock, found.clock)) << "event " << k;
        ASSERT_EQ(expected.i, found.i);
        ASSERT_EQ(expected.j, found.j);
    }
    for (std::size_t i = 0; i < discs.discs.size(); ++i) {
        const Disc disc = a.disc(i), sphere = b.disc(i);
        ASSERT_TRUE(same_bits(disc.position.x, sphere.position.x));
        ASSERT_TRUE(same_bits(disc.position.y, sphere.position.y));
        ASSERT_TRUE(same_bits(disc.velocity.x, sphere.velocity.x));
        ASSERT_TRUE(same_bits(disc.velocity.y, sphere.velocity.y));
        ASSERT_TRUE(same_bits(disc.spin, sphere.spin));
        // No torque acts about the horizontal axes.
        ASSERT_EQ(sphere.rolling_spin.x, spheres.discs[i].rolling_spin.x);
        ASSERT_EQ(sphere.rolling_spin.y, spheres.discs[i].rolling_spin.y);
    }
}
TEST(Spheres, EqualDiscsWithoutFloorAndFriction) {
    for (const std::size_t n : {2u, 5u, 28u, 48u}) {
        InitialState spheres = sphere_container(n, 0.0, 0.0);
        for (Disc& d : spheres.discs) d.rolling_spin = {0.7, -0.3};
        expect_spheres_equal_discs(spheres, 20000);
    }
    InitialState mixture = sphere_mixture();
    mixture.floor.deceleration = 0.0;
    mixture.disc_surface.mu = mixture.wall_surface.mu = 0.0;
    expect_spheres_equal_discs(mixture, 20000);
}
TEST(Spheres, EqualDiscsWithoutFloorAndVerticalFriction) {
    for (InitialState spheres : {sphere_container(28, 0.0, 0.5), sphere_mixture()}) {
        spheres.floor.deceleration = 0.0;
        for (Disc& d : spheres.discs) d.rolling_spin = {0.7, -0.3};
        spheres.disc_surface.vertical_friction = spheres.wall_surface.vertical_friction = 0.0;
        expect_spheres_equal_discs(spheres, 20000);
    }
}

TEST(Spheres, AreBitwiseIdenticalAfterResuming) {
    expect_bitwise_identical_after_resuming(sphere_container(40), 30000, 12345);
    expect_bitwise_identical_after_resuming(resisting_container(40, 0.1), 30000, 12345);
}

void expect_refreshed_snapshots_equal_new_ones(const InitialState& scene) {
    Simulation simulation(scene);
    Snapshot refreshed = simulation.snapshot();
    for (int k = 0; k < 3000; ++k) {
        const Event event = simulation.step();
        // Just before the event the snapshot's positions are still valid.
        if (event.kind == EventKind::disc_disc) {
            Snapshot before = refreshed;
            before.clock = event.clock;
            const Vec2 s = before.position(event.j) - before.position(event.i);
            ASSERT_NEAR(std::hypot(s.x, s.y), 2.0, 1e-12);
        }
        simulation.refresh(refreshed, event);
    }
    const Snapshot fresh = simulation.snapshot();
    EXPECT_EQ(refreshed.x, fresh.x);
    EXPECT_EQ(refreshed.vy, fresh.vy);
    EXPECT_EQ(refreshed.ax, fresh.ax);
    EXPECT_EQ(refreshed.spin_x, fresh.spin_x);
    EXPECT_EQ(refreshed.held_at, fresh.held_at);
    const Snapshot now = fresh.up_to_date();
    for (std::size_t i = 0; i < now.size(); ++i) {
        EXPECT_EQ(now.held_at[i], now.clock);
        EXPECT_EQ(now.position(i).x, fresh.position(i).x);
        EXPECT_EQ(now.vx[i], fresh.velocity(i).x);
        EXPECT_EQ(now.rolls(i), fresh.rolls(i));
    }
}
TEST(Spheres, RefreshedSnapshotEqualsANewOneAndPredictsPositions) {
    expect_refreshed_snapshots_equal_new_ones(sphere_container(20));
    expect_refreshed_snapshots_equal_new_ones(resisting_container(20));
}

// Compares the two searches where the reference would take too long.
TEST(Spheres, CellsEqualAllPairsOverManyPeriods) {
    for (const InitialState& scene : {sphere_container(48), coin_container(48),
                                      sphere_container(40, 0.05), resisting_container(48, 0.1)}) {
        Simulation pairs(scene), cells(scene, {}, {0, Width::best, SearchMethod::cells});
        pairs.run(sanitized ? 5000 : 200000);
        cells.run(sanitized ? 5000 : 200000);
        EXPECT_EQ(pairs.state_hash(), cells.state_hash());
    }
}
TEST(Spheres, AreBitwiseIdenticalAfterResumingWithinASegment) {
    expect_bitwise_identical_after_resuming(many_spheres(300, 0.7, 1.0), 30000, 12345);
}

// A coin that never touches the wall soon rests on the floor, in every segment.
TEST(Spheres, CoinAwayFromTheWallMovesWithTheFloor) {
    InitialState scene = coin_container(1);
    scene.discs[0].position = scene.path.segments[0].start;
    scene.discs[0].velocity = scene.path.segments[0].velocity;
    Simulation simulation(scene);
    for (std::size_t k = 1; k < 15; ++k) {
        ASSERT_EQ(simulation.step().kind, EventKind::path_vertex);
        ASSERT_EQ(simulation.step().kind, EventKind::begins_to_roll);
        EXPECT_EQ(simulation.disc(0).velocity.x, scene.path.segments[k].velocity.x);
        EXPECT_EQ(simulation.disc(0).velocity.y, scene.path.segments[k].velocity.y);
    }
}

// It gains 2/7 of every jump of the floor's velocity, as soon as it rolls (floor.hpp).
TEST(Spheres, SphereAwayFromTheWallGainsTwoSeventhsOfTheFloorsVelocity) {
    InitialState scene = sphere_container(1);
    const Vec2 u = scene.path.segments[0].velocity;
    scene.discs[0].position = scene.path.segments[0].start;
    scene.discs[0].velocity = u;
    scene.discs[0].rolling_spin = {0.0, 0.0};
    Simulation simulation(scene);
    Vec2 expected = u;
    for (std::size_t k = 1; k < 15; ++k) {
        ASSERT_EQ(simulation.step().kind, EventKind::path_vertex);
        ASSERT_EQ(simulation.step().kind, EventKind::begins_to_roll);
        const Vec2 jump = scene.path.segments[k].velocity - scene.path.segments[k - 1].velocity;
        expected = expected + 2.0 / 7.0 * jump;
        EXPECT_NEAR(simulation.disc(0).velocity.x, expected.x, 1e-13);
        EXPECT_NEAR(simulation.disc(0).velocity.y, expected.y, 1e-13);
    }
}

// After 2/7 of a jump it rolls with 5/7 of it relative to the floor, and stops before the next
// jump.
TEST(Spheres, RollingResistanceStopsASphereInEverySegment) {
    InitialState scene = resisting_container(1);
    const Vec2 u = scene.path.segments[0].velocity;
    scene.discs[0].position = scene.path.segments[0].start;
    scene.discs[0].velocity = u;
    Simulation simulation(scene);
    for (std::size_t k = 1; k < 15; ++k) {
        ASSERT_EQ(simulation.step().kind, EventKind::path_vertex);
        const double rolls = simulation.step().clock;
        const Event rests = simulation.step();
        ASSERT_EQ(rests.kind, EventKind::begins_to_roll);
        const Vec2 jump = scene.path.segments[k].velocity - scene.path.segments[k - 1].velocity;
        EXPECT_NEAR(rests.clock - rolls, 5.0 / 7.0 * std::hypot(jump.x, jump.y) / (5.0 / 7.0 * 1.5),
                    1e-12);
        EXPECT_EQ(simulation.disc(0).velocity.x, scene.path.segments[k].velocity.x);
        EXPECT_EQ(simulation.disc(0).velocity.y, scene.path.segments[k].velocity.y);
    }
}

// In a container at rest the distance is w²/2a, no matter how often the clocks restart.
TEST(Spheres, RollingResistanceDeterminesTheStoppingDistance) {
    InitialState scene = resisting_container(1, 0.02);
    scene.path = still_path(1.0);
    const double w = 0.3, a = 5.0 / 7.0 * 0.02;
    scene.discs[0].position = {-3.0, 0.0};
    scene.discs[0].velocity = {w, 0.0};
    scene.discs[0].rolling_spin = spin_of_rolling({w, 0.0}, 1.0);
    Simulation simulation(scene);
    int stops = 0;
    while (simulation.periods() < 30) stops += simulation.step().kind == EventKind::begins_to_roll;
    EXPECT_EQ(stops, 1);  // 21 restarts before it
    EXPECT_EQ(simulation.disc(0).velocity.x, 0.0);
    EXPECT_NEAR(simulation.disc(0).position.x, -3.0 + w * w / (2.0 * a), 1e-12);
}

// Its rotation is the distance over the floor, also just after the floor's velocity has changed.
TEST(Spheres, SlowingSphereTurnsByItsDistanceOverTheFloor) {
    InitialState scene = resisting_container(1, 0.5);
    const Segment& segment = scene.path.segments[0];
    const Vec2 w{0.6, 0.0};
    scene.discs[0].position = segment.start;
    scene.discs[0].velocity = segment.velocity + w;
    scene.discs[0].rolling_spin = spin_of_rolling(w, 1.0);
    Simulation simulation(scene);
    Snapshot s = simulation.snapshot();
    s.turned = {Quaternion{}};
    const Event vertex = simulation.step();
    ASSERT_EQ(vertex.kind, EventKind::path_vertex);
    simulation.refresh(s, vertex);
    const double way = 0.6 * segment.end - 0.5 * (5.0 / 7.0 * 0.5) * segment.end * segment.end;
    EXPECT_NEAR(2.0 * std::acos(std::abs(s.turned[0].w)), way, 1e-9);
}

// The limits: very weak friction against the floor is a perturbation of first order; with strong
// friction spheres roll, except for a fraction of the time in proportion to 1/(μ_f g).
TEST(Spheres, SlideFreelyOnAWeakFloorAndRollOnAStrongOne) {
    const auto after = [](double deceleration) {
        Simulation simulation(sphere_container(5, deceleration));
        simulation.advance_to(0, 6.0);
        return simulation.snapshot();
    };
    const Snapshot none = after(0.0);
    const auto distance = [&](double deceleration) {
        const Snapshot s = after(deceleration);
        double maximum = 0.0;
        for (std::size_t i = 0; i < s.size(); ++i) {
            const Vec2 off = s.position(i) - none.position(i);
            maximum = std::max(maximum, std::hypot(off.x, off.y));
        }
        return maximum;
    };
    const double at_1e6 = distance(1e-6);
    EXPECT_GT(at_1e6, 1e-7);  // the effect is ½ a t² = 2·10⁻⁵
    EXPECT_LT(at_1e6, 1e-2);
    // A thousandth of the friction gives a thousandth of the distance, up to its rounding errors.
    EXPECT_NEAR(distance(1e-9) / at_1e6, 1e-3, 1e-5);

    const auto rolling_share = [](double deceleration) {
        Simulation simulation(sphere_container(5, deceleration));
        int rolls = 0, all = 0;
        for (int k = 1; k <= 400; ++k) {
            simulation.advance_to(k / 40, paper_period * (k % 40) / 40.0 + 0.013);
            const Snapshot s = simulation.snapshot();
            for (std::size_t i = 0; i < s.size(); ++i, ++all) {
                const Disc d = s.disc(i);
                const Vec2 c = slip_on_floor(d, s.container_velocity);
                rolls += std::hypot(c.x, c.y) < 1e-12 ? 1 : 0;
            }
        }
        return double(rolls) / all;
    };
    EXPECT_LT(rolling_share(0.01), 0.2);
    EXPECT_GT(rolling_share(100.0), 0.9);
}

// Compares with time steps, in which friction against the floor is a force. The error must decrease
// like the length of a step.
TEST(Spheres, ParabolaAgreesWithTimeSteps) {
    InitialState scene = sphere_container(1, 0.7);
    scene.discs[0].position = scene.path.segments[0].start + Vec2{-1.0, 0.5};
    scene.discs[0].velocity = {0.9, -0.2};
    scene.discs[0].rolling_spin = {0.4, -0.8};
    Simulation simulation(scene);
    simulation.advance_to(0, 0.9);
    const Snapshot exact = simulation.snapshot();
    const auto error = [&](int steps) {
        Disc d = scene.discs[0];
        const double dt = 0.9 / steps;
        for (int k = 0; k < steps; ++k) {
            const Vec2 c = slip_on_floor(d, scene.path.segment_at((k + 0.5) * dt).velocity);
            const double slip = std::hypot(c.x, c.y);
            // The friction acts at most until the slip c is zero. c changes 3.5 times as fast as v.
            const double push = std::min(0.7 * dt, slip / 3.5) / slip;
            d.velocity = d.velocity - push * c;
            d.rolling_spin = d.rolling_spin + 2.5 * Vec2{-push * c.y, push * c.x};
            d.position = d.position + dt * d.velocity;
        }
        const Vec2 off = d.position - exact.position(0);
        return std::hypot(off.x, off.y);
    };
    EXPECT_LT(error(1000), 3e-3);
    EXPECT_LT(error(100000), 3e-5);
}

// With restitution 0 spheres rest at each other and at the wall, separated by less than a rounding
// error. A contact there that changes nothing would repeat without end at the same instant.
TEST(Spheres, WithoutRestitutionDoNotCollideEndlesslyAtOneInstant) {
    for (const std::size_t n : {2u, 20u, 48u}) {
        Simulation simulation(sphere_container(n, 1.92, 0.2, 0.0));
        int at_once = 0, max_at_once = 0;
        double before = 0.0;
        for (int k = 0; k < 60000; ++k) {
            const double now = simulation.step().clock;
            at_once = now == before ? at_once + 1 : 0;
            max_at_once = std::max(max_at_once, at_once);
            before = now;
        }
        EXPECT_LT(max_at_once, 200) << n;
        EXPECT_GT(simulation.clock() + paper_period * double(simulation.periods()),
                  0.5 * paper_period)
            << n;
    }
}

}  // namespace
}  // namespace swirl
