// The paper's experiment from videos, compared with simulation: tables, drawings and a report of
// tracked videos, and of simulations with the same number of discs in the same container, sampled
// like the video (camera_sampled_run.hpp).
#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

#include "swirl/paper/paper.hpp"
#include "swirl/run/parameters.hpp"

namespace swirl {

struct ContainerVideo {
    std::string name;  // of its files and in the report
    bool smooth = false;
    std::string video;                 // path
    Json result;                       // as of a run, or {"failed": reason}
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

/// Throws UsageError before any work if the parameters are invalid, Failure, and Interrupted;
/// finished runs are stored in OUT/parts.
void check(const ExperimentSettings& settings);
ExperimentResult make_experiment(const std::vector<ContainerVideo>& videos,
                                 const ExperimentSettings& settings, const PaperControl& control);

}  // namespace swirl
