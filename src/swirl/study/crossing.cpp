#include "swirl/study/crossing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <mutex>
#include <optional>

#include "swirl/run/failure.hpp"
#include "swirl/run/json.hpp"
#include "swirl/run/parallel_for.hpp"
#include "swirl/run/particle_sizes.hpp"
#include "swirl/run/path_parameter.hpp"

namespace swirl {
namespace {

struct RunOutcome {
    std::optional<SearchRun> run;
    std::string failure;
};

class Searcher {
  public:
    Searcher(const CrossingSettings& settings, const CrossingControl& control)
        : settings_(settings), control_(control), search_(settings) {}

    CrossingResult search() {
        try {
            for (auto runs = search_.next(); !runs.empty(); runs = search_.next()) make(runs);
        } catch (const Interrupted& stopped) {
            CrossingResult so_far = result();
            so_far.stopped = true;
            throw StoppedSearch(stopped.what(), std::move(so_far));
        }
        return result();
    }

  private:
    /// If stopped, the finished runs count.
    void make(const std::vector<ProposedRun>& runs) {
        std::vector<std::optional<RunOutcome>> outcomes(runs.size());
        std::exception_ptr stopped;
        try {
            parallel_for(
                runs.size(), [&](std::size_t k) { outcomes[k] = outcome_of(runs[k]); },
                control_.threads);
        } catch (const Interrupted&) {
            stopped = std::current_exception();
        }
        for (std::size_t k = 0; k < runs.size(); ++k)
            if (outcomes[k]) record(runs[k], *outcomes[k]);
        if (stopped) std::rethrow_exception(stopped);
    }

    RunOutcome outcome_of(const ProposedRun& task) {
        try {
            RunConfig config = with_discs(settings_.config, task.discs);
            config.periods.reset();
            config.events = settings_.config.events * task.length;
            config.seed = search_seed(config, task.replica);
            SearchRun run = long_enough_run(config, task);
            report_progress(run.events);
            return {run, ""};
        } catch (const Failure& failure) {
            return {std::nullopt, failure.what()};
        } catch (const UsageError& error) {  // the discs do not fit with this seed
            return {std::nullopt, error.what()};
        }
    }

    void record(const ProposedRun& task, const RunOutcome& outcome) {
        if (!outcome.run) {
            search_.take(task, nullptr);
            if (first_failure_.empty()) first_failure_ = outcome.failure;
            return;
        }
        const SearchRun& run = *outcome.run;
        const SearchedRun searched{{run.rotation.begin(), run.rotation.end()}, run.periods};
        search_.take(task, &searched);
        verdicts_[task.discs].push_back(run.verdict);
        ++runs_;
    }

