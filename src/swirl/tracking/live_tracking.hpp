// Tracks a video while it is recorded, by the steps of track_video():
//
//   1  the survey, of the first frames: if they do not suffice, of twice as many
//   2  detection, frame by frame; links to the frame before; the rotation rate ϖ so far
//   3  at the end of the video all steps after the detection, for all frames
//
// Step 3 gives what track_video() gives for the same frames, except that track_video() surveys
// frames from the whole video. If the survey takes all frames, the results are bitwise identical.
#pragma once

#include <cstdint>
#include <functional>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "swirl/statistics/block_average.hpp"
#include "swirl/tracking/live_video.hpp"
#include "swirl/tracking/tracking.hpp"

namespace swirl {

struct LiveDisc {
    Vec2 position{0.0, 0.0};  // as seen
    double radius = 0.0;
    int track = -1;  // −1: not linked
};

/// ϖ by time, in units of Ω, from central differences of the positions. Links are not corrected
/// later, and no disc is added that was missed.
struct LiveRotation {
    double last_period = 0.0;  // mean over the last complete period
    Estimate mean{};           // over all complete periods
    std::size_t periods = 0;   // complete
};

/// What is known after a frame.
struct LiveFrame {
    std::int64_t number = 0;  // of this frame, from 0
    cv::Mat grey;
    bool surveyed = false;  // the members below are known
    std::optional<Vec2> rim_centre;
    double rim_radius = 0.0;
    std::size_t number_of_discs = 0;  // as surveyed
    std::vector<LiveDisc> discs;
    double period = 0.0;  // frames
    LiveRotation rotation;
};

struct LiveSettings {
    std::int64_t survey_frames = 96;
    std::function<void(const LiveFrame&)> show;  // called for each frame, in order
};

struct LiveResult {
    TrackedVideo video;
    std::int64_t surveyed_frames = 0;
    LiveRotation rotation;
};

/// Returns when the video ends. `settings.video` names it in messages. Throws Failure with the
/// likely cause.
LiveResult track_live(LiveVideo& video, TrackingSettings settings, const LiveSettings& live);

/// The frame with the discs, the rim and the results drawn, as a JPEG file.
std::string live_jpeg(const LiveFrame& frame);

}  // namespace swirl
