#include <gtest/gtest.h>

#include <cmath>

#include "math/deviate.hpp"
#include "swirl/math/random.hpp"
#include "swirl/math/unit_circle.hpp"
#include "track/video/contact_distance.hpp"
#include "track/video/tracking_steps.hpp"

namespace swirl::tracking {
namespace wall_bounces_tests {

/// A disc of radius 15 pixels that flies freely in a swirled container and bounces off its wall,
/// about four times per period.
TrackedVideo bouncing_disc(std::uint64_t seed, double noise) {
    constexpr std::size_t frames = 480;
    constexpr int steps = 50;  // per frame
    constexpr double radius = 15.0, container = 130.0, speed = 8.0;
    TrackedVideo tracked;
    tracked.path.centre = {200.0, 200.0};
    tracked.path.amplitude = 5.0;
    tracked.path.omega = 2.0 * pi / 120.0;
    tracked.radius = radius;
    tracked.number = 1;
    tracked.rim_radius = 136.0;  // the outer edge of the wall
    tracked.errors.assign(frames, {0.05});
    tracked.seen.assign(frames, {1});
    Random random(seed);
    Vec2 p = tracked.path.centre, v = speed * unit_circle(random.uniform());
    for (std::size_t k = 0; k < frames; ++k) {
        tracked.times.push_back(double(k));
        TrackFrame f;
        f.id = {0};
        f.position = {p + noise * Vec2{deviate(random), deviate(random)}};
        f.radius = {radius};
        tracked.tracks.frames.push_back(f);
        for (int s = 0; s < steps; ++s) {
            const double now = double(k) + double(s) / steps;
            p = p + (1.0 / steps) * v;
            const Vec2 out = p - tracked.path.at(now);
            const Vec2 wall =
                0.5 * steps *
                (tracked.path.at(now + 1.0 / steps) - tracked.path.at(now - 1.0 / steps));
            const Vec2 n = (1.0 / length(out)) * out;
            const double approach = dot(v - wall, n);
            if (length(out) > container - radius && approach > 0.0) v = v - 2.0 * approach * n;
        }
    }
    return tracked;
}

TEST(WallBounces, GiveTheContainerRadiusOfFewDiscs) {
    for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
        TrackedVideo tracked = bouncing_disc(seed, 0.15);
        measure_quality(Detections(tracked.times.size()), tracked);
        EXPECT_TRUE(tracked.wall_reached) << seed;
        set_radii(tracked);
        // The target of the container radius: 0.5 %.
        EXPECT_NEAR(tracked.container_radius, 130.0, 0.005 * 130.0) << seed;
    }
}

// The rim is seen in thousands of pixels, and no disc comes through it.
TEST(WallBounces, BeyondTheRimDoNotMoveIt) {
    TrackedVideo tracked = bouncing_disc(1, 0.15);
    tracked.rim_radius = 127.0;
    measure_quality(Detections(tracked.times.size()), tracked);
    EXPECT_GT(tracked.reach, 129.0);
    set_radii(tracked);
    EXPECT_EQ(tracked.container_radius, tracked.rim_radius);
}

TEST(WallBounces, ScatterByTheErrorOfAPosition) {
    // Bounces that agree lie within 0.65 pixels, so larger errors are claimed too small.
    for (const double noise : {0.08, 0.15}) {
        TrackedVideo tracked = bouncing_disc(1, noise);
        measure_quality(Detections(tracked.times.size()), tracked);
        // The claimed error of a coordinate; that of the edges, 0.05, is too small.
        EXPECT_GT(tracked.position_error, 0.7 * noise);
        EXPECT_LT(tracked.position_error, 2.0 * noise);  // flights are extrapolated to the wall
    }
}

// A shift by light is possible, and not certain: the factor covers an error without it.
TEST(ClaimedError, MayBeTooLargeByAPossibleShift) {
    TrackedVideo tracked = bouncing_disc(1, 0.1);
    tracked.contact_fitted = true;
    tracked.overlap_error = 0.1;
    tracked.error_factor = 1.2;
    tracked.shading_shift_error = 0.2;
    measure_quality(Detections(tracked.times.size()), tracked);
    EXPECT_NEAR(tracked.position_error, std::hypot(0.1, 0.2), 1e-12);
    EXPECT_NEAR(tracked.error_factor, std::hypot(1.0, 2.0), 1e-12);
}

/// Three discs that fly freely, and are hit once in about five frames.
TrackedVideo flying_discs(std::uint64_t seed, double noise) {
    constexpr double radius = 20.0, container = 170.0;
    TrackedVideo tracked;
    tracked.path = {.centre = {320.0, 240.0}, .amplitude = 38.0, .omega = 2.0 * pi / 15.0};
    tracked.radius = radius;
    tracked.rim_radius = container;
    tracked.number = 3;
    Random random(seed);
    std::vector<Vec2> p(3), v(3);
    for (int k = 0; k < 60; ++k) {
        tracked.times.push_back(k);
        TrackFrame f;
        for (std::size_t i = 0; i < 3; ++i) {
            p[i] = p[i] + v[i];
            if (k == 0 || length(p[i]) > container - radius || random.uniform() < 0.1) {
                v[i] = 40.0 * unit_circle(random.uniform());
                if (length(p[i]) > 0.5 * container) v[i] = (-40.0 / length(p[i])) * p[i];
            }
            f.id.push_back(std::int64_t(i));
            f.radius.push_back(radius);
            f.position.push_back(tracked.path.centre + p[i] +
                                 noise * Vec2{deviate(random), deviate(random)});
        }
        tracked.tracks.frames.push_back(f);
        tracked.errors.emplace_back(3, 0.1);
        tracked.seen.emplace_back(3, 1);
    }
    return tracked;
}

// Edges claim 0.1 pixels. Without contacts, only flights show the errors of fast discs.
TEST(FreeFlights, ShowErrorsThatEdgesDoNot) {
    for (const double noise : {0.5, 1.0})
        for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
            TrackedVideo tracked = flying_discs(seed, noise);
            find_contacts(tracked);
            measure_quality(Detections(tracked.times.size()), tracked);
            EXPECT_FALSE(tracked.contact_fitted);
            EXPECT_GT(tracked.position_error, 0.7 * noise) << seed;
            EXPECT_LT(tracked.position_error, 1.5 * noise) << seed;
        }
}

