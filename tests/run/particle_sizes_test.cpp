#include "swirl/run/particle_sizes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "run/rejected_parameters.hpp"
#include "swirl/run/config.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/json.hpp"
#include "swirl/run/run.hpp"

namespace swirl {
namespace {

/// Many particles of a law, in a container that has space for them.
std::vector<double> radii_of(const char* law, const char* seed = "1") {
    const RunConfig config = resolve(
        {{"sizes", law}, {"discs", "100000"}, {"container_radius", "2000"}, {"seed", seed}});
    std::vector<double> radii;
    for (const ParticleProperties& p : particles_of(config)) radii.push_back(p.radius);
    return radii;
}
double mean_power(const std::vector<double>& values, int n) {
    double sum = 0.0;
    for (const double value : values) sum += std::pow(value, n);
    return sum / static_cast<double>(values.size());
}

// Tolerances are four standard errors for n = 10⁵.
TEST(ParticleSizes, UniformRadiiHaveTheirMoments) {
    const auto radii = radii_of("uniform:0.5:1.5");
    EXPECT_NEAR(mean_power(radii, 1), 1.0, 4.0 * 0.289 / std::sqrt(1e5));
    EXPECT_NEAR(mean_power(radii, 2) - 1.0, 1.0 / 12.0, 4.0 * 0.6 / std::sqrt(1e5));
    for (const double r : radii) ASSERT_TRUE(r >= 0.5 && r < 1.5);
}
TEST(ParticleSizes, NormalRadiiAreCutOffAtThreeStandardDeviations) {
    const auto radii = radii_of("normal:1:0.1");
    EXPECT_NEAR(mean_power(radii, 1), 1.0, 4.0 * 0.1 / std::sqrt(1e5));
    // The variance of a standard normal deviate within ±3: 1 − 2·3·φ(3)/(2Φ(3) − 1) = 0.97334.
    const double variance = mean_power(radii, 2) - std::pow(mean_power(radii, 1), 2);
    EXPECT_NEAR(variance / 0.01, 0.97334, 4.0 * 1.4 / std::sqrt(1e5));
    for (const double r : radii) ASSERT_TRUE(r >= 0.7 && r <= 1.3);
}
TEST(ParticleSizes, LogarithmsOfLognormalRadiiAreNormal) {
    auto radii = radii_of("lognormal:2:0.2");
    for (double& r : radii) r = std::log(r / 2.0) / 0.2;
    EXPECT_NEAR(mean_power(radii, 1), 0.0, 4.0 / std::sqrt(1e5));
    EXPECT_NEAR(mean_power(radii, 2), 0.97334, 4.0 * 1.4 / std::sqrt(1e5));
}
TEST(ParticleSizes, PowerLawsHaveTheirDistributionFunction) {
    for (const double exponent : {-2.0, 0.0, 1.0, 2.5}) {
        const auto radii = radii_of(("power:" + std::to_string(exponent) + ":0.5:2").c_str());
        double below = 0.0;  // the share below 1
        for (const double r : radii) {
            ASSERT_TRUE(r >= 0.5 && r <= 2.0);
            below += r < 1.0 ? 1e-5 : 0.0;
        }
        const double b = 1.0 - exponent;
        const double expected =
            b == 0.0 ? 0.5 : (1.0 - std::pow(0.5, b)) / (std::pow(2.0, b) - std::pow(0.5, b));
        EXPECT_NEAR(below, expected, 4.0 * 0.5 / std::sqrt(1e5)) << exponent;
    }
}

TEST(ParticleSizes, FollowFromTheSeed) {
    EXPECT_EQ(radii_of("normal:1:0.1", "3"), radii_of("normal:1:0.1", "3"));
    EXPECT_NE(radii_of("normal:1:0.1", "3"), radii_of("normal:1:0.1", "4"));
}

TEST(ParticleSizes, MassesAreThoseOfOneMaterial) {
    for (const char* body : {"disc", "sphere"}) {
        const RunConfig config = resolve({{"sizes", "uniform:0.5:1"},
                                          {"discs", "20"},
                                          {"radius", "2"},
                                          {"mass", "3"},
                                          {"body", body}});
        for (const ParticleProperties& p : particles_of(config)) {
            const double ratio = p.radius / 2.0;
            const double expected =
                3.0 * ratio * ratio * (config.body == Shape::sphere ? ratio : 1.0);
            EXPECT_DOUBLE_EQ(p.mass, expected);
            const double factor = config.inertia / (3.0 * 4.0);
            EXPECT_DOUBLE_EQ(p.inertia, factor * p.mass * p.radius * p.radius);
        }
    }
}

// A list that says what --mixture says gives the same trajectory: one way of doing a thing.
TEST(ParticleSizes, AListEqualsTheMixture) {
    const RunConfig mixture = resolve({{"discs", "6"}, {"mixture", "2:0.5"}, {"events", "3000"}});
    const RunConfig list = resolve({{"sizes", "list 1 1 1 1 0.5 0.5"}, {"events", "3000"}});
    EXPECT_EQ(list.discs, 6);
    EXPECT_EQ(run(list).state_hash, run(mixture).state_hash);
    const RunConfig heavy = resolve({{"sizes", "list 1 1 1 1 0.5:2 0.5:2"}, {"events", "3000"}});
    EXPECT_EQ(
        run(heavy).state_hash,
        run(resolve({{"discs", "6"}, {"mixture", "2:0.5:2"}, {"events", "3000"}})).state_hash);
}

TEST(ParticleSizes, SurviveTheJson) {
    for (const char* sizes : {"uniform:0.8:1.2", "normal:1:0.1", "lognormal:1:0.1",
                              "power:2.5:0.5:1.5", "list 1 0.5:2 0.25"}) {
        const RunConfig config = resolve({{"sizes", sizes}});
        EXPECT_EQ(config_json(config)["sizes"], sizes);
        EXPECT_EQ(config_json(resolve(texts_of(config))), config_json(config));
    }
    // A later choice replaces the other of the two.
    const RunConfig mixture = resolve({{"mixture", "2:0.5"}}),
                    sizes = resolve({{"sizes", "normal:1:0.1"}});
    EXPECT_FALSE(resolve(overridden(texts_of(mixture), {{"sizes", "normal:1:0.1"}})).mixture);
    EXPECT_FALSE(resolve(overridden(texts_of(sizes), {{"mixture", "2:0.5"}})).sizes);
}

TEST(ParticleSizes, AShareOfAMixtureIsRoundedToWholeDiscs) {
    const auto count = [](const char* discs, const char* mixture) {
        return resolve({{"discs", discs}, {"mixture", mixture}}).mixture->count;
    };
    EXPECT_EQ(count("48", "50%:0.8"), 24);
    EXPECT_EQ(count("45", "50%:0.8"), 23);
    EXPECT_EQ(count("7", "33.3%:0.8"), 2);
    EXPECT_EQ(count("5", "100%:0.8"), 5);
    const RunConfig share = resolve({{"discs", "6"}, {"mixture", "33%:0.5"}, {"events", "3000"}});
    const RunConfig whole = resolve({{"discs", "6"}, {"mixture", "2:0.5"}, {"events", "3000"}});
    EXPECT_EQ(run(share).state_hash, run(whole).state_hash);
    // The share stays in the configuration, so that it holds for other numbers of discs.
    EXPECT_EQ(texts_of(share).at("mixture"), "33%:0.5");
    EXPECT_EQ(config_text(resolve(texts_of(share))), config_text(share));
    EXPECT_EQ(config_text(resolve(parameters_in(config_text(share)))), config_text(share));
    EXPECT_EQ(with_discs(share, 30).mixture->count, 10);
    EXPECT_EQ(with_discs(whole, 30).mixture->count, 2);
}

// A configuration that was changed after it was read is validated before it runs.
/// The particles that cannot spin, with this share and seed.
std::vector<double> held_spins(const char* share, const char* seed) {
    std::vector<double> held;
    for (const ParticleProperties& p :
         particles_of(resolve({{"discs", "40"}, {"cannot_spin", share}, {"seed", seed}})))
        held.push_back(1.0 - p.can_spin);
    return held;
}

TEST(CannotSpin, AShareIsRoundedAndDrawnWithTheSeed) {
    const auto count = [](const std::vector<double>& held) {
        return std::accumulate(held.begin(), held.end(), 0.0);
    };
    EXPECT_EQ(count(held_spins("0", "1")), 0.0);
    EXPECT_EQ(count(held_spins("0.3", "1")), 12.0);
    EXPECT_EQ(count(held_spins("0.51", "1")), 20.0);
    EXPECT_EQ(count(held_spins("1", "1")), 40.0);
    EXPECT_EQ(held_spins("0.3", "1"), held_spins("0.3", "1"));
    EXPECT_NE(held_spins("0.3", "1"), held_spins("0.3", "2"));
}
TEST(CannotSpin, ALargerShareIncludesTheParticlesOfASmallerOne) {
    const auto few = held_spins("0.3", "5"), many = held_spins("0.6", "5");
    for (std::size_t i = 0; i < few.size(); ++i) EXPECT_LE(few[i], many[i]);
}
TEST(CannotSpin, IsWrittenOnlyIfItIsSet) {
    EXPECT_FALSE(config_json(resolve({})).contains("cannot_spin"));
    EXPECT_EQ(config_json(resolve({{"cannot_spin", "0.5"}}))["cannot_spin"], 0.5);
}
TEST(CannotSpin, ParticlesWithASpinAreRejected) {
    const ParameterTexts spinning{{"initial", "states 2:0:1:0:0.5"}, {"cannot_spin", "1"}};
    expect_rejected(spinning, "disc 0 has the spin 0.5, but it cannot spin");
}

TEST(ParticleSizes, AMixtureOfMoreDiscsThanThereAreDoesNotRun) {
    RunConfig config = resolve({{"mixture", "45:0.8"}, {"events", "3000"}});
    EXPECT_THROW(with_discs(config, 44), UsageError);
    config.discs = 44;
    EXPECT_THROW(run(config), UsageError);
}

TEST(ParticleSizes, ListsAreValidated) {
    for (const char* share : {"0%:0.8", "-1%:0.8", "101%:0.8"})
        expect_rejected({{"mixture", share}}, "the share in --mixture is");
    expect_rejected({{"mixture", "1%:0.8"}, {"discs", "20"}}, "rounds to none of 20 discs");
    for (const char* text : {"%:0.8", "x%:0.8", "50%", "50%:", "5 %:0.8", "50%%:0.8"})
        expect_rejected({{"mixture", text}}, "COUNT:RADIUS");
    expect_rejected({{"sizes", "list 1 x"}}, "entry 2");
    expect_rejected({{"sizes", "list 1 1:2:3"}}, "entry 2");
    expect_rejected({{"sizes", "list 1 nan"}}, "entry 2");
    expect_rejected({{"sizes", "list 1 0"}}, "a radius in --sizes is 0");
    expect_rejected({{"sizes", "list 1 -1"}}, "a radius in --sizes is -1");
    expect_rejected({{"sizes", "list 1 1:0"}}, "a mass in --sizes is 0");
    expect_rejected({{"sizes", "list 1 9"}}, "does not fit");
    expect_rejected({{"sizes", "list 1 1"}, {"discs", "3"}}, "lists 2 particles, but --discs is 3");
    expect_rejected({{"sizes", "list "}}, "lists no particles");
}

}  // namespace
}  // namespace swirl
