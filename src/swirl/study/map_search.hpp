// Finds the runs that an adaptive map needs. A map is a sweep (sweep.hpp) of which only some points
// are run. The answer depends on the results alone, so any number of processes may work on one map,
// in any order.
//
// Sites. The values of the axes x and y span a grid of sites. First, sites about five steps apart
// in each direction are computed. They divide the grid into cells. A cell is halved in both
// directions if the sites in it and on its border differ: the quantity is above the level at one
// and below it at another, or undetermined, or all runs of one failed, or (`change`) two values are
// farther apart. So the map is fine at its zero line and coarse elsewhere.
//
// Budget of a site. It begins with two runs (different seeds). While the quantity is within three
// errors (certain_sign) of the level, the number of runs doubles, up to the plan's `replicas`. If
// it is still within three errors then, it is undetermined.
//
// N_c. At each site the number of discs is a further axis, and N_c is searched as by `swirl
// crossing` (statistics/crossing_search.hpp), but with runs of equal length: the coarse scan has
// five numbers of discs, and more runs double their number. A site between others begins next to
// the N_c of these instead. Its range ends at the largest number that fits there. A cell is halved
// if the verdicts differ, one is undecided, or N_c differs by more than `change`.
//
// Growth. A plan may get further values of its axes, more replicas (sweep_plan.hpp) and, for N_c,
// further numbers of discs. The search then repeats that of the smaller plan, and continues with
// the larger one: cells beyond the old range are added, sites that were undetermined get more runs,
// and a cell is halved at a value of the old plan where one lies between. A site without N_c is
// searched in the added numbers, too; one with an N_c keeps it. So every run of the smaller map is
// used.
//
// Failed runs count as done and are excluded. A site whose runs all failed has no value.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "swirl/statistics/block_average.hpp"
#include "swirl/study/sweep_plan.hpp"

namespace swirl {

/// The part of a run's result that a map uses.
struct MapRun {
    Estimate value = {};
    double periods = 0.0;
    bool failed = false, direction = false;  // direction: an angle in degrees
};

struct MapSite {
    std::size_t x = 0, y = 0;  // ranks of the values of the axes, ascending_order()
    bool decided = false;      // needs no further run
    /// "above", "below", "undetermined" or "failed"; for N_c "crosses", "always rotates", "always
    /// counterrotates", "undecided" or "failed".
    std::string verdict = {};
    Estimate value = {};
    double lower = not_available, upper = not_available;  // 95 % of N_c
    std::int64_t from = 0, to = 0;                        // numbers of discs of the search
    double periods = 0.0;                                 // sum over all runs
    std::int64_t runs = 0, failed = 0;                    // finished and failed ones
};

struct MapState {
    std::vector<MapSite> sites = {};        // known so far, by y and x
    std::vector<std::size_t> missing = {};  // points of the plan to run next, in ascending order
};

/// The site's runs so far, and which runs come next. `find_run` returns null for a point that has
/// no result yet. The plan must be one of make_map_plan() (map_plan.hpp).
MapState explore_map(const SweepPlan& plan,
                     const std::function<const MapRun*(std::size_t point)>& find_run);

}  // namespace swirl
