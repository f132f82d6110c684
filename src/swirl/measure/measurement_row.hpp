// A row of the list of measurements (measurement_list.hpp).
#pragma once

#include "swirl/measure/sampling.hpp"

namespace swirl {

template <class M>
struct MeasurementRow {
    static_assert(SamplingContract<M>::holds);
    const char* name;
    const char* header;  // file with the definition, in src/swirl/measure/
    const char* description;
    M (*make)(const ObservedDish& dish);
};

template <class M>
constexpr MeasurementRow<M> measurement(const char* name, const char* header,
                                        const char* description) {
    return {name, header, description, [](const ObservedDish&) { return M(); }};
}
/// For a class whose constructor needs the radius of the container.
template <class M>
constexpr MeasurementRow<M> measurement_in_container(const char* name, const char* header,
                                                     const char* description) {
    return {name, header, description,
            [](const ObservedDish& dish) { return M(dish.container_radius); }};
}
/// For one that also needs r.
template <class M>
constexpr MeasurementRow<M> measurement_in_dish(const char* name, const char* header,
                                                const char* description) {
    return {name, header, description, [](const ObservedDish& dish) { return M(dish); }};
}

}  // namespace swirl
