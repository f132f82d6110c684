// For tests of all parameters: values other than the defaults, and what a parameter needs to have
// an effect. Both follow from the table; only parameters that are not numbers are listed here.
#pragma once

#include <fmt/format.h>

#include <map>
#include <string>
#include <variant>

#include "swirl/run/parameters.hpp"

namespace swirl {

/// The text of a value other than the default, for any settable parameter.
inline std::string another(const Parameter& p) {
    static const std::map<std::string, std::string> words = {{"mu", "0.5"},
                                                             {"inertia", "ring"},
                                                             {"mixture", "2:1.2"},
                                                             {"speed", "2"},
                                                             {"path", "circle"},
                                                             {"frictionless", "bulk"},
                                                             {"container_radius", "9"},
                                                             {"direction", "clockwise"},
                                                             {"sizes", "uniform:0.9:1.1"},
                                                             {"initial", "states 2:0:1:0:0"},
                                                             {"periods", "50"},
                                                             {"warmup", "7"},
                                                             {"events_per_sample", "7"},
                                                             {"ramp", "mu=0.5:0.7@2..9"},
                                                             {"preset", "experiment"},
                                                             {"body", "sphere"},
                                                             {"floor", "sliding"},
                                                             {"length_unit", "3mm"},
                                                             {"time_unit", "22ms"}};
    if (const auto found = words.find(p.name); found != words.end()) return found->second;
    if (p.number()) {
        const double value = RunConfig{}.*p.number();
        return fmt::format("{}", value == p.range.lowest ? 0.5 * p.page.slider.to : 0.9 * value);
    }
    const ParameterValue value = value_of(p, {});
    if (const auto* whole = std::get_if<std::int64_t>(&value)) return fmt::format("{}", *whole - 1);
    return "7";
}

/// The parameters without which a run rejects this one.
inline ParameterTexts needed_by(const Parameter& p) {
    ParameterTexts needed;
    if (needs_spheres(p.applies_to)) needed["body"] = "sphere";
    if (needs_floor(p.applies_to)) needed["floor"] = "sliding";
    if (p.name == std::string_view("length_unit")) needed["time_unit"] = "22ms";
    if (p.name == std::string_view("time_unit")) needed["length_unit"] = "3mm";
    return needed;
}

}  // namespace swirl
