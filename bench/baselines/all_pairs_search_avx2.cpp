#include "baselines/all_pairs_search.hpp"

namespace swirl {
PendingEvent all_pairs_search_avx2(const FlightColumns& discs, const Segment& segment,
                                   double container_radius, double* wall_times, double* times) {
    return find_first_of_all(discs, segment, container_radius, wall_times, times);
}
}  // namespace swirl
