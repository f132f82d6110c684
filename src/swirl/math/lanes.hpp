// Vectors of doubles: physics that is written once computes several contact times at a time.
//
// `Lanes<W>` holds W doubles in registers of the target. For W = 8 these are one with AVX-512, two
// with AVX2, four with SSE2, and eight plain doubles elsewhere. Every operation is the same
// operation on each lane, exactly rounded and never fused, so all targets give bitwise identical
// results.
//
// Everything here is in an inline namespace named after the target, because one program contains
// several (engine/event_loop.hpp is compiled once for each).
#pragma once

#include <cstdint>
#if defined(__SSE2__)
#include <immintrin.h>
#endif

#include "swirl/math/real.hpp"

#if defined(__AVX512VL__) && defined(__AVX512DQ__) && defined(__AVX512BW__)
#define SWIRL_TARGET avx512
#define SWIRL_REGISTER_BYTES 64
#elif defined(__AVX2__)
#define SWIRL_TARGET avx2
#define SWIRL_REGISTER_BYTES 32
#else
#define SWIRL_TARGET baseline
#define SWIRL_REGISTER_BYTES 16
#endif

namespace swirl {
inline namespace SWIRL_TARGET {

// Makes the scalar functions of real.hpp visible next to the overloads for lanes below.
using ::swirl::select;
using ::swirl::smaller;
using ::swirl::square_root;

// A vector of doubles may alias doubles in memory and nothing else (GCC gives it the alias set of
// its element). So after a row was written, the compiler need not read every pointer again.
typedef double Double2 __attribute__((vector_size(16)));
typedef double Double4 __attribute__((vector_size(32)));
typedef double Double8 __attribute__((vector_size(64)));
typedef std::int64_t Mask2 __attribute__((vector_size(16)));
typedef std::int64_t Mask4 __attribute__((vector_size(32)));
typedef std::int64_t Mask8 __attribute__((vector_size(64)));

template <int Bytes>
struct Register;
template <>
struct Register<16> {
    using Real = Double2;
    using Mask = Mask2;
};
template <>
struct Register<32> {
    using Real = Double4;
    using Mask = Mask4;
};
template <>
struct Register<64> {
    using Real = Double8;
    using Mask = Mask8;
};

template <int W>
struct LaneMask {
    static constexpr int bytes = 8 * W < SWIRL_REGISTER_BYTES ? 8 * W : SWIRL_REGISTER_BYTES;
    static constexpr int parts = 8 * W / bytes;
    typename Register<bytes>::Mask part[parts];
};

template <int W>
struct Lanes {
    static constexpr int bytes = LaneMask<W>::bytes;
    static constexpr int parts = LaneMask<W>::parts;
    static constexpr int per_part = bytes / 8;
    using Part = typename Register<bytes>::Real;
    Part part[parts];

    Lanes() = default;
    SWIRL_INLINE explicit Lanes(double x) {
        for (int p = 0; p < parts; ++p) part[p] = x - Part{};
    }
    /// Loads W doubles from memory aligned to 8W bytes.
    SWIRL_INLINE static Lanes load(const double* from) {
        Lanes r;
        for (int p = 0; p < parts; ++p)
            r.part[p] = *reinterpret_cast<const Part*>(from + p * per_part);
        return r;
    }
    SWIRL_INLINE void store(double* to) const {
        for (int p = 0; p < parts; ++p) *reinterpret_cast<Part*>(to + p * per_part) = part[p];
    }
};

SWIRL_INLINE Lanes<2> two_lanes(double a, double b) {
    Lanes<2> r;
    r.part[0] = Double2{a, b};
    return r;
}

/// Converts one pair of doubles, or two pairs, to a vector.
SWIRL_INLINE Lanes<2> joined(const Double2 (&pairs)[1]) {
    Lanes<2> r;
    r.part[0] = pairs[0];
    return r;
}
SWIRL_INLINE Lanes<4> joined(const Double2 (&pairs)[2]) {
    Lanes<4> r;
#if SWIRL_REGISTER_BYTES >= 32
    r.part[0] = __builtin_shufflevector(pairs[0], pairs[1], 0, 1, 2, 3);
#else
    r.part[0] = pairs[0];
    r.part[1] = pairs[1];
#endif
    return r;
}

#define SWIRL_LANES_BINARY(op)                                                        \
    template <int W>                                                                  \
    SWIRL_INLINE Lanes<W> operator op(const Lanes<W>& a, const Lanes<W>& b) {         \
        Lanes<W> r;                                                                   \
        for (int p = 0; p < Lanes<W>::parts; ++p) r.part[p] = a.part[p] op b.part[p]; \
        return r;                                                                     \
    }
SWIRL_LANES_BINARY(+)
SWIRL_LANES_BINARY(-)
SWIRL_LANES_BINARY(*)
SWIRL_LANES_BINARY(/)
#undef SWIRL_LANES_BINARY

template <int W>
SWIRL_INLINE Lanes<W> operator-(const Lanes<W>& a) {
    Lanes<W> r;
    for (int p = 0; p < Lanes<W>::parts; ++p) r.part[p] = -a.part[p];
    return r;
}

#define SWIRL_LANES_COMPARE(op)                                                       \
    template <int W>                                                                  \
    SWIRL_INLINE LaneMask<W> operator op(const Lanes<W>& a, const Lanes<W>& b) {      \
        LaneMask<W> r;                                                                \
        for (int p = 0; p < Lanes<W>::parts; ++p) r.part[p] = a.part[p] op b.part[p]; \
        return r;                                                                     \
    }
SWIRL_LANES_COMPARE(<)
SWIRL_LANES_COMPARE(>)
SWIRL_LANES_COMPARE(>=)
SWIRL_LANES_COMPARE(==)
#undef SWIRL_LANES_COMPARE

template <int W>
SWIRL_INLINE LaneMask<W> operator&(const LaneMask<W>& a, const LaneMask<W>& b) {
    LaneMask<W> r;
    for (int p = 0; p < LaneMask<W>::parts; ++p) r.part[p] = a.part[p] & b.part[p];
    return r;
}

template <int W>
SWIRL_INLINE Lanes<W> select(const LaneMask<W>& condition, const Lanes<W>& yes,
                             const Lanes<W>& no) {
    Lanes<W> r;
    for (int p = 0; p < Lanes<W>::parts; ++p)
        r.part[p] = condition.part[p] ? yes.part[p] : no.part[p];
    return r;
}

#if defined(__SSE2__)
SWIRL_INLINE Double2 square_root_of(Double2 a) { return _mm_sqrt_pd(a); }
#if SWIRL_REGISTER_BYTES >= 32
SWIRL_INLINE Double4 square_root_of(Double4 a) { return _mm256_sqrt_pd(a); }
#endif
#if SWIRL_REGISTER_BYTES >= 64
SWIRL_INLINE Double8 square_root_of(Double8 a) { return _mm512_sqrt_pd(a); }
#endif
#else
SWIRL_INLINE Double2 square_root_of(Double2 a) {
    return Double2{square_root(a[0]), square_root(a[1])};
}
#endif

template <int W>
SWIRL_INLINE Lanes<W> square_root(const Lanes<W>& a) {
    Lanes<W> r;
    for (int p = 0; p < Lanes<W>::parts; ++p) r.part[p] = square_root_of(a.part[p]);
    return r;
}

// smaller() of real.hpp, as one instruction: minpd is (a < b) ? a : b.
#if defined(__SSE2__)
SWIRL_INLINE Double2 smaller_of(Double2 a, Double2 b) { return _mm_min_pd(a, b); }
#if SWIRL_REGISTER_BYTES >= 32
SWIRL_INLINE Double4 smaller_of(Double4 a, Double4 b) { return _mm256_min_pd(a, b); }
#endif
#if SWIRL_REGISTER_BYTES >= 64
SWIRL_INLINE Double8 smaller_of(Double8 a, Double8 b) { return _mm512_min_pd(a, b); }
#endif
#else
SWIRL_INLINE Double2 smaller_of(Double2 a, Double2 b) { return a < b ? a : b; }
#endif

template <int W>
SWIRL_INLINE Lanes<W> smaller(const Lanes<W>& a, const Lanes<W>& b) {
    Lanes<W> r;
    for (int p = 0; p < Lanes<W>::parts; ++p) r.part[p] = smaller_of(a.part[p], b.part[p]);
    return r;
}

/// The smallest lane, for times (no NaN, no −0). It is a vector operation to the end, because for
/// two numbers the compiler might use a branch.
SWIRL_INLINE double smallest_of(Double2 a) {
    return smaller_of(a, __builtin_shufflevector(a, a, 1, 1))[0];
}
#if SWIRL_REGISTER_BYTES >= 32
SWIRL_INLINE double smallest_of(Double4 a) {
    return smallest_of(
        smaller_of(__builtin_shufflevector(a, a, 0, 1), __builtin_shufflevector(a, a, 2, 3)));
}
#endif
#if SWIRL_REGISTER_BYTES >= 64
SWIRL_INLINE double smallest_of(Double8 a) {
    return smallest_of(smaller_of(__builtin_shufflevector(a, a, 0, 1, 2, 3),
                                  __builtin_shufflevector(a, a, 4, 5, 6, 7)));
}
#endif
template <int W>
SWIRL_INLINE double smallest(const Lanes<W>& a) {
    typename Lanes<W>::Part m = a.part[0];
    for (int p = 1; p < Lanes<W>::parts; ++p) m = smaller_of(m, a.part[p]);
    return smallest_of(m);
}

/// Bit k is set where lane k of `a` equals x.
template <int W>
SWIRL_INLINE unsigned lanes_equal(const Lanes<W>& a, double x) {
    unsigned bits = 0;
    for (int p = 0; p < Lanes<W>::parts; ++p) {
        unsigned part_bits = 0;
#if SWIRL_REGISTER_BYTES >= 64
        if constexpr (Lanes<W>::bytes == 64)
            part_bits = _mm512_cmp_pd_mask(a.part[p], _mm512_set1_pd(x), _CMP_EQ_OQ);
#endif
#if SWIRL_REGISTER_BYTES >= 32
        if constexpr (Lanes<W>::bytes == 32)
            part_bits = static_cast<unsigned>(
                _mm256_movemask_pd(_mm256_cmp_pd(a.part[p], _mm256_set1_pd(x), _CMP_EQ_OQ)));
#endif
        if constexpr (Lanes<W>::bytes == 16) {
#if defined(__SSE2__)
            part_bits =
                static_cast<unsigned>(_mm_movemask_pd(_mm_cmpeq_pd(a.part[p], _mm_set1_pd(x))));
#else
            part_bits = (a.part[p][0] == x ? 1u : 0u) | (a.part[p][1] == x ? 2u : 0u);
#endif
        }
        bits |= part_bits << (p * Lanes<W>::per_part);
    }
    return bits;
}

/// Bit 8g + k is set where lane k of a[g] equals x.
template <int G>
SWIRL_INLINE std::uint64_t lanes_equal(const Lanes<8> (&a)[G], double x) {
#if SWIRL_REGISTER_BYTES >= 64
    // The first four are combined in mask registers, where they are computed.
    const Double8 y = _mm512_set1_pd(x);
    const auto equal = [&](int g) {
        return g < G ? _mm512_cmp_pd_mask(a[g].part[0], y, _CMP_EQ_OQ) : __mmask8{0};
    };
    const __mmask16 low = _mm512_kunpackb(equal(1), equal(0));
    std::uint64_t bits = G <= 2 ? low : _mm512_kunpackw(_mm512_kunpackb(equal(3), equal(2)), low);
    for (int g = 4; g < G; ++g) bits |= static_cast<std::uint64_t>(equal(g)) << (8 * g);
    return bits;
#else
    std::uint64_t bits = 0;
    for (int g = 0; g < G; ++g) bits |= static_cast<std::uint64_t>(lanes_equal(a[g], x)) << (8 * g);
    return bits;
#endif
}

/// Bit k is set where from[k] < x, k < 8; `from` is aligned.
SWIRL_INLINE unsigned lanes_below(const double* from, double x) {
    const Lanes<8> a = Lanes<8>::load(from);
    unsigned bits = 0;
    for (int p = 0; p < Lanes<8>::parts; ++p) {
#if SWIRL_REGISTER_BYTES >= 64
        bits |= _mm512_cmp_pd_mask(a.part[p], _mm512_set1_pd(x), _CMP_LT_OQ);
#elif SWIRL_REGISTER_BYTES >= 32
        bits |= static_cast<unsigned>(
                    _mm256_movemask_pd(_mm256_cmp_pd(a.part[p], _mm256_set1_pd(x), _CMP_LT_OQ)))
                << (4 * p);
#elif defined(__SSE2__)
        bits |= static_cast<unsigned>(_mm_movemask_pd(_mm_cmplt_pd(a.part[p], _mm_set1_pd(x))))
                << (2 * p);
#else
        bits |= ((a.part[p][0] < x ? 1u : 0u) | (a.part[p][1] < x ? 2u : 0u)) << (2 * p);
#endif
    }
    return bits;
}

/// Bit k is set where gap[k] − reach[k] < x, k < 8; both are aligned.
SWIRL_INLINE unsigned lanes_closer(const double* gap, const double* reach, double x) {
    alignas(64) double need[8];
    (Lanes<8>::load(gap) - Lanes<8>::load(reach)).store(need);
    return lanes_below(need, x);
}

/// The index of k in a list of disc numbers, whose capacity is a multiple of 4. The list must
/// contain k.
SWIRL_INLINE std::uint32_t index_in_list(const std::uint32_t* list, std::uint32_t capacity,
                                         std::uint32_t k) {
#if defined(__SSE2__)
    const __m128i target = _mm_set1_epi32(static_cast<int>(k));
    // Compares all of a short list, because a branch that stops at k would be mispredicted.
    for (std::uint32_t begin = 0; begin < capacity; begin += 64) {
        std::uint64_t bits = 0;
        for (std::uint32_t slot = 0; slot < 64 && begin + slot < capacity; slot += 4) {
            const __m128i four =
                _mm_loadu_si128(reinterpret_cast<const __m128i*>(list + begin + slot));
            const int equal = _mm_movemask_ps(_mm_castsi128_ps(_mm_cmpeq_epi32(four, target)));
            bits |= static_cast<std::uint64_t>(static_cast<unsigned>(equal)) << slot;
        }
        if (bits != 0) return begin + static_cast<std::uint32_t>(__builtin_ctzll(bits));
    }
    return 0;
#else
    std::uint32_t slot = 0;
    while (list[slot] != k && slot + 1 < capacity) ++slot;
    return slot;
#endif
}

/// The vector with lane k replaced by x.
template <int W>
SWIRL_INLINE Lanes<W> with_lane(const Lanes<W>& a, unsigned k, double x) {
    Lanes<W> r;
    for (int p = 0; p < Lanes<W>::parts; ++p) {
        typename Register<Lanes<W>::bytes>::Mask number;
        for (int l = 0; l < Lanes<W>::per_part; ++l) number[l] = p * Lanes<W>::per_part + l;
        const auto here = number == (static_cast<std::int64_t>(k) - decltype(number){});
        r.part[p] = here ? (x - typename Lanes<W>::Part{}) : a.part[p];
    }
    return r;
}

/// Sets number k in a row of W doubles to x, or to the smaller of both. Only the register that
/// holds it is read and written.
template <int W>
SWIRL_INLINE void set_lane(double* row, unsigned k, double x) {
    constexpr unsigned width = Lanes<W>::per_part;
    double* const part = row + (k & ~(width - 1));
    with_lane(Lanes<width>::load(part), k & (width - 1), x).store(part);
}
template <int W>
SWIRL_INLINE void lower_lane(double* row, unsigned k, double x) {
    constexpr unsigned width = Lanes<W>::per_part;
    double* const part = row + (k & ~(width - 1));
    smaller(with_lane(Lanes<width>(never), k & (width - 1), x), Lanes<width>::load(part))
        .store(part);
}

#if SWIRL_REGISTER_BYTES >= 32
SWIRL_INLINE Double4 joined(const double* a, const double* b) {
    return _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_load_pd(a)), _mm_load_pd(b), 1);
}
#endif
#if SWIRL_REGISTER_BYTES >= 64
SWIRL_INLINE Double8 joined(const Double4& a, const Double4& b) {
    return _mm512_insertf64x4(_mm512_castpd256_pd512(a), b, 1);
}
#endif

