// Quantiles of Student's t distribution, and the degrees of freedom that belong to a difference.
#pragma once

#include <array>
#include <cstddef>

namespace swirl {

/// 95 % of a normal distribution lies within ± this many standard deviations.
inline constexpr double normal_95 = 1.959963984540054;

/// The quantile of Student's t with `freedom` degrees of freedom that has the same probability as
/// the quantile `normal` of a normal distribution. The first three terms of the Cornish–Fisher
/// expansion in 1/freedom; its error at 10 degrees of freedom is below 0.004 for 95 %.
inline double student_quantile(double normal, double freedom) {
    const double z = normal, z3 = z * z * z, z5 = z3 * z * z;
    return z + (z3 + z) / (4.0 * freedom) +
           (5.0 * z5 + 16.0 * z3 + 3.0 * z) / (96.0 * freedom * freedom);
}

/// 95 % of Student's t lies within ± this. Up to 10 degrees of freedom from tables, linear in
/// 1/freedom between their entries; beyond, from the expansion. Below one degree: the value of one.
inline double student_95(double freedom) {
    constexpr std::array t = {12.70620474, 4.30265273, 3.18244631, 2.77644511, 2.57058184,
                              2.44691185,  2.36462425, 2.30600414, 2.26215716, 2.22813885};
    if (!(freedom > 1.0)) return t[0];
    if (freedom >= 10.0) return student_quantile(normal_95, freedom);
    const auto k = static_cast<std::size_t>(freedom);  // t[k − 1] is that of k
    const double lower = 1.0 / static_cast<double>(k), upper = 1.0 / static_cast<double>(k + 1);
    const double share = (lower - 1.0 / freedom) / (lower - upper);
    return t[k - 1] + share * (t[k] - t[k - 1]);
}

/// Welch's degrees of freedom of the difference of two independent means with the squared errors
/// `a` and `b` (Welch 1947, doi:10.1093/biomet/34.1-2.28).
inline double welch_freedom(double a, double freedom_of_a, double b, double freedom_of_b) {
    return (a + b) * (a + b) / (a * a / freedom_of_a + b * b / freedom_of_b);
}

}  // namespace swirl
