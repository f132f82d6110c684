// Trajectories on paths other than the paper's: closed-form answers, and bitwise equality with the
// reference implementation for every vector width.
#include <gtest/gtest.h>

#include <vector>

#include "engine/same_trajectory.hpp"
#include "engine/scenes.hpp"

namespace swirl {
namespace {

/// Discs of a scene, in a container that starts at the beginning of another path.
InitialState on_path(InitialState scene, ContainerPath path) {
    const Segment before = scene.path.segments.front(), first = path.segments.front();
    for (Disc& disc : scene.discs) {
        disc.position = disc.position + (first.start - before.start);
        disc.velocity = disc.velocity + (first.velocity - before.velocity);
    }
    scene.path = std::move(path);
    return scene;
}

ContainerPath lissajous() {
    return sampled_path(paper_period, 60, [](int k) {
        return Vec2{1.9 * unit_circle(2.0 * k / 60.0).x, 1.9 * unit_circle(3.0 * k / 60.0).y};
    });
}
/// Irregular times, a rest in the middle, a reversal, and a start away from the origin.
ContainerPath irregular() {
    return polyline_path({{0.0, {3.0, 1.0}},
                          {0.5, {4.0, 1.0}},
                          {2.5, {4.0, 1.0}},
                          {2.75, {3.5, 0.25}},
                          {7.0, {3.0, -1.0}},
                          {10.0, {3.0, 1.0}}});
}
/// Back and forth between −1 and 1 on the x axis at the speed 1.
ContainerPath back_and_forth() {
    return polyline_path({{0.0, {-1.0, 0.0}}, {2.0, {1.0, 0.0}}, {4.0, {-1.0, 0.0}}});
}
std::vector<ContainerPath> paths() {
    return {lissajous(), irregular(), back_and_forth(),
            mirrored(polygon_path(paper_amplitude, paper_period, paper_sides)),
            mirrored(circular_path(paper_amplitude, paper_period))};
}

TEST(EngineEqualsReferenceOnPaths, ForDiscs) {
    for (const ContainerPath& path : paths())
        for (const std::size_t n : {3u, 45u}) {
            const InitialState scene = on_path(paper_container(n), path);
            expect_same_for_every_width(scene, 2000, tuning());
            expect_same_for_every_width(scene, 2000, tuning(3));
            expect_same_for_every_width(scene, 1000, tuning(SearchMethod::cells));
        }
}
TEST(EngineEqualsReferenceOnPaths, ForSpheresAndCoins) {
    for (const ContainerPath& path : paths()) {
        if (path.segments.front().turn_rate != 0.0) continue;  // no floor on arcs
        expect_same_for_every_width(on_path(sphere_container(28), path), 1000, tuning());
        expect_same_for_every_width(on_path(coin_container(28), path), 1000, tuning());
        expect_same_for_every_width(on_path(sphere_container(28), path), 1000,
                                    tuning(SearchMethod::cells));
    }
}
/// Every disc is a species of its own.
TEST(EngineEqualsReferenceOnPaths, ForManyRadii) {
    std::vector<Disc> discs;
    Random random(5);
    for (int k = 0; k < 40; ++k) {
        const double r = 0.5 + random.uniform();
        discs.push_back({{0, 0}, {0, 0}, 0, 0, 0, r, r * r, 10.0 * r * r * r * r});
    }
    const InitialState scene =
        state_of(discs, discs.size(), 10.0,
                 polygon_path(paper_amplitude, paper_period, paper_sides), 0.7, 0.4);
    expect_same_for_every_width(scene, 5000, tuning());
    expect_same_for_every_width(scene, 5000, tuning(3));
    expect_same_for_every_width(scene, 5000, tuning(SearchMethod::cells));
}

// The container moves at the speed 1 along x and turns at ±1. A smooth elastic disc at rest in the
// middle of it meets the left wall when that has moved by the gap, and leaves at twice its speed.
// All numbers are exact in binary.
TEST(LineAtConstantSpeed, PushesADiscAtTwiceTheSpeedOfTheWall) {
    const double R = 2.0, r = 0.5;
    Disc disc = unit_disc();
    disc.radius = r;
    disc.position = {-1.0, 0.0};  // the gap on either side is 1.5
    const InitialState scene{.discs = {disc},
                             .path = back_and_forth(),
                             .container_radius = R,
                             .disc_surface = {.mu = 0.0},
                             .wall_surface = {.mu = 0.0}};
    Simulation simulation(scene);
    const Event hit = simulation.step();
    EXPECT_EQ(hit.kind, EventKind::disc_wall);
    EXPECT_EQ(hit.clock, R - r);
    EXPECT_EQ(simulation.disc(0).velocity.x, 2.0);
    EXPECT_EQ(simulation.disc(0).velocity.y, 0.0);
    // The momentum that the wall gave, 2 m V.
    EXPECT_EQ(hit.impulse.normal, 2.0);
    const Event turn = simulation.step();
    EXPECT_EQ(turn.kind, EventKind::path_vertex);
    EXPECT_EQ(turn.clock, 2.0);
    // At t = 2 the disc is at x = 0 with velocity 2, and the right wall's contact position is 2.5
    // with velocity −1: contact after 2.5/3, and the velocity becomes 2 (−1) − 2 = −4.
    const Event back = simulation.step();
    EXPECT_EQ(back.kind, EventKind::disc_wall);
    EXPECT_NEAR(back.clock, 2.0 + 2.5 / 3.0, 1e-15 * 4.0);
    EXPECT_EQ(simulation.disc(0).velocity.x, -4.0);
}

// Momentum is that which the wall gave: friction between discs does not change it.
TEST(LineAtConstantSpeed, ChangesMomentumByTheImpulsesOfTheWallOnly) {
    const InitialState scene = on_path(paper_container(20, 1.0, 1.0), back_and_forth());
    Simulation simulation(scene);
    Vec2 momentum{0.0, 0.0}, given{0.0, 0.0};
    for (const Disc& d : scene.discs) momentum = momentum + d.mass * d.velocity;
    for (int k = 0; k < 5000; ++k) {
        const Event e = simulation.step();
        if (e.kind != EventKind::disc_wall) continue;
        // The tangential impulse is along (n_y, −n_x).
        given =
            given - e.impulse.normal * e.normal + e.impulse.tangential * perpendicular(e.normal);
    }
    Vec2 after{0.0, 0.0};
    for (std::size_t i = 0; i < simulation.size(); ++i)
        after = after + simulation.disc(i).mass * simulation.disc(i).velocity;
    // 5000 roundings of numbers up to 100.
    EXPECT_NEAR(after.x - momentum.x, given.x, 1e-10);
    EXPECT_NEAR(after.y - momentum.y, given.y, 1e-10);
}

TEST(Mirrored, PathsGiveMirroredTrajectories) {
    InitialState scene = paper_container(28), mirror = scene;
    mirror.path = mirrored(mirror.path);
    for (Disc& d : mirror.discs) {
        d.position.y = -d.position.y;
        d.velocity.y = -d.velocity.y;
    }
    Simulation a(scene), b(mirror);
    a.run(200);
    b.run(200);
    // The order of roundings differs, and 200 events amplify them.
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_NEAR(a.disc(i).position.x, b.disc(i).position.x, 1e-6);
        EXPECT_NEAR(a.disc(i).position.y, -b.disc(i).position.y, 1e-6);
        EXPECT_NEAR(a.disc(i).spin, -b.disc(i).spin, 1e-6);
    }
}

}  // namespace
}  // namespace swirl
