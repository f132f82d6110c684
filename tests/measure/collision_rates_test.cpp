#include "swirl/measure/collision_rates.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "measure/snapshots.hpp"

namespace swirl {
namespace {

Event event_of(EventKind kind) { return {0, 0.0, kind, 0, 1, {1.0, 0.0}, {1.0, 0.0, false}, 0.0}; }

TEST(CollisionRates, CountPerDiscAndTime) {
    CollisionRates rates;
    for (int block = 0; block < 3; ++block) {
        for (int k = 0; k < 30; ++k) rates.sample_event(event_of(EventKind::disc_disc));
        for (int k = 0; k < 20; ++k) rates.sample_event(event_of(EventKind::disc_wall));
        for (int k = 0; k < 30; ++k) rates.sample_event(event_of(EventKind::path_vertex));
        rates.close_event_block(4.0, 5);
    }
    EXPECT_DOUBLE_EQ(row_of(rates, "disc_disc_rate").mean, 60.0 / 20.0);
    EXPECT_DOUBLE_EQ(row_of(rates, "disc_wall_rate").mean, 20.0 / 20.0);
    EXPECT_DOUBLE_EQ(rates.mean_free_time().mean, 20.0 / 80.0);
    EXPECT_NEAR(rates.mean_free_time().error, 0.0, 1e-15);
}

// Rates of 1 and 3 per unit time: 2 ± 1. The mean free time is 1/2, and d(1/x) = dx/x².
TEST(CollisionRates, ErrorOfTheMeanFreeTimeFollowsFromTheRate) {
    CollisionRates rates;
    for (const int hits : {1, 3}) {
        for (int k = 0; k < hits; ++k) rates.sample_event(event_of(EventKind::disc_wall));
        rates.close_event_block(1.0, 1);
    }
    EXPECT_DOUBLE_EQ(row_of(rates, "disc_wall_rate").mean, 2.0);
    EXPECT_DOUBLE_EQ(row_of(rates, "disc_wall_rate").error, 1.0);
    EXPECT_DOUBLE_EQ(rates.mean_free_time().mean, 0.5);
    EXPECT_DOUBLE_EQ(rates.mean_free_time().error, 0.25);
}

TEST(CollisionRates, AreNaNWithoutTimeOrDiscsAndZeroWithoutCollisions) {
    CollisionRates rates;
    EXPECT_TRUE(std::isnan(row_of(rates, "disc_disc_rate").mean));
    rates.sample_event(event_of(EventKind::disc_disc));
    rates.close_event_block(4.0, 0);
    EXPECT_TRUE(std::isnan(row_of(rates, "disc_disc_rate").mean));
    CollisionRates quiet;
    quiet.close_event_block(4.0, 5);
    EXPECT_EQ(row_of(quiet, "disc_disc_rate").mean, 0.0);
    EXPECT_TRUE(std::isinf(quiet.mean_free_time().mean));
}

}  // namespace
}  // namespace swirl
