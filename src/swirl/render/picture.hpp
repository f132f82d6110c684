// A picture of one instant, or of several laid over each other as a stroboscope would.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "swirl/render/frame_source.hpp"
#include "swirl/render/movie.hpp"

namespace swirl {

struct PictureConfig {
    std::vector<FrameSource> sources;  // side by side
    Appearance appearance;
    double at = 20.0;    // swirls
    int flashes = 1;     // of the stroboscope; the last one is at `at`
    double every = 1.0;  // swirls between two flashes
    std::string out;     // .png, .svg or .pdf
};

/// By the ending of the name; nothing for any other ending.
std::optional<PictureFormat> picture_format(const std::string& path);

/// Why this cannot be drawn, as a full sentence; nothing if it can.
std::optional<std::string> problem(const PictureConfig& config);

/// Throws Failure.
void make_picture(const PictureConfig& config);

/// A picture's file, whole or not at all (io/atomic_file.hpp). Throws Failure.
void write_picture(const std::filesystem::path& file, const std::string& bytes);

}  // namespace swirl
