// The N at which a curve ϖ(N) changes sign, with a confidence interval. N_c is the last change from
// rotation to counterrotation.
//
// Signs. The sign of a point is certain if its mean is more than three errors from zero. Otherwise
// it is undetermined; such points are listed (`undetermined`), because the curve may change sign
// next to them. Between two points of certain and opposite signs, with no other certain point
// between them, the curve does change sign. These two are the bracket of the change.
//
// N_c. N is a whole number, so the zero is that of the straight line between two neighbours, N and
// N + 1. It depends on these two points alone, not on the range of the table. A bracket may hold
// undetermined points; then the curve in it is the polyline through all its points. If this has
// several zeros, N_c is the middle one.
//
// Interval. At x = N + f the polyline has the value and the variance
//
//     g(x) = (1 − f) m_N + f m_{N+1},   σ²(x) = (1 − f)² e_N² + f² e_{N+1}².
//
// The interval of 95 % reaches from the first to the last x at which g is compatible with zero,
// |g(x)| ≤ z σ(x), z = 1.96. For one pair of points this is Fieller's interval (1954,
// doi:10.1111/j.2517-6161.1954.tb00159.x), which is exact. It contains the zeros of its own
// polyline. It lies within the bracket, since the signs at both ends are certain. The error is the
// half width of the interval divided by z.
//
// Coarse tables. If two points of a bracket are more than one apart, the curve between them is not
// known. Then only the bracket is reported: N_c and its error are NaN, and the interval is the
// bracket.
//
// One sign throughout is claimed only if every point certainly has it. Units: those of N. Limits:
// points without a finite mean and a finite, non-negative error are omitted; an exact point (error
// 0) has a certain sign unless its mean is 0. Errors count as those of normal deviates;
// replicates.hpp widens those of few runs.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "swirl/statistics/block_average.hpp"

namespace swirl {

struct RotationPoint {
    double discs;        // N
    double mean, error;  // ϖ/Ω
};

/// Number of errors from zero that makes a sign certain. Two would not do: among many points, one
/// or two are off by two errors.
inline constexpr double certain_sign = 3.0;
/// +1, −1, or 0 if the sign is not certain.
inline int certain_sign_of(double mean, double error) {
    return mean > certain_sign * error ? 1 : mean < -certain_sign * error ? -1 : 0;
}

/// One change of sign of a curve, which need not be monotonic.
struct SignChange {
    double before, after;     // the bracket
    bool to_counterrotation;  // else back to rotation
    double discs = not_available, error = not_available;
    double lower = not_available, upper = not_available;  // 95 %, or the bracket of a coarse table
    std::vector<double> between = {};                     // undetermined points in the bracket

    /// True if every N of the bracket has a point, so that N_c is known.
    bool resolved() const { return discs == discs; }
};

struct Crossing {
    enum class Verdict : std::uint8_t {
        crosses,
        always_rotates,         // every point is certainly positive
        always_counterrotates,  // every point is certainly negative
        undecided,              // the errors are too large, or there are too few points
    };
    Verdict verdict = Verdict::undecided;
    std::size_t points = 0;  // those with a mean and an error
    /// Of the last change to counterrotation; NaN if its bracket comes from a coarse table.
    double discs = not_available, error = not_available;
    double lower = not_available, upper = not_available;
    std::vector<SignChange> changes = {};   // the certain ones, in the order of N
    std::vector<double> undetermined = {};  // N whose sign is not certain, in order

    /// The last change to counterrotation; nullptr if there is none.
    const SignChange* last() const;
    /// Undetermined points beyond the last change to counterrotation: another change may follow.
    std::vector<double> undetermined_after() const;
};

/// Points in any order.
Crossing find_crossing(std::span<const RotationPoint> points);

}  // namespace swirl
