#include "swirl/measure/radial_density.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "measure/snapshots.hpp"

namespace swirl {
namespace {

TEST(RadialDensity, UniformPointsAreFlat) {
    RadialDensity density(10.0, 10);
    // In ring k, 2k + 1 points for every point in ring 0: as the areas.
    Snapshot s = empty_container(0.3);
    s.container_radius = 10.0;
    for (int ring = 0; ring < 10; ++ring)
        for (int k = 0; k < 4 * (2 * ring + 1); ++k)
            add_disc(s, s.container_centre + (ring + 0.5) * unit_circle(k / (4.0 * (2 * ring + 1))),
                     {0.0, 0.0});
    for (int k = 0; k < 3; ++k) {
        density.sample(s);
        density.close_block();
    }
    double sum = 0.0;
    for (std::size_t k = 0; k < density.rings(); ++k) {
        EXPECT_NEAR(density.density(k).mean, 4.0 / pi, 1e-13);
        EXPECT_NEAR(density.density(k).error, 0.0, 1e-7);
        sum += density.density(k).mean * density.area(k);
    }
    EXPECT_NEAR(sum, 400.0, 1e-10);
}

TEST(RadialDensity, IsNaNWithoutSamplesAndZeroInAnEmptyRing) {
    RadialDensity density(8.6);
    EXPECT_TRUE(std::isnan(density.density(0).mean));
    density.sample(empty_container());
    density.close_block();
    EXPECT_EQ(density.density(0).mean, 0.0);
}

}  // namespace
}  // namespace swirl
