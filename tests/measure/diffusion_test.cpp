#include "swirl/measure/diffusion.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "measure/snapshots.hpp"

namespace swirl {
namespace {

constexpr int per_period = 8;

Snapshot container_at(int sample) {
    Snapshot s = empty_container(static_cast<double>(sample % per_period) / per_period);
    s.periods = sample / per_period;
    return s;
}

TEST(Diffusion, GrowsWithTheSquareOfTheLagForUniformMotion) {
    Diffusion diffusion(5);
    const double step = paper_period / per_period;
    for (int k = 0; k < 40; ++k) {
        Snapshot s = container_at(k);
        add_disc(s, s.container_centre + Vec2{0.03 * step * k, 0.04 * step * k}, {0.0, 0.0});
        s.angle[0] = 0.5 * step * k;
        diffusion.sample(s);
        if (k % per_period == per_period - 1) diffusion.close_block();
    }
    for (std::size_t k = 0; k < diffusion.lags(); ++k) {
        const double t = step * (1 << k);
        EXPECT_NEAR(diffusion.lag(k), t, 1e-12);
        EXPECT_NEAR(diffusion.square_displacement(k).mean, 0.0025 * t * t, 1e-12);
        EXPECT_NEAR(diffusion.mean_rotation(k).mean, 0.5 * t, 1e-12);
        EXPECT_NEAR(diffusion.rotation_variance(k).mean, 0.0, 1e-10);
    }
    EXPECT_EQ(diffusion.breaks(), 0.0);
}

TEST(Diffusion, GrowsWithTheLagForARandomWalk) {
    Diffusion diffusion(4);
    Noise noise(6);
    std::vector<Vec2> p(40);
    std::vector<double> angle(40, 0.0);
    for (int k = 0; k < 4000; ++k) {
        Snapshot s = container_at(k);
        for (std::size_t i = 0; i < p.size(); ++i) {
            p[i] = p[i] + Vec2{noise(), noise()};
            angle[i] += noise() + 0.1;
            add_disc(s, s.container_centre + p[i], {0.0, 0.0});
            s.angle[i] = angle[i];
        }
        diffusion.sample(s);
        if (k % per_period == per_period - 1) diffusion.close_block();
    }
    for (std::size_t k = 0; k < 4; ++k) {
        // Steps are uniform in (−1, 1), so each coordinate has the variance 1/3. With 160 000 steps
        // its error is 0.5 %, and five times that for the longest lag, whose displacements overlap.
        EXPECT_NEAR(diffusion.square_displacement(k).mean / (1 << k), 2.0 / 3.0, 0.02);
        EXPECT_NEAR(diffusion.rotation_variance(k).mean / (1 << k), 1.0 / 3.0, 0.01);
        EXPECT_NEAR(diffusion.mean_rotation(k).mean / (1 << k), 0.1, 0.01);
    }
}

TEST(Diffusion, OverlappingDisplacementsCountAsOneSample) {
    // The scatter over many walks, compared with the error that each reports, for a lag of four
    // periods (one sample each). √L is an upper bound of the effect of overlap (√(2L/3) for a free
    // walk).
    double stated = 0.0, sum = 0.0, squares = 0.0;
    constexpr int walks = 200;
    for (int walk = 0; walk < walks; ++walk) {
        Diffusion diffusion(3);
        Noise noise(static_cast<std::uint64_t>(100 + walk));
        Vec2 p{};
        for (int k = 0; k < 200; ++k) {
            Snapshot s = empty_container();
            s.periods = k;
            p = p + Vec2{noise(), noise()};
            add_disc(s, s.container_centre + p, {0.0, 0.0});
            diffusion.sample(s);
            diffusion.close_block();
        }
        const Estimate e = diffusion.square_displacement(2);
        stated += e.error / walks;
        sum += e.mean / walks;
        squares += e.mean * e.mean / walks;
    }
    const double scatter = std::sqrt(squares - sum * sum);
    // The scatter of 200 walks is accurate to 5 %, and the stated error is about 22 % too large.
    EXPECT_GT(stated, 0.95 * scatter);
    EXPECT_LT(stated, 1.5 * scatter);
}

TEST(Diffusion, IsZeroForADiscCarriedByTheContainerAndNaNWithoutAngles) {
    Diffusion diffusion(3);
    for (int k = 0; k < 20; ++k) {
        Snapshot s = container_at(k);
        add_disc(s, s.container_centre + Vec2{2.0, 1.0}, s.container_velocity);
        s.angle[0] = s.spin[0] = not_available;
        diffusion.sample(s);
    }
    diffusion.close_block();
    EXPECT_NEAR(diffusion.square_displacement(2).mean, 0.0, 1e-28);
    EXPECT_TRUE(std::isnan(diffusion.mean_rotation(0).mean));
}

TEST(Diffusion, UnsortedOrUnevenTimesRestart) {
    Diffusion diffusion(3);
    const auto sample_at = [&](int k) {
        Snapshot s = container_at(k);
        add_disc(s, s.container_centre, {0.0, 0.0});
        diffusion.sample(s);
    };
    for (const int k : {0, 1, 2, 1}) sample_at(k);
    EXPECT_EQ(diffusion.breaks(), 1.0);
    for (const int k : {2, 4}) sample_at(k);
    EXPECT_EQ(diffusion.breaks(), 2.0);
    // Steps are equal to 1 %, here of 1/8 of a period.
    for (const double step : {0.1237, 0.1238, 0.1262, 0.1263}) {
        Diffusion even(3);
        for (const double time : {0.0, 0.125, 0.125 + step}) {
            Snapshot s = empty_container(time);
            add_disc(s, s.container_centre, {0.0, 0.0});
            even.sample(s);
        }
        EXPECT_EQ(even.breaks(), std::abs(step / 0.125 - 1.0) > 0.01 ? 1.0 : 0.0) << step;
    }
    diffusion.sample(empty_container());
    EXPECT_TRUE(std::isnan(Diffusion(3).square_displacement(0).mean));
}

}  // namespace
}  // namespace swirl
