#include "swirl/run/collapse_guard.hpp"

#include <fmt/format.h>

namespace swirl {

static std::string reason_for_collapse(const RunConfig& config) {
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

std::string duration_text(const Collapse& collapse) {
    // The two times may be equal in double precision.
    return fmt::format("the last {} events took {}", collapse.events,
                       collapse.periods > 0.0 ? fmt::format("only {:.2g} periods", collapse.periods)
                                              : "no measurable time");
}

std::string collapse_sentence(const Collapse& collapse, double periods, const RunConfig& config) {
    return fmt::format("{} (collapse after {:.3f} periods): {}", duration_text(collapse), periods,
                       reason_for_collapse(config));
}

}  // namespace swirl
