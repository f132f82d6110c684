#include "swirl/run/pinned_series.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <memory>

#include "swirl/measure/observation.hpp"
#include "swirl/run/measured_series.hpp"
#include "swirl/run/run.hpp"

namespace swirl {
namespace {

/// The frames of a run in memory.
SnapshotSeries recorded(int frames_per_period, std::int64_t periods) {
    RunConfig config;
    config.discs = 30;
    config.periods = periods;
    Run run(config);
    SampleTimes times = run.sample_times(frames_per_period);
    const auto frames = std::make_shared<std::vector<Snapshot>>();
    while (run.next_event()) {
        while (run.next_sample(times)) frames->push_back(run.snapshot().up_to_date());
        run.pass_event();
    }
    SnapshotSeries series;
    series.frames = frames->size();
    series.frame = [frames](std::uint64_t k) { return (*frames)[k]; };
    return series;
}

double mean_of_known(const SnapshotSeries& series, std::vector<double> PinnedColumns::*column) {
    double sum = 0.0, count = 0.0;
    for (std::uint64_t k = 0; k < series.frames; ++k)
        for (const double state : series.pinned(k).*column)
            if (!std::isnan(state)) sum += state, count += 1.0;
    return sum / count;
}

TEST(PinnedSeries, ItsSharesAreThoseOfTheMeasurements) {
    const SnapshotSeries series = with_pinned_discs(recorded(511, 6));
    ASSERT_TRUE(series.pinned);
    const MeasuredSeries measured = measure_series(series, {"pinned", "residence"});
    const auto share = [&](std::size_t measurement) {
        for (const ReportRow& row : measured.reports[measurement].report.rows)
            if (std::string(row.name) == "share") return row.estimate.mean;
        return not_available;
    };
    // The measurement of pinned discs omits the first and the last seven of 3066 frames, too.
    EXPECT_NEAR(mean_of_known(series, &PinnedColumns::pinned), share(0), 1e-12);
    // Residences that had begun before the first frame, or have not ended at the last, are unknown
    // here until they are long; the measurement counts them as not resident: at most 2 × 40 frames.
    EXPECT_NEAR(mean_of_known(series, &PinnedColumns::resident), share(1), 80.0 / 3066.0);
}

TEST(PinnedSeries, StatesDoNotDependOnTheFrameThatIsReadFirst) {
    const SnapshotSeries frames = recorded(511, 4);
    PinnedSeries in_order(frames);
    std::vector<PinnedColumns> all;
    for (std::uint64_t k = 0; k < frames.frames; ++k) all.push_back(in_order.at(k));
    using ::testing::NanSensitiveDoubleEq;
    using ::testing::Pointwise;
    for (const std::uint64_t first : {3u, 250u, 777u, 1500u, 2043u}) {
        PinnedSeries series(frames);
        for (std::uint64_t k = first; k < std::min(first + 40, frames.frames); ++k) {
            EXPECT_THAT(series.at(k).pinned, Pointwise(NanSensitiveDoubleEq(), all[k].pinned)) << k;
            EXPECT_THAT(series.at(k).resident, Pointwise(NanSensitiveDoubleEq(), all[k].resident))
                << k;
        }
    }
    EXPECT_TRUE(std::isnan(all[6].pinned[0]));
    EXPECT_FALSE(std::isnan(all[7].pinned[0]));
    EXPECT_FALSE(std::isnan(all[frames.frames - 8].pinned[0]));
    EXPECT_TRUE(std::isnan(all[frames.frames - 7].pinned[0]));
}

TEST(PinnedSeries, StatesAreUnknownBelowTheRateThatTheyNeed) {
    EXPECT_FALSE(with_pinned_discs(recorded(30, 4)).pinned);
    const SnapshotSeries slow = with_pinned_discs(recorded(128, 4));
    ASSERT_TRUE(slow.pinned);
    EXPECT_TRUE(std::isnan(slow.pinned(200).pinned[0]));
    EXPECT_FALSE(std::isnan(slow.pinned(200).resident[0]));
}

}  // namespace
}  // namespace swirl
