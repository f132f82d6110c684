// A run's result in words, for the terminal.
#pragma once

#include <string>
#include <vector>

#include "swirl/run/result.hpp"

namespace swirl {

/// "−0.037 ± 0.001": as many digits as the error supports; without an error, three.
std::string with_error(double mean, double error);

/// "1,000,000"
std::string with_commas(std::uint64_t number);

/// "rotate", "counterrotate", or "stall" when the mean is within two standard errors of zero.
std::string sense_of_rotation(const Estimate& rotation);

/// "48 discs counterrotate: ϖ/Ω = −0.037 ± 0.001 by event, …": one line.
std::string headline(const RunResult& result);

/// "steady", "drifting", "jumping", "switching" or "too short to tell".
const char* verdict(SteadyState::Verdict verdict);

/// What the tests of the steady state found: "the rotation jumps at period 812 from 0.72 to 1.00";
/// empty if they found nothing.
std::string steady_state_found(const RunResult& result);

/// The headline and what else there is to say, a few lines.
std::string report(const RunResult& result);

/// What a reader must know before believing the numbers: stopped early, not steady, energy growing
/// without bound. Full sentences; empty for a sound run.
std::vector<std::string> warnings(const RunResult& result);

}  // namespace swirl
