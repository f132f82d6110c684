#include "swirl/measure/observation.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <set>

#include "measure/snapshots.hpp"
#include "swirl/measure/sample_times.hpp"

namespace swirl {
namespace {

using ::testing::NanSensitiveDoubleEq;
using ::testing::Pointwise;

std::vector<std::string> everything() {
    std::vector<std::string> names;
    for (const MeasurementKind& kind : measurement_kinds()) names.emplace_back(kind.name);
    return names;
}

const Report& report_of(const std::vector<MeasurementReport>& reports, const std::string& name) {
    for (const MeasurementReport& r : reports)
        if (r.name == name) return r.report;
    static const Report none;
    return none;
}

/// `periods` periods of `per_period` samples of the same discs.
void observe(Observation& observation, int periods, int per_period) {
    for (int period = 0; period < periods; ++period) {
        for (int k = 0; k < per_period; ++k) {
            Snapshot s = random_discs(12, 7, static_cast<double>(k) / per_period);
            s.periods = period;
            observation.sample(s);
        }
        observation.close_block();
    }
}

Observation observation_of(std::vector<std::string> names) {
    const Snapshot s = random_discs(12, 7);
    return Observation({s.container_radius, s.period}, std::move(names));
}

TEST(Observation, NeedsFollowFromTheFunctionsOfTheClass) {
    std::set<std::string> pinned, tracks, cells, events, any_path;
    for (const MeasurementKind& kind : measurement_kinds()) {
        if (kind.needs_pinned) pinned.emplace(kind.name);
        if (kind.needs_tracks) tracks.emplace(kind.name);
        if (kind.needs_cells) cells.emplace(kind.name);
        if (kind.needs_events) events.emplace(kind.name);
        if (!kind.needs_m_frame) any_path.emplace(kind.name);
    }
    using Names = std::set<std::string>;
    EXPECT_EQ(pinned, (Names{"pinned", "slip", "frustration"}));
    EXPECT_EQ(tracks, (Names{"pinned", "slip", "frustration", "diffusion"}));
    EXPECT_EQ(cells, (Names{"order", "packing", "segregation"}));
    EXPECT_EQ(events, (Names{"collisions", "wall", "energy", "torque", "collision_angles"}));
    EXPECT_EQ(any_path, (Names{"collisions", "contact_network", "diffusion", "energy",
                               "fluctuations", "order", "packing", "pair_correlation", "radial",
                               "rolling", "segregation", "velocity_correlation"}));
}

TEST(Observation, UsesEveryFrameAndEvery32ndEvent) {
    Observation observation = observation_of({"density"});
    observe(observation, 2, 50);
    Event event{};
    event.kind = EventKind::path_vertex;
    for (int k = 0; k < 31; ++k) observation.sample(event, random_discs(12, 7));
    observation.close_block();
    const auto by_event = [&] {
        const auto reports = observation.report();
        const ReportTable& table = report_of(reports, "density").tables.front();
        double sum = 0.0;
        for (std::size_t r = 0; r < table.rows(); ++r) sum += table.at(r, 4);
        return sum;
    };
    EXPECT_TRUE(std::isnan(by_event()));
    observation.sample(event, random_discs(12, 7));  // the 32nd
    observation.close_block();
    EXPECT_GT(by_event(), 0.0);
}

// One frame per period for five periods: an average of every 64th or 100th of them would have none,
// or one, and could not have the error of five.
TEST(Observation, UsesEveryFrameIfThereAreFewerThan511) {
    const Snapshot s = random_discs(12, 7);
    Observation observation({s.container_radius, s.period},
                            {"order", "packing", "slip", "pair_correlation", "contact_network"},
                            true, 1.0);
    for (int period = 0; period < 5; ++period) {
        Snapshot frame = random_discs(12, 7 + static_cast<std::uint64_t>(period));
        frame.periods = period;
        observation.sample(frame);
        observation.close_block();
    }
    for (const auto& [name, row] : {std::pair{"order", "all"},
                                    {"packing", "all"},
                                    {"slip", "cluster_perimeter"},
                                    {"pair_correlation", "inner_packing"},
                                    {"contact_network", "coordination"}}) {
        const auto reports = observation.report();
        bool found = false;
        for (const ReportRow& r : report_of(reports, name).rows) {
            if (r.name != std::string(row)) continue;
            found = true;
            // Five at most, since the five frames may seem correlated by chance.
            EXPECT_GT(r.estimate.effective_samples, 1.0) << name;
            EXPECT_LE(r.estimate.effective_samples, 5.0) << name;
            EXPECT_EQ(r.estimate.blocks, 5u) << name;
            EXPECT_TRUE(std::isfinite(r.estimate.error)) << name;
        }
        EXPECT_TRUE(found) << name;
    }
}

// The criteria are times. At a tenth of the rate for which they were made, they would report
// another number without a word.
TEST(Observation, ValuesAreMissingBelowTheFrameRateThatTheyNeed) {
    const Snapshot s = random_discs(12, 7);
    const auto known = [&](double rate) {
        Observation observation({s.container_radius, s.period}, everything(), true, rate);
        observe(observation, 4, static_cast<int>(rate));
        std::set<std::string> names;
        for (const auto& [name, report] : observation.report())
            for (const ReportRow& row : report.rows)
                if (!std::isnan(row.estimate.mean)) names.insert(name + "." + row.name);
        return names;
    };
    // A recording of few periods lacks a frame, so 1 % less is enough.
    const std::set<std::string> all = known(507.0), residence = known(500.0), none = known(110.0);
    for (const char* name : {"pinned.share", "residence.share", "fluctuations.n_variance"})
        EXPECT_TRUE(all.contains(name)) << name;
    EXPECT_FALSE(residence.contains("pinned.share"));
    EXPECT_TRUE(residence.contains("residence.share"));
    EXPECT_FALSE(none.contains("residence.share"));
    EXPECT_FALSE(known(29.0).contains("fluctuations.n_variance"));
    for (const char* name : {"order.all", "slip.cluster_perimeter", "radial.mean"})
        EXPECT_EQ(none.contains(name), all.contains(name)) << name;
}

TEST(Observation, ReportsInTheOrderOfTheNamesAndIgnoresUnknownNames) {
    const Observation observation = observation_of({"slip", "nothing", "density"});
    EXPECT_THAT(observation.names(), testing::ElementsAre("slip", "density"));
    const auto reports = observation.report();
    ASSERT_EQ(reports.size(), 2u);
    EXPECT_EQ(reports[0].name, "slip");
    EXPECT_EQ(reports[1].report.tables.front().rows(), 10000u);
}

TEST(Observation, RowsAndColumnsAreCompleteWithoutSamples) {
    for (const auto& [name, report] : observation_of(everything()).report()) {
        EXPECT_FALSE(report.rows.empty() && report.tables.empty()) << name;
        for (const ReportRow& row : report.rows) {
            EXPECT_STRNE(row.name, "");
            EXPECT_STRNE(row.unit, "") << row.name;
            EXPECT_STRNE(row.description, "") << row.name;
            EXPECT_TRUE(std::isnan(row.estimate.mean)) << row.name;
        }
        for (const ReportTable& table : report.tables)
            for (const ReportColumn& column : table.columns) {
                EXPECT_NE(column.name, "") << name;
                EXPECT_STRNE(column.unit(), "") << column.name;
            }
    }
}

/// Every number of a report, in order.
std::vector<double> numbers_in(const Report& report) {
    std::vector<double> numbers;
    for (const ReportRow& row : report.rows) {
        numbers.insert(numbers.end(), {row.estimate.mean, row.estimate.error});
        for (const ReportDetail& detail : row.details) numbers.push_back(detail.value);
    }
    for (const ReportTable& table : report.tables)
        numbers.insert(numbers.end(), table.values.begin(), table.values.end());
    return numbers;
}

// A measurement does not depend on what is computed for others.
TEST(Observation, AMeasurementReportsTheSameAloneAndAmongAll) {
    for (const bool same_discs : {true, false}) {
        const Snapshot s = random_discs(12, 7);
        Observation all({s.container_radius, s.period}, everything(), same_discs);
        observe(all, 3, 210);
        const auto among_all = all.report();
        for (const std::string& name : everything()) {
            Observation one({s.container_radius, s.period}, {name}, same_discs);
            observe(one, 3, 210);
            const auto alone = one.report();
            EXPECT_THAT(numbers_in(report_of(alone, name)),
                        Pointwise(NanSensitiveDoubleEq(), numbers_in(report_of(among_all, name))))
                << name;
        }
    }
}

// Pinned discs of a frame are known seven frames later; then it must still be stored.
TEST(PinnedFrames, EarlierIsTheFrameOfSevenSamplesAgo) {
    for (const double rate : {511.0, 2.0 * 511.0}) {
        PinnedFrames frames(rate);
        const int delay = rate > 511.0 ? 14 : 7;
        for (int k = 0; k < 50; ++k) {
            frames.sample(random_discs(3, 7, k / rate));
            if (k < 2 * delay) {
                EXPECT_EQ(frames.earlier(), nullptr) << k;
                continue;
            }
            ASSERT_NE(frames.earlier(), nullptr) << k;
            EXPECT_EQ(frames.earlier()->time, empty_container((k - delay) / rate).time()) << k;
        }
        EXPECT_TRUE(frames.is_consistent());
    }
}

TEST(Observation, WithoutTracksCellsAreThoseOfThePresentFrame) {
    const Snapshot s = random_discs(12, 7);
    Observation observation({s.container_radius, s.period}, {"packing"}, false);
    observe(observation, 2, 100);
    const auto reports = observation.report();
    const Report& packing = report_of(reports, "packing");
    EXPECT_EQ(packing.rows[0].estimate.blocks, 2u);
    EXPECT_GT(packing.rows[0].estimate.mean, 0.0);
    EXPECT_TRUE(std::isnan(packing.rows[1].estimate.mean));
}

// Twelve discs, of which one is replaced in the middle: the tracks give the results of two shorter
// recordings.
TEST(Observation, NewDiscsBeginNewTracks) {
    const auto moving = [](double time, double begin) {
        Snapshot s = empty_container();
        for (int i = 0; i < 12; ++i)
            add_disc(s, s.container_centre + 6.0 * unit_circle(begin + i / 12.0 - time), {});
        s.clock = time * s.period;
        s.held_at.assign(s.size(), s.clock);
        return s;
    };
    for (const bool announced : {true, false}) {
        Observation observation = observation_of({"pinned", "diffusion"});
        for (int k = 0; k < 60; ++k) {
            if (k == 30 && announced) observation.begin_tracks();
            observation.sample(moving(k / 511.0, k < 30 ? 0.0 : 0.31));
        }
        observation.close_block();
        const auto reports = observation.report();
        const ReportTable& diffusion = report_of(reports, "diffusion").tables.front();
        // No disc has moved by more than 2π · 6 · 28/511 = 2.1.
        double longest = 0.0;
        for (std::size_t r = 0; r < diffusion.rows(); ++r)
            longest = std::max(longest, diffusion.at(r, 1));
        EXPECT_EQ(longest < 2.1 * 2.1, announced) << longest;
    }
}

TEST(SampleTimes, AreEquallySpacedAndThePeriodIsHalfOpen) {
    const ContainerPath path = polygon_path(1.0, 2.0, 6);
    SampleTimes times(4, 2.0);
    Snapshot s;
    s.period = 2.0;
    std::vector<double> found;
    for (const double until : {0.4, 0.5, 2.0})
        while (times.next(s, path, until)) found.push_back(s.clock);
    EXPECT_THAT(found, testing::ElementsAre(0.0, 0.5, 1.0, 1.5));
    s.periods = 1;
    ASSERT_TRUE(times.next(s, path, 0.0));
    EXPECT_EQ(s.clock, 0.0);
}

TEST(SampleTimes, DueIsTheNextTimeOfThisPeriodAndZeroInAnother) {
    const ContainerPath path = polygon_path(1.0, 2.0, 6);
    SampleTimes times(4, 2.0);
    Snapshot s;
    s.period = 2.0;
    EXPECT_EQ(times.due(0), 0.0);  // not yet determined
    ASSERT_TRUE(times.next(s, path, 0.0));
    EXPECT_EQ(times.due(0), 0.5);
    EXPECT_EQ(times.due(1), 0.0);
    while (times.next(s, path, 2.0)) {
    }
    EXPECT_EQ(times.due(0), never);
    EXPECT_EQ(times.due(1), 0.0);
}

TEST(SampleTimes, IntervalContinuesAcrossPeriods) {
    const ContainerPath path = polygon_path(1.0, 2.0, 6);
    SampleTimes times(0, 2.0, 1.5);
    Snapshot s;
    s.period = 2.0;
    std::vector<double> found;
    for (s.periods = 0; s.periods < 3; ++s.periods)
        while (times.next(s, path, 2.0)) found.push_back(s.time());
    EXPECT_THAT(found, testing::ElementsAre(0.0, 1.5, 3.0, 4.5));
}

}  // namespace
}  // namespace swirl
