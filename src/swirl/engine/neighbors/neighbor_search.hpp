// The functions that the event loop (event_loop.hpp) requires from a neighbour search. A search
// answers one question: which event comes next? It decides how fast the answer comes, never what it
// is. To add a search, write a struct that satisfies NeighborSearch, give it a state
// (search_states.hpp), set that up (search_setup.cpp), and add its loop to EventLoops.
#pragma once

#include <concepts>
#include <cstdint>

#include "swirl/engine/neighbors/engine_state.hpp"
#include "swirl/engine/pending_event.hpp"

namespace swirl {

/// All functions are static.
///
///     State                             EngineState and the search's own state
///     Bodies                            Discs or Spheres (resolve.hpp)
///     start(state)                      predicts all events from the discs' current states
///     next(state)                       returns the earliest pending event, valid or not
///     reschedule(state, event)          `event` was invalidated: predicts its disc again
///     remove(state, event)              removes the pending events of the discs of the next event
///                                       and returns that event; if several come at one instant,
///                                       it is the first in order (pending_event.hpp)
///     predict_changed(state, discs, t)  predicts one or two discs that have collided at time t
///     segment_ended(state, t)           the container has begun its next segment, the last one
///                                       ended at t: predicts what depends on the container
///     check(state, t)                   checks the invariants of the search (invariant.hpp)
template <class Search>
concept NeighborSearch = std::derived_from<typename Search::State, EngineState> &&
    requires(typename Search::State& state, const typename Search::State& constant,
             const PendingEvent& event, const std::uint32_t (&one)[1],
             const std::uint32_t (&two)[2], double t) {
    { Search::Bodies::have_floor } -> std::convertible_to<bool>;
    { Search::start(state) } -> std::same_as<void>;
    { Search::next(constant) } -> std::same_as<PendingEvent>;
    { Search::reschedule(state, event) } -> std::same_as<void>;
    { Search::remove(state, event) } -> std::same_as<PendingEvent>;
    { Search::predict_changed(state, one, t) } -> std::same_as<void>;
    { Search::predict_changed(state, two, t) } -> std::same_as<void>;
    { Search::segment_ended(state, t) } -> std::same_as<void>;
    { Search::check(constant, t) } -> std::same_as<void>;
};

/// Optional: the search renews its predictions when EngineState::interval_end is reached, which may
/// be before the segment ends.
template <class Search>
concept RenewsWithinSegment = requires(typename Search::State& state) {
    { Search::interval_ended(state) } -> std::same_as<void>;
};

/// Optional: the search may ask to be replaced by another one. It stays correct, but it is no
/// longer the fastest.
template <class Search>
concept CanAskToBeReplaced = requires(const typename Search::State& state) {
    { Search::should_switch_search(state) } -> std::same_as<bool>;
};

}  // namespace swirl
