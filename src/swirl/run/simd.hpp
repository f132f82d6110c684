// The vector instructions that the user selects by the environment variable SWIRL_SIMD. All widths
// give bitwise identical results, so this is not a parameter of a run.
#pragma once

#include <array>
#include <atomic>
#include <string>
#include <utility>

#include "swirl/engine/simulation.hpp"
#include "swirl/math/cpu_width.hpp"

namespace swirl {

inline constexpr std::array<std::pair<const char*, Width>, 3> named_widths{
    {{baseline_name, Width::baseline}, {"avx2", Width::avx2}, {"avx512", Width::avx512}}};

/// The names of the widths that this processor supports, separated by commas.
std::string supported_widths();

/// The width that SWIRL_SIMD names; `best` if it is not set, empty or "auto". Throws UsageError for
/// an unknown name, and for a width that this processor does not support.
Width selected_width();

/// Settings of a simulation: the selected width, and `stop`, which ends it early when it is set.
Tuning selected_tuning(const std::atomic<bool>* stop);

}  // namespace swirl
