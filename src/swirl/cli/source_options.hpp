// Options for the source of an image or a movie: a run, a recording, a camera's tracks or the
// minimal model.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "swirl/cli/options.hpp"
#include "swirl/cli/track_options.hpp"
#include "swirl/physics/container_path.hpp"
#include "swirl/run/parameters.hpp"

namespace swirl {

struct Appearance;
struct FrameSource;

struct SourceTexts {
    std::shared_ptr<ParameterTexts> parameters;
    std::string file;  // a recording, or a configuration before take_video_config()
    TrackTexts camera;
    std::string images;  // images of the camera
    std::int64_t first_image = 0;
    std::string compared;  // numbers of discs
    std::optional<double> slip;
    double ball_radius = 0.5 * paper_container_radius;
};

/// A paragraph of the help.
inline constexpr const char* source_explanation =
    "FILE is a recorded trajectory (.h5), a camera's tracks (CSV of trackpy), a LAMMPS text dump, "
    "or a TOML file with option names as keys. A TOML file may name a recording as `file`; options "
    "on the command line take precedence. --over takes a video, or numbered files such as "
    "'frames/%05d.png'.\n";

std::shared_ptr<SourceTexts> add_source_options(Subcommand& subcommand);

/// If FILE is a configuration (.toml), takes from it every option that was not given.
void take_video_config(Subcommand& subcommand, SourceTexts& texts, const std::string& command,
                       const std::vector<std::vector<std::string>>& instead = {});

/// One source, or with --compare one for each number. Throws UsageError or Failure.
std::vector<FrameSource> frame_sources(const SourceTexts& texts);

/// Throws UsageError if an output file is the recording or one of the camera images.
void reject_output_onto_source(const SourceTexts& texts, const std::vector<std::string>& outputs);

/// Prints warnings about recordings that do not hold all that is shown.
void print_source_warnings(const std::vector<FrameSource>& sources, const Appearance& appearance);

}  // namespace swirl
