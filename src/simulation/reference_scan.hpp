// Who touches first, of everybody: the paper's search (SI, "Finding the next event") as plainly as
// it can be said. All times, the soonest.
//
// The text is compiled once for each width of vectors (cmake/simulation.cmake), so that the loop
// which `swirl bench` holds the engine against has the best instructions too. For that the discs
// stand in columns, and the times of a disc with all later ones are found before they are compared;
// which instructions do it changes no bit.
#pragma once

#include <cstddef>

#include "physics/contact_time.hpp"

namespace swirl {

/// What contact times depend on: radii, and states that hold each at its time.
struct FlightColumns {
    const double *x, *y, *vx, *vy, *time, *radius;
    std::size_t size;

    SWIRL_INLINE Flight<double> flight(std::size_t k) const {
        return {{x[k], y[k]}, {vx[k], vy[k]}, time[k]};
    }
};

/// Discs i < j, or i = j: the wall. Of several at one instant the smallest i, then the smallest j.
struct Meeting {
    double time;
    std::size_t i, j;
};

SWIRL_INLINE double time_of_wall_contact(const FlightColumns& discs, std::size_t k, const Leg& leg,
                                         double container_radius) {
    const double clearance = container_radius - discs.radius[k];
    if (leg.turning != 0.0) return time_of_turning_wall_contact(discs.flight(k), leg, clearance);
    return time_of_wall_contact(discs.flight(k), {leg.start, leg.velocity, leg.begin}, clearance);
}

/// `times` has room for as many numbers as there are discs.
SWIRL_INLINE Meeting soonest_meeting(const FlightColumns& discs, const Leg& leg,
                                     double container_radius, double* __restrict times) {
    Meeting soonest{never, 0, 0};
    for (std::size_t i = 0; i < discs.size; ++i) {
        const Flight<double> flight = discs.flight(i);
        const double radius = discs.radius[i];
        times[i] = time_of_wall_contact(discs, i, leg, container_radius);
        for (std::size_t j = i + 1; j < discs.size; ++j)
            times[j] = time_of_contact(flight, discs.flight(j), radius + discs.radius[j]);
        for (std::size_t j = i; j < discs.size; ++j)
            if (times[j] < soonest.time) soonest = {times[j], i, j};
    }
    return soonest;
}

using MeetingScan = Meeting (*)(const FlightColumns& discs, const Leg& leg, double container_radius,
                                double* times);
Meeting soonest_meeting_baseline(const FlightColumns&, const Leg&, double, double*);
Meeting soonest_meeting_avx2(const FlightColumns&, const Leg&, double, double*);
Meeting soonest_meeting_avx512(const FlightColumns&, const Leg&, double, double*);

}  // namespace swirl
