#include "track/video/contact_distance.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "math/deviate.hpp"
#include "swirl/math/random.hpp"
#include "swirl/math/unit_circle.hpp"

namespace swirl::tracking {
namespace {

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

// Discs on a line, some of them in contact.
TEST(MoveApart, SeparatesOverlappingDiscsOnly) {
    std::vector<HardDisc> discs{{{0.0, 0.0}, 0.01, 10.0},
                                {{19.5, 0.0}, 0.01, 10.0},
                                {{60.0, 0.0}, 0.01, 10.0},
                                {{90.0, 0.0}, 0.01, 10.0, 89.0}};
    move_apart(discs, 1.0, {0.0, 0.0});
    const double apart = discs[1].centre.x - discs[0].centre.x;
    EXPECT_GE(apart, 20.0);
    EXPECT_LT(apart, 20.2);  // at most the error of the distance, 0.14
    EXPECT_NEAR(discs[0].centre.x + discs[1].centre.x, 19.5, 1e-9);  // equal errors
    EXPECT_EQ(discs[2].centre.x, 60.0);
    EXPECT_LE(discs[3].centre.x, 89.0);
    EXPECT_GT(discs[3].centre.x, 88.8);
}

TEST(MoveApart, ImprovesPositionsInACrowd) {
    // A hexagonal crowd with gaps and noisy positions.
    Random random(9);
    double before = 0.0, after = 0.0;
    for (int frame = 0; frame < 40; ++frame) {
        std::vector<HardDisc> discs;
        std::vector<Vec2> truth;
        for (int row = 0; row < 5; ++row)
            for (int column = 0; column < 5; ++column) {
                const Vec2 p{20.1 * column + 10.05 * (row % 2), 17.5 * row};
                truth.push_back(p);
                discs.push_back({p + 0.3 * Vec2{deviate(random), deviate(random)}, 0.04, 10.0});
            }
        for (std::size_t i = 0; i < truth.size(); ++i) {
            const Vec2 d = discs[i].centre - truth[i];
            before += dot(d, d);
        }
        move_apart(discs, 1.0, {0.0, 0.0});
        for (std::size_t i = 0; i < truth.size(); ++i) {
            const Vec2 d = discs[i].centre - truth[i];
            after += dot(d, d);
        }
    }
    EXPECT_LT(after, 0.75 * before);
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

}  // namespace
}  // namespace swirl::tracking
