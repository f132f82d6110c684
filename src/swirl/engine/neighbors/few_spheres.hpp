// Speed only; results stay bitwise identical. The search for a few spheres. Like all_pairs.hpp for
// discs, it tests all pairs. But spheres fly along parabolas, and each has a third pending event:
// it begins to roll.
//
// On a floor all spheres are predicted again with every segment, so only contacts within the
// segment matter. Seen from the floor, whose velocity u is constant, a sphere is at x + (t − t₀) v
// − t u = X + (t − t₀)(v − u) + ½ (t − t₀)² a with X = x − t₀ u. Until the end of the segment, and
// while it has no event, its distance from X is at most its reach,
//
//     |v − u| (t_end − t₀) + ½ |a| (t_end − t₀)².
//
// Two spheres whose X are farther apart than the sum of reaches and radii do not collide. In a
// thirtieth of a period a sphere moves a fraction of its radius, so five or six candidates are
// left. Reaches are enlarged by far more than rounding errors, so the way they are computed does
// not matter.
#pragma once

#include "swirl/engine/neighbors/all_pairs.hpp"
#include "swirl/engine/neighbors/neighbor_search.hpp"
#include "swirl/engine/neighbors/prediction.hpp"
#include "swirl/engine/neighbors/search_states.hpp"
#include "swirl/engine/neighbors/sphere_contacts.hpp"
#include "swirl/engine/pending_event.hpp"
#include "swirl/engine/resolve.hpp"
#include "swirl/math/lanes.hpp"
#include "swirl/physics/contact_time.hpp"

