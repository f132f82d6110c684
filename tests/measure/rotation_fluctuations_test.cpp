#include "swirl/measure/rotation_fluctuations.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "measure/snapshots.hpp"
#include "swirl/math/normal_deviate.hpp"

namespace swirl {
namespace {

/// Five discs that rotate rigidly with the angular velocity `rate`, in units of Ω.
Snapshot rotating(double rate) {
    Snapshot s = empty_container(0.3);
    const double angular_velocity = rate * 2.0 * pi / s.period;
    for (int k = 0; k < 5; ++k) {
        const Vec2 r = (1.0 + 0.5 * k) * unit_circle(0.2 * k + 0.01);
        add_disc(s, s.container_centre + r,
                 s.container_velocity + angular_velocity * perpendicular(r));
    }
    return s;
}

void add_period(RotationFluctuations& f, double rate) {
    for (int k = 0; k < 8; ++k) f.sample_in_lab(rotating(rate));
    f.close_block();
}

TEST(RotationFluctuations, OfARigidRotationAreThoseOfItsRates) {
    Random random(4);
    RotationFluctuations measured;
    std::vector<double> rates;
    for (int k = 0; k < 300; ++k) {
        rates.push_back(0.1 + 0.02 * normal_deviate(random));
        add_period(measured, rates.back());
    }
    const Fluctuations expected = fluctuations_of({&rates, 1});
    // Both estimators are the rate itself, up to the rounding of positions of size 10.
    for (const char* prefix : {"", "discs_"}) {
        const auto row = [&](const char* name) {
            return row_of(measured, std::string(prefix) + name);
        };
        EXPECT_NEAR(row("n_variance").mean, 5.0 * expected.variance.mean, 1e-12);
        EXPECT_NEAR(row("n_variance").error, 5.0 * expected.variance.error, 1e-12);
        EXPECT_NEAR(row("skewness").mean, expected.skewness.mean, 1e-9);
        EXPECT_NEAR(row("excess_kurtosis").mean, expected.excess_kurtosis.mean, 1e-9);
        EXPECT_NEAR(row("binder").mean, expected.binder.mean, 1e-12);
        EXPECT_NEAR(row("correlation_time").mean, expected.autocorrelation_time.mean, 1e-9);
        EXPECT_TRUE(std::isnan(row("low_lifetime").mean));
    }
}

TEST(RotationFluctuations, FindTheLifetimesOfRotationAndCounterrotation) {
    RotationFluctuations measured;
    for (int cycle = 0; cycle < 5; ++cycle)
        for (int k = 0; k < 60; ++k) add_period(measured, k < 40 ? 0.25 : -0.125);
    // Four complete visits of 20 periods and one at the end, which is not left; five of 40 periods.
    EXPECT_NEAR(row_of(measured, "high").mean, 0.25, 1e-12);
    EXPECT_NEAR(row_of(measured, "low").mean, -0.125, 1e-12);
    EXPECT_EQ(row_of(measured, "high_lifetime").mean, 40.0);
    EXPECT_EQ(row_of(measured, "low_lifetime").mean, 5.0 * 20.0 / 4.0);
}

TEST(RotationFluctuations, OfOneDiscAreNotAvailable) {
    RotationFluctuations measured;
    Snapshot s = empty_container();
    add_disc(s, s.container_centre, {0.1, 0.0});
    for (int k = 0; k < 20; ++k) {
        measured.sample_in_lab(s);
        measured.close_block();
    }
    EXPECT_TRUE(std::isnan(row_of(measured, "n_variance").mean));
}

}  // namespace
}  // namespace swirl
