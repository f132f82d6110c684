// Combines the results of runs that differ only in their seeds into one result of the same form, so
// that a figure reads a point of many runs like one run.
//
// Every average becomes the mean over the runs, with the error within and between them
// (statistics/replicates.hpp). Angles are averaged as directions. Counts of visits add up. Lengths
// (events, periods) become means. Averages over time are weighted by the periods after the warm-up;
// averages over events are not weighted.
//
// Failed runs are not averaged, nor are runs that ended before their warm-up or within five periods
// after it. Averages over three periods without wall friction, for example, deviate by a tenth of
// Ω, in the same direction for all seeds, and by many of their own errors.
//
// "seeds" has the number of runs, and how many of them were averaged, steady, drifting, jumping,
// switching, too short for the test, too short to average, and failed. It also has the scatter of ϖ
// by event over the seeds, in units of the runs' own errors ("scatter", "disagree").
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <vector>

namespace swirl {

inline constexpr int min_periods_of_an_average = 5;

/// A single result that is not a run is returned as it is.
nlohmann::ordered_json seed_ensemble(const std::vector<nlohmann::ordered_json>& results);

}  // namespace swirl
