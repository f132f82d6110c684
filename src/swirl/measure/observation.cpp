#include "swirl/measure/observation.hpp"

#include <array>

namespace swirl {

template class BasicObservation<AllMeasurements>;

namespace {

constexpr auto kinds =
    std::apply([](const auto&... row) { return std::array{kind_of(row)...}; }, measurement_list);

}  // namespace

std::span<const MeasurementKind> measurement_kinds() { return kinds; }

const MeasurementKind* find_measurement(std::string_view name) {
    for (const MeasurementKind& kind : kinds)
        if (kind.name == name) return &kind;
    return nullptr;
}

}  // namespace swirl
