#include "swirl/simulation/reference_scan.hpp"

namespace swirl {
Meeting soonest_meeting_baseline(const FlightColumns& discs, const Leg& leg,
                                 double container_radius, double* wall_times, double* times) {
    return find_soonest_meeting(discs, leg, container_radius, wall_times, times);
}
}  // namespace swirl
