#include "swirl/study/crossing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "swirl/measure/several_runs.hpp"
#include "swirl/run/all_cores.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/json.hpp"
#include "swirl/run/report.hpp"
#include "swirl/run/version.hpp"

namespace swirl {
namespace {

constexpr int coarse_points = 8;
constexpr std::int64_t beside = 3;  // numbers on either side of the change of sign

class Search {
  public:
    Search(const CrossingSettings& settings, const CrossingControl& control)
        : settings_(settings), control_(control) {}

    CrossingSearch operator()() {
        look_at(coarse_numbers(), settings_.config.events, settings_.seeds, "coarse look");
        narrow();
        for (int round = 0; round < settings_.rounds && !good_enough(); ++round) {
            look_at(window(), settings_.config.events << round, 1, "more events");
            narrow();  // the crossing may turn out to lie elsewhere
        }
        narrow_all();
        CrossingSearch search;
        search.points = points();
        for (const auto& [n, runs] : runs_at_) {
            if (!runs.made.empty()) search.runs_made.push_back(std::int64_t(runs.made.size()));
            if (runs.failed > 0) search.failures.push_back({n, runs.failed, runs.tried()});
        }
        search.first_failure = first_failure_;
        search.crossing = find_crossing(search.points);
        search.changes = find_sign_changes(search.points);
        search.events = events_;
        search.runs = runs_;
        for (const std::int64_t n : changes_sign() ? window() : all_numbers()) count(n, search);
        search.within_tolerance = good_enough();
        search.seconds = seconds();
        return search;
    }

  private:
    /// What is kept of a run.
    struct Made {
        Estimate rotation;
        double swirls;  // after the warm-up
        SteadyState::Verdict verdict;
    };
    struct Runs {
        std::vector<Made> made;
        std::int64_t failed = 0;
        std::int64_t tried() const { return std::int64_t(made.size()) + failed; }
    };

    std::set<std::int64_t> coarse_numbers() const {
        std::set<std::int64_t> numbers;
        if (settings_.step > 0) {
            for (std::int64_t n = settings_.from; n < settings_.to; n += settings_.step)
                numbers.insert(n);
            numbers.insert(settings_.to);
            return numbers;
        }
        for (int k = 0; k < coarse_points; ++k)
            numbers.insert(settings_.from +
                           (settings_.to - settings_.from) * k / (coarse_points - 1));
        return numbers;
    }

    std::set<std::int64_t> all_numbers() const {
        std::set<std::int64_t> numbers;
        for (const auto& [n, runs] : runs_at_)
            if (!runs.made.empty()) numbers.insert(n);
        return numbers;
    }

    std::vector<RotationPoint> points() const {
        std::vector<RotationPoint> all;
        for (const auto& [n, runs] : runs_at_) {
            if (runs.made.empty()) continue;
            const Estimate e = together(runs.made).estimate;
            all.push_back({static_cast<double>(n), e.mean, e.error});
        }
        return all;
    }

    static SeveralRuns together(const std::vector<Made>& runs) {
        std::vector<Estimate> estimates;
        std::vector<double> swirls;
        for (const Made& run : runs) {
            estimates.push_back(run.rotation);
            swirls.push_back(run.swirls);
        }
        return several_runs(estimates, swirls);
    }

    void count(std::int64_t n, CrossingSearch& search) const {
        const std::vector<Made>& runs = runs_at_.at(n).made;
        if (runs.empty()) return;
        for (const Made& run : runs) {
            const bool too_short = run.verdict == SteadyState::Verdict::too_short;
            search.too_short += too_short ? 1 : 0;
            search.not_steady += !too_short && run.verdict != SteadyState::Verdict::steady ? 1 : 0;
        }
        search.disagreeing += together(runs).disagree ? 1 : 0;
    }

    /// The neighbours between which the sign changes, as well as one can tell: the last of the cut
    /// that leaves most rotation on its left and most counterrotation on its right.
    std::pair<std::int64_t, std::int64_t> bracket() const {
        const auto all = points();
        std::pair<std::int64_t, std::int64_t> best{0, 0};
        double most = 0.0;
        for (std::size_t cut = 1; cut < all.size(); ++cut) {
            double score = 0.0;
            for (std::size_t k = 0; k < all.size(); ++k) {
                // More than certain does not count more.
                const double sign =
                    std::clamp(all[k].mean / (certain_sign * all[k].error), -1.0, 1.0);
                score += k < cut ? sign : -sign;
            }
            if (cut > 1 && score <= most) continue;
            most = score;
            best = {std::int64_t(all[cut - 1].discs), std::int64_t(all[cut].discs)};
        }
        return best;
    }

