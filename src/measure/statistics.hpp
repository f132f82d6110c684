// How well a mean is known. A run delivers blocks, each covering whole periods of the swirl: the
// sum of a quantity over the block, and the weight (number of samples, or time) it was summed over.
//
// Mean. m = ΣS / ΣW over all blocks, so every sample counts the same however many fell into a
// period. With S_b the sum and W_b the weight of block b this is a ratio estimator, and what
// scatters is the residual d_b = S_b − m W_b (Cochran, Sampling Techniques, 3rd ed. 1977, §6.3):
//
//     error² = τ · n/(n−1) · Σ d_b² / (ΣW)²
//
// Correlation between periods. τ = 1 + 2 Σ_k ρ_k is the integrated autocorrelation time of the
// residuals in blocks, summed over Geyer's initial monotone positive sequence (Geyer 1992,
// doi:10.1214/ss/1177011137) and taken to be at least 1. n/τ is the number of effective samples.
// Products never reach across the seam between two runs that were merged.
//
// Warm-up. MSER-5: blocks are averaged in fives, and the truncation d ≤ n/2 is the one that
// minimises the squared standard error of what is left, Σ_{i>d}(Y_i − Ȳ_d)² / (n − d)²
// (White 1997, doi:10.1177/003754979706900601; batches of five: White, Cobb, Spratt, Proceedings of
// the 2000 Winter Simulation Conference).
//
// Steady state. After the truncation, the mean of the first fifth is compared with that of the
// last half (Geweke 1992, doi:10.21034/sr.148, who takes a tenth; a fifth keeps more blocks in a
// short run), each with its own correlated error: z = (m_1 − m_2)/√(error_1² + error_2²). It is a
// drift if |z| is above the quantile of Student's t that 4 is for a normal deviate, with Welch's
// degrees of freedom from the effective samples, ν = (Σ error²)²/Σ(error⁴/(n − 1)), because errors
// of short pieces are uncertain themselves (expansion of the quantile in 1/ν: Abramowitz and
// Stegun, 26.7.5). Four and not three, since a study tests hundreds of runs, and the z of steady
// dishes scatters with a standard deviation of 1.3: the errors of correlated pieces come out a
// little too small. A truncation that wants the whole first half is a drift too. Of a series in
// which nothing is known (NaN) nothing can be said.
//
// Warm-up while a run goes on. The blocks so far are asked every now and then, from 50 of them on:
// the beginning is forgotten when MSER-5 wants less than their first half cut off, and what is left
// has no trend: |z| ≤ 2, with the errors of both pieces about their own straight lines, since a
// trend would enlarge them and hide in them. (Two, because to wait a little longer costs less than
// to begin too early.) All blocks up to then are the warm-up.
//
// Units and normalisation: those of what is added. Limits: fewer than two blocks have no error
// (NaN); no blocks, or no weight, have no mean (NaN); a NaN added makes the mean NaN. The error
// carries a relative uncertainty of about 1/√(2n/τ). Runs of very many periods are coarsened: when
// a run reaches 2048 blocks, neighbours are put together, so memory stays bounded.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace swirl {

inline constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

/// A mean, its standard error, and what they rest on.
struct Estimate {
    double mean = not_known;
    double error = not_known;
    double effective_samples = 0.0;
    std::size_t blocks = 0;
};

/// One block: sum of the quantity, and the weight it was summed over.
struct Block {
    double sum = 0.0, weight = 0.0;
};

/// The blocks of one run, or of several runs one after the other.
class BlockSeries {
  public:
    static constexpr std::size_t most_blocks_per_run = 2048;

    /// Closes a block of one period. A block without weight is kept: it happened, and held nothing.
    void add(double sum, double weight) {
        if (runs_.empty()) runs_.emplace_back();
        runs_[current_].add({sum, weight});
    }
    /// Adds the blocks of an independent run. What is added later still continues this one.
    void merge(const BlockSeries& other) {
        if (runs_.empty()) runs_.emplace_back();
        for (std::size_t r = 0; r < other.runs_.size(); ++r)
            if (!other.runs_[r].blocks.empty()) runs_.push_back(other.runs_[r]);
    }

    bool empty() const { return size() == 0; }
    std::size_t size() const {
        std::size_t n = 0;
        for (const Run& run : runs_) n += run.blocks.size();
        return n;
    }
    /// Runs that hold a block.
    std::size_t runs() const {
        std::size_t n = 0;
        for (const Run& run : runs_) n += run.blocks.empty() ? 0 : 1;
        return n;
    }

    double mean() const {
        const Block total = sum_of_blocks();
        return total.weight != 0.0 ? total.sum / total.weight : not_known;
    }

