// SWIRL_WIDE before a function: compiled for AVX-512, for AVX2 and for whatever processor there is,
// and chosen when the program starts. For loops over columns whose iterations do not depend on each
// other: the same operations on each element, never fused, so all give the same bits. Where the
// compiler or a sanitizer does not go along, it is compiled once.
#pragma once

#if defined(__x86_64__) && defined(__gnu_linux__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define SWIRL_WIDE __attribute__((target_clones("arch=x86-64-v4", "avx2", "default")))
#else
#define SWIRL_WIDE
#endif
