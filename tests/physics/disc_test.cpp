#include "swirl/physics/disc.hpp"

#include <gtest/gtest.h>

namespace swirl {
namespace {

// All numbers have short binary forms, so nothing is rounded.
Disc turning_disc() {
    Disc d{{1.0, -2.0}, {0.5, 0.25}, 3.0, -0.75, 4.0, 2.0, 3.0, 6.0};
    d.last_collision = 1.5;
    return d;
}

TEST(Disc, MovesUniformlyWithConstantSpin) {
    const Disc later = turning_disc().at(8.0);
    EXPECT_EQ(later.position.x, 3.0);
    EXPECT_EQ(later.position.y, -1.0);
    EXPECT_EQ(later.angle, 0.0);
    EXPECT_EQ(later.time, 8.0);
    EXPECT_EQ(later.velocity.x, 0.5);
    EXPECT_EQ(later.spin, -0.75);
    EXPECT_EQ(later.last_collision, 1.5);
}

TEST(Disc, EnergyIncludesTranslationAndAllThreeSpins) {
    Disc d = turning_disc();
    // ½ (3 (0.25 + 0.0625) + 6 · 0.5625).
    EXPECT_EQ(kinetic_energy(d), 2.15625);
    d.rolling_spin = {0.5, -1.0};
    EXPECT_EQ(kinetic_energy(d), 2.15625 + 0.5 * 6.0 * 1.25);
}

TEST(Disc, MomentsOfInertiaAreProportionalToMassAndSquaredRadius) {
    EXPECT_EQ(ring_inertia(3.0, 2.0), 12.0);
    EXPECT_EQ(solid_inertia(3.0, 2.0), 6.0);
}

}  // namespace
}  // namespace swirl
