// The earliest contact of all pairs: the search of engine/reference.hpp, optimised. The discs are
// stored in columns and eight pairs are tested together. A square root and a division are computed
// only for the few pairs that may collide before the earliest contact so far: two discs with
// c = s·s − σ² (s: separation, σ: sum of the radii) cannot touch before c / (−2 s·v).
//
// Compiled once for each vector width (cmake/engine.cmake), like the engine's event loop.
#pragma once

#include <cstddef>
#include <cstdint>

#include "swirl/engine/pending_event.hpp"
#include "swirl/math/lanes.hpp"
#include "swirl/physics/contact_time.hpp"

namespace swirl {

/// What contact times depend on: radii, and states at each disc's own time. Columns start at a
/// cache line. They continue to a multiple of eight with discs far away and at rest, which no other
/// disc can reach.
struct FlightColumns {
    const double *x, *y, *vx, *vy, *time, *radius;
    std::size_t size;

    SWIRL_INLINE Flight<double> flight(std::size_t k) const {
        return {{x[k], y[k]}, {vx[k], vy[k]}, time[k]};
    }
};

using Eight = Lanes<8>;

SWIRL_INLINE Flight<Eight> eight_flights(const FlightColumns& discs, std::size_t begin) {
    const auto column = [begin](const double* from) { return Eight::load(from + begin); };
    return {{column(discs.x), column(discs.y)},
            {column(discs.vx), column(discs.vy)},
            column(discs.time)};
}
SWIRL_INLINE Flight<Eight> eight_times(const Flight<double>& flight) {
    return {{Eight(flight.position.x), Eight(flight.position.y)},
            {Eight(flight.velocity.x), Eight(flight.velocity.y)},
            Eight(flight.time)};
}

SWIRL_INLINE void find_times_of_wall_contact(const FlightColumns& discs, const Segment& segment,
                                             double container_radius, double* __restrict times) {
    const double R = container_radius;
    if (segment.turn_rate != 0.0) {
        for (std::size_t i = 0; i < discs.size; ++i)
            times[i] = time_of_arc_contact(discs.flight(i), segment, R - discs.radius[i]);
        return;
    }
    const Flight<Eight> centre = eight_times({segment.start, segment.velocity, segment.begin});
    for (std::size_t i = 0; i < discs.size; i += 8)
        time_of_wall_contact(eight_flights(discs, i), centre,
                             Eight(R) - Eight::load(discs.radius + i))
            .store(times + i);
}

/// Bit k is set if disc i may touch disc begin + k before time `first`.
SWIRL_INLINE unsigned may_come_before(const FlightColumns& discs, std::size_t i, std::size_t begin,
                                      double first) {
    const Flight<Eight> mine = eight_times(discs.flight(i)), others = eight_flights(discs, begin);
    const Eight sum_of_radii = Eight(discs.radius[i]) + Eight::load(discs.radius + begin);
    const Eight now = larger(mine.time, others.time);
    const BasicVec2<Eight> s = others.position_at(now) - mine.position_at(now);
    const Eight b = dot(s, others.velocity - mine.velocity);
    const Eight c = dot(s, s) - sum_of_radii * sum_of_radii;
    constexpr double rounding_margin = 1.0 + 1e-9;  // larger than the rounding error
    const Eight left = c + (b + b) * (Eight(rounding_margin * first) - now);
    alignas(64) double row[8];
    left.store(row);
    return lanes_below(row, 0x1p-1000);
}

/// A dozen discs have no pairs to fill vectors with: all times, and the smallest. Pairs come in
/// their order at equal times (pending_event.hpp), so only what is earlier takes the lead.
SWIRL_INLINE PendingEvent find_first_of_few(const FlightColumns& discs, const double* wall_times,
                                            double* __restrict times) {
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
    return {time, static_cast<std::uint32_t>(disc), static_cast<std::uint32_t>(partner)};
}

SWIRL_INLINE PendingEvent find_first_of_many(const FlightColumns& discs, double end_of_segment,
                                             const double* wall_times) {
    const auto number = [](std::size_t k) { return static_cast<std::uint32_t>(k); };
    PendingEvent first{never, number(discs.size), number(discs.size)};
    for (std::size_t i = 0; i < discs.size; ++i)
        if (wall_times[i] < first.time) first = {wall_times[i], number(i), number(i)};
    for (std::size_t i = 0; i < discs.size; ++i) {
        const Flight<double> flight = discs.flight(i);
        for (std::size_t begin = (i + 1) / 8 * 8; begin < discs.size; begin += 8) {
            unsigned near = may_come_before(discs, i, begin, smaller(first.time, end_of_segment));
            if (begin <= i) near &= ~0u << (i + 1 - begin);
            for (; near != 0; near &= near - 1) {
                const std::size_t j = begin + static_cast<unsigned>(__builtin_ctz(near));
                const PendingEvent contact{
                    time_of_contact(flight, discs.flight(j), discs.radius[i] + discs.radius[j]),
                    number(i), number(j)};
                if (precedes(contact, first)) first = contact;
            }
        }
    }
    return first;
}

/// The earliest contact, or the end of the segment if that is earlier. `wall_times` and `times` are
/// scratch columns.
SWIRL_INLINE PendingEvent find_first_of_all(const FlightColumns& discs, const Segment& segment,
                                            double container_radius, double* __restrict wall_times,
                                            double* __restrict times) {
    find_times_of_wall_contact(discs, segment, container_radius, wall_times);
    const PendingEvent first = discs.size <= 12
                                   ? find_first_of_few(discs, wall_times, times)
                                   : find_first_of_many(discs, segment.end, wall_times);
    if (first.time < segment.end) return first;
    const auto none = static_cast<std::uint32_t>(discs.size);
    return {segment.end, none, none};
}

using AllPairsSearch = PendingEvent (*)(const FlightColumns& discs, const Segment& segment,
                                        double container_radius, double* wall_times, double* times);
PendingEvent all_pairs_search_baseline(const FlightColumns&, const Segment&, double, double*,
                                       double*);
PendingEvent all_pairs_search_avx2(const FlightColumns&, const Segment&, double, double*, double*);
PendingEvent all_pairs_search_avx512(const FlightColumns&, const Segment&, double, double*,
                                     double*);

}  // namespace swirl
