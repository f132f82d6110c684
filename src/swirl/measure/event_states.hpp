// The state after an event, as a run hands it over to measurements.
//
// Spheres on a floor are accelerated, so columns hold the states of the present only after all
// spheres were moved to it. That costs as much as several events. Most measurements read the one
// or two particles of the event alone, whose states are those of the present anyway. So the others
// are moved when the first measurement asks for them.
#pragma once

#include "swirl/physics/snapshot.hpp"

namespace swirl {

class EventStates {
  public:
    /// All states are those at the clock, or of discs, which have no acceleration.
    EventStates(const Snapshot& all) : of_event_(all), of_all_(&all) {}
    /// move_all(owner) is called once, if the states of all particles are needed.
    EventStates(const Snapshot& of_event, const Snapshot& (*move_all)(void*), void* owner)
        : of_event_(of_event), move_all_(move_all), owner_(owner) {}

    /// Only the columns of the particles of the event are at the clock. Times, the container, and
    /// numbers that never change hold for all.
    const Snapshot& of_event() const { return of_event_; }
    const Snapshot& of_all() const {
        if (of_all_ == nullptr) of_all_ = &move_all_(owner_);
        return *of_all_;
    }

  private:
    const Snapshot& of_event_;
    mutable const Snapshot* of_all_ = nullptr;
    const Snapshot& (*move_all_)(void*) = nullptr;
    void* owner_ = nullptr;
};

}  // namespace swirl
