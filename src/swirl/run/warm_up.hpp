// The warm-up of a run, and the averages that it separates: rotation and spin during the warm-up
// and after it. It ends at the end of a period: after a given number of periods, when the beginning
// is forgotten (steady_state.hpp), or, without either, after twenty periods or a fifth of the run.
#pragma once

#include <algorithm>
#include <cstdint>

#include "swirl/measure/cluster_rotation.hpp"
#include "swirl/run/parameters.hpp"
#include "swirl/statistics/block_average.hpp"
#include "swirl/statistics/steady_state.hpp"

namespace swirl {

struct WarmUp {
    WarmUp(const RunConfig& config, Width width)
        : is_over(config.warmup == 0),
          rotation_before(width, config.turns_clockwise()),
          rotation_after(width, config.turns_clockwise()) {}

    ClusterRotation& rotation() { return is_over ? rotation_after : rotation_before; }
    BlockMean& spin() { return is_over ? spin_after : spin_before; }

    /// Called at the end of each period. True if the warm-up ends with it. `fraction`: the
    /// completed part of the run.
    bool ends(const RunConfig& config, std::int64_t periods, double fraction) {
        if (is_over) return false;
        if (config.warmup_found)
            is_over = beginning_is_forgotten_after(periods) || fraction >= 0.5;
        else if (config.warmup)
            is_over = periods >= *config.warmup;
        else
            is_over = periods >= default_warmup || fraction >= 0.2;
        return is_over;
    }

    bool is_over;
    ClusterRotation rotation_before, rotation_after;
    BlockMean spin_before, spin_after;
    std::int64_t next_test = min_blocks_of_a_steady_state;  // period of the next test

  private:
    /// The test takes time proportional to the number of periods, so the intervals between tests
    /// grow.
    bool beginning_is_forgotten_after(std::int64_t periods) {
        if (periods < next_test) return false;
        next_test += std::max<std::int64_t>(10, next_test / 10);
        return beginning_is_forgotten(rotation_before.mean_by_event().block_means()) &&
               beginning_is_forgotten(spin_before.series().block_means());
    }
};

}  // namespace swirl
