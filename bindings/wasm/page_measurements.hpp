// The measurements of the page. It shows no others and is smaller without them; it prints no
// descriptions.
#pragma once

#include <tuple>

#include "swirl/measure/angular_profile.hpp"
#include "swirl/measure/basic_observation.hpp"
#include "swirl/measure/density_map.hpp"
#include "swirl/measure/flow_map.hpp"
#include "swirl/measure/measurement_row.hpp"
#include "swirl/measure/slip.hpp"
#include "swirl/measure/spin_frustration.hpp"

namespace swirl {

struct PageMeasurements {
    static constexpr std::tuple rows{
        measurement_in_container<DensityMaps>("density", "", ""),
        measurement_in_container<FlowMap>("flow", "", ""),
        measurement<AngularProfile>("profile", "", ""),
        measurement<Slip>("slip", "", ""),
        measurement<SpinFrustration>("frustration", "", ""),
    };
};
using PageObservation = BasicObservation<PageMeasurements>;

}  // namespace swirl
