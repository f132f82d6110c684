// A run's result as text for the terminal.
#pragma once

#include <string>
#include <vector>

#include "swirl/run/period_series.hpp"
#include "swirl/run/result.hpp"

namespace swirl {

/// "−0.037 ± 0.001": as many digits as the error supports; three without an error; "n/a" for NaN.
std::string with_error(double mean, double error);

/// "1,000,000"
std::string with_commas(std::uint64_t number);

/// The averages of a series and their correlations, one line each.
std::string series_text(const PeriodSeries& series);

/// "rotate", "counterrotate", or "stall" if the mean is within two standard errors of zero.
std::string rotation_verb(const Estimate& rotation);
/// "rotate counter-clockwise", "rotate clockwise" or "stall": for paths without an M-frame, where
/// there is no swirl with which the cluster could rotate.
std::string direction_verb(const Estimate& rotation);

/// "48 discs counterrotate: ϖ/Ω = −0.037 ± 0.001 by event, …": one line. A run of few periods has
/// no verb, unless the direction is certain.
std::string headline(const RunResult& result);

/// "steady", "drifting", "jumping", "switching" or "too short to tell".
const char* verdict(SteadyState::Verdict verdict);

/// The findings of the steady-state tests: "the rotation jumps at period 812 from 0.72 to 1.00".
/// Empty if there are none.
std::string steady_state_found(const RunResult& result);

/// The headline and a few lines of details, without the warnings. `verbose` adds lines on errors,
/// energy, overlap and computing time.
std::string report(const RunResult& result, bool verbose);

/// "24 of 48 discs have radius 0.8: 50 %, rounded to whole discs" for a mixture given as a share;
/// otherwise empty.
std::string rounded_share_text(const RunConfig& config);

/// Reasons to distrust the numbers: stopped early, not steady, energy growing without bound. A
/// warning may have a second line "hint: …". Empty if there are none.
std::vector<std::string> warnings(const RunResult& result);
/// The same as lines "warning: …".
std::string warning_lines(const RunResult& result);

}  // namespace swirl
