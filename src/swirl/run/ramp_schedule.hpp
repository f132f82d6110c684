// The path of a run's container, and its changes by ramps (ramp.hpp).
#pragma once

#include <cstdint>
#include <utility>

#include "swirl/engine/simulation.hpp"
#include "swirl/physics/container_path.hpp"
#include "swirl/physics/snapshot.hpp"
#include "swirl/run/parameters.hpp"
#include "swirl/run/ramp.hpp"

namespace swirl {

class RampSchedule {
  public:
    explicit RampSchedule(ContainerPath path) : path_(std::move(path)) {}

    const ContainerPath& path() const { return path_; }

    /// Continues with the values of the period that begins. False if they are those of the last
    /// one.
    bool begin_period(const RunConfig& config, Simulation& simulation, const Tuning& tuning,
                      Snapshot& snapshot) {
        const std::int64_t period = simulation.periods();
        if (config.ramps.empty() || !changes_in_period(config, period)) return false;
        const InitialState next = surroundings_in(config, period);
        const bool period_changes = next.path.period != path_.period;
        const double now = snapshot.time();
        simulation.change_surroundings(next, tuning);
        path_ = next.path;
        Snapshot begin = simulation.snapshot();
        begin.turned = std::move(snapshot.turned);
        begin.periods_at_change = period_changes ? begin.periods : snapshot.periods_at_change;
        begin.time_at_change = period_changes ? now : snapshot.time_at_change;
        snapshot = std::move(begin);
        return true;
    }

  private:
    ContainerPath path_;
};

}  // namespace swirl
