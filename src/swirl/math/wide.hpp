// SWIRL_WIDE before a function: it is compiled for AVX-512, for AVX2 and for the baseline, and one
// version is chosen when the program starts. It is for loops over columns with independent
// iterations. Every version does the same operations on each element, never fused, so results are
// bitwise identical. If the compiler or a sanitizer does not support this, there is one version.
#pragma once

#if defined(__x86_64__) && defined(__gnu_linux__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define SWIRL_WIDE __attribute__((target_clones("arch=x86-64-v4", "avx2", "default")))
#else
#define SWIRL_WIDE
#endif
