// Speed only, changes no bit: whether lists or cells are the faster. A thin dish begins with cells.
// Where its discs have gathered they stay in their skins for long, and lists take over; where these
// do not last, cells again.
//
// Included by one file per vector width, like event_loop.hpp, and under the same rule.
#pragma once

#include "swirl/engine/neighbors/comoving_frame.hpp"
#include "swirl/engine/neighbors/engine_state.hpp"

namespace swirl {
inline namespace SWIRL_TARGET {

SWIRL_INLINE double collisions_since_asked(const EngineState& state) {
    return static_cast<double>(state.disc_disc + state.disc_wall - state.collisions_when_asked);
}
SWIRL_INLINE double rebuilds_since_asked(const EngineState& state) {
    return static_cast<double>(state.list_rebuilds - state.rebuilds_when_asked);
}
SWIRL_INLINE void begin_to_count(EngineState& state) {
    state.rebuilds_when_asked = state.list_rebuilds;
    state.collisions_when_asked = state.disc_disc + state.disc_wall;
}

/// Lists are the faster up to so many rebuilt per collision.
inline constexpr double bearable_rebuilds = 0.3;
/// How many there would be is not known where there are cells. The discs go ways against these that
/// tell how many are entered, and shorter ones against a frame that takes part in their common
/// motion. If all of them together go less than this from one collision to the next, in radii,
/// lists last, though skins are narrow where discs have gathered. Each time that this was an error
/// they have to go less, up to a third.
inline constexpr double short_way = 0.2, shorter = 0.7;
inline constexpr std::uint32_t max_returns_counted = 3;
static bool lists_would_last(const EngineState& state, double width, double t) {
    double way = short_way * state.smallest_radius * collisions_since_asked(state);
    for (std::uint32_t k = 0; k < state.returns_to_cells; ++k) way *= shorter;
    const double gone = width * rebuilds_since_asked(state);
    const MotionInFrame motion = motion_in_frame(state, t);
    return gone * gone * motion.random < way * way * (motion.random + motion.lag);
}

}  // namespace SWIRL_TARGET
}  // namespace swirl
