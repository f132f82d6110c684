#include "swirl/run/measured_series.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "swirl/io/range_checks.hpp"
#include "swirl/io/trajectory.hpp"
#include "swirl/measure/observation.hpp"
#include "swirl/run/config.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/json.hpp"
#include "swirl/run/path_parameter.hpp"
#include "swirl/run/simd.hpp"
#include "swirl/statistics/few_blocks.hpp"

namespace swirl {

namespace {

/// The numbers that these frames are too few for, and the rate that they need.
std::string rate_remark(const Observation& observation, bool has_rotation, double rate,
                        bool differences) {
    std::map<double, std::vector<std::string>> missing;
    const auto needed = [&](const Quantity& q) {
        return differences ? q.min_rates.of_tracks : q.min_rates.of_frames;
    };
    if (!has_rotation) missing[needed(quantity("rotation.mean_by_time"))].push_back("the rotation");
    for (const auto& [name, report] : observation.report()) {
        std::map<double, std::vector<std::string>> here;
        std::size_t rows = 0;
        for (const ReportRow& row : report.rows) {
            if (row.quantity->per == Per::collision) continue;
            ++rows;
            if (!observation.has_rate(*row.quantity))
                here[needed(*row.quantity)].push_back(row.quantity->name);
        }
        for (const ReportTable& table : report.tables)
            for (const ReportColumn& column : table.columns) {
                const double minimum = needed(*column.quantity);
                // The rows of the measurement stand for its tables.
                if (observation.has_rate(*column.quantity) || here.contains(minimum)) continue;
                here[minimum].push_back(*table.name == '\0' ? name : name + "." + table.name);
            }
        for (const auto& [minimum, names] : here)
            if (rows > 0 && names.size() == rows)
                missing[minimum].push_back(name);
            else
                missing[minimum].insert(missing[minimum].end(), names.begin(), names.end());
    }
    std::string few, remark;
    for (const auto& [minimum, names] : missing)
        if (minimum < never_enough)
            few += fmt::format("{}{} ({:.0f})", few.empty() ? "" : "; ", fmt::join(names, ", "),
                               minimum);
    if (!few.empty())
        remark = fmt::format(
            "{} too few for these values, which are n/a (in brackets the rate that they need): "
            "{}.\nhint: record {} frames per period, or use `swirl run --measure`.",
            rate > 0.0 ? fmt::format("{:.3g} frames per period are", rate) : "a single frame is",
            few, samples_per_period);
    if (missing.contains(never_enough))
        remark += fmt::format(
            "{}positions alone do not show these values, which are n/a, because differences of "
            "positions miss the collisions between two frames: {}.\nhint: record 100 or more "
            "frames per period, so that velocities can be smoothed.",
            remark.empty() ? "" : "\n", fmt::join(missing[never_enough], ", "));
    return remark;
}

/// The whole periods that the frames show; each frame stands for a step of time. A recording begins
/// and ends within a period, and parts of periods count as no block.
std::size_t whole_periods(const MeasuredSeries& measured) {
    constexpr double rounding = 0.02;  // periods: the period of a video is measured
    const double step = measured.frames_per_period > 0.0 ? 1.0 / measured.frames_per_period : 0.0;
    return static_cast<std::size_t>(std::max(measured.periods, 0.0) + step + rounding);
}

/// ϖ by time from frames at any times: each stands for half of the steps before and after it.
class RotationByTime {
  public:
    explicit RotationByTime(bool uneven) : uneven_(uneven), rotation_(selected_width()) {}

    void sample(const Snapshot& s) {
        if (!uneven_) {
            rotation_.sample_by_time(s);
            return;
        }
        if (is_held_) pass(s.time() - held_.time());
        held_ = s;
        is_held_ = true;
    }
    /// The next frame is in another period.
    void close_block() {
        closes_ = uneven_;
        if (!uneven_) rotation_.close_block();
    }
    RotationEstimates estimates() {
        if (uneven_) pass(step_before_);
        rotation_.close_block();
        return rotation_.estimates();
    }

  private:
    /// Counts the held frame, whose successor is one step later.
    void pass(double step) {
        rotation_.sample_by_time(held_, 0.5 * (step_before_ + step));
        step_before_ = step;
        if (closes_) rotation_.close_block();
        closes_ = false;
    }