/// Two periods of a phone's video: sixteen discs near the wall, displaced by `shift`.
TrackedVideo discs_at_the_wall(std::uint64_t seed, const Vec2& shift) {
    constexpr double radius = 20.0, reach = 152.0;
    TrackedVideo tracked;
    tracked.path = {.centre = {320.0, 240.0}, .amplitude = 38.0, .omega = 2.0 * pi / 15.0};
    tracked.radius = radius;
    tracked.number = 16;
    Random random(seed);
    for (int k = 0; k < 30; ++k) {
        tracked.times.push_back(k);
        TrackFrame f;
        for (std::int64_t i = 0; i < 16; ++i) {
            const double gap = -0.4 * radius * std::log(1.0 - random.uniform());
            const Vec2 noise = 0.3 * Vec2{deviate(random), deviate(random)};
            f.id.push_back(i);
            f.radius.push_back(radius);
            f.position.push_back(tracked.path.at(k) +
                                 (reach - gap) * unit_circle(random.uniform()) + noise + shift);
        }
        tracked.tracks.frames.push_back(f);
        tracked.seen.emplace_back(16, 1);
    }
    return tracked;
}

TEST(WallFit, TellsAShiftTowardsTheLightFromADisplacedRim) {
    constexpr int seeds = 20;
    double square = 0.0;
    for (int seed = 1; seed <= seeds; ++seed) {
        const Vec2 shift{-2.2, -2.2};
        TrackedVideo lit = discs_at_the_wall(std::uint64_t(seed), shift), dim = lit;
        VideoSurvey survey;
        survey.shading = {0.65, 0.65};  // the sign is arbitrary
        find_wall(survey, lit);
        const Vec2 off = lit.shading_shift - shift;
        EXPECT_LT(length(off), 0.8) << seed;  // four errors
        EXPECT_EQ(length(lit.rim_shift), 0.0) << seed;
        square += 0.5 * dot(off, off) / std::pow(lit.shading_shift_error, 2) / seeds;
        survey.shading = {0.2, 0.2};
        find_wall(survey, dim);
        EXPECT_LT(length(dim.shading_shift), 0.1) << seed;
        EXPECT_LT(length(dim.path.centre - Vec2{320.0, 240.0} - shift), 0.8) << seed;
    }
    // Without discs at the wall, the expected shift is in the error.
    TrackedVideo inside = discs_at_the_wall(1, {0.0, 0.0});
    for (auto& seen : inside.seen) seen.assign(16, 0);
    VideoSurvey survey;
    survey.shading = {0.65, 0.65};
    find_wall(survey, inside);
    EXPECT_EQ(length(inside.shading_shift), 0.0);
    EXPECT_GT(inside.shading_shift_error, 1.0);
    // The errors are those of the shifts: of 40 coordinates the mean square has an error of 22 %.
    EXPECT_GT(square, 0.4);
    EXPECT_LT(square, 2.0);
}

// One disc touches the wall some sixteen times. The rim, seen in thousands of pixels, is right.
TEST(WallFit, LeavesTheRimWhereItIsForFewBounces) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        TrackedVideo tracked = bouncing_disc(seed, 0.15);
        tracked.rim_radius = 130.0;
        VideoSurvey survey;
        survey.shading = {0.55, -0.47};
        find_wall(survey, tracked);
        EXPECT_EQ(length(tracked.rim_shift), 0.0) << seed;
        EXPECT_EQ(length(tracked.shading_shift), 0.0) << seed;
        // The light may have shifted the disc, and this stays in its error.
        EXPECT_GT(tracked.shading_shift_error, 0.0) << seed;
    }
}

