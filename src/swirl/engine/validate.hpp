// The preconditions of the engine: what a scene, a saved state and a request must fulfil. Each is
// checked where it enters, and never in the event loop.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "swirl/engine/simulation.hpp"
#include "swirl/physics/initial_state.hpp"

namespace swirl {

/// Overlaps up to this fraction of the smaller radius are rounding errors of a contact.
inline constexpr double rounding_overlap = 1e-6;

/// Why no simulation can start from the scene, or continue in it from `progress`, as a sentence;
/// nothing if it can:
///
/// - there is at least one disc; radius, mass and inertia are above 0; a disc that cannot spin has
///   the spin 0
/// - the container has a radius above 0; its path has a period above 0, begins at time 0, ends
///   after a period where it began, and has no gaps; for spheres and coins its segments are
///   straight
/// - no friction coefficient is negative; restitutions are from 0 to 1
/// - all numbers are finite
/// - the clock is within the segment of the path, and the number of path vertices is that of the
///   segments that have ended
/// - the time of each disc is between the start of the period and the clock
/// - without an event so far: no disc overlaps another disc or the wall by more than
///   `rounding_overlap`. Later each disc is at its own time, and rounding errors of contacts remain
///   in the state; then each disc is inside the container at the clock, up to a thousandth of its
///   radius
std::optional<std::string> validate(const InitialState& scene, const Progress& progress = {});

/// The same for settings of speed: this processor and this build have the width, and the grid has
/// at most `max_cells_per_side`.
std::optional<std::string> validate(const Tuning& tuning);

/// Why a simulation with this path and progress cannot replace its surroundings by those of
/// `scene`, besides what validate() says of the new scene: it is not at the start of a period, or
/// the new path has another number of segments.
std::optional<std::string> problem_with_change(const InitialState& scene, std::size_t segments,
                                               const Progress& progress);

/// Why a simulation at `now` cannot advance to another time: the time is in the past, or the clock
/// is not within a period of this length.
std::optional<std::string> problem_with_time(const Progress& now, double period,
                                             std::int64_t periods, double clock);

/// Why no disc, or none of these discs, can be placed in a container: a size is not above 0 and
/// finite. Discs that do not fit are no problem here (place_discs() returns nothing).
std::optional<std::string> problem_with_radii(const std::vector<double>& radii,
                                              double container_radius);

/// False on the browser page. It makes scenes from validated parameters only, and moves the
/// container by hand on paths that do not close. Its program is small without the messages.
#ifdef __wasm__
inline constexpr bool preconditions_are_checked = false;
#else
inline constexpr bool preconditions_are_checked = true;
#endif

/// Stops the program (std::abort) with a line on standard error if there is a problem. The engine
/// has no exceptions. It prints nowhere else. `function` is the one that was called, without
/// "swirl::".
void stop_if(const std::optional<std::string>& problem, const char* function);
[[noreturn]] void stop(const char* problem, const char* function);

/// Which discs overlap each other, or the wall of a container at `centre`, by more than the
/// fraction `tolerance` of the smaller radius.
std::optional<std::string> overlap_in(const InitialState& scene, const Vec2& centre,
                                      double tolerance);

}  // namespace swirl
