// A run's parameters in terms of the engine: their validation, the container's path, and the
// initial state.
#pragma once

#include <atomic>
#include <optional>
#include <string>

#include "swirl/engine/simulation.hpp"
#include "swirl/measure/quantity.hpp"
#include "swirl/physics/container_path.hpp"
#include "swirl/run/message.hpp"
#include "swirl/run/parameters.hpp"

namespace swirl {

/// Why this configuration cannot be run; nothing if it can.
std::optional<Message> problem(const RunConfig& config);

ContainerPath make_path(const RunConfig& config);

/// The particles in messages: "disc" or "sphere".
const char* body_word(const RunConfig& config);
/// The same as the value {body} of a message.
MessageValue body_of(const RunConfig& config);

/// The container, its surfaces and its floor without discs. `path` may differ from the
/// configuration's.
InitialState without_discs(const RunConfig& config, const ContainerPath& path);

/// The initial state: that of --initial, or discs without overlap and with small random velocities
/// in the container, which the seed determines. Throws UsageError if the discs do not fit, and
/// Interrupted if `stop` is set meanwhile (the placement may take seconds).
InitialState make_initial_state(const RunConfig& config, const std::atomic<bool>* stop = nullptr);

/// Settings of a simulation that ends early when `stop` is set (simulation.hpp).
Tuning stopped_by(const std::atomic<bool>* stop);

/// Mean speed of the container along its path: 2AM sin(π/M)/T on the polygon, AΩ on the circle.
double container_speed(const RunConfig& config);

/// r, v and m of a configuration, in its own units. v is rounded to 24 bits, as many as the digits
/// of the paper's A and T define, so that the paper's container moves at 1. If the container is at
/// rest, v is the speed of the paper's container with this r and T.
MeasuredUnits units_of(const RunConfig& config);
ObservedDish dish_of(const RunConfig& config);

}  // namespace swirl
