// The mean over several runs of the same thing that differ in their seeds, and how well it is
// known: the one estimator for sweeps, crossings and the paper's figures.
//
// Run i has the mean m_i with the error e_i from its own blocks (statistics.hpp) and the weight w_i
// (its length; equal for runs of equal length).
//
//     p_i = w_i / Σ w_i,   m = Σ p_i m_i
//     V_w = Σ p_i² e_i²                                         within: what the blocks say
//     V_b = V_w + τ² Σ p_i²                                     between: what the seeds say
//     V   = max(V_w, V_b)
//
// τ² is the variance between the seeds of the random effects model, in which m_i varies by
// e_i² + τ² (DerSimonian and Laird 1986, doi:10.1016/0197-2456(86)90046-2), found from the scatter
// B = Σ p_i² (m_i − m)². Since m_i − m = Σ_j (δ_ij − p_j) m_j, the expectation of B is
//
//     Σ p_i² [(1 − 2 p_i) e_i² + V_w] + τ² c,   c = Σ p_i² [1 − 2 p_i + Σ p_j²],
//
// and τ² is what makes it B. Of equal weights V_b is the familiar Σ (m_i − m)² / (n (n − 1)); of
// unequal ones that would be too small, since a long run draws m to itself. Both V estimate the
// variance of m. Within is the more precise and misses what lasts longer than a run; between misses
// nothing and is uncertain itself. The larger is not below either, so it is on the safe side.
//
// Do they agree? Q = Σ (m_i − m)²/e_i² is χ² with n − 1 degrees of freedom if they do. Above the
// quantile that three standard deviations are for a normal deviate, the seeds disagree: V then has
// the degrees of freedom of B, Satterthwaite's (tr A)²/tr A² of the quadratic form B = mᵀA m, which
// are n − 1 of equal weights and fewer of others. Otherwise those of the blocks (Welch's) are
// added.
//
// Small numbers. The error is √V times t/1.96, t the quantile of Student's t for 95 %: so that
// mean ± 1.96 errors holds the truth in 95 of 100 cases, however few runs there are, if the blocks
// say all. If seeds differ by more than that, few of them cannot always tell it from chance, and
// the interval holds less often: at worst (τ of some two to five errors e_i) in 74 of 100 cases
// with two runs, 84 with three, 89 with five and 92 with eight, and the truth is beyond three
// errors in up to 17, 8, 4 and 2 of 100 (tests/statistics/replicates_test.cpp).
//
// Units: those of what is averaged. Limits: runs whose mean is not known are left out; a single run
// keeps its own error; runs without errors of their own have the one between them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "swirl/statistics/block_average.hpp"