// Of two sizes that a few frames seemed to show, one has no disc in the end.
TEST(TrackAssembly, ForgetsASizeWithoutDiscs) {
    constexpr std::size_t frames = 12;
    Detections all(frames);
    Links links;
    links.species = {1};
    TrackedVideo tracked;
    tracked.path = {.centre = {100.0, 100.0}, .amplitude = 20.0, .omega = 2.0 * pi / 60.0};
    tracked.species = {{17.0, 0.1, 0}, {19.0, 0.1, 1}};
    for (std::size_t k = 0; k < frames; ++k) {
        tracked.times.push_back(double(k));
        DetectedParticle disc;
        disc.centre = {100.0, 100.0};
        disc.species = 1;
        all[k].particles = {disc};
        links.track.push_back({0});
    }
    assemble_tracks(all, links, 0, tracked);
    ASSERT_EQ(tracked.species.size(), 1u);
    EXPECT_EQ(tracked.species[0].radius, 19.0);
    EXPECT_EQ(tracked.species[0].number, 1u);
}

double exponential(Random& random, double mean) { return -mean * std::log(1.0 - random.uniform()); }

TEST(ContactDistance, IsFoundFromNoisyDistances) {
    Random random(5);
    for (const double error : {0.004, 0.012, 0.02})
        for (const double decay : {0.03, 0.1}) {
            std::vector<double> distances;
            for (int n = 0; n < 6000; ++n)
                distances.push_back(1.003 + exponential(random, decay) + error * deviate(random));
            const auto contact = contact_of(distances, 0.9, 1.1);
            ASSERT_TRUE(contact);
            // A bin is 0.0025 wide.
            EXPECT_NEAR(contact->at, 1.003, 0.002) << error << " " << decay;
            EXPECT_NEAR(contact->error, error, 0.3 * error + 0.0005) << error << " " << decay;
        }
    EXPECT_FALSE(contact_of({1.0, 1.01, 0.99}, 0.9, 1.1));
}

// A dilute crowd with a few wrong positions. The wall may confirm a contact that is not sharp.
TEST(ContactDistance, IgnoresWrongPositionsAndBelievesTheWall) {
    Random random(1);
    std::vector<double> near{0.83, 0.88, 0.89, 0.9, 0.91, 0.92, 0.93, 0.94}, far;
    for (int n = 0; n < 1500; ++n) {
        near.push_back(0.99 + exponential(random, 0.5) + 0.01 * deviate(random));
        far.push_back(1.16 + exponential(random, 0.6) + 0.05 * deviate(random));
    }
    EXPECT_NEAR(contact_of_discs(near, 0.0, 3e-4).value().error, 0.01,
                0.006);  // half of it: few are in contact
    EXPECT_FALSE(contact_of_discs(far, 1.0));
    EXPECT_NEAR(contact_of_discs(far, 1.17).value().at, 1.16, 0.02);  // two bins
}

// Discs that are seldom in contact. Two that fly together for long are one encounter.
TEST(ContactDistance, OfFewEncountersIsFoundWithItsError) {
    constexpr int seeds = 20;
    double square = 0.0;
    for (int seed = 1; seed <= seeds; ++seed) {
        Random random{std::uint64_t(seed)};
        std::vector<std::vector<double>> encounters{std::vector<double>(100, 1.045)};
        for (int n = 0; n < 40; ++n)
            encounters.push_back({1.0153 + 0.08 * random.uniform() + 0.004 * deviate(random)});
        const auto found = contact_of_few(encounters, 0.004);
        ASSERT_TRUE(found) << seed;
        EXPECT_LT(found->error, 0.008) << seed;
        square += std::pow((found->at - 1.0153) / found->error, 2) / seeds;
        encounters.resize(6);
        EXPECT_FALSE(contact_of_few(encounters, 0.004)) << seed;
    }
    // The errors are those of the distances, within a factor of two.
    EXPECT_GT(square, 0.25);
    EXPECT_LT(square, 4.0);
}

// Pairs in contact all over a container, seen through a lens.
TEST(ContactDistance, DeterminesTheLensDistortion) {
    constexpr Vec2 middle{319.5, 239.5};
    Random random(4);
    for (const double k : {0.0, 0.03, -0.02}) {
        Lens lens{middle, 240.0};
        lens.k = k;
        std::vector<DiscPair> pairs;
        for (int n = 0; n < 8000; ++n) {
            const Vec2 p = middle + random.in_disc(190.0);
            const double apart = 42.0 + exponential(random, 1.5);
            const Vec2 d = 0.5 * apart * unit_circle(random.uniform());
            const Vec2 noise{0.3 * deviate(random), 0.3 * deviate(random)};
            pairs.push_back({lens.seen(p - d) + noise, lens.seen(p + d), 42.0});
        }
        const auto found = distortion_of(pairs, middle, 240.0);
        ASSERT_TRUE(found);
        EXPECT_LT(found->error, 0.006);
        EXPECT_NEAR(found->k, k, 2.0 * found->error) << k;
    }
}

}  // namespace wall_bounces_tests
}  // namespace swirl::tracking
