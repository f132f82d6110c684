// The warning that replicates disagree, shared by sweeps and searches for a crossing.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <string_view>

namespace swirl {

/// "at 2 of 40 rows, the replicates scatter more …".
inline std::string disagreement_warning(std::int64_t count, std::string_view of_what) {
    return fmt::format(
        "at {} of {}, the replicates scatter more than the errors within the runs explain; the "
        "errors given are those between the replicates.",
        count, of_what);
}

}  // namespace swirl
