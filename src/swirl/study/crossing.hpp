// `swirl crossing`: finds N_c, the number of discs at which rotation changes into counterrotation,
// with few events. Which runs the search needs: statistics/crossing_search.hpp. Here they are made:
// a run has at least the given number of events and fifty periods after the warm-up, because a
// few periods of a dense container do not show its mean. Failed runs (a collapse by friction,
// docs/explanation/physics.md) are reported. The runs made depend on their results and the seed,
// never on the number of threads.
//
// Rates count in the direction of the swirl, so a clockwise path has the N_c of its mirror image.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "swirl/io/table.hpp"
#include "swirl/measure/rotation_crossings.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/run.hpp"
#include "swirl/statistics/crossing_search.hpp"

namespace swirl {

/// Default number of events of the first runs: fewer than for a single run.
inline constexpr const char* default_search_events = "2e4";
/// Default target of the standard error of N_c: 95 of 100 searches are within 0.15 of the true
/// value at μ = 1.
inline constexpr double default_search_tolerance = 0.1;

struct CrossingSettings : CrossingRules {
    CrossingSettings() {
        curves = rotation_rates.size();
        rate = default_rate;  // index in rotation_rates
    }
    RunConfig config = {};          // events: those of the first runs; discs is ignored
    std::int64_t min_periods = 50;  // length of the first runs after the warm-up
    bool to_is_default = false;     // nobody asked for `to`
    std::int64_t asked_to = 0;      // the end of the range before fit_range()
};

/// Failed runs at one number of discs.
struct FailedRuns {
    std::int64_t discs, failed, runs;  // `failed` of `runs`
};

struct CrossingResult {
    std::size_t rate = default_rate;      // that controlled the search
    Crossings crossings;                  // one for each of rotation_rates
    RotationCurves curves;                // one for each of rotation_rates, sorted by N
    std::vector<std::int64_t> runs_made;  // runs at each N
    std::uint64_t events = 0, runs = 0;   // failed runs do not count
    std::vector<FailedRuns> failures;     // sorted by N
    std::string first_failure;            // its error message
    /// Numbers of discs in the bracket of N_c (all, if there is none), and at how many of them the
    /// replicates scatter more than the errors within the runs explain.
    std::int64_t decisive_numbers = 0, disagreeing = 0;
    /// Runs at these numbers that are not steady after their warm-up, or too short to test.
    std::int64_t not_steady = 0, too_short = 0;
    bool within_tolerance = false;
    bool stopped = false;  // ended early by CrossingControl::stop
    double seconds = 0.0;

    const Crossing& crossing() const { return crossings[rate]; }
    const std::vector<RotationPoint>& points() const { return curves[rate]; }

