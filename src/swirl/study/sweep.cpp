#include "swirl/study/sweep.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>

#include "swirl/io/atomic_file.hpp"
#include "swirl/io/checksum.hpp"
#include "swirl/io/file_error.hpp"
#include "swirl/io/optional_file.hpp"
#include "swirl/io/result_writer.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/json.hpp"
#include "swirl/run/measurements.hpp"
#include "swirl/run/parallel_for.hpp"
#include "swirl/run/period_series.hpp"
#include "swirl/run/recorded_run.hpp"
#include "swirl/run/shell_word.hpp"
#include "swirl/study/point_result.hpp"
#include "swirl/study/sweep_chain.hpp"
#include "swirl/study/sweep_folder.hpp"
#include "swirl/study/sweep_locks.hpp"

namespace swirl {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// The command that runs one point on its own; for a chain, the sweep, of which no point runs
/// alone.
std::string command_of(const SweepPlan& plan, std::size_t point, std::uint64_t seed) {
    const std::string measure =
        plan.measure.empty() ? "" : fmt::format(" --measure {}", fmt::join(plan.measure, ","));
    if (plan.chain.empty()) return command_of_run(plan.parameters(point), measure, seed);
    std::string sweep = "swirl sweep";
    for (const SweepAxis& axis : plan.axes)
        sweep += fmt::format(" {} {}", option_name(axis.name),
                             shell_word(fmt::format("{}", fmt::join(axis.values, ","))));
    return sweep + fmt::format("{} --replicates {} --chain {} --out DIR", measure, plan.replicas,
                               plan.chain);
}

/// The relative time that a point takes. A run of N discs in the paper's container has about N^2.5
/// events per period for N from 20 to 50.
double cost_of(const SweepPlan& plan, std::size_t point) {
    const ParameterTexts texts = plan.parameters(point);
    const auto value = [&](const char* name, double default_value) {
        const auto found = texts.find(name);
        if (found == texts.end()) return default_value;
        return read_number(found->second).value_or(default_value);
    };
    if (!texts.contains("periods")) return value("events", double(RunConfig{}.events));
    return value("periods", 1.0) * std::pow(value("discs", double(RunConfig{}.discs)), 2.5);
}

RunFiles files_of_point(const fs::path& folder, const SweepPlan& plan, std::size_t point) {
    const std::string number = number_of_point(point);
    RunFiles files;
    files.checkpoint = part_of_sweep(folder, "checkpoints", plan) / (number + ".checkpoint");
    files.resume = true;
    files.overwrite = true;  // existing files of this number belong to this point
    files.in_folder_of_runs = true;
    if (plan.frames > 0) files.trajectory = folder / "trajectories" / (number + ".h5");
    if (plan.series) files.series = part_of_sweep(folder, "series", plan) / (number + ".csv");
    files.frames.per_period = std::max(plan.frames, 1);
    return files;
}

std::string checksum_of_series(const std::string& series) {
    return fmt::format("{:016x}", checksum(series));
}

/// The first of the other files of a point with a result that is missing or not whole: its final
/// state in a chain, its trajectory, its series. "" if all are whole.
std::string damaged_part(const fs::path& folder, const SweepPlan& plan, std::size_t point) {
    const RunFiles files = files_of_point(folder, plan, point);
    if (!plan.chain.empty() && !find_final_state(folder, plan, point))
        return state_file(folder, plan, point).string();
    if (!files.trajectory.empty() && !has_whole_trajectory(plan.config(point), files))
        return files.trajectory.string();
    if (files.series.empty()) return "";
    const std::optional<std::string> series = read_optional_file(files.series);
    const std::string expected = series_checksum(folder, plan, point);
    const bool is_whole = series && (expected.empty() || expected == checksum_of_series(*series));
    return is_whole ? "" : files.series.string();
}

class SweepWorker {
  public:
    SweepWorker(const fs::path& folder, const SweepPlan& plan, const SweepShare& share,
                const SweepControl& control)
        : folder_(folder),
          plan_(plan),
          share_(share),
          control_(control),
          locks_(std::make_shared<SweepLocks>(folder)),
          writer_(part_of_sweep(folder, "results", plan)) {}

