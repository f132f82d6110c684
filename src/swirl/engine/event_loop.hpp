// The event loop: take the pending event that comes first, execute it, and predict the next events
// of the discs it changed.
//
// Each disc has one pending event, its earliest (Lubachevsky 1991; Smallenburg 2022). If discs i
// and k will collide, at least one of them has predicted that with the other's current state: the
// one that collided last. So the earliest of all collisions is the pending event of some disc.
//
// An *invalidated event* is a pending event whose partner has collided since the prediction. The
// partner's collision counter shows that. The event does not happen as predicted, but it is never
// too late: nothing else can happen to the disc before. When its time comes, the disc is predicted
// again.
//
// Each disc keeps the state it had after its last collision, at its own time, until the next one.
// No prediction, list or measurement changes it. Therefore results do not depend on the search.
//
// `Search` is a neighbour search: neighbors/neighbor_search.hpp states what the loop requires from
// it. `Observer` looks at the discs before and after each event: event_observer.hpp. Spheres on a
// floor have a fourth kind of event, which the loop for discs does not test for: a sphere begins to
// roll.
//
// One file per vector width includes this header, and with it resolve.hpp and the searches, and is
// compiled with that width's instructions. The linker must not mix the versions up. So no function
// in these headers may have a symbol that is visible outside: all are inlined or static.
// tests/engine/wide_objects_test.py checks the object files.
#pragma once

#include "swirl/engine/event_observer.hpp"
#include "swirl/engine/neighbors/engine_state.hpp"
#include "swirl/engine/neighbors/engine_state_checks.hpp"
#include "swirl/engine/neighbors/neighbor_search.hpp"
#include "swirl/engine/neighbors/wall_times.hpp"
#include "swirl/engine/pending_event.hpp"
#include "swirl/engine/resolve.hpp"
#include "swirl/engine/rotation_observer.hpp"

namespace swirl {
inline namespace SWIRL_TARGET {

/// True if a sphere begins to roll.
template <NeighborSearch Search>
SWIRL_INLINE bool is_of_floor(const PendingEvent& event) {
    return Search::Bodies::have_floor && event.partner == the_floor;
}

/// Returns the next event that happens. Invalidated events before it are predicted again.
template <NeighborSearch Search>
SWIRL_INLINE PendingEvent next_event(typename Search::State& state) {
    for (;;) {
        const PendingEvent next = Search::next(state);
        if (next.time >= state.interval_end) [[unlikely]] {
            const double end = state.segments[state.segment].end;
            if (state.interval_end >= end) return {end, state.size, state.size};
            if constexpr (RenewsWithinSegment<Search>) Search::interval_ended(state);
            continue;
        }
        if (is_of_floor<Search>(next) || state.is_valid(next)) return next;
        Search::reschedule(state, next);
    }
}

/// Checks invariants, in the build that does so (invariant.hpp).
template <NeighborSearch Search>
SWIRL_INLINE void check(const typename Search::State& state, const PendingEvent& next) {
    if constexpr (internal_checks && Search::Bodies::have_floor) {
        invariant::time_never_goes_back(next.time >= state.clock);
        if (is_time_to_check(state)) Search::check(state, next.time);
    } else if constexpr (internal_checks) {
        check_order(state, next);
        if (!is_time_to_check(state)) return;
        check_discs(state, next.time);
        Search::check(state, next.time);
    }
}

/// Prepares what predictions need to know of the segment.
SWIRL_INLINE void begin_segment(EngineState& state) {
    state.interval_end = state.segments[state.segment].end;
    state.arc_centre.time = -never;
    if (state.on_arc()) renew_arc_bound(state, state.clock);
}

/// Not inlined, so that collisions, which are most events, have all registers.
template <NeighborSearch Search>
[[gnu::noinline]] static Event end_segment(typename Search::State& state) {
    const Event event = start_next_segment<typename Search::Bodies>(state);
    begin_segment(state);
    Search::segment_ended(state, event.clock);
    return event;
}

template <NeighborSearch Search>
SWIRL_INLINE Event execute(typename Search::State& state, const PendingEvent& next) {
    if (next.disc == state.size) {
        check<Search>(state, next);
        return end_segment<Search>(state);
    }
    const PendingEvent due = Search::remove(state, next);
    check<Search>(state, due);
    state.clock = due.time;
    if constexpr (Search::Bodies::have_floor) {
        if (is_of_floor<Search>(due)) {
            const Event event = Search::Bodies::begin_to_roll(state, due.disc, due.time);
            Search::predict_changed(state, {due.disc}, due.time);
            return event;
        }
    }
    if (due.is_with_wall()) {
        const Event event = collide_with_wall<typename Search::Bodies>(state, due.disc, due.time);
        Search::predict_changed(state, {due.disc}, due.time);
        return event;
    }
    const Event event =
        collide_discs<typename Search::Bodies>(state, due.first(), due.second(), due.time);
    Search::predict_changed(state, {due.first(), due.second()}, due.time);
    return event;
}

// The functions of EventLoop, which do not know the type of the search's state.

template <NeighborSearch Search>
static void start(EngineState& shared) {
    auto& state = static_cast<typename Search::State&>(shared);
    if constexpr (internal_checks)
        state.overlapped_at_start = !all_discs_are_apart(state, state.clock);
    begin_segment(state);
    Search::start(state);
}

template <NeighborSearch Search, EventObserver<typename Search::State> Observer>
SWIRL_INLINE void run_observed(typename Search::State& state, Observer observer, EventSpan& span,
                               std::uint64_t count, std::int64_t periods, double clock) {
    std::uint64_t done = span.events;
    double max_overlap = span.max_overlap;
    while (done < count) {
        const PendingEvent next = next_event<Search>(state);
        if (state.periods > periods || (state.periods == periods && next.time > clock)) break;
        if (!observer.before(state, next.time)) [[unlikely]]
            break;
        const Event event = execute<Search>(state, next);
        span.discs[done++ % EventSpan::capacity] = {event.i, event.j};
        max_overlap = event.overlap > max_overlap ? event.overlap : max_overlap;
        observer.after(state, event);
        if constexpr (CanAskToBeReplaced<Search>)
            if (Search::should_switch_search(state)) [[unlikely]]
                break;
    }
    span.events = done;
    span.max_overlap = max_overlap;
}

template <NeighborSearch Search>
static void run(EngineState& shared, EventSpan& span, std::uint64_t count, std::int64_t periods,
                double clock) {
    auto& state = static_cast<typename Search::State&>(shared);
    run_observed<Search>(state, NoObserver{}, span, count, periods, clock);
}

template <NeighborSearch Search>
static void observe(EngineState& shared, RotationSampling* sampling, Event* last, EventSpan& span,
                    std::uint64_t count, std::int64_t periods, double clock) {
    auto& state = static_cast<typename Search::State&>(shared);
    run_observed<Search>(state, RotationObserver(state, sampling, last), span, count, periods,
                         clock);
}

template <NeighborSearch Search>
constexpr EventLoop event_loop(const char* width) {
    return {width, start<Search>, run<Search>, observe<Search>};
}

}  // namespace SWIRL_TARGET
}  // namespace swirl
