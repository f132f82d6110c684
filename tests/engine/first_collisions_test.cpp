// The first collisions from an initial state that is given as numbers, against a stored list of
// partners and times. The other tests compare implementations with each other and final states with
// hashes. This one does not depend on placement and random numbers, and shows the first collision
// that differs.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "engine/grid_reference.hpp"
#include "engine/same_trajectory.hpp"
#include "engine/scenes.hpp"

namespace swirl {
namespace {

// Four for each of 61 discs; the container passes its first vertex at the clock 0.396.
constexpr std::size_t stored_collisions = 120;

/// A triangular lattice in the paper's container, as wide as it fits, with unequal velocities.
InitialState lattice() {
    InitialState scene{.path = polygon_path(paper_amplitude, paper_period, paper_sides),
                       .container_radius = paper_container_radius};
    for (int row = -4; row <= 4; ++row) {
        for (int column = -4; column <= 4; ++column) {
            const Vec2 centre{2.1 * column + (row % 2 ? 1.05 : 0.0), 1.8 * row};
            if (dot(centre, centre) > 7.55 * 7.55) continue;
            const int k = static_cast<int>(scene.discs.size());
            Disc disc = unit_disc();
            disc.position = scene.path.segments[0].start + centre;
            disc.velocity = {(7 * k % 11 - 5) / 64.0, (5 * k % 13 - 6) / 64.0};
            scene.discs.push_back(disc);
        }
    }
    return scene;
}

/// One line per collision: its time, and the discs (j = i at the wall). They all happen in the
/// first period. 17 digits distinguish all doubles.
template <class Engine>
std::vector<std::string> first_collisions(Engine engine) {
    std::vector<std::string> lines;
    while (lines.size() < stored_collisions) {
        const Event event = engine.step();
        if (event.kind == EventKind::path_vertex) continue;
        std::array<char, 80> line{};
        std::snprintf(line.data(), line.size(), "%.17g,%u,%u", event.clock, event.i, event.j);
        lines.emplace_back(line.data());
    }
    return lines;
}

/// The lines of first_collisions() for Reference. A separate program of 60 lines, which advances
/// all discs at every event, gave the same partners and times equal to 4e-12.
std::vector<std::string> stored() {
    std::ifstream file(SWIRL_SOURCE_DIR "/tests/engine/first_collisions.csv");
    std::vector<std::string> lines;
    for (std::string line; std::getline(file, line);) lines.push_back(line);
    return lines;
}

void expect_stored(const std::vector<std::string>& found) {
    const auto expected = stored();
    ASSERT_EQ(expected.size(), stored_collisions);
    for (std::size_t k = 0; k < stored_collisions; ++k)
        ASSERT_EQ(found[k], expected[k]) << "collision " << k;
}

TEST(FirstCollisions, OfTheReferencesAreTheStoredOnes) {
    expect_stored(first_collisions(Reference(lattice())));
    expect_stored(first_collisions(GridReference(lattice())));
}

TEST(FirstCollisions, OfEverySearchAndWidthAreTheStoredOnes) {
    for (const Width width : every_width())
        for (const SearchMethod search :
             {SearchMethod::all_pairs, SearchMethod::lists, SearchMethod::cells})
            expect_stored(first_collisions(Simulation(lattice(), {}, {0, width, search})));
}

}  // namespace
}  // namespace swirl
