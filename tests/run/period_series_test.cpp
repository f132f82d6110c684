// The table of the averages of every period.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "io/scratch.hpp"
#include "swirl/io/atomic_file.hpp"
#include "swirl/math/random.hpp"
#include "swirl/run/measurements.hpp"
#include "swirl/run/period_series.hpp"
#include "swirl/run/run.hpp"

namespace swirl {
namespace {

std::size_t column(const PeriodSeries& series, const std::string& name) {
    for (std::size_t c = 0; c < series.columns().size(); ++c)
        if (series.columns()[c].name == name) return c;
    ADD_FAILURE() << "there is no column " << name;
    return 0;
}

double mean_of_counted(const PeriodSeries& series, const std::string& name) {
    double sum = 0.0, count = 0.0;
    for (std::size_t k = 0; k < series.periods(); ++k) {
        if (series.at(k, 1) == 0.0) continue;
        sum += series.at(k, column(series, name));
        count += 1.0;
    }
    return sum / count;
}

TEST(PeriodSeries, ItsMeansAreTheAveragesOfTheRun) {
    RunConfig config;
    config.discs = 20;
    config.periods = 40;
    config.warmup = 5;
    const std::vector<std::string> names{"centre", "collisions"};
    Observation observation = observation_of(config, names);
    PeriodSeries series(config, names);
    RunControl control;
    control.observation = &observation;
    control.series = &series;
    const RunResult result = run(config, control);

    ASSERT_EQ(series.periods(), 40u);
    double events = 0.0;
    for (std::size_t k = 0; k < series.periods(); ++k) {
        EXPECT_EQ(series.at(k, 0), static_cast<double>(k));
        EXPECT_EQ(series.at(k, 1), k < 5 ? 0.0 : 1.0);
        events += series.at(k, column(series, "events"));
    }
    EXPECT_EQ(events, static_cast<double>(result.events.total()));
    // Every period has as many samples by time, so the mean of the means is the mean; the sums are
    // added in another order.
    EXPECT_NEAR(mean_of_counted(series, "mean_by_time"), result.rotation.mean_by_time.mean, 1e-14);
    EXPECT_NEAR(mean_of_counted(series, "rigid_by_time"), result.rotation.rigid_by_time.mean,
                1e-14);
    int compared = 0;
    for (const auto& [name, report] : observation.report())
        for (const ReportRow& row : report.rows) {
            const std::string full = name + "." + row.name;
            // A rate of collisions is their number by the time. The centre is a mean over frames,
            // seven of which the series lacks at the start of a period: pinned discs are known
            // late.
            if (full == "collisions.disc_disc_rate" || full == "collisions.disc_wall_rate") {
                EXPECT_NEAR(mean_of_counted(series, full), row.estimate.mean, 1e-12) << full;
                ++compared;
            }
            if (full == "centre.x" || full == "centre.y") {
                EXPECT_NEAR(mean_of_counted(series, full), row.estimate.mean, 0.01) << full;
                ++compared;
            }
        }
    EXPECT_EQ(compared, 4);
    // The series samples 64 times per period and the measurement 511 times.
    EXPECT_NEAR(mean_of_counted(series, "centre_x"), mean_of_counted(series, "centre.x"), 0.01);
}

/// x' = a x + noise has the autocorrelation time (1 + a) / (1 − a).
TEST(PeriodSeries, TheAutocorrelationTimeIsThatOfAnAutoregressiveSeries) {
    PeriodSeries series(RunConfig{}, {});
    Random random(7);
    constexpr double a = 0.8;
    double x = 0.0;
    for (int k = 0; k < 20'000; ++k) {
        x = a * x + random.uniform() - 0.5;
        series.add_period({k, true, {x, x, x, x}, {1, 1, 1, 1}, random.uniform(), 0});
    }
    for (const SeriesAverage& average : series.averages()) {
        // The estimate of τ over a window of W lags has a relative error of sqrt(2 (2W + 1) / n),
        // 0.09 for W = 4 τ. Geyer's window ends where noise begins, so the bound is three times
        // that.
        const double expected = (1 + a) / (1 - a);
        if (average.name == "mean_by_time") {
            EXPECT_NEAR(average.autocorrelation_time, expected, 0.27 * expected);
        }
    }
}

TEST(PeriodSeries, TheAutocorrelationTimeOfUncorrelatedPeriodsIsOne) {
    PeriodSeries series(RunConfig{}, {});
    Random random(3);
    for (int k = 0; k < 1'000; ++k)
        series.add_period({k, k >= 100, {0, 0, 0, 0}, {1, 1, 1, 1}, random.uniform(), 0});
    for (const SeriesAverage& average : series.averages()) {
        if (average.name != "spin") continue;
        EXPECT_EQ(average.estimate.blocks, 900u);
        // At least 1 by definition; the window of the noise adds at most about 4/√n · few lags.
        EXPECT_GE(average.autocorrelation_time, 1.0);
        EXPECT_LT(average.autocorrelation_time, 1.3);
        EXPECT_NEAR(average.estimate.mean, 0.5, 5 * std::sqrt(1.0 / 12 / 900));
    }
}

TEST(PeriodSeries, TheFileReadsBackAsTheSameNumbers) {
    PeriodSeries series(RunConfig{}, {});
    series.add_period({0, false, {0.1, -1.0 / 3.0, not_available, 2e-300}, {1, 1, 1, 1}, 1.0, 17});
    const Scratch folder;
    series.write(folder / "s.csv");
    const std::string text = read_whole_file(folder / "s.csv");
    EXPECT_EQ(text,
              "period,counted,mean_by_event,mean_by_time,rigid_by_event,rigid_by_time,spin,energy,"
              "centre_x,"
              "centre_y,events\n0,0,0.1,-0.3333333333333333,,2e-300,1,,,,17\n");
}

}  // namespace
}  // namespace swirl
