// The loop: take the event that comes first, execute it, predict again for the discs it changed.
//
// Each disc has one pending event, its earliest (Lubachevsky 1991; Smallenburg 2022). When i and k
// are due to meet, at least one of them, the one that collided last, has seen the other as it is
// now; so the soonest of all meetings is somebody's pending event. One whose partner has collided
// since, its collision counter tells, is invalidated: it is too early rather than too late, and
// when its time comes, its disc is predicted again.
//
// Each disc keeps the state it had after its last collision, at its own time, until the next; no
// prediction and no list touches it.
//
// `Search` is a neighbour search: who may meet whom. It changes the speed, never a bit.
//
//     start(state)                       makes all predictions
//     next(state)                        the pending event that comes first
//     predict_again(state, event)        its disc is predicted anew: the event was invalidated
//     take_out(state, event)             nothing is pending any more for the discs of the first
//                                        event; of several at one instant, says the first in order
//     predict_changed(state, discs, t)   predicts one or two discs that have just collided
//     leg_ended(state, t)                predicts what depends on the container's course anew
//     stretch_ended(state)               renews what it wanted to at EngineState::stretch_end, if
//                                        that is before the leg's end
//     is_outgrown(state)                 whether another search is to take over: this one is still
//                                        right, but no longer fast
//     check(state, t)                    asks what the search promises (invariant.hpp)
//
//     Bodies                             Discs; or Spheres (resolve.hpp): their search has this
//
// Spheres on a floor have a fourth kind of event, which the loop of discs does not ask about: one
// begins to roll.
//
// Included by one file per vector width, and compiled with that width's instructions. So that the
// linker cannot mix them up, nothing in here may leave a symbol of its own: functions are inlined
// or static, and a test looks at the objects.
#pragma once

#include "swirl/engine/neighbors/engine_state.hpp"
#include "swirl/engine/neighbors/engine_state_checks.hpp"
#include "swirl/engine/neighbors/wall_times.hpp"
#include "swirl/engine/pending_event.hpp"
#include "swirl/engine/resolve.hpp"

namespace swirl {
inline namespace SWIRL_TARGET {

template <class Search>
struct BodiesOf {
    using Type = Discs;
};
template <class Search>
requires requires { typename Search::Bodies; }
struct BodiesOf<Search> {
    using Type = typename Search::Bodies;
};
template <class Search>
using Bodies = typename BodiesOf<Search>::Type;

template <class Search>
SWIRL_INLINE bool is_of_floor(const PendingEvent& event) {
    return Bodies<Search>::have_floor && event.partner == the_floor;
}

/// The next event that happens.
template <class Search>
SWIRL_INLINE PendingEvent next_event(EngineState& state) {
    for (;;) {
        const PendingEvent next = Search::next(state);
        if (next.time >= state.stretch_end) [[unlikely]] {
            const double end = state.segments[state.segment].end;
            if (state.stretch_end >= end) return {end, state.size, state.size};
            if constexpr (requires { Search::segment_ended(state); }) Search::segment_ended(state);
            continue;
        }
        if (is_of_floor<Search>(next) || state.is_valid(next)) return next;
        Search::reschedule(state, next);
    }
}

/// In the build that checks invariants, and only there.
template <class Search>
SWIRL_INLINE void check(const EngineState& state, const PendingEvent& next) {
    if constexpr (internal_checks && Bodies<Search>::have_floor) {
        promise::time_never_goes_back(next.time >= state.clock);
        if (is_time_to_check(state)) Search::check(state, next.time);
    } else if constexpr (internal_checks) {
        check_order(state, next);
        if (!is_time_to_check(state)) return;
        check_discs(state, next.time);
        Search::check(state, next.time);
    }
}

/// What is to be known of the leg before anybody predicts.
SWIRL_INLINE void begin_segment(EngineState& state) {
    state.stretch_end = state.segments[state.segment].end;
    state.turning_centre.time = -never;
    if (state.on_turning_segment()) renew_turning_bound(state, state.clock);
}

/// Not inlined: the collisions, which are most events, have the registers to themselves.
template <class Search>
[[gnu::noinline]] static Event end_segment(EngineState& state) {
    const Event event = start_next_segment<Bodies<Search>>(state);
    begin_segment(state);
    Search::segment_ended(state, event.clock);
    return event;
}

template <class Search>
SWIRL_INLINE Event execute(EngineState& state, const PendingEvent& next) {
    if (next.disc == state.size) {
        check<Search>(state, next);
        return end_segment<Search>(state);
    }
    const PendingEvent due = Search::remove(state, next);
    check<Search>(state, due);
    state.clock = due.time;
    if constexpr (Bodies<Search>::have_floor) {
        if (is_of_floor<Search>(due)) {
            const Event event = Bodies<Search>::begin_to_roll(state, due.disc, due.time);
            Search::predict_changed(state, {due.disc}, due.time);
            return event;
        }
    }
    if (due.is_with_wall()) {
        const Event event = collide_with_wall<Bodies<Search>>(state, due.disc, due.time);
        Search::predict_changed(state, {due.disc}, due.time);
        return event;
    }
    const Event event = collide_discs<Bodies<Search>>(state, due.first(), due.second(), due.time);
    Search::predict_changed(state, {due.first(), due.second()}, due.time);
    return event;
}

template <class Search>
static void start(EngineState& state) {
    if constexpr (internal_checks)
        state.overlapped_at_start = !all_discs_are_apart(state, state.clock);
    begin_segment(state);
    Search::start(state);
}

template <class Search>
static Event step(EngineState& state) {
    return execute<Search>(state, next_event<Search>(state));
}

/// As many events as asked for, or as come up to (swirls, clock], or until the search is outgrown;
/// says how many.
template <class Search>
static std::uint64_t run(EngineState& state, std::uint64_t count, std::int64_t periods,
                         double clock) {
    for (std::uint64_t done = 0; done < count; ++done) {
        const PendingEvent next = next_event<Search>(state);
        if (state.periods > periods || (state.periods == periods && next.time > clock)) return done;
        execute<Search>(state, next);
        if constexpr (requires { Search::should_switch_search(state); })
            if (Search::should_switch_search(state)) [[unlikely]]
                return done + 1;
    }
    return count;
}

template <class Search>
constexpr EventLoop event_loop(const char* width) {
    return {width, start<Search>, step<Search>, run<Search>};
}

}  // namespace SWIRL_TARGET
}  // namespace swirl