/// Two columns from W rows that each start with a pair of doubles: rows[k] → (first[k], second[k]).
/// Pairs are loaded as a whole. A pair that was just stored as a whole is then forwarded from the
/// store buffer.
template <int W>
SWIRL_INLINE void load_pairs(const double* const (&rows)[W], Lanes<W>& first, Lanes<W>& second) {
    for (int p = 0; p < Lanes<W>::parts; ++p) {
        const double* const* const row = rows + p * Lanes<W>::per_part;
        if constexpr (Lanes<W>::bytes == 16) {
            const Double2 a = *reinterpret_cast<const Double2*>(row[0]);
            const Double2 b = *reinterpret_cast<const Double2*>(row[1]);
            first.part[p] = __builtin_shufflevector(a, b, 0, 2);
            second.part[p] = __builtin_shufflevector(a, b, 1, 3);
        }
#if SWIRL_REGISTER_BYTES >= 32
        if constexpr (Lanes<W>::bytes == 32) {
            const Double4 a = joined(row[0], row[2]), b = joined(row[1], row[3]);
            first.part[p] = _mm256_unpacklo_pd(a, b);
            second.part[p] = _mm256_unpackhi_pd(a, b);
        }
#endif
#if SWIRL_REGISTER_BYTES >= 64
        if constexpr (Lanes<W>::bytes == 64) {
            const Double8 a = joined(joined(row[0], row[2]), joined(row[4], row[6]));
            const Double8 b = joined(joined(row[1], row[3]), joined(row[5], row[7]));
            first.part[p] = _mm512_unpacklo_pd(a, b);
            second.part[p] = _mm512_unpackhi_pd(a, b);
        }
#endif
    }
}

