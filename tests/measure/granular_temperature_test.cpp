#include "swirl/measure/granular_temperature.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "measure/snapshots.hpp"

namespace swirl {
namespace {

/// Discs on the cells' centres that move with the rigid flow plus ±(a, b).
Snapshot jiggling(const SquareGrid& grid, double u, double sign, double mass = 2.0) {
    Snapshot s = empty_container(u);
    const MFrame f = m_frame(s);
    for (std::size_t c = 0; c < grid.cells(); ++c) {
        const Vec2 p = grid.centre_of(c);
        const Vec2 flow = 0.4 * perpendicular(p);
        add_disc(s, f.lab_position(p),
                 s.container_velocity + f.rotate_back(flow + sign * Vec2{0.3, 0.4}),
                 1.0 + 2.0 * sign, 1.0, mass);
    }
    return s;
}

TEST(GranularTemperature, SubtractsTheMeanFlow) {
    GranularTemperature temperature(R, 5, 1);
    for (int k = 0; k < 10; ++k) {
        temperature.sample(jiggling(temperature.grid(), k / 10.0, 1.0));
        temperature.sample(jiggling(temperature.grid(), k / 10.0, -1.0));
        temperature.close_block();
    }
    // ½ m (0.3² + 0.4²) with m = 2; spins 3 and −1 with I = 20: 20 · 2².
    EXPECT_NEAR(temperature.granular().mean, 0.25, 1e-13);
    EXPECT_NEAR(temperature.temperature(7), 0.25, 1e-13);
    EXPECT_NEAR(temperature.of_the_spin().mean, 80.0, 1e-12);
}

// Two discs with the velocities ±2 in one cell, six with ±4 in another: temperatures of ½ 2² = 2
// and ½ 4² = 8. Each disc counts the same, so the average is (2·2 + 6·8)/8.
TEST(GranularTemperature, WeightsCellsWithTheirVisits) {
    Snapshot s = empty_container(0.3);
    const MFrame f = m_frame(s);
    const auto add = [&](const Vec2& place, double speed) {
        add_disc(s, f.lab_position(place), s.container_velocity + f.rotate_back({speed, 0.0}));
    };
    for (const double sign : {1.0, -1.0}) add({-3.0, -3.0}, 2.0 * sign);
    for (int k = 0; k < 3; ++k)
        for (const double sign : {1.0, -1.0}) add({3.0, 3.0}, 4.0 * sign);
    GranularTemperature temperature(R, 2, 1);
    temperature.sample(s);
    temperature.close_block();
    EXPECT_NEAR(temperature.temperature(0), 2.0, 1e-14);
    EXPECT_NEAR(temperature.temperature(3), 8.0, 1e-14);
    EXPECT_NEAR(temperature.granular().mean, 6.5, 1e-14);
}

TEST(GranularTemperature, IsZeroForARigidFlowAndNaNWithoutDiscs) {
    GranularTemperature temperature(R, 5, 1);
    EXPECT_TRUE(std::isnan(temperature.granular().mean));
    EXPECT_TRUE(std::isnan(temperature.of_the_spin().mean));
    const SquareGrid grid = temperature.grid();
    for (int k = 0; k < 4; ++k) {
        Snapshot s = jiggling(grid, 0.25 * k, 0.0);
        temperature.sample(s);
        temperature.close_block();
    }
    EXPECT_NEAR(temperature.granular().mean, 0.0, 1e-13);
}

// The only velocity in a cell is its mean flow.
TEST(GranularTemperature, IsZeroForOneDiscSeenOnce) {
    Snapshot s = empty_container(0.3);
    add_disc(s, {-3.0, -3.0}, {1.5, -0.5});
    GranularTemperature temperature(R, 5, 1);
    temperature.sample(s);
    temperature.close_block();
    EXPECT_NEAR(temperature.granular().mean, 0.0, 1e-14);
}

TEST(GranularTemperature, IsNaNForMissingSpins) {
    GranularTemperature temperature(R, 5, 1);
    Snapshot s = random_discs(5, 1);
    s.spin[2] = not_available;
    temperature.sample(s);
    temperature.close_block();
    EXPECT_TRUE(std::isnan(temperature.of_the_spin().mean));
    EXPECT_FALSE(std::isnan(temperature.granular().mean));
}

TEST(GranularTemperature, AddsTheEnergyMissingInSmoothedVelocities) {
    GranularTemperature temperature(R, 5, 1);
    for (const double sign : {1.0, -1.0})
        temperature.sample(jiggling(temperature.grid(), 0.1, sign));
    temperature.close_block();
    temperature.add_energy(0.125);
    EXPECT_NEAR(temperature.granular().mean, 0.25 + 0.125, 1e-13);
}

}  // namespace
}  // namespace swirl
