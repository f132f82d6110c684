// Reports a collapse with its reason. CoreRun has its own watch; every other caller that advances a
// simulation as far as a user asks has a guard, because in a collapse time does not advance.
#pragma once

#include <optional>

#include "swirl/engine/simulation.hpp"
#include "swirl/run/collapse.hpp"
#include "swirl/run/config.hpp"

namespace swirl {

/// "only 1e-05 periods"
Message duration_of(const Collapse& collapse);

/// Which of the two kinds of collapse it is, and what helps.
Message collapse_message(const Collapse& collapse, double periods, const RunConfig& config);

class CollapseGuard {
  public:
    CollapseGuard(const Simulation& simulation, double period)
        : watch_(simulation.size(), mark(simulation, period)) {}

    /// Why the simulation cannot continue; nothing if it can. Call this at least
    /// every few thousand events. `period`: its present length.
    std::optional<Message> problem(const Simulation& simulation, double period,
                                   const RunConfig& config) {
        const RunMark now = mark(simulation, period);
        const auto found = watch_.check(now);
        if (!found) return {};
        return collapse_message(*found, now.periods, config);
    }

  private:
    static RunMark mark(const Simulation& simulation, double period) {
        return {simulation.events().total(),
                static_cast<double>(simulation.periods()) + simulation.clock() / period};
    }

    CollapseWatch watch_;
};

}  // namespace swirl
