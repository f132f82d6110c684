// Test whether a run has reached a steady state, from the blocks of one of its averages
// (block_average.hpp). Three tests use all the blocks of the average:
//
// Change. A step at block k divides the series where it reduces the sum of squares most, but not
// within a twentieth of either end or within ten blocks. Its size is
// z = (m_2 − m_1)/√(error_1² + error_2²). A step, or a trend, would enlarge the errors and so hide
// itself. Therefore the errors rest on the residuals about a straight line in each of the two
// parts. The error with one variance for all blocks and the error with a variance for each part are
// both formed, and the larger counts. The limit is the quantile of Student's t that `max_change`
// is for a normal deviate, with Welch's degrees of freedom from the effective samples. The change
// is a jump if the step describes it well: better than a straight line, and nearly as well as two
// lines. Otherwise it is a drift.
//
// Could it miss a change? Few effective samples make the limit large: with 26, that of a change in
// the middle is 10 errors. Near an end, the shorter part may have so few that the error with a
// variance of its own has a limit of 30 or 100. Then the error with one variance for all decides
// that there is no change, if its own test finds none. If it finds one, or if every limit is above
// 10 errors, a change of 10 errors could be missed: the run is too short to tell.
//
// Transient. The mean of the first fifth is compared with that of the last half. (Geweke 1992,
// doi:10.21034/sr.148, takes a tenth; a fifth keeps more blocks in a short run.) The last half
// alone, without its trend, gives the error of both, so that a slow beginning cannot hide itself. A
// transient is a drift.
//
// Two states. The series is averaged over windows of 1, 2, 4, … blocks, as long as there are 40
// windows. The best threshold divides the windows into two classes (Otsu 1979,
// doi:10.1109/TSMC.1979.4310076). The separation is the share of the variance between the classes:
// 2/π = 0.64 for a normal distribution, whatever its correlation, and 1 for two sharp levels. The
// window with the largest separation counts. A change of state is noted when the
// series comes nearer to the other level than a quarter of their distance. The series switches
// between two states if the separation is at least 0.85, if it changes at least twice, and if a
// visit to either state lasts five windows on average.
//
// Error rates, measured: docs/explanation/statistics.md has the table
// (tests/run/steady_state_calibration_test.cpp).
//
// Warm-up while a run continues. The blocks so far are tested at intervals, from 50 of them on. The
// end of the warm-up is that of MSER-5: blocks are averaged in fives, and the truncation d ≤ n/2
// minimises the squared standard error of the remainder, Σ_{i>d}(Y_i − Ȳ_d)² / (n − d)² (White
// 1997, doi:10.1177/003754979706900601; batches of five: White, Cobb, Spratt, Proceedings of the
// 2000 Winter Simulation Conference). The warm-up is over when MSER-5 cuts off less than the first
// half and the remainder has no drift. For that, the first fifth of the remainder is compared with
// its last half, each with its own correlated error: |z| ≤ 4 (of Student's t) with these errors,
// and |z| ≤ 2 with the errors about straight lines. (Two, because waiting a little longer costs
// less than beginning too early.) All blocks up to then are the warm-up.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "swirl/statistics/block_average.hpp"
#include "swirl/statistics/student.hpp"

namespace swirl {

/// Minimum number of blocks for the tests.
inline constexpr std::size_t min_blocks_of_a_steady_state = 50;
/// Limit of the change test, as a normal deviate.
inline constexpr double max_change = 4.5;
/// A change of more standard errors is never random enough for a steady series.
inline constexpr double max_steady_change = 10.0;

/// The largest change that chance explains. The autocorrelation time is estimated from the same
/// blocks, which makes the error less certain: a third of the degrees of freedom remain (Error
/// rates, above).
inline double limit_of_change(double freedom) {
    return student_quantile(max_change, freedom >= 3.0 ? freedom / 3.0 : 1.0);
}

/// A change of the mean.
struct MeanChange {
    std::size_t at = 0;  // the first block after it
    double before = not_available, after = not_available;
    double size = not_available;      // unit: standard errors
    double max_size = not_available;  // largest size that chance explains
    bool is_jump = false;             // otherwise a drift
    double effective_samples = 0.0;   // samples in the blocks without the change

