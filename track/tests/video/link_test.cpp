#include "track/video/link.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "swirl/math/random.hpp"
#include "swirl/math/unit_circle.hpp"

namespace swirl::tracking {
namespace link_tests {

/// The best partial assignment: as many pairs as possible, then the least sum.
struct Best {
    std::size_t pairs = 0;
    double sum = 0.0;
};
Best by_trial(const std::vector<std::vector<double>>& cost, std::size_t row,
              std::vector<char>& used) {
    if (row == cost.size()) return {};
    Best best = by_trial(cost, row + 1, used);
    for (std::size_t c = 0; c < used.size(); ++c) {
        if (used[c] || !(std::abs(cost[row][c]) <= 1e100)) continue;
        used[c] = 1;
        Best here = by_trial(cost, row + 1, used);
        used[c] = 0;
        ++here.pairs;
        here.sum += cost[row][c];
        if (here.pairs > best.pairs || (here.pairs == best.pairs && here.sum < best.sum))
            best = here;
    }
    return best;
}

TEST(BestAssignment, MatchesExhaustiveSearchAndTerminatesForAnyCosts) {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    const double odd[] = {std::numeric_limits<double>::quiet_NaN(), infinite, -infinite, 1e300,
                          -1e300};
    Random random(3);
    for (int trial = 0; trial < 500; ++trial) {
        const std::size_t rows = 1 + random.below(5), columns = 1 + random.below(5);
        const std::size_t strange = random.below(6);  // of five costs
        std::vector<std::vector<double>> cost(rows, std::vector<double>(columns));
        for (auto& row : cost)
            for (double& c : row)
                c = random.below(5) < strange ? odd[random.below(5)] : 2.0 * random.uniform() - 1.0;
        const std::vector<int> found = best_assignment(cost);
        std::vector<char> used(columns, 0);
        Best mine;
        for (std::size_t r = 0; r < rows; ++r) {
            if (found[r] < 0) continue;
            const auto c = static_cast<std::size_t>(found[r]);
            ASSERT_LT(c, columns);
            ASSERT_FALSE(used[c]);
            used[c] = 1;
            ++mine.pairs;
            mine.sum += cost[r][c];
        }
        std::vector<char> none(columns, 0);
        const Best best = by_trial(cost, 0, none);
        ASSERT_EQ(mine.pairs, best.pairs);
        // Five costs below 1 next to forbidden ones of at most 18: rounding stays below 1e-13.
        ASSERT_NEAR(mine.sum, best.sum, 1e-12);
    }
}

TEST(BestAssignment, ChecksForAStopInEveryRow) {
    const std::vector<std::vector<double>> cost(9, std::vector<double>(9, 1.0));
    int calls = 0;
    best_assignment(cost, [&] { ++calls; });
    EXPECT_EQ(calls, 9);
    EXPECT_THROW(best_assignment(cost, [] { throw std::runtime_error("stop"); }),
                 std::runtime_error);
}

/// A cluster that rotates about the centre of a swirled container, with so few frames that the
/// nearest disc is the wrong one.
struct Scene {
    TrackedPath path{{200.0, 180.0}, 28.0, 0.2, 0.3, false};
    std::vector<std::vector<DetectedDisc>> frames;
    std::vector<double> times;