    SweepOutcome run() {
        remove_checkpoints_of_done_points();
        std::vector<std::vector<std::size_t>> own, others;
        // Without chains, each point is one.
        const auto add = [&](std::vector<std::size_t> chain, std::size_t k) {
            const auto to_do = std::count_if(chain.begin(), chain.end(), [&](std::size_t point) {
                return !done_before_[point];
            });
            if (to_do == 0) return;
            const bool is_own = k % share_.parts == share_.part - 1;
            if (is_own || share_.rest) {
                total_ += double(to_do);
                for (const std::size_t point : chain)
                    if (!done_before_[point]) total_cost_ += cost_of(plan_, point);
            }
            (is_own ? own : others).push_back(std::move(chain));
        };
        if (!plan_.chain.empty()) {
            std::vector<std::vector<std::size_t>> chains = chains_of(plan_);
            for (std::size_t k = 0; k < chains.size(); ++k) add(std::move(chains[k]), k);
        } else if (share_.only) {
            for (const std::size_t point : *share_.only) add({point}, point);
        } else {
            for (std::size_t point = 0; point < plan_.points(); ++point) add({point}, point);
        }
        work_on(own);
        if (share_.rest) work_on(others);
        writer_.finish();
        outcome_.stopped = control_.stop && control_.stop->load();
        return outcome_;
    }

  private:
    /// A call that ended between the result of a point and its checkpoint leaves the latter.
    void remove_checkpoints_of_done_points() const {
        const std::vector<bool> left = numbered_files(part_of_sweep(folder_, "checkpoints", plan_),
                                                      ".checkpoint", plan_.points());
        for (std::size_t point = 0; point < left.size(); ++point) {
            if (!left[point]) continue;
            const std::shared_ptr<SweepLock> lock = SweepLock::try_lock(locks_, point);
            if (lock && is_done(point)) remove_checkpoint(files_of_point(folder_, plan_, point));
        }
    }

    /// The points with a whole result. Those that this call surely does not run are not checked.
    std::vector<bool> results_before() const {
        std::vector<bool> listed(share_.only ? plan_.points() : 0);
        if (share_.only)
            for (const std::size_t point : *share_.only) listed[point] = true;
        std::vector<bool> done = whole_results(folder_, plan_, [&](std::size_t point) {
            if (share_.only) return bool(listed[point]);
            return share_.rest || !plan_.chain.empty() || point % share_.parts == share_.part - 1;
        });
        for (std::size_t point = 0; point < done.size(); ++point)
            done[point] = done[point] && damaged_part(folder_, plan_, point).empty();
        return done;
    }

    bool is_done(std::size_t point) const {
        return has_whole_result(folder_, plan_, point) &&
               damaged_part(folder_, plan_, point).empty();
    }

    void work_on(const std::vector<std::vector<std::size_t>>& chains) {
        parallel_for(
            chains.size(), [&](std::size_t k) { run_chain(chains[k]); }, share_.threads);
    }

    /// Ends at the first point that this call cannot finish: the next one starts from its end.
    void run_chain(const std::vector<std::size_t>& chain) {
        for (std::size_t k = 0; k < chain.size(); ++k) {
            if (done_before_[chain[k]]) continue;
            if (control_.stop && control_.stop->load(std::memory_order_relaxed)) return;
            ChainLink link;
            if (k > 0) {
                link.from = chain[k - 1];
                link.begin = find_final_state(folder_, plan_, chain[k - 1]);
                if (!link.begin)
                    throw FileError(fmt::format(
                        "the final state of point {} was removed from '{}' during this "
                        "call.\nhint: "
                        "run `swirl sweep --out {}` again, which repeats the run of this point.",
                        chain[k - 1], folder_.string(), shell_word(folder_.string())));
            }
            if (!try_point(chain[k], link)) return;
        }
    }

    /// Start and end of a run of a chain.
    struct ChainLink {
        std::optional<std::size_t> from;  // the point before
        std::optional<FinalState> begin;
        FinalState end;
    };

    /// True if the point is done.
    bool try_point(std::size_t point, ChainLink& link) {
        const std::shared_ptr<SweepLock> point_lock = SweepLock::try_lock(locks_, point);
        if (!point_lock) {
            const std::lock_guard lock(mutex_);
            ++outcome_.elsewhere;
            return false;
        }
        // Another process may have finished it in the meantime.
        if (is_done(point)) {
            count(point, 1.0, 0);
            return true;
        }
        std::string failure;
        try {
            if (!do_point(point, point_lock, link)) return false;
        } catch (const FileError& error) {
            throw;  // concerns the whole folder, not this point
        } catch (const Interrupted&) {
            return false;
        } catch (const std::exception& error) {
            failure = error.what();
        }
        const fs::path file = failure_file(folder_, point);
        if (failure.empty()) {
            if (failed_before_[point]) ::unlink(file.c_str());
            return true;
        }
        write_file_atomically(file, failure + "\n");
        const std::lock_guard lock(mutex_);
        if (outcome_.failed++ == 0)
            outcome_.first_failure = fmt::format("point {}: {}", point, failure);
        return false;
    }

