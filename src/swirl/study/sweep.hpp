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
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "swirl/study/sweep_plan.hpp"

namespace swirl {

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

}  // namespace swirl
