#include "swirl/measure/torque_budget.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "measure/random_collision.hpp"
#include "swirl/measure/coarse_graining.hpp"

namespace swirl {
namespace {

TEST(TorqueBudget, ClosesForEveryCollision) {
    for (const Surface& surface :
         {Surface{.mu = 1.0},
          Surface{.mu = 0.1, .restitution = 0.9, .tangential_restitution = 0.3}})
        for (std::uint64_t seed = 1; seed <= 200; ++seed)
            for (const bool wall : {false, true}) {
                const RandomCollision c = collide_at_random(seed, wall, surface);
                const AngularImpulse t = angular_impulse(c.event, c.after);
                const AngularMomentum before = angular_momentum(c.before),
                                      after = angular_momentum(c.after);
                // Angular momenta of order 100: a few ulp.
                constexpr double rounding = 2e-13;
                EXPECT_NEAR(t.wall_normal + t.wall_tangential + t.transfer,
                            after.orbital - before.orbital, rounding);
                EXPECT_NEAR(t.wall_on_spins + t.discs_on_spins, after.spins - before.spins,
                            rounding);
                // In the frame of the container, whose velocity is the same before and after.
                EXPECT_NEAR(t.wall_about_centre + t.transfer,
                            after.about_centre - before.about_centre, rounding);
                // Friction between discs only moves angular momentum. What holds a disc that cannot
                // spin takes its torque.
                const bool spins = c.after.inverse_inertia(0) != 0.0;
                const Transfer whole = transfer_of(c.event, c.after);
                EXPECT_NEAR(t.transfer + t.discs_on_spins, wall ? 0.0 : -whole.taken_up, rounding);
                EXPECT_EQ(whole.taken_up != 0.0, !spins && c.event.impulse.normal > 0.0);
                const bool approached = c.event.impulse.normal > 0.0;
                EXPECT_EQ(t.transfer != 0.0, approached && !wall);
                EXPECT_EQ(t.wall_on_spins != 0.0, approached && wall && spins);
            }
}

TEST(TorqueBudget, ReferenceCollisionsGiveTheDocumentedSpins) {
    // Discs at (0,0) and (0,2), v = (0,1) and (0.5,−1), μ = 1: both spins become −0.25/11. The wall
    // at (7.6,0), v = (1,0.3): the spin becomes −0.3/11. I = 10.
    Snapshot s = empty_container();
    add_disc(s, {0.0, 0.0}, {0.0, 1.0});
    add_disc(s, {0.0, 2.0}, {0.5, -1.0});
    Body a{s.velocity(0), 0.0, 1.0, 1.0, 0.1}, b{s.velocity(1), 0.0, 1.0, 1.0, 0.1};
    const Impulse discs = collide(a, b, {0.0, 2.0}, Surface{.mu = 1.0});
    const AngularImpulse pair =
        angular_impulse({0, s.clock, EventKind::disc_disc, 0, 1, {0.0, 1.0}, discs, 0.0}, s);
    EXPECT_NEAR(pair.discs_on_spins, 2.0 * 10.0 * -0.25 / 11.0, 1e-15);
    EXPECT_NEAR(pair.transfer, 2.0 * 10.0 * 0.25 / 11.0, 1e-15);

    Snapshot one = empty_container();
    one.container_centre = one.container_velocity = {0.0, 0.0};
    add_disc(one, {7.6, 0.0}, {-1.0, 0.3 / 11.0});
    Body disc{{1.0, 0.3}, 0.0, 1.0, 1.0, 0.1}, wall = wall_body({0.0, 0.0});
    const Impulse J = collide(disc, wall, {7.6, 0.0}, Surface{.mu = 1.0});
    const AngularImpulse t =
        angular_impulse({0, one.clock, EventKind::disc_wall, 0, 0, {1.0, 0.0}, J, 0.0}, one);
    EXPECT_NEAR(t.wall_on_spins, 10.0 * -0.3 / 11.0, 1e-15);
    // The only disc is its own centre of mass; about C the lever is R − r.
    EXPECT_EQ(t.wall_normal, 0.0);
    EXPECT_EQ(t.wall_tangential, 0.0);
    EXPECT_NEAR(t.wall_about_centre, 7.6 * (0.3 / 11.0 - 0.3), 1e-15);
}

TEST(TorqueBudget, RowsArePerTimeAndTheProfileSumsToThem) {
    TorqueBudget budget, twice;
    AngularImpulse sum;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const RandomCollision c =
            collide_at_random(seed, seed % 2 == 0, Surface{.mu = 1.0, .restitution = 0.9});
        const AngularImpulse t = angular_impulse(c.event, c.after);
        sum.wall_normal += t.wall_normal;
        sum.wall_tangential += t.wall_tangential;
        sum.transfer += t.transfer;
        budget.sample_event(c.event, c.after);
        budget.close_event_block(2.0);
    }
    twice = budget;
    twice.merge(budget);
    for (const TorqueBudget& b : {budget, twice}) {
        // Sums of twenty numbers of order 10.
        EXPECT_NEAR(row_of(b, "wall_normal").mean, sum.wall_normal / 40.0, 1e-13);
        EXPECT_NEAR(row_of(b, "wall_tangential").mean, sum.wall_tangential / 40.0, 1e-13);
        EXPECT_NEAR(row_of(b, "transfer").mean, sum.transfer / 40.0, 1e-13);
        for (const char* part : {"wall", "transfer"}) {
            const std::string name = part;
            const std::string whole = name == "wall" ? "wall_tangential" : name;
            EXPECT_NEAR(row_of(b, name + "_sticking").mean + row_of(b, name + "_sliding").mean,
                        row_of(b, whole).mean, 1e-13);
        }
        Report report;
        b.report(report);
        double profile[3] = {0.0, 0.0, 0.0};
        const ReportTable& table = report.tables.front();
        for (std::size_t r = 0; r < table.rows(); ++r)
            for (std::size_t k = 0; k < 3; ++k) profile[k] += table.at(r, 1 + 2 * k);
        EXPECT_NEAR(profile[0], sum.wall_normal / 40.0, 1e-13);
        EXPECT_NEAR(profile[1], sum.wall_tangential / 40.0, 1e-13);
        EXPECT_NEAR(profile[2], sum.transfer / 40.0, 1e-13);
    }
    // A budget without events takes over the rows of the one that is merged.
    TorqueBudget first;
    first.merge(budget);
    const double unaccounted = row_of(budget, "unaccounted_share").mean;
    EXPECT_GE(unaccounted, 0.0);
    EXPECT_EQ(row_of(first, "unaccounted_share").mean, unaccounted);
    EXPECT_TRUE(std::isnan(row_of(TorqueBudget(), "orbital").mean));
    EXPECT_TRUE(std::isnan(row_of(TorqueBudget(), "unaccounted_share").mean));
}

// Disc 0 stays at the wall, disc 1 in the middle; both collide with the wall and with each other
// once per sample, with known impulses.
TEST(TorqueBudget, PinnedDiscsAreThoseOnALongResidenceAtTheTimeOfTheCollision) {
    TorqueBudget budget;
    LongResidences residences;
    for (int k = 0; k < 400; ++k) {
        Snapshot s = empty_container(static_cast<double>(k) / 511.0);
        const MFrame frame = m_frame(s);
        add_disc(s, frame.lab_position({7.5, 0.0}), {0.0, 0.0});
        add_disc(s, frame.lab_position({0.0, 3.0}), {0.0, 0.0});
        residences.sample(MFrameView(s));
        const Vec2 n = frame.rotate_back({1.0, 0.0});
        const auto collide = [&](EventKind kind, std::uint32_t i, std::uint32_t j, double J) {
            budget.sample_event({0, s.clock, kind, i, j, n, {0.0, J, false}, 0.0}, s);
        };
        collide(EventKind::disc_wall, 0, 0, 1.0);
        collide(EventKind::disc_wall, 1, 1, 10.0);
        collide(EventKind::disc_disc, 0, 1, 100.0);
        budget.sample_residences(residences);
        budget.close_event_block(paper_period / 511.0);
    }
    // (0,3) − (7.5,0) and half of that, times the tangent (0,−1), times J.
    const double per_sample = 511.0 / paper_period;
    const auto expect = [&](const char* name, double value) {
        // The times, of order 10, have a rounding error of 10⁻¹⁵, the samples are 0.02 apart.
        EXPECT_NEAR(row_of(budget, name).mean, value * per_sample,
                    1e-10 * std::abs(value) * per_sample)
            << name;
    };
    expect("wall_tangential_pinned", 3.75);
    expect("wall_tangential_loose", -37.5);
    expect("transfer_mixed", 750.0);
    expect("transfer", 750.0);
    expect("transfer_pinned", 0.0);
    expect("transfer_loose", 0.0);
    expect("wall_normal_pinned", 0.0);
}

TEST(TorqueBudget, IsNotAvailableForSpheres) {
    Snapshot s = empty_container();
    s.resize_for_spheres(1);
    s.set(0, {{7.6, 0.0}, {1.0, 0.0}, 0.0, 0.0, 0.0, 1.0, 1.0, 0.4});
    TorqueBudget budget;
    budget.sample_event({0, 0.0, EventKind::disc_wall, 0, 0, {1.0, 0.0}, {1.0, 1.0, false}, 0.0},
                        s);
    budget.close_event_block(1.0);
    Report report;
    budget.report(report);
    for (const ReportRow& row : report.rows) EXPECT_TRUE(std::isnan(row.estimate.mean)) << row.name;
}

}  // namespace
}  // namespace swirl