    /// False if the run was stopped early.
    bool do_point(std::size_t point, const std::shared_ptr<SweepLock>& point_lock,
                  ChainLink& link) {
        const RunConfig config = plan_.config(point);
        const RunFiles files = files_of_point(folder_, plan_, point);
        const std::string command = command_of(plan_, point, config.seed);
        Observation observation = observation_of(config, plan_.measure);
        const RunResult result = run_point(point, config, files, command, observation, link);
        if (!result.complete) return false;
        if (!plan_.chain.empty()) write_final_state(folder_, plan_, point, link.end);
        Json json = point_json(plan_, point, result, command);
        if (!plan_.chain.empty()) json["started_from"] = link.from ? Json(*link.from) : Json();
        if (plan_.series)
            json["series_checksum"] = checksum_of_series(read_regular_file(files.series));
        if (!plan_.measure.empty()) json["measured"] = measured_json(observation.report());
        writer_.write(number_of_point(point) + ".json", json.dump() + "\n",
                      [files, point_lock] { remove_checkpoint(files); });
        const std::lock_guard lock(mutex_);
        ++outcome_.done;
        return true;
    }

    RunResult run_point(std::size_t point, const RunConfig& config, const RunFiles& files,
                        const std::string& command, Observation& observation, ChainLink& link) {
        RunControl control;
        control.begin_from = std::move(link.begin);
        if (!plan_.chain.empty()) control.final_state = &link.end;
        std::optional<PeriodSeries> series;
        if (plan_.series) control.series = &series.emplace(config, plan_.measure);
        control.stop = control_.stop;
        double counted = 0.0;
        std::uint64_t counted_events = 0;
        control.progress = [&](const RunProgress& p) {
            count(point, p.fraction - counted, p.events - counted_events);
            counted = p.fraction;
            counted_events = p.events;
        };
        if (!observation.empty()) control.observation = &observation;
        Provenance provenance;  // only recordings need it
        if (plan_.frames > 0) provenance = provenance_of(config, command, plan_text_);
        const RunResult result = run_recorded(config, files, control, provenance);
        if (result.complete) count(point, 1.0 - counted, result.events.total() - counted_events);
        return result;
    }

    /// Adds a fraction of a point to the progress, weighted with its cost.
    void count(std::size_t point, double fraction, std::uint64_t events) {
        const double share = total_cost_ > 0.0 ? cost_of(plan_, point) * total_ / total_cost_ : 1.0;
        const std::lock_guard lock(mutex_);
        done_ += fraction * share;
        events_ += events;
        if (control_.progress) control_.progress(done_, total_, events_);
    }

    const fs::path folder_;
    const SweepPlan& plan_;
    const std::string plan_text_ = plan_.text();
    const SweepShare share_;
    const SweepControl& control_;
    const std::shared_ptr<SweepLocks> locks_;
    const std::vector<bool> failed_before_ =
        numbered_files(folder_ / "failures", ".txt", plan_.points());
    const std::vector<bool> done_before_ = results_before();
    ResultWriter writer_;
    std::mutex mutex_;
    SweepOutcome outcome_;
    double done_ = 0.0, total_ = 0.0, total_cost_ = 0.0;
    std::uint64_t events_ = 0;
};

}  // namespace

SweepStatus sweep_status(const fs::path& folder, const SweepPlan& plan, Counted counted) {
    SweepStatus status;
    status.points = plan.points();
    const std::vector<bool> exists = numbered_files(part_of_sweep(folder, "results", plan), ".json",
                                                    status.points),
                            whole = whole_results(folder, plan, [](std::size_t) { return true; });
    const std::vector<bool> failed = numbered_files(folder / "failures", ".txt", status.points);
    const std::vector<bool> locked = SweepLocks::locked(folder, status.points);
    for (std::size_t point = 0; point < status.points; ++point) {
        std::string damaged;
        if (exists[point] && !whole[point]) damaged = result_file(folder, plan, point).string();
        if (whole[point] && counted == Counted::points) damaged = damaged_part(folder, plan, point);
        if (!damaged.empty() && status.damaged++ == 0) status.first_damaged = damaged;
        if (whole[point] && damaged.empty())
            ++status.done;
        else if (locked[point])
            ++status.running;
        else if (failed[point])
            ++status.failed;
    }
    return status;
}

void require_sweep(const fs::path& folder, const SweepPlan& plan) {
    if (!plan.needs_all_points())
        throw UsageError(
            fmt::format("'{}' holds a {}, which does not need all points.\nhint: run `swirl {} "
                        "--out {}`{}.",
                        folder.string(), plan.kind(), plan.command(), shell_word(folder.string()),
                        plan.search ? " with the options of the search" : ""));
}

SweepOutcome run_sweep(const fs::path& folder, const SweepPlan& plan, const SweepShare& share,
                       const SweepControl& control) {
    if (!share.only) require_sweep(folder, plan);
    return SweepWorker(folder, plan, share, control).run();
}

}  // namespace swirl
