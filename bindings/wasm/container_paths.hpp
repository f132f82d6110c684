// Paths that the page needs: by hand.
#pragma once

#include "swirl/physics/container_path.hpp"

namespace swirl {

/// The period of a path that is moved by hand. Such a path has no period, so this is practically
/// infinite.
inline constexpr double no_period = 1e6;

/// The container moves straight to a point and waits there for the next target. It stops at once,
/// at a vertex like any other.
inline ContainerPath path_by_hand(const Vec2& from, const Vec2& to, double duration) {
    return {no_period,
            {{0.0, duration, from, (1.0 / duration) * (to - from), 0.0},
             {duration, no_period, to, {0.0, 0.0}, 0.0}}};
}

inline bool is_by_hand(const ContainerPath& path) { return path.period == no_period; }

}  // namespace swirl
