// The paper's numbers that its figures need, each with its source. Defaults of a run (R = 8.6, A =
// 1.892, the period, 30 sides, I = 10) are in physics/container_path.hpp and run/run.hpp; the 10^6
// events of a run are PaperSettings::default_events(). For Python: paper/paper_parameters.py.
#pragma once

#include <cstdint>
#include <string_view>

#include "swirl/run/parameters.hpp"

namespace swirl {

/// Friction coefficients between discs and at the wall. With a preset: the spheres of the
/// experiment, whose floor has the same coefficient.
struct Friction {
    const char* name;   // in tables and keys
    const char* words;  // in sentences
    double mu_disc, mu_wall;
    std::string_view preset = {};

    bool spheres() const { return !preset.empty(); }
};

// Figure 5b. Caption: "When one friction is completely turned off, the other is set to 1.0."
inline constexpr Friction high_friction{"high", "high friction", 1.0, 1.0};
inline constexpr Friction medium_friction{"medium", "medium friction", 0.5, 0.5};
inline constexpr Friction low_friction{"low", "low friction", 0.1, 0.1};
inline constexpr Friction no_wall_friction{"no-wall", "no wall friction", 1.0, 0.0};
inline constexpr Friction no_disc_friction{"no-disc", "no disc friction", 0.0, 1.0};
inline constexpr Friction friction_of_5b[] = {high_friction, medium_friction, low_friction,
                                              no_wall_friction, no_disc_friction};

// The experiment of Figures 1 to 4: smooth spheres; roughened ones (Figure 4c); and smooth ones
// with 1.15 cm as the diameter of the container's path instead of its radius.
inline constexpr Friction smooth_spheres{"smooth", "smooth spheres", smooth_friction,
                                         smooth_friction, "experiment"};
inline constexpr Friction rough_spheres{"rough", "roughened spheres", rough_friction,
                                        rough_friction, "experiment-rough"};
inline constexpr Friction half_amplitude{"half", "smooth spheres at half the amplitude",
                                         smooth_friction, smooth_friction, "experiment-half"};

// SI, "Simulation parameters": "for each N between 5 and 48".
inline constexpr std::int64_t first_n = 5, last_n = 48;
// Caption of Figure 5: "a rotating (N = 28) and counterrotating (N = 48) case". Figures 2b, 2c, 5c,
// 5d.
inline constexpr std::int64_t rotating_n = 28, counterrotating_n = 48;
// Main text, experiment: "N (ranging from 24 to 48)".
inline constexpr std::int64_t first_n_of_experiment = 24;
// Figure 4c: where the direction of rotation changes, with smooth and with roughened spheres.
inline constexpr std::int64_t smooth_change_n = 36, rough_change_n = 28;
// Not in the paper: more discs, up to this number. 59 discs can be placed, but from 56 on runs end
// in a frictional collapse, after some periods or at once.
inline constexpr std::int64_t densest_n = 55;

}  // namespace swirl
