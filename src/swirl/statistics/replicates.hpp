// The mean over replicates (runs with the same parameters and different seeds) and its error: the
// one estimator for sweeps, crossings and the paper's figures.
//
// Run i has the mean m_i with the error e_i from its own blocks (block_average.hpp), without the
// factor for few blocks (few_blocks.hpp), and the weight w_i (its length; equal for runs of equal
// length).
//
//     p_i = w_i / Σ w_i,   m = Σ p_i m_i
//     V_w = Σ p_i² e_i²                                         within: from the blocks
//     V_b = V_w + τ² Σ p_i²                                     between: from the seeds
//     V   = max(V_w, V_b)
//
// τ² is the variance between the seeds of the random effects model, in which m_i varies by
// e_i² + τ² (DerSimonian and Laird 1986, doi:10.1016/0197-2456(86)90046-2), found from the scatter
// B = Σ p_i² (m_i − m)². Since m_i − m = Σ_j (δ_ij − p_j) m_j, the expectation of B is
//
//     Σ p_i² [(1 − 2 p_i) e_i² + V_w] + τ² c,   c = Σ p_i² [1 − 2 p_i + Σ p_j²],
//
// and τ² is the value for which it is B. For equal weights V_b is the familiar Σ (m_i − m)² / (n (n
// − 1)). For unequal weights this formula would be too small, because m lies close to the mean of a
// long run. Both V estimate the variance of m. V_w is more precise, but misses correlations longer
// than a run. V_b misses nothing, but is uncertain itself. The larger of the two is used, so the
// error is rather too large than too small.
//
// Do they agree? If they do, Q = Σ (m_i − m)²/e_i² is χ² with n − 1 degrees of freedom. The seeds
// disagree if Q is above the quantile that corresponds to three standard deviations of a normal
// distribution. V then has the degrees of freedom of B: Satterthwaite's (tr A)²/tr A² of the
// quadratic form B = mᵀA m, which are n − 1 for equal weights and fewer for others. Otherwise those
// of the blocks (Welch's) are added.
//
// Small numbers. The error is √V · t/1.96, with t the quantile of Student's t for 95 %. So
// mean ± 1.96 errors contains the true value in 95 of 100 cases, however few runs there are, if the
// blocks contain all correlations. If seeds differ by more than that, few of them cannot always
// distinguish it from chance, and the interval contains the true value less often. The worst case
// is a τ of two to five errors e_i: 74 of 100 cases with two runs, 84 with three, 89 with five and
// 92 with eight. The true value is then beyond three errors in up to 17, 8, 4 and 2 of 100 cases
// (tests/statistics/replicates_test.cpp).
//
// Which runs count. A run with fewer than five periods after its warm-up is left out, because its
// transient is part of its mean: without wall friction, averages over three periods deviate by a
// tenth of Ω, in the same direction for all seeds. If every run is that short, all of them count.
// Averages over time are weighted by the lengths of the runs, averages over events are not.
//
// Units: those of the mean. Limits: runs without a mean are omitted; a single run keeps its own
// error; runs without errors of their own get the one between them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "swirl/statistics/block_average.hpp"
#include "swirl/statistics/few_blocks.hpp"
#include "swirl/statistics/student.hpp"

namespace swirl {

/// Mean and error over replicates, and how the seeds compare with the blocks.
struct Ensemble {
    Estimate estimate;
    std::size_t runs = 0;                                    // that have a mean
    double within = not_available, between = not_available;  // √V_w, √V_b
    /// Scatter of the runs in units of their own errors, √(Q/(n − 1)): 1 is expected by chance.
    double scatter = not_available;
    bool disagree = false;  // the seeds scatter more than their blocks can explain
};

/// Runs with fewer periods after their warm-up are left out.
inline constexpr double min_averaged_periods = 5.0;

/// The weights of runs with these lengths after the warm-up, in periods; 0 for a run that is left
/// out. Equal weights are 1.
inline std::vector<double> replicate_weights(std::span<const double> periods, bool by_time) {
    const auto is_long = [](double length) { return length >= min_averaged_periods; };
    const bool any = std::any_of(periods.begin(), periods.end(), is_long);
    std::vector<double> weights;
    for (const double length : periods)
        weights.push_back(any && !is_long(length) ? 0.0 : by_time ? length : 1.0);
    double common = 0.0;
    for (const double weight : weights) {
        if (weight == 0.0) continue;
        if (common != 0.0 && weight != common) return weights;
        common = weight;
    }
    if (common == 0.0) return std::vector<double>(weights.size(), 1.0);  // no run has a length
    for (double& weight : weights) weight /= common;
    return weights;
}

/// True if χ² is above chance by the three standard deviations that count as certain.
inline bool beyond_chance(double chi_square, double freedom) {
    const double ninth = 2.0 / (9.0 * freedom);  // Wilson and Hilferty 1931
    const double root = 1.0 - ninth + 3.0 * std::sqrt(ninth);
    return chi_square > freedom * root * root * root;
}

/// V_b, and the degrees of freedom of B.
struct Between {
    double variance, freedom;
};

/// `p` are the shares of the runs in the total weight; `within` is V_w, 0 if the runs have no
/// errors.
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

/// `weights` has one value per run, or is empty: then all runs count the same. A run with the
/// weight 0 is left out.
inline Ensemble ensemble(std::span<const Estimate> given, std::span<const double> weights = {}) {
    Ensemble all;
    std::vector<Estimate> runs;
    std::vector<Estimate> plain;  // the same runs with the errors e_i
    std::vector<double> w;
    for (std::size_t i = 0; i < given.size(); ++i) {
        if (std::isnan(given[i].mean) || (!weights.empty() && weights[i] == 0.0)) continue;
        runs.push_back(given[i]);
        w.push_back(weights.empty() ? 1.0 : weights[i]);
        plain.push_back(given[i]);
        plain.back().error = plain_error(given[i]);
    }
    all.runs = runs.size();
    if (runs.empty()) return all;
    if (runs.size() == 1) {
        all.estimate = runs.front();
        all.within = all.estimate.error;
        return all;
    }
    runs = std::move(plain);
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
        // If the number of samples behind an error is unknown, the error counts as exact.
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

/// The same for angles in degrees, for which 350° and 10° average to 0°; the mean is in 0° … 360°.
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
