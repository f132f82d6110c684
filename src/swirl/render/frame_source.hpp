// What can be filmed: the states of a dish at any moments, asked for in order of time. From the
// engine, from a recorded file, or from the minimal model of one rolling ball.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "swirl/io/series.hpp"
#include "swirl/io/tracks.hpp"
#include "swirl/math/vec2.hpp"
#include "swirl/physics/rolling_ball.hpp"
#include "swirl/physics/snapshot.hpp"
#include "swirl/render/image.hpp"
#include "swirl/run/config.hpp"

namespace swirl {

/// One pass over it. A second pass is a second call of open().
using Reel = std::function<Snapshot(double periods)>;
/// One pass over what a camera saw.
using BackdropReel = std::function<Backdrop(double periods)>;

struct FrameSource {
    /// Starts a pass; the times asked of one reel must not decrease.
    std::function<Reel()> open;
    std::vector<Vec2> path;  // of C in the lab frame; empty if not known
    double container_radius = 0.0, amplitude = 0.0, period = 0.0;
    std::string caption;                  // "48 discs"
    std::vector<std::string> parameters;  // for the parameter line (render/label.hpp)
    /// Swirls covered by a recording; nothing: from 0 without end.
    std::optional<double> from = {}, to = {};
    /// What the recording tells of the discs.
    bool knows_spin = true, knows_orientation = true;
    bool knows_slip = false;  // spheres on a floor
    /// Where discs come and go: their names at that moment, ascending. Empty: they are the same
    /// all the time.
    std::function<std::vector<std::int64_t>(double periods)> ids = {};
    /// Where open() shows nothing but recorded frames, though the discs between them are known: a
    /// pass that has those too. Empty: open() does.
    std::function<Reel()> open_between = {};
    /// Where there are pictures of a camera: starts a pass over them.
    std::function<BackdropReel()> open_backdrop = {};
    double frames_per_swirl = 0.0;  // of a recording; 0: as many as one likes
};

/// Exact states at exact times.
FrameSource simulated(const RunConfig& config, const std::atomic<bool>* stop = nullptr);

/// The paper's minimal model (physics/rolling_ball.hpp) in the paper's container or another one.
FrameSource rolling(const RollingBall& ball, double amplitude, double period);

/// Frames that were recorded, by us or by a camera. Between two of them discs move in straight
/// lines. Swirls count from the beginning of the run. Throws Failure if there is not one frame.
FrameSource recorded(const SnapshotSeries& series, const std::string& caption);
/// A trajectory file of ours; throws Failure.
FrameSource recorded(const std::string& file);

/// Tracks of a camera or of another program. Where discs come and go, or over a camera's pictures,
/// the nearest frame is shown as it is. `pictures` is a name as for render/numbered_frames.hpp, in
/// which frame 0 has the number `first_picture`; empty: none. Throws Failure.
FrameSource tracked(Tracks tracks, const TrackScale& scale, const std::string& caption,
                    const std::string& pictures = "", std::int64_t first_picture = 0);

/// "$N$ = 48", "$μ_{d}$ = 1", … in the order in which the paper names them.
std::vector<std::string> parameter_labels(const RunConfig& config);

}  // namespace swirl
