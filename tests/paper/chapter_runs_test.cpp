#include "swirl/paper/chapter_runs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "swirl/run/config.hpp"

namespace swirl {
namespace {

TEST(Dish, PackingFractionOfItsDiscs) {
    EXPECT_EQ((Dish{10.0, 0.22}.discs(0.5)), 50);
    EXPECT_DOUBLE_EQ((DishPoints::Point{{10.0, 0.22}, 50}.packing_fraction()), 0.5);
}

TEST(Dish, ContainerHasSpeedOne) {
    for (const double radius : {6.0, 8.6, 60.0}) {
        const RunConfig config = dish_config({}, {radius, 0.22}, 10);
        EXPECT_NEAR(container_speed(config), 1.0, 1e-12);
        EXPECT_DOUBLE_EQ(config.amplitude, 0.22 * radius);
    }
}

// The fourth moment of two values ± 1 is the square of the second: 1 − 1/3.
TEST(PeriodFluctuations, BinderIsTwoThirdsForTwoEqualStates) {
    std::vector<double> values;
    for (int k = 0; k < 1000; ++k) values.push_back(k % 2 ? 1.0 : -1.0);
    const PeriodFluctuations found = period_fluctuations(values, 7);
    EXPECT_NEAR(found.binder, 2.0 / 3.0, 1e-12);
    EXPECT_NEAR(found.variance, 1000.0 / 999.0, 1e-12);
    // Alternating values are anticorrelated; a correlation time below 1 counts as 1.
    EXPECT_DOUBLE_EQ(found.correlation, 1.0);
    EXPECT_NEAR(found.susceptibility, 7.0 * found.variance, 1e-12);
}

// Fourth moment over the square of the second: 3 for a normal distribution, 9/5 for a uniform one.
TEST(PeriodFluctuations, BinderOfAUniformDistribution) {
    std::vector<double> values;
    for (int k = 0; k < 1001; ++k) values.push_back(0.001 * k);
    EXPECT_NEAR(period_fluctuations(values, 1).binder, 1.0 - 9.0 / 15.0, 1e-5);
}

// Blocks of equal values: an autocorrelation 1 − k/10 has the integrated time 1 + 2 Σ (1 − k/10) =
// 10, up to the random signs of the blocks.
TEST(PeriodFluctuations, CorrelationTimeOfBlocksIsTheirLength) {
    std::vector<double> values;
    std::uint32_t state = 1;
    for (int block = 0; block < 4000; ++block) {
        state = state * 1664525u + 1013904223u;
        values.insert(values.end(), 10, state >> 31 ? 1.0 : -1.0);
    }
    // The estimate has a relative error of about √(2 · 10 / 4000) = 0.07.
    EXPECT_NEAR(period_fluctuations(values, 1).correlation, 10.0, 2.0);
}

Json result_with(double rotation, double largest) {
    const auto average = [](double mean, double error) {
        return Json{{"mean", mean}, {"error", error}};
    };
    return {
        {"rotation", {{"rigid_by_time", average(rotation, 0.01)}}},
        {"measured",
         {{"slip", {{"cluster_perimeter", average(2.0 * pi * 8.0, 0.0)}}},
          {"contact_network", {{"largest", average(largest, 0.0)}, {"wall", average(0.1, 0.0)}}},
          {"centre", {{"distance", average(1.0, 0.0)}, {"elongation", average(1.1, 0.0)}}}}}};
}

TEST(DirectionChanges, AreTheZerosOfTheCurveOfEachDish) {
    DishPoints points;
    const Dish dish{10.0, 0.22}, other{20.0, 0.22};
    for (const double fraction : {0.2, 0.4, 0.6}) points.add(dish, fraction);
    points.add(dish, 0.2);  // is there already
    for (const double fraction : {0.2, 0.4}) points.add(other, fraction);
    ASSERT_EQ(points.points.size(), 5u);
    const std::vector<Json> results{result_with(0.3, 0.2), result_with(-0.1, 0.6),
                                    result_with(0.1, 1.0), result_with(0.5, 0.0),
                                    result_with(0.2, 0.0)};
    const std::vector<DirectionChange> changes = direction_changes(points, results);
    ASSERT_EQ(changes.size(), 2u);
    EXPECT_TRUE(changes[0].to_counterrotation);
    EXPECT_FALSE(changes[1].to_counterrotation);
    // At 0.2 + u the parabola through all three points is 0.3 − 3.5 u + 7.5 u². The straight line
    // has the slope −2, its zero at 0.35, and there the statistical error.
    const double u = (3.5 - std::sqrt(12.25 - 9.0)) / 15.0;
    EXPECT_NEAR(changes[0].packing_fraction, 0.2 + u, 1e-9);
    EXPECT_NEAR(changes[0].slope, -2.0, 1e-12);
    EXPECT_NEAR(changes[0].slope_error, 0.01 * std::sqrt(2.0) / 0.2, 1e-12);
    EXPECT_NEAR(changes[0].interpolation_error, 0.15 - u, 1e-9);
    EXPECT_NEAR(changes[0].error, std::hypot(std::hypot(0.25 * 0.01, 0.75 * 0.01) / 2.0, 0.15 - u),
                1e-9);
    EXPECT_NEAR(changes[0].largest, 0.2 + 2.0 * u, 1e-9);
    EXPECT_NEAR(changes[0].reach, 0.9, 1e-12);
    // A tenth of the discs is at the wall, where 9 π would fit.
    EXPECT_NEAR(changes[0].occupied, 10.0 * (0.2 + u) / (9.0 * pi), 1e-9);
    EXPECT_STREQ(kind_of(changes[0]), "wall");
    EXPECT_STREQ(kind_of(changes[1]), "back");
    // The other zero of the same parabola.
    EXPECT_NEAR(changes[1].packing_fraction, 0.2 + (3.5 + std::sqrt(12.25 - 9.0)) / 15.0, 1e-9);
    const std::vector<std::string> sentences = change_sentences(points, changes);
    ASSERT_EQ(sentences.size(), 2u);
    EXPECT_NE(sentences[1].find("no certain change"), std::string::npos);
}

}  // namespace
}  // namespace swirl
