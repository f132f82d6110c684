// The names of the observations, for headers that only pass pointers to them.
#pragma once

namespace swirl {

template <class Measurements>
class BasicObservation;

struct AllMeasurements;
using Observation = BasicObservation<AllMeasurements>;

}  // namespace swirl
