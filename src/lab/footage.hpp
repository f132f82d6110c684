// What can be filmed: the states of a dish at any moments, asked for in order of time. From the
// engine, from a recorded file, or from the minimal model of one rolling ball.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "lab/run_config.hpp"
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
    /// Swirls covered; nothing: from 0 without end.
    std::optional<double> from, to;
};

/// Exact states at exact times.
Footage simulated(const RunConfig& config);

/// The paper's minimal model: one rigid ball in the steady state, γ = s γ_c with
/// γ_c = R_container / R_ball; s = 1 rolls without slipping, s = 0 slips without turning in the
/// M-frame. The ball rests at M there, and ϖ = (1 − γ) Ω in the lab.
Footage rolling_ball(double slip, double ball_radius, const RunConfig& container);

/// "$N$ = 48", "$μ_{d}$ = 1", … in the order in which the paper names them.
std::vector<std::string> parameter_labels(const RunConfig& config);

}  // namespace swirl
