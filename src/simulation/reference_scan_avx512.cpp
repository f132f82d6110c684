#include "simulation/reference_scan.hpp"

namespace swirl {
Meeting soonest_meeting_avx512(const FlightColumns& discs, const Leg& leg, double container_radius,
                               double* times) {
    return soonest_meeting(discs, leg, container_radius, times);
}
}  // namespace swirl
