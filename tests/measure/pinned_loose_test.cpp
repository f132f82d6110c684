#include "swirl/measure/pinned_loose.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "measure/snapshots.hpp"

namespace swirl {
namespace {

constexpr int frames = 511;
constexpr double degree = pi / 180.0;

/// The container at frame `k`, with discs at path(k) in the M-frame.
template <class Path>
Snapshot frame_of(int k, std::size_t discs, Path&& path) {
    Snapshot s = empty_container(static_cast<double>(k % frames) / frames);
    s.periods = k / frames;
    const MFrame f = m_frame(s);
    for (std::size_t i = 0; i < discs; ++i) add_disc(s, f.lab_position(path(i, k)), {0.0, 0.0});
    return s;
}

/// A simplified form of the paper's cycle: clockwise along the wall with its speed from θ = 180° to
/// 60°, then smoothly off the wall and down to 240°, then a sharp turn back along the wall to 180°.
Vec2 cycle(double k) {
    const double r = 7.0;
    const int along = static_cast<int>(120.0 / 360.0 * frames);  // the wall's own speed
    const int across = 100, back = 43;
    const double phase = std::fmod(k, along + across + back);
    const Vec2 leave = r * unit_circle(60.0 / 360.0), arrive = r * unit_circle(240.0 / 360.0);
    if (phase < along) return r * unit_circle(0.5 - phase / frames);
    if (phase < along + across) {
        const double t = phase - along, end = across;
        const Vec2 v = (-2.0 * pi / frames) * perpendicular(leave);
        const Vec2 a = (2.0 / (end * end)) * (arrive - leave - end * v);
        return leave + t * v + (0.5 * t * t) * a;
    }
    return r * unit_circle((240.0 - 60.0 * (phase - along - across) / back) / 360.0);
}

TEST(PinnedLoose, ADiscThatMovesWithTheWallIsPinned) {
    PinnedLoose pinning;
    for (int k = 0; k < 60; ++k) {
        pinning.sample(frame_of(k, 2, [](std::size_t i, int t) {
            return (5.0 + static_cast<double>(i)) * unit_circle(1.0 - static_cast<double>(t) / 511);
        }));
        // 15 frames to fit, and parallel for 8 of them.
        EXPECT_EQ(pinning.pinned().at(0), k >= 21 ? 1 : 0) << k;
    }
    pinning.close_block();
    EXPECT_EQ(pinning.depinning().count(), 0.0);
    EXPECT_EQ(pinning.pinning().count(), 0.0);
    EXPECT_NEAR(pinning.share().mean, 39.0 / 46.0, 1e-15);
}

// The numbers of frames in the criteria are those at 511 frames per period. At other rates they are
// the same times, so the same motion gives the same results.
TEST(PinnedLoose, CriteriaAreTimesAtAnyFrameRate) {
    const auto found_at = [](int per_frame) {
        PinnedLoose pinning(frame_window(511.0 * per_frame));
        for (int k = 0; k < 5 * 313 * per_frame; ++k) {
            const double time = static_cast<double>(k) / per_frame;  // unit: 511ths of a period
            Snapshot s = empty_container(std::fmod(time, frames) / frames);
            s.periods = static_cast<std::int64_t>(time) / frames;
            add_disc(s, m_frame(s).lab_position(cycle(time)), {0.0, 0.0});
            pinning.sample(s);
        }
        pinning.close_block();
        return pinning;
    };
    const PinnedLoose standard = found_at(1);
    ASSERT_GT(standard.depinning().count(), 2.0);
    for (const int per_frame : {2, 4}) {
        const PinnedLoose fast = found_at(per_frame);
        EXPECT_EQ(fast.depinning().count(), standard.depinning().count()) << per_frame;
        // A change is seen up to a frame earlier: 1/511 of a period is 0.7°, or 0.3 % of a cycle.
        EXPECT_NEAR(fast.depinning().angle().mean, standard.depinning().angle().mean, 0.8 * degree);
        EXPECT_NEAR(fast.share().mean, standard.share().mean, 0.01) << per_frame;
    }
}

TEST(PinnedLoose, ADiscThatMovesAgainstTheWallOrAcrossIsLoose) {
    PinnedLoose pinning;
    for (int k = 0; k < 60; ++k)
        pinning.sample(frame_of(k, 2, [](std::size_t i, int t) {
            return i == 0 ? 5.0 * unit_circle(static_cast<double>(t) / 511)
                          : Vec2{0.1 * t - 3.0, 0.2};
        }));
    EXPECT_EQ(pinning.pinned().at(0), 0);
    EXPECT_EQ(pinning.pinned().at(1), 0);
}

TEST(PinnedLoose, FindsTheAnglesOfAKnownCycle) {
    PinnedLoose pinning;
    for (int k = 0; k < 20 * frames; ++k) {
        pinning.sample(frame_of(k, 1, [](std::size_t, int t) { return cycle(t); }));
        if (k % frames == frames - 1) pinning.close_block();
    }
    // Its direction is 10° off only some time after it left the wall.
    EXPECT_NEAR(pinning.depinning().angle().mean, 52.0 * degree, 10.0 * degree);
    EXPECT_GT(pinning.depinning().concentration(), 0.99);
    // The only sharp turn of the cycle.
    EXPECT_NEAR(pinning.pinning().angle().mean, 240.0 * degree, 2.0 * degree);
    // It reaches 240° from below: all turns are in the two slices next to it.
    EXPECT_EQ(pinning.pinned_positions().share(23) + pinning.pinned_positions().share(24), 1.0);
    EXPECT_GT(pinning.free_positions().share(4) + pinning.free_positions().share(5), 0.99);
    EXPECT_EQ(pinning.breaks(), 0.0);
}

// The SI's two numbers, each with a motion on either side of it.
TEST(PinnedLoose, DeviationIsTenDegrees) {
    for (const double angle : {9.8, 10.2}) {
        // A spiral: its direction is always off the azimuthal one by this angle. The line that is
        // fitted to 15 frames has that of the spiral to 0.01°.
        const double growth = std::tan(angle * degree) * 2.0 * pi / frames;
        PinnedLoose pinning;
        for (int k = 0; k < 40; ++k)
            pinning.sample(frame_of(k, 1, [&](std::size_t, int t) {
                return 4.0 * std::exp(growth * t) * unit_circle(1.0 - double(t) / frames);
            }));
        EXPECT_EQ(pinning.pinned().at(0), angle < 10.0 ? 1 : 0) << angle;
    }
}
TEST(PinnedLoose, SharpTurnChangesTheVelocityByHalfTheSpeedOfTheWall) {
    for (const double change : {0.49, 0.51}) {
        const double step = change * paper_container_radius * 2.0 * pi / frames;
        PinnedLoose pinning;
        for (int k = 0; k < 40; ++k)  // rest, then outwards
            pinning.sample(frame_of(k, 1, [&](std::size_t, int t) {
                return Vec2{1.0 + step * std::max(t - 20, 0), 0};
            }));
        pinning.close_block();
        EXPECT_EQ(pinning.pinning().count(), change < 0.5 ? 0.0 : 1.0) << change;
    }
}

TEST(PinnedLoose, RunningFitEqualsTheFitFromScratch) {
    // A long track: pinned or not must not depend on how long ago the track began.
    const auto path = [](std::size_t i, int t) {
        return (3.0 + 0.5 * static_cast<double>(i)) *
               unit_circle(1.0 - 0.3 * std::sin(0.01 * t * (1.0 + 0.1 * static_cast<double>(i))));
    };
    PinnedLoose all, late;
    for (int k = 0; k < 5000; ++k) {
        const Snapshot s = frame_of(k, 8, path);
        all.sample(s);
        if (k >= 4100) late.sample(s);
        if (k > 4200) {
            EXPECT_EQ(all.pinned(), late.pinned()) << k;
        }
    }
}

TEST(PinnedLoose, BriefDeviationIsNotBecomingFree) {
    // Along the wall, with a short kink: the fit leaves the azimuthal direction for a few frames
    // only.
    const auto wobble = [](std::size_t, int t) {
        const double kink = t >= 100 && t < 103   ? 0.12 * (t - 99)
                            : t >= 103 && t < 106 ? 0.12 * (106 - t)
                                                  : 0.0;
        return (6.0 - kink) * unit_circle(1.0 - static_cast<double>(t) / 511);
    };
    PinnedLoose pinning;
    bool ever_loose = false;
    for (int k = 0; k < 300; ++k) {
        pinning.sample(frame_of(k, 1, wobble));
        if (k > 30) ever_loose = ever_loose || pinning.pinned().at(0) == 0;
    }
    pinning.close_block();
    EXPECT_TRUE(ever_loose);
    EXPECT_EQ(pinning.depinning().count(), 0.0);
}

TEST(PinnedLoose, UnevenTimesBreakTheTracks) {
    PinnedLoose pinning;
    const auto circle = [](std::size_t, int t) {
        return 6.0 * unit_circle(1.0 - static_cast<double>(t) / 511);
    };
    for (int k = 0; k < 40; ++k) pinning.sample(frame_of(k, 1, circle));
    EXPECT_EQ(pinning.pinned().at(0), 1);
    pinning.sample(frame_of(20, 1, circle));  // back in time
    EXPECT_EQ(pinning.breaks(), 1.0);
    EXPECT_EQ(pinning.pinned().at(0), 0);
    pinning.sample(frame_of(21, 1, circle));
    pinning.sample(frame_of(25, 1, circle));  // frames missing
    EXPECT_EQ(pinning.breaks(), 2.0);
    for (int k = 26; k < 50; ++k) pinning.sample(frame_of(k, 1, circle));
    EXPECT_TRUE(pinning.is_known());
    pinning.begin_tracks();  // one disc, but a different one
    pinning.sample(frame_of(50, 1, circle));
    EXPECT_EQ(pinning.breaks(), 3.0);
    EXPECT_FALSE(pinning.is_known());
    EXPECT_EQ(pinning.pinned().at(0), 0);
    pinning.sample(frame_of(51, 3, circle));  // another number of discs
    EXPECT_EQ(pinning.pinned().size(), 3u);
    pinning.sample(empty_container());
    EXPECT_TRUE(pinning.pinned().empty());
}

Event collision_at(EventKind kind, std::uint32_t i, std::uint32_t j) {
    return {0, 0.0, kind, i, j, {1.0, 0.0}, {1.0, 0.0, false}, 0.0};
}

TEST(PinnedByCollisions, LongestFlightOfAPeriodCounts) {
    PinnedByCollisions pinning;
    const auto at = [&](double u, double theta) {
        Snapshot s = empty_container(u);
        const MFrame f = m_frame(s);
        add_disc(s, f.lab_position(7.0 * unit_circle(theta)), {0.0, 0.0});
        return s;
    };
    const auto hit = [&](double u, double theta) {
        pinning.sample_event(collision_at(EventKind::disc_wall, 0, 0), at(u, theta));
    };
    hit(0.10, 0.30);  // the first has no flight before it
    hit(0.12, 0.28);
    hit(0.16, 0.25);
    hit(0.30, 0.70);  // 0.14 T in the air, from 0.25 to 0.70 turns: the longest
    pinning.sample_event(collision_at(EventKind::path_vertex, 0, 0), at(0.31, 0.0));
    hit(0.34, 0.65);
    pinning.close_block();
    EXPECT_EQ(pinning.depinning().count(), 1.0);
    EXPECT_NEAR(pinning.depinning().angle().mean, 0.25 * 2.0 * pi, 1e-14);
    EXPECT_NEAR(pinning.pinning().angle().mean, 0.70 * 2.0 * pi, 1e-14);
    pinning.close_block();  // a period without a collision adds nothing
    EXPECT_EQ(pinning.depinning().count(), 1.0);
}

TEST(PinnedByCollisions, BothPartnersCountAndFlightsContinueAcrossPeriods) {
    PinnedByCollisions pinning;
    Snapshot s = empty_container(0.95);
    const MFrame f = m_frame(s);
    add_disc(s, f.lab_position({1.0, 0.0}), {0.0, 0.0});
    add_disc(s, f.lab_position({3.0, 0.0}), {0.0, 0.0});
    pinning.sample_event(collision_at(EventKind::disc_disc, 0, 1), s);
    Snapshot t = empty_container(0.05);
    t.periods = 1;
    const MFrame g = m_frame(t);
    add_disc(t, g.lab_position({0.0, 1.0}), {0.0, 0.0});
    add_disc(t, g.lab_position({0.0, 3.0}), {0.0, 0.0});
    pinning.sample_event(collision_at(EventKind::disc_disc, 0, 1), t);
    pinning.close_block();
    EXPECT_EQ(pinning.pinning().count(), 2.0);
    EXPECT_NEAR(pinning.pinning().angle().mean, 0.5 * pi, 1e-14);
}

TEST(PinnedByCollisions, IsConsistent) {
    PinnedByCollisions pinning;
    EXPECT_TRUE(pinning.is_consistent());
    pinning.sample_event(collision_at(EventKind::disc_wall, 0, 0), random_discs(3, 1));
    EXPECT_TRUE(pinning.is_consistent());
}

}  // namespace
}  // namespace swirl
