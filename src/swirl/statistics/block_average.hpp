// How well a mean is known. A run delivers blocks, each covering whole periods: the sum of a
// quantity over the block, and the weight (number of samples, or time) over which it was summed.
//
// Mean. m = ΣS / ΣW over all blocks, so every sample counts the same, however many fell into a
// period. With S_b the sum and W_b the weight of block b this is a ratio estimator. What scatters
// is the residual d_b = S_b − m W_b (Cochran, Sampling Techniques, 3rd ed. 1977, §6.3):
//
//     error² = τ · n/(n−1) · Σ d_b² / (ΣW)²
//
// Correlation between periods. τ = 1 + 2 Σ_k ρ_k is the integrated autocorrelation time of the
// residuals in blocks, summed over Geyer's initial monotone positive sequence (Geyer 1992,
// doi:10.1214/ss/1177011137) and taken to be at least 1. n/τ is the number of effective samples.
// If runs were merged, no product combines blocks of two runs.
//
// Units and normalisation: those of the values added. Limits: fewer than two blocks have no error
// (NaN); no blocks, or no weight, have no mean (NaN); a NaN added makes the mean NaN. The error has
// a relative uncertainty of about 1/√(2n/τ). Runs of very many periods are coarsened: when a run
// reaches 2048 blocks, neighbouring blocks are joined, so memory stays bounded.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace swirl {

inline constexpr double not_available = std::numeric_limits<double>::quiet_NaN();

/// A mean, its standard error, and the data behind them.
struct Estimate {
    double mean = not_available;
    double error = not_available;
    double effective_samples = 0.0;
    std::size_t blocks = 0;
    /// What the values count in the mean; 0 if the mean is none of such values. The mean over parts
    /// of a run, each with its weight, is that of the run.
    double weight = 0.0;
};

/// An estimate times a factor: other units, or a normalisation.
inline Estimate scaled(Estimate e, double factor) {
    e.mean *= factor;
    e.error *= std::abs(factor);
    return e;
}

/// One block: the sum of the quantity, and the weight over which it was summed.
struct Block {
    double sum = 0.0, weight = 0.0;
};

/// Integrated autocorrelation time, at least 1, from the autocovariances of lags below `lags`:
/// Geyer's sum.
template <class Autocovariance>
double autocorrelation_time(std::size_t lags, const Autocovariance& autocovariance) {
    const double variance = autocovariance(0);
    if (!(variance > 0.0)) return 1.0;
    double sum = -variance, last = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k + 1 < lags; k += 2) {
        double pair = autocovariance(k) + autocovariance(k + 1);
        if (!(pair > 0.0)) break;
        pair = std::min(pair, last);
        last = pair;
        sum += 2.0 * pair;
    }
    return std::max(1.0, sum / variance);
}

/// Mean and error of values in order of time, without joining any of them; and their integrated
/// autocorrelation time, NaN for fewer than two values. No weights: all values count the same.
struct SeriesEstimate {
    Estimate estimate;
    double autocorrelation_time = not_available;
};
inline SeriesEstimate estimate_of_series(std::span<const double> values,
                                         std::span<const double> weights = {}) {
    SeriesEstimate found;
    const auto n = static_cast<double>(values.size());
    const auto weight = [&](std::size_t k) { return weights.empty() ? 1.0 : weights[k]; };
    double sum = 0.0, total = 0.0;
    for (std::size_t k = 0; k < values.size(); ++k) {
        sum += weight(k) * values[k];
        total += weight(k);
    }
    found.estimate.blocks = values.size();
    if (values.empty()) return found;
    const double mean = sum / total, mean_weight = total / n;
    const auto residual = [&](std::size_t k) {
        return weight(k) / mean_weight * (values[k] - mean);
    };
    found.estimate.mean = mean;
    found.estimate.effective_samples = n;
    if (values.size() < 2) return found;
    const auto autocovariance = [&](std::size_t lag) {
        double product = 0.0;
        for (std::size_t k = 0; k + lag < values.size(); ++k)
            product += residual(k) * residual(k + lag);
        return product / n;
    };
    const double tau = autocorrelation_time(values.size(), autocovariance);
    found.autocorrelation_time = tau;
    found.estimate.effective_samples = n / tau;
    found.estimate.error = std::sqrt(tau * autocovariance(0) / (n - 1.0));
    return found;
}

/// The blocks of one run, or of several runs one after the other.
class BlockSeries {
  public:
    static constexpr std::size_t max_blocks_per_run = 2048;

    /// Closes a block of one period. A block without weight counts as a block.
    void add(double sum, double weight) {
        if (runs_.empty()) runs_.emplace_back();
        runs_[current_].add({sum, weight});
    }
    /// Adds the blocks of an independent run. Blocks added later still continue this run.
    void merge(const BlockSeries& other) {
        if (runs_.empty()) runs_.emplace_back();
        for (std::size_t r = 0; r < other.runs_.size(); ++r)
            if (!other.runs_[r].blocks.empty()) runs_.push_back(other.runs_[r]);
    }

