// The options that say what is drawn or filmed: a recording, a run, a second dish beside it, or the
// minimal model, or a camera's tracks.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "swirl/cli/options.hpp"
#include "swirl/cli/track_options.hpp"
#include "swirl/render/frame_source.hpp"
#include "swirl/render/movie.hpp"
#include "swirl/run/parameters.hpp"

namespace swirl {

struct SourceTexts {
    std::shared_ptr<ParameterTexts> parameters;
    std::string file;  // a recording; of a call also a configuration
    TrackTexts camera;
    std::string pictures;  // of the camera
    std::int64_t first_picture = 0;
    std::optional<std::int64_t> beside;
    std::optional<double> slip;
    double ball_radius = 0.5 * paper_container_radius;
};

std::shared_ptr<SourceTexts> add_source_options(Subcommand& subcommand);

/// Where FILE is a configuration (.toml), takes what it says of the options that were not given;
/// it may name a recording as `file`.
void take_video_config(Subcommand& subcommand, SourceTexts& texts, const std::string& command,
                       const std::vector<std::vector<std::string>>& instead = {});

/// One dish or two. Throws WrongCall or Failure.
std::vector<FrameSource> frame_sources(const SourceTexts& texts);

/// Throws WrongCall if a file that is to be written is what is shown, or one of the pictures that
/// it is drawn over.
void reject_to_draw_onto_source(const SourceTexts& texts, const std::vector<std::string>& outputs);

/// What a recording does not tell well enough for what was shown, in lines for the report.
std::string remark_on(const std::vector<FrameSource>& sources, const Appearance& appearance);

}  // namespace swirl
