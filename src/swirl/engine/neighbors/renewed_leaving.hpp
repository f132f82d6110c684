// Speed only; results stay bitwise identical. How a path vertex changes a disc's pending event.
#pragma once

#include "swirl/engine/neighbors/event_queue.hpp"
#include "swirl/engine/neighbors/prediction.hpp"
#include "swirl/engine/neighbors/search_states.hpp"
#include "swirl/engine/neighbors/wall_times.hpp"
#include "swirl/engine/pending_event.hpp"

namespace swirl {
inline namespace SWIRL_TARGET {

/// The container has changed its velocity, so disc i reaches the wall at another time. If the frame
/// was renewed as well, it leaves its skin at another time. If the pending event was one of these
/// and now comes later, it keeps its old time, marked as no event. The disc is then predicted again
/// at that time, which is early enough. Within an arc only the skin is affected.
SWIRL_INLINE void renew_leaving(ListsOrCellsState& state, std::uint32_t i, double t,
                                Leaving leaving, bool in_new_frame = true) {
    ColdDisc& cold = state.cold(i);
    const bool on_arc = state.on_arc();
    if ((cold.partner == i && !on_arc) || (cold.partner == leaves_skin && in_new_frame))
        cold.partner = no_event;
    const PendingEvent stored{pending_time(state, i), i, cold.partner};
    if (on_arc) [[unlikely]] {
        if (cold.partner == i || cold.partner == approaches_wall)
            leaving.wall = never;
        else
            approach_wall(state, i, t, smaller(stored.time, leaving.skin), leaving);
    }
    const PendingEvent first = first_of(stored, leaving);
    if (first.partner != stored.partner) insert(state, first);
}

}  // namespace SWIRL_TARGET
}  // namespace swirl