    /// Without its blocks, the series continues as one that has just begun.
    void forget_blocks() { *this = {}; }

    bool empty() const { return size() == 0; }
    std::size_t size() const {
        std::size_t n = 0;
        for (const Run& run : runs_) n += run.blocks.size();
        return n;
    }
    /// Runs that have a block.
    std::size_t runs() const {
        std::size_t n = 0;
        for (const Run& run : runs_) n += run.blocks.empty() ? 0 : 1;
        return n;
    }

    double mean() const {
        const Block total = sum_of_blocks();
        return total.weight != 0.0 ? total.sum / total.weight : not_available;
    }

    Estimate estimate() const {
        const Block total = sum_of_blocks();
        Estimate e;
        e.blocks = size();
        e.mean = total.weight != 0.0 ? total.sum / total.weight : not_available;
        e.weight = total.weight;
        if (e.blocks == 0 || std::isnan(e.mean)) return e;
        const double n = static_cast<double>(e.blocks), used = blocks_with_weight();
        e.effective_samples = used;
        if (used < 2.0) return e;
        const double variance = autocovariance(e.mean, 0);
        const double tau = autocorrelation_time(e.mean);
        e.effective_samples = used / tau;
        e.error = std::sqrt(tau * variance * n * used / (used - 1.0)) / std::abs(total.weight);
        return e;
    }

    /// Mean of each block of run `run` in order of time; blocks without weight are omitted.
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
        return swirl::autocorrelation_time(
            longest_run(), [&](std::size_t lag) { return autocovariance(mean, lag); });
    }

    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(current_, runs_);
    }
    bool is_consistent() const { return current_ < std::max<std::size_t>(runs_.size(), 1); }

    struct Run {
        std::vector<Block> blocks;
        std::size_t periods_per_block = 1;
        Block filling;           // the open block, if a block covers several periods
        std::size_t filled = 0;  // periods in the open block

        void add(const Block& period) {
            filling = {filling.sum + period.sum, filling.weight + period.weight};
            if (++filled < periods_per_block) return;
            blocks.push_back(filling);
            filling = {};
            filled = 0;
            if (blocks.size() < max_blocks_per_run) return;
            for (std::size_t b = 0; b < blocks.size() / 2; ++b)
                blocks[b] = {blocks[2 * b].sum + blocks[2 * b + 1].sum,
                             blocks[2 * b].weight + blocks[2 * b + 1].weight};
            blocks.resize(blocks.size() / 2);
            periods_per_block *= 2;
        }
        template <class Visitor>
        void fields(Visitor&& visit) {
            visit(blocks, periods_per_block, filling, filled);
        }
        bool is_consistent() const {
            return blocks.size() < max_blocks_per_run && std::has_single_bit(periods_per_block) &&
                   filled < periods_per_block;
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
    /// Those without say nothing about the mean.
    double blocks_with_weight() const {
        double n = 0.0;
        for (const Run& run : runs_)
            for (const Block& b : run.blocks) n += b.weight != 0.0 ? 1.0 : 0.0;
        return n;
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

    std::size_t current_ = 0;  // the run to which blocks are added
    std::vector<Run> runs_;
};

/// A series to whose open block values are added one by one.
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
    /// For a loop that adds values itself, as add() does.
    Block& open() { return open_; }
    /// The mean of the open block; NaN without a value.
    double open_mean() const {
        return open_.weight != 0.0 ? open_.sum / open_.weight : not_available;
    }
    Estimate estimate() const { return series_.estimate(); }
    const BlockSeries& series() const { return series_; }
    void merge(const BlockMean& other) { series_.merge(other.series_); }
    void forget_blocks() { series_.forget_blocks(); }
    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(open_, series_);
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

/// Base of a class M with several averages. M lists them once, in the order of its checkpoint:
///
///     static auto averages(auto& s) { return std::tie(s.a_, s.b_); }
template <class M>
class MergedAverages {
  public:
    /// Adds the closed blocks of an independent run.
    void merge(const M& other) {
        const auto into = M::averages(static_cast<M&>(*this));
        const auto from = M::averages(other);
        [&]<std::size_t... K>(std::index_sequence<K...>) {
            (std::get<K>(into).merge(std::get<K>(from)), ...);
        }
        (std::make_index_sequence<std::tuple_size_v<decltype(into)>>{});
    }

  protected:
    template <class Visitor>
    void visit_averages(Visitor&& visit) {
        std::apply(visit, M::averages(static_cast<M&>(*this)));
    }
};

/// The same if the blocks of all averages are closed together.
template <class M>
class BlockAverages : public MergedAverages<M> {
  public:
    void close_block() {
        this->visit_averages([](auto&... average) { (average.close_block(), ...); });
    }
};

}  // namespace swirl
