// Many runs: the product of lists of parameters, with some replicas of each. A sweep is a folder:
//
//     DIR/plan.json            the plan, which may grow
//     DIR/results/000012.json  result of point 12; it exists only when complete (atomic write)
//     DIR/locks                byte 12 is locked by the process that works on point 12
//     DIR/failures/000012.txt  the error message of point 12; the next call tries again
//     DIR/checkpoints/         of points that take longer than a minute
//     DIR/trajectories/000012.h5  recorded frames, if the plan asks for them
//     DIR/series/000012.csv       averages of every period, if the plan asks for them; the result
//                                 has its checksum
//     DIR/states/                 final states of the runs of a chain (sweep_chain.hpp)
//
// Any number of processes, on any machines that share the folder, may work on it, be killed, and
// start again. A point done twice gives the same bytes except for the time it took. A point is done
// if its result, its trajectory and its series are whole. Otherwise its run is repeated.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "swirl/study/sweep_plan.hpp"

namespace swirl {

struct SweepStatus {
    std::size_t points = 0, done = 0, running = 0, failed = 0;
    std::size_t damaged = 0;  // points with a result that are not done
    std::string first_damaged = {};
};
/// Counts what a table needs, the results, or also the recordings that a point needs to be done.
enum class Counted { results, points };
SweepStatus sweep_status(const std::filesystem::path& folder, const SweepPlan& plan,
                         Counted counted = Counted::points);

/// The points that this process works on: those with number ≡ part − 1 modulo parts. With `rest`,
/// it then works on the others that no process has locked.
struct SweepShare {
    std::size_t part = 1, parts = 1;
    bool rest = false;
    unsigned threads = 0;  // 0: one per core
    /// Only these points, in this order; all if there is no list.
    std::optional<std::vector<std::size_t>> only = {};
};

struct SweepOutcome {
    std::size_t done = 0, failed = 0;  // runs of this call
    std::size_t elsewhere = 0;         // points locked by other processes
    bool stopped = false;
    std::string first_failure;
};

struct SweepControl {
    const std::atomic<bool>* stop = nullptr;
    /// Called from any thread with the points of this call that are done (including fractions of
    /// running points, and each weighted with the time that it probably takes), their total, and
    /// the events so far.
    std::function<void(double done, double all, std::uint64_t events)> progress;
};

/// Throws UsageError if the plan does not need all its points, as a map.
void require_sweep(const std::filesystem::path& folder, const SweepPlan& plan);

SweepOutcome run_sweep(const std::filesystem::path& folder, const SweepPlan& plan,
                       const SweepShare& share, const SweepControl& control);

}  // namespace swirl
