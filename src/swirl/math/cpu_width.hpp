// The vector instructions of this processor. The event loop, the averages over events and the
// benchmark are compiled once for each width, and the widest is chosen at run time. Every width
// gives bitwise identical results.
#pragma once

#include <cstdint>

// Defined if code for AVX2, and for AVX-512, is part of this build (cmake/options.cmake).
#if defined(__x86_64__) && !defined(SWIRL_BASELINE_ONLY) && !defined(SWIRL_WITHOUT_AVX2)
#define SWIRL_HAS_AVX2 1
#endif
#if defined(__x86_64__) && !defined(SWIRL_BASELINE_ONLY) && !defined(SWIRL_WITHOUT_AVX512)
#define SWIRL_HAS_AVX512 1
#endif

namespace swirl {

/// `best` is the widest that this processor supports.
enum class Width : std::uint8_t { best, baseline, avx2, avx512 };

/// Every processor that the program is built for supports the baseline; on x86-64 it is SSE2.
#if defined(__x86_64__)
inline constexpr const char* baseline_name = "sse2";
#else
inline constexpr const char* baseline_name = "baseline";
#endif

/// True if this build has code of that width and this processor can run it.
inline bool has_width(Width width) {
#if defined(SWIRL_HAS_AVX512)
    if (width == Width::avx512)
        return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
               __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw");
#endif
#if defined(SWIRL_HAS_AVX2)
    if (width == Width::avx2) return __builtin_cpu_supports("avx2");
#endif
    return width == Width::baseline || width == Width::best;
}

/// The width itself; for `best`, the widest that this processor supports.
inline Width width_meant(Width width) {
    if (width != Width::best) return width;
    return has_width(Width::avx512) ? Width::avx512
           : has_width(Width::avx2) ? Width::avx2
                                    : Width::baseline;
}

}  // namespace swirl
