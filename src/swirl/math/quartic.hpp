// When a quartic first falls to zero: the question that two bodies on parabolas ask
// (physics/contact_time.hpp). It uses only + − × ÷ √ in a fixed order, so results are the same for
// every compiler and processor. It has no tolerance.
//
//     f(τ) = c0 + c1 τ + c2 τ² + c3 τ³ + c4 τ⁴,     0 ≤ τ ≤ h
//
// f measures the gap between two bodies. They touch at the first τ at which f ≤ 0 while f falls.
// The method separates the roots by derivatives. f'' is a quadratic. Between its roots f' is
// monotonic and has at most one root; between the roots of f', f is monotonic and has at most one.
// Each root lies in a bracket and is found by Newton's method, or by bisection if a step would
// leave the bracket.
//
// Bodies that have just touched have f = 0 up to a rounding error of either sign. They must not
// touch again before they have separated:
//   f ≤ 0 and falling at 0        they touch now
//   f rises first                 they touch when it falls through 0 after that
//   f rises and turns below       they never separated by more than a rounding error. There the
//   `grain`, a rounding error     speed of approach is 0, or so small that the time until f is 0
//                                 again is lost in the clock's rounding. A contact would change
//                                 nothing, for ever. So they touch when f has fallen by `grain`
//                                 from there: then the speed of approach is well defined
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

/// The root of a function (f − level, or f') that is monotonic from `low` to `high` and changes its
/// sign there. `first` is the initial estimate.
template <class Value, class Slope>
SWIRL_INLINE double root_between(const Value& value, const Slope& slope, double low, double high,
                                 bool rising, double first) {
    double t = first > low && first < high ? first : 0.5 * (low + high);
    // Five steps are usual, and sixty if only bisection helps.
    constexpr int max_steps = 200;
    for (int step = 0; step < max_steps; ++step) {
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

/// The zero of f, which falls from `low` to `high`; `never` if f stays above 0.
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

/// The first time, up to `horizon`, at which f falls to 0; `never` if there is none. Static: the
/// event loop of each vector width must have its own copy (engine/event_loop.hpp).
[[maybe_unused]] static double first_fall(const Quartic& f, double horizon, double grain) {
    if (f.c0 <= 0.0 && f.c1 < 0.0) return 0.0;

    // The roots of f''/2 = c2 + 3 c3 τ + 6 c4 τ², in the form in which nothing cancels. Roots
    // beyond the horizon, and NaN, are dropped.
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

    double begin = 0.0;       // f is monotonic from here on
    double low = 0.0;         // f' is monotonic from here on
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
