// The fit of the relations of a micropolar fluid, to fields with planted coefficients.
#include <gtest/gtest.h>

#include <cmath>

#include "swirl/math/normal_deviate.hpp"
#include "swirl/math/random.hpp"
#include "swirl/paper/fluid_relations.hpp"

namespace swirl {
namespace {

constexpr double planted_gamma = 0.7, planted_eta = 1.3, planted_diffusion = 0.4,
                 planted_ratio = 1.1;
constexpr std::size_t field_points = 300;

/// Seeds that have the same true fields, with noise in every column; `shared` is the covariance of
/// the noise of the torque and of the spin.
FieldSeeds planted_fields(std::size_t seeds, double noise, double shared = 0.0) {
    Random truth(1), random(2);
    FieldColumns f;
    const auto fill = [&](const char* name, auto value) {
        for (std::size_t p = 0; p < field_points; ++p) f[name].push_back(value(p));
    };
    const auto deviate = [&](std::size_t) { return normal_deviate(truth); };
    for (const char* name :
         {"vorticity", "spin", "strain_xx", "strain_xy", "spin_gradient_x", "spin_gradient_y",
          "kinetic_xx", "kinetic_yy", "kinetic_xy", "kinetic_couple_x", "kinetic_couple_y"})
        fill(name, deviate);
    const auto speed = [&](std::size_t p) { return std::sqrt(f["temperature"][p]); };
    // The second half of the points is outside the range and obeys no relation.
    fill("packing", [](std::size_t p) { return p < field_points / 2 ? 0.35 : 0.45; });
    fill("x", [](std::size_t) { return 6.0; });
    fill("y", [](std::size_t) { return -7.0; });
    fill("temperature", [](std::size_t p) { return 1.0 + 0.01 * double(p); });
    const auto obey = [&](const char* name, auto value) {
        fill(name, [&](std::size_t p) {
            return p < field_points / 2 ? value(p) : normal_deviate(truth);
        });
    };
    obey("torque", [&](std::size_t p) {
        return planted_gamma * speed(p) * (f["vorticity"][p] - 2.0 * f["spin"][p]);
    });
    obey("collisional_xx", [&](std::size_t p) {
        return 2.0 * planted_eta * speed(p) * f["strain_xx"][p] - f["kinetic_xx"][p] - 5.0;
    });
    obey("collisional_yy", [&](std::size_t p) {
        return -2.0 * planted_eta * speed(p) * f["strain_xx"][p] - f["kinetic_yy"][p] - 5.0;
    });
    obey("collisional_xy", [&](std::size_t p) {
        return 2.0 * planted_eta * speed(p) * f["strain_xy"][p] - f["kinetic_xy"][p] -
               0.5 * f["torque"][p];
    });
    obey("collisional_yx", [&](std::size_t p) { return f["collisional_xy"][p] + f["torque"][p]; });
    for (const std::string a : {"x", "y"})
        obey(("collisional_couple_" + a).c_str(), [&](std::size_t p) {
            return planted_diffusion * speed(p) * f["spin_gradient_" + a][p] -
                   f["kinetic_couple_" + a][p];
        });
    obey("pressure", [&](std::size_t p) {
        return planted_ratio * f["packing"][p] / pi * f["temperature"][p] *
               henderson_ratio(f["packing"][p]);
    });
    FieldSeeds all(seeds, f);
    for (FieldColumns& seed : all)
        for (auto& [name, column] : seed)
            for (double& value : column)
                if (name != "packing" && name != "temperature" && name != "x" && name != "y")
                    value += noise * normal_deviate(random);
    if (shared != 0.0)
        for (FieldColumns& seed : all)
            for (std::size_t p = 0; p < field_points; ++p) {
                const double common = normal_deviate(random);
                seed["spin"][p] += common;
                seed["torque"][p] += shared * common;
            }
    return all;
}
constexpr FieldRegion fitted_range{0.3, 0.4, 10.0};
constexpr double planted_coefficients[] = {planted_gamma, planted_eta, planted_diffusion,
                                           planted_ratio};

TEST(FluidRelations, RecoverPlantedCoefficientsExactly) {
    const FieldSeeds seeds = planted_fields(4, 0.0);
    for (int k = 0; k < 4; ++k) {
        const RelationFit fit = fit_relation(seeds, fluid_relations[k], fitted_range);
        EXPECT_EQ(fit.points, field_points / 2);
        // Rounding; the sums are differences of squares.
        EXPECT_NEAR(fit.coefficient.mean, planted_coefficients[k], 1e-10);
        EXPECT_NEAR(fit.explained.mean, 1.0, 1e-10);
        EXPECT_NEAR(fit.coefficient.error, 0.0, 1e-10);
    }
}

// Ordinary least squares would give k/(1 + noise²/⟨x²⟩): for D, half of it.
TEST(FluidRelations, AreNotBiasedByNoise) {
    const FieldSeeds seeds = planted_fields(8, 1.0);
    for (int k = 0; k < 3; ++k) {
        const RelationFit fit = fit_relation(seeds, fluid_relations[k], fitted_range);
        EXPECT_GT(fit.coefficient.error, 0.0);
        EXPECT_NEAR(fit.coefficient.mean, planted_coefficients[k], 4.0 * fit.coefficient.error);
        EXPECT_NEAR(fit.explained.mean, 1.0, 4.0 * fit.explained.error);
        // Each point has about √2 (1 + noise) / (8 √150) of the coefficient's scale.
        EXPECT_LT(fit.coefficient.error, 0.2 * planted_coefficients[k]);
    }
}

// Noise that torque and spin share within a run adds −2 shared/(4 + 1) per point to a plain fit.
TEST(FluidRelations, AreNotBiasedByNoiseThatBothSidesShare) {
    const RelationFit fit =
        fit_relation(planted_fields(8, 0.1, 3.0), fluid_relations[0], fitted_range);
    EXPECT_NEAR(fit.coefficient.mean, planted_gamma, 4.0 * fit.coefficient.error);
    EXPECT_LT(fit.coefficient.error, 0.3 * planted_gamma);
}

TEST(FluidRelations, ExplainNothingWhereNothingIsPlanted) {
    const RelationFit fit =
        fit_relation(planted_fields(8, 0.1), fluid_relations[0], {0.4, 0.5, 10.0});
    EXPECT_EQ(fit.points, field_points / 2);
    // The correlation of 150 random pairs has the error 1/√150; its square is below 10/150.
    EXPECT_LT(fit.explained.mean, 10.0 / 150.0);
}

TEST(FluidRelations, NeedSeedsAndKnownValues) {
    EXPECT_EQ(fit_relation({}, fluid_relations[0], fitted_range).points, 0u);
    FieldSeeds seeds = planted_fields(4, 0.1);
    seeds[2]["torque"][7] = not_available;
    const RelationFit fit = fit_relation(seeds, fluid_relations[0], fitted_range);
    EXPECT_EQ(fit.points, field_points / 2 - 1);
    EXPECT_TRUE(std::isfinite(fit.coefficient.mean));
    EXPECT_EQ(fit_relation(seeds, fluid_relations[0], {0.3, 0.4, 9.0}).points, 0u);  // x² + y² = 85
    EXPECT_TRUE(std::isnan(
        fit_relation(planted_fields(3, 0.1), fluid_relations[0], fitted_range).coefficient.mean));
}

// Carnahan and Starling's form by Henderson: its second virial coefficient is exact, Z = 1 + 2φ.
TEST(FluidRelations, ThePressureOfADiluteGasHasTheSecondVirialCoefficient) {
    EXPECT_EQ(henderson_ratio(0.0), 1.0);
    EXPECT_NEAR((henderson_ratio(1e-6) - 1.0) / 1e-6, 2.0, 1e-5);
    // Kolafa and Rottner 2006: Z = 2.063261 at 0.3; Henderson's error is below 0.5 %.
    EXPECT_NEAR(henderson_ratio(0.3), 2.063261, 0.005 * 2.063261);
}

}  // namespace
}  // namespace swirl
