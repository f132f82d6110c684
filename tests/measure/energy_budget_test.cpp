#include "swirl/measure/energy_budget.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "measure/random_collision.hpp"

namespace swirl {
namespace {

double energy_gained(const RandomCollision& c) {
    return kinetic_energy(c.after) - kinetic_energy(c.before);
}

TEST(EnergyBudget, ClosesForEveryCollision) {
    for (const Surface& surface :
         {Surface{.mu = 1.0}, Surface{.mu = 0.1, .restitution = 0.9},
          Surface{.mu = 0.5, .restitution = 0.0, .tangential_restitution = 0.5},
          Surface{.mu = 0, .restitution = 1, .tangential_restitution = 0}})
        for (std::uint64_t seed = 1; seed <= 200; ++seed)
            for (const bool wall : {false, true}) {
                const RandomCollision c = collide_at_random(seed, wall, surface);
                const EnergyChange e = energy_change(c.event, c.after);
                // Energies of order 10: a few ulp.
                EXPECT_NEAR(e.work - e.friction_loss - e.inelastic_loss, energy_gained(c), 3e-14);
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
    const Impulse J = collide(a, b, {0.0, 2.0}, Surface{.mu = 1.0});
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
        const RandomCollision c =
            collide_at_random(seed, true, Surface{.mu = 1.0, .restitution = 0.9});
        budget.sample_event(c.event, c.after);
        work += energy_change(c.event, c.after).work;
        change += energy_gained(c);
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
