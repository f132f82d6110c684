// The results of runs that differ in their seeds alone, put together into one of the same shape, so
// that a figure reads a point of many runs as it reads one run.
//
// Every average, wherever it stands, becomes the mean over the runs with the error within and
// between them (statistics/replicates.hpp); angles are averaged as directions; counts of visits add
// up; lengths (events, periods) are means of one run. By time, runs count by the swirls they cover
// after their warm-up; by event all the same.
//
// What is not averaged: a run that failed, and one that ended before its warm-up did, or with fewer
// than five swirls after it. Three swirls of a dish without wall friction, say, are off by a tenth
// of Ω, all seeds alike, and by many of the errors that such runs give.
//
// Besides: under "seeds" how many runs there are, how many were averaged, steady, drifting,
// jumping, switching, too short to tell, too short to be averaged, failed; and how ϖ by event
// scatters over the seeds
// ("scatter" in units of the runs' own errors, "disagree").
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <vector>

namespace swirl {

inline constexpr int min_periods_of_an_average = 5;

/// Of one result that is no run, that result.
nlohmann::ordered_json replicates(const std::vector<nlohmann::ordered_json>& results);

}  // namespace swirl
