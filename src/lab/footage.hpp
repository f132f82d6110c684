// What can be filmed: the states of a dish at any moments, asked for in order of time. From the
// engine, from a recorded file, or from the minimal model of one rolling ball.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "files/series.hpp"
#include "lab/run_config.hpp"
#include "physics/rolling_ball.hpp"
#include "physics/snapshot.hpp"
#include "physics/vec2.hpp"

namespace swirl {

/// One pass over it. A second pass is a second call of open().
using Reel = std::function<Snapshot(double swirls)>;

struct Footage {
    /// Starts a pass; the times asked of one reel must not decrease.
    std::function<Reel()> open;
    std::vector<Vec2> path;  // of C in the lab frame; empty if not known
    double container_radius = 0.0, amplitude = 0.0, period = 0.0;
    std::string caption;                  // "48 discs"
    std::vector<std::string> parameters;  // for the parameter line (draw/label.hpp)
    /// Swirls covered by a recording; nothing: from 0 without end.
    std::optional<double> from = {}, to = {};
};

/// Exact states at exact times.
Footage simulated(const RunConfig& config);

/// The paper's minimal model (physics/rolling_ball.hpp) in the paper's container or another one.
Footage rolling(const RollingBall& ball, double amplitude, double period);

/// Frames that were recorded, by us or by a camera. Between two of them discs move in straight
/// lines. Swirls count from the beginning of the run. Throws Failure if there is not one frame.
Footage recorded(const SnapshotSeries& series, const std::string& caption);
/// A trajectory file of ours; throws Failure.
Footage recorded(const std::string& file);

/// "$N$ = 48", "$μ_{d}$ = 1", … in the order in which the paper names them.
std::vector<std::string> parameter_labels(const RunConfig& config);

}  // namespace swirl
