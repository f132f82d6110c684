// The inner loop of cluster_rotation.hpp, compiled once for each width of vector registers
// (cmake/measure.cmake). Whatever the width, eight discs are treated side by side in the same
// operations, exactly rounded and never fused, and the eight partial sums are added in the same
// order; so all widths give the same bits.
//
// Only plain pointers in and doubles out: an inline function of the standard library, compiled here
// for a wide register, could be the copy that the linker keeps for everybody.
#pragma once

#include <cstddef>

#include "physics/real.hpp"
#include "physics/vec2.hpp"

#if defined(__AVX512F__) && defined(__AVX512DQ__)
#define SWIRL_ROTATION_TARGET rotation_avx512
#define SWIRL_ROTATION_REGISTER 64
#elif defined(__AVX2__)
#define SWIRL_ROTATION_TARGET rotation_avx2
#define SWIRL_ROTATION_REGISTER 32
#else
#define SWIRL_ROTATION_TARGET rotation_baseline
#define SWIRL_ROTATION_REGISTER 16
#endif

namespace swirl {

/// The columns of a snapshot.
struct RotationColumns {
    const double *x, *y, *vx, *vy, *held_at, *mass;
    std::ptrdiff_t size;
    double clock;
};

/// What the columns add up to.
struct RotationSums {
    double x, y, vx, vy;     // of the centre of mass
    double individual;       // Σ ϖ_i
    double angular, square;  // Σ r × v, Σ r²
    double least;            // smallest r²
};

using RotationKernel = RotationSums (*)(const RotationColumns&);
namespace rotation_baseline {
RotationSums rotation_sums(const RotationColumns&);
}
namespace rotation_avx2 {
RotationSums rotation_sums(const RotationColumns&);
}
namespace rotation_avx512 {
RotationSums rotation_sums(const RotationColumns&);
}

#if defined(SWIRL_ROTATION_KERNEL)
namespace SWIRL_ROTATION_TARGET {
namespace {

constexpr int lanes = 8;
typedef double Double2 __attribute__((vector_size(16)));
typedef double Double4 __attribute__((vector_size(32)));
typedef double Double8 __attribute__((vector_size(64)));
typedef double Register __attribute__((vector_size(SWIRL_ROTATION_REGISTER)));
typedef double Unaligned
    __attribute__((vector_size(SWIRL_ROTATION_REGISTER), aligned(8), may_alias));

struct Eight {
    static constexpr int parts = 64 / SWIRL_ROTATION_REGISTER;
    static constexpr int per_part = lanes / parts;
    Register part[parts];

    SWIRL_INLINE static Eight all(double value) {
        Eight e;
        for (int p = 0; p < parts; ++p) e.part[p] = value - Register{};
        return e;
    }
    SWIRL_INLINE static Eight load(const double* from) {
        Eight e;
        for (int p = 0; p < parts; ++p)
            e.part[p] = *reinterpret_cast<const Unaligned*>(from + p * per_part);
        return e;
    }
};

#define SWIRL_EIGHT(op)                                                            \
    SWIRL_INLINE Eight operator op(const Eight& a, const Eight& b) {               \
        Eight e;                                                                   \
        for (int p = 0; p < Eight::parts; ++p) e.part[p] = a.part[p] op b.part[p]; \
        return e;                                                                  \
    }
SWIRL_EIGHT(+)
SWIRL_EIGHT(-)
SWIRL_EIGHT(*)
SWIRL_EIGHT(/)
#undef SWIRL_EIGHT

SWIRL_INLINE Eight smaller_of(const Eight& a, const Eight& b) {
    Eight e;
    for (int p = 0; p < Eight::parts; ++p)
        e.part[p] = a.part[p] < b.part[p] ? a.part[p] : b.part[p];
    return e;
}

// Lanes k, k + 2, k + 4, k + 6 are put together, (k + (k + 4)) + ((k + 2) + (k + 6)), whatever the
// register, and then the two that are left.
SWIRL_INLINE Double2 halves(const Double4& e) {
    return __builtin_shufflevector(e, e, 0, 1) + __builtin_shufflevector(e, e, 2, 3);
}
SWIRL_INLINE Double2 halves(const Eight& e) {
#if SWIRL_ROTATION_REGISTER == 16
    return (e.part[0] + e.part[2]) + (e.part[1] + e.part[3]);
#elif SWIRL_ROTATION_REGISTER == 32
    return halves(e.part[0] + e.part[1]);
#else
    const Double8& m = e.part[0];
    return halves(__builtin_shufflevector(m, m, 0, 1, 2, 3) +
                  __builtin_shufflevector(m, m, 4, 5, 6, 7));
#endif
}
/// (sum of a, sum of b).
SWIRL_INLINE Double2 sums(const Eight& a, const Eight& b) {
    const Double2 p = halves(a), q = halves(b);
    return __builtin_shufflevector(p, q, 0, 2) + __builtin_shufflevector(p, q, 1, 3);
}

SWIRL_INLINE double smallest(const Eight& e) {
#if SWIRL_ROTATION_REGISTER == 16
    const Double2 a = e.part[0] < e.part[1] ? e.part[0] : e.part[1];
    const Double2 b = e.part[2] < e.part[3] ? e.part[2] : e.part[3];
#else
#if SWIRL_ROTATION_REGISTER == 32
    const Double4 m = e.part[0] < e.part[1] ? e.part[0] : e.part[1];
#else
    const Double4 lo = __builtin_shufflevector(e.part[0], e.part[0], 0, 1, 2, 3);
    const Double4 hi = __builtin_shufflevector(e.part[0], e.part[0], 4, 5, 6, 7);
    const Double4 m = lo < hi ? lo : hi;
#endif
    const Double2 a = __builtin_shufflevector(m, m, 0, 1);
    const Double2 b = __builtin_shufflevector(m, m, 2, 3);
#endif
    const Double2 two = a < b ? a : b;
    return smaller(two[0], two[1]);
}

struct Discs {
    Eight x, y, vx, vy, mass;
};

SWIRL_INLINE Discs discs(const RotationColumns& c, const Eight& clock, std::ptrdiff_t first) {
    const Eight elapsed = clock - Eight::load(c.held_at + first);
    const Eight vx = Eight::load(c.vx + first), vy = Eight::load(c.vy + first);
    return {Eight::load(c.x + first) + elapsed * vx, Eight::load(c.y + first) + elapsed * vy, vx,
            vy, Eight::load(c.mass + first)};
}

struct Moments {
    Eight mass, x, y, vx, vy;

