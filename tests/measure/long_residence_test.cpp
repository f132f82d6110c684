#include "swirl/measure/long_residence.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <utility>
#include <vector>

#include "measure/snapshots.hpp"
#include "swirl/measure/strided.hpp"
#include "swirl/measure/wall_residence.hpp"

namespace swirl {
namespace {

/// One disc, in the wall's layer or inside, at the k-th sample.
MFrameView at_sample(int k, bool at_wall, std::size_t discs = 1) {
    Snapshot s = empty_container(double(k % samples_per_period) / samples_per_period);
    s.periods = k / samples_per_period;
    for (std::size_t i = 0; i < discs; ++i)
        add_disc(s, s.container_centre + (at_wall ? 7.5 : 5.0) * unit_circle(0.3 * double(i)), {});
    return MFrameView(s);
}

/// The samples, of `count`, at which the disc is on a long residence. Each is read as soon as it is
/// known.
std::vector<int> found(int count, const std::function<bool(int)>& at_wall) {
    LongResidences residences;
    std::vector<int> result;
    int asked = 0;
    for (int k = 0; k < count; ++k) {
        residences.sample(at_sample(k, at_wall(k)));
        for (; asked <= k && residences.is_known(at_sample(asked, true).time); ++asked)
            if (residences.resident(0, at_sample(asked, true).time)) result.push_back(asked);
    }
    return result;
}

std::vector<int> from_to(int from, int to) {
    std::vector<int> all;
    for (int k = from; k <= to; ++k) all.push_back(k);
    return all;
}

TEST(LongResidences, CountFromTheFirstSampleToTheLast) {
    EXPECT_EQ(found(300, [](int k) { return k >= 50 && k <= 120; }), from_to(50, 120));
    // Exactly long enough, and one sample too short.
    EXPECT_EQ(found(300, [](int k) { return k >= 50 && k <= 90; }), from_to(50, 90));
    EXPECT_EQ(found(300, [](int k) { return k >= 50 && k <= 89; }), std::vector<int>{});
}

TEST(LongResidences, ShortOnesBetweenDoNotCount) {
    const auto at_wall = [](int k) {
        return (k >= 10 && k <= 60) || (k >= 63 && k <= 70) || (k >= 72 && k <= 130) || k == 140;
    };
    std::vector<int> expected = from_to(10, 60);
    for (const int k : from_to(72, 130)) expected.push_back(k);
    EXPECT_EQ(found(300, at_wall), expected);
}

TEST(LongResidences, ShareEqualsThatOfWallResidences) {
    const auto at_wall = [](int k) { return (k / 37) % 3 == 0 || (k / 61) % 4 == 1; };
    WallResidences residences;
    for (int k = 0; k < 3000; ++k) residences.sample(at_sample(k, at_wall(k)));
    residences.close_block();
    // They differ only by the samples at the end, for which the residence is not yet determined.
    EXPECT_NEAR(residences.share().mean * 3000, double(found(3000, at_wall).size()), 41.0);
}

TEST(LongResidences, OtherDiscsOrDescendingTimesRestart) {
    for (const int how : {0, 1, 2}) {
        LongResidences residences;
        for (int k = 0; k < 60; ++k) residences.sample(at_sample(k, true));
        const double before = at_sample(10, true).time;
        EXPECT_TRUE(residences.is_known(before));
        EXPECT_TRUE(residences.resident(0, before));
        if (how == 0) residences.begin_tracks();
        residences.sample(how == 1 ? at_sample(60, true, 2) : at_sample(how == 2 ? 5 : 60, true));
        // It will never be known, so no measurement waits for it.
        EXPECT_TRUE(residences.is_known(before)) << how;
        EXPECT_FALSE(residences.resident(0, before)) << how;
        EXPECT_FALSE(residences.resident(7, at_sample(60, true).time));
    }
}

// R = 8.6. For a disc of radius 2 the layer begins at 8.6 − 1.5·2 = 5.6, for radius ½ at 7.85.
TEST(WallLayer, IsOneAndAHalfOfTheDiscsOwnRadii) {
    Snapshot s = empty_container();
    for (const auto& [radius, distance] :
         {std::pair{2.0, 5.61}, std::pair{2.0, 5.59}, std::pair{0.5, 7.86}, std::pair{0.5, 7.84}})
        add_disc(s, s.container_centre + Vec2{0.0, distance}, {}, 0.0, radius);
    const MFrameView view(s);
    EXPECT_TRUE(in_wall_layer(view, 0));
    EXPECT_FALSE(in_wall_layer(view, 1));
    EXPECT_TRUE(in_wall_layer(view, 2));
    EXPECT_FALSE(in_wall_layer(view, 3));
}

}  // namespace
}  // namespace swirl
