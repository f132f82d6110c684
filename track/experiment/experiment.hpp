// The paper's experiment from videos, compared with simulation: tables, drawings and a report of
// tracked videos, and of simulations with the same number of discs in the same container, sampled
// like the video (camera_sampled_run.hpp).
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "swirl/run/parameters.hpp"
#include "swirl/run/run.hpp"
#include "track/experiment/results.hpp"

namespace swirl {

struct ContainerVideo {
    std::string name;  // name of its files and in the report
    bool smooth = false;
    std::string video;                 // path
    Json result;                       // result as of a run, or {"failed": reason}
    Json found;                        // what tracking found: path, species, quality
    std::vector<std::string> remarks;  // sentences
    std::vector<fs::path> images;      // images of the video with the detected discs

    bool good() const { return !result.contains("failed"); }
};

struct ExperimentSettings {
    fs::path out = "experiment";
    /// Parameters of the simulation. Container and number of discs default to those of the video.
    ParameterTexts parameters;
    std::string smooth_mu = "0.1";
    int seeds = 3;
    bool simulate = true;
    std::string command;
};

/// The measurements of the paper that work on tracks.
const std::vector<std::string>& measurements_of_a_video();

struct ExperimentResult {
    std::vector<std::string> findings;
    std::vector<fs::path> files;  // the report last
    std::size_t runs = 0, remembered = 0;
    Json json;
};

struct ExperimentControl {
    const std::atomic<bool>* stop = nullptr;
    unsigned threads = 0;                           // 0: all cores
    std::function<void(double fraction)> progress;  // share of all simulations
};

/// Throws UsageError before any work if the parameters are invalid, Failure, and Interrupted;
/// finished runs are stored in OUT/parts.
void check(const ExperimentSettings& settings);
ExperimentResult make_experiment(const std::vector<ContainerVideo>& videos,
                                 const ExperimentSettings& settings,
                                 const ExperimentControl& control);

}  // namespace swirl
