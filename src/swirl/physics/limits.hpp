// The smallest and largest allowed values: for the parameters of a run, and for everything that is
// read from a file and measured, drawn or exported.
#pragma once

namespace swirl {

// Outside this range the arithmetic is still correct, but results are meaningless. Such a number is
// usually a typing error.
inline constexpr double smallest_value = 1e-6, largest_value = 1e6;
inline constexpr double max_discs = 1e7, max_events = 1e15, max_periods = 1e12, max_sides = 1e6;

/// Range of moments of inertia; in a mixture they follow from the mass and the square of the
/// radius.
inline constexpr double smallest_inertia = 1e-48, largest_inertia = 1e48;

/// Largest coordinate: the container's centre plus its radius, and twice that for a camera's tracks
/// of discs outside the container.
inline constexpr double largest_coordinate = 4.0 * largest_value;

/// Largest velocity, angle, spin, or other number in a saved state. Values that the parameters
/// allow are far below this limit. Squares and products of numbers up to the limit are finite.
inline constexpr double largest_magnitude = 1e18;

}  // namespace swirl
