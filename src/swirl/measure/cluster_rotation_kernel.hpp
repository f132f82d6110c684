// The inner loop of cluster_rotation.hpp, compiled once for each width of vector registers
// (cmake/engine.cmake). For every width, eight discs are processed in parallel by the same
// operations, exactly rounded and never fused, and the eight partial sums are added in the same
// order. So all widths give bitwise the same result.
//
// The interface has only plain pointers and doubles. An inline function of the standard library,
// compiled here for a wide register, could be the copy that the linker keeps for the whole program,
// and crash processors without that register.
#pragma once

#include <cstddef>

#include "swirl/math/real.hpp"
#include "swirl/math/vec2.hpp"
#include "swirl/physics/disc.hpp"
#include "swirl/physics/rotation_follower.hpp"

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

namespace rotation_baseline {
extern const RotationKernel kernel;
}
namespace rotation_avx2 {
extern const RotationKernel kernel;
}
namespace rotation_avx512 {
extern const RotationKernel kernel;
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
    /// The first `count` < 8 lanes; the others are 0, and their memory is not read.
    SWIRL_INLINE static Eight load_first(const double* from, std::ptrdiff_t count) {
#if SWIRL_ROTATION_REGISTER == 64
        const auto mask = static_cast<unsigned char>((1u << count) - 1u);
        return {{__builtin_ia32_loadupd512_mask(from, Register{}, mask)}};
#else
        double all[lanes] = {};
        for (std::ptrdiff_t k = 0; k < count; ++k) all[k] = from[k];
        return load(all);
#endif
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

/// `value` where `square` is above the limit, elsewhere NaN.
SWIRL_INLINE Eight where_above(const Eight& square, double limit, const Eight& value) {
    Eight e;
    for (int p = 0; p < Eight::parts; ++p)
        e.part[p] =
            square.part[p] > limit - Register{} ? value.part[p] : __builtin_nan("") - Register{};
    return e;
}

// Adds lanes k and k + 4, then of these four 0 and 1, 2 and 3, then the remaining two:
// ((0 + 4) + (1 + 5)) + ((2 + 6) + (3 + 7)), for every register width.
#if SWIRL_ROTATION_REGISTER == 16
SWIRL_INLINE Double2 sums_of_two(const Double2& a, const Double2& b) {
    return __builtin_shufflevector(a, b, 0, 2) + __builtin_shufflevector(a, b, 1, 3);
}
/// (sum of a, sum of b).
SWIRL_INLINE Double2 sums(const Eight& a, const Eight& b) {
    return sums_of_two(a.part[0] + a.part[2], b.part[0] + b.part[2]) +
           sums_of_two(a.part[1] + a.part[3], b.part[1] + b.part[3]);
}
#else
SWIRL_INLINE Double4 halves(const Eight& e) {
#if SWIRL_ROTATION_REGISTER == 32
    return e.part[0] + e.part[1];
#else
    return __builtin_shufflevector(e.part[0], e.part[0], 0, 1, 2, 3) +
           __builtin_shufflevector(e.part[0], e.part[0], 4, 5, 6, 7);
#endif
}
SWIRL_INLINE Double2 sums(const Eight& a, const Eight& b) {
    const Double4 p = halves(a), q = halves(b);
    const Double4 pairs =
        __builtin_shufflevector(p, q, 0, 4, 2, 6) + __builtin_shufflevector(p, q, 1, 5, 3, 7);
    return __builtin_shufflevector(pairs, pairs, 0, 1) +
           __builtin_shufflevector(pairs, pairs, 2, 3);
}
#endif

struct Discs {
    Eight x, y, vx, vy;
};

/// As in Snapshot::position() and velocity().
template <bool accelerated>
SWIRL_INLINE Discs discs(const RotationColumns& c, const Eight& clock, std::ptrdiff_t first) {
    const Eight elapsed = clock - Eight::load(c.held_at + first);
    const Eight vx = Eight::load(c.vx + first), vy = Eight::load(c.vy + first);
    Discs d{Eight::load(c.x + first) + elapsed * vx, Eight::load(c.y + first) + elapsed * vy, vx,
            vy};
    if constexpr (accelerated) {
        const Eight x = Eight::load(c.ax + first), y = Eight::load(c.ay + first);
        const Eight half_square = Eight::all(0.5) * elapsed * elapsed;
        d.x = d.x + half_square * x;
        d.y = d.y + half_square * y;
        d.vx = d.vx + elapsed * x;
        d.vy = d.vy + elapsed * y;
    }
    return d;
}

struct Moments {
    Eight mass, x, y, vx, vy;

    SWIRL_INLINE void add(const Discs& d, const Eight& m) {
        mass = mass + m;
        x = x + m * d.x;
        y = y + m * d.y;
        vx = vx + m * d.vx;
        vy = vy + m * d.vy;
    }
};

/// A disc relative to the centre of mass: l = r × v and q = r².
struct Arm {
    Eight l, q;
};

struct Centre {
    Eight x, y, vx, vy;

    SWIRL_INLINE Centre(const RotationCentre& c, const Eight& clock)
        : vx(Eight::all(c.velocity.x)), vy(Eight::all(c.velocity.y)) {
        const Eight elapsed = clock - Eight::all(c.held_at);
        x = Eight::all(c.position.x) + elapsed * vx;
        y = Eight::all(c.position.y) + elapsed * vy;
    }
    SWIRL_INLINE Arm arm(const Discs& d) const {
        const Eight rx = d.x - x, ry = d.y - y;
        // Signs such that an instruction can take the disc's velocity from memory.
        return {ry * (vx - d.vx) - rx * (vy - d.vy), rx * rx + ry * ry};
    }
};

/// The partial sums over discs, and the smallest r².
struct RateSums {
    Eight individual, angular, square, minimum;

    SWIRL_INLINE explicit RateSums(const Arm& a)
        : individual(a.l / a.q), angular(a.l), square(a.q), minimum(a.q) {}
    SWIRL_INLINE void add(const Arm& a) {
        individual = individual + a.l / a.q;
        angular = angular + a.l;
        square = square + a.q;
        minimum = smaller_of(a.q, minimum);
    }
    /// Adds two discs per lane with a single division.
    SWIRL_INLINE void add(const Arm& a, const Arm& b) {
        individual = individual + (a.l * b.q + b.l * a.q) / (a.q * b.q);
        angular = (angular + a.l) + b.l;
        square = (square + a.q) + b.q;
        minimum = smaller_of(b.q, smaller_of(a.q, minimum));
    }
    /// `counts` is 1 for a lane that counts and 0 for one that was added before.
    SWIRL_INLINE void add(const Arm& a, const Eight& counts) {
        const Eight l = a.l * counts;
        individual = individual + l / a.q;
        angular = angular + l;
        square = square + a.q * counts;
        minimum = smaller_of(a.q, minimum);
    }
};

// Lane k of `last_lanes + left` is 1 for the last `left` of eight lanes.
constexpr double last_lanes[2 * lanes] = {0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1};

// Lane k of `first_lanes + lanes - count` is 1 for the first `count` of eight lanes, and that of
// `far_lanes + lanes - count` is 0 there.
constexpr double first_lanes[2 * lanes] = {1, 1, 1, 1, 1, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0};
constexpr double far = 0x1p900;
constexpr double far_lanes[2 * lanes] = {0,   0,   0,   0,   0,   0,   0,   0,
                                         far, far, far, far, far, far, far, far};

/// If the number of discs is not a multiple of eight, the last `left` discs are loaded together
/// with those before them, which then have weight 0.
struct Rows {
    std::ptrdiff_t left, whole, last;

    SWIRL_INLINE explicit Rows(std::ptrdiff_t size)
        : left(size & (lanes - 1)), whole(size - left), last(size - lanes) {}
    SWIRL_INLINE Eight counts() const { return Eight::load(last_lanes + left); }
};

template <bool accelerated>
SWIRL_INLINE RotationCentre centre_of(const RotationColumns& c, const double* mass,
                                      std::ptrdiff_t size, double clock_now) {
    const Rows rows(size);
    const Eight clock = Eight::all(clock_now), zero = Eight::all(0.0);
    Moments m{zero, zero, zero, zero, zero};
    for (std::ptrdiff_t i = 0; i < rows.whole; i += lanes)
        m.add(discs<accelerated>(c, clock, i), Eight::load(mass + i));
    if (rows.left > 0)
        m.add(discs<accelerated>(c, clock, rows.last),
              Eight::load(mass + rows.last) * rows.counts());
    const Double2 all = sums(m.mass, m.mass);
    const Double2 r = sums(m.x, m.y) / all, v = sums(m.vx, m.vy) / all;
    return {size, clock_now, all[0], {r[0], r[1]}, {v[0], v[1]}};
}

template <bool accelerated>
SWIRL_INLINE RotationRates rates_of(const RotationColumns& c, const RotationCentre& about,
                                    double clock_now, double closest_square) {
    const Rows rows(about.discs);
    const Eight clock = Eight::all(clock_now);
    const Centre centre_of_mass(about, clock);
    const auto arm = [&](std::ptrdiff_t i) __attribute__((always_inline)) {
        return centre_of_mass.arm(discs<accelerated>(c, clock, i));
    };
    RateSums t(arm(0));
    std::ptrdiff_t i = lanes;
    for (; i + lanes < rows.whole; i += 2 * lanes) t.add(arm(i), arm(i + lanes));
    if (i < rows.whole) t.add(arm(i));
    if (rows.left > 0) t.add(arm(rows.last), rows.counts());
    t.individual = where_above(t.minimum, closest_square, t.individual);
    const Double2 above = sums(t.individual, t.angular);
    const Double2 below{static_cast<double>(about.discs), sums(t.square, t.square)[0]};
    return above / below;
}

/// The other lanes are far away, so they change no sum and not the minimum.
SWIRL_INLINE RotationRates rates_of_few_discs(const RotationColumns& c, const RotationCentre& about,
                                              double clock_now, double closest_square) {
    const auto load = [&](const double* column) __attribute__((always_inline)) {
        return Eight::load_first(column, about.discs);
    };
    const Eight clock = Eight::all(clock_now), elapsed = clock - load(c.held_at);
    const Eight vx = load(c.vx), vy = load(c.vy);
    const Discs discs{load(c.x) + elapsed * vx, load(c.y) + elapsed * vy, vx, vy};
    const Eight counts = Eight::load(first_lanes + lanes - about.discs);
    const Eight far_away = Eight::load(far_lanes + lanes - about.discs);
    Arm arm = Centre(about, clock).arm(discs);
    arm.l = arm.l * counts;
    const Eight individual = arm.l / (arm.q + far_away), minimum = arm.q + far_away;
    const Double2 above = sums(where_above(minimum, closest_square, individual), arm.l);
    const Double2 below{static_cast<double>(about.discs), sums(arm.q * counts, arm.q * counts)[0]};
    return above / below;
}

// One disc after the other: for fewer than eight discs, and if a disc on the centre of mass must be
// omitted.

SWIRL_INLINE Flight<double> disc_at(const RotationColumns& c, std::ptrdiff_t i, double clock) {
    const double elapsed = clock - c.held_at[i];
    const Flight<double> d{
        {c.x[i] + elapsed * c.vx[i], c.y[i] + elapsed * c.vy[i]}, {c.vx[i], c.vy[i]}, clock};
    if (c.ax == nullptr) return d;
    const double half_square = 0.5 * elapsed * elapsed;
    return {{d.position.x + half_square * c.ax[i], d.position.y + half_square * c.ay[i]},
            {d.velocity.x + elapsed * c.ax[i], d.velocity.y + elapsed * c.ay[i]},
            clock};
}

[[gnu::noinline]] RotationCentre centre_one_by_one(const RotationColumns& c, const double* masses,
                                                   std::ptrdiff_t size, double clock) {
    double mass = 0.0;
    Vec2 r{0.0, 0.0}, v{0.0, 0.0};
    for (std::ptrdiff_t i = 0; i < size; ++i) {
        const Flight<double> disc = disc_at(c, i, clock);
        mass += masses[i];
        r = r + masses[i] * disc.position;
        v = v + masses[i] * disc.velocity;
    }
    return {size, clock, mass, {r.x / mass, r.y / mass}, {v.x / mass, v.y / mass}};
}

[[gnu::noinline]] RotationRates rates_one_by_one(const RotationColumns& c,
                                                 const RotationCentre& about, double clock,
                                                 double closest_square) {
    constexpr double not_available = __builtin_nan("");
    if (about.discs < 2) return RotationRates{not_available, not_available};
    const Vec2 centre = about.at(clock);
    double individual = 0.0, counted = 0.0, angular = 0.0, square = 0.0;
    for (std::ptrdiff_t i = 0; i < about.discs; ++i) {
        const Flight<double> disc = disc_at(c, i, clock);
        const Vec2 r = disc.position - centre;
        const double l = cross(r, disc.velocity - about.velocity), q = dot(r, r);
        angular += l;
        square += q;
        if (q <= closest_square) continue;
        individual += l / q;
        counted += 1.0;
    }
    return RotationRates{counted > 0.0 ? individual / counted : not_available,
                         square > closest_square ? angular / square : not_available};
}

RotationCentre centre(const RotationColumns& c, const double* mass, std::ptrdiff_t size,
                      double clock) {
    if (size < lanes) return centre_one_by_one(c, mass, size, clock);
    if (c.ax != nullptr) return centre_of<true>(c, mass, size, clock);
    return centre_of<false>(c, mass, size, clock);
}

RotationRates rates(const RotationColumns& c, const RotationCentre& about, double clock,
                    double closest_square) {
    if (about.discs < 2 || (about.discs < lanes && c.ax != nullptr))
        return rates_one_by_one(c, about, clock, closest_square);
    const RotationRates rates =
        about.discs < lanes ? rates_of_few_discs(c, about, clock, closest_square)
        : c.ax != nullptr   ? rates_of<true>(c, about, clock, closest_square)
                            : rates_of<false>(c, about, clock, closest_square);
    // Otherwise a disc is on the centre of mass, or a state is NaN.
    const bool is_number = rates[0] - rates[0] == 0.0;
    if (is_number) [[likely]]
        return rates;
    return rates_one_by_one(c, about, clock, closest_square);
}

}  // namespace

const RotationKernel kernel{centre, rates};

}  // namespace SWIRL_ROTATION_TARGET
#endif

}  // namespace swirl
