// What a run's parameters mean to the engine: whether it can be run at all, the container's path,
// and the initial state.
#pragma once

#include <atomic>
#include <optional>
#include <string>

#include "swirl/engine/simulation.hpp"
#include "swirl/physics/container_path.hpp"
#include "swirl/run/parameters.hpp"

namespace swirl {

/// Why this cannot be run, as a full sentence; nothing if it can.
std::optional<std::string> problem(const RunConfig& config);

ContainerPath make_path(const RunConfig& config);

/// What they are, in sentences: "disc" or "sphere".
const char* body_word(const RunConfig& config);

/// A dish without its discs: surfaces, floor, and a path that need not be the configuration's.
InitialState without_discs(const RunConfig& config, const ContainerPath& path);

/// The initial state: discs placed without overlap, with small random velocities relative to the
/// container, all from the seed. Throws WrongCall if the discs do not fit, Interrupted if `stop` is
/// set meanwhile; places may be sought for seconds.
InitialState make_initial_state(const RunConfig& config, const std::atomic<bool>* stop = nullptr);

/// How a simulation is made that gives up when `stop` is set (simulation.hpp).
Tuning stopped_by(const std::atomic<bool>* stop);

/// Speed of the container along its path: 2AM sin(π/M)/T on the polygon, AΩ on the circle.
double container_speed(const RunConfig& config);

}  // namespace swirl
