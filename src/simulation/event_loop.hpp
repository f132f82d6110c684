// The loop: take the event that comes first, execute it, predict again for those it changed.
//
// Each disc has one pending event, its earliest (Lubachevsky 1991; Smallenburg 2022). When i and k
// are due to meet, at least one of them, the one that changed last, has seen the other as it is
// now; so the soonest of all meetings is on somebody's card. A card whose partner has changed
// since, `changes` tells, is too early rather than too late: when its time comes, its owner
// predicts again.
//
// Each disc keeps the state it had after its last collision, at its own time, until the next; no
// prediction and no list touches it.
//
// Included by one file per vector width, and compiled with that width's instructions. So that the
// linker cannot mix them up, nothing in here may leave a symbol of its own: functions are inlined
// or static, and a test looks at the objects.
#pragma once

#include "swirl/simulation/resolve.hpp"
#include "swirl/simulation/search/state.hpp"
#include "swirl/simulation/search/tournament.hpp"

namespace swirl {
inline namespace SWIRL_TARGET {

/// Whether the disc's card is an event that happens.
SWIRL_INLINE bool is_due(const EngineState& state, const ColdDisc& pending) {
    return pending.partner < state.size &&
           state.discs[pending.partner].collisions == pending.partner_collisions;
}

/// Writes a new card for a disc whose card is no event.
template <class Search>
SWIRL_INLINE void renew_card(EngineState& state, const Next& next) {
    const bool leaves = state.cold(next.disc).partner >= leaves_skin;
    take_out(state, next.disc);
    if (leaves) {
        Search::renew_place(state, next.disc, next.time);
    } else {
        ++state.invalidated;
        Search::predict(state, next.disc, next.time);
    }
}

/// Brings the cards in order until the first one is an event that happens, and says when.
template <class Search>
SWIRL_INLINE Next next_event(EngineState& state) {
    for (;;) {
        const Next next = next_pending(state);
        if (next.time >= state.legs[state.leg].end) return {state.legs[state.leg].end, state.size};
        if (is_due(state, state.cold(next.disc))) return next;
        renew_card<Search>(state, next);
    }
}

SWIRL_INLINE void take_out_both(EngineState& state, std::uint32_t disc, std::uint32_t partner) {
    if (partner != disc) take_out(state, partner);
    take_out(state, disc);
}

/// If several events come at the same instant: their first, in order. The discs of the one that was
/// found have been taken out and are put back; those of the first are taken out.
template <class Search>
[[gnu::noinline]] static Next first_of_simultaneous(EngineState& state, const Next& found,
                                                    double partner_pending) {
    put_in(state, state.cold(found.disc).partner, partner_pending);
    put_in(state, found.disc, found.time);
    for (;;) {
        const Next next{found.time,
                        first_of_equals(state, found.time, state.levels - 1, 0, state.size)};
        if (is_due(state, state.cold(next.disc))) {
            take_out_both(state, next.disc, state.cold(next.disc).partner);
            return next;
        }
        renew_card<Search>(state, next);
    }
}

/// Takes the discs of an event out of the queue.
template <class Search>
SWIRL_INLINE Next take_event(EngineState& state, const Next& next) {
    const std::uint32_t partner = state.cold(next.disc).partner;
    const double partner_pending = pending_time(state, partner);
    take_out_both(state, next.disc, partner);
    if (next_pending(state).time == next.time) [[unlikely]]
        return first_of_simultaneous<Search>(state, next, partner_pending);
    return next;
}

template <class Search>
SWIRL_INLINE Event execute(EngineState& state, const Next& due) {
    if (due.disc == state.size) return Search::end_leg(state);
    state.clock = due.time;
    const Next next = take_event<Search>(state, due);
    const std::uint32_t partner = state.cold(next.disc).partner;
    if (partner == next.disc) {
        const Event event = collide_with_wall(state, partner, next.time);
        Search::template predict_changed<1>(state, {partner}, next.time);
        return event;
    }
    if (state.prefetches) prefetch_neighbours(state, partner);
    const std::uint32_t i = next.disc < partner ? next.disc : partner;
    const std::uint32_t j = next.disc < partner ? partner : next.disc;
    const Event event = collide_discs(state, i, j, next.time);
    Search::template predict_changed<2>(state, {i, j}, next.time);
    return event;
}

template <class Search>
static Event step(EngineState& state) {
    return execute<Search>(state, next_event<Search>(state));
}

template <class Search>
static std::uint64_t run(EngineState& state, std::uint64_t count, std::int64_t swirls,
                         double clock) {
    for (std::uint64_t done = 0; done < count; ++done) {
        const Next next = next_event<Search>(state);
        if (state.swirls > swirls || (state.swirls == swirls && next.time > clock)) return done;
        execute<Search>(state, next);
    }
    return count;
}

/// `Search` says who may meet whom: Lists (verlet_lists.hpp) or Cells (linked_cells.hpp).
template <class Search>
constexpr EventLoop event_loop(const char* width, void (*start)(EngineState&)) {
    return {width, start, step<Search>, run<Search>};
}

}  // namespace SWIRL_TARGET
}  // namespace swirl