    bool found() const { return std::abs(size) > max_size; }
    /// Whether the test says something if it finds nothing: it would have found a change of
    /// `max_steady_change` errors.
    bool decides() const {
        if (size == 0.0) return true;  // a constant; its residuals are rounding errors
        return max_size <= max_steady_change &&
               limit_of_change(effective_samples - 4.0) <= max_steady_change;
    }
};

/// Two levels between which a series switches.
struct TwoStates {
    double low = not_available, high = not_available;
    double separation = 0.0;    // share of the variance between the two
    std::size_t changes = 0;    // steps from one to the other
    double shortest_visit = 0;  // windows: mean over the visits to the state with the shorter ones
    std::size_t window = 1;     // blocks
    /// Windows in the lower and in the higher state, and how often the series leaves it.
    std::array<std::size_t, 2> stayed{}, departures{};

    // The thresholds are those of "Two states", above.
    bool found() const { return separation >= 0.85 && changes >= 2 && shortest_visit >= 5.0; }
};

/// True if a run is independent of its initial state and stays in one state.
struct SteadyState {
    enum class Verdict : std::uint8_t {
        steady,
        drifting,   // the mean changes gradually
        jumping,    // the mean changes in one step
        switching,  // changes between two states
        too_short,  // fewer than 50 blocks, or too few effective samples: unknown
    };
    Verdict verdict = Verdict::too_short;
    MeanChange change;
    TwoStates states;
    double period = not_available;  // time of the change since the run's beginning
};

/// The residuals of a series about its straight-line fit.
inline std::vector<double> without_trend(std::span<const double> blocks) {
    const double n = static_cast<double>(blocks.size()), middle = (n - 1.0) / 2.0;
    double mean = 0.0, slope = 0.0;
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        mean += blocks[b] / n;
        slope += (static_cast<double>(b) - middle) * blocks[b];
    }
    slope *= n > 1.0 ? 12.0 / (n * (n * n - 1.0)) : 0.0;
    std::vector<double> residuals(blocks.begin(), blocks.end());
    for (std::size_t b = 0; b < residuals.size(); ++b)
        residuals[b] -= mean + slope * (static_cast<double>(b) - middle);
    return residuals;
}

inline double mean_of(std::span<const double> values) {
    double sum = 0.0;
    for (const double value : values) sum += value;
    return sum / static_cast<double>(values.size());
}

/// Σ (value − mean)².
inline double squares_about(std::span<const double> values, double mean) {
    double squares = 0.0;
    for (const double value : values) squares += (value - mean) * (value - mean);
    return squares;
}

/// The division into the first k values and the others whose two means reduce the sum of squares
/// most.
struct Division {
    std::size_t at = 0;
    double reduction = 0.0;
};
inline Division best_division(std::span<const double> values, std::size_t minimum) {
    Division best;
    const double n = static_cast<double>(values.size()), mean = mean_of(values);
    double sum = 0.0;
    for (std::size_t k = 1; k + minimum <= values.size(); ++k) {
        sum += values[k - 1] - mean;
        const double share = static_cast<double>(k) / n;
        const double reduction = sum * sum / (n * share * (1.0 - share));
        if (k >= minimum && (best.at == 0 || reduction > best.reduction)) best = {k, reduction};
    }
    return best;
}

