#include "swirl/run/collapse_guard.hpp"

namespace swirl {

Message duration_of(const Collapse& collapse) {
    // The two times may be equal in double precision.
    if (collapse.periods > 0.0) return {"short_time", {rounded("periods", collapse.periods, 2)}};
    return Message("no_time");
}

Message collapse_message(const Collapse& collapse, double periods, const RunConfig& config) {
    const MessageValue events("events", static_cast<double>(collapse.events));
    const MessageValue duration("duration", duration_of(collapse));
    const MessageValue until = with_decimals("periods", periods, 3);
    if (config.restitution < 1.0)
        return {"inelastic_collapse",
                {events,
                 duration,
                 until,
                 {"restitution", config.restitution},
                 body_of(config),
                 {"contact", config.contact_duration}}};
    return {"frictional_collapse",
            {events, duration, until, body_of(config), {"seed", config.seed}}};
}

}  // namespace swirl
