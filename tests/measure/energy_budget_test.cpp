#include "swirl/measure/energy_budget.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "measure/snapshots.hpp"
#include "swirl/physics/collision_law.hpp"

namespace swirl {
namespace {

/// Two random discs of random mass, or one and the wall, collide by the collision law. Returns the
/// change of K between the snapshots.
struct Case {
    Snapshot after;
    Event event;
    double change;
};

Case collide_at_random(std::uint64_t seed, bool wall, const Surface& surface) {
    Noise noise(seed);
    Snapshot s = empty_container(0.5 + 0.5 * noise());
    const Vec2 n = unit_circle(noise());
    const double r0 = 1.0 + 0.5 * noise(), r1 = 1.0 + 0.5 * noise();
    const Vec2 at = s.container_centre + (wall ? (s.container_radius - r0) * n : Vec2{0, 0});
    add_disc(s, at, {noise(), noise()}, noise(), r0, 2.0 + noise());
    add_disc(s, at + (r0 + r1) * n, {noise(), noise()}, noise(), r1, 2.0 + noise());
    const double before = kinetic_energy(s);

    const auto body = [&](std::size_t i) {
        return Body{s.velocity(i), s.spin[i], s.radius[i], 1.0 / s.mass[i], 1.0 / s.inertia[i]};
    };
    Body a = body(0), b = wall ? wall_body(s.container_velocity) : body(1);
    const Impulse J = collide(a, b, n, surface);
    s.vx[0] = a.velocity.x;
    s.vy[0] = a.velocity.y;
    s.spin[0] = a.spin;
    if (!wall) {
        s.vx[1] = b.velocity.x;
        s.vy[1] = b.velocity.y;
        s.spin[1] = b.spin;
    }
    const EventKind kind = wall ? EventKind::disc_wall : EventKind::disc_disc;
    const Event event{0, s.clock, kind, 0, wall ? 0u : 1u, n, J, 0.0};
    return {s, event, kinetic_energy(s) - before};
}

TEST(EnergyBudget, ClosesForEveryCollision) {
    for (const Surface& surface :
         {Surface{1.0, 1.0, 0.0}, Surface{0.1, 0.9, 0.0}, Surface{0.5, 0.0, 0.5}, Surface{0, 1, 0}})
        for (std::uint64_t seed = 1; seed <= 200; ++seed)
            for (const bool wall : {false, true}) {
                const Case c = collide_at_random(seed, wall, surface);
                const EnergyChange e = energy_change(c.event, c.after);
                // Energies of order 10: a few ulp.
                EXPECT_NEAR(e.work - e.friction_loss - e.inelastic_loss, c.change, 3e-14);
                EXPECT_GE(e.friction_loss, -1e-15);
                EXPECT_GE(e.inelastic_loss, -3e-14);
                if (!wall) {
                    EXPECT_EQ(e.work, 0.0);
                }
                if (surface.mu == 0.0) {
                    EXPECT_EQ(e.friction_loss, 0.0);
                }
                if (surface.restitution == 1.0) {
                    EXPECT_NEAR(e.inelastic_loss, 0.0, 3e-14);
                }
            }
}

TEST(EnergyBudget, ReferenceCollisionLosesTheDocumentedEnergy) {
    // Discs at (0,0) and (0,2), v = (0,1) and (0.5,−1), μ = 1: loses 0.0568181… = 5/88.
    Snapshot s = empty_container();
    add_disc(s, {0.0, 0.0}, {0.0, 1.0});
    add_disc(s, {0.0, 2.0}, {0.5, -1.0});
    Body a{s.velocity(0), 0.0, 1.0, 1.0, 0.1}, b{s.velocity(1), 0.0, 1.0, 1.0, 0.1};
    const Impulse J = collide(a, b, {0.0, 2.0}, Surface{1.0, 1.0, 0.0});
    s.vx = {a.velocity.x, b.velocity.x};
    s.vy = {a.velocity.y, b.velocity.y};
    s.spin = {a.spin, b.spin};
    const EnergyChange e =
        energy_change({0, 0.0, EventKind::disc_disc, 0, 1, {0.0, 1.0}, J, 0.0}, s);
    EXPECT_NEAR(e.friction_loss, 5.0 / 88.0, 1e-16);
    EXPECT_NEAR(e.inelastic_loss, 0.0, 1e-16);
}

TEST(EnergyBudget, PowersArePerTimeAndTotalsAccumulate) {
    EnergyBudget budget;
    double work = 0.0, change = 0.0;
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        const Case c = collide_at_random(seed, true, Surface{1.0, 0.9, 0.0});
        budget.sample_event(c.event, c.after);
        work += energy_change(c.event, c.after).work;
        change += c.change;
        budget.close_event_block(2.0);
    }
    EXPECT_NEAR(row_of(budget, "wall_power").mean, work / 20.0, 1e-15);
    EXPECT_NEAR(budget.accounted(), change, 1e-13);
    EXPECT_EQ(row_of(budget, "disc_friction_power").mean, 0.0);
    EXPECT_GT(row_of(budget, "wall_friction_power").mean, 0.0);
    EXPECT_GT(row_of(budget, "inelastic_power").mean, 0.0);
    EXPECT_TRUE(std::isnan(row_of(EnergyBudget(), "wall_power").mean));
    EnergyBudget twice = budget;
    twice.merge(budget);
    EXPECT_NEAR(row_of(twice, "wall_power").mean, row_of(budget, "wall_power").mean, 1e-15);
    EXPECT_NEAR(twice.total_work(), 2.0 * work, 1e-13);
}

TEST(EnergyBudget, PathVertexChangesNothing) {
    EnergyBudget budget;
    budget.sample_event({0, 0.0, EventKind::path_vertex, 0, 0, {1.0, 0.0}, {1.0, 1.0, false}, 0.0},
                        random_discs(2, 1));
    EXPECT_EQ(budget.accounted(), 0.0);
}

// The impulse acts along the given normal, even if its length is not exactly 1 by rounding. Here it
// is too long by a thousandth, so that an error of the budget is visible.
TEST(EnergyBudget, ClosesForANormalOfAnotherLengthThanOne) {
    const Vec2 n{1.001, 0.0};
    constexpr double J = 0.9;
    Snapshot s = empty_container();
    add_disc(s, {0.0, 0.0}, {1.0, 0.0});
    add_disc(s, {2.0, 0.0}, {0.0, 0.0}, 0.0, 1.0, 2.0);
    const double before = kinetic_energy(s);
    s.vx[0] -= J * n.x;
    s.vx[1] += 0.5 * J * n.x;
    const Event event{0, 0.0, EventKind::disc_disc, 0, 1, n, {J, 0.0, false}, 0.0};
    const EnergyChange change = energy_change(event, s);
    EXPECT_EQ(change.friction_loss, 0.0);
    EXPECT_NEAR(kinetic_energy(s) - before, change.work - change.inelastic_loss, 1e-15);
}

}  // namespace
}  // namespace swirl