/// The error of the difference of two means, and its degrees of freedom.
struct DifferenceError {
    double variance, freedom, effective_samples;
};
/// The error of the difference between the mean of the first `at` residuals and the mean of the
/// others, with one variance for all and with one for each part. A straight line was subtracted
/// from each part, which costs two degrees of freedom.
struct DifferenceErrors {
    DifferenceError joint, separate;
};
inline DifferenceErrors errors_of_difference(std::span<const double> residuals, std::size_t at) {
    const Estimate early = estimate_of(residuals.first(at)),
                   late = estimate_of(residuals.subspan(at)), all = estimate_of(residuals);
    const double a = early.error * early.error, b = late.error * late.error;
    const double share = static_cast<double>(at) / static_cast<double>(residuals.size());
    const double joint = all.error * all.error / (share * (1.0 - share));
    const double freedom =
        welch_freedom(a, early.effective_samples - 2.0, b, late.effective_samples - 2.0);
    return {.joint = {joint, all.effective_samples - 4.0, all.effective_samples},
            .separate = {a + b, freedom, all.effective_samples}};
}

inline void set_size(MeanChange& change, const DifferenceError& error) {
    const double difference = change.after - change.before;
    change.size = difference == 0.0 ? 0.0 : difference / std::sqrt(error.variance);
    change.max_size = limit_of_change(error.freedom);
    change.effective_samples = error.effective_samples;
}

/// From the first fifth to the last half.
inline MeanChange transient(std::span<const double> blocks) {
    const auto early = blocks.first(blocks.size() / 5), late = blocks.last(blocks.size() / 2);
    MeanChange change;
    change.at = early.size();
    change.before = mean_of(early);
    change.after = mean_of(late);
    const Estimate residual = estimate_of(without_trend(late));
    const double ratio = static_cast<double>(late.size()) / static_cast<double>(early.size());
    set_size(change,
             {residual.error * residual.error * (1.0 + ratio), residual.effective_samples - 2.0,
              residual.effective_samples * static_cast<double>(blocks.size()) /
                  static_cast<double>(late.size())});
    return change;
}

inline MeanChange most_likely_change(std::span<const double> blocks) {
    MeanChange change;
    change.at = best_division(blocks, std::max<std::size_t>(10, blocks.size() / 20)).at;
    const auto early = blocks.first(change.at), late = blocks.subspan(change.at);
    change.before = mean_of(early);
    change.after = mean_of(late);
    std::vector<double> residuals = without_trend(early);
    for (const double residual : without_trend(late)) residuals.push_back(residual);
    const auto [joint, separate] = errors_of_difference(residuals, change.at);
    set_size(change, joint);
    const bool joint_finds_none = !change.found() && change.max_size <= max_steady_change;
    if (!(joint.variance >= separate.variance)) set_size(change, separate);
    if (change.max_size > max_steady_change && joint_finds_none) set_size(change, joint);
    const double step = squares_about(early, change.before) + squares_about(late, change.after);
    const double line = squares_about(without_trend(blocks), 0.0);
    change.is_jump = step < line && squares_about(residuals, 0.0) > 0.5 * step;
    return change;
}

/// Upper bounds of the measured rates at which the tests of a steady series with this many
/// effective samples find a change (docs/explanation/statistics.md).
inline double false_alarm_rate(const MeanChange& change) {
    return change.effective_samples >= 100.0  ? 0.0005
           : change.effective_samples >= 50.0 ? 0.004
                                              : 0.015;
}

/// Divides the values at the threshold that leaves the least variance within the two classes.
inline TwoStates two_classes(std::span<const double> values) {
    TwoStates states;
    std::vector<double> sorted(values.begin(), values.end());
    std::sort(sorted.begin(), sorted.end());
    const Division division = best_division(sorted, 1);
    const double squares = squares_about(sorted, mean_of(sorted));
    if (!(squares > 0.0)) return states;
    states.low = mean_of(std::span(sorted).first(division.at));
    states.high = mean_of(std::span(sorted).subspan(division.at));
    states.separation = division.reduction / squares;
    const double near = 0.25 * (states.high - states.low);
    std::array<std::size_t, 2> visits{};
    constexpr std::size_t none = 2;
    std::size_t state = none;
    for (const double value : values) {
        const std::size_t next = value > states.high - near  ? 1
                                 : value < states.low + near ? 0
                                                             : state;
        if (next == none) continue;
        if (next != state) {
            ++visits[next];
            if (state != none) ++states.departures[state];
        }
        ++states.stayed[next];
        state = next;
    }
    // Both states were visited: the smallest value is below its mean, the largest one above.
    states.changes = visits[0] + visits[1] - 1;
    for (const std::size_t s : {0, 1}) {
        const double visit = static_cast<double>(states.stayed[s]) / static_cast<double>(visits[s]);
        states.shortest_visit = s == 0 ? visit : std::min(visit, states.shortest_visit);
    }
    return states;
}

