// When a quartic first comes down to zero: the one question that two bodies on parabolas ask
// (physics/contact_time.hpp). Only + − × ÷ √, in an order that is fixed, so every compiler and
// processor gives the same bits; no tolerance.
//
//     f(τ) = c0 + c1 τ + c2 τ² + c3 τ³ + c4 τ⁴,     0 ≤ τ ≤ h
//
// f is the room that two bodies have. They touch at the first τ at which f is 0 or less and they
// approach, f falling. The method is splitting by derivatives: f'' is a quadratic, between whose
// roots f' is monotonic and has at most one root; between those f is monotonic and has at most
// one. Each root lies in a bracket and is found by Newton's method, or by halving where that would
// leave the bracket.
//
// What has just touched has f = 0 up to a rounding error, of either sign, and must not touch again
// before it has been apart:
//   f ≤ 0 and falling at 0        they touch now
//   f rises first                 they touch when it falls through 0 after that
//   f rises and turns below       they were never apart by more than a rounding error. There the
//   `grain`, a rounding error     approach is exactly 0, or so little that the time until f is 0
//                                 again is lost in the clock's rounding, and a contact would
//                                 change nothing, for ever. So they touch when f has fallen by
//                                 `grain` from there, which their approach can be told from
#pragma once

#include "swirl/math/real.hpp"

namespace swirl {

struct Quartic {
    double c0, c1, c2, c3, c4;

    SWIRL_INLINE constexpr double value(double t) const {
        return (((c4 * t + c3) * t + c2) * t + c1) * t + c0;
    }
    SWIRL_INLINE constexpr double slope(double t) const {
        return ((4.0 * c4 * t + 3.0 * c3) * t + 2.0 * c2) * t + c1;
    }
    SWIRL_INLINE constexpr double curvature(double t) const {
        return (12.0 * c4 * t + 6.0 * c3) * t + 2.0 * c2;
    }
};

namespace quartic {

/// A root of f − level, or of f', which is monotonic from `low` to `high` and changes its sign
/// there. `first` is where to begin.
template <class Value, class Slope>
SWIRL_INLINE double root_between(const Value& value, const Slope& slope, double low, double high,
                                 bool rising, double first) {
    double t = first > low && first < high ? first : 0.5 * (low + high);
    // Some five steps are usual, sixty where only halving helps.
    for (int step = 0; step < 200; ++step) {
        const double f = value(t);
        if (f == 0.0) return t;
        ((f > 0.0) == rising ? high : low) = t;
        double next = t - f / slope(t);
        if (next == t) return t;
        if (!(next > low && next < high)) next = 0.5 * (low + high);
        if (!(next > low && next < high)) return t;
        t = next;
    }
    return t;
}

/// Where f, falling all the way from `low` to `high`, comes down to 0; `never` if it does not.
SWIRL_INLINE double fall_between(const Quartic& f, double low, double high, double grain) {
    const double top = f.value(low), bottom = f.value(high);
    if (!(bottom < top)) return never;
    const double level = low == 0.0 && top > 0.0 ? 0.0 : smaller(0.0, top - grain);
    if (bottom > level) return never;
    const double first = low == 0.0 ? f.c0 / -f.c1 : 0.5 * (low + high);
    return root_between([&](double t) { return f.value(t) - level; },
                        [&](double t) { return f.slope(t); }, low, high, false, first);
}

}  // namespace quartic

/// The first time, up to `horizon`, at which f comes down to 0; `never` if there is none. Static:
/// each width's event loop must have a copy of its own (engine/event_loop.hpp).
[[maybe_unused]] static double first_fall(const Quartic& f, double horizon, double grain) {
    if (f.c0 <= 0.0 && f.c1 < 0.0) return 0.0;

    // The roots of f''/2 = c2 + 3 c3 τ + 6 c4 τ², in the form in which nothing cancels; what is
    // not within the horizon, or no number, is none.
    double ends[3];
    int count = 0;
    const double half = 1.5 * f.c3, square = half * half - 6.0 * f.c4 * f.c2;
    if (square > 0.0) {
        const double root = square_root(square);
        const double w = half > 0.0 ? -(half + root) : root - half;
        const double a = w / (6.0 * f.c4), b = f.c2 / w;
        const double one = smaller(a, b), two = larger(a, b);
        if (one > 0.0 && one < horizon) ends[count++] = one;
        if (two > 0.0 && two < horizon && two > one) ends[count++] = two;
    }
    ends[count++] = horizon;

    double begin = 0.0;       // of the monotonic stretch of f
    double low = 0.0;         // of the monotonic stretch of f'
    double direction = f.c1;  // the last slope that was not 0
    for (int k = 0; k < count; ++k) {
        const double slope = f.slope(ends[k]);
        if ((direction < 0.0 && slope > 0.0) || (direction > 0.0 && slope < 0.0)) {
            const double turn = quartic::root_between([&](double t) { return f.slope(t); },
                                                      [&](double t) { return f.curvature(t); }, low,
                                                      ends[k], slope > 0.0, 0.5 * (low + ends[k]));
            const double fall = quartic::fall_between(f, begin, turn, grain);
            if (fall != never) return fall;
            begin = turn;
        }
        if (slope != 0.0) direction = slope;
        low = ends[k];
    }
    return quartic::fall_between(f, begin, horizon, grain);
}

}  // namespace swirl
