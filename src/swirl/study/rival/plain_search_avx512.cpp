#include "swirl/study/rival/plain_search.hpp"

namespace swirl {
PendingEvent plain_search_avx512(const FlightColumns& discs, const Segment& segment,
                                 double container_radius, double* wall_times, double* times) {
    return find_first_of_all(discs, segment, container_radius, wall_times, times);
}
}  // namespace swirl
