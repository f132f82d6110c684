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
#include "swirl/run/parallel_for.hpp"
#include "swirl/statistics/replicates.hpp"

namespace swirl {
namespace {

constexpr int coarse_points = 8;
constexpr int rounds_of_a_sign = 3;  // more runs at a number of discs to make its sign certain

class Search {
  public:
    Search(const CrossingSettings& settings, const CrossingControl& control)
        : settings_(settings), control_(control) {}

    CrossingSearch operator()() {
        make_runs(coarse_numbers(), "coarse look");
        narrow();
        for (auto more = worth_more(); !more.empty(); more = worth_more()) {
            for (const std::int64_t n : more) ++runs_at_[n].rounds;
            make_runs(more, "more events");
            narrow();
        }
        CrossingSearch search;
        search.rate = settings_.rate;
        search.curves = curves();
        search.crossings = find_crossings(search.curves);
        for (const auto& [n, runs] : runs_at_) {
            if (!runs.made.empty()) search.runs_made.push_back(std::int64_t(runs.made.size()));
            if (runs.failed > 0) search.failures.push_back({n, runs.failed, runs.tried()});
        }
        search.first_failure = first_failure_;
        search.events = events_;
        search.runs = runs_;
        for (const std::int64_t n : decisive_numbers(search.crossing())) count(n, search);
        search.within_tolerance = is_good_enough(search.crossing());
        search.seconds = seconds();
        return search;
    }

  private:
    /// What is kept of a run.
    struct Made {
        std::array<Estimate, rotation_rates.size()> rotation;
        double periods;  // after the warm-up
        SteadyState::Verdict verdict;
    };
    struct Runs {
        std::vector<Made> made;
        std::int64_t failed = 0;
        int rounds = 0;  // how often it was given more runs, each twice as long as the ones before
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

    RotationCurves curves() const {
        RotationCurves all;
        for (const auto& [n, runs] : runs_at_) {
            if (runs.made.empty()) continue;
            for (std::size_t r = 0; r < all.size(); ++r) {
                const Estimate e = together(runs.made, r).estimate;
                all[r].push_back({static_cast<double>(n), e.mean, e.error});
            }
        }
        return all;
    }

    static Ensemble together(const std::vector<Made>& runs, std::size_t rate) {
        std::vector<Estimate> estimates;
        std::vector<double> periods;
        for (const Made& run : runs) {
            estimates.push_back(run.rotation[rate]);
            periods.push_back(run.periods);
        }
        return ensemble(estimates, periods);
    }

    void count(std::int64_t n, CrossingSearch& search) const {
        const std::vector<Made>& runs = runs_at_.at(n).made;
        if (runs.empty()) return;
        for (const Made& run : runs) {
            const bool too_short = run.verdict == SteadyState::Verdict::too_short;
            search.too_short += too_short ? 1 : 0;
            search.not_steady += !too_short && run.verdict != SteadyState::Verdict::steady ? 1 : 0;
        }
        search.disagreeing += together(runs, settings_.rate).disagree ? 1 : 0;
    }

    /// The numbers in the bracket of N_c; all of them, if there is none.
    std::set<std::int64_t> decisive_numbers(const Crossing& crossing) const {
        const SignChange* const change = crossing.last();
        std::set<std::int64_t> numbers;
        for (const auto& [n, runs] : runs_at_)
            if (!runs.made.empty() &&
                (!change || (change->before <= double(n) && double(n) <= change->after)))
                numbers.insert(n);
        return numbers;
    }

    /// Nearest to the middle of a bracket, a number without runs. Where all runs failed, the
    /// numbers next to it still count.
    std::optional<std::int64_t> unseen_in(const SignChange& change) const {
        const auto left = std::int64_t(change.before), right = std::int64_t(change.after);
        std::optional<std::int64_t> nearest;
        const auto off = [&](std::int64_t n) { return std::abs(2 * n - left - right); };
        for (std::int64_t n = left + 1; n < right; ++n)
            if (!runs_at_.contains(n) && (!nearest || off(n) < off(*nearest))) nearest = n;
        return nearest;
    }

    /// Until there are runs at every number in the bracket of every change of sign.
    void narrow() {
        for (;;) {
            std::set<std::int64_t> missing;
            for (const Crossing& crossing : find_crossings(curves()))
                for (const SignChange& change : crossing.changes)
                    if (const auto unseen = unseen_in(change)) missing.insert(*unseen);
            if (missing.empty()) return;
            make_runs(missing, "narrowing");
        }
    }

