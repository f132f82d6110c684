// A movie of one container, or of several next to each other, in the lab frame, the M-frame or
// both.
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "swirl/render/frame_source.hpp"
#include "swirl/render/page.hpp"

namespace swirl {

struct MovieConfig {
    std::vector<FrameSource> sources;  // order: left to right
    Appearance appearance;
    double start = 0.0;  // periods
    double pace = 0.5;   // periods per second of the movie
    int frames_per_second = 60;
    int frames = 1200;
    std::string out;            // movie file; empty: none
    std::string frames_folder;  // PNG files go there; empty: none
};

struct MovieControl {
    const std::atomic<bool>* stop = nullptr;
    /// Called regularly with the number of finished frames.
    std::function<void(int done, int of)> progress;
};

struct MovieResult {
    int frames = 0;  // frames in the file
    bool complete = false;
};

/// An error message if this movie cannot be made.
std::optional<std::string> problem(const MovieConfig& config);

/// File name of a frame in MovieConfig::frames_folder. The first frame has number 1.
std::string frame_name(const std::string& folder, int number);

/// If it is stopped early, the movie holds the frames made so far. Throws Failure.
MovieResult make_movie(const MovieConfig& config, const MovieControl& control = {});

}  // namespace swirl
