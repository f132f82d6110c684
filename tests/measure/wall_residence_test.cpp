#include "swirl/measure/wall_residence.hpp"

#include <gtest/gtest.h>

#include "measure/snapshots.hpp"
#include "swirl/measure/strided.hpp"

namespace swirl {
namespace {

/// A disc at a position in the M-frame, at the k-th sample.
Snapshot at_sample(int k, const std::vector<Vec2>& places) {
    Snapshot s = empty_container(double(k % samples_per_period) / samples_per_period);
    s.periods = k / samples_per_period;
    const MFrame frame = m_frame(s);
    for (const Vec2& p : places) add_disc(s, frame.lab_position(p), frame.lab_velocity(p, {}));
    return s;
}

/// Moves around clockwise once per period, at the wall from 240° to 120° and inside otherwise.
Vec2 rounds(int k, double from = 240.0, double to = 120.0) {
    const double theta =
        std::fmod(3600.0 - 360.0 * (k % samples_per_period) / samples_per_period, 360.0);
    const bool at_wall = theta <= from && theta >= to;
    return (at_wall ? 7.55 : 4.0) * unit_circle(theta / 360.0);
}

TEST(WallResidences, BeginAndEndWhereTheDiscEntersAndLeaves) {
    WallResidences residences;
    for (int k = 0; k < 10 * samples_per_period; ++k) {
        residences.sample(at_sample(k, {rounds(k)}));
        if (k % samples_per_period == samples_per_period - 1) residences.close_block();
    }
    const double a_sample = 360.0 / samples_per_period;
    EXPECT_NEAR(residences.pinning().angle().mean * degrees_per_radian, 240.0, a_sample);
    EXPECT_NEAR(residences.depinning().angle().mean * degrees_per_radian, 120.0, a_sample);
    EXPECT_NEAR(residences.depinning().concentration(), 1.0, 1e-9);
    EXPECT_EQ(residences.depinning().count(), 10.0);
    // The whole residence counts, from its first sample on; it covers 120° of 360°.
    EXPECT_NEAR(residences.share().mean, 1.0 / 3.0, 1.0 / samples_per_period);
    EXPECT_NEAR(residences.length().mean, 1.0 / 3.0, 2.0 / samples_per_period);
}

// Two of three residences are of 120°, a third of a period; one is of 20°, 0.056 periods.
TEST(WallResidences, LengthsHaveADistribution) {
    WallResidences residences;
    for (int k = 0; k < 9 * samples_per_period; ++k) {
        const bool is_short = k / samples_per_period % 3 == 2;
        residences.sample(
            at_sample(k, {is_short ? rounds(k, 200.0, 180.0) : rounds(k, 240.0, 120.0)}));
        if (k % samples_per_period == samples_per_period - 1) residences.close_block();
    }
    EXPECT_NEAR(residences.length_share(6).mean, 2.0 / 3.0, 1e-12);  // 0.30 to 0.35
    EXPECT_NEAR(residences.length_share(1).mean, 1.0 / 3.0, 1e-12);  // 0.05 to 0.10
    double sum = 0.0;
    for (std::size_t bin = 0; bin < WallResidences::length_bins; ++bin)
        sum += residences.length_share(bin).mean;
    EXPECT_NEAR(sum, 1.0, 1e-12);
}

TEST(WallResidences, LayersAre13And15And17RadiiWide) {
    // Between the edges of the layers, 1.3, 1.5 and 1.7 from the wall, 0.01 on either side of them.
    const std::vector<double> distances{1.29, 1.31, 1.49, 1.51, 1.69, 1.71};
    const std::vector<std::size_t> layers{3, 2, 2, 1, 1, 0};  // that contain the disc
    for (std::size_t d = 0; d < distances.size(); ++d) {
        WallResidences residences;
        for (int k = 0; k < samples_per_period; ++k)
            residences.sample(at_sample(k, {{0.0, paper_container_radius - distances[d]}}));
        residences.close_block();
        for (std::size_t layer = 0; layer < 3; ++layer)
            EXPECT_EQ(residences.share(layer).mean > 0.9, layer + layers[d] >= 3) << d << layer;
    }
}

// The minimum lengths are 20, 40 and 80 steps, from the first of 21, 41 and 81 samples to the last.
TEST(WallResidences, MinimumLengthsAre20And40And80Steps) {
    for (const int steps : {19, 20, 39, 40, 79, 80}) {
        WallResidences residences;
        for (int k = 0; k < 200; ++k)
            residences.sample(at_sample(k, {{0.0, k >= 50 && k <= 50 + steps ? 7.6 : 3.0}}));
        residences.close_block();
        for (const std::size_t minimum : {0u, 1u, 2u}) {
            const bool counts = steps >= 20 << minimum;
            const auto layer = WallResidences::standard;
            EXPECT_EQ(residences.depinning(layer, minimum).count(), counts ? 1.0 : 0.0) << steps;
            EXPECT_EQ(residences.pinning(layer, minimum).count(), counts ? 1.0 : 0.0) << steps;
            EXPECT_NEAR(residences.share(layer, minimum).mean, counts ? (steps + 1) / 200.0 : 0.0,
                        1e-15);
        }
    }
}

TEST(WallResidences, LongOnesAreInTheLastBinOfTheLengths) {
    WallResidences residences;
    for (int k = 0; k < 4 * samples_per_period; ++k)  // 3 periods; the last bin begins at 2
        residences.sample(
            at_sample(k, {{0.0, k >= 50 && k < 50 + 3 * samples_per_period ? 7.6 : 3.0}}));
    residences.close_block();
    EXPECT_EQ(residences.length_share(WallResidences::length_bins - 1).mean, 1.0);
    EXPECT_EQ(residences.length_share(0).mean, 0.0);
}

TEST(WallResidences, OneThatBeganBeforeTheFirstSampleHasNoBeginning) {
    WallResidences residences;
    for (int k = 0; k < 200; ++k)
        residences.sample(at_sample(k, {(k < 100 ? 7.6 : 3.0) * unit_circle(0.25)}));
    residences.close_block();
    EXPECT_EQ(residences.pinning().count(), 0.0);
    EXPECT_EQ(residences.depinning().count(), 1.0);
    EXPECT_NEAR(residences.share().mean, 0.5, 1e-12);
}

TEST(WallResidences, ChangeOfTheNumberOfDiscsRestarts) {
    WallResidences residences;
    for (int k = 0; k < 30; ++k) residences.sample(at_sample(k, {{0.0, 7.6}}));
    for (int k = 30; k < 60; ++k) residences.sample(at_sample(k, {{0.0, 7.6}, {0.0, 0.0}}));
    for (int k = 60; k < 70; ++k) residences.sample(at_sample(k, {{0.0, 0.0}, {3.0, 0.0}}));
    residences.close_block();
    EXPECT_EQ(residences.depinning().count(), 0.0);  // 30 samples each time
}

}  // namespace
}  // namespace swirl
