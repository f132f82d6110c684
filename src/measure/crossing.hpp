// Where a curve ϖ(N) changes sign from rotation to counterrotation: N_c, with a confidence
// interval.
//
// Method. The points are in order of N, each with its mean and error. The change of sign is looked
// for where it fits the signs best: the cut k that leaves the largest Σ_{left} m/e² − Σ_{right}
// m/e². Through the points nearest to it (`window` on either side) goes the straight line a + b (N
// − N̄) of weighted least squares; if they scatter about it more than their errors say (χ² per
// degree of freedom > 1), the errors are scaled up by its root, and by Student's t for the points
// less two, since that root is uncertain itself. N_c is the line's zero, and its
// interval is that of Fieller (1954, doi:10.1111/j.2517-6161.1954.tb00159.x): every N at which the
// line is compatible with zero,
//
//     (a + b x)² ≤ z² (σ_a² + σ_b² x²),   x = N − N̄,  z = 1.96 for 95 %.
//
// The verdict does not come from the line: a crossing is claimed only if some point left of the cut
// is positive and some point right of it is negative, each by more than three errors, and a curve
// has one sign throughout only if every one of its points has, by as much. Between the nearest two
// such points of opposite signs the curve does cross zero, so nothing outside them belongs to the
// interval; and where the line says less than they do, N_c is anywhere between them: their middle,
// with the standard deviation of an even distribution, a √12th of their distance.
//
// Units: those of N. Limits: points without a finite mean and a finite, non-negative error are left
// out; fewer than two points decide nothing.
// An exact point (error 0) counts as having the smallest positive error there is, or 1 if there is
// none.
#pragma once

#include <span>
#include <vector>

#include "swirl/measure/statistics.hpp"

namespace swirl {

struct RotationPoint {
    double discs;        // N
    double mean, error;  // ϖ/Ω
};

/// Errors that make a sign certain: of many points one or two are off by two.
inline constexpr double certain_sign = 3.0;

struct Crossing {
    enum class Verdict : std::uint8_t {
        crosses,
        always_rotates,         // every point is certainly positive
        always_counterrotates,  // every point is certainly negative
        undecided,              // the errors are too large, or there are too few points
    };
    Verdict verdict = Verdict::undecided;
    double discs = not_known;                     // N_c
    double error = not_known;                     // one standard error of N_c
    double lower = not_known, upper = not_known;  // 95 %
    // The evidence: the points that are most clearly on either side, in units of their errors.
    double most_positive = not_known, most_negative = not_known;
    double slope = not_known;  // of the line, per disc
    int points_used = 0;
};

/// Points in any order.
Crossing find_crossing(std::span<const RotationPoint> points, int window = 3);

/// One of several changes of sign, of a curve that need not be monotonic.
struct SignChange {
    double before, after;                         // the neighbours N whose signs are certain
    bool to_counterrotation;                      // else back to rotation
    double discs = not_known, error = not_known;  // where the line between them is zero
};

/// Every change of sign that is certain, in order of N: between two neighbours of certain and
/// opposite signs, those of uncertain sign left out of the count, the curve changes sign at least
/// once. Where: the zero of the straight line through these points and those between them, by
/// weighted least squares, its error being that of the line, and at least that of how the points
/// scatter about it; never outside the two, as above.
std::vector<SignChange> find_sign_changes(std::span<const RotationPoint> points);

}  // namespace swirl