    /// Numbers that more runs are worth while at: undetermined ones outside every bracket, and the
    /// bracket of N_c, as long as its error is above the tolerance. The numbers of a bracket get
    /// more runs together: if one of them got runs until its sign is certain, it would stop where
    /// chance takes it away from zero, and the interval of N_c would be too narrow.
    std::set<std::int64_t> worth_more() const {
        const Crossing crossing = find_crossing(curves()[settings_.rate]);
        const auto under = [&](std::int64_t n, int maximum) {
            return runs_at_.at(n).rounds < std::min(maximum, settings_.rounds);
        };
        std::set<std::int64_t> numbers;
        for (const double discs : crossing.undetermined) {
            const auto n = std::int64_t(discs);
            const bool in_bracket = std::any_of(
                crossing.changes.begin(), crossing.changes.end(),
                [&](const SignChange& c) { return c.before < discs && discs < c.after; });
            if (!in_bracket && under(n, rounds_of_a_sign)) numbers.insert(n);
        }
        const SignChange* const change = crossing.last();
        if (!change || !change->resolved() || is_good_enough(crossing)) return numbers;
        for (const std::int64_t n : decisive_numbers(crossing))
            if (under(n, settings_.rounds)) numbers.insert(n);
        return numbers;
    }

    bool is_good_enough(const Crossing& crossing) const {
        if (crossing.verdict == Crossing::Verdict::crosses)
            return crossing.error <= settings_.tolerance;
        return crossing.verdict != Crossing::Verdict::undecided;
    }

    /// `seeds` new runs at each of these numbers, as long as its rounds make them.
    void make_runs(const std::set<std::int64_t>& numbers, const char* stage) {
        struct Place {
            std::int64_t discs;
            std::uint64_t seed;
            int rounds;
        };
        std::vector<Place> places;
        for (auto n = numbers.rbegin(); n != numbers.rend(); ++n)  // long ones first
            for (int s = 0; s < settings_.seeds; ++s)
                places.push_back(
                    {*n,
                     settings_.config.seed + static_cast<std::uint64_t>(runs_at_[*n].tried() + s),
                     runs_at_[*n].rounds});
        std::vector<RunResult> results(places.size());
        std::vector<std::string> failures(places.size());
        parallel_for(
            places.size(),
            [&](std::size_t k) {
                RunConfig config = settings_.config;
                config.discs = places[k].discs;
                config.events = settings_.config.events << places[k].rounds;
                config.seed = places[k].seed;
                const std::int64_t periods = settings_.min_periods << places[k].rounds;
                try {
                    results[k] = long_enough(config, periods, stage);
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
                {r.rotation.all(), r.periods - static_cast<double>(r.warmup), r.steady_state()});
            ++runs_;
        }
    }

    /// A run of so many events, and as many swirls as it takes at least.
    RunResult long_enough(RunConfig config, std::int64_t periods, const char* stage) {
        RunControl inner;
        inner.stop = control_.stop;
        config.periods = config.warmup.value_or(default_warmup) + periods;
        RunResult result = control_.make_run(config, inner);
        const bool short_of_events =
            result.events.total() < static_cast<std::uint64_t>(config.events);
        if (result.complete && short_of_events) {
            config.periods.reset();
            result = control_.make_run(config, inner);
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

}  // namespace

void check_range(const CrossingSettings& settings) {
    if (!(settings.from >= 2 && settings.to > settings.from))
        throw UsageError(fmt::format(
            "The search goes from --from {} to --to {}, but it must begin at 2 or more and "
            "end above its beginning.",
            settings.from, settings.to));
    if (static_cast<double>(settings.to) > max_discs)
        throw UsageError(
            fmt::format("--to is {}, but it must be at most {:.0f}.", settings.to, max_discs));
}

void check(const CrossingSettings& settings) {
    check_range(settings);
    if (!(settings.rate < rotation_rates.size()))
        throw UsageError(
            "The rotation rate of a search must be one of the four that a run reports.");
    if (settings.step < 0)
        throw UsageError(
            fmt::format("--step is {}, but it must be 1 or more, or 0 for about eight numbers.",
                        settings.step));
    RunConfig largest = settings.config;
    largest.discs = settings.to;
    if (const auto wrong = problem(largest)) throw UsageError(*wrong);
    if (!(settings.tolerance > 0.0))
        throw UsageError(
            fmt::format("--tolerance is {}, but it must be above 0: the standard error "
                        "of N_c that is wanted.",
                        settings.tolerance));
}

CrossingSearch search_crossing(const CrossingSettings& settings, const CrossingControl& control) {
    check(settings);
    return Search(settings, control)();
}

}  // namespace swirl