    bool changes_sign() const {
        bool positive = false, negative = false;
        for (const RotationPoint& p : points()) {
            positive = positive || p.mean > certain_sign * p.error;
            negative = negative || p.mean < -certain_sign * p.error;
        }
        return positive && negative;
    }

    /// Nearest to the middle of these two, a number that has not been looked at: where all runs
    /// failed, one beside it says as much.
    std::optional<std::int64_t> unseen_between(std::int64_t left, std::int64_t right) const {
        std::optional<std::int64_t> nearest;
        const auto off = [&](std::int64_t n) { return std::abs(2 * n - left - right); };
        for (std::int64_t n = left + 1; n < right; ++n)
            if (!runs_at_.contains(n) && (!nearest || off(n) < off(*nearest))) nearest = n;
        return nearest;
    }

    /// Until the neighbours of the crossing, and all of its window, have been looked at. What is
    /// found on the way may move it.
    void narrow() {
        while (changes_sign()) {
            const auto [left, right] = bracket();
            std::set<std::int64_t> missing;
            if (const auto middle = unseen_between(left, right)) {
                missing.insert(*middle);
            } else {
                for (const std::int64_t n : window())
                    if (!runs_at_.contains(n)) missing.insert(n);
            }
            if (missing.empty()) return;
            look_at(missing, settings_.config.events, settings_.seeds, "narrowing");
        }
    }

    /// Each change of sign that is certain: until it lies between neighbours, or the sign of those
    /// between is not certain.
    void narrow_all() {
        for (;;) {
            std::set<std::int64_t> missing;
            for (const SignChange& change : find_sign_changes(points())) {
                const auto middle = std::int64_t(change.before + change.after) / 2;
                const auto seen = runs_at_.find(middle);
                if (seen != runs_at_.end() && !seen->second.made.empty()) continue;
                if (const auto unseen =
                        unseen_between(std::int64_t(change.before), std::int64_t(change.after)))
                    missing.insert(*unseen);
            }
            if (missing.empty()) return;
            look_at(missing, settings_.config.events, settings_.seeds, "other crossings");
        }
    }

    /// Where more events help: about the crossing; without one, where the sign is least certain.
    std::set<std::int64_t> window() const {
        std::set<std::int64_t> numbers;
        if (changes_sign()) {
            const auto [left, right] = bracket();
            for (std::int64_t k = 0; k < beside; ++k) {
                numbers.insert(std::max(left - k, settings_.from));
                numbers.insert(std::min(right + k, settings_.to));
            }
            return numbers;
        }
        auto all = points();
        std::sort(all.begin(), all.end(), [](const RotationPoint& a, const RotationPoint& b) {
            return std::fabs(a.mean / a.error) < std::fabs(b.mean / b.error);
        });
        for (std::size_t k = 0; k < std::min<std::size_t>(3, all.size()); ++k)
            numbers.insert(std::int64_t(all[k].discs));
        return numbers;
    }

    bool good_enough() const {
        const Crossing crossing = find_crossing(points());
        if (crossing.verdict == Crossing::Verdict::crosses)
            return crossing.error <= settings_.tolerance;
        return crossing.verdict != Crossing::Verdict::undecided;
    }

    /// `seeds` new runs at each of these numbers.
    void look_at(const std::set<std::int64_t>& numbers, std::int64_t events, int seeds,
                 const char* stage) {
        struct Place {
            std::int64_t discs;
            std::uint64_t seed;
        };
        std::vector<Place> places;
        for (auto n = numbers.rbegin(); n != numbers.rend(); ++n)  // long ones first
            for (int s = 0; s < seeds; ++s)
                places.push_back({*n, settings_.config.seed +
                                          static_cast<std::uint64_t>(runs_at_[*n].tried() + s)});
        std::vector<RunResult> results(places.size());
        std::vector<std::string> failures(places.size());
        on_all_cores(
            places.size(),
            [&](std::size_t k) {
                RunConfig config = settings_.config;
                config.discs = places[k].discs;
                config.events = events;
                config.seed = places[k].seed;
                try {
                    results[k] = long_enough(config, stage);
                } catch (const Failure& failure) {
                    failures[k] = failure.what();
                }
            },
            control_.threads);
        for (std::size_t k = 0; k < places.size(); ++k) {
            const RunResult& r = results[k];
            Runs& runs = runs_at_[places[k].discs];
            if (!failures[k].empty()) {
                ++runs.failed;
                if (first_failure_.empty()) first_failure_ = failures[k];
                continue;
            }
            runs.made.push_back(
                {r.rotation.by_time, r.periods - static_cast<double>(r.warmup), r.steady_state()});
            ++runs_;
        }
    }

