// What an observer within the event loop (event_loop.hpp) must offer. It is known at compile time,
// so an event costs nothing that the observer does not ask for. An observer reads the state and
// never changes it: observing does not change a trajectory.
#pragma once

#include <concepts>

#include "swirl/engine/neighbors/engine_state.hpp"
#include "swirl/physics/event.hpp"

namespace swirl {

///     before(state, t)     the next event happens at t. All discs move freely until then, so their
///                          state at any earlier time is known. False: the loop returns first
///     after(state, event)  the event was executed
template <class Observer, class State>
concept EventObserver = std::derived_from<State, EngineState> &&
    requires(Observer& observer, State& state, const Event& event, double t) {
    { observer.before(state, t) } -> std::same_as<bool>;
    { observer.after(state, event) } -> std::same_as<void>;
};

/// For a run that nothing observes.
struct NoObserver {
    SWIRL_INLINE bool before(const EngineState&, double) const { return true; }
    SWIRL_INLINE void after(const EngineState&, const Event&) const {}
};
static_assert(EventObserver<NoObserver, EngineState>);

}  // namespace swirl
