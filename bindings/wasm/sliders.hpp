// The sliders of the page: the range and the step of each. Values outside the range are allowed.
#pragma once

#include <algorithm>
#include <array>
#include <string_view>

#include "swirl/run/parameters.hpp"

namespace swirl {

struct Slider {
    const char* parameter;
    double from, to, step;
};

inline constexpr auto sliders = std::to_array<Slider>({
    {"discs", 1, 55, 1},
    {"mu", 0, 2, 0.05},
    {"mu_disc", 0, 2, 0.05},
    {"mu_wall", 0, 2, 0.05},
    {"inertia", 0.25, 20, 0.25},
    {"cannot_spin", 0, 1, 0.05},
    {"mass", 0.1, 10, 0.1},
    {"radius", 0.1, 2, 0.05},
    {"restitution", 0.5, 1, 0.01},
    {"tangential_restitution", 0, 1, 0.05},
    {"contact_duration", 0, 0.1, 0.001},
    {"floor_friction", 0.05, 1, 0.05},
    {"gravity", 0.5, 20, 0.5},
    {"rolling_resistance", 0, 0.05, 0.001},
    {"vertical_disc", 0, 1, 0.05},
    {"vertical_wall", 0, 1, 0.05},
    {"container_radius", 4, 20, 0.1},
    {"amplitude", 0, 5, 0.05},
    {"period", 2, 40, 0.1},
    {"speed", 0.1, 5, 0.1},
    {"path_phase", 0, 360, 15},
    {"sides", 3, 60, 1},
    {"events", 20000, 2000000, 20000},
    {"periods", 20, 2000, 20},
    {"warmup", 0, 200, 1},
    {"events_per_sample", 0, 64, 1},
    {"seed", 1, 100, 1},
});

/// The slider of a parameter; null if it has none.
constexpr const Slider* slider_of(std::string_view parameter) {
    const auto found = std::find_if(sliders.begin(), sliders.end(),
                                    [&](const Slider& s) { return s.parameter == parameter; });
    return found == sliders.end() ? nullptr : &*found;
}
static_assert(std::all_of(sliders.begin(), sliders.end(), [](const Slider& s) {
    return std::any_of(run_parameters.begin(), run_parameters.end(),
                       [&](const Parameter& p) { return std::string_view(p.name) == s.parameter; });
}));

}  // namespace swirl
