// Many runs: the product of lists of parameters, some replicas of each. A sweep is a folder:
//
//     DIR/plan.json            what is to be done; it may grow
//     DIR/results/000012.json  point 12 is done: complete when it is there (written aside, renamed)
//     DIR/claims               byte 12 is locked by who works on point 12, as long as he lives
//     DIR/failures/000012.txt  why it could not be done; tried again by the next call
//     DIR/checkpoints/         of points that take longer than a minute
//     DIR/trajectories/000012.h5  frames, if the plan asks for them
//
// So any number of processes, on any number of machines that share the folder, may work on it, be
// killed, and start again. A point done twice gives the same bytes but for the time it took.
//
// Growing. A plan takes further values of its parameters, further replicas and further
// measurements. Points keep their numbers, and with them what is done: those that are new are
// counted on from the last. What a run measures must be looked at while it goes on, so with a
// further measurement all are done again, with the same seeds and bits, in DIR/results-2, -3, …;
// what was found before stays.
//
// Order. Points are numbered with the parameters in the order of `swirl run --help`, the last one
// and then the replica running fastest. The seed of a point comes from what the point is (its
// resolved parameters, the replica, and the seed of the plan), so it does not depend on the number,
// on threads or machines, or on what else is in the sweep.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "swirl/files/table.hpp"
#include "swirl/measure/statistics.hpp"
#include "swirl/run/parameters.hpp"

namespace swirl {

struct SweepAxis {
    std::string name;
    std::vector<std::string> values;
    bool operator==(const SweepAxis&) const = default;
};

/// How large a plan was before it grew: so many values of each axis, so many replicas.
struct SweepStage {
    std::vector<std::size_t> values;
    std::int64_t replicas = 1;
    bool operator==(const SweepStage&) const = default;
};

struct SweepPlan {
    std::vector<SweepAxis> axes;  // every parameter that was given, in order
    std::int64_t replicas = 1;
    std::vector<std::string> measure;  // measurements of every run (measurements.hpp)
    int frames = 0;                    // per swirl, of the trajectory of every run; 0: none
    int generation = 1;                // one more whenever further measurements were added
    std::vector<SweepStage> before = {};
    /// The place of every point in the product of the axes, the replica running fastest; empty: the
    /// number is the place. Follows from the rest.
    std::vector<std::size_t> places = {};

    std::size_t points() const;
    std::size_t place(std::size_t point) const { return places.empty() ? point : places[point]; }
    /// The parameters of a point, without its seed.
    ParameterTexts parameters(std::size_t point) const;
    std::int64_t replica(std::size_t point) const;
    /// With its seed. Throws WrongCall.
    RunConfig config(std::size_t point) const;
    bool operator==(const SweepPlan&) const = default;
};

/// "5:48", "0:0.25:1" (from : step : to), "0.1,0.5,1", or one value. Throws WrongCall.
std::vector<std::string> list_of_values(std::string_view name, std::string_view text);

/// Texts may be lists. Throws WrongCall, also for a point that cannot be run, and for two values
/// that are the same run.
SweepPlan make_plan(const ParameterTexts& given, std::int64_t replicas);

/// What a plan becomes when further values, replicas and measurements are added to it; 0 replicas
/// and no measurements are what it has. Throws WrongCall for parameters it does not have.
SweepPlan grown(const SweepPlan& plan, const ParameterTexts& more, std::int64_t replicas,
                const std::vector<std::string>& measure);

/// The plan of a folder; throws FileError if there is none.
SweepPlan read_plan(const std::filesystem::path& folder);
/// Makes the folder and writes the plan; throws Failure if it holds another one, unless it grows.
void write_plan(const std::filesystem::path& folder, const SweepPlan& plan, bool grows = false);

struct SweepStatus {
    std::size_t points = 0, done = 0, running = 0, failed = 0;
};
SweepStatus sweep_status(const std::filesystem::path& folder, const SweepPlan& plan);

/// Which points this process works on: those with number ≡ part − 1 modulo parts; with `rest`,
/// afterwards the others that nobody works on.
struct SweepShare {
    std::size_t part = 1, parts = 1;
    bool rest = false;
    unsigned threads = 0;  // 0: one for each core
};

struct SweepOutcome {
    std::size_t done = 0, failed = 0, elsewhere = 0;  // by this call; left to other processes
    bool stopped = false;
    std::string first_failure;
};

struct SweepControl {
    const std::atomic<bool>* stop = nullptr;
    /// Points of this call that are done (the share of those under way included), and all of them;
    /// events so far. From any thread.
    std::function<void(double done, double all, std::uint64_t events)> progress;
};

SweepOutcome run_sweep(const std::filesystem::path& folder, const SweepPlan& plan,
                       const SweepShare& share, const SweepControl& control);

struct CollectedRow {
    ParameterTexts parameters;
    Estimate by_time;  // of the rotation, over the replicas
};

struct CollectedSweep {
    Table table;
    std::vector<CollectedRow> rows = {};
    std::size_t disagreeing = 0;  // whose replicas scatter more than their own errors can explain
    std::size_t not_steady = 0;   // with a replica that drifts or is too short to tell
    /// Runs without a whole swirl after the warm-up: there is nothing to average of them.
    std::size_t without_swirl = 0;
    std::set<std::string> versions = {};  // of the programs that made the runs
};

/// One row for each combination of parameters: mean over the replicas that are done, and its
/// standard error within and between them (measure/several_runs.hpp), of the rotation and of every
/// number that was measured; whether all are steady; and the scatter of the replicas' rotation by
/// time in units of their own errors. The same bytes whoever did the work. Throws FileError for a
/// result that is damaged or of another version.
CollectedSweep collect_sweep(const std::filesystem::path& folder, const SweepPlan& plan);

/// Where the rotation of a collected sweep changes its sign: a row for each combination of the
/// parameters but the number of discs. Throws WrongCall if that is none of them.
Table crossings_in(const SweepPlan& plan, const CollectedSweep& collected);

}  // namespace swirl
