// A simulated run measured as a camera would: from noisy positions at a finite frame rate.
//
// The sampled positions are smoothed and measured like the tracks of a video. So the effects of the
// frame rate and of position errors are the same on both sides of a comparison with a video.
#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

#include "swirl/run/run.hpp"

namespace swirl {

struct CameraSampling {
    int frames_per_period = 511;
    double position_error = 0.0;  // standard deviation per coordinate, in disc radii
};

/// Returns result_json() of the run, in which the averages by time and "measured" come from the
/// sampled frames. Throws Interrupted, and Failure if less than one period follows the warm-up.
nlohmann::ordered_json camera_sampled_run(const RunConfig& config, const CameraSampling& sampling,
                                          const std::vector<std::string>& measurements,
                                          const RunControl& control = {});

}  // namespace swirl
