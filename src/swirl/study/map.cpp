#include "swirl/study/map.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <thread>
#include <unordered_map>

#include "swirl/io/atomic_file.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/study/collected_sweep.hpp"
#include "swirl/study/crossing.hpp"
#include "swirl/study/point_result.hpp"
#include "swirl/study/sweep_folder.hpp"

namespace swirl {
namespace {

namespace fs = std::filesystem;

/// The results in the folder; each file is read once.
class MapResults {
  public:
    MapResults(const fs::path& folder, const SweepPlan& plan) : folder_(folder), plan_(plan) {
        if (!plan.map)
            throw Failure(fmt::format("'{}' holds a sweep, not a map.\nhint: use swirl sweep.",
                                      folder.string()));
    }

    /// Reads the folder again.
    void update() {
        const std::size_t points = plan_.points();
        done_ = numbered_files(part_of_sweep(folder_, "results", plan_), ".json", points);
        failed_ = numbered_files(folder_ / "failures", ".txt", points);
    }

    /// Removes the errors of failed runs, so that they are missing again.
    void retry_failed_runs() {
        update();
        std::error_code ignored;
        for (std::size_t point = 0; point < failed_.size(); ++point)
            if (failed_[point] && !done_[point]) fs::remove(failure_file(folder_, point), ignored);
    }

    const MapRun* find(std::size_t point) {
        if (const auto known = runs_.find(point); known != runs_.end()) return &known->second;
        MapRun run;
        if (done_[point]) {
            const PointResult result = read_result(folder_, plan_, point);
            if (!result.exists) {  // a damaged file
                done_[point] = false;
                return nullptr;
            }
            const MapTarget& target = *plan_.map;
            const std::string& name = target.is_of_crossing() ? target.rate : target.of;
            run.value = result.quantity(0, name);
            run.periods = result.periods;
            for (const MeasuredNumber& number : result.quantities)
                if (number.name == name) run.direction = number.direction;
        } else if (failed_[point]) {
            run.failed = true;
        } else {
            return nullptr;
        }
        return &runs_.emplace(point, run).first->second;
    }

    MapState explore() {
        update();
        return explore_map(plan_, [this](std::size_t point) { return find(point); });
    }

  private:
    const fs::path folder_;
    const SweepPlan& plan_;
    std::vector<bool> done_, failed_;
    std::unordered_map<std::size_t, MapRun> runs_;
};

std::size_t decided_sites(const MapState& state) {
    return static_cast<std::size_t>(std::count_if(state.sites.begin(), state.sites.end(),
                                                  [](const MapSite& s) { return s.decided; }));
}

/// Waits a moment for the runs of other processes; false if stopped.
bool wait_for_others(const std::atomic<bool>* stop) {
    for (int k = 0; k < 10; ++k) {
        if (stop && stop->load()) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return true;
}

}  // namespace

MapState read_map(const fs::path& folder, const SweepPlan& plan) {
    return MapResults(folder, plan).explore();
}

MapOutcome run_map(const fs::path& folder, const SweepPlan& plan, const SweepShare& given,
                   const MapControl& control) {
    MapResults results(folder, plan);
    results.retry_failed_runs();
    MapOutcome outcome;
    std::uint64_t events_before = 0;
    for (;;) {
        outcome.state = results.explore();
        if (outcome.state.missing.empty()) return outcome;
        SweepShare share = given;
        share.rest = true;  // the next step needs all runs of this one
        share.only = outcome.state.missing;
        const std::size_t decided = decided_sites(outcome.state);
        std::uint64_t events = 0;
        SweepControl step;
        step.stop = control.stop;
        step.progress = [&](double done, double runs, std::uint64_t so_far) {
            events = so_far;
            if (control.progress)
                control.progress(decided, outcome.state.sites.size(), done, runs,
                                 events_before + so_far);
        };
        const SweepOutcome made = run_sweep(folder, plan, share, step);
        events_before += events;
        outcome.done += made.done;
        outcome.failed += made.failed;
        const bool idle = made.done == 0 && made.failed == 0;
        if (made.stopped || (idle && !wait_for_others(control.stop))) {
            outcome.stopped = true;
            outcome.state = results.explore();
            return outcome;
        }
    }
}

std::string first_failure(const fs::path& folder, const SweepPlan& plan) {
    const std::vector<bool> failed = numbered_files(folder / "failures", ".txt", plan.points());
    for (std::size_t point = 0; point < failed.size(); ++point) {
        if (!failed[point]) continue;
        std::string text = read_whole_file(failure_file(folder, point));
        while (text.ends_with('\n')) text.pop_back();
        std::vector<std::string> where = varied_options(plan, plan.parameters(point));
        where.push_back(fmt::format("replicate {}", plan.replica(point) + 1));
        return fmt::format("{}: {}", fmt::join(where, ", "), text);
    }
    return "";
}

Table map_table(const SweepPlan& plan, const MapState& state) {
    const MapTarget& target = *plan.map;
    const SweepAxis *const x = plan.axis(target.x), *const y = plan.axis(target.y);
    std::vector<std::string> columns{target.x};
    if (y) columns.push_back(target.y);
    columns.insert(columns.end(), {target.of, target.of + "_error"});
    if (target.is_of_crossing())
        columns.insert(columns.end(), {"N_c_lower", "N_c_upper", "from", "to"});
    columns.insert(columns.end(), {"verdict", "total_periods", "replicates", "failed"});
    Table table(columns);
    const std::vector<std::size_t> x_order = ascending_order(*x),
                                   y_order = y ? ascending_order(*y) : std::vector<std::size_t>();
    for (const MapSite& s : state.sites) {
        if (!s.decided) continue;
        std::vector<Table::Cell> row{cell_of(x->values[x_order[s.x]])};
        if (y) row.push_back(cell_of(y->values[y_order[s.y]]));
        row.insert(row.end(), {s.value.mean, s.value.error});
        if (target.is_of_crossing()) row.insert(row.end(), {s.lower, s.upper, s.from, s.to});
        row.emplace_back(s.verdict);
        row.emplace_back(s.periods);
        row.emplace_back(s.runs);
        row.emplace_back(s.failed);
        table.add(std::move(row));
    }
    return table;
}

std::string map_summary(const SweepPlan& plan, const MapState& state) {
    const SweepAxis *const x = plan.axis(plan.map->x), *const y = plan.axis(plan.map->y);
    std::map<std::string, int> verdicts;
    std::int64_t runs = 0, failed = 0;
    for (const MapSite& s : state.sites) {
        if (s.decided) ++verdicts[s.verdict];
        runs += s.runs;
        failed += s.failed;
    }
    std::vector<std::string> counts;
    for (const auto& [verdict, count] : verdicts)
        counts.push_back(fmt::format("{} {}", count, verdict));
    const std::string level =
        plan.map->is_of_crossing() ? "" : fmt::format("level {}: ", plan.map->level);
    const std::size_t decided = decided_sites(state);
    const bool complete = decided == state.sites.size();
    return fmt::format("{} of {} points needed{}{}; {} runs{}", state.sites.size(),
                       x->values.size() * (y ? y->values.size() : 1),
                       complete ? "" : fmt::format(" so far, {} decided", decided),
                       counts.empty() ? "" : fmt::format(" ({}{})", level, fmt::join(counts, ", ")),
                       runs, failed > 0 ? fmt::format(", {} failed", failed) : "");
}

}  // namespace swirl
