// What a run hands over to an observation, whatever the list of its measurements
// (basic_observation.hpp). Without one, the functions do nothing. CoreRun knows no list, so the
// browser page contains only the measurements that it shows.
#pragma once

#include <cstddef>

#include "swirl/measure/event_states.hpp"
#include "swirl/measure/observation_fwd.hpp"
#include "swirl/physics/event.hpp"
#include "swirl/physics/snapshot.hpp"

namespace swirl {

class RunObserver {
  public:
    RunObserver(std::nullptr_t) {}
    /// The observation must outlive the run. It may be null.
    template <class Measurements>
    RunObserver(BasicObservation<Measurements>* observation)
        : observation_(observation),
          calls_(observation ? &calls_of<BasicObservation<Measurements>> : nullptr),
          samples_events_(observation && observation->samples_events()) {}

    bool exists() const { return calls_ != nullptr; }
    /// True if it needs every event.
    bool samples_events() const { return samples_events_; }

    void sample(const Snapshot& lab) {
        if (calls_) calls_->sample(observation_, lab);
    }
    void sample(const Event& event, const EventStates& after) {
        if (calls_) calls_->sample_event(observation_, event, after);
    }
    void close_block() {
        if (calls_) calls_->close_block(observation_);
    }

  private:
    struct Calls {
        void (*sample)(void*, const Snapshot&);
        void (*sample_event)(void*, const Event&, const EventStates&);
        void (*close_block)(void*);
    };
    template <class O>
    static constexpr Calls calls_of = {
        .sample = [](void* o, const Snapshot& lab) { static_cast<O*>(o)->sample(lab); },
        .sample_event = [](void* o, const Event& event,
                           const EventStates& after) { static_cast<O*>(o)->sample(event, after); },
        .close_block = [](void* o) { static_cast<O*>(o)->close_block(); }};

    void* observation_ = nullptr;
    const Calls* calls_ = nullptr;
    bool samples_events_ = false;
};

}  // namespace swirl
