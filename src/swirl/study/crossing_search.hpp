// Finding N_c, the number of discs at which rotation turns into counterrotation, with as few events
// as it takes: `swirl crossing`. What N_c is, and its interval: statistics/zero_crossing.hpp.
//
// 1. Coarse look: `seeds` runs, with seeds of their own, at about eight numbers of discs over the
//    range. A run is as long as the events asked for, and covers a hundred periods after its
//    warm-up at least: what a few periods show of a dense container is not its mean.
// 2. Narrowing: runs of the same length at the middle of each bracket, until every number in it has
//    runs. This is done for all four rotation rates.
// 3. Signs: numbers outside every bracket whose sign is undetermined get `seeds` more runs, twice
// as
//    long as the ones before, until the sign is certain, or three times. Those that stay
//    undetermined are reported.
// 4. Tolerance: the numbers in the bracket of N_c get `seeds` more runs, twice as long as the ones
//    before, until the error of N_c is below the tolerance. A number is given more runs at most
//    `rounds` times; then the search stops, and its report says so.
//
// After each step the search narrows again. One rotation rate drives steps 3 and 4; the other three
// are of the same runs. Which runs a number near N_c gets depends on the runs there, not on the
// range. Therefore two ranges find the same N_c, if they contain its bracket with certain signs. If
// the bracket ends with the range, at an undetermined sign, the replicates differ, and N_c agrees
// within its error.
//
// A run that fails (a collapse by friction, docs/physics.md) is left out, counted and reported; a
// number of discs at which every run failed has no point. If it lies in a bracket, N_c is not
// known, and the bracket is reported.
//
// Runs at one number of discs are put together with the periods they cover as weights, their error
// is the one within and between them (statistics/replicates.hpp). Which runs are made depends on
// their results and the seed alone, never on the number of threads.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "swirl/io/table.hpp"
#include "swirl/measure/rotation_crossings.hpp"
#include "swirl/run/run.hpp"

namespace swirl {

/// The events of the first runs where none are given: a run of a search is shorter than one that is
/// made for its own sake.
inline constexpr const char* events_of_a_search = "2e5";

struct CrossingSettings {
    RunConfig
        config;  // its number of discs does not matter; its events are those of the first runs
    std::int64_t from = 5, to = 48;
    double tolerance = 0.3;           // wanted standard error of N_c
    std::size_t rate = default_rate;  // of rotation_rates: what drives steps 3 and 4
    int rounds = 8;                   // of step 4 at one number of discs, at most
    int seeds = 3;                    // runs of one step at one number of discs
    std::int64_t min_periods = 100;   // after the warm-up, of the first runs
    std::int64_t step = 0;  // between the numbers of the coarse look; 0: about eight numbers
};

/// Runs at one number of discs that could not be made.
struct FailedRuns {
    std::int64_t discs, failed, runs;  // failed of so many
};

struct CrossingSearch {
    std::size_t rate = default_rate;      // what drove the search
    Crossings crossings;                  // by each of rotation_rates
    RotationCurves curves;                // the same, in the order of N
    std::vector<std::int64_t> runs_made;  // at each N
    std::uint64_t events = 0, runs = 0;   // of the runs that did not fail
    std::vector<FailedRuns> failures;     // in the order of N
    std::string first_failure;            // why the first of them failed
    /// Of the runs that the crossing rests on (of all, if there is none): how many had not reached
    /// a steady state after their warm-up, and how many were too short to tell.
    std::int64_t not_steady = 0, too_short = 0;
    /// Of the numbers of discs that it rests on: where the seeds scatter more than the errors
    /// within the runs can explain.
    std::int64_t disagreeing = 0;
    bool within_tolerance = false;
    double seconds = 0.0;

    const Crossing& crossing() const { return crossings[rate]; }
    const std::vector<RotationPoint>& points() const { return curves[rate]; }

    /// How many runs failed in all.
    std::int64_t failed() const {
        std::int64_t sum = 0;
        for (const FailedRuns& f : failures) sum += f.failed;
        return sum;
    }
};

struct CrossingControl {
    const std::atomic<bool>* stop = nullptr;
    std::function<void(const std::string& stage, double events_per_second)> progress;
    unsigned threads = 0;  // 0: all cores
    /// How a run is made; a test may put a curve of its own in its place.
    std::function<RunResult(const RunConfig&, const RunControl&)> make_run =
        [](const RunConfig& config, const RunControl& control) { return run(config, control); };
};

/// Throws WrongCall if the range is empty.
void check_range(const CrossingSettings& settings);
/// Throws WrongCall if the range is empty, the discs do not fit, or another setting is wrong.
void check(const CrossingSettings& settings);

/// The same, and throws Interrupted when stopped. There are no points if no run could be made.
CrossingSearch search_crossing(const CrossingSettings& settings,
                               const CrossingControl& control = {});

/// "crosses", "always rotates", "always counterrotates" or "undecided".
const char* verdict_word(Crossing::Verdict verdict);

/// The place of a name in rotation_rates. Throws WrongCall.
std::size_t rate_named(const std::string& name);

/// "38.3 ± 0.1" or "between 36 and 40".
std::string change_words(const SignChange& change);
/// "at N = 38.3 ± 0.1" or "between N = 36 and 40".
std::string change_place(const SignChange& change);
/// "38.3 ± 0.1" or "between 36 and 40", or the verdict if there is no N_c.
std::string crossing_words(const Crossing& crossing);
/// " By the other rates: 36.4 ± 0.3 (mean over the discs, by event), …": every rate that has points
/// but `without`. Nothing if no rate crosses.
std::string other_rates_report(const Crossings& crossings, std::size_t without);
/// "28, 30"; in a cell of a table "28 30".
std::string listed(const std::vector<double>& discs);
std::string spaced(const std::vector<double>& discs);

/// "N_c = 36.4 ± 0.3 (95 %: 35.9 to 37.0) …" or that there is none, with the evidence; N_c of the
/// other rates; and which runs failed.
std::string crossing_report(const CrossingSettings& settings, const CrossingSearch& search);
/// A line for each change of sign of a curve that changes it more than once, and the numbers whose
/// sign is undetermined; else nothing.
std::string other_crossings_report(const CrossingSearch& search);

/// Columns of a table of crossings: verdict, N_c, N_c_error, N_c_lower, N_c_upper (95 %) by the
/// rate in column `rate`; the same numbers by each of rotation_rates; how often the sign changes,
/// and the numbers whose sign is undetermined.
std::vector<std::string> crossing_columns();
void add_crossings(std::vector<Table::Cell>& row, const Crossings& crossings, std::size_t rate);

/// All that was found, and the command that asked for it.
std::string crossing_json(const CrossingSettings& settings, const CrossingSearch& search,
                          const std::string& command);

}  // namespace swirl
