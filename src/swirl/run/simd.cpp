#include "swirl/run/simd.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <string_view>

#include "swirl/run/config.hpp"
#include "swirl/run/failure.hpp"

namespace swirl {

std::string supported_widths() {
    std::string names;
    for (const auto& [name, width] : named_widths)
        if (has_width(width)) names += (names.empty() ? "" : ", ") + std::string(name);
    return names;
}

Width selected_width() {
    const char* const given = std::getenv("SWIRL_SIMD");
    if (!given || !*given || std::string_view(given) == "auto") return Width::best;
    for (const auto& [name, width] : named_widths) {
        if (std::string_view(given) != name) continue;
        if (has_width(width)) return width;
        throw UsageError(fmt::format("SWIRL_SIMD is '{}', but this processor supports only {}.",
                                     given, supported_widths()));
    }
    throw UsageError(fmt::format("SWIRL_SIMD is '{}', but it must be auto, {}, avx2 or avx512.",
                                 given, baseline_name));
}

Tuning selected_tuning(const std::atomic<bool>* stop) {
    Tuning tuning = stopped_by(stop);
    tuning.width = selected_width();
    return tuning;
}

}  // namespace swirl
