// Reports a collapse with its reason. CoreRun has its own watch; every other caller that advances a
// simulation as far as a user asks has a guard, because in a collapse time does not advance.
#pragma once

#include <fmt/format.h>

#include <optional>
#include <string>

#include "swirl/engine/simulation.hpp"
#include "swirl/run/collapse.hpp"
#include "swirl/run/config.hpp"

namespace swirl {

/// Which of the two kinds of collapse it is, and what helps.
inline std::string reason_for_collapse(const RunConfig& config) {
    if (config.restitution < 1.0)
        return fmt::format(
            "with restitution {} the {}s collide ever faster (inelastic collapse).\nhint: use a "
            "--contact-duration longer than {}.",
            config.restitution, body_word(config), config.contact_duration);
    return fmt::format(
        "friction has dissipated the relative motion of {}s that are pressed together, and they "
        "collide ever faster (frictional collapse; docs/explanation/physics.md). The model has no "
        "state after it.\nhint: another --seed than {} may avoid it.",
        body_word(config), config.seed);
}

inline std::string collapse_sentence(const Collapse& collapse, double periods,
                                     const std::string& reason) {
    return fmt::format("{} (collapse after {:.3f} periods): {}", duration_text(collapse), periods,
                       reason);
}

class CollapseGuard {
  public:
    CollapseGuard(const Simulation& simulation, double period)
        : watch_(simulation.size(), mark(simulation, period)) {}

    /// Why the simulation cannot continue, as a sentence; nothing if it can. Call this at least
    /// every few thousand events. `period`: its present length.
    std::optional<std::string> problem(const Simulation& simulation, double period,
                                       const RunConfig& config) {
        const RunMark now = mark(simulation, period);
        const auto found = watch_.check(now);
        if (!found) return {};
        return collapse_sentence(*found, now.periods, reason_for_collapse(config));
    }

  private:
    static RunMark mark(const Simulation& simulation, double period) {
        return {simulation.events().total(),
                static_cast<double>(simulation.periods()) + simulation.clock() / period};
    }

    CollapseWatch watch_;
};

}  // namespace swirl