/// Four columns from W rows that each start with four doubles, stored and loaded as a whole.
SWIRL_INLINE void store_four(double* to, double a, double b, double c, double d) {
#if SWIRL_REGISTER_BYTES >= 32
    *reinterpret_cast<Double4*>(to) = Double4{a, b, c, d};
#else
    *reinterpret_cast<Double2*>(to) = Double2{a, b};
    *reinterpret_cast<Double2*>(to + 2) = Double2{c, d};
#endif
}
template <int W>
SWIRL_INLINE void load_fours(const double* const (&rows)[W], Lanes<W> (&columns)[4]) {
    if constexpr (Lanes<W>::bytes == 16) {
        const double* halves[W];
        for (int k = 0; k < W; ++k) halves[k] = rows[k] + 2;
        load_pairs<W>(rows, columns[0], columns[1]);
        load_pairs<W>(halves, columns[2], columns[3]);
    }
#if SWIRL_REGISTER_BYTES >= 32
    const auto four = [&](int k) { return *reinterpret_cast<const Double4*>(rows[k]); };
    if constexpr (Lanes<W>::bytes == 32) {
        for (int p = 0; p < Lanes<W>::parts; ++p) {
            const Double4 a = four(4 * p), b = four(4 * p + 1);
            const Double4 c = four(4 * p + 2), d = four(4 * p + 3);
            const Double4 ab0 = _mm256_unpacklo_pd(a, b), ab1 = _mm256_unpackhi_pd(a, b);
            const Double4 cd0 = _mm256_unpacklo_pd(c, d), cd1 = _mm256_unpackhi_pd(c, d);
            columns[0].part[p] = _mm256_permute2f128_pd(ab0, cd0, 0x20);
            columns[1].part[p] = _mm256_permute2f128_pd(ab1, cd1, 0x20);
            columns[2].part[p] = _mm256_permute2f128_pd(ab0, cd0, 0x31);
            columns[3].part[p] = _mm256_permute2f128_pd(ab1, cd1, 0x31);
        }
    }
#endif
#if SWIRL_REGISTER_BYTES >= 64
    if constexpr (Lanes<W>::bytes == 64) {
        const Double8 a = joined(four(0), four(2)), b = joined(four(1), four(3));
        const Double8 c = joined(four(4), four(6)), d = joined(four(5), four(7));
        const Double8 ab0 = _mm512_unpacklo_pd(a, b), ab1 = _mm512_unpackhi_pd(a, b);
        const Double8 cd0 = _mm512_unpacklo_pd(c, d), cd1 = _mm512_unpackhi_pd(c, d);
        columns[0].part[0] = _mm512_shuffle_f64x2(ab0, cd0, 0x88);
        columns[1].part[0] = _mm512_shuffle_f64x2(ab1, cd1, 0x88);
        columns[2].part[0] = _mm512_shuffle_f64x2(ab0, cd0, 0xdd);
        columns[3].part[0] = _mm512_shuffle_f64x2(ab1, cd1, 0xdd);
    }
#endif
}

