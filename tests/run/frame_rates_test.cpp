// Every number of a recording at the minimum rate of its registry row is that of the run: with
// velocities in the frames, and from positions alone. Both see the same trajectory, so the
// difference of their values has a small error, which is that between the seeds.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "swirl/io/tracks.hpp"
#include "swirl/measure/quantities.hpp"
#include "swirl/measure/sample_times.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/measured_series.hpp"
#include "swirl/run/measurements.hpp"
#include "swirl/run/run.hpp"

namespace swirl {
namespace frame_rates {

constexpr int warmup = 20;

/// The values of a row, or of a column, by the place in its table; with the errors that it states.
struct Cell {
    double value, error;
};
using Place = std::vector<double>;
using Numbers = std::map<const Quantity*, std::map<Place, Cell>>;

void add_table(Numbers& all, const ReportTable& table) {
    const std::size_t columns = table.columns.size();
    for (std::size_t r = 0; r < table.rows(); ++r) {
        Place place;
        for (std::size_t c = 0; c < columns; ++c)
            if (table.columns[c].quantity->combines == Combines::as_axis)
                place.push_back(std::round(1e6 * table.at(r, c)));
        for (std::size_t c = 0; c < columns; ++c) {
            const ReportColumn& column = table.columns[c];
            if (column.is_error || column.quantity->combines == Combines::as_axis) continue;
            const bool has_error = c + 1 < columns && table.columns[c + 1].is_error;
            all[column.quantity][place] = {table.at(r, c),
                                           has_error ? table.at(r, c + 1) : not_available};
        }
    }
}

Numbers numbers_of(const RotationEstimates& rotation, const MeasurementReports& reports) {
    Numbers all;
    const auto add = [&](const Quantity& q, const Estimate& e) { all[&q][{}] = {e.mean, e.error}; };
    add(quantity("rotation.mean_by_time"), rotation.mean_by_time);
    add(quantity("rotation.rigid_by_time"), rotation.rigid_by_time);
    for (const auto& [name, report] : reports) {
        for (const ReportRow& row : report.rows) add(*row.quantity, row.estimate);
        for (const ReportTable& table : report.tables) add_table(all, table);
    }
    // A number of samples grows with the rate; its share of all does not.
    for (auto& [q, cells] : all) {
        if (q->combines != Combines::as_count) continue;
        double sum = 0.0;
        for (const auto& [place, cell] : cells) sum += cell.value;
        for (auto& [place, cell] : cells) cell.value /= sum;
    }
    return all;
}

enum class Holds { velocities, positions };
double minimum_of(const Quantity& q, Holds holds) {
    return holds == Holds::velocities ? q.min_rates.of_frames : q.min_rates.of_tracks;
}
/// All minima of the registry, and rates that are too low for many rows.
std::vector<int> rates_of_the_registry() {
    std::set<int> rates{8, samples_per_period};
    for (const Quantity& q : all_quantities::rows)
        for (const double rate : {q.min_rates.of_frames, q.min_rates.of_tracks})
            if (rate > 0.0 && rate < never_enough) rates.insert(static_cast<int>(rate));
    return {rates.begin(), rates.end()};
}

/// The positions of these frames, as tracks of a camera that sees lengths in r.
SnapshotSeries positions_of(const std::vector<Snapshot>& frames, const RunConfig& config,
                            int rate) {
    Tracks tracks;
    for (const Snapshot& s : frames) {
        TrackFrame frame;
        frame.number = static_cast<std::int64_t>(tracks.frames.size());
        for (std::size_t i = 0; i < s.size(); ++i) {
            frame.id.push_back(static_cast<std::int64_t>(i));
            frame.position.push_back((1.0 / config.radius) * s.position(i));
        }
        tracks.frames.push_back(std::move(frame));
    }
    TrackScale scale;
    scale.amplitude = config.amplitude / config.radius;
    scale.period = scale.our_period();
    scale.frames_per_time = rate / scale.period;
    const Vec2 centre = frames.front().container_centre;
    scale.phase = std::atan2(centre.y, centre.x);
    scale.container_radius = config.container_radius / config.radius;
    return series_of(std::move(tracks), scale);
}

SnapshotSeries velocities_of(const std::vector<Snapshot>& frames, const RunConfig& config) {
    SnapshotSeries series;
    series.frames = frames.size();
    series.frame = [&frames](std::uint64_t k) { return frames[k]; };
    series.units = units_of(config);
    return series;
}

/// The numbers of one run, and those of its recordings.
struct Measured {
    Numbers run;
    std::map<std::pair<Holds, int>, Numbers> recorded;
};

Measured measured(const RunConfig& config, const std::vector<int>& rates) {
    Observation observation = observation_of(config, read_measurement_list("all"));
    RunControl control;
    control.observation = &observation;
    swirl::Run run(config, control);
    std::vector<SampleTimes> times;
    std::vector<std::vector<Snapshot>> frames(rates.size());
    for (const int rate : rates) times.push_back(run.sample_times(rate));
    while (run.next_event()) {
        for (std::size_t k = 0; k < rates.size(); ++k)
            while (run.next_sample(times[k]))
                if (run.snapshot().periods >= warmup - 1) frames[k].push_back(run.snapshot());
        run.pass_event();
    }
    Measured all;
    all.run = numbers_of(run.result().rotation, observation.report());
    const std::vector<std::string> names = measurable(read_measurement_list("all"), true);
    const auto add = [&](Holds holds, int rate, const SnapshotSeries& series, double begin) {
        const MeasuredSeries found = measure_series(series, names, begin);
        all.recorded[{holds, rate}] = numbers_of(found.rotation, found.reports);
    };
    for (std::size_t k = 0; k < rates.size(); ++k) {
        const Snapshot& first = frames[k].front();
        const double begin = double(first.periods) + first.clock / first.period;
        add(Holds::velocities, rates[k], velocities_of(frames[k], config), warmup);
        add(Holds::positions, rates[k], positions_of(frames[k], config, rates[k]), warmup - begin);
    }
    return all;
}

/// The difference of a number in recordings and runs: root mean square over the cells of its table.
struct Difference {
    double bias = 0.0;     // deviation of the means over the seeds
    double scatter = 0.0;  // its standard error
    double error = 0.0;    // error of the number in 400 periods
};

/// Differences of angles are on the circle.
double difference(const Quantity& q, double a, double b) {
    return q.combines == Combines::as_direction ? std::remainder(a - b, 360.0) : a - b;
}

struct Sums {
    double n = 0.0, sum = 0.0, square = 0.0;