    /// A run of so many events, and as many swirls as it takes at least.
    RunResult long_enough(RunConfig config, const char* stage) {
        RunControl inner;
        inner.stop = control_.stop;
        config.periods = config.warmup.value_or(default_warmup) + settings_.least_swirls;
        RunResult result = run(config, inner);
        const bool short_of_events =
            result.events.total() < static_cast<std::uint64_t>(config.events);
        if (result.complete && short_of_events) {
            config.periods.reset();
            result = run(config, inner);
        }
        if (!result.complete) throw Interrupted("Stopped before the crossing was found.");
        report(stage, result.events.total());
        return result;
    }

    double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
    }
    void report(const char* stage, std::uint64_t events) {
        const std::lock_guard lock(mutex_);
        events_ += events;
        if (control_.progress) control_.progress(stage, static_cast<double>(events_) / seconds());
    }

    const CrossingSettings& settings_;
    const CrossingControl& control_;
    const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
    std::map<std::int64_t, Runs> runs_at_;  // of every number that was looked at
    std::string first_failure_;
    std::mutex mutex_;
    std::uint64_t events_ = 0, runs_ = 0;
};

/// "2 runs failed and are left out: 1 of 3 at N = 47, 1 of 3 at N = 48. Why: …", or nothing.
std::string failures_report(const CrossingSearch& search) {
    if (search.failures.empty()) return {};
    const std::int64_t failed = search.failed();
    std::string where;
    for (const FailedRuns& f : search.failures)
        where += fmt::format("{}{} of {} at N = {}", where.empty() ? "" : ", ", f.failed, f.runs,
                             f.discs);
    return fmt::format(" {} run{} failed and {} left out: {}. Why{}: {}", failed,
                       failed == 1 ? "" : "s", failed == 1 ? "is" : "are", where,
                       failed == 1 ? "" : ", of the first", search.first_failure);
}

/// How many discs it is at is N_c: "discs" would be a number of a run's discs.
nlohmann::ordered_json search_json(const CrossingSettings& settings, const CrossingSearch& s,
                                   const std::string& command) {
    nlohmann::ordered_json points = nlohmann::ordered_json::array();
    for (std::size_t k = 0; k < s.points.size(); ++k)
        points.push_back({{"discs", s.points[k].discs},
                          {"mean", s.points[k].mean},
                          {"error", s.points[k].error},
                          {"runs", s.runs_made[k]}});
    nlohmann::ordered_json changes = nlohmann::ordered_json::array();
    for (const SignChange& change : s.changes)
        changes.push_back(
            {{"N", change.discs},
             {"N_error", change.error},
             {"from", change.before},
             {"to", change.after},
             {"sense", change.to_counterrotation ? "to counterrotation" : "to rotation"}});
    nlohmann::ordered_json failures = nlohmann::ordered_json::array();
    for (const FailedRuns& f : s.failures)
        failures.push_back({{"discs", f.discs}, {"failed", f.failed}, {"runs", f.runs}});
    return {{"verdict", verdict_word(s.crossing.verdict)},
            {"N_c", s.crossing.discs},
            {"N_c_error", s.crossing.error},
            {"N_c_lower", s.crossing.lower},
            {"N_c_upper", s.crossing.upper},
            {"sign_changes", changes},
            {"within_tolerance", s.within_tolerance},
            {"tolerance", settings.tolerance},
            {"points", points},
            {"runs", s.runs},
            {"runs_not_steady", s.not_steady},
            {"runs_too_short_to_tell", s.too_short},
            {"numbers_whose_seeds_disagree", s.disagreeing},
            {"runs_failed", failures},
            {"first_failure", s.first_failure.empty() ? nlohmann::ordered_json()
                                                      : nlohmann::ordered_json(s.first_failure)},
            {"events", s.events},
            {"seconds", s.seconds},
            {"config", config_json(settings.config)},
            {"command", command},
            {"version", version()}};
}

std::string verdict_report(const CrossingSettings& settings, const CrossingSearch& search) {
    if (search.points.empty())
        return fmt::format("Undecided: no run between N = {} and {} could be made.", settings.from,
                           settings.to);
    const Crossing& c = search.crossing;
    const auto lowest = std::min_element(
        search.points.begin(), search.points.end(),
        [](const RotationPoint& a, const RotationPoint& b) { return a.mean < b.mean; });
    const std::string evidence =
        fmt::format("between N = {:.0f} and {:.0f} the lowest is ϖ/Ω = {} at N = {:.0f}",
                    search.points.front().discs, search.points.back().discs,
                    with_error(lowest->mean, lowest->error), lowest->discs);
    switch (c.verdict) {
        case Crossing::Verdict::crosses:
            return fmt::format("N_c = {} (95 %: {:.1f} to {:.1f}){}", with_error(c.discs, c.error),
                               c.lower, c.upper,
                               search.within_tolerance
                                   ? "."
                                   : fmt::format("; the error is still above the {} that was asked "
                                                 "for, so more --events would be right.",
                                                 settings.tolerance));
        case Crossing::Verdict::always_rotates:
            return fmt::format("No crossing: the {}s always rotate; {}, {:.0f} errors above zero.",
                               body_word(settings.config), evidence, lowest->mean / lowest->error);
        case Crossing::Verdict::always_counterrotates:
            return fmt::format("No crossing: the {}s always counterrotate; {}.",
                               body_word(settings.config), evidence);
        case Crossing::Verdict::undecided:
            break;
    }
    return fmt::format(
        "Undecided: {}; the errors are too large to tell, and more --events would be "
        "right.",
        evidence);
}

}  // namespace