/// Three columns from eight rows that each start with four floats. This is done in registers: eight
/// numbers that are stored one by one and loaded as a vector would first have to leave the store
/// buffer.
SWIRL_INLINE void load_three(const float* const (&rows)[8], Lanes<8>& a, Lanes<8>& b, Lanes<8>& c) {
    typedef float Float4 __attribute__((vector_size(16), may_alias));
    const auto row = [&](int k) { return *reinterpret_cast<const Float4*>(rows[k]); };
    Float4 columns[3][2];
    for (int half = 0; half < 2; ++half) {
        const Float4 r0 = row(4 * half), r1 = row(4 * half + 1);
        const Float4 r2 = row(4 * half + 2), r3 = row(4 * half + 3);
        const Float4 low01 = __builtin_shufflevector(r0, r1, 0, 4, 1, 5);
        const Float4 low23 = __builtin_shufflevector(r2, r3, 0, 4, 1, 5);
        const Float4 high01 = __builtin_shufflevector(r0, r1, 2, 6, 3, 7);
        const Float4 high23 = __builtin_shufflevector(r2, r3, 2, 6, 3, 7);
        columns[0][half] = __builtin_shufflevector(low01, low23, 0, 1, 4, 5);
        columns[1][half] = __builtin_shufflevector(low01, low23, 2, 3, 6, 7);
        columns[2][half] = __builtin_shufflevector(high01, high23, 0, 1, 4, 5);
    }
    const auto in_double = [](const Float4(&halves)[2]) {
        Lanes<8> r;
#if SWIRL_REGISTER_BYTES >= 64
        r.part[0] =
            _mm512_cvtps_pd(__builtin_shufflevector(halves[0], halves[1], 0, 1, 2, 3, 4, 5, 6, 7));
#elif SWIRL_REGISTER_BYTES >= 32
        for (int p = 0; p < 2; ++p) r.part[p] = _mm256_cvtps_pd(halves[p]);
#else
        for (int p = 0; p < 4; ++p)
            r.part[p] = Double2{halves[p / 2][p % 2 * 2], halves[p / 2][p % 2 * 2 + 1]};
#endif
        return r;
    };
    a = in_double(columns[0]);
    b = in_double(columns[1]);
    c = in_double(columns[2]);
}

/// Lane k.
template <int W>
SWIRL_INLINE double lane(const Lanes<W>& a, int k) {
    return a.part[k / Lanes<W>::per_part][k % Lanes<W>::per_part];
}

/// The number of doubles below x among the first `count`, a multiple of 8. `from` is aligned.
SWIRL_INLINE unsigned count_below(const double* from, unsigned count, double x) {
    unsigned below = 0;
    for (unsigned k = 0; k < count; k += 8) below += __builtin_popcount(lanes_below(from + k, x));
    return below;
}

}  // namespace SWIRL_TARGET
}  // namespace swirl
