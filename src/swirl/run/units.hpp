// Values with units: "3mm", "78rpm", "0.532s", "9.81m/s2".
//
// A run computes with r as the unit of length and r/v as the unit of time, where v = AΩ is the
// speed of the container. If values have units, they are converted before anything reads them:
//
//     R' = R/r,   A' = A/r,   T' = 2π A',   g' = g τ²/r,   t_c' = t_c/τ,   τ = T/T'.
//
// The same dish in millimetres, in inches and in these ratios is therefore the same run, bitwise.
// Gravity is 9.81 m/s² unless it is given. A preset supplies the sizes of its own dish. Values with
// and without units cannot be mixed: a number alone would be a multiple of r for one reader and
// millimetres for another.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "swirl/measure/quantity.hpp"
#include "swirl/run/parameters.hpp"

namespace swirl {

/// Powers of length and time.
struct Dimension {
    int length = 0, time = 0;
    bool operator==(const Dimension&) const = default;
};

/// A value with a unit, in µm and s: factors of lengths are then whole numbers, so that 25.5mm is
/// 8.5 times 3mm exactly.
struct UnitValue {
    double value;
    Dimension dimension;
};
inline constexpr double micrometres_per_metre = 1e6;

/// Nothing if the text does not end with a known unit.
std::optional<UnitValue> read_with_unit(std::string_view text);
/// "3mm" for a length, "78rpm or 0.77s" for a time; "" for a pure number.
const char* example_with_unit(const Parameter& parameter);
/// The duration of a period from "0.77s" or "78rpm", in s. Throws UsageError.
double period_in_seconds(std::string_view name, std::string_view text);

/// The texts without units; `length_unit` and `time_unit` tell what r and r/v are. Unchanged if no
/// value has a unit. Throws UsageError.
ParameterTexts without_units(ParameterTexts texts);

/// What r and r/v are in the user's units: values for reports.
struct UserUnits {
    double length;            // the radius
    std::string length_unit;  // "mm"
    double time;              // r/v in s
};
/// Nothing if the configuration has no units.
std::optional<UserUnits> user_units(const RunConfig& config);

/// What a unit of the report is in the user's units: a factor and "mm/s". Masses are
/// multiples of that of a particle.
struct PrintedUnit {
    double factor;
    std::string text;
};
/// Nothing for a pure number or an angle.
std::optional<PrintedUnit> in_user_units(const Unit& unit, const RunConfig& config,
                                         const UserUnits& user);

/// "r = 3 mm, R = 25.5 mm, A = 11.5 mm, 112.8 rpm, v = 136 mm/s"
std::string dish_in_units(const RunConfig& config, const UserUnits& units);

}  // namespace swirl
