// How well one quantity predicts another over a set of points: Spearman's rank correlation and R²
// of a straight line, with errors from the jackknife over the points (Efron, Tibshirani, An
// Introduction to the Bootstrap, 1993, ch. 11):
//
//     error² = (n − 1)/n · Σ_k (θ_(k) − θ̄)²,     θ_(k): the value without point k,
//                                                θ̄: the mean of these values.
//
// Limits: NaN with fewer than four points, or if all values of one quantity are equal. Equal values
// have their mean rank.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <vector>

#include "swirl/statistics/block_average.hpp"

namespace swirl {

using Values = std::vector<double>;

/// Pearson's correlation.
inline double correlation_of(const Values& x, const Values& y) {
    const auto n = static_cast<double>(x.size());
    const double mx = std::accumulate(x.begin(), x.end(), 0.0) / n;
    const double my = std::accumulate(y.begin(), y.end(), 0.0) / n;
    double xx = 0.0, xy = 0.0, yy = 0.0;
    for (std::size_t k = 0; k < x.size(); ++k) {
        xx += (x[k] - mx) * (x[k] - mx);
        xy += (x[k] - mx) * (y[k] - my);
        yy += (y[k] - my) * (y[k] - my);
    }
    return xy / std::sqrt(xx * yy);
}

inline Values ranks_of(const Values& x) {
    Values ranks;
    for (const double value : x) {
        double rank = 0.5;
        for (const double other : x) rank += other < value ? 1.0 : other == value ? 0.5 : 0.0;
        ranks.push_back(rank);
    }
    return ranks;
}

inline double rank_correlation_of(const Values& x, const Values& y) {
    return correlation_of(ranks_of(x), ranks_of(y));
}

/// A statistic as a function of the indices of the points, and its jackknife error.
inline Estimate jackknife(std::size_t points,
                          const std::function<double(const std::vector<std::size_t>&)>& statistic) {
    Estimate e;
    e.blocks = points;
    if (points < 4) return e;
    std::vector<std::size_t> all(points);
    std::iota(all.begin(), all.end(), std::size_t{0});
    e.mean = statistic(all);
    Values without;
    for (std::size_t k = 0; k < points; ++k) {
        std::vector<std::size_t> others = all;
        others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
        without.push_back(statistic(others));
    }
    const auto n = static_cast<double>(points);
    const double mean = std::accumulate(without.begin(), without.end(), 0.0) / n;
    double square = 0.0;
    for (const double value : without) square += (value - mean) * (value - mean);
    e.error = std::sqrt((n - 1.0) / n * square);
    return e;
}

inline Values chosen(const Values& all, const std::vector<std::size_t>& numbers) {
    Values values;
    for (const std::size_t k : numbers) values.push_back(all[k]);
    return values;
}

}  // namespace swirl
