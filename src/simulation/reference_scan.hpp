// Who touches first, of everybody: the paper's search (SI, "Finding the next event") as plainly as
// it can be said. All times, the soonest.
//
// The text is compiled once for each width of vectors (cmake/simulation.cmake), so that the loop
// which `swirl bench` holds the engine against has the best instructions too. For that the discs
// stand in columns, times are found before they are compared, and what kind of leg it is, is asked
// once for all.
#pragma once

#include <cstddef>

#include "swirl/physics/contact_time.hpp"

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

/// Both arrays have room for as many numbers as there are discs.
SWIRL_INLINE Meeting find_soonest_meeting(const FlightColumns& discs, const Leg& leg,
                                          double container_radius, double* __restrict wall_times,
                                          double* __restrict times) {
    find_times_of_wall_contact(discs, leg, container_radius, wall_times);
    Meeting soonest{never, 0, 0};
    for (std::size_t i = 0; i < discs.size; ++i) {
        const Flight<double> flight = discs.flight(i);
        const double radius = discs.radius[i];
        times[i] = wall_times[i];
        for (std::size_t j = i + 1; j < discs.size; ++j)
            times[j] = time_of_contact(flight, discs.flight(j), radius + discs.radius[j]);
        for (std::size_t j = i; j < discs.size; ++j)
            if (times[j] < soonest.time) soonest = {times[j], i, j};
    }
    return soonest;
}

using SoonestMeeting = Meeting (*)(const FlightColumns& discs, const Leg& leg,
                                   double container_radius, double* wall_times, double* times);
Meeting soonest_meeting_baseline(const FlightColumns&, const Leg&, double, double*, double*);
Meeting soonest_meeting_avx2(const FlightColumns&, const Leg&, double, double*, double*);
Meeting soonest_meeting_avx512(const FlightColumns&, const Leg&, double, double*, double*);

}  // namespace swirl
