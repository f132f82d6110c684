// The observer of runs, within the event loop: it follows the rotation of the discs, takes its
// samples by event and by time, and hands over the last event.
//
// The rotation is computed from columns. A search with columns lends its own. For any other search
// the observer copies the discs into columns: after each event if each is sampled, otherwise before
// each sample.
#pragma once

#include <concepts>
#include <cstdint>

#include "swirl/engine/event_observer.hpp"
#include "swirl/engine/neighbors/engine_state.hpp"
#include "swirl/math/lanes.hpp"
#include "swirl/physics/event.hpp"
#include "swirl/physics/rotation_follower.hpp"

namespace swirl {
inline namespace SWIRL_TARGET {

/// True if the search itself keeps the flights of all discs in columns.
template <class State>
concept HasColumns = requires(const State& state) {
    { state.columns.time[0] } -> std::convertible_to<double>;
};

template <class Columns>
SWIRL_INLINE RotationColumns rotation_columns(const Columns& columns) {
    RotationColumns of{columns.x, columns.y, columns.vx, columns.vy, columns.time};
    if constexpr (requires { columns.ax; }) {
        of.ax = columns.ax;
        of.ay = columns.ay;
    }
    return of;
}

SWIRL_INLINE void copy_flight(const EngineState& state, std::uint32_t i) {
    const HotDisc& d = state.discs[i];
    const CopiedFlights& to = state.copies;
    to.x[i] = d.position.x;
    to.y[i] = d.position.y;
    to.vx[i] = d.velocity.x;
    to.vy[i] = d.velocity.y;
    to.time[i] = d.time;
    if (to.ax == nullptr) return;
    to.ax[i] = state.spheres[i].motion.acceleration.x;
    to.ay[i] = state.spheres[i].motion.acceleration.y;
}

[[gnu::noinline]] static void copy_all_flights(EngineState& state) {
    for (std::uint32_t i = 0; i < state.size; ++i) copy_flight(state, i);
    state.copies.events = state.events();
}

/// At all sample times up to t, the time of the next event. False if the loop must return after a
/// sample.
[[gnu::noinline]] static bool sample_by_time(const EngineState& state,
                                             const RotationColumns& columns, RotationSampling& s,
                                             double t) {
    while (s.due <= t) {
        const double now = s.due;
        s.rotation.sample_by_time(columns, now);
        double spin = 0.0;
        for (std::uint32_t i = 0; i < state.size; ++i) spin += state.discs[i].spin;
        *s.spin +=
            s.swirl_sign * spin / static_cast<double>(state.size) * state.period / (2.0 * pi);
        *s.spins += 1.0;
        ++s.index;
        s.set_due(state.period);
        if (!s.pauses) continue;
        s.paused_at = now;
        return false;
    }
    return true;
}

/// After an event, if not every event is sampled.
[[gnu::noinline]] static void sample_sometimes(const RotationColumns& columns, RotationSampling& s,
                                               const Event& event, double clock,
                                               bool period_ended) {
    if (period_ended) s.rotation.follow(columns, event, clock, period_ended);
    if (*s.left > 0) return;
    *s.left = s.interval;
    s.rotation.sample_alone(columns, clock);
}

template <class State>
class RotationObserver {
  public:
    SWIRL_INLINE RotationObserver(State& state, RotationSampling* sampling, Event* last)
        : sampling_(sampling), last_(last), due_(sampling ? sampling->due : never) {
        if constexpr (HasColumns<State>)
            columns_ = rotation_columns(state.columns);
        else
            columns_ = rotation_columns(state.copies);
    }

    SWIRL_INLINE bool before(State& state, double t) {
        if (due_ > t) [[likely]]
            return true;
        bring_up_to_date(state);
        const bool continues = sample_by_time(state, columns_, *sampling_, t);
        due_ = sampling_->due;
        return continues;
    }

    SWIRL_INLINE void after(State& state, const Event& event) {
        if (last_ != nullptr) *last_ = event;
        if (sampling_ == nullptr) return;
        RotationSampling& s = *sampling_;
        const bool period_ended = state.periods != event.periods;
        if (s.interval == 1) {
            update_columns(state, event, period_ended);
            s.rotation.follow(columns_, event, state.clock, period_ended);
            s.rotation.sample(columns_, state.clock);
            return;
        }
        const bool is_due = --*s.left == 0;
        if (!is_due && !period_ended) [[likely]]
            return;
        bring_up_to_date(state);
        sample_sometimes(columns_, s, event, state.clock, period_ended);
    }

  private:
    /// After each event.
    SWIRL_INLINE void update_columns(State& state, const Event& event, bool period_ended) {
        if constexpr (!HasColumns<State>) {
            CopiedFlights& copies = state.copies;
            const bool all_changed =
                period_ended || (event.kind == EventKind::path_vertex && copies.ax != nullptr);
            if (all_changed || copies.events + 1 != state.events()) [[unlikely]]
                return copy_all_flights(state);
            ++copies.events;
            copy_flight(state, event.i);
            copy_flight(state, event.j);
        }
    }
    SWIRL_INLINE void bring_up_to_date(State& state) {
        if constexpr (!HasColumns<State>)
            if (state.copies.events != state.events()) copy_all_flights(state);
    }

    RotationSampling* sampling_;
    Event* last_;
    double due_;  // that of the sampling
    RotationColumns columns_;
};

static_assert(EventObserver<RotationObserver<EngineState>, EngineState>);

}  // namespace SWIRL_TARGET
}  // namespace swirl
