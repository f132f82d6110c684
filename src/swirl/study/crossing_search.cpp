#include "swirl/study/crossing_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <mutex>
#include <optional>
#include <set>

#include "swirl/run/failure.hpp"
#include "swirl/run/json.hpp"
#include "swirl/run/parallel_for.hpp"
#include "swirl/run/path_parameter.hpp"
#include "swirl/statistics/replicates.hpp"

namespace swirl {
namespace {

constexpr int coarse_points = 8;
constexpr int max_sign_rounds = 4;  // step 3: rounds of further runs at one number of discs

using Numbers = std::set<std::int64_t>;  // of discs

/// The runs at one number of discs.
struct RunGroup {
    std::vector<SearchRun> finished;
    std::int64_t failed = 0;
    int rounds = 0;         // of further runs
    int doublings = 0;      // of the length, by these rounds
    bool scatters = false;  // the replicates disagree, so further runs are no longer
    std::int64_t attempted() const { return std::int64_t(finished.size()) + failed; }
};

struct RunTask {
    std::int64_t discs, replica;
    int doublings;
};

struct RunOutcome {
    std::optional<SearchRun> run;
    std::string failure;
};

Ensemble combined(const std::vector<SearchRun>& runs, std::size_t rate) {
    std::vector<Estimate> estimates;
    std::vector<double> periods;
    for (const SearchRun& run : runs) {
        estimates.push_back(run.rotation[rate]);
        periods.push_back(run.periods);
    }
    return ensemble(estimates, periods);
}

class Searcher {
  public:
    Searcher(const CrossingSettings& settings, const CrossingControl& control)
        : settings_(settings), control_(control) {}

    CrossingSearch search() {
        try {
            make_runs(coarse_numbers(), "coarse scan");
            fill_brackets();
            for (Numbers more = numbers_for_more_runs(); !more.empty();
                 more = numbers_for_more_runs()) {
                for (const std::int64_t n : more) begin_round(groups_[n]);
                make_runs(more, "more runs");
                fill_brackets();
            }
        } catch (const Interrupted& stopped) {
            CrossingSearch so_far = result();
            so_far.stopped = true;
            throw StoppedSearch(stopped.what(), std::move(so_far));
        }
        return result();
    }

  private:
    Numbers coarse_numbers() const {
        const std::int64_t from = settings_.from, to = settings_.to;
        Numbers numbers{to};
        if (settings_.step > 0) {
            for (std::int64_t n = from; n < to; n += settings_.step) numbers.insert(n);
            return numbers;
        }
        for (int k = 0; k < coarse_points; ++k)
            numbers.insert(from + (to - from) * k / (coarse_points - 1));
        return numbers;
    }

    /// Makes runs until every number in the bracket of every change of sign has some.
    void fill_brackets() {
        for (;;) {
            Numbers missing;
            for (const Crossing& crossing : find_crossings(curves()))
                for (const SignChange& change : crossing.changes)
                    if (const auto number = next_number_in(change)) missing.insert(*number);
            if (missing.empty()) return;
            make_runs(missing, "narrowing");
        }
    }

    /// The number without runs that is nearest to the middle of a bracket. Numbers at which all
    /// runs failed do not end the search in their bracket.
    std::optional<std::int64_t> next_number_in(const SignChange& change) const {
        return middle_number(std::int64_t(change.before), std::int64_t(change.after),
                             [&](std::int64_t n) { return !groups_.contains(n); });
    }

    /// The numbers that get more runs: undetermined ones outside every bracket, and the bracket of
    /// N_c while its error exceeds the tolerance. All numbers of a bracket get more runs together.
    /// If each got runs until its sign is certain, it would stop where chance moves it away from
    /// zero, and the interval of N_c would be too narrow.
    Numbers numbers_for_more_runs() const {
        const Crossing crossing = find_crossing(curves()[settings_.rate]);
        Numbers numbers = undetermined_numbers(crossing);
        const SignChange* const change = crossing.last();
        if (!change || !change->resolved() || is_within_tolerance(crossing)) return numbers;
        for (const std::int64_t n : decisive_numbers(crossing))
            if (has_rounds_left(n, settings_.rounds)) numbers.insert(n);
        return numbers;
    }

    Numbers undetermined_numbers(const Crossing& crossing) const {
        Numbers numbers;
        for (const double discs : crossing.undetermined) {
            const bool in_bracket = std::any_of(
                crossing.changes.begin(), crossing.changes.end(),
                [&](const SignChange& c) { return c.before < discs && discs < c.after; });
            const auto n = std::int64_t(discs);
            if (!in_bracket && has_rounds_left(n, max_sign_rounds)) numbers.insert(n);
        }
        return numbers;
    }