    /// The total number of failed runs.
    std::int64_t failed() const {
        std::int64_t sum = 0;
        for (const FailedRuns& f : failures) sum += f.failed;
        return sum;
    }
};

/// Replicas have consecutive seeds. Random sizes follow from the seed, so each number of discs then
/// has its own seeds: otherwise neighbours would deviate together, and N_c by more than its error.
inline std::uint64_t search_seed(const RunConfig& config, std::int64_t replica) {
    const std::int64_t first = config.sizes ? config.discs * max_search_runs : 0;
    return config.seed + static_cast<std::uint64_t>(first + replica);
}

/// What a search uses of a run.
struct SearchRun {
    std::array<Estimate, rotation_rates.size()> rotation;
    double periods;  // length after the warm-up
    SteadyState::Verdict verdict;
    std::uint64_t events;
};

/// The runs of earlier calls.
class StoredRuns {
  public:
    virtual ~StoredRuns() = default;
    /// The stored run, if its configuration has one of these texts.
    virtual std::optional<SearchRun> find(std::int64_t discs, std::int64_t replica,
                                          const std::vector<std::string>& config_texts) = 0;
    virtual void store(std::int64_t discs, std::int64_t replica, const RunResult& result) = 0;
};

/// The search was stopped. Holds what it has found so far.
class StoppedSearch : public Interrupted {
  public:
    StoppedSearch(const std::string& message, CrossingResult so_far)
        : Interrupted(message), search(std::move(so_far)) {}
    CrossingResult search;
};

struct CrossingControl {
    const std::atomic<bool>* stop = nullptr;
    std::function<void(const std::string& stage, double events_per_second)> progress;
    unsigned threads = 0;  // 0: all cores
    StoredRuns* stored = nullptr;
    /// Makes a run; tests replace it by a known curve.
    std::function<RunResult(const RunConfig&, const RunControl&)> make_run =
        [](const RunConfig& config, const RunControl& control) { return run(config, control); };
};

/// Throws UsageError if the range is empty.
void validate_range(std::int64_t from, std::int64_t to);
/// `to`, if so many particles fit; otherwise the number with a packing fraction of 0.75, since a
/// denser placement takes seconds or fails. At least `from`, which may not fit either.
std::int64_t most_that_fit(const RunConfig& config, std::int64_t from, std::int64_t to);
/// Reduces the end of the range to most_that_fit(), and a default end to a packing fraction of
/// 0.75.
void fit_range(CrossingSettings& settings);
/// "up to N = 42; more spheres …"; empty if the range is the one asked for.
std::string range_words(const CrossingSettings& settings);
/// Throws UsageError if the range is empty, a number of discs in it cannot be run, or another
/// setting is invalid.
void validate(const CrossingSettings& settings);

/// Throws UsageError if runs of this configuration have no N_c: on a path that is not nearly a
/// circle there is no swirl to rotate with, and in a ramp there is no steady state.
void require_crossing(const RunConfig& config);

/// Throws UsageError if the parameters list the sizes of all particles: a search varies their
/// number.
void reject_listed_particles(const ParameterTexts& given);

/// Validates the settings and searches. Throws StoppedSearch when stopped. The result has no points
/// if every run failed.
CrossingResult search_crossing(const CrossingSettings& settings,
                               const CrossingControl& control = {});

/// "crosses", "always rotates", "always counterrotates" or "undecided".
const char* verdict_word(Crossing::Verdict verdict);

/// The index of a name in rotation_rates. Throws UsageError.
std::size_t rate_named(const std::string& name);
/// The names of rotation_rates.
std::vector<std::string> rate_names();

/// "38.3 ± 0.1" or "between 36 and 40".
std::string change_words(const SignChange& change);
/// "at N = 38.3 ± 0.1" or "between N = 36 and 40".
std::string change_location(const SignChange& change);
/// "38.3 ± 0.1" or "between 36 and 40", or the verdict if there is no N_c.
std::string crossing_words(const Crossing& crossing);
/// " By the other rates: 36.4 ± 0.3 (mean over the discs, by event), …": every rate with points
/// except `excluded`. Empty if no rate crosses.
std::string other_rates_report(const Crossings& crossings, std::size_t excluded);
/// "28, 30"; in a cell of a table "28 30".
std::string listed(const std::vector<double>& discs);
std::string spaced(const std::vector<double>& discs);

/// "N_c = 36.4 ± 0.3: …" or that there is none, with the evidence; and the failed runs.
std::string crossing_report(const CrossingSettings& settings, const CrossingResult& search);
/// "N_c = 35.1 ± 0.1, …": that of the rigid body, if it differs by more than three errors.
std::string rigid_body_crossing(const CrossingResult& search);
/// "ϖ/Ω = 0.0012 ± 0.0004 at N = 38, −0.0021 ± 0.0004 at N = 39"; empty without N_c.
std::string nearest_points(const CrossingResult& search);
/// A line for each change of sign if there are several, and the numbers with an undetermined sign.
std::string other_crossings_report(const CrossingResult& search);
/// Reasons to distrust N_c: runs that are not steady or too short, disagreeing replicates.
std::vector<std::string> warnings(const CrossingResult& search);

/// Columns of a table of crossings: verdict, N_c, N_c_error, N_c_lower, N_c_upper (95 %) for the
/// rate in column `rate`; the same numbers for each of rotation_rates; the number of sign changes,
/// and the numbers with an undetermined sign.
std::vector<std::string> crossing_columns();
void add_crossings(std::vector<Table::Cell>& row, const Crossings& crossings, std::size_t rate);

/// All results, and the command that made them.
std::string crossing_json(const CrossingSettings& settings, const CrossingResult& search,
                          const std::string& command);

}  // namespace swirl
