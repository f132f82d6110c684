#include "swirl/measure/cluster_rotation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "measure/snapshots.hpp"

namespace swirl {
namespace {

/// N discs that rotate rigidly at `rate` about a moving point.
Snapshot rigid_cluster(std::size_t n, double rate, std::uint64_t seed) {
    Snapshot s = random_discs(n, seed);
    for (std::size_t i = 0; i < n; ++i) {
        const Vec2 v = Vec2{0.7, -0.2} + rate * perpendicular(s.position(i));
        s.vx[i] = v.x;
        s.vy[i] = v.y;
    }
    return s;
}

/// The definition, written out.
RotationSample by_definition(const Snapshot& s) {
    Vec2 r{0, 0}, v{0, 0};
    double mass = 0.0;
    for (std::size_t i = 0; i < s.size(); ++i) {
        mass += s.mass[i];
        r = r + s.mass[i] * s.position(i);
        v = v + s.mass[i] * s.velocity(i);
    }
    r = (1.0 / mass) * r;
    v = (1.0 / mass) * v;
    double individual = 0.0, angular = 0.0, square = 0.0;
    for (std::size_t i = 0; i < s.size(); ++i) {
        const Vec2 d = s.position(i) - r, u = s.velocity(i) - v;
        individual += cross(d, u) / dot(d, d);
        angular += cross(d, u);
        square += dot(d, d);
    }
    return {individual / static_cast<double>(s.size()), angular / square};
}

/// An event after which the centre of mass is summed up again.
const Event anything{0, 0.0, EventKind::path_vertex, 0, 0, {}, {}, 0.0};
const Event collision{0, 0.0, EventKind::disc_disc, 0, 1, {1.0, 0.0}, {}, 0.0};

TEST(ClusterRotation, RigidRotationGivesItsRate) {
    for (const std::size_t n : {2u, 3u, 7u, 8u, 9u, 28u, 48u, 55u}) {
        const RotationSample sample = cluster_rotation(rigid_cluster(n, Omega, n));
        // Rounding of positions of size 10 at distances of order 0.1 from the centre of mass.
        EXPECT_NEAR(sample.individual, Omega, 1e-13) << n;
        EXPECT_NEAR(sample.rigid, Omega, 1e-14) << n;
    }
}

TEST(ClusterRotation, AgreesWithItsDefinitionForEveryNumberAndAnyMasses) {
    for (std::size_t n = 2; n <= 60; ++n) {
        Snapshot s = random_discs(n, 100 + n);
        Noise noise(n);
        for (std::size_t i = 0; i < n; ++i) s.mass[i] = 2.0 + noise();
        const RotationSample expected = by_definition(s), sample = cluster_rotation(s);
        const RotationSample earlier = cluster_rotation(held_earlier(s));
        // Another order of additions; a disc near the centre of mass magnifies rounding.
        EXPECT_NEAR(sample.individual, expected.individual, 1e-12) << n;
        EXPECT_NEAR(sample.rigid, expected.rigid, 1e-14) << n;
        EXPECT_NEAR(earlier.individual, expected.individual, 1e-12) << n;
        EXPECT_NEAR(earlier.rigid, expected.rigid, 1e-14) << n;
    }
}

/// Accelerated spheres on a floor; each state belongs to another time.
Snapshot pushed_spheres(std::size_t n, std::uint64_t seed) {
    Snapshot s = held_earlier(random_discs(n, seed));
    s.resize_for_spheres(n);
    s.on_floor = true;
    Noise noise(seed);
    for (std::size_t i = 0; i < n; ++i)
        s.set_floor_motion(i, {noise(), noise()}, {noise(), noise()});
    return s;
}

TEST(ClusterRotation, UsesTheAccelerationOfSpheres) {
    for (std::size_t n = 2; n <= 60; ++n) {
        const Snapshot s = pushed_spheres(n, n);
        const RotationSample expected = by_definition(s), sample = cluster_rotation(s);
        // Another order of additions; a disc near the centre of mass magnifies rounding.
        EXPECT_NEAR(sample.individual, expected.individual, 1e-11) << n;
        EXPECT_NEAR(sample.rigid, expected.rigid, 1e-13) << n;
        for (const Width width : {Width::baseline, Width::avx2, Width::avx512}) {
            if (!has_width(width)) continue;
            EXPECT_EQ(cluster_rotation(s, width).individual, sample.individual) << n;
        }
    }
}

TEST(ClusterRotation, IsBitwiseEqualForEveryWidth) {
    for (std::size_t n = 2; n <= 60; ++n) {
        const Snapshot s = held_earlier(random_discs(n, n));
        const RotationSample base = cluster_rotation(s, Width::baseline);
        for (const Width width : {Width::avx2, Width::avx512}) {
            if (!has_width(width)) continue;
            const RotationSample wide = cluster_rotation(s, width);
            EXPECT_EQ(base.individual, wide.individual) << n;
            EXPECT_EQ(base.rigid, wide.rigid) << n;
        }
    }
}

TEST(ClusterRotation, IsNaNWithoutTwoDiscsAtDifferentPoints) {
    Snapshot s = empty_container();
    EXPECT_TRUE(std::isnan(cluster_rotation(s).individual));
    EXPECT_TRUE(std::isnan(cluster_rotation(s).rigid));
    add_disc(s, {1.0, 2.0}, {0.3, 0.4});
    EXPECT_TRUE(std::isnan(cluster_rotation(s).individual));
    EXPECT_TRUE(std::isnan(cluster_rotation(s).rigid));
    for (int i = 0; i < 20; ++i) {
        add_disc(s, {1.0, 2.0}, {0.1 * i, 0.4});
        EXPECT_TRUE(std::isnan(cluster_rotation(s).individual)) << i;
        EXPECT_TRUE(std::isnan(cluster_rotation(s).rigid)) << i;
    }
}

TEST(ClusterRotation, IndividualMeanOmitsADiscOnTheCentreOfMass) {
    for (const int others : {6, 8, 12, 46}) {
        for (int place = 0; place <= others; ++place) {
            Snapshot s = empty_container();
            for (int k = 0; k < others; ++k) {
                if (k == place) add_disc(s, {0.0, 0.0}, {0.0, 0.0});
                const Vec2 p = 4.0 * unit_circle(double(k) / others);
                add_disc(s, p, 0.25 * perpendicular(p));
            }
            // The centre of mass is a sum of up to 46 rounded positions of size 4, so it lies
            // 10⁻¹⁵ away from the disc, well within 2⁻⁴⁰ container radii.
            EXPECT_NEAR(cluster_rotation(s).individual, 0.25, 1e-14) << others;
            EXPECT_NEAR(cluster_rotation(s).rigid, 0.25, 1e-14) << others;
            ClusterRotation rotation;
            EXPECT_EQ(rotation.sample(s, collision).individual, cluster_rotation(s).individual);
        }
    }
}

// A disc moves through the centre of mass of a ring. The mean is about the ring's rate, since
// Σ r = 0 on a ring, but r × v/r² of that disc would be 10¹⁵.
TEST(ClusterRotation, OmitsADiscOnTheCentreOfMassAtAnyIndex) {
    constexpr int others = 46;
    for (int place = 0; place <= others; ++place) {
        Snapshot s = empty_container();
        for (int k = 0; k < others; ++k) {
            if (k == place) add_disc(s, {0.0, 0.0}, {0.3, 0.4});
            const Vec2 p = 4.0 * unit_circle(double(k) / others);
            add_disc(s, p, 0.25 * perpendicular(p));
        }
        if (place == others) add_disc(s, {0.0, 0.0}, {0.3, 0.4});
        EXPECT_NEAR(cluster_rotation(s).individual, 0.25, 1e-14) << place;
    }
}

TEST(ClusterRotation, SampleByTimeEqualsFirstSampleAfterAnEvent) {
    for (std::size_t n = 0; n <= 60; ++n) {
        const Snapshot s = held_earlier(random_discs(n, n));
        ClusterRotation rotation;
        const RotationSample in_time = rotation.sample_by_time(s),
                             first = rotation.sample(s, collision);
        if (n < 2) {
            EXPECT_TRUE(std::isnan(in_time.individual) && std::isnan(first.individual)) << n;
            continue;
        }
        EXPECT_EQ(in_time.individual, first.individual) << n;
        EXPECT_EQ(in_time.rigid, first.rigid) << n;
    }
}

/// Gives disc i an impulse, as the wall would.
Event push(Snapshot& s, std::size_t i, const Vec2& normal, double along, double across) {
    const Vec2 tangent{normal.y, -normal.x};
    Disc d = s.disc(i).at(s.clock);
    d.velocity = d.velocity - (1.0 / d.mass) * (along * normal + across * tangent);
    s.set(i, d);
    const auto k = static_cast<std::uint32_t>(i);
    return {0, s.clock, EventKind::disc_wall, k, k, normal, {along, across, false}, 0.0};
}

TEST(ClusterRotation, FollowsTheCentreOfMassThroughWallImpulses) {
    for (std::size_t n = 2; n <= 60; ++n) {
        Snapshot s = held_earlier(random_discs(n, 300 + n));
        Noise noise(n);
        for (std::size_t i = 0; i < n; ++i) s.mass[i] = 2.0 + noise();
        ClusterRotation rotation;
        rotation.sample(s, anything);
        for (int k = 0; k < 100; ++k) {
            s.clock += 0.003 * (1.0 + noise());
            const auto i = static_cast<std::size_t>(0.5 * (1.0 + noise()) * double(n));
            const Event event = push(s, i, unit_circle(noise()), noise(), noise());
            const RotationSample seen = rotation.sample(s, event), found = cluster_rotation(s);
            // A hundred impulses, each rounded to 10⁻¹⁵; a disc near the centre magnifies it.
            EXPECT_NEAR(seen.individual, found.individual, 1e-10) << n;
            EXPECT_NEAR(seen.rigid, found.rigid, 1e-12) << n;
        }
    }
}

/// Discs i and j exchange a random impulse.
Event collide(Snapshot& s, std::size_t i, std::size_t j, const Vec2& impulse) {
    Disc a = s.disc(i).at(s.clock), b = s.disc(j).at(s.clock);
    a.velocity = a.velocity - (1.0 / a.mass) * impulse;
    b.velocity = b.velocity + (1.0 / b.mass) * impulse;
    s.set(i, a);
    s.set(j, b);
    return {0,
            s.clock,
            EventKind::disc_disc,
            static_cast<std::uint32_t>(i),
            static_cast<std::uint32_t>(j),
            {},
            {},
            0.0};
}

TEST(ClusterRotation, ExactMeanByTimeIsThatOfVeryManySamples) {
    for (const std::size_t n : {2u, 5u, 9u}) {
        Snapshot s = held_earlier(random_discs(n, 70 + n));
        Noise noise(n);
        for (std::size_t i = 0; i < n; ++i) s.mass[i] = 2.0 + noise();
        ClusterRotation rotation;
        rotation.sample(s, anything);
        rotation.begin_angles(s);
        rotation.sample_by_time(s);
        const double begin = s.clock;
        double sum = 0.0;
        for (int k = 0; k < 60; ++k) {
            const double flight = 0.5 * (1.0 + noise()), before = s.clock;
            // Simpson's rule with intervals that fit the closest approach, 0.1 or more of speed 1.
            constexpr int intervals = 20000;
            for (int m = 0; m <= intervals; ++m) {
                s.clock = before + flight * m / intervals;
                const double weight = m == 0 || m == intervals ? 1.0 : m % 2 == 1 ? 4.0 : 2.0;
                sum += weight * cluster_rotation(s).individual * flight / (3.0 * intervals);
            }
            const std::size_t i = static_cast<std::size_t>(k) % n;
            rotation.follow(s, k % 3 == 0 ? push(s, i, unit_circle(noise()), noise(), noise())
                                          : collide(s, i, (i + 1) % n, {noise(), noise()}));
        }
        rotation.end_angles(s);
        const double exact = rotation.open_means()[default_rate] * 2.0 * pi / s.period;
        EXPECT_NEAR(exact, sum / (s.clock - begin), 1e-6) << n;
    }
}

// Two discs on the x axis turn about their centre of mass along a square, a quarter turn per side.
TEST(ClusterRotation, ExactMeanByTimeCountsFullTurns) {
    for (const int turns : {1, -1}) {
        Snapshot s = empty_container();
        add_disc(s, {1.0, 0.0}, {});
        add_disc(s, {-1.0, 0.0}, {});
        const auto aim = [&](int side) {
            const Vec2 along = quarter_turns(turns * side, {-1.0, double(turns)});
            for (std::size_t i = 0; i < 2; ++i) {
                Disc d = s.disc(i).at(s.clock);
                d.velocity = i == 0 ? along : -1.0 * along;
                s.set(i, d);
            }
            Event event = collision;
            event.clock = s.clock;
            return event;
        };
        aim(0);
        ClusterRotation rotation;
        rotation.sample(s, anything);
        rotation.begin_angles(s);
        rotation.sample_by_time(s);
        for (int side = 1; side <= 4 * 25; ++side) {
            s.clock = side;
            rotation.follow(s, aim(side));
        }
        rotation.end_angles(s);
        const double in_omega = turns * 2.0 * pi * 25 / 100.0 * s.period / (2.0 * pi);
        EXPECT_NEAR(rotation.open_means()[default_rate], in_omega, 1e-13 * s.period);
    }
}

TEST(ClusterRotation, ExactMeanByTimeOfOneDiscIsNaN) {
    Snapshot s = random_discs(1, 1);
    ClusterRotation rotation;
    rotation.begin_angles(s);
    rotation.sample_by_time(s);
    s.clock = 1.0;
    rotation.end_angles(s);
    EXPECT_TRUE(std::isnan(rotation.open_means()[default_rate]));
}

TEST(ClusterRotation, FollowingIsBitwiseEqualForEveryWidth) {
    for (const std::size_t n : {5u, 8u, 13u, 48u, 55u}) {
        Snapshot s = held_earlier(random_discs(n, n));
        ClusterRotation best, baseline(Width::baseline), avx2(Width::avx2);
        Noise noise(n);
        for (int k = 0; k < 50; ++k) {
            s.clock += 0.01;
            const Event event = push(s, k % n, unit_circle(noise()), noise(), noise());
            const RotationSample base = baseline.sample(s, event);
            for (ClusterRotation* wide : {&best, &avx2}) {
                const RotationSample sample = wide->sample(s, event);
                EXPECT_EQ(base.individual, sample.individual) << n;
                EXPECT_EQ(base.rigid, sample.rigid) << n;
            }
        }
    }
}

TEST(ClusterRotation, SumsTheCentreOfMassAgainIfTheNumberOfDiscsChanges) {
    ClusterRotation rotation;
    for (const std::size_t n : {48u, 12u, 3u, 30u}) {
        const Snapshot s = random_discs(n, n);
        EXPECT_EQ(rotation.sample(s, collision).individual, cluster_rotation(s).individual) << n;
    }
}

TEST(ClusterRotation, IsNaNForANaNState) {
    Snapshot s = random_discs(20, 4);
    s.vx[3] = not_available;
    EXPECT_TRUE(std::isnan(cluster_rotation(s).individual));
    EXPECT_TRUE(std::isnan(cluster_rotation(s).rigid));
}

TEST(ClusterRotation, MeansByEventAndByTimeAreSeparateAndInUnitsOfOmega) {
    ClusterRotation rotation;
    for (int block = 0; block < 4; ++block) {
        rotation.sample(rigid_cluster(9, Omega, 1), anything);
        rotation.sample(rigid_cluster(9, 3.0 * Omega, 2), anything);
        rotation.sample_by_time(rigid_cluster(9, -0.5 * Omega, 3));
        rotation.close_block();
    }
    const RotationEstimates e = rotation.estimates();
    EXPECT_NEAR(e.mean_by_event.mean, 2.0, 1e-12);
    EXPECT_NEAR(e.rigid_by_event.mean, 2.0, 1e-12);
    EXPECT_NEAR(e.mean_by_time.mean, -0.5, 1e-12);
    EXPECT_NEAR(e.rigid_by_time.mean, -0.5, 1e-12);
    EXPECT_EQ(e.mean_by_event.blocks, 4u);
    EXPECT_NEAR(e.mean_by_event.error, 0.0, 1e-12);
}

TEST(ClusterRotation, HasNoMeanWithoutSamples) {
    ClusterRotation rotation;
    EXPECT_TRUE(std::isnan(rotation.estimates().mean_by_event.mean));
    rotation.close_block();
    EXPECT_TRUE(std::isnan(rotation.estimates().mean_by_event.mean));
    EXPECT_TRUE(std::isnan(rotation.estimates().rigid_by_time.mean));
}

TEST(ClusterRotation, OpenBlockDoesNotCount) {
    ClusterRotation rotation;
    rotation.sample(rigid_cluster(9, Omega, 1), anything);
    rotation.close_block();
    rotation.sample(rigid_cluster(9, 5.0 * Omega, 1), anything);
    EXPECT_NEAR(rotation.estimates().mean_by_event.mean, 1.0, 1e-12);
}

TEST(ClusterRotation, MergedEqualsOneLongRun) {
    ClusterRotation whole, first, second;
    for (int block = 0; block < 10; ++block) {
        for (int event = 0; event < 20 + block; ++event) {
            const Snapshot s = random_discs(12, 50 * block + event);
            whole.sample(s, anything);
            whole.sample_by_time(s);
            (block < 4 ? first : second).sample(s, anything);
            (block < 4 ? first : second).sample_by_time(s);
        }
        whole.close_block();
        (block < 4 ? first : second).close_block();
    }
    first.merge(second);
    // Only the order of a few additions differs.
    EXPECT_NEAR(first.estimates().mean_by_event.mean, whole.estimates().mean_by_event.mean, 1e-14);
    EXPECT_NEAR(first.estimates().rigid_by_time.mean, whole.estimates().rigid_by_time.mean, 1e-14);
    EXPECT_EQ(first.mean_by_event().size(), 10u);
}

// A sample reads all discs; every event is sampled up to 128 discs.
TEST(ClusterRotation, ManyDiscsAreSampledAfterEveryFewEvents) {
    EXPECT_EQ(events_per_rotation_sample(1), 1u);
    EXPECT_EQ(events_per_rotation_sample(128), 1u);
    EXPECT_EQ(events_per_rotation_sample(129), 33u);  // ⌈129/4⌉
    EXPECT_EQ(events_per_rotation_sample(499), 125u);
    EXPECT_EQ(events_per_rotation_sample(500), 250u);  // ⌈500/2⌉
    // At least 128 samples of the 2048 events or more of a period, and all of fewer events.
    EXPECT_EQ(events_per_rotation_sample(48, 2047), 1u);
    EXPECT_EQ(events_per_rotation_sample(48, 2048), 16u);
    EXPECT_EQ(events_per_rotation_sample(500, 2048), 250u);
}

}  // namespace
}  // namespace swirl
