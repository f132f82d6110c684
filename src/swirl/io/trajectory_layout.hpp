// The datasets of a trajectory that hold a value per frame, for its reader and its writer. The
// comment of trajectory.hpp describes the whole file.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "swirl/io/h5md.hpp"

namespace swirl::trajectory_layout {

/// Series of values for each disc. From rolling_spin on they exist for spheres and coins only.
enum Series { position, velocity, angle, angular_velocity, rolling_spin, orientation, all_series };
inline constexpr int series_of_discs = rolling_spin;
constexpr int series_count(bool are_spheres) { return are_spheres ? all_series : series_of_discs; }

struct SeriesLayout {
    const char* name;
    std::uint64_t components;
    const char* scale;  // the dimension scale of the components, if there is more than one
};
inline constexpr SeriesLayout layouts[all_series] = {
    {"position", 3, "/xyz"},          {"velocity", 3, "/xyz"},    {"angle", 1, nullptr},
    {"angular_velocity", 1, nullptr}, {"rolling_spin", 2, "/xy"}, {"orientation", 4, "/wxyz"}};
inline std::string group_of(int series) { return h5md::particles + "/" + layouts[series].name; }

/// Datasets with one integer for each frame, and their paths.
enum Counter { step, periods, events, counters };
inline const std::array<std::string, counters> counter_paths{h5md::particles + "/position/step",
                                                             h5md::observables + "/swirls/value",
                                                             h5md::observables + "/events/value"};

/// Datasets with one real number for each frame, and their paths. The last two exist only if the
/// period changes during the run.
enum Scalar {
    time,
    clock,
    centre_x,
    centre_y,
    centre_vx,
    centre_vy,
    period_length,
    period_start,
    scalars
};
constexpr int scalar_count(bool period_changes) { return period_changes ? scalars : period_length; }
inline const std::array<std::string, scalars> scalar_paths{
    h5md::particles + "/position/time",        h5md::observables + "/clock/value",
    h5md::observables + "/container_x/value",  h5md::observables + "/container_y/value",
    h5md::observables + "/container_vx/value", h5md::observables + "/container_vy/value",
    h5md::observables + "/period/value",       h5md::observables + "/period_start/value"};

}  // namespace swirl::trajectory_layout