namespace swirl {
inline namespace SWIRL_TARGET {
namespace few_spheres {

using all_pairs::set;
using spheres::Eight, spheres::EightOthers, spheres::EightTimes, spheres::earlier_contact;

/// Columns that are loaded as vectors are also stored as vectors (`set`), because a wide load right
/// behind a narrow store has to wait for it. The other columns are not.
SWIRL_INLINE void copy(FewSpheresState& state, std::uint32_t i) {
    const Parabola<double> flight = Spheres::flight(state, i);
    SphereColumns& columns = state.columns;
    columns.x[i] = flight.position.x;
    columns.y[i] = flight.position.y;
    columns.vx[i] = flight.velocity.x;
    columns.vy[i] = flight.velocity.y;
    columns.ax[i] = flight.acceleration.x;
    columns.ay[i] = flight.acceleration.y;
    columns.time[i] = flight.time;
    columns.rolls[i] = state.spheres[i].motion.begins_to_roll;
    // Without a floor the end of a segment predicts no contact again, so all spheres are
    // candidates.
    if (!Spheres::change_with_segment(state)) {
        set(columns.X, i, 0.0);
        set(columns.Y, i, 0.0);
        return;
    }
    const Segment& segment = state.segments[state.segment];
    const double distance = spheres::max_distance_over_floor(
        flight.velocity, flight.acceleration, segment.velocity, segment.end - flight.time);
    set(columns.X, i, flight.position.x - flight.time * segment.velocity.x);
    set(columns.Y, i, flight.position.y - flight.time * segment.velocity.y);
    set(columns.reach, i, distance + 0x1p-30 * state.container_radius);
}

/// Bit k is set if sphere i may collide with sphere k within this segment.
template <int G>
SWIRL_INLINE std::uint64_t within_reach(const FewSpheresState& state, std::uint32_t i) {
    const SphereColumns& columns = state.columns;
    const Eight X(columns.X[i]), Y(columns.Y[i]), near(columns.reach[i] + columns.radius[i]);
    Eight beyond[G];
    for (int g = 0; g < G; ++g) {
        const int k = 8 * g;
        const Eight dx = Eight::load(columns.X + k) - X, dy = Eight::load(columns.Y + k) - Y;
        const Eight maximum =
            near + (Eight::load(columns.reach + k) + Eight::load(columns.radius + k));
        beyond[g] = larger(dx * dx + dy * dy - maximum * maximum, Eight(0.0));
    }
    const std::uint64_t all_spheres = ~std::uint64_t{0} >> (64 - state.size);
    return lanes_equal(beyond, 0.0) & all_spheres & ~(std::uint64_t{1} << i);
}

SWIRL_INLINE void put(EightOthers& others, int lane, const SphereColumns& columns,
                      std::uint32_t k) {
    others.x[lane] = columns.x[k];
    others.y[lane] = columns.y[k];
    others.vx[lane] = columns.vx[k];
    others.vy[lane] = columns.vy[k];
    others.ax[lane] = columns.ax[k];
    others.ay[lane] = columns.ay[k];
    others.time[lane] = columns.time[k];
    others.radius[lane] = columns.radius[k];
    others.rolls[lane] = columns.rolls[k];
    others.ids[lane] = k;
}

/// Predicts the first contact of sphere i with another sphere. Returns its time. (This function and
/// those below are not inlined: the call costs little, and the loops compile in a third of the
/// time.)
template <int G>
[[gnu::noinline]] static double predict_contact(FewSpheresState& state, std::uint32_t i) {
    SphereColumns& columns = state.columns;
    const EightTimes mine(state, i);
    PendingEvent first{never, i, 0};
    for (std::uint64_t left = within_reach<G>(state, i); left != 0;) {
        EightOthers others;
        int count = 0;
        for (; left != 0 && count < 8; left &= left - 1, ++count)
            put(others, count, columns, static_cast<std::uint32_t>(__builtin_ctzll(left)));
        for (int lane = count; lane < 8; ++lane) put(others, lane, columns, others.ids[0]);
        first = earlier_contact(state, mine, others, count, first);
    }
    store_partner(state, first);
    columns.contact[i] = first.time;
    return first.time;
}

[[gnu::noinline]] static void predict_wall(FewSpheresState& state, std::uint32_t i) {
    state.columns.wall[i] = spheres::wall_time(state, i);
}

/// Stores and returns the earliest of a sphere's three events: contact, wall, beginning to roll.
SWIRL_INLINE double update_first(FewSpheresState& state, std::uint32_t i) {
    SphereColumns& columns = state.columns;
    const double first = smaller(smaller(columns.contact[i], columns.wall[i]), columns.rolls[i]);
    set(columns.first, i, first);
    return first;
}

/// Returns the first in order of simultaneous events; the bits select the spheres.
SWIRL_INLINE PendingEvent first_in_order(const FewSpheresState& state, double time,
                                         std::uint64_t contacts, std::uint64_t walls,
                                         std::uint64_t rolls) {
    const PendingEvent first = all_pairs::first_in_order(state, time, contacts, walls);
    if (rolls == 0) return first;
    const PendingEvent roll{time, static_cast<std::uint32_t>(__builtin_ctzll(rolls)), the_floor};
    return is_first_in_order(roll, first) ? roll : first;
}

/// Scans the pending events of all spheres and stores which comes first.
template <int G>
[[gnu::noinline]] static void find_next(FewSpheresState& state) {
    SphereColumns& columns = state.columns;
    Eight first[G];
    for (int g = 0; g < G; ++g) first[g] = Eight::load(columns.first + 8 * g);
    Eight minimum = first[0];
    for (int g = 1; g < G; ++g) minimum = smaller(minimum, first[g]);
    const double time = smallest(minimum);
    columns.next = {time, state.size, state.size};
    // Which event comes after the end of the segment does not matter.
    if (!(time < state.segments[state.segment].end)) return;
    std::uint64_t contacts = 0, walls = 0, rolls = 0;
    for (std::uint64_t equal = lanes_equal(first, time); equal != 0; equal &= equal - 1) {
        const int i = __builtin_ctzll(equal);
        contacts |= std::uint64_t{columns.contact[i] == time} << i;
        walls |= std::uint64_t{columns.wall[i] == time} << i;
        rolls |= std::uint64_t{columns.rolls[i] == time} << i;
    }
    columns.next = first_in_order(state, time, contacts, walls, rolls);
}

template <int G>
[[gnu::noinline]] static void predict_all(FewSpheresState& state) {
    for (std::uint32_t i = 0; i < state.size; ++i) copy(state, i);
    for (std::uint32_t i = 0; i < state.size; ++i) {
        predict_contact<G>(state, i);
        predict_wall(state, i);
        update_first(state, i);
    }
    find_next<G>(state);
}

SWIRL_INLINE void remove(SphereColumns& columns, std::uint32_t i) {
    columns.contact[i] = columns.wall[i] = columns.rolls[i] = never;
    set(columns.first, i, never);
}

}  // namespace few_spheres

/// The search for up to 8 G spheres.
template <int G>
struct FewSpheres {
    using State = FewSpheresState;
    using Bodies = Spheres;

    SWIRL_INLINE static void start(FewSpheresState& state) { few_spheres::predict_all<G>(state); }

    SWIRL_INLINE static PendingEvent next(const FewSpheresState& state) {
        return state.columns.next;
    }
    SWIRL_INLINE static void reschedule(FewSpheresState& state, const PendingEvent& event) {
        ++state.invalidated;
        few_spheres::predict_contact<G>(state, event.disc);
        few_spheres::update_first(state, event.disc);
        few_spheres::find_next<G>(state);
    }
    /// Also finds the earliest event of the remaining spheres, before the spheres that now collide
    /// have been predicted. Mostly it is the next event.
    SWIRL_INLINE static PendingEvent remove(FewSpheresState& state, const PendingEvent& event) {
        SphereColumns& columns = state.columns;
        few_spheres::remove(columns, event.disc);
        if (event.partner < state.size && !event.is_with_wall())
            few_spheres::remove(columns, event.partner);
        few_spheres::find_next<G>(state);
        return event;
    }
    template <int D>
    SWIRL_INLINE static void predict_changed(FewSpheresState& state, const std::uint32_t (&ids)[D],
                                             double) {
        double first = never;
        for (int d = 0; d < D; ++d) few_spheres::copy(state, ids[d]);
        for (int d = 0; d < D; ++d) {
            few_spheres::predict_wall(state, ids[d]);
            few_spheres::predict_contact<G>(state, ids[d]);
            first = smaller(first, few_spheres::update_first(state, ids[d]));
        }
        if (first <= state.columns.next.time) few_spheres::find_next<G>(state);
    }
    SWIRL_INLINE static void segment_ended(FewSpheresState& state, double) {
        if (state.segment == 0 || Spheres::change_with_segment(state))
            return few_spheres::predict_all<G>(state);
        for (std::uint32_t i = 0; i < state.size; ++i) {
            few_spheres::predict_wall(state, i);
            few_spheres::update_first(state, i);
        }
        few_spheres::find_next<G>(state);
    }
    static void check(const FewSpheresState& state, double t) { spheres::check(state, t); }
};
static_assert(NeighborSearch<FewSpheres<1>>);

}  // namespace SWIRL_TARGET
}  // namespace swirl
