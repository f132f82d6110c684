// A run as a camera would see it: places alone, so many pictures a swirl, with an error of so much.
// Then they are smoothed and measured as a camera's tracks are, and what few pictures and poor
// places do to a number they do to both sides of a comparison.
#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

#include "swirl/run/run.hpp"

namespace swirl {

struct SeenAs {
    int frames_per_swirl = 511;
    double position_error = 0.0;  // of a coordinate, in disc radii, normally distributed
};

/// As result_json() of the run, with the averages by time and "measured" from its pictures. Throws
/// Failure where no swirl is left after the warm-up, Interrupted.
nlohmann::ordered_json seen_run(const RunConfig& config, const SeenAs& seen,
                                const std::vector<std::string>& measurements,
                                const RunControl& control = {});

}  // namespace swirl
