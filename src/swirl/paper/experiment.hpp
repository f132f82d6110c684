// The paper's experiment from films, beside simulation: each film that was tracked and measured,
// the runs of as many discs in such a dish seen as the camera saw them
// (run/camera_sampled_run.hpp), tables, drawings, and a report of it all.
#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

#include "swirl/paper/paper.hpp"
#include "swirl/run/parameters.hpp"

namespace swirl {

struct FilmedContainer {
    std::string name;  // of its files and in the report
    bool smooth = false;
    std::string video;                            // where it was
    nlohmann::ordered_json result;                // as of a run; {"failed": why}
    nlohmann::ordered_json found;                 // what stands beside the tracks
    std::vector<std::string> remarks;             // sentences
    std::vector<std::filesystem::path> pictures;  // of the film with its discs, if there are any

    bool good() const { return !result.contains("failed"); }
};

struct ExperimentSettings {
    std::filesystem::path out = "experiment";
    /// Of the simulation, by hand; dish and number of discs are the film's where nothing is said.
    ParameterTexts parameters;
    std::string smooth_mu = "0.1";
    int seeds = 3;
    bool simulate = true;
    std::string command;
};

/// What of the paper's can be measured on tracks.
const std::vector<std::string>& measurements_of_a_video();

struct ExperimentResult {
    std::vector<std::string> findings;
    std::vector<std::filesystem::path> files;  // the report last
    std::size_t runs = 0, remembered = 0;
    nlohmann::ordered_json json;
};

/// Throws WrongCall before any work if the parameters are wrong, Failure, and Interrupted: what is
/// done until then is remembered in OUT/parts.
void check(const ExperimentSettings& settings);
ExperimentResult make_experiment(const std::vector<FilmedContainer>& videos,
                                 const ExperimentSettings& settings, const PaperControl& control);

}  // namespace swirl
