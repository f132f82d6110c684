#include "swirl/paper/several_seeds.hpp"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "swirl/paper/points.hpp"

namespace swirl {
namespace {

using Json = nlohmann::ordered_json;

Json average(double mean, double error) {
    return {{"mean", mean}, {"error", error}, {"effective_samples", 100.0}, {"blocks", 100}};
}

/// A run of 120 swirls, 20 of them warm-up.
Json run_of(double rotation, const char* verdict = "steady", double periods = 120.0) {
    Json json{{"config", {{"seed", 1}, {"warmup", nullptr}}},
              {"events", {{"total", 1000}}},
              {"periods", periods},
              {"warmup", {{"periods", 20}}},
              {"state_hash", "0123456789abcdef"},
              {"steady_state", {{"verdict", verdict}}}};
    for (const char* which : {"by_event", "by_time", "rigid_by_event", "rigid_by_time"})
        json["rotation"][which] = average(rotation, 0.1);
    return json;
}

TEST(SeveralSeeds, AveragesAreThoseOfTheRunsAndHaveTheErrorOfAll) {
    const Json all = replicates({run_of(0.1), run_of(0.3)});
    EXPECT_NEAR(number(at(all, {"rotation", "by_event", "mean"})), 0.2, 1e-12);
    // Within: 0.1/√2; between: 0.1. A factor of Student's comes on top.
    EXPECT_GT(number(at(all, {"rotation", "by_event", "error"})), 0.1);
    EXPECT_LT(number(at(all, {"rotation", "by_event", "error"})), 0.11);
    EXPECT_EQ(all["seeds"]["runs"], 2);
    EXPECT_EQ(all["seeds"]["disagree"], false);
    EXPECT_EQ(steadiness(all), "steady");
}

TEST(SeveralSeeds, ACellThatAllHaveStaysAsItIsToTheBit) {
    const auto with = [](double layer) {
        Json run = run_of(0.1);
        run["measured"]["wall"]["sensitivity"] = {{"layer", {layer}}};
        return run;
    };
    // (1.3 + 1.3 + 1.3) / 3 is another number.
    const Json all = replicates({with(1.3), with(1.3), with(1.3), with(1.3), with(1.3)});
    EXPECT_EQ(all["measured"]["wall"]["sensitivity"]["layer"][0], 1.3);
    const Json later = replicates({with(not_available), with(1.7), with(1.7)});
    EXPECT_EQ(later["measured"]["wall"]["sensitivity"]["layer"][0], 1.7);
}

TEST(SeveralSeeds, ByTimeLongRunsCountMore) {
    const Json all = replicates({run_of(0.0, "steady", 120.0), run_of(0.4, "steady", 320.0)});
    EXPECT_NEAR(number(at(all, {"rotation", "by_time", "mean"})), 0.3, 1e-12);
    EXPECT_NEAR(number(at(all, {"rotation", "by_event", "mean"})), 0.2, 1e-12);
}

TEST(SeveralSeeds, SeedsThatScatterTooMuchAreSaidToDisagree) {
    const Json all = replicates({run_of(0.0), run_of(1.0), run_of(0.0), run_of(1.0)});
    EXPECT_EQ(all["seeds"]["disagree"], true);
    EXPECT_NEAR(number(all["seeds"]["scatter"]), 0.5 / 0.1 * std::sqrt(4.0 / 3.0), 1e-12);
}

TEST(SeveralSeeds, ARunThatDriftsMakesThePointDrift) {
    const Json all = replicates({run_of(0.0), run_of(0.0, "drifting"), run_of(0.0)});
    EXPECT_EQ(steadiness(all), "drifting");
    EXPECT_EQ(all["seeds"]["steady"], 2);
    EXPECT_EQ(steadiness(replicates({run_of(0.0), run_of(0.0, "too short to tell")})),
              "too short to tell");
}

TEST(SeveralSeeds, WhatEndedInItsWarmupIsNotAveragedAndCounted) {
    Json short_run = run_of(5.0, "too short to tell", 3.0);
    short_run["warmup"]["periods"] = 0;
    const Json all = replicates({run_of(0.1), short_run, run_of(0.3), {{"failed", "why"}}});
    EXPECT_NEAR(number(at(all, {"rotation", "by_event", "mean"})), 0.2, 1e-12);
    EXPECT_EQ(all["seeds"]["too_short_to_average"], 1);
    EXPECT_EQ(all["seeds"]["failed"], 1);
    EXPECT_EQ(all["seeds"]["averaged"], 2);
    EXPECT_TRUE(failed(replicates({short_run, short_run})));
    // Who asks for no warm-up has none to end.
    short_run["config"]["warmup"] = 0;
    EXPECT_FALSE(failed(replicates({short_run, short_run})));
    EXPECT_EQ(replicates({{{"failed", "why"}}})["failed"], "why");
}

TEST(SeveralSeeds, FourSwirlsAfterTheWarmupAreNoAverageAndFiveAre) {
    const auto lasting = [](int periods) {
        Json run = run_of(1.04, "too short to tell", 20.0 + periods);
        run["rotation"]["by_event"]["blocks"] = periods;
        return run;
    };
    const Json all = replicates({run_of(1.0), lasting(4), run_of(1.0)});
    EXPECT_EQ(number(at(all, {"rotation", "by_event", "mean"})), 1.0);
    EXPECT_EQ(all["seeds"]["too_short_to_average"], 1);
    EXPECT_EQ(replicates({run_of(1.0), lasting(5)})["seeds"]["averaged"], 2);
    const Json none = replicates({lasting(4), lasting(4)});
    EXPECT_EQ(none["failed"], "no run had 5 swirls after its warm-up, so nothing is averaged.");
}

TEST(SeveralSeeds, MeasuredRowsTablesCountsAndDirections) {
    Json a = run_of(0.0), b = run_of(0.0);
    const auto direction = [](double angle, double count) {
        Json json = average(angle, 1.0);
        json["concentration"] = 0.5;
        json["count"] = count;
        return json;
    };
    a["measured"] = {{"pinned", {{"becoming_free", direction(350.0, 10)}}},
                     {"profile",
                      {{"theta", {2.5, 7.5}},
                       {"visits", {10, 20}},
                       {"varpi_m", {-1.0, nullptr}},
                       {"varpi_m_error", {0.1, nullptr}}}}};
    b["measured"] = {{"pinned", {{"becoming_free", direction(10.0, 30)}}},
                     {"profile",
                      {{"theta", {2.5, 7.5}},
                       {"visits", {1, 2}},
                       {"varpi_m", {-1.1, -2.0}},
                       {"varpi_m_error", {0.1, 0.3}}}}};
    const Json all = replicates({a, b})["measured"];
    const double free = number(all["pinned"]["becoming_free"]["mean"]);
    EXPECT_NEAR(std::remainder(free, 360.0), 0.0, 1e-9);
    EXPECT_EQ(all["pinned"]["becoming_free"]["count"], 40.0);
    EXPECT_EQ(all["profile"]["theta"], Json({2.5, 7.5}));
    EXPECT_EQ(all["profile"]["visits"], Json({11.0, 22.0}));
    EXPECT_NEAR(number(all["profile"]["varpi_m"][0]), -1.05, 1e-12);
    EXPECT_NEAR(number(all["profile"]["varpi_m"][1]), -2.0, 1e-12);
    EXPECT_NEAR(number(all["profile"]["varpi_m_error"][1]), 0.3, 1e-12);
}

TEST(SeveralSeeds, WhatIsNoRunStaysAsItIs) {
    const Json other{{"energy", {1, 2, 3}}};
    EXPECT_EQ(replicates({other}), other);
}

}  // namespace
}  // namespace swirl
