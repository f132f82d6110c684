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
