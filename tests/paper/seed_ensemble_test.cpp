#include "swirl/paper/seed_ensemble.hpp"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "swirl/paper/results.hpp"

namespace swirl {
namespace {

Json average(double mean, double error) {
    return {{"mean", mean}, {"error", error}, {"effective_samples", 100.0}, {"blocks", 100}};
}

/// A run of 120 periods, 20 of them warm-up.
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

TEST(SeedEnsemble, MeanOverRunsWithErrorBetweenThem) {
    const Json all = seed_ensemble({run_of(0.1), run_of(0.3)});
    EXPECT_NEAR(number(at(all, {"rotation", "by_event", "mean"})), 0.2, 1e-12);
    // Within the runs 0.1/√2, between them 0.1, times a factor of Student's t close to 1.
    EXPECT_GT(number(at(all, {"rotation", "by_event", "error"})), 0.1);
    EXPECT_LT(number(at(all, {"rotation", "by_event", "error"})), 0.11);
    EXPECT_EQ(all["seeds"]["runs"], 2);
    EXPECT_EQ(all["seeds"]["disagree"], false);
    EXPECT_EQ(steadiness(all), "steady");
}

TEST(SeedEnsemble, CommonCellIsKeptBitwise) {
    const auto with = [](double layer) {
        Json run = run_of(0.1);
        run["measured"]["wall"]["sensitivity"] = {{"layer", {layer}}};
        return run;
    };
    // In floating point (1.3 + 1.3 + 1.3) / 3 differs from 1.3.
    const Json all = seed_ensemble({with(1.3), with(1.3), with(1.3), with(1.3), with(1.3)});
    EXPECT_EQ(all["measured"]["wall"]["sensitivity"]["layer"][0], 1.3);
    const Json later = seed_ensemble({with(not_available), with(1.7), with(1.7)});
    EXPECT_EQ(later["measured"]["wall"]["sensitivity"]["layer"][0], 1.7);
}

TEST(SeedEnsemble, AveragesByTimeAreWeightedByLength) {
    const Json all = seed_ensemble({run_of(0.0, "steady", 120.0), run_of(0.4, "steady", 320.0)});
    EXPECT_NEAR(number(at(all, {"rotation", "by_time", "mean"})), 0.3, 1e-12);
    EXPECT_NEAR(number(at(all, {"rotation", "by_event", "mean"})), 0.2, 1e-12);
}

TEST(SeedEnsemble, LargeScatterIsReportedAsDisagreement) {
    const Json all = seed_ensemble({run_of(0.0), run_of(1.0), run_of(0.0), run_of(1.0)});
    EXPECT_EQ(all["seeds"]["disagree"], true);
    EXPECT_NEAR(number(all["seeds"]["scatter"]), 0.5 / 0.1 * std::sqrt(4.0 / 3.0), 1e-12);
}

TEST(SeedEnsemble, OneDriftingRunMakesThePointDrift) {
    const Json all = seed_ensemble({run_of(0.0), run_of(0.0, "drifting"), run_of(0.0)});
    EXPECT_EQ(steadiness(all), "drifting");
    EXPECT_EQ(all["seeds"]["steady"], 2);
    EXPECT_EQ(steadiness(seed_ensemble({run_of(0.0), run_of(0.0, "too short to tell")})),
              "too short to tell");
}

TEST(SeedEnsemble, RunThatEndsInItsWarmupIsCountedNotAveraged) {
    Json short_run = run_of(5.0, "too short to tell", 3.0);
    short_run["warmup"]["periods"] = 0;
    const Json all = seed_ensemble({run_of(0.1), short_run, run_of(0.3), {{"failed", "reason"}}});
    EXPECT_NEAR(number(at(all, {"rotation", "by_event", "mean"})), 0.2, 1e-12);
    EXPECT_EQ(all["seeds"]["too_short_to_average"], 1);
    EXPECT_EQ(all["seeds"]["failed"], 1);
    EXPECT_EQ(all["seeds"]["averaged"], 2);
    EXPECT_TRUE(failed(seed_ensemble({short_run, short_run})));
    // A run without a warm-up cannot end in it.
    short_run["config"]["warmup"] = 0;
    EXPECT_FALSE(failed(seed_ensemble({short_run, short_run})));
    EXPECT_EQ(seed_ensemble({{{"failed", "reason"}}})["failed"], "reason");
}

TEST(SeedEnsemble, AverageNeedsFivePeriodsAfterTheWarmup) {
    const auto lasting = [](int periods) {
        Json run = run_of(1.04, "too short to tell", 20.0 + periods);
        run["rotation"]["by_event"]["blocks"] = periods;
        return run;
    };
    const Json all = seed_ensemble({run_of(1.0), lasting(4), run_of(1.0)});
    EXPECT_EQ(number(at(all, {"rotation", "by_event", "mean"})), 1.0);
    EXPECT_EQ(all["seeds"]["too_short_to_average"], 1);
    EXPECT_EQ(seed_ensemble({run_of(1.0), lasting(5)})["seeds"]["averaged"], 2);
    const Json none = seed_ensemble({lasting(4), lasting(4)});
    EXPECT_EQ(none["failed"], "no run has 5 periods after its warm-up, so nothing is averaged.");
}

TEST(SeedEnsemble, CombinesMeasuredAveragesTablesCountsAndDirections) {
    Json a = run_of(0.0), b = run_of(0.0);
    const auto direction = [](double angle, double count) {
        Json json = average(angle, 1.0);
        json["concentration"] = 0.5;
        json["count"] = count;
        return json;
    };
    a["measured"] = {{"pinned", {{"depinning", direction(350.0, 10)}}},
                     {"profile",
                      {{"theta", {2.5, 7.5}},
                       {"visits", {10, 20}},
                       {"varpi_m", {-1.0, nullptr}},
                       {"varpi_m_error", {0.1, nullptr}}}}};
    b["measured"] = {{"pinned", {{"depinning", direction(10.0, 30)}}},
                     {"profile",
                      {{"theta", {2.5, 7.5}},
                       {"visits", {1, 2}},
                       {"varpi_m", {-1.1, -2.0}},
                       {"varpi_m_error", {0.1, 0.3}}}}};
    const Json all = seed_ensemble({a, b})["measured"];
    const double angle = number(all["pinned"]["depinning"]["mean"]);
    EXPECT_NEAR(std::remainder(angle, 360.0), 0.0, 1e-9);
    EXPECT_EQ(all["pinned"]["depinning"]["count"], 40.0);
    EXPECT_EQ(all["profile"]["theta"], Json({2.5, 7.5}));
    EXPECT_EQ(all["profile"]["visits"], Json({11.0, 22.0}));
    EXPECT_NEAR(number(all["profile"]["varpi_m"][0]), -1.05, 1e-12);
    EXPECT_NEAR(number(all["profile"]["varpi_m"][1]), -2.0, 1e-12);
    EXPECT_NEAR(number(all["profile"]["varpi_m_error"][1]), 0.3, 1e-12);
}

TEST(SeedEnsemble, ResultThatIsNotARunIsUnchanged) {
    const Json other{{"energy", {1, 2, 3}}};
    EXPECT_EQ(seed_ensemble({other}), other);
}

}  // namespace
}  // namespace swirl
