// `swirl map`: a quantity as a function of one or two parameters, with runs where they are needed
// (map_search.hpp). The folder is that of a sweep: the same plan, locks, results and failures
// (sweep.hpp). So any number of processes may work on a map, be killed and start again, and `swirl
// collect` makes a table of its runs. A process repeats two steps until no run is missing: find the
// missing runs from the results so far, and make those that no other process works on.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "swirl/io/table.hpp"
#include "swirl/study/map_search.hpp"
#include "swirl/study/sweep.hpp"

namespace swirl {

struct MapControl {
    const std::atomic<bool>* stop = nullptr;
    /// Called from any thread with the decided and the known sites, the runs of the present step
    /// that are done and their number, and the events so far.
    std::function<void(std::size_t decided, std::size_t sites, double done, double runs,
                       std::uint64_t events)>
        progress;
};

struct MapOutcome {
    MapState state;
    std::size_t done = 0, failed = 0;  // runs made by this call
    bool stopped = false;
};

/// Reads the results and finds the missing runs. Throws FileError for a damaged result, Failure if
/// the folder does not hold a map.
MapState read_map(const std::filesystem::path& folder, const SweepPlan& plan);

/// Makes runs until the map is complete. Runs that failed before are tried again. Waits for
/// runs that other processes work on.
MapOutcome run_map(const std::filesystem::path& folder, const SweepPlan& plan,
                   const SweepShare& share, const MapControl& control);

/// The parameters and the error message of the first failed run; "" if no run failed.
std::string first_failure(const std::filesystem::path& folder, const SweepPlan& plan);

/// A row for each decided site: the values of the axes, the quantity and its error (for N_c its
/// interval), the verdict, the periods of all runs, and their number.
Table map_table(const SweepPlan& plan, const MapState& state);

/// "87 of 256 points needed (level 0: 43 above, 39 below, 5 undetermined); 332 runs"
std::string map_summary(const SweepPlan& plan, const MapState& state);

}  // namespace swirl
