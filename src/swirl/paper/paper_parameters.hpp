// The paper's numbers that its figures need, each with its source. Defaults of a run (R = 8.6, A =
// 1.892, the period, 30 sides, I = 10) are in physics/container_path.hpp and run/run.hpp; the 10^6
// events of a run are PaperSettings::default_events(). For Python: figures/paper_parameters.py.
#pragma once

#include <cstdint>

namespace swirl {

/// Friction coefficients between discs and at the wall.
struct Friction {
    const char* name;   // in tables and keys
    const char* words;  // in sentences
    double mu_disc, mu_wall;
};

// Figure 5b. Caption: "When one friction is completely turned off, the other is set to 1.0."
inline constexpr Friction high_friction{"high", "high friction", 1.0, 1.0};
inline constexpr Friction medium_friction{"medium", "medium friction", 0.5, 0.5};
inline constexpr Friction low_friction{"low", "low friction", 0.1, 0.1};
inline constexpr Friction no_wall_friction{"no-wall", "no wall friction", 1.0, 0.0};
inline constexpr Friction no_disc_friction{"no-disc", "no disc friction", 0.0, 1.0};
inline constexpr Friction friction_of_5b[] = {high_friction, medium_friction, low_friction,
                                              no_wall_friction, no_disc_friction};

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
