// Speed only; results stay bitwise identical. At run time, a simulation switches between linked
// cells and Verlet lists, to the one that is faster now.
//
//  - A dilute container begins with linked cells: a disc would leave any skin after a collision or
//    two, so its list would not be worth building.
//  - Where discs have gathered (a swirled container does that), each stays within its skin for many
//    collisions. Then lists take over: `lists_would_last`.
//  - If those lists have to be rebuilt too often, cells take over again: `lists_do_not_last`.
//
// Each test covers the time since the previous one, which begin_test() marks.
#pragma once

#include "swirl/engine/neighbors/comoving_frame.hpp"
#include "swirl/engine/neighbors/search_states.hpp"

namespace swirl {
inline namespace SWIRL_TARGET {

SWIRL_INLINE double collisions_since_test(const ListsOrCellsState& state) {
    return static_cast<double>(state.disc_disc + state.disc_wall - state.collisions_at_test);
}
/// Of lists; in linked cells, the number of times that a disc has entered another cell.
SWIRL_INLINE double rebuilds_since_test(const ListsOrCellsState& state) {
    return static_cast<double>(state.list_rebuilds - state.rebuilds_at_test);
}
SWIRL_INLINE void begin_test(ListsOrCellsState& state) {
    state.rebuilds_at_test = state.list_rebuilds;
    state.collisions_at_test = state.disc_disc + state.disc_wall;
}

/// Up to this many list rebuilds per collision, lists are faster than cells (measured).
inline constexpr double max_rebuilds_per_collision = 0.3;
SWIRL_INLINE bool lists_do_not_last(const ListsOrCellsState& state) {
    return rebuilds_since_test(state) > max_rebuilds_per_collision * collisions_since_test(state);
}

/// While cells are in use, the number of list rebuilds is unknown. It is estimated from how far the
/// discs travel, all of them together, from one collision of the simulation to the next.
///
/// If they have entered E cells of width w in C collisions, that distance is about E w / C. Skins
/// move with the common motion of the discs, so only the random part of the velocities leads out of
/// them: √(random/(random + lag)) of the whole (MotionInFrame). Lists last if the distance that is
/// left is less than `max_travel` radii r:
///
///     E w √(random/(random + lag)) < max_travel r C.
///
/// The limit is low because skins are narrow where discs have gathered. Each time that lists took
/// over and did not last, the limit is multiplied by `caution`, three times at most.
inline constexpr double max_travel = 0.2, caution = 0.7;
inline constexpr std::uint32_t max_failures_counted = 3;
[[maybe_unused]] static bool lists_would_last(const ListsOrCellsState& state, double cell_width,
                                              double t) {
    double limit = max_travel * state.smallest_radius * collisions_since_test(state);
    for (std::uint32_t k = 0; k < state.failed_lists; ++k) limit *= caution;
    const double travelled = cell_width * rebuilds_since_test(state);
    const MotionInFrame motion = motion_in_frame(state, t);
    return travelled * travelled * motion.random < limit * limit * (motion.random + motion.lag);
}

}  // namespace SWIRL_TARGET
}  // namespace swirl
