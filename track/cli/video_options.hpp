// The options that `swirl track` and `swirl experiment` have in common.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <optional>

#include "swirl/run/failure.hpp"

namespace swirl {

/// Throws UsageError unless --fps and --max-frames are above 0.
inline void check_video_options(const std::optional<double>& fps,
                                const std::optional<std::int64_t>& frames) {
    if (fps && !(*fps > 0.0))
        throw UsageError(fmt::format("--fps is {}, but it must be above 0.", *fps));
    if (frames && !(*frames > 0))
        throw UsageError(fmt::format("--max-frames is {}, but it must be at least 1.", *frames));
}

}  // namespace swirl
