// How large and how small a dish may be: the ranges of the parameters of a run, and of everything
// that is read from a file and measured, drawn or exported.
#pragma once

namespace swirl {

// Beyond these the arithmetic is still right but a result means nothing any more; most often a
// number outside is a slip of the keyboard.
inline constexpr double smallest_value = 1e-6, largest_value = 1e6;
inline constexpr double max_discs = 1e7, max_events = 1e15, max_periods = 1e12, max_sides = 1e6;

/// Moments of inertia: in a mixture they follow from the mass and the square of the radius.
inline constexpr double smallest_inertia = 1e-48, largest_inertia = 1e48;

/// Of a coordinate: the container's centre and its radius, and as much again for a camera's tracks
/// of discs that were not in it.
inline constexpr double largest_coordinate = 4.0 * largest_value;

/// Of velocities, angles and spins, and of all that a saved state holds. What the parameters allow
/// stays far below it, and squares and products of such numbers are numbers still.
inline constexpr double largest_magnitude = 1e18;

}  // namespace swirl
