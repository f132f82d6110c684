// Speed only; results stay bitwise identical. The search with Verlet lists (verlet_skin.hpp), for
// clusters and everything else that is as dense.
#pragma once

#include "swirl/engine/neighbors/comoving_frame.hpp"
#include "swirl/engine/neighbors/engine_state_checks.hpp"
#include "swirl/engine/neighbors/event_queue.hpp"
#include "swirl/engine/neighbors/lists_or_cells.hpp"
#include "swirl/engine/neighbors/neighbor_search.hpp"
#include "swirl/engine/neighbors/prediction.hpp"
#include "swirl/engine/neighbors/renewed_leaving.hpp"
#include "swirl/engine/neighbors/search_states.hpp"
#include "swirl/engine/neighbors/verlet_skin.hpp"
#include "swirl/engine/neighbors/wall_times.hpp"
#include "swirl/engine/pending_event.hpp"
#include "swirl/engine/resolve.hpp"
#include "swirl/math/lanes.hpp"

namespace swirl {
inline namespace SWIRL_TARGET {
namespace lists {

/// The tail of a long list, which is stored apart from it.
[[gnu::noinline]] static PendingEvent earliest_in_tail(const VerletListsState& state,
                                                       PendingEvent first, double t) {
    if (state.tails == nullptr) return first;
    const HotDisc& disc = state.discs[first.disc];
    const ListTail& tail = state.tail(first.disc);
    for (std::uint32_t k = 0; k < tail.length; k += 8) {
        const std::uint32_t* const list = tail.neighbours() + k;
        const Others<8> others = load_others<8>(state, list);
        first = earlier<8>(list, contact_times<StateAge::any>(disc, others, t), first);
    }
    return first;
}

/// The part of a list beyond the first vector.
SWIRL_INLINE PendingEvent earliest_beyond_eight(const VerletListsState& state, PendingEvent first,
                                                double t) {
    const HotDisc& disc = state.discs[first.disc];
    const std::uint32_t* const list = state.cold(first.disc).neighbours();
    const std::uint32_t length = disc.list_length;
    for (std::uint32_t k = 8; k < length; k += 4) {
        const Others<4> others = load_others<4>(state, list + k);
        first = earlier<4>(list + k, contact_times<StateAge::any>(disc, others, t), first);
    }
    if (length == state.list_capacity) [[unlikely]]
        return earliest_in_tail(state, first, t);
    return first;
}

template <int D>
SWIRL_INLINE bool all_far(const VerletListsState& state, const std::uint32_t (&ids)[D]) {
    return state.discs[ids[0]].far_from_wall != 0 && state.discs[ids[D - 1]].far_from_wall != 0;
}

/// Predicts the next events of D discs at time t. Each step is done for all discs before the next
/// step, so that the processor works on one disc while it waits for the data of the other.
template <StateAge age, int D>
[[gnu::noinline]] static void predict(VerletListsState& state, const std::uint32_t (&ids)[D],
                                      double t) {
    Others<8> others[D];
    Lanes<8> contacts[D];
    Leaving leaving[D];
    for (int d = 0; d < D; ++d) others[d] = load_others<8>(state, state.cold(ids[d]).neighbours());
    for (int d = 0; d < D; ++d) contacts[d] = contact_times<age>(state.discs[ids[d]], others[d], t);
    const bool on_arc = state.on_arc();
    if (on_arc && !all_far<D>(state, ids)) [[unlikely]]
        find_leaving_on_arc<D>(state, ids, t, leaving);
    else
        find_leaving<age, D>(state, ids, t, leaving);
#pragma GCC unroll 2
    for (int d = 0; d < D; ++d) {
        PendingEvent contact =
            first_contact<8>(state.cold(ids[d]).neighbours(), contacts[d], ids[d]);
        if (state.discs[ids[d]].list_length > 8) contact = earliest_beyond_eight(state, contact, t);
        if (on_arc) [[unlikely]]
            approach_wall(state, ids[d], t, smaller(contact.time, leaving[d].skin), leaving[d]);
        insert(state, first_of(contact, leaving[d]));
    }
}

[[gnu::noinline]] static void predict_all(VerletListsState& state, double t) {
    clear_queue(state);
    for (std::uint32_t i = 0; i < state.size; ++i) {
        if (state.stops_at(i)) return;
        predict<StateAge::any, 1>(state, {i}, t);
    }
}

SWIRL_INLINE SkinRadiusRange skin_radius_range(const VerletListsState& state) {
    return {0.005 * state.smallest_radius, state.largest_skin_radius};
}

/// Rebuilds all lists with a very small skin radius. Such a list holds only discs that almost
/// touch, and its capacity is sufficient for these. Each skin widens when its disc next leaves it.
/// The radius exceeds the rounding of the centre to single precision. Otherwise a disc might be
/// outside its new skin at once, get another one, and so on without end.
static void rebuild_all_narrow(VerletListsState& state, double t) {
    SkinRadiusRange narrow = skin_radius_range(state);
    const double rounding = rounding_of_centre * state.container_radius;
    narrow.largest = larger(0.02 * state.smallest_radius, 2.0 * rounding);
    narrow.minimum = larger(0.001 * state.smallest_radius, rounding);
    rebuild_all_lists(state, t, 0.0, narrow);
}

/// Begins a new co-moving frame within a segment, after the discs have left the old one.
[[gnu::noinline]] static void begin_new_frame(VerletListsState& state, double t) {
    ++state.full_rebuilds;
    begin_comoving_frame(state, t);
    rebuild_all_narrow(state, t);
    predict_all(state, t);
}

/// When lists took over from cells: tests whether cells should take over again, each time that
/// every list has been rebuilt once on average.
SWIRL_INLINE void test_whether_lists_last(VerletListsState& state) {
    if (rebuilds_since_test(state) < state.size) return;
    if (lists_do_not_last(state)) {
        if (state.failed_lists < max_failures_counted) ++state.failed_lists;
        state.should_switch_search = true;
    }
    begin_test(state);
}

/// Disc i, which has no pending event, gets a new skin and list.
[[gnu::noinline]] static void rebuild_list(VerletListsState& state, std::uint32_t i, double t) {
    ++state.list_rebuilds;
    if (state.chooses_search) test_whether_lists_last(state);
    if (++state.rebuilds_in_frame > 8 * static_cast<std::uint64_t>(state.size)) [[unlikely]] {
        state.rebuilds_in_frame = 0;
        if (frame_is_left_behind(state, t)) return begin_new_frame(state, t);
    }
    const double before = recentre_skin(state, i, t);
    if (build_list(state, i, t, before, skin_radius_range(state))) {
        // With a fast container, discs get far from the frame's origin, where single precision
        // is coarse.
        if (is_lost_in_rounding(state.skins[i])) [[unlikely]]
            return begin_new_frame(state, t);
        predict<StateAge::any, 1>(state, {i}, t);
        return;
    }
    ++state.overflows;
    const std::uint32_t count = resolve_overflow(state, i, t, skin_radius_range(state));
    const std::uint32_t* const rebuilt = state.candidates.rebuilt;
    for (std::uint32_t k = 0; k < count; ++k) {
        remove(state, rebuilt[k]);
        predict<StateAge::any, 1>(state, {rebuilt[k]}, t);
    }
    if (count == 0) begin_new_frame(state, t);
}

[[gnu::noinline]] static void start(VerletListsState& state) {
    begin_test(state);
    begin_comoving_frame(state, state.clock);
    const double usual = 0.2 * state.smallest_radius;
    if (!rebuild_all_lists(state, state.clock, usual, skin_radius_range(state)))
        rebuild_all_narrow(state, state.clock);
    predict_all(state, state.clock);
}

/// Eight skins as struct of arrays.
struct Skins {
    Flight<Lanes<8>> flight;
    Lanes<8> radius;
};
/// Loads the skins of `count` discs starting at `begin`; unused lanes repeat the first disc.
SWIRL_INLINE Skins load_skins(const VerletListsState& state, std::uint32_t begin,
                              std::uint32_t count) {
    const float* rows[8];
    for (std::uint32_t k = 0; k < 8; ++k) rows[k] = &state.skins[begin + (k < count ? k : 0)].X;
    BasicVec2<Lanes<8>> Z;
    Lanes<8> radius;
    load_three(rows, Z.x, Z.y, radius);
    return {state.comoving_frame.flight_of(Z), radius};
}

/// Predicts wall and skin again for the eight discs from `begin` on. All of them hold states from
/// before time t, when a segment or an interval begins.
SWIRL_INLINE void renew_eight(VerletListsState& state, std::uint32_t begin, double t) {
    const std::uint32_t count = state.size - begin < 8 ? state.size - begin : 8;
    std::uint32_t ids[8];
    for (std::uint32_t k = 0; k < 8; ++k) ids[k] = k < count ? begin + k : state.size;
    using Eight = Lanes<8>;
    const Others<8> discs = load_others<8>(state, ids);
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

/// Predicts the wall again for the eight discs from `begin` on, in the unchanged frame. A disc that
/// was far from the wall and still is has no event that could have changed.
SWIRL_INLINE void renew_walls_of_eight(VerletListsState& state, std::uint32_t begin,
                                       const WallReach& reach, double t) {
    using Eight = Lanes<8>;
    const std::uint32_t count = state.size - begin < 8 ? state.size - begin : 8;
    std::uint32_t ids[8];
    alignas(64) double beyond[8], wall[8];
    const double* radii[8];
    unsigned were_far = 0;
    for (std::uint32_t k = 0; k < 8; ++k) {
        ids[k] = k < count ? begin + k : state.size;
        radii[k] = &state.discs[ids[k]].time;
        were_far |= static_cast<unsigned>(state.discs[ids[k]].far_from_wall) << k;
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
    const Others<8> discs = load_others<8>(state, ids);
    soonest_wall_times<8>(state, discs.flight, discs.radius, t).store(wall);
    for (; near != 0; near &= near - 1) {
        const auto k = static_cast<std::uint32_t>(__builtin_ctz(near));
        const unsigned is_far = far >> k & 1u;
        state.discs[begin + k].far_from_wall = is_far & 1u;
        renew_leaving(state, begin + k, t, {wall[k] + far_wait[is_far], never}, false);
    }
}

/// At a path vertex, only what depends on the container's motion is predicted again.
static void renew_all_leaving(VerletListsState& state, double t) {
    begin_interval(state, t);
    if (renew_frame_if_left(state, t)) {
        for (std::uint32_t i = 0; i < state.size; i += 8) renew_eight(state, i, t);
        return;
    }
    const WallReach reach = reach_far_from_wall(state, t);
    for (std::uint32_t i = 0; i < state.size; i += 8) renew_walls_of_eight(state, i, reach, t);
}

/// At the end of a period, at time t, the discs' clocks have restarted, and the frame's clock does
/// too. If the frame's origin is more than a cell away from the container, or the frame has
/// stretched the cells, a new frame begins.
static void renew_all(VerletListsState& state, double t) {
    ComovingFrame& frame = state.comoving_frame;
    const Vec2 drift = frame.origin.position_at(t) - state.segments[0].start;
    const bool gone = square_root(dot(drift, drift)) * state.grids[0].cells_per_length > 1.0;
    if ((!state.has_no_grid && gone) || frame.scale > max_stretch_at_period_end) {
        begin_comoving_frame(state, 0.0);
        rebuild_all_narrow(state, 0.0);
    } else {
        frame.origin.time -= t;
        begin_interval(state, 0.0);
        renew_comoving_frame(state, motion_in_frame(state, 0.0), 0.0);
        for (std::uint32_t i = 0; i < state.size; ++i) update_far_from_wall(state, i, 0.0);
    }
    predict_all(state, 0.0);
}

SWIRL_INLINE void segment_ended(VerletListsState& state, double t) {
    if (state.segment == 0) return renew_all(state, t);
    renew_all_leaving(state, t);
}

/// An interval ends within an arc: the discs have turned with the container, and the frame follows.
[[gnu::noinline]] static void interval_ended(VerletListsState& state) {
    renew_all_leaving(state, state.interval_end);
}

}  // namespace lists

struct VerletLists {
    using State = VerletListsState;
    using Bodies = Discs;

    SWIRL_INLINE static void start(VerletListsState& state) { lists::start(state); }
    SWIRL_INLINE static PendingEvent next(const VerletListsState& state) {
        return next_pending(state);
    }
    SWIRL_INLINE static void reschedule(VerletListsState& state, const PendingEvent& event) {
        swirl::remove(state, event.disc);
        if (event.partner == leaves_skin) {
            lists::rebuild_list(state, event.disc, event.time);
        } else {
            ++state.invalidated;
            lists::predict<StateAge::any, 1>(state, {event.disc}, event.time);
        }
    }
    SWIRL_INLINE static PendingEvent remove(VerletListsState& state, const PendingEvent& event) {
        return remove_first<VerletLists>(state, event);
    }
    template <int D>
    SWIRL_INLINE static void predict_changed(VerletListsState& state, const std::uint32_t (&ids)[D],
                                             double t) {
        lists::predict<StateAge::now, D>(state, ids, t);
    }
    SWIRL_INLINE static void check(const VerletListsState& state, double t) {
        check_lists(state, t);
        check_tournament(state);
    }
    SWIRL_INLINE static bool should_switch_search(const VerletListsState& state) {
        return state.should_switch_search;
    }
    SWIRL_INLINE static void segment_ended(VerletListsState& state, double t) {
        lists::segment_ended(state, t);
    }
    SWIRL_INLINE static void interval_ended(VerletListsState& state) {
        lists::interval_ended(state);
    }
};
static_assert(NeighborSearch<VerletLists> && RenewsWithinSegment<VerletLists> &&
              CanAskToBeReplaced<VerletLists>);

}  // namespace SWIRL_TARGET
}  // namespace swirl
