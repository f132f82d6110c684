// How a series of equally weighted values, one per period, fluctuates about its mean m.
//
//   variance           V = μ₂ / (1 − τ/n), with μ_k = ⟨(x − m)^k⟩ and the integrated
//                      autocorrelation time τ (block_average.hpp). The mean of n values takes up V
//                      τ/n, so V has no bias of the order 1/n
//   skewness           μ₃ / μ₂^(3/2)
//   excess kurtosis    μ₄ / μ₂² − 3
//   Binder cumulant    U = 1 − μ₄ / (3 μ₂²). Binder 1981 (doi:10.1007/BF01293604) has moments about
//                      zero, for a magnet whose states ±x are equal by symmetry. ϖ has no such
//                      symmetry; moments about m serve for a liquid and its vapour (Rovere,
//                      Heermann, Binder, "The gas-liquid transition of the two-dimensional
//                      Lennard-Jones fluid")
//   lifetimes          of the two states of the steady-state test (steady_state.hpp): the time in a
//                      state by the number of times the series leaves it
//
// Ideal answers, whatever the mean is. Gaussian noise: skewness, excess kurtosis and U are 0. Two
// equally probable values: excess kurtosis −2, U = 2/3. x' = a x + noise: τ = (1 + a)/(1 − a),
// V = (variance of the noise)/(1 − a²). A state that is left with probability p in each period:
// lifetime 1/p.
//
// Several runs: one mean for all. Products of two periods, and visits, never extend over two runs.
//
// Units: those of the values, squared for the variance; periods for times. Errors: jackknife over
// blocks of at least 4 τ periods, at most about 64 blocks; a lifetime after k departures has the
// error lifetime/√k. NaN with fewer than eight blocks. τ has no error here; compare replicates.
// Limits: without the correction of the variance, moments of few effective samples are biased by
// 1/(number of them). A constant has no skewness, kurtosis and U (NaN). Without two states there
// are no levels and no lifetimes (NaN). A state shorter than a period is unknown, and the lifetime
// of windows of w periods has the resolution w.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "swirl/statistics/block_average.hpp"
#include "swirl/statistics/steady_state.hpp"

namespace swirl {

struct Fluctuations {
    Estimate variance, skewness, excess_kurtosis, binder, autocorrelation_time;
    /// Mean of the lower and of the higher state; their lifetimes in periods.
    Estimate low, high, low_lifetime, high_lifetime;
};

/// Sums of powers of the values less a constant, and of their squares.
struct PowerSums {
    double count = 0.0;
    std::array<double, 4> about{};  // Σ (x − c)^k, k = 1 … 4
    double squares = 0.0;           // Σ x², the scale of the rounding errors