    bool uneven_;
    ClusterRotation rotation_;
    Snapshot held_;
    bool is_held_ = false, closes_ = false;
    double step_before_ = 0.0;
};

}  // namespace

double frames_per_period(const SnapshotSeries& series) {
    if (series.frames < 2) return 0.0;
    const Snapshot first = series.frame(0), last = series.frame(series.frames - 1);
    const double periods = last.periods_passed() - first.periods_passed();
    return periods > 0.0 ? static_cast<double>(series.frames - 1) / periods : 0.0;
}

bool holds_tracks(const SnapshotSeries& series) {
    std::uint64_t begin = 0, longest = 0;
    for (const std::uint64_t end : series.breaks) {
        longest = std::max(longest, end - begin);
        begin = end;
    }
    longest = std::max(longest, series.frames - begin);
    return series.same_discs() || longest > std::uint64_t(FrameWindow().width());
}

SnapshotSeries series_of_run(const std::shared_ptr<TrajectoryReader>& reader) {
    SnapshotSeries series = series_of(reader);
    series.frame = [reader](std::uint64_t k) {
        Snapshot s = reader->frame(k);
        require_separate_bodies(s, reader->path());
        return s;
    };
    const std::string parameters = reader->provenance("parameters");
    if (parameters.empty()) return series;
    try {
        const RunConfig config = resolve(parameters_in(parameters));
        series.has_m_frame = has_m_frame(config);
        series.clockwise = config.turns_clockwise();
        series.units = units_of(config);
    } catch (const UsageError&) {
        // The recording of another version, whose paths all have an M-frame.
    }
    return series;
}

std::vector<std::string> measurable(const std::vector<std::string>& names, bool tracked,
                                    bool has_m_frame) {
    std::vector<std::string> left;
    std::copy_if(names.begin(), names.end(), std::back_inserter(left), [&](const auto& name) {
        const MeasurementKind& kind = *find_measurement(name);
        return !kind.needs_events && (tracked || !kind.needs_tracks) &&
               (has_m_frame || !kind.needs_m_frame);
    });
    return left;
}

MeasuredSeries measure_series(const SnapshotSeries& series, const std::vector<std::string>& names,
                              double skip, const MeasuringControl& control) {
    if (series.frames == 0) throw Failure("there are no frames.");
    const Snapshot first = series.frame(0);
    // Frames of a camera may have negative numbers, and then begin before time 0.
    const double begin = std::min(first.time(), 0.0);
    MeasuredSeries measured;
    measured.frames_per_period = frames_per_period(series);
    Observation observation({first.container_radius, first.period, series.units}, names,
                            series.has_m_frame && holds_tracks(series), measured.frames_per_period);
    if (series.velocities_are_differences) observation.takes_differences();
    // A single frame has a rotation, but no average.
    const bool has_rotation =
        series.frames == 1 || observation.has_rate(quantity("rotation.mean_by_time"));
    measured.remark = rate_remark(observation, has_rotation, measured.frames_per_period,
                                  series.velocities_are_differences);
    const bool uneven = series.has_uneven_times();
    RotationByTime rotation(uneven);
    std::int64_t period = first.periods;
    auto next_break = series.breaks.begin();
    for (std::uint64_t k = 0; k < series.frames; ++k) {
        if (control.stop && control.stop->load())
            throw Interrupted("stopped before the last frame.");
        const Snapshot s = series.observed(k);
        const bool new_discs = next_break != series.breaks.end() && *next_break == k;
        if (new_discs) ++next_break;
        if (s.time() < begin + skip * s.period) continue;
        if (measured.frames > 0 && s.periods != period) {
            rotation.close_block();
            observation.close_block();
        }
        if (new_discs) observation.begin_tracks();
        period = s.periods;
        measured.discs = std::max(measured.discs, s.size());
        rotation.sample(s);
        observation.sample(s);
        ++measured.frames;
        if (control.progress) control.progress(k + 1, series.frames);
    }
    if (measured.frames == 0)
        throw Failure(fmt::format("no frame is left after the first {:g} periods.", skip));
    observation.close_block();
    observation.add_energy(series.missing_energy);
    measured.rotation = rotation.estimates();
    const double end = series.frame(series.frames - 1).time();
    measured.periods = (end - begin) / first.period - skip;
    const std::size_t periods = whole_periods(measured);
    measured.reports = observation.report(periods);
    for (Estimate* const e : {&measured.rotation.mean_by_time, &measured.rotation.rigid_by_time})
        *e = has_rotation ? corrected(*e, periods) : Estimate();
    const auto add_remark = [&](const std::string& remark) {
        measured.remark += (measured.remark.empty() ? "" : "\n") + remark;
    };
    if (uneven && !names.empty())
        add_remark(
            "frames are not at equal steps of time: the rotation is averaged by time, but the "
            "measurements count every frame the same, as an average by event does.\nhint: record "
            "with --frames-per-period.");
    if (measured.frames > 1 && whole_periods(measured) < min_blocks_of_an_error)
        add_remark(fmt::format(
            "errors are n/a, because {:.1f} periods are too few for an error: {} are needed, and "
            "twenty make it reliable.",
            measured.periods, min_blocks_of_an_error));
    return measured;
}

}  // namespace swirl
