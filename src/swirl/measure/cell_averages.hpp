// Averages over the cells of a map or the bins of a profile, with errors from blocks of periods.
//
//   CellMeans   the average over the visitors of the cell: m = Σ s_b / Σ w_b, with the sum s_b and
//               the number of visits w_b of block b, both of that cell
//   CellRates   the amount in the cell per sample: m = Σ s_b / Σ w_b, with w_b the samples of block
//               b, common to all cells
//
// Both are ratios of sums over n blocks with a weight. What scatters is s_b − m w_b, so
//
//     error² = n/(n−1) · (Σ s_b² − 2m Σ s_b w_b + m² Σ w_b²) / (Σ w_b)²
//
// which needs five sums per cell, however long the run. Unlike block_average.hpp this takes the
// blocks for independent: a cell forgets within a period, and 10⁴ cells cannot each store their
// history.
//
// Limits: a cell never visited has no mean (NaN); in CellRates it is 0 if there was a sample. With
// fewer than two such blocks the error is NaN. The open block does not count.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "swirl/statistics/block_average.hpp"

namespace swirl {

/// The five sums of one quantity in one cell.
struct RatioSums {
    double s = 0.0, w = 0.0, ss = 0.0, sw = 0.0, ww = 0.0;

    /// `n` of the blocks have a weight.
    Estimate estimate(std::size_t blocks, double n) const {
        Estimate e;
        e.blocks = blocks;
        if (w == 0.0) return e;
        e.mean = s / w;
        e.weight = w;
        e.effective_samples = n;
        if (n < 2.0) return e;
        const double square = ss - 2.0 * e.mean * sw + e.mean * e.mean * ww;
        e.error = std::sqrt(std::max(square, 0.0) * n / (n - 1.0)) / std::abs(w);
        return e;
    }
};

template <std::size_t Quantities>
class CellMeans {
  public:
    explicit CellMeans(std::size_t cells) : open_(cells), sums_(cells) {}

    std::size_t size() const { return sums_.size(); }
    std::size_t blocks() const { return blocks_; }

    /// The values of one visit, or the sums over several.
    void add(std::size_t cell, const std::array<double, Quantities>& values, double visits = 1.0) {
        Open& o = open_[cell];
        o.visits += visits;
        for (std::size_t k = 0; k < Quantities; ++k) o.sum[k] += values[k];
    }
    void close_block() {
        ++blocks_;
        for (std::size_t cell = 0; cell < sums_.size(); ++cell) {
            Open& o = open_[cell];
            Sums& t = sums_[cell];
            if (o.visits == 0.0) continue;
            t.n += 1.0;
            t.w += o.visits;
            t.ww += o.visits * o.visits;
            for (std::size_t k = 0; k < Quantities; ++k) {
                t.s[k] += o.sum[k];
                t.ss[k] += o.sum[k] * o.sum[k];
                t.sw[k] += o.sum[k] * o.visits;
            }
            o = {};
        }
    }
    double visits(std::size_t cell) const { return sums_[cell].w; }
    double mean(std::size_t cell, std::size_t quantity = 0) const {
        const Sums& t = sums_[cell];
        return t.w != 0.0 ? t.s[quantity] / t.w : not_available;
    }
    Estimate estimate(std::size_t cell, std::size_t quantity = 0) const {
        const Sums& t = sums_[cell];
        return RatioSums{t.s[quantity], t.w, t.ss[quantity], t.sw[quantity], t.ww}.estimate(blocks_,
                                                                                            t.n);
    }
    void forget_blocks() {
        std::fill(sums_.begin(), sums_.end(), Sums{});
        blocks_ = 0;
    }
    /// The other must have as many cells.
    void merge(const CellMeans& other) {
        blocks_ += other.blocks_;
        for (std::size_t c = 0; c < sums_.size(); ++c) {
            Sums& t = sums_[c];
            const Sums& o = other.sums_[c];
            t.n += o.n;
            t.w += o.w;
            t.ww += o.ww;
            for (std::size_t k = 0; k < Quantities; ++k) {
                t.s[k] += o.s[k];
                t.ss[k] += o.ss[k];
                t.sw[k] += o.sw[k];
            }
        }
    }
    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(std::span(open_));
        visit(std::span(sums_));
        visit(blocks_);
    }

  private:
    struct Open {
        double visits = 0.0;
        std::array<double, Quantities> sum{};
    };
    struct Sums {
        double n = 0.0, w = 0.0, ww = 0.0;  // n: blocks with a visit
        std::array<double, Quantities> s{}, ss{}, sw{};
    };
    std::vector<Open> open_;
    std::vector<Sums> sums_;
    std::size_t blocks_ = 0;
};

class CellRates {
  public:
    explicit CellRates(std::size_t cells) : open_(cells), s_(cells), ss_(cells), sw_(cells) {}

    std::size_t size() const { return s_.size(); }
    std::size_t blocks() const { return blocks_; }

    void add(std::size_t cell, double amount = 1.0) { open_[cell] += amount; }
    /// Counts a sample; if the amounts are per time, adds the time that has passed.
    void add_weight(double weight = 1.0) { weight_ += weight; }

    void close_block() {
        ++blocks_;
        used_ += weight_ != 0.0 ? 1.0 : 0.0;
        w_ += weight_;
        ww_ += weight_ * weight_;
        // All cells, visited or not: as columns this is faster than a list of the visited ones.
        double *const open = open_.data(), *const s = s_.data(), *const ss = ss_.data(),
                      *const sw = sw_.data();
        for (std::size_t c = 0; c < open_.size(); ++c) {
            s[c] += open[c];
            ss[c] += open[c] * open[c];
            sw[c] += open[c] * weight_;
            open[c] = 0.0;
        }
        weight_ = 0.0;
    }
    double weight() const { return w_; }
    double sum(std::size_t cell) const { return s_[cell]; }
    double mean(std::size_t cell) const { return w_ != 0.0 ? s_[cell] / w_ : not_available; }
    Estimate estimate(std::size_t cell) const {
        return RatioSums{s_[cell], w_, ss_[cell], sw_[cell], ww_}.estimate(blocks_, used_);
    }
    void forget_blocks() {
        for (auto* column : {&s_, &ss_, &sw_}) std::fill(column->begin(), column->end(), 0.0);
        w_ = ww_ = used_ = 0.0;
        blocks_ = 0;
    }
    /// The other must have as many cells.
    void merge(const CellRates& other) {
        blocks_ += other.blocks_;
        used_ += other.used_;
        w_ += other.w_;
        ww_ += other.ww_;
        for (std::size_t c = 0; c < s_.size(); ++c) {
            s_[c] += other.s_[c];
            ss_[c] += other.ss_[c];
            sw_[c] += other.sw_[c];
        }
    }
    template <class Visitor>
    void fields(Visitor&& visit) {
        for (auto* column : {&open_, &s_, &ss_, &sw_}) visit(std::span(*column));
        visit(weight_, w_, ww_, used_, blocks_);
    }

  private:
    std::vector<double> open_, s_, ss_, sw_;
    double weight_ = 0.0, w_ = 0.0, ww_ = 0.0, used_ = 0.0;  // used: blocks with a weight
    std::size_t blocks_ = 0;
};

}  // namespace swirl