    void add(double value, double c) {
        const double d = value - c;
        count += 1.0;
        for (double power = d; double& sum : about) {
            sum += power;
            power *= d;
        }
        squares += value * value;
    }
    PowerSums without(const PowerSums& part) const {
        PowerSums rest = *this;
        rest.count -= part.count;
        for (std::size_t k = 0; k < about.size(); ++k) rest.about[k] -= part.about[k];
        rest.squares -= part.squares;
        return rest;
    }
    /// μ₂, skewness, excess kurtosis, Binder cumulant.
    std::array<double, 4> moments() const {
        const double d = about[0] / count, second = about[1] / count, third = about[2] / count,
                     fourth = about[3] / count, square = squares / count;
        double variance = second - d * d;
        // The rounding of a constant is no fluctuation.
        if (!(variance > 1e-28 * square)) variance = 0.0;
        const double skew = third - 3.0 * d * second + 2.0 * d * d * d;
        const double fourth_about_mean =
            fourth - 4.0 * d * third + 6.0 * d * d * second - 3.0 * d * d * d * d;
        if (!(variance > 0.0)) return {variance, not_available, not_available, not_available};
        const double kurtosis = fourth_about_mean / (variance * variance);
        return {variance, skew / (variance * std::sqrt(variance)), kurtosis - 3.0,
                1.0 - kurtosis / 3.0};
    }
};

using Runs = std::span<const std::vector<double>>;

/// The mean, without an error, and τ of several runs.
inline SeriesEstimate estimate_of_runs(Runs runs) {
    SeriesEstimate found;
    double sum = 0.0, n = 0.0;
    std::size_t longest = 0;
    for (const std::vector<double>& run : runs) {
        for (const double value : run) sum += value;
        n += static_cast<double>(run.size());
        longest = std::max(longest, run.size());
    }
    if (n == 0.0) return found;
    const double mean = sum / n;
    found.estimate = {mean, not_available, n, static_cast<std::size_t>(n)};
    if (n < 2.0) return found;
    const auto autocovariance = [&](std::size_t lag) {
        double product = 0.0;
        for (const std::vector<double>& run : runs)
            for (std::size_t k = 0; k + lag < run.size(); ++k)
                product += (run[k] - mean) * (run[k + lag] - mean);
        return product / n;
    };
    found.autocorrelation_time = autocorrelation_time(longest, autocovariance);
    found.estimate.effective_samples = n / found.autocorrelation_time;
    return found;
}

/// The power sums of blocks of nearly equal length, none of which extends over two runs.
inline std::vector<PowerSums> power_sums_of_blocks(Runs runs, double about, double tau) {
    constexpr double max_blocks = 64.0, correlation_times = 4.0;
    std::size_t n = 0;
    for (const std::vector<double>& run : runs) n += run.size();
    const double length = std::max(correlation_times * tau, static_cast<double>(n) / max_blocks);
    std::vector<PowerSums> blocks;
    for (const std::vector<double>& run : runs) {
        if (run.empty()) continue;
        const std::size_t count = std::max<std::size_t>(
            1, static_cast<std::size_t>(static_cast<double>(run.size()) / length));
        for (std::size_t b = 0; b < count; ++b) {
            PowerSums& sums = blocks.emplace_back();
            for (std::size_t k = b * run.size() / count; k < (b + 1) * run.size() / count; ++k)
                sums.add(run[k], about);
        }
    }
    return blocks;
}

/// Sets the levels and the lifetimes, if a run has two states.
inline void find_lifetimes(Runs runs, Fluctuations& found) {
    constexpr std::size_t low = 0, high = 1;
    std::array<double, 2> stayed{}, left{}, level{};
    for (const std::vector<double>& run : runs) {
        const TwoStates states = find_two_states(run);
        if (!states.found()) continue;
        for (const std::size_t s : {low, high}) {
            const auto periods = static_cast<double>(states.stayed[s] * states.window);
            stayed[s] += periods;
            left[s] += static_cast<double>(states.departures[s]);
            level[s] += periods * (s == low ? states.low : states.high);
        }
    }
    const auto set = [&](std::size_t s, Estimate& its_level, Estimate& lifetime) {
        if (stayed[s] > 0.0) its_level.mean = level[s] / stayed[s];
        if (left[s] == 0.0) return;
        lifetime.mean = stayed[s] / left[s];
        lifetime.error = lifetime.mean / std::sqrt(left[s]);
        lifetime.effective_samples = left[s];
        lifetime.blocks = static_cast<std::size_t>(left[s]);
    };
    set(low, found.low, found.low_lifetime);
    set(high, found.high, found.high_lifetime);
}

inline Fluctuations fluctuations_of(Runs runs) {
    constexpr std::size_t min_blocks = 8;
    Fluctuations found;
    const SeriesEstimate mean = estimate_of_runs(runs);
    const double n = static_cast<double>(mean.estimate.blocks), tau = mean.autocorrelation_time;
    if (!(n >= 2.0)) return found;
    found.autocorrelation_time = mean.estimate;
    found.autocorrelation_time.mean = tau;
    const std::vector<PowerSums> blocks = power_sums_of_blocks(runs, mean.estimate.mean, tau);
    PowerSums all;
    for (const std::vector<double>& run : runs)
        for (const double value : run) all.add(value, mean.estimate.mean);
    const std::array<double, 4> moments = all.moments();
    std::array<double, 4> squares{}, sums{};
    const double b = static_cast<double>(blocks.size());
    for (const PowerSums& block : blocks) {
        const std::array<double, 4> others = all.without(block).moments();
        for (std::size_t k = 0; k < moments.size(); ++k) {
            sums[k] += others[k] - moments[k];
            squares[k] += (others[k] - moments[k]) * (others[k] - moments[k]);
        }
    }
    Estimate* const estimates[] = {&found.variance, &found.skewness, &found.excess_kurtosis,
                                   &found.binder};
    for (std::size_t k = 0; k < moments.size(); ++k) {
        *estimates[k] = mean.estimate;
        estimates[k]->mean = moments[k];
        if (blocks.size() >= min_blocks)
            estimates[k]->error =
                std::sqrt((b - 1.0) / b * std::max(squares[k] - sums[k] * sums[k] / b, 0.0));
    }
    const double correction = n > tau ? 1.0 / (1.0 - tau / n) : not_available;
    found.variance = scaled(found.variance, correction);
    find_lifetimes(runs, found);
    return found;
}

/// Values of several runs, and the open mean of the present period.
class PeriodMeans {
  public:
    /// A NaN is omitted.
    void add(double value) {
        if (std::isnan(value)) return;
        sum_ += value;
        count_ += 1.0;
    }
    /// A period without values is omitted.
    void close_block() {
        if (runs_.empty()) runs_.emplace_back();
        if (count_ > 0.0) runs_.front().push_back(sum_ / count_);
        sum_ = count_ = 0.0;
    }
    /// Adds the closed periods of an independent run.
    void merge(const PeriodMeans& other) {
        if (runs_.empty()) runs_.emplace_back();
        for (const std::vector<double>& run : other.runs_)
            if (!run.empty()) runs_.push_back(run);
    }
    Runs runs() const { return runs_; }

    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(sum_, count_, runs_);
    }

  private:
    double sum_ = 0.0, count_ = 0.0;
    std::vector<std::vector<double>> runs_;  // the first one is open
};

}  // namespace swirl