    /// `turn`: angular velocity relative to the container, in units of Ω, counter-clockwise.
    Scene(double turn, int count, bool clockwise = false) {
        path.clockwise = clockwise;
        for (int k = 0; k < count; ++k) {
            times.push_back(k);
            std::vector<DetectedDisc> here;
            for (int row = -4; row <= 4; ++row)
                for (int column = -4; column <= 4; ++column) {
                    const Vec2 p{33.0 * (column + 0.5 * (row & 1)) + 3.0 * row, 29.0 * row};
                    if (dot(p, p) > 100.0 * 100.0) continue;
                    const Vec2 u = unit_circle(turn * path.omega * k / (2.0 * pi) -
                                               std::floor(turn * path.omega * k / (2.0 * pi)));
                    // y down: counter-clockwise is x towards −y.
                    const Vec2 at{u.x * p.x + u.y * p.y, -u.y * p.x + u.x * p.y};
                    here.push_back({path.at(k) + at});
                }
            frames.push_back(here);
        }
    }
    LinkSettings settings() const { return {{15.0}, {frames.front().size()}, 0.95}; }
};

/// The number of detections whose track differs from that in the first frame.
int identity_swaps(const Links& links) {
    int count = 0;
    for (const auto& tracks : links.track)
        for (std::size_t d = 0; d < tracks.size(); ++d) count += tracks[d] != links.track[0][d];
    return count;
}

TEST(Linking, FollowsRotationAndCounterrotationAtALowFrameRate) {
    for (const bool clockwise : {false, true})
        for (const double turn : {1.0, 0.5, 0.0, -0.1}) {
            // In an image where the swirl is clockwise, the cluster's rotation is mirrored, too.
            const Scene scene(clockwise ? -turn : turn, 60, clockwise);
            const Links links = link_discs(scene.frames, scene.times, scene.path, scene.settings());
            EXPECT_EQ(identity_swaps(links), 0) << turn << clockwise;
            EXPECT_EQ(links.species.size(), scene.frames.front().size());
        }
}

/// Discs that move independently of each other: each is in every frame at a random point within
/// 0.65 radii of its site. Sites are 2.7 radii apart, so an assignment that confuses discs costs
/// more than the right one. A frame is a fifteenth of a period.
Scene independent_discs(std::uint64_t seed) {
    constexpr double radius = 15.0, spacing = 2.7 * radius, off = 0.65 * radius;
    constexpr double reach = 120.0;  // of the sites
    Scene scene(0.0, 30);
    scene.path.omega = 2.0 * pi / 15.0;
    Random random(seed);
    for (std::size_t k = 0; k < scene.frames.size(); ++k) {
        scene.frames[k].clear();
        for (int row = -3; row <= 3; ++row)
            for (int column = -3; column <= 3; ++column) {
                const Vec2 site = spacing * Vec2{double(column), double(row)};
                if (dot(site, site) < reach * reach)
                    scene.frames[k].push_back(
                        {scene.path.at(double(k)) + site + random.in_disc(off)});
            }
    }
    return scene;
}

TEST(Linking, DiscsThatWereHiddenTogetherArePossibleSwaps) {
    for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
        Scene scene = independent_discs(seed);
        LinkSettings settings = scene.settings();
        settings.gate = 1.4;
        const Links seen = link_discs(scene.frames, scene.times, scene.path, settings);
        EXPECT_EQ(identity_swaps(seen), 0) << seed;
        EXPECT_TRUE(seen.swaps.empty()) << seed;
        // The last two are neighbours.
        for (std::size_t k = 20; k < 25; ++k) scene.frames[k].resize(scene.frames[k].size() - 2);
        const Links links = link_discs(scene.frames, scene.times, scene.path, settings);
        const auto first = std::size_t(links.track[19].end()[-2]),
                   second = std::size_t(links.track[19].back());
        const auto swap =
            std::find_if(links.swaps.begin(), links.swaps.end(), [&](const auto& possible) {
                return possible.frame == 25 &&
                       std::minmax(possible.first, possible.second) == std::minmax(first, second);
            });
        ASSERT_NE(swap, links.swaps.end()) << seed;
        EXPECT_EQ(swap->from, 19u) << seed;
        // At odds of 3 for the given assignment, the chance is 1/(1 + e³).
        EXPECT_GT(swap->chance, 1.0 / (1.0 + std::exp(3.0))) << seed;
        EXPECT_LT(swap->chance, 1.0) << seed;
        EXPECT_TRUE(
            std::is_sorted(links.swaps.begin(), links.swaps.end(),
                           [](const auto& a, const auto& b) { return a.chance > b.chance; }))
            << seed;
    }
}

TEST(Linking, FailsWithAWrongPath) {
    // Shows that the test above can fail: without the container's motion the lattice is linked to
    // its neighbour sites, unless all discs are known to be seen.
    Scene scene(1.0, 40);
    TrackedPath still = scene.path;
    still.amplitude = 0.0;
    still.omega = 1e-9;
    LinkSettings settings = scene.settings();
    settings.numbers.clear();
    const Links links = link_discs(scene.frames, scene.times, still, settings);
    EXPECT_GT(identity_swaps(links), 0);
}

TEST(Linking, ABrieflyHiddenDiscKeepsItsTrack) {
    Scene scene(0.4, 60);
    const std::size_t hidden = 7;
    for (std::size_t k = 20; k < 26; ++k) scene.frames[k].erase(scene.frames[k].begin() + hidden);
    const Links links = link_discs(scene.frames, scene.times, scene.path, scene.settings());
    EXPECT_EQ(links.species.size(), scene.frames.front().size());
    EXPECT_EQ(links.track[59], links.track[0]);
}

TEST(Linking, DiscsCoveredForTwoPeriodsResumeTheirTracks) {
    // For two periods a hand covers the left half, with circles on it that are not discs.
    Scene scene(0.4, 120);
    Random random(5);
    const std::size_t number = scene.frames.front().size();
    for (std::size_t k = 20; k < 82; ++k) {
        auto& here = scene.frames[k];
        std::erase_if(here,
                      [&](const DetectedDisc& d) { return d.position.x < scene.path.centre.x; });
        for (int n = 0; n < 6; ++n)
            here.push_back(
                {scene.path.centre + Vec2{-20.0 * n, 90.0 * random.uniform()}, 0, false});
    }
    const Links links = link_discs(scene.frames, scene.times, scene.path, scene.settings());
    EXPECT_EQ(links.species.size(), number);
    for (std::size_t k = 82; k < 120; ++k) {
        std::vector<int> tracks = links.track[k];
        std::sort(tracks.begin(), tracks.end());
        std::vector<int> all(number);
        std::iota(all.begin(), all.end(), 0);
        EXPECT_EQ(tracks, all) << k;  // each track has exactly one disc
    }
}

TEST(Linking, AStrayTrackReturnsToTheUnexplainedDisc) {
    // One disc is hidden while an unsure detection next to it moves with the container and attracts
    // its track. Then the disc reappears, but another one is hidden, so not all discs are sure.
    Scene scene(0.0, 60);
    const std::size_t lost = 7, other = 0;
    for (std::size_t k = 20; k < 60; ++k) {
        auto& here = scene.frames[k];
        const Vec2 position = here[lost].position;
        here.push_back({position + Vec2{9.0 + 0.5 * double(k - 20), 0.0}, 0, false});
        if (k < 30) here[lost].position = {-1e3, -1e3};
        here[other].position = {-1e3, -1e3};
        here[other].sure = false;
        if (k < 30) here[lost].sure = false;
    }
    const Links links = link_discs(scene.frames, scene.times, scene.path, scene.settings());
    EXPECT_EQ(links.track[59][lost], links.track[0][lost]);
}

TEST(Linking, NumberOfTracksIsLimitedToTheNumberOfDiscs) {
    Scene scene(0.4, 30);
    for (std::size_t k = 10; k < 20; ++k)
        for (const double x : {170.0, 210.0})
            scene.frames[k].push_back({{scene.path.centre.x + x, scene.path.centre.y}});
    const Links links = link_discs(scene.frames, scene.times, scene.path, scene.settings());
    EXPECT_EQ(links.species.size(), scene.frames.front().size());
    EXPECT_EQ(links.rejected, 20u);
    EXPECT_EQ(links.crowded, 10u);  // frames, not detections
    LinkSettings open = scene.settings();
    open.numbers.clear();
    EXPECT_EQ(link_discs(scene.frames, scene.times, scene.path, open).species.size(),
              scene.frames.front().size() + 2);
}

TEST(Linking, CirclesOnAHandAtTheBeginningBecomeNoTracks) {
    // As many detections as discs, but discs 5 to 7 are elsewhere. Then the last one is hidden.
    Scene scene(0.4, 40);
    for (std::size_t k = 0; k < 4; ++k)
        for (std::size_t d = 5; d < 8; ++d)
            scene.frames[k][d].position = {370.0, 40.0 * double(d + k % 2)};
    for (std::size_t k = 4; k < 7; ++k) scene.frames[k].pop_back();
    const Links links = link_discs(scene.frames, scene.times, scene.path, scene.settings());
    EXPECT_EQ(links.species.size(), scene.frames[39].size());
    for (std::size_t k = 4; k < 7; ++k)
        for (std::size_t d = 0; d < scene.frames[k].size(); ++d)
            EXPECT_EQ(links.track[k][d], links.track[39][d]) << k << ", " << d;
}

TEST(Linking, TimesThatDoNotAscendAreRejected) {
    for (const double wrong : {19.0, 18.0, std::numeric_limits<double>::quiet_NaN(),
                               std::numeric_limits<double>::infinity()}) {
        Scene scene(0.4, 40);
        scene.times[20] = wrong;
        EXPECT_THROW(link_discs(scene.frames, scene.times, scene.path, scene.settings()),
                     std::invalid_argument);
    }
}

TEST(Linking, TerminatesForTimeStepsOfAnySize) {
    // Discs cannot be followed across such a step, but each track still has at most one disc.
    for (const double step : {1e-300, 1e-15, 1e15, 1e300})
        for (const bool counted : {true, false}) {
            Scene scene(0.4, 40);
            for (std::size_t k = 20; k < 40; ++k)
                scene.times[k] = scene.times[19] + step + double(k - 20);
            for (std::size_t k = 20; k < 40; ++k)
                if (!(scene.times[k] > scene.times[k - 1]))
                    scene.times[k] = std::nextafter(scene.times[k - 1], 1e308);
            LinkSettings settings = scene.settings();
            if (!counted) settings.numbers.clear();
            const Links links = link_discs(scene.frames, scene.times, scene.path, settings);
            ASSERT_EQ(links.track.size(), 40u);
            for (const auto& tracks : links.track) {
                std::vector<int> sorted;
                for (const int t : tracks)
                    if (t >= 0) sorted.push_back(t);
                std::sort(sorted.begin(), sorted.end());
                EXPECT_EQ(std::adjacent_find(sorted.begin(), sorted.end()), sorted.end());
            }
        }
}

TEST(Linking, StopsOnRequest) {
    const Scene scene(0.4, 40);
    LinkSettings settings = scene.settings();
    int calls = 0;
    settings.throw_if_stopped = [&] {
        if (++calls == 30) throw std::runtime_error("stop");
    };
    EXPECT_THROW(link_discs(scene.frames, scene.times, scene.path, settings), std::runtime_error);
    EXPECT_EQ(calls, 30);
}

}  // namespace link_tests
}  // namespace swirl::tracking
