// Who touches first, of everybody: the search of simulation/reference.hpp, written so that a
// compiler makes vectors of it. Discs stand in columns, times are found before they are compared,
// and what kind of leg it is, is asked once for all.
//
// Compiled once for each width of vectors (cmake/engine.cmake), like the engine's event loop.
#pragma once

#include <cstddef>
#include <cstdint>

#include "swirl/physics/contact_time.hpp"
#include "swirl/simulation/pending_event.hpp"

namespace swirl {

/// What contact times depend on: radii, and states that hold each at its time.
struct FlightColumns {
    const double *x, *y, *vx, *vy, *time, *radius;
    std::size_t size;

    SWIRL_INLINE Flight<double> flight(std::size_t k) const {
        return {{x[k], y[k]}, {vx[k], vy[k]}, time[k]};
    }
};

SWIRL_INLINE void find_times_of_wall_contact(const FlightColumns& discs, const Leg& leg,
                                             double container_radius, double* __restrict times) {
    const double R = container_radius;
    if (leg.turning != 0.0) {
        for (std::size_t i = 0; i < discs.size; ++i)
            times[i] = time_of_turning_wall_contact(discs.flight(i), leg, R - discs.radius[i]);
        return;
    }
    const Flight<double> centre{leg.start, leg.velocity, leg.begin};
    for (std::size_t i = 0; i < discs.size; ++i)
        times[i] = time_of_wall_contact(discs.flight(i), centre, R - discs.radius[i]);
}

/// Or the end of the leg. Both arrays have room for as many numbers as there are discs. Pairs come
/// in their order at equal times (pending_event.hpp), so only what is earlier takes the lead.
SWIRL_INLINE PendingEvent find_first_of_all(const FlightColumns& discs, const Leg& leg,
                                            double container_radius, double* __restrict wall_times,
                                            double* __restrict times) {
    find_times_of_wall_contact(discs, leg, container_radius, wall_times);
    double time = never;
    std::size_t disc = discs.size, partner = discs.size;
    for (std::size_t i = 0; i < discs.size; ++i) {
        const Flight<double> flight = discs.flight(i);
        const double radius = discs.radius[i];
        times[i] = wall_times[i];
        for (std::size_t j = i + 1; j < discs.size; ++j)
            times[j] = time_of_contact(flight, discs.flight(j), radius + discs.radius[j]);
        for (std::size_t j = i; j < discs.size; ++j)
            if (times[j] < time) time = times[j], disc = i, partner = j;
    }
    if (leg.end <= time) time = leg.end, disc = partner = discs.size;
    return {time, static_cast<std::uint32_t>(disc), static_cast<std::uint32_t>(partner)};
}

using PlainSearch = PendingEvent (*)(const FlightColumns& discs, const Leg& leg,
                                     double container_radius, double* wall_times, double* times);
PendingEvent plain_search_baseline(const FlightColumns&, const Leg&, double, double*, double*);
PendingEvent plain_search_avx2(const FlightColumns&, const Leg&, double, double*, double*);
PendingEvent plain_search_avx512(const FlightColumns&, const Leg&, double, double*, double*);

}  // namespace swirl
