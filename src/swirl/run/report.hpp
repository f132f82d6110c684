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

/// 1, −1, or 0 if the mean is within two standard errors of zero.
int direction_of(const Estimate& rotation);
/// "rotate with the swirl", "rotate against the swirl (counterrotation)" or "stall, …". On a path
/// without an M-frame there is no swirl: "rotate clockwise". `clockwise`: the direction of the
/// path.
std::string rotation_words(const Estimate& rotation, bool with_a_swirl, bool clockwise = false);

/// A line of a report: "  steady      yes".
std::string report_line(std::string_view name, const std::string& value);

/// The rate of the best-fitting rigid body, if it differs from the mean over the discs by more than
/// three errors; otherwise empty.
std::string rigid_body_line(const RotationEstimates& rotation);

/// "48 discs rotate against the swirl (counterrotation): ϖ/Ω = −0.037 ± 0.001": one line, with the
/// mean over the discs, by time. A run of few periods has no verb, unless the direction is certain.
std::string headline(const RunResult& result);

/// "steady", "drifting", "jumping", "switching" or "too short to tell".
const char* verdict(SteadyState::Verdict verdict);

/// The findings of the steady-state tests: "the rotation jumps at period 812 from 0.72 to 1.00".
/// Empty if there are none.
std::string steady_state_found(const RunResult& result);

/// The headline, what is averaged, whether it is steady, and the final state, without the warnings.
/// A further line reports a rigid-body rate that differs beyond the errors. `verbose` adds all four
/// rates, errors, events, energy, overlap and computing time.
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