    SWIRL_INLINE void add(const Discs& d) {
        mass = mass + d.mass;
        x = x + d.mass * d.x;
        y = y + d.mass * d.y;
        vx = vx + d.mass * d.vx;
        vy = vy + d.mass * d.vy;
    }
};

struct Turning {
    Eight cx, cy, cvx, cvy;
    Eight individual, angular, square, least;

    SWIRL_INLINE void add(const Discs& d) {
        const Eight rx = d.x - cx, ry = d.y - cy;
        const Eight l = rx * (d.vy - cvy) - ry * (d.vx - cvx);
        const Eight q = rx * rx + ry * ry;
        individual = individual + l / q;
        angular = angular + l;
        square = square + q;
        least = smaller_of(q, least);
    }
    /// The same where a lane counts (1) or not (0).
    SWIRL_INLINE void add(const Discs& d, const Eight& counts) {
        const Eight nobody = Eight::all(1.0) - counts;
        const Eight rx = (d.x - cx) * counts, ry = (d.y - cy) * counts;
        const Eight l = rx * (d.vy - cvy) - ry * (d.vx - cvx);
        const Eight q = rx * rx + ry * ry;
        individual = individual + l / (q + nobody);
        angular = angular + l;
        square = square + q;
        least = smaller_of(q + nobody * Eight::all(0x1p1000), least);
    }
};

// Lane k of `last_lanes + left` is 1 for the last `left` of eight lanes.
constexpr double last_lanes[2 * lanes] = {0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1};

}  // namespace

/// What is left over of a number of discs that is not a multiple of eight is looked at together
/// with those before it, which then count nothing. So where there are fewer than eight, the columns
/// must be readable for eight in all, the others before the first.
RotationSums rotation_sums(const RotationColumns& columns) {
    const RotationColumns c = columns;
    const std::ptrdiff_t left = c.size % lanes, whole = c.size - left, last = c.size - lanes;
    const Eight clock = Eight::all(c.clock);
    const Eight zero = Eight::all(0.0);

    Moments m{zero, zero, zero, zero, zero};
    for (std::ptrdiff_t i = 0; i < whole; i += lanes) m.add(discs(c, clock, i));
    if (left > 0) {
        Discs d = discs(c, clock, last);
        d.mass = d.mass * Eight::load(last_lanes + left);
        m.add(d);
    }
    const Double2 mass = sums(m.mass, m.mass);
    const Double2 r = sums(m.x, m.y) / mass, v = sums(m.vx, m.vy) / mass;

    Turning t{
        Eight::all(r[0]),    Eight::all(r[1]), Eight::all(v[0]), Eight::all(v[1]), zero, zero, zero,
        Eight::all(0x1p1000)};
    for (std::ptrdiff_t i = 0; i < whole; i += lanes) t.add(discs(c, clock, i));
    if (left > 0) t.add(discs(c, clock, last), Eight::load(last_lanes + left));

    const Double2 a = sums(t.individual, t.angular), b = sums(t.square, t.square);
    return {r[0], r[1], v[0], v[1], a[0], a[1], b[0], smallest(t.least)};
}

}  // namespace SWIRL_ROTATION_TARGET
#endif

}  // namespace swirl
