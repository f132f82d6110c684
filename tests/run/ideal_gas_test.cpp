// The gas of elastic smooth discs in a large container at rest has known answers. Its density is
// higher at the wall, so the packing fraction is that of the inner circle of radius R/2.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/scenes.hpp"
#include "measure/snapshots.hpp"
#include "swirl/measure/collision_angles.hpp"
#include "swirl/measure/pair_correlation.hpp"
#include "swirl/measure/velocity_correlation.hpp"
#include "swirl/measure/velocity_distribution.hpp"

namespace swirl {
namespace {

/// Calls sample(snapshot) `samples` times, close() after every 20. Samples are taken at equal steps
/// of time, about `collisions` collisions of a disc apart: right after a collision, two discs would
/// touch.
template <class Sample, class Close>
void sample_gas(std::size_t n, double packing, int samples, double collisions, const Sample& sample,
                const Close& close) {
    Simulation gas(gas_at_rest(n, packing));
    gas.run(20 * n);  // equilibration: 40 collisions of each disc
    const double from = gas.snapshot().time(), period = gas.snapshot().period;
    gas.run(20 * n);
    const double start = gas.snapshot().time(), step = collisions * (start - from) / 40.0;
    for (int k = 1; k <= samples; ++k) {
        const double time = start + k * step, whole = std::floor(time / period);
        gas.advance_to(static_cast<std::int64_t>(whole), time - whole * period);
        sample(gas.snapshot());
        if (k % 20 == 0) close();
    }
}

/// The angular momentum about C, without spins.
double angular_momentum(const InitialState& scene) {
    double sum = 0.0;
    for (const Disc& d : scene.discs) sum += d.mass * cross(d.position, d.velocity);
    return sum;
}

/// The gas without its rotation, which a container at rest conserves.
InitialState without_rotation(InitialState scene) {
    double inertia = 0.0;
    for (const Disc& d : scene.discs) inertia += d.mass * dot(d.position, d.position);
    const double rate = angular_momentum(scene) / inertia;
    for (Disc& d : scene.discs) d.velocity = d.velocity - rate * perpendicular(d.position);
    return scene;
}

class HardDiscs : public ::testing::TestWithParam<double> {};

// Henderson's equation of state: g(σ) = (1 − 7φ/16)/(1 − φ)², Mol. Phys. 30, 971 (1975),
// doi:10.1080/00268977500102511. Compared with Kolafa and Rottner (doi:10.1080/00268970600967963),
// it is 0.1 % high at φ = 0.3 and 0.6 % at φ = 0.5. The parabola at contact is exact to 0.3 %.
TEST_P(HardDiscs, HaveHendersonsPairCorrelationAtContact) {
    constexpr std::size_t n = 800;
    const double packing = GetParam();
    PairCorrelation correlation({std::sqrt(n / packing), 1.0}, 1);
    sample_gas(
        n, packing, 1200, 1.0, [&](const Snapshot& s) { correlation.sample(s); },
        [&] { correlation.close_block(); });
    const double phi = correlation.inner_packing().mean;
    EXPECT_NEAR(phi, packing, 0.05 * packing);
    const double expected = (1.0 - 7.0 * phi / 16.0) / ((1.0 - phi) * (1.0 - phi));
    const Estimate contact = correlation.contact();
    EXPECT_LT(contact.error, 0.035 * expected);
    EXPECT_NEAR(contact.mean, expected, 3.5 * contact.error + 0.009 * expected) << phi;
    // Hard discs do not overlap.
    EXPECT_EQ(correlation.g(10).mean, 0.0);
    EXPECT_EQ(correlation.inner_g(19).mean, 0.0);
}
INSTANTIATE_TEST_SUITE_P(PackingFractions, HardDiscs, ::testing::Values(0.1, 0.3, 0.5));

// The discs share one energy. A container at rest conserves no momentum, but its angular momentum,
// which changes the moments by 1/N.
TEST(IdealGas, HasMaxwellsDistributionAndIndependentVelocities) {
    constexpr std::size_t n = 500;
    VelocityDistribution distribution(1);
    VelocityCorrelation correlation({std::sqrt(n / 0.2), 1.0}, 1);
    sample_gas(
        n, 0.2, 600, 2.0,
        [&](const Snapshot& s) {
            distribution.sample(s);
            correlation.sample(s);
        },
        [&] {
            distribution.close_block();
            correlation.close_block();
        });
    const Estimate kurtosis = row_of(distribution, "kurtosis");
    EXPECT_NEAR(kurtosis.mean, 3.0, 4.0 * kurtosis.error + 3.0 / n);
    EXPECT_LT(kurtosis.error, 0.03);
    EXPECT_TRUE(std::isnan(row_of(distribution, "spin_kurtosis").mean));  // smooth discs at no spin
    for (std::size_t bin = 0; bin < VelocityDistribution::speed_bins; ++bin) {
        const double x = VelocityDistribution::speed_of(bin), low = x - 0.05, high = x + 0.05;
        const double maxwell = (std::exp(-low * low) - std::exp(-high * high)) / 0.1;
        const Estimate e = distribution.speed_density(bin);
        // The total energy is fixed, which changes the density by x⁴/N of its value. In a rare bin,
        // one disc more or less changes it by 10/300000.
        EXPECT_NEAR(e.mean, maxwell, 4.5 * e.error + (1.0 + std::pow(x, 4)) / n * maxwell + 2e-4)
            << x;
    }
    for (std::size_t bin = 20; bin < correlation.bins().count; ++bin)
        for (const Estimate& e : {correlation.along(bin), correlation.across(bin)})
            // 360 values with errors from 30 blocks (Student): no value deviates by more than 5
            // errors.
            EXPECT_NEAR(e.mean, -1.0 / (n - 1.0), 5.0 * e.error) << bin;
}

CollisionAngles collisions_of(const InitialState& scene) {
    CollisionAngles angles;
    Simulation gas(scene);
    gas.run(20 * scene.discs.size());
    Snapshot after = gas.snapshot();
    for (int block = 0; block < 50; ++block) {
        for (int k = 0; k < 3000; ++k) {
            const Event event = gas.step();
            gas.refresh(after, event);
            angles.sample_event(event, after);
        }
        angles.close_event_block(1.0);
    }
    return angles;
}

// A dilute gas without a preferred direction: the number of collisions in db is proportional to db,
// between discs and at the wall.
TEST(IdealGas, CollidesIsotropically) {
    const CollisionAngles angles = collisions_of(without_rotation(gas_at_rest(100, 0.02)));
    for (const char* row : {"impact", "wall_impact"}) {
        const Estimate e = row_of(angles, row);
        EXPECT_NEAR(e.mean, 0.5, 4.0 * e.error) << row;
        EXPECT_LT(e.error, 0.01) << row;
    }
    for (const char* row : {"orbit", "wall_orbit"})
        EXPECT_NEAR(row_of(angles, row).mean, 0.0, 4.0 * row_of(angles, row).error) << row;
    for (std::size_t k = 0; k < CollisionAngles::bins; ++k)
        for (const Estimate& e : {angles.density(k), angles.wall_density(k)})
            // 116 values with errors from 50 blocks: none is beyond 4.5.
            EXPECT_NEAR(e.mean, 0.5, 4.5 * e.error) << k;
    for (std::size_t k = 0; k < CollisionAngles::direction_bins; ++k)
        EXPECT_NEAR(angles.direction_density(k).mean, 1.0, 4.5 * angles.direction_density(k).error);
}

TEST(IdealGas, ThatRotatesHitsTheWallInItsDirection) {
    const InitialState scene = gas_at_rest(100, 0.02);
    ASSERT_LT(angular_momentum(scene), 0.0);
    const Estimate orbit = row_of(collisions_of(scene), "wall_orbit");
    EXPECT_LT(orbit.mean, -5.0 * orbit.error);
}

}  // namespace
}  // namespace swirl