    Estimate estimate() const {
        const Block total = sum_of_blocks();
        Estimate e;
        e.blocks = size();
        e.mean = total.weight != 0.0 ? total.sum / total.weight : not_known;
        if (e.blocks == 0 || std::isnan(e.mean)) return e;
        const double n = static_cast<double>(e.blocks);
        e.effective_samples = n;
        if (e.blocks < 2) return e;
        const double variance = autocovariance(e.mean, 0);
        const double tau = autocorrelation_time(e.mean);
        e.effective_samples = n / tau;
        e.error = std::sqrt(tau * variance * n * n / (n - 1.0)) / std::abs(total.weight);
        return e;
    }

    /// Mean of each block of run `run` in order of time; blocks without weight are left out.
    std::vector<double> block_means(std::size_t run = 0) const {
        std::vector<double> means;
        if (run >= runs_.size()) return means;
        for (const Block& b : runs_[run].blocks)
            if (b.weight != 0.0) means.push_back(b.sum / b.weight);
        return means;
    }
    /// Periods that one block of run `run` covers.
    std::size_t periods_per_block(std::size_t run = 0) const {
        return run < runs_.size() ? runs_[run].periods_per_block : 1;
    }

    /// Integrated autocorrelation time of the residuals about `mean`, in blocks; at least 1.
    double autocorrelation_time(double mean) const {
        const double variance = autocovariance(mean, 0);
        if (!(variance > 0.0)) return 1.0;
        const std::size_t longest = longest_run();
        double sum = -variance, last = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k + 1 < longest; k += 2) {
            double pair = autocovariance(mean, k) + autocovariance(mean, k + 1);
            if (!(pair > 0.0)) break;
            pair = std::min(pair, last);
            last = pair;
            sum += 2.0 * pair;
        }
        return std::max(1.0, sum / variance);
    }

    /// All that has to be kept to go on later (checkpoints).
    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(current_);
        visit(runs_);
    }

    struct Run {
        std::vector<Block> blocks;
        std::size_t periods_per_block = 1;
        Block filling;           // not yet full, when a block covers several periods
        std::size_t filled = 0;  // periods in it

        void add(const Block& period) {
            filling = {filling.sum + period.sum, filling.weight + period.weight};
            if (++filled < periods_per_block) return;
            blocks.push_back(filling);
            filling = {};
            filled = 0;
            if (blocks.size() < most_blocks_per_run) return;
            for (std::size_t b = 0; b < blocks.size() / 2; ++b)
                blocks[b] = {blocks[2 * b].sum + blocks[2 * b + 1].sum,
                             blocks[2 * b].weight + blocks[2 * b + 1].weight};
            blocks.resize(blocks.size() / 2);
            periods_per_block *= 2;
        }
        template <class Visitor>
        void fields(Visitor&& visit) {
            visit(blocks);
            visit(periods_per_block);
            visit(filling);
            visit(filled);
        }
    };

  private:
    Block sum_of_blocks() const {
        Block total;
        for (const Run& run : runs_) {
            for (const Block& b : run.blocks) total = {total.sum + b.sum, total.weight + b.weight};
        }
        return total;
    }
    std::size_t longest_run() const {
        std::size_t n = 0;
        for (const Run& run : runs_) n = std::max(n, run.blocks.size());
        return n;
    }
    /// Σ d_b d_{b+lag} / n, within runs.
    double autocovariance(double mean, std::size_t lag) const {
        double sum = 0.0;
        for (const Run& run : runs_) {
            const auto residual = [&](std::size_t b) {
                return run.blocks[b].sum - mean * run.blocks[b].weight;
            };
            for (std::size_t b = 0; b + lag < run.blocks.size(); ++b)
                sum += residual(b) * residual(b + lag);
        }
        return sum / static_cast<double>(size());
    }

    std::size_t current_ = 0;  // the run that is being added to
    std::vector<Run> runs_;
};

/// A series whose block is filled value by value.
class BlockMean {
  public:
    void add(double value, double weight = 1.0) {
        open_.sum += value * weight;
        open_.weight += weight;
    }
    void close_block() {
        series_.add(open_.sum, open_.weight);
        open_ = {};
    }
    Estimate estimate() const { return series_.estimate(); }
    const BlockSeries& series() const { return series_; }
    void merge(const BlockMean& other) { series_.merge(other.series_); }
    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(open_);
        series_.fields(visit);
    }

  private:
    Block open_;
    BlockSeries series_;
};

/// Mean and error of equally weighted values in order of time.
inline Estimate estimate_of(std::span<const double> values) {
    BlockSeries series;
    for (const double value : values) series.add(value, 1.0);
    return series.estimate();
}