inline TwoStates find_two_states(std::span<const double> blocks) {
    constexpr std::size_t min_windows = 40;
    TwoStates best;
    for (std::size_t window = 1; blocks.size() / window >= min_windows; window *= 2) {
        std::vector<double> means;
        for (std::size_t b = 0; b + window <= blocks.size(); b += window)
            means.push_back(mean_of(blocks.subspan(b, window)));
        TwoStates states = two_classes(means);
        states.window = window;
        if (states.separation > best.separation) best = states;
    }
    return best;
}

/// Applies the three tests.
inline SteadyState find_steady_state(std::span<const double> blocks) {
    using Verdict = SteadyState::Verdict;
    SteadyState state;
    if (blocks.size() < min_blocks_of_a_steady_state) return state;
    for (const double block : blocks)
        if (std::isnan(block)) return state;
    state.states = find_two_states(blocks);
    state.change = most_likely_change(blocks);
    if (const MeanChange slow = transient(blocks); slow.found() && !state.change.found())
        state.change = slow;
    state.verdict = state.states.found() ? Verdict::switching
                    : state.change.found()
                        ? state.change.is_jump ? Verdict::jumping : Verdict::drifting
                    : state.change.decides() ? Verdict::steady
                                             : Verdict::too_short;
    return state;
}

/// MSER-5: how many of the first blocks to drop; a multiple of five, at most half.
inline std::size_t mser5_truncation(std::span<const double> blocks) {
    const std::size_t n = blocks.size() / 5;
    std::vector<double> batch(n);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t k = 0; k < 5; ++k) batch[i] += blocks[5 * i + k] / 5.0;
    // From the end, with Welford's update, which avoids cancellation.
    std::size_t best = 0;
    double minimum = std::numeric_limits<double>::infinity(), mean = 0.0, squares = 0.0;
    for (std::size_t d = n; d-- > 0;) {
        const double left = static_cast<double>(n - d);
        const double step = batch[d] - mean;
        mean += step / left;
        squares += step * (batch[d] - mean);
        if (d > n / 2 || n - d < 2) continue;
        const double score = squares / (left * left);
        if (score <= minimum) {
            minimum = score;
            best = d;
        }
    }
    return 5 * best;
}

/// True if the blocks so far are a sufficient warm-up. Called while a run continues.
inline bool beginning_is_forgotten(std::span<const double> blocks) {
    constexpr double max_drift = 4.0, max_trend = 2.0;
    if (blocks.size() < min_blocks_of_a_steady_state) return false;
    for (const double block : blocks)
        if (std::isnan(block)) return false;
    const std::size_t warm_up = mser5_truncation(blocks);
    if (warm_up >= 5 * (blocks.size() / 5 / 2)) return false;
    const auto left = blocks.subspan(warm_up);
    const auto early = left.first(left.size() / 5), late = left.last(left.size() / 2);
    const Estimate first = estimate_of(early), last = estimate_of(late);
    const double change = std::abs(first.mean - last.mean);
    const double c = first.error * first.error, d = last.error * last.error;
    const double freedom =
        welch_freedom(c, first.effective_samples - 1.0, d, last.effective_samples - 1.0);
    if (change > 0.0 &&
        !(change <= student_quantile(max_drift, freedom >= 1.0 ? freedom : 1.0) * std::sqrt(c + d)))
        return false;
    const double a = estimate_of(without_trend(early)).error,
                 b = estimate_of(without_trend(late)).error;
    return change <= max_trend * std::sqrt(a * a + b * b);
}

}  // namespace swirl