    void add(double value) {
        n += 1.0;
        sum += value;
        square += value * value;
    }
    double mean() const { return sum / n; }
    double variance() const { return std::fmax(square - sum * sum / n, 0.0) / (n - 1.0); }
};

/// Over the cells that all seeds know; an error of 0 if there is none.
Difference compare(const std::vector<Measured>& seeds, const Quantity& q, Holds holds, int rate,
                   double periods) {
    double bias = 0.0, scatter = 0.0, error = 0.0;
    for (const auto& [place, unused] : seeds.front().run.at(&q)) {
        Sums differences, errors, values;
        for (const Measured& seed : seeds) {
            const auto& recorded = seed.recorded.at({holds, rate}).at(&q);
            const auto& run = seed.run.at(&q);
            if (!recorded.contains(place) || !run.contains(place)) continue;
            const Cell whole = run.at(place), part = recorded.at(place);
            if (std::isnan(whole.value) || std::isnan(part.value)) continue;
            differences.add(difference(q, part.value, whole.value));
            values.add(whole.value);
            if (whole.error > 0.0) errors.add(whole.error * whole.error);
        }
        if (differences.n < double(seeds.size())) continue;
        bias += differences.mean() * differences.mean();
        scatter += differences.variance() / differences.n;
        error += (errors.n > 0.0 ? errors.mean() : values.variance()) * periods / 400.0;
    }
    return {std::sqrt(bias), std::sqrt(scatter), std::sqrt(error)};
}

struct Study {
    int discs, periods, seeds;
    int highest_rate = samples_per_period;
    /// A difference of this many standard errors is none of chance: Student's t for so few seeds,
    /// and all rows and rates.
    double chance;
};

std::vector<Measured> seeds_of(const Study& study, const std::vector<int>& rates) {
    std::vector<Measured> seeds;
    for (int seed = 1; std::ssize(seeds) < study.seeds; ++seed) {
        // A camera takes the path for a circle.
        RunConfig config = resolve({{"path", "circle"}});
        config.discs = study.discs;
        config.seed = static_cast<std::uint64_t>(100 + seed);
        config.warmup = warmup;
        config.periods = warmup + study.periods;
        try {
            seeds.push_back(measured(config, rates));
        } catch (const Failure&) {
            // 48 discs with friction can collapse. Another seed takes the place of such a run.
            if (seed > 2 * study.seeds) throw;
        }
    }
    return seeds;
}

bool is_missing(const std::vector<Measured>& seeds, const Quantity& q, Holds holds, int rate) {
    for (const Measured& seed : seeds)
        for (const auto& [place, cell] : seed.recorded.at({holds, rate}).at(&q))
            if (!std::isnan(cell.value)) return false;
    return true;
}

void expect_the_numbers_of_the_run(const Study& study) {
    SCOPED_TRACE(testing::Message() << study.discs << " discs");
    std::vector<int> rates = rates_of_the_registry();
    std::erase_if(rates, [&](int rate) { return rate > study.highest_rate; });
    const std::vector<Measured> seeds = seeds_of(study, rates);
    std::set<const Quantity*> compared;
    for (const Holds holds : {Holds::velocities, Holds::positions})
        for (const int rate : rates)
            for (const auto& [q, cells] : seeds.front().recorded.at({holds, rate})) {
                const std::string name =
                    fmt::format("{} of {} at {} frames per period", q->name,
                                holds == Holds::velocities ? "velocities" : "positions", rate);
                if (!rate_suffices(rate, minimum_of(*q, holds))) {
                    EXPECT_TRUE(is_missing(seeds, *q, holds, rate)) << name;
                    continue;
                }
                const Difference d = compare(seeds, *q, holds, rate, study.periods);
                if (d.error == 0.0) continue;
                compared.insert(q);
                EXPECT_LE(d.bias, d.error / 3.0 + study.chance * d.scatter)
                    << name << ": " << d.bias << " ± " << d.scatter << ", error " << d.error;
            }
    EXPECT_GT(compared.size(), 60u);
}

// 12 discs for the default tests: some numbers are more biased with few, others with many. Few rows
// need more than 64 frames per period, and those frames would take most of the time.
TEST(FrameRates, AtTheMinimumOfARowHaveTheNumberOfTheRun) {
    expect_the_numbers_of_the_run(
        {.discs = 12, .periods = 20, .seeds = 6, .highest_rate = 64, .chance = 8.0});
}

TEST(FrameRates, Slow_AtTheMinimumOfARowHaveTheNumberOfTheRun) {
    expect_the_numbers_of_the_run({.discs = 5, .periods = 100, .seeds = 8, .chance = 6.0});
    expect_the_numbers_of_the_run({.discs = 12, .periods = 40, .seeds = 8, .chance = 6.0});
    expect_the_numbers_of_the_run({.discs = 48, .periods = 12, .seeds = 8, .chance = 6.0});
}

}  // namespace frame_rates
}  // namespace swirl