    bool has_rounds_left(std::int64_t n, int max_rounds) const {
        const RunGroup& group = groups_.at(n);
        return group.rounds < std::min(max_rounds, settings_.rounds) &&
               2 * group.attempted() <= max_search_runs;
    }

    bool is_within_tolerance(const Crossing& crossing) const {
        if (crossing.verdict == Crossing::Verdict::crosses)
            return crossing.error <= settings_.tolerance;
        return crossing.verdict != Crossing::Verdict::undecided;
    }

    /// The numbers in the bracket of N_c; all numbers if there is no bracket.
    Numbers decisive_numbers(const Crossing& crossing) const {
        const SignChange* const change = crossing.last();
        Numbers numbers;
        for (const auto& [n, group] : groups_)
            if (!group.finished.empty() &&
                (!change || (change->before <= double(n) && double(n) <= change->after)))
                numbers.insert(n);
        return numbers;
    }

    RotationCurves curves() const {
        RotationCurves all;
        for (const auto& [n, group] : groups_) {
            if (group.finished.empty()) continue;
            for (std::size_t r = 0; r < all.size(); ++r) {
                const Estimate e = combined(group.finished, r).estimate;
                all[r].push_back({static_cast<double>(n), e.mean, e.error});
            }
        }
        return all;
    }

    void begin_round(RunGroup& group) const {
        ++group.rounds;
        group.scatters = group.scatters || combined(group.finished, settings_.rate).disagree;
        if (!group.scatters) ++group.doublings;
    }

    /// Makes new runs at each of these numbers. If stopped, the finished ones count.
    void make_runs(const Numbers& numbers, const char* stage) {
        const std::vector<RunTask> tasks = tasks_at(numbers);
        std::vector<std::optional<RunOutcome>> outcomes(tasks.size());
        std::exception_ptr stopped;
        try {
            parallel_for(
                tasks.size(), [&](std::size_t k) { outcomes[k] = outcome_of(tasks[k], stage); },
                control_.threads);
        } catch (const Interrupted&) {
            stopped = std::current_exception();
        }
        for (std::size_t k = 0; k < tasks.size(); ++k)
            if (outcomes[k]) record(groups_[tasks[k].discs], *outcomes[k]);
        if (stopped) std::rethrow_exception(stopped);
    }

    std::vector<RunTask> tasks_at(const Numbers& numbers) {
        std::vector<RunTask> tasks;
        for (auto n = numbers.rbegin(); n != numbers.rend(); ++n) {  // long runs first
            const RunGroup& group = groups_[*n];
            const std::int64_t before = group.attempted(),
                               count = group.scatters ? before : settings_.seeds;
            for (std::int64_t k = before; k < before + count; ++k)
                tasks.push_back({*n, k, group.doublings});
        }
        return tasks;
    }

    RunOutcome outcome_of(const RunTask& task, const char* stage) {
        try {
            RunConfig config = with_discs(settings_.config, task.discs);
            config.periods.reset();
            config.events = settings_.config.events << task.doublings;
            config.seed = search_seed(config, task.replica);
            SearchRun run = long_enough_run(config, task);
            for (Estimate& rate : run.rotation) rate.mean *= swirl_sign(config);
            report_progress(stage, run.events);
            return {run, ""};
        } catch (const Failure& failure) {
            return {std::nullopt, failure.what()};
        } catch (const UsageError& error) {  // with this seed, the discs do not fit
            return {std::nullopt, error.what()};
        }
    }

    void record(RunGroup& group, const RunOutcome& outcome) {
        if (outcome.run) {
            group.finished.push_back(*outcome.run);
            ++runs_;
            return;
        }
        ++group.failed;
        if (first_failure_.empty()) first_failure_ = outcome.failure;
    }

    /// A run of at least config.events events and at least as many periods as its round requires.
    SearchRun long_enough_run(const RunConfig& by_events, const RunTask& task) {
        RunConfig by_periods = by_events;
        by_periods.periods =
            by_events.warmup.value_or(default_warmup) + (settings_.min_periods << task.doublings);
        const auto has_enough_events = [&](std::uint64_t events) {
            return events >= static_cast<std::uint64_t>(by_events.events);
        };
        if (control_.stored)
            if (const auto run = control_.stored->find(
                    task.discs, task.replica, {config_text(by_periods), config_text(by_events)});
                run && has_enough_events(run->events))
                return *run;
        RunControl run_control;
        run_control.stop = control_.stop;
        RunResult r = control_.make_run(by_periods, run_control);
        if (r.complete && !has_enough_events(r.events.total()))
            r = control_.make_run(by_events, run_control);
        if (!r.complete) throw Interrupted("stopped before the crossing was found.");
        if (control_.stored) control_.stored->store(task.discs, task.replica, r);
        return {r.rotation.all(), r.periods - static_cast<double>(r.warmup), r.steady_state(),
                r.events.total()};
    }

