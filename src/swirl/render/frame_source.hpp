// Sources of images and movies: the states of a container at arbitrary times, asked for
// in order. They come from the engine, from a recording, or from the minimal model of one rolling
// ball.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "swirl/io/series.hpp"
#include "swirl/math/vec2.hpp"
#include "swirl/physics/rolling_ball.hpp"
#include "swirl/physics/snapshot.hpp"
#include "swirl/render/image.hpp"
#include "swirl/run/config.hpp"

namespace swirl {

/// One pass over a source: returns the state at a time in periods. Times must not decrease.
using Playback = std::function<Snapshot(double periods)>;
/// One pass over the images of a camera.
using BackdropPlayback = std::function<Backdrop(double periods)>;

struct FrameSource {
    /// Starts a pass. Passes are independent of each other.
    std::function<Playback()> open;
    std::vector<Vec2> path;  // path of C in the lab frame; empty if unknown
    double container_radius = 0.0, amplitude = 0.0, period = 0.0;
    bool clockwise = false;               // direction of the path
    std::string caption;                  // "48 discs"
    std::vector<std::string> parameters;  // list of parameters (render/label.hpp)
    /// The range of a recording in periods. Empty: from 0 on, without end.
    std::optional<double> from = {}, to = {};
    /// The quantities that the states hold.
    bool has_spin = true, has_orientation = true;
    bool has_slip = false;  // spheres on a floor slip
    /// If discs come and go: their IDs at a time, ascending. Empty: every state has the same discs.
    std::function<std::vector<std::int64_t>(double periods)> ids = {};
    /// Starts a pass with interpolated states, if open() returns recorded frames only but discs can
    /// be followed between them. Empty: use open().
    std::function<Playback()> open_interpolated = {};
    /// Starts a pass over camera images. Empty: there are none.
    std::function<BackdropPlayback()> open_backdrop = {};
    double frames_per_period = 0.0;  // rate of a recording; 0: any number
};

/// Exact states at exact times. The passes throw Interrupted after `stop` was set.
FrameSource simulated(const RunConfig& config, const std::atomic<bool>* stop = nullptr);

/// The paper's minimal model (physics/rolling_ball.hpp) in a container on a circular path.
FrameSource rolling(const RollingBall& ball, double amplitude, double period);

/// Recorded frames. Between two frames discs move on straight lines. Periods count from the
/// beginning of the run. Throws Failure if there is no frame.
FrameSource recorded(const SnapshotSeries& series, const std::string& caption);
/// A trajectory file of this program. Throws Failure.
FrameSource recorded(const std::string& file);

/// "$N$ = 48", "$μ_{d}$ = 1", … in the order of the paper.
std::vector<std::string> parameter_labels(const RunConfig& config);

}  // namespace swirl
