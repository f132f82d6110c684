// The mean over several runs of the same thing that differ in their seeds, and how well it is
// known: the one estimator for sweeps, crossings and the paper's figures.
//
// Run i has the mean m_i with the error e_i from its own blocks (statistics.hpp) and the weight w_i
// (its length; equal for runs of equal length).
//
//     m   = Σ w_i m_i / Σ w_i
//     V_w = Σ w_i² e_i² / (Σ w_i)²                              within: what the blocks say
//     V_b = n/(n−1) Σ w_i² (m_i − m)² / (Σ w_i)²                between: what the seeds say
//     V   = max(V_w, V_b)
//
// Both estimate the variance of m. Within is the more precise and misses what lasts longer than a
// run; between misses nothing and is uncertain itself. Their maximum is the variance of the random
// effects model, V_w + τ² with τ² = max(0, V_b − V_w) (DerSimonian and Laird 1986,
// doi:10.1016/0197-2456(86)90046-2): it is not below either, so it is on the safe side.
//
// Do they agree? Q = Σ (m_i − m)²/e_i² is χ² with n − 1 degrees of freedom if they do. Above the
// quantile that three standard deviations are for a normal deviate, the seeds disagree: V is then
// V_b with n − 1 degrees of freedom. Otherwise it has those of the blocks (Welch's) and n − 1 more.
//
// Small numbers. The error is √V times t/1.96, t the quantile of Student's t for 95 %: so that
// mean ± 1.96 errors holds the truth in 95 of 100 cases, however few runs there are.
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

#include "swirl/measure/statistics.hpp"

namespace swirl {

/// Mean and error over several runs, and how the seeds compare with the blocks.
struct SeveralRuns {
    Estimate estimate;
    std::size_t runs = 0;                            // whose mean is known
    double within = not_known, between = not_known;  // √V_w, √V_b
    /// By how many of their own errors the runs scatter, √(Q/(n − 1)): 1 is what chance makes.
    double scatter = not_known;
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

/// `weights` as many as runs, or none: then all count the same.
inline SeveralRuns several_runs(std::span<const Estimate> given,
                                std::span<const double> weights = {}) {
    SeveralRuns all;
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
    double within = 0.0, between = 0.0, uncertain = 0.0, chi_square = 0.0, samples = 0.0;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        const Estimate& run = runs[i];
        const double own = std::pow(w[i] * run.error / total, 2), off = run.mean - mean;
        within += own;
        between += std::pow(w[i] * off / total, 2);
        // How many samples an error rests on may not be known; then it is taken as it is.
        if (run.effective_samples > 0.0)
            uncertain += own * own / std::max(run.effective_samples - 1.0, 1.0);
        if (off != 0.0) chi_square += std::pow(off / run.error, 2);
        all.estimate.blocks += run.blocks;
        samples += run.effective_samples;
    }
    between *= (others + 1.0) / others;
    all.within = std::sqrt(within);
    all.between = std::sqrt(between);
    all.scatter = std::sqrt(chi_square / others);
    all.disagree = beyond_chance(chi_square, others);
    const bool seeds_alone = std::isnan(within) || all.disagree;
    const double variance = seeds_alone ? between : std::max(within, between);
    double freedom = others;
    if (!seeds_alone)
        freedom +=
            uncertain > 0.0 ? within * within / uncertain : std::numeric_limits<double>::infinity();
    all.estimate.mean = mean;
    all.estimate.error = std::sqrt(variance) * student_95(freedom) / student_95(1e9);
    all.estimate.effective_samples = seeds_alone ? others + 1.0 : samples;
    return all;
}

/// The same of angles in degrees, of which 350° and 10° make 0°; the mean is in 0° … 360°.
inline SeveralRuns several_directions(std::span<const Estimate> given,
                                      std::span<const double> weights = {}) {
    std::vector<Estimate> unwrapped(given.begin(), given.end());
    const auto known = std::find_if(given.begin(), given.end(),
                                    [](const Estimate& e) { return !std::isnan(e.mean); });
    if (known == given.end()) return several_runs(given, weights);
    for (Estimate& e : unwrapped) e.mean -= 360.0 * std::round((e.mean - known->mean) / 360.0);
    SeveralRuns all = several_runs(unwrapped, weights);
    all.estimate.mean -= 360.0 * std::floor(all.estimate.mean / 360.0);
    return all;
}

}  // namespace swirl