namespace swirl {

/// Mean and error over several runs, and how the seeds compare with the blocks.
struct Ensemble {
    Estimate estimate;
    std::size_t runs = 0;                                    // whose mean is known
    double within = not_available, between = not_available;  // √V_w, √V_b
    /// By how many of their own errors the runs scatter, √(Q/(n − 1)): 1 is what chance makes.
    double scatter = not_available;
    bool disagree = false;  // the seeds scatter more than their blocks can explain
};

/// Of Student's t: 95 % of it lie within ± this. From tables up to 10 degrees of freedom (linear in
/// 1/ν between them), by the expansion beyond; at least one degree.
inline double student_95(double freedom) {
    constexpr double normal = 1.959963984540054;
    constexpr std::array t = {12.70620474, 4.30265273, 3.18244631, 2.77644511, 2.57058184,
                              2.44691185,  2.36462425, 2.30600414, 2.26215716, 2.22813885};
    if (!(freedom > 1.0)) return t[0];
    if (freedom >= 10.0) return student_quantile(normal, freedom);
    const auto k = static_cast<std::size_t>(freedom);  // t[k − 1] is that of k
    const double lower = 1.0 / static_cast<double>(k), upper = 1.0 / static_cast<double>(k + 1);
    const double share = (lower - 1.0 / freedom) / (lower - upper);
    return t[k - 1] + share * (t[k] - t[k - 1]);
}

/// Is χ² above what chance makes, by the three standard deviations that count as certain?
inline bool beyond_chance(double chi_square, double freedom) {
    const double ninth = 2.0 / (9.0 * freedom);  // Wilson and Hilferty 1931
    const double root = 1.0 - ninth + 3.0 * std::sqrt(ninth);
    return chi_square > freedom * root * root * root;
}

/// V_b, and the degrees of freedom of what it rests on.
struct Between {
    double variance, freedom;
};

/// Of runs with shares p of all the weight; `within` is V_w, 0 if the runs have no errors.
inline Between between_seeds(std::span<const Estimate> runs, std::span<const double> p, double mean,
                             double within) {
    const std::size_t n = runs.size();
    double squares = 0.0, scatter = 0.0, trace = 0.0, trace_of_square = 0.0, by_blocks = 0.0;
    for (const double share : p) squares += share * share;
    for (std::size_t i = 0; i < n; ++i) {
        const double own = within > 0.0 ? runs[i].error * runs[i].error : 0.0;
        scatter += std::pow(p[i] * (runs[i].mean - mean), 2);
        by_blocks += p[i] * p[i] * ((1.0 - 2.0 * p[i]) * own + within);
        trace += p[i] * p[i] * (1.0 - 2.0 * p[i] + squares);
        for (std::size_t j = 0; j < n; ++j)
            trace_of_square +=
                std::pow(p[i] * p[j] * ((i == j ? 1.0 : 0.0) - p[i] - p[j] + squares), 2);
    }
    return {std::max(0.0, within + squares * (scatter - by_blocks) / trace),
            trace * trace / trace_of_square};
}

/// `weights` as many as runs, or none: then all count the same.
inline Ensemble ensemble(std::span<const Estimate> given, std::span<const double> weights = {}) {
    Ensemble all;
    std::vector<Estimate> runs;
    std::vector<double> w;
    for (std::size_t i = 0; i < given.size(); ++i) {
        if (std::isnan(given[i].mean)) continue;
        runs.push_back(given[i]);
        w.push_back(weights.empty() ? 1.0 : weights[i]);
    }
    all.runs = runs.size();
    if (runs.empty()) return all;
    if (runs.size() == 1) {
        all.estimate = runs.front();
        all.within = all.estimate.error;
        return all;
    }
    double total = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        total += w[i];
        sum += w[i] * runs[i].mean;
    }
    const double mean = sum / total, others = static_cast<double>(runs.size()) - 1.0;
    double within = 0.0, uncertain = 0.0, chi_square = 0.0, samples = 0.0;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        const Estimate& run = runs[i];
        const double own = std::pow(w[i] * run.error / total, 2), off = run.mean - mean;
        within += own;
        // How many samples an error rests on may not be known; then it is taken as it is.
        if (run.effective_samples > 0.0)
            uncertain += own * own / std::max(run.effective_samples - 1.0, 1.0);
        if (off != 0.0) chi_square += std::pow(off / run.error, 2);
        all.estimate.blocks += run.blocks;
        samples += run.effective_samples;
    }
    for (double& weight : w) weight /= total;
    const Between seeds = between_seeds(runs, w, mean, std::isnan(within) ? 0.0 : within);
    const double between = seeds.variance;
    all.within = std::sqrt(within);
    all.between = std::sqrt(between);
    all.scatter = std::sqrt(chi_square / others);
    all.disagree = beyond_chance(chi_square, others);
    const bool seeds_alone = std::isnan(within) || all.disagree;
    const double variance = std::isnan(within) ? between : std::max(within, between);
    double freedom = seeds.freedom;
    if (!seeds_alone)
        freedom +=
            uncertain > 0.0 ? within * within / uncertain : std::numeric_limits<double>::infinity();
    all.estimate.mean = mean;
    all.estimate.error = std::sqrt(variance) * student_95(freedom) / student_95(1e9);
    all.estimate.effective_samples = seeds_alone ? others + 1.0 : samples;
    return all;
}

/// The same of angles in degrees, of which 350° and 10° make 0°; the mean is in 0° … 360°.
inline Ensemble several_directions(std::span<const Estimate> given,
                                   std::span<const double> weights = {}) {
    std::vector<Estimate> unwrapped(given.begin(), given.end());
    const auto known = std::find_if(given.begin(), given.end(),
                                    [](const Estimate& e) { return !std::isnan(e.mean); });
    if (known == given.end()) return ensemble(given, weights);
    for (Estimate& e : unwrapped) e.mean -= 360.0 * std::round((e.mean - known->mean) / 360.0);
    Ensemble all = ensemble(unwrapped, weights);
    all.estimate.mean -= 360.0 * std::floor(all.estimate.mean / 360.0);
    return all;
}

}  // namespace swirl