void check(const CrossingSettings& settings) {
    if (!(settings.from >= 2 && settings.to > settings.from))
        throw WrongCall(fmt::format(
            "The search goes from --from {} to --to {}, but it must begin at 2 or more and "
            "end above its beginning.",
            settings.from, settings.to));
    if (settings.step < 0)
        throw WrongCall(
            fmt::format("--step is {}, but it must be 1 or more, or 0 for about eight numbers.",
                        settings.step));
    RunConfig largest = settings.config;
    largest.discs = settings.to;
    if (const auto wrong = problem(largest)) throw WrongCall(*wrong);
    if (!(settings.tolerance > 0.0))
        throw WrongCall(
            fmt::format("--tolerance is {}, but it must be above 0: the standard error "
                        "of N_c that is wanted.",
                        settings.tolerance));
}

CrossingSearch search_crossing(const CrossingSettings& settings, const CrossingControl& control) {
    check(settings);
    return Search(settings, control)();
}

const char* verdict_word(Crossing::Verdict verdict) {
    switch (verdict) {
        case Crossing::Verdict::crosses:
            return "crosses";
        case Crossing::Verdict::always_rotates:
            return "always rotates";
        case Crossing::Verdict::always_counterrotates:
            return "always counterrotates";
        case Crossing::Verdict::undecided:
            break;
    }
    return "undecided";
}

std::vector<std::string> crossing_columns() {
    return {"verdict", "N_c", "N_c_error", "N_c_lower", "N_c_upper"};
}

void add_crossing(std::vector<Table::Cell>& row, const Crossing& c) {
    row.emplace_back(std::string(verdict_word(c.verdict)));
    for (const double value : {c.discs, c.error, c.lower, c.upper}) row.emplace_back(value);
}

std::string crossing_json(const CrossingSettings& settings, const CrossingSearch& search,
                          const std::string& command) {
    return search_json(settings, search, command).dump(2) + "\n";
}

std::string other_crossings_report(const CrossingSearch& search) {
    if (search.changes.size() < 2) return {};
    std::string text = fmt::format(
        "ϖ(N) is not monotonic: its sign changes {} times between the numbers that were looked at "
        "(by more than three errors on either side):\n",
        search.changes.size());
    for (const SignChange& change : search.changes)
        text += fmt::format("  N = {:<14} to {}, between {:.0f} and {:.0f}\n",
                            with_error(change.discs, change.error),
                            change.to_counterrotation ? "counterrotation" : "rotation",
                            change.before, change.after);
    return text;
}

std::string crossing_report(const CrossingSettings& settings, const CrossingSearch& search) {
    return verdict_report(settings, search) + failures_report(search);
}

}  // namespace swirl
