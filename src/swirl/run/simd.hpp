// Which vector instructions a user asks for, by name. Every width gives the same bits, so this is
// no parameter of a run. The environment variable SWIRL_SIMD asks for one, in every command and in
// Python.
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

/// The names of the widths that this processor has, separated by commas.
std::string names_of_widths_here();

/// The width that SWIRL_SIMD names; `best` where it is not set, is empty or says "auto". Throws
/// WrongCall for another word, and for a width that this processor lacks.
Width asked_width();

/// How a simulation runs that a user asks for: with that width, until it is stopped.
Tuning asked_tuning(const std::atomic<bool>* stop);

}  // namespace swirl
