// Hard discs and spheres do not overlap in 10⁷ events: checked for the pair at each collision, and
// for all pairs at intervals.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "engine/scenes.hpp"

namespace swirl {
namespace {

constexpr double allowed =
    1e-12;  // rounding errors are 10⁻¹⁵ of the container's radius per contact

double deepest_overlap(const Snapshot& s) {
    double deepest = -1.0;
    for (std::size_t i = 0; i < s.size(); ++i) {
        const Vec2 p = s.position(i), from_centre = p - s.container_centre;
        deepest = std::max(
            deepest, std::hypot(from_centre.x, from_centre.y) - (s.container_radius - s.radius[i]));
        for (std::size_t j = i + 1; j < s.size(); ++j) {
            const Vec2 apart = s.position(j) - p;
            deepest = std::max(deepest, s.radius[i] + s.radius[j] - std::hypot(apart.x, apart.y));
        }
    }
    return deepest;
}

void expect_no_overlap_in_all(const InitialState& scene, int events, const Tuning& tuning) {
    Simulation simulation(scene, {}, tuning);
    double deepest = -1.0;
    for (int k = 1; k <= events; ++k) {
        const Event event = simulation.step();
        if (event.kind != EventKind::path_vertex) deepest = std::max(deepest, event.overlap);
        if (k % 10007 == 0) deepest = std::max(deepest, deepest_overlap(simulation.snapshot()));
    }
    EXPECT_LT(deepest, allowed);
    EXPECT_GT(deepest, -1e-12);  // the overlap is zero at contact
}

void expect_no_overlap(const InitialState& scene, int events) {
    expect_no_overlap_in_all(scene, sanitized ? events / 50 : events, {});
}

// The sanitizers check every access and every invariant of these, too (./check --slow).
void run_search(SearchMethod search, const InitialState& scene) {
    expect_no_overlap_in_all(scene, 3'000'000, {.search = search});
}
TEST(Overlap, Slow_SearchAllPairs) { run_search(SearchMethod::all_pairs, paper_container(28)); }
TEST(Overlap, Slow_SearchLists) { run_search(SearchMethod::lists, paper_container(48)); }
TEST(Overlap, Slow_SearchCells) {
    run_search(SearchMethod::cells,
               state_of({unit_disc()}, 200, 30.0, polygon_path(6.6, 41.4, paper_sides), 1.0, 1.0));
}
TEST(Overlap, Slow_SearchFewSpheres) { run_search(SearchMethod::all_pairs, sphere_container(48)); }
TEST(Overlap, Slow_SearchManySpheres) { run_search(SearchMethod::cells, sphere_container(48)); }

TEST(Overlap, NoneWith48DiscsInSixMillionEvents) {
    expect_no_overlap(paper_container(48), 6000000);
}
TEST(Overlap, NoneWith28DiscsInTwoMillionEvents) {
    expect_no_overlap(paper_container(28), 2000000);
}
TEST(Overlap, NoneInAMixture) { expect_no_overlap(mixture_container(), 1000000); }
TEST(Overlap, NoneWithoutFrictionWhereTheEnergyGrows) {
    expect_no_overlap(paper_container(40, 0.0, 0.0), 1000000);
}
TEST(Overlap, NoneWithRollingSpheres) { expect_no_overlap(sphere_container(48), 1000000); }
TEST(Overlap, Slow_NoneWithSpheresAndCoinsInTenMillionEvents) {
    for (const std::size_t n : {5u, 28u, 48u}) expect_no_overlap(sphere_container(n), 10'000'000);
    expect_no_overlap(sphere_container(48, 0.0), 10'000'000);
    expect_no_overlap(sphere_mixture(), 10'000'000);
    expect_no_overlap(coin_container(48), 10'000'000);
}
TEST(Overlap, NoneOnTheExactCircle) {
    InitialState scene = paper_container(28);
    scene.path = circular_path(paper_amplitude, paper_period);
    expect_no_overlap(scene, 100000);
}

}  // namespace
}  // namespace swirl
