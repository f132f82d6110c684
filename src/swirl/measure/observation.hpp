// The observation that can sample every measurement (basic_observation.hpp).
#pragma once

#include <span>
#include <string_view>

#include "swirl/measure/basic_observation.hpp"
#include "swirl/measure/measurement_list.hpp"

namespace swirl {

struct AllMeasurements {
    static constexpr const auto& rows = measurement_list;
};
// Compiled once, in observation.cpp.
extern template class BasicObservation<AllMeasurements>;

/// In the order of the list.
std::span<const MeasurementKind> measurement_kinds();
/// Null if no measurement has this name.
const MeasurementKind* find_measurement(std::string_view name);

}  // namespace swirl
