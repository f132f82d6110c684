// A still image: one instant, or several on top of each other as under a stroboscope.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "swirl/render/frame_source.hpp"
#include "swirl/render/page.hpp"

namespace swirl {

struct StillConfig {
    std::vector<FrameSource> sources;  // order: left to right
    Appearance appearance;
    double at = 20.0;    // periods
    int flashes = 1;     // instants of the stroboscope; the last one is `at`
    double every = 1.0;  // periods between two flashes
    std::string out;     // .png, .svg or .pdf
};

/// The format by the file extension; nothing if it is no image format.
std::optional<ImageFormat> image_format(const std::string& path);

/// An error message if this image cannot be drawn.
std::optional<std::string> problem(const StillConfig& config);

/// Draws the image and writes it. Returns the period since which it counts turns. Throws Failure.
double make_still(const StillConfig& config);

/// Writes the image file atomically (io/atomic_file.hpp). Throws Failure.
void write_image(const std::filesystem::path& file, const std::string& bytes);

}  // namespace swirl
