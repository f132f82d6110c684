// Finding N_c, the number of discs at which rotation turns into counterrotation, with as few events
// as it takes: `swirl crossing`.
//
// 1. A coarse look: a few runs, with seeds of their own, at about eight numbers of discs over the
//    range. A run is as long as the events asked for, and covers a hundred swirls after its warm-up
//    at least: what a few swirls say of a dense dish is not its mean.
// 2. Between the neighbours where the sign changes, runs in the middle, until they are next to each
//    other; then the three numbers on either side, which is what the line of measure/crossing.hpp
//    is drawn through.
// 3. As long as N_c is less certain than asked for, one more run at each of those numbers, with a
//    new seed and twice as many events as the last one.
//
// A curve may change its sign several times (spheres on a floor do). N_c is then the one that the
// method of measure/crossing.hpp takes; the others that the points show with certainty are
// narrowed down to neighbours as well, each is told, and how closely the range was looked at.
//
// A run that fails (a collapse by friction, docs/physics.md) is left out, counted and told; a
// number of discs at which every run failed has no point, and the search goes on with those beside
// it.
//
// Runs at one number of discs are put together with the periods they cover as weights, their error
// is the one within and between them (measure/several_runs.hpp). Which runs
// are made depends on their results and the seed alone, never on how many cores there are.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "swirl/files/table.hpp"
#include "swirl/measure/crossing.hpp"
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
    int rounds = 6;                   // of step 3, at most
    int seeds = 3;                    // of a first look at a number of discs
    std::int64_t least_swirls = 100;  // after the warm-up, of every run
    std::int64_t step = 0;  // between the numbers of the coarse look; 0: about eight numbers
};

/// Runs at one number of discs that could not be made.
struct FailedRuns {
    std::int64_t discs, failed, runs;  // failed of so many
};

struct CrossingSearch {
    Crossing crossing;
    std::vector<SignChange> changes;      // all that are certain, in the order of N
    std::vector<RotationPoint> points;    // by time, in the order of N
    std::vector<std::int64_t> runs_made;  // at each of them
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
};

/// Throws WrongCall if the range is empty or the discs do not fit.
void check(const CrossingSettings& settings);

/// The same, and throws Interrupted when stopped. There are no points if no run could be made.
CrossingSearch search_crossing(const CrossingSettings& settings,
                               const CrossingControl& control = {});

/// "crosses", "always rotates", "always counterrotates" or "undecided".
const char* verdict_word(Crossing::Verdict verdict);

/// "N_c = 36.4 ± 0.3 (95 %: 35.9 to 37.0)." or that there is none, with the evidence;
/// and which runs failed.
std::string crossing_report(const CrossingSettings& settings, const CrossingSearch& search);
/// Of a curve that changes its sign more than once, a sentence for each change; else nothing.
std::string other_crossings_report(const CrossingSearch& search);
/// Of a table of crossings: verdict, N_c, N_c_error, N_c_lower, N_c_upper (95 %).
std::vector<std::string> crossing_columns();
void add_crossing(std::vector<Table::Cell>& row, const Crossing& crossing);

/// All that was found, and the command that asked for it.
std::string crossing_json(const CrossingSettings& settings, const CrossingSearch& search,
                          const std::string& command);

}  // namespace swirl