    /// A run of at least config.events events and at least as many periods as its round requires.
    SearchRun long_enough_run(const RunConfig& by_events, const ProposedRun& task) {
        RunConfig by_periods = by_events;
        by_periods.periods =
            by_events.warmup.value_or(default_warmup) + settings_.min_periods * task.length;
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
    void report_progress(std::uint64_t events) {
        const std::lock_guard lock(mutex_);
        events_ += events;
        if (control_.progress)
            control_.progress(search_.stage(), static_cast<double>(events_) / seconds());
    }

    CrossingResult result() const {
        CrossingResult found;
        found.rate = settings_.rate;
        for (std::size_t r = 0; r < found.curves.size(); ++r) found.curves[r] = search_.curve(r);
        found.crossings = find_crossings(found.curves);
        for (const auto& [n, group] : search_.groups()) {
            if (!group.finished.empty())
                found.runs_made.push_back(std::int64_t(group.finished.size()));
            if (group.failed > 0) found.failures.push_back({n, group.failed, group.attempted()});
        }
        found.first_failure = first_failure_;
        found.events = events_;
        found.runs = runs_;
        const auto decisive = search_.decisive_numbers(found.crossing());
        found.decisive_numbers = std::int64_t(decisive.size());
        for (const std::int64_t n : decisive) count_doubtful(n, found);
        found.within_tolerance = search_.is_within_tolerance();
        found.seconds = seconds();
        return found;
    }

    void count_doubtful(std::int64_t number, CrossingResult& found) const {
        for (const SteadyState::Verdict verdict : verdicts_.at(number)) {
            const bool too_short = verdict == SteadyState::Verdict::too_short;
            found.too_short += too_short ? 1 : 0;
            found.not_steady += !too_short && verdict != SteadyState::Verdict::steady ? 1 : 0;
        }
        const Ensemble all = search_.combined(search_.groups().at(number), settings_.rate);
        found.disagreeing += all.disagree ? 1 : 0;
    }

    const CrossingSettings& settings_;
    const CrossingControl& control_;
    const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
    CrossingSearch search_;
    std::map<std::int64_t, std::vector<SteadyState::Verdict>> verdicts_;  // key: number of discs
    std::string first_failure_;
    std::mutex mutex_;
    std::uint64_t events_ = 0, runs_ = 0;
};

}  // namespace

void validate_range(std::int64_t from, std::int64_t to) {
    if (!(from >= 2 && to > from))
        throw UsageError(fmt::format(
            "the range is --from {} --to {}, but --from must be 2 or more and --to must be larger.",
            from, to));
    if (static_cast<double>(to) > max_discs)
        throw UsageError(fmt::format("--to is {}, but it must be at most {:.0f}.", to, max_discs));
}

namespace {

/// Denser particles are placed for seconds, and may find no place.
constexpr double max_easy_packing = 0.75;

bool is_dense(const RunConfig& config) {
    double area = 0.0;
    for (const ParticleProperties& particle : particles_of(config))
        area += particle.radius * particle.radius;
    return area > max_easy_packing * config.container_radius * config.container_radius;
}

/// Nothing if so many particles cannot be run.
std::optional<RunConfig> config_with(const RunConfig& config, std::int64_t discs) {
    try {
        return with_discs(config, discs);
    } catch (const UsageError&) {
        return {};
    }
}

std::int64_t most_easily_placed(const RunConfig& config, std::int64_t from, std::int64_t to) {
    for (std::int64_t n = to; n > from; --n)
        if (const auto made = config_with(config, n); made && !is_dense(*made)) return n;
    return from;
}

}  // namespace

std::int64_t most_that_fit(const RunConfig& config, std::int64_t from, std::int64_t to) {
    return config_with(config, to) ? to : most_easily_placed(config, from, to);
}

void fit_range(CrossingSettings& settings) {
    settings.asked_to = settings.to;
    const std::int64_t from = settings.from, to = settings.to;
    const std::int64_t most = settings.to_is_default ? most_easily_placed(settings.config, from, to)
                                                     : most_that_fit(settings.config, from, to);
    if (most > from) settings.to = most;  // otherwise validate() reports the problem
}

std::string range_words(const CrossingSettings& settings) {
    if (settings.to >= settings.asked_to) return {};
    return fmt::format("N = {} to {}; {} {}s do not fit, or only closely packed", settings.from,
                       settings.to, settings.asked_to, body_word(settings.config));
}

void validate(const CrossingSettings& settings) {
    validate_range(settings.from, settings.to);
    if (!(settings.rate < rotation_rates.size()))
        throw UsageError("the rotation rate must be one of the four that a run reports.");
    if (settings.step < 0)
        throw UsageError(fmt::format(
            "--step is {}, but it must be 1 or more, or 0 for about {} numbers of discs.",
            settings.step, settings.coarse_numbers));
    for (std::int64_t n = settings.from; n <= settings.to; ++n) with_discs(settings.config, n);
    if (!(settings.tolerance > 0.0))
        throw UsageError(
            fmt::format("--tolerance, the target standard error of N_c, is {}, but it must be "
                        "above 0.",
                        settings.tolerance));
}

void require_crossing(const RunConfig& config) {
    if (!has_m_frame(config))
        throw UsageError(
            "on this path there is no swirl with which the discs could rotate or counterrotate, so "
            "there is no N_c.\nhint: use a path that is nearly a circle.");
    if (!config.ramps.empty())
        throw UsageError(
            "ramp is given, but a search for N_c needs a steady state.\nhint: omit it.");
}

void reject_listed_particles(const ParameterTexts& given) {
    const auto sizes = given.find("sizes");
    if (sizes != given.end() && sizes->second.find("list ") != std::string::npos)
        throw UsageError(
            "--sizes lists every particle, but a search for N_c varies their number.\nhint: give a "
            "distribution, such as --sizes normal:1:0.1.");
    if (given.contains("initial"))
        throw UsageError(
            "--initial gives every disc, but a search for N_c varies their number.\nhint: omit "
            "it.");
}

CrossingResult search_crossing(const CrossingSettings& settings, const CrossingControl& control) {
    require_crossing(settings.config);
    validate(settings);
    return Searcher(settings, control).search();
}

}  // namespace swirl
