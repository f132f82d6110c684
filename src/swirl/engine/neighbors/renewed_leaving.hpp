// Speed only, changes no bit: what a corner of the path changes of a disc's pending event.
//
// Included by one file per vector width, like event_loop.hpp, and under the same rule.
#pragma once

#include "swirl/engine/neighbors/engine_state.hpp"
#include "swirl/engine/neighbors/prediction.hpp"
#include "swirl/engine/neighbors/tournament.hpp"
#include "swirl/engine/neighbors/wall_times.hpp"
#include "swirl/engine/pending_event.hpp"

namespace swirl {
inline namespace SWIRL_TARGET {

/// The container has changed course, so the wall and the skin, whose frame is renewed, come at
/// other times. An event of theirs that now comes later leaves its disc to be predicted again at
/// the time it held, which is early enough for whatever comes next. In the middle of a turning leg
/// only the skin does.
SWIRL_INLINE void renew_leaving(EngineState& state, std::uint32_t i, double t, Leaving leaving,
                                bool in_new_frame = true) {
    ColdDisc& cold = state.cold(i);
    const bool turning = state.on_turning_segment();
    if ((cold.partner == i && !turning) || (cold.partner == leaves_skin && in_new_frame))
        cold.partner = no_event;
    const PendingEvent held{pending_time(state, i), i, cold.partner};
    if (turning) [[unlikely]] {
        if (cold.partner == i || cold.partner == approaches_wall)
            leaving.wall = never;
        else
            approach_wall(state, i, t, smaller(held.time, leaving.skin), leaving);
    }
    const PendingEvent first = first_of(held, leaving);
    if (first.partner != held.partner) insert(state, first);
}

}  // namespace SWIRL_TARGET
}  // namespace swirl