/// Whether a run has forgotten how it began.
struct SteadyState {
    enum class Verdict : std::uint8_t {
        steady,
        drifting,   // still changing at the end
        too_short,  // fewer than 50 blocks: nothing can be said
    };
    Verdict verdict = Verdict::too_short;
    std::size_t warm_up = 0;   // blocks to drop (MSER-5)
    double drift = not_known;  // Geweke's z after dropping them
    double most_drift = 4.0;   // that may be chance

    bool drifts() const { return !(std::abs(drift) <= most_drift); }
};

/// MSER-5: how many of the first blocks to drop; a multiple of five, at most half.
inline std::size_t mser5_truncation(std::span<const double> blocks) {
    const std::size_t n = blocks.size() / 5;
    std::vector<double> batch(n);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t k = 0; k < 5; ++k) batch[i] += blocks[5 * i + k] / 5.0;
    // From the back, with Welford's update, so that nothing cancels.
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity(), mean = 0.0, squares = 0.0;
    for (std::size_t d = n; d-- > 0;) {
        const double left = static_cast<double>(n - d);
        const double step = batch[d] - mean;
        mean += step / left;
        squares += step * (batch[d] - mean);
        if (d > n / 2 || n - d < 2) continue;
        const double score = squares / (left * left);
        if (score <= least) {
            least = score;
            best = d;
        }
    }
    return 5 * best;
}

/// The quantile of Student's t with this many degrees of freedom that `normal` is for a normal
/// deviate.
inline double student_quantile(double normal, double freedom) {
    const double z = normal, z3 = z * z * z, z5 = z3 * z * z;
    return z + (z3 + z) / (4.0 * freedom) +
           (5.0 * z5 + 16.0 * z3 + 3.0 * z) / (96.0 * freedom * freedom);
}

/// Geweke's z, the first fifth of a series against its last half, and the most that may be chance.
inline void test_for_drift(std::span<const double> blocks, SteadyState& state) {
    const Estimate early = estimate_of(blocks.first(blocks.size() / 5));
    const Estimate late = estimate_of(blocks.last(blocks.size() / 2));
    const double a = early.error * early.error, b = late.error * late.error;
    if (a + b == 0.0 && early.mean == late.mean) {
        state.drift = 0.0;
        return;
    }
    state.drift = (early.mean - late.mean) / std::sqrt(a + b);
    const double freedom =
        (a + b) * (a + b) /
        (a * a / (early.effective_samples - 1.0) + b * b / (late.effective_samples - 1.0));
    // At least one: fewer than two effective samples tell nothing of their own scatter.
    state.most_drift = student_quantile(4.0, freedom >= 1.0 ? freedom : 1.0);
}

/// Blocks that it takes to say anything.
inline constexpr std::size_t least_blocks_of_a_steady_state = 50;

/// How much warm-up a run needed, and whether it has reached a steady state.
inline SteadyState find_steady_state(std::span<const double> blocks) {
    SteadyState state;
    if (blocks.size() < least_blocks_of_a_steady_state) return state;
    for (const double block : blocks)
        if (std::isnan(block)) return state;
    const std::size_t half = 5 * (blocks.size() / 5 / 2);
    state.warm_up = mser5_truncation(blocks);
    test_for_drift(blocks.subspan(state.warm_up), state);
    const bool settled = state.warm_up < half && !state.drifts();
    state.verdict = settled ? SteadyState::Verdict::steady : SteadyState::Verdict::drifting;
    return state;
}

/// What is left of a series when its straight line is taken away.
inline std::vector<double> without_trend(std::span<const double> blocks) {
    const double n = static_cast<double>(blocks.size()), middle = (n - 1.0) / 2.0;
    double mean = 0.0, slope = 0.0;
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        mean += blocks[b] / n;
        slope += (static_cast<double>(b) - middle) * blocks[b];
    }
    slope *= n > 1.0 ? 12.0 / (n * (n * n - 1.0)) : 0.0;
    std::vector<double> rest(blocks.begin(), blocks.end());
    for (std::size_t b = 0; b < rest.size(); ++b)
        rest[b] -= mean + slope * (static_cast<double>(b) - middle);
    return rest;
}

/// While a run goes on: are these, all blocks so far, warm-up enough?
inline bool beginning_is_forgotten(std::span<const double> blocks) {
    constexpr double most_trend = 2.0;
    const SteadyState state = find_steady_state(blocks);
    if (state.verdict != SteadyState::Verdict::steady) return false;
    const auto left = blocks.subspan(state.warm_up);
    const auto early = left.first(left.size() / 5), late = left.last(left.size() / 2);
    const double change = std::abs(estimate_of(early).mean - estimate_of(late).mean);
    const double a = estimate_of(without_trend(early)).error,
                 b = estimate_of(without_trend(late)).error;
    return change <= most_trend * std::sqrt(a * a + b * b);
}

}  // namespace swirl
