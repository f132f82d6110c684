// Speed only, changes no bit: the search through neighbour lists (verlet_skin.hpp). For the pack,
// and whatever is as dense.
//
// Included by one file per vector width, like event_loop.hpp, and under the same rule.
#pragma once

#include "swirl/engine/neighbors/comoving_frame.hpp"
#include "swirl/engine/neighbors/engine_state.hpp"
#include "swirl/engine/neighbors/engine_state_checks.hpp"
#include "swirl/engine/neighbors/lists_or_cells.hpp"
#include "swirl/engine/neighbors/prediction.hpp"
#include "swirl/engine/neighbors/renewed_leaving.hpp"
#include "swirl/engine/neighbors/tournament.hpp"
#include "swirl/engine/neighbors/verlet_skin.hpp"
#include "swirl/engine/neighbors/wall_times.hpp"
#include "swirl/engine/pending_event.hpp"
#include "swirl/math/lanes.hpp"

namespace swirl {
inline namespace SWIRL_TARGET {
namespace lists {

/// The end of a long list, which is kept apart from it.
[[gnu::noinline]] static PendingEvent earliest_in_tail(const EngineState& state, PendingEvent first,
                                                       double t) {
    if (state.tails == nullptr) return first;
    const HotDisc& disc = state.discs[first.disc];
    const ListTail& tail = state.tail(first.disc);
    for (std::uint32_t k = 0; k < tail.length; k += 8) {
        const std::uint32_t* const list = tail.neighbours() + k;
        const Others<8> others = load_others<8>(state, list);
        first = earlier<8>(list, contact_times<Held::for_a_while>(disc, others, t), first);
    }
    return first;
}

/// The rest of a list that is longer than one vector.
SWIRL_INLINE PendingEvent earliest_beyond_eight(const EngineState& state, PendingEvent first,
                                                double t) {
    const HotDisc& disc = state.discs[first.disc];
    const std::uint32_t* const list = state.cold(first.disc).neighbours();
    const std::uint32_t length = disc.neighbours;
    for (std::uint32_t k = 8; k < length; k += 4) {
        const Others<4> others = load_others<4>(state, list + k);
        first = earlier<4>(list + k, contact_times<Held::for_a_while>(disc, others, t), first);
    }
    if (length == state.capacity) [[unlikely]]
        return earliest_in_tail(state, first, t);
    return first;
}

template <int D>
SWIRL_INLINE bool all_far(const EngineState& state, const std::uint32_t (&who)[D]) {
    return state.discs[who[0]].far_from_wall != 0 && state.discs[who[D - 1]].far_from_wall != 0;
}

/// Everything that may happen to D discs, asked at time t; one step at a time for all of them, so
/// that the processor works on one while it waits for the other.
template <Held held, int D>
[[gnu::noinline]] static void predict(EngineState& state, const std::uint32_t (&who)[D], double t) {
    Others<8> others[D];
    Lanes<8> contacts[D];
    Leaving leaving[D];
    for (int d = 0; d < D; ++d) others[d] = load_others<8>(state, state.cold(who[d]).neighbours());
    for (int d = 0; d < D; ++d)
        contacts[d] = contact_times<held>(state.discs[who[d]], others[d], t);
    const bool turning = state.on_turning_segment();
    if (turning && !all_far<D>(state, who)) [[unlikely]]
        find_leaving_on_turn<D>(state, who, t, leaving);
    else
        find_leaving<held, D>(state, who, t, leaving);
#pragma GCC unroll 2
    for (int d = 0; d < D; ++d) {
        PendingEvent meeting =
            first_meeting<8>(state.cold(who[d]).neighbours(), contacts[d], who[d]);
        if (state.discs[who[d]].neighbours > 8) meeting = earliest_beyond_eight(state, meeting, t);
        if (turning) [[unlikely]]
            approach_wall(state, who[d], t, smaller(meeting.time, leaving[d].skin), leaving[d]);
        insert(state, first_of(meeting, leaving[d]));
    }
}

[[gnu::noinline]] static void predict_all(EngineState& state, double t) {
    empty_queue(state);
    for (std::uint32_t i = 0; i < state.size; ++i) {
        if (state.stops_at(i)) return;
        predict<Held::for_a_while, 1>(state, {i}, t);
    }
}

SWIRL_INLINE SkinRadiusRange skin_radius_range(const EngineState& state) {
    return {0.005 * state.smallest_radius, state.largest_skin_radius};
}

/// With a skin radius this small a list holds only discs that all but touch, for which its capacity
/// is made; each widens again when its disc next leaves. Not so small that the centre, rounded to
/// single precision, may leave the disc outside: it would get a new skin for ever and never move.
static void rebuild_all_narrow(EngineState& state, double t) {
    SkinRadiusRange narrow = skin_radius_range(state);
    const double rounding = rounding_of_centre * state.container_radius;
    narrow.largest = larger(0.02 * state.smallest_radius, 2.0 * rounding);
    narrow.minimum = larger(0.001 * state.smallest_radius, rounding);
    rebuild_all_lists(state, t, 0.0, narrow);
}

/// A new frame, in which the discs rest, in the middle of the leg.
[[gnu::noinline]] static void follow_the_discs(EngineState& state, double t) {
    ++state.full_rebuilds;
    begin_comoving_frame(state, t);
    rebuild_all_narrow(state, t);
    predict_all(state, t);
}

/// Of lists that took over from cells: whether these are to come back. Asked when all lists have
/// been rebuilt once, on average.
SWIRL_INLINE void ask_whether_lists_last(EngineState& state) {
    if (rebuilds_since_asked(state) < state.size) return;
    if (rebuilds_since_asked(state) > bearable_rebuilds * collisions_since_asked(state)) {
        if (state.returns_to_cells < max_returns_counted) ++state.returns_to_cells;
        state.should_switch_search = true;
    }
    begin_to_count(state);
}

/// Disc i, which has no event pending, gets a new skin and list.
[[gnu::noinline]] static void rebuild_list(EngineState& state, std::uint32_t i, double t) {
    ++state.list_rebuilds;
    if (state.chooses_search) ask_whether_lists_last(state);
    if (++state.rebuilds_in_frame > 8 * static_cast<std::uint64_t>(state.size)) [[unlikely]] {
        state.rebuilds_in_frame = 0;
        if (frame_is_left_behind(state, t)) return follow_the_discs(state, t);
    }
    const double before = recentre_skin(state, i, t);
    if (build_list(state, i, t, before, skin_radius_range(state))) {
        // In a fast dish discs get far from where the frame began, and singles are coarse there.
        if (is_lost_in_rounding(state.skins[i])) [[unlikely]]
            return follow_the_discs(state, t);
        predict<Held::for_a_while, 1>(state, {i}, t);
        return;
    }
    ++state.overflows;
    const std::uint32_t count = resolve_overflow(state, i, t, skin_radius_range(state));
    const std::uint32_t* const rebuilt = state.candidates.rebuilt;
    for (std::uint32_t k = 0; k < count; ++k) {
        remove(state, rebuilt[k]);
        predict<Held::for_a_while, 1>(state, {rebuilt[k]}, t);
    }
    if (count == 0) follow_the_discs(state, t);
}

[[gnu::noinline]] static void start(EngineState& state) {
    begin_to_count(state);
    begin_comoving_frame(state, state.clock);
    const double usual = 0.2 * state.smallest_radius;
    if (!rebuild_all_lists(state, state.clock, usual, skin_radius_range(state)))
        rebuild_all_narrow(state, state.clock);
    predict_all(state, state.clock);
}

/// Eight skins side by side.
struct Skins {
    Flight<Lanes<8>> flight;
    Lanes<8> radius;
};
/// Those of `count` discs from `begin` on; of the first, where there are no more.
SWIRL_INLINE Skins load_skins(const EngineState& state, std::uint32_t begin, std::uint32_t count) {
    const float* rows[8];
    for (std::uint32_t k = 0; k < 8; ++k) rows[k] = &state.skins[begin + (k < count ? k : 0)].X;
    BasicVec2<Lanes<8>> Z;
    Lanes<8> radius;
    load_three(rows, Z.x, Z.y, radius);
    return {state.comoving_frame.flight_of(Z), radius};
}

/// Wall and skin of the eight discs from `begin` on; all of them hold states from before time t,
/// when the leg begins, or a stretch of it.
SWIRL_INLINE void renew_eight(EngineState& state, std::uint32_t begin, double t) {
    const std::uint32_t count = state.size - begin < 8 ? state.size - begin : 8;
    std::uint32_t who[8];
    for (std::uint32_t k = 0; k < 8; ++k) who[k] = k < count ? begin + k : state.size;
    using Eight = Lanes<8>;
    const Others<8> discs = load_others<8>(state, who);
    const Skins skins = load_skins(state, begin, count);
    const BasicVec2<Eight> centre = skins.flight.position_at(Eight(t));
    const BasicVec2<Eight> offset = discs.flight.position_at(Eight(t)) - centre;
    const BasicVec2<Eight> drift = discs.flight.velocity - skins.flight.velocity;
    alignas(64) double wall[8], skin[8], beyond[8];
    soonest_wall_times<8>(state, discs.flight, discs.radius, t).store(wall);
    (Eight(t) + time_to_leave(offset, drift, inner_skin_radius(skins.radius))).store(skin);
    const WallReach reach = reach_far_from_wall(state, t);
    const BasicVec2<Eight> s = centre - in_lanes<8>(state.segments[state.segment].position_at(t));
    beyond_reach(Eight(reach.reach), Eight(reach.growth) * s, skins.radius, discs.radius)
        .store(beyond);
    const unsigned far = lanes_below(beyond, 0.0);
    for (std::uint32_t k = 0; k < count; ++k) {
        const unsigned is_far = far >> k & 1u;
        state.discs[begin + k].far_from_wall = is_far & 1u;
        renew_leaving(state, begin + k, t, {wall[k] + far_wait[is_far], skin[k]});
    }
}

/// In the old frame, for the eight discs from `begin` on: the wall alone. Who was far from it and
/// still is has no event that could have changed.
SWIRL_INLINE void renew_walls_of_eight(EngineState& state, std::uint32_t begin,
                                       const WallReach& reach, double t) {
    using Eight = Lanes<8>;
    const std::uint32_t count = state.size - begin < 8 ? state.size - begin : 8;
    std::uint32_t who[8];
    alignas(64) double beyond[8], wall[8];
    const double* radii[8];
    unsigned were_far = 0;
    for (std::uint32_t k = 0; k < 8; ++k) {
        who[k] = k < count ? begin + k : state.size;
        radii[k] = &state.discs[who[k]].time;
        were_far |= static_cast<unsigned>(state.discs[who[k]].far_from_wall) << k;
    }
    Eight times, radius;
    load_pairs<8>(radii, times, radius);
    const Skins skins = load_skins(state, begin, count);
    const BasicVec2<Eight> s = skins.flight.position_at(Eight(t)) -
                               in_lanes<8>(state.segments[state.segment].position_at(t));
    beyond_reach(Eight(reach.reach), Eight(reach.growth) * s, skins.radius, radius).store(beyond);
    const unsigned far = lanes_below(beyond, 0.0);
    unsigned near = ~(far & were_far) & ((1u << count) - 1u);
    if (near == 0) return;
    const Others<8> discs = load_others<8>(state, who);
    soonest_wall_times<8>(state, discs.flight, discs.radius, t).store(wall);
    for (; near != 0; near &= near - 1) {
        const auto k = static_cast<std::uint32_t>(__builtin_ctz(near));
        const unsigned is_far = far >> k & 1u;
        state.discs[begin + k].far_from_wall = is_far & 1u;
        renew_leaving(state, begin + k, t, {wall[k] + far_wait[is_far], never}, false);
    }
}

/// At a corner of the path only what depends on the container's motion is predicted anew.
static void renew_all_leaving(EngineState& state, double t) {
    begin_stretch(state, t);
    if (renew_frame_if_left(state, t)) {
        for (std::uint32_t i = 0; i < state.size; i += 8) renew_eight(state, i, t);
        return;
    }
    const WallReach reach = reach_far_from_wall(state, t);
    for (std::uint32_t i = 0; i < state.size; i += 8) renew_walls_of_eight(state, i, reach, t);
}

/// At the end of the swirl, at time t, the discs' clocks have restarted, and so does the frame's.
/// Its origin is brought back to the container when it has moved away by more than a cell, and its
/// cells to their size when they have grown.
static void renew_all(EngineState& state, double t) {
    ComovingFrame& frame = state.comoving_frame;
    const Vec2 drift = frame.origin.position_at(t) - state.segments[0].start;
    const bool gone = square_root(dot(drift, drift)) * state.grids[0].cells_per_length > 1.0;
    if ((!state.has_no_grid && gone) || frame.scale > bearable_stretch) {
        begin_comoving_frame(state, 0.0);
        rebuild_all_narrow(state, 0.0);
    } else {
        frame.origin.time -= t;
        begin_stretch(state, 0.0);
        renew_comoving_frame(state, motion_in_frame(state, 0.0), 0.0);
        for (std::uint32_t i = 0; i < state.size; ++i) note_far_from_wall(state, i, 0.0);
    }
    predict_all(state, 0.0);
}

SWIRL_INLINE void segment_ended(EngineState& state, double t) {
    if (state.segment == 0) return renew_all(state, t);
    renew_all_leaving(state, t);
}

/// Of a turning leg: the discs have turned with the container, and so does the frame.
[[gnu::noinline]] static void segment_ended(EngineState& state) {
    renew_all_leaving(state, state.stretch_end);
}

}  // namespace lists

struct VerletLists {
    SWIRL_INLINE static void start(EngineState& state) { lists::start(state); }
    SWIRL_INLINE static PendingEvent next(const EngineState& state) { return next_pending(state); }
    SWIRL_INLINE static void reschedule(EngineState& state, const PendingEvent& event) {
        swirl::remove(state, event.disc);
        if (event.partner == leaves_skin) {
            lists::rebuild_list(state, event.disc, event.time);
        } else {
            ++state.invalidated;
            lists::predict<Held::for_a_while, 1>(state, {event.disc}, event.time);
        }
    }
    SWIRL_INLINE static PendingEvent remove(EngineState& state, const PendingEvent& event) {
        return take_first<VerletLists>(state, event);
    }
    template <int D>
    SWIRL_INLINE static void predict_changed(EngineState& state, const std::uint32_t (&who)[D],
                                             double t) {
        lists::predict<Held::since_now, D>(state, who, t);
    }
    SWIRL_INLINE static void check(const EngineState& state, double t) {
        check_lists(state, t);
        check_tournament(state);
    }
    SWIRL_INLINE static bool should_switch_search(const EngineState& state) {
        return state.should_switch_search;
    }
    SWIRL_INLINE static void segment_ended(EngineState& state, double t) {
        lists::segment_ended(state, t);
    }
    SWIRL_INLINE static void segment_ended(EngineState& state) { lists::segment_ended(state); }
};

}  // namespace SWIRL_TARGET
}  // namespace swirl