    double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
    }
    void report_progress(const char* stage, std::uint64_t events) {
        const std::lock_guard lock(mutex_);
        events_ += events;
        if (control_.progress) control_.progress(stage, static_cast<double>(events_) / seconds());
    }

    CrossingSearch result() const {
        CrossingSearch search;
        search.rate = settings_.rate;
        search.curves = curves();
        search.crossings = find_crossings(search.curves);
        for (const auto& [n, group] : groups_) {
            if (!group.finished.empty())
                search.runs_made.push_back(std::int64_t(group.finished.size()));
            if (group.failed > 0) search.failures.push_back({n, group.failed, group.attempted()});
        }
        search.first_failure = first_failure_;
        search.events = events_;
        search.runs = runs_;
        const Numbers decisive = decisive_numbers(search.crossing());
        search.decisive_numbers = std::int64_t(decisive.size());
        for (const std::int64_t n : decisive) count_doubtful(groups_.at(n).finished, search);
        search.within_tolerance = is_within_tolerance(search.crossing());
        search.seconds = seconds();
        return search;
    }

    void count_doubtful(const std::vector<SearchRun>& runs, CrossingSearch& search) const {
        for (const SearchRun& run : runs) {
            const bool too_short = run.verdict == SteadyState::Verdict::too_short;
            search.too_short += too_short ? 1 : 0;
            search.not_steady += !too_short && run.verdict != SteadyState::Verdict::steady ? 1 : 0;
        }
        search.disagreeing += combined(runs, settings_.rate).disagree ? 1 : 0;
    }

    const CrossingSettings& settings_;
    const CrossingControl& control_;
    const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
    std::map<std::int64_t, RunGroup> groups_;  // by number of discs
    std::string first_failure_;
    std::mutex mutex_;
    std::uint64_t events_ = 0, runs_ = 0;
};

}  // namespace

void validate_range(const CrossingSettings& settings) {
    if (!(settings.from >= 2 && settings.to > settings.from))
        throw UsageError(fmt::format(
            "the range is --from {} --to {}, but --from must be 2 or more and --to must be larger.",
            settings.from, settings.to));
    if (static_cast<double>(settings.to) > max_discs)
        throw UsageError(
            fmt::format("--to is {}, but it must be at most {:.0f}.", settings.to, max_discs));
}

void validate(const CrossingSettings& settings) {
    validate_range(settings);
    if (!(settings.rate < rotation_rates.size()))
        throw UsageError("the rotation rate must be one of the four that a run reports.");
    if (settings.step < 0)
        throw UsageError(fmt::format(
            "--step is {}, but it must be 1 or more, or 0 for about {} numbers of discs.",
            settings.step, coarse_points));
    for (std::int64_t n = settings.from; n <= settings.to; ++n) with_discs(settings.config, n);
    if (!(settings.tolerance > 0.0))
        throw UsageError(
            fmt::format("--tolerance, the target standard error of N_c, is {}, but it must be "
                        "above 0.",
                        settings.tolerance));
}

void require_crossing(const RunConfig& config) {
    RunConfig mirrored = config;
    mirrored.clockwise = false;
    if (!has_m_frame(mirrored))
        throw UsageError(
            "on this path there is no swirl with which the discs could rotate or counterrotate, so "
            "there is no N_c.\nhint: use a path that is nearly a circle.");
    if (!config.ramps.empty())
        throw UsageError(
            "ramp is given, but a search for N_c needs a steady state.\nhint: omit it.");
}

void reject_listed_sizes(const ParameterTexts& given) {
    const auto sizes = given.find("sizes");
    if (sizes != given.end() && sizes->second.find("list ") != std::string::npos)
        throw UsageError(
            "--sizes lists every particle, but a search for N_c varies their number.\nhint: give a "
            "distribution, such as --sizes normal:1:0.1.");
}

CrossingSearch search_crossing(const CrossingSettings& settings, const CrossingControl& control) {
    require_crossing(settings.config);
    validate(settings);
    return Searcher(settings, control).search();
}

}  // namespace swirl
