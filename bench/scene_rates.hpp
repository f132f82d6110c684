// Measures the event rate of the engine in the scenes of docs/results/performance.md, each next
// to a baseline in the same run. The baselines are optimised, but lack the methods of this engine:
// one searches all pairs (baselines/all_pairs.hpp), the other uses neighbour lists and a calendar
// of events (baselines/neighbor_lists.hpp). Compare ratios, not rates: a rate depends on the
// processor and on what else it executes.
//
// One thread; processor time. The engine, the baseline and the scene to compare with (if any) run
// alternately for a fraction of a second each; a rate is the median over these turns. The baseline
// is the one that was fastest in a short trial. Containers count all events, gases count
// collisions.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "swirl/engine/simulation.hpp"

namespace swirl {

struct BenchSettings {
    bool full = false;                          // 10⁵ and 10⁶ discs, too
    std::string only = {};                      // scenes whose name contains this text
    std::vector<Width> widths = {Width::best};  // vector widths of the event loop
    double seconds = 1.0;                       // processor time for each rate
    const std::atomic<bool>* stop = nullptr;
    std::function<void(double fraction, const std::string& scene)> progress;
};

/// A measured value and its target.
struct BenchTarget {
    enum class Bound { at_least, at_most, below };
    std::string name, unit;  // unit of value and target; empty for a ratio
    double value;
    Bound bound;
    std::optional<double> target;

    bool met() const {
        return !target || (bound == Bound::at_least  ? value >= *target
                           : bound == Bound::at_most ? value <= *target
                                                     : value < *target);
    }
};

struct BenchRow {
    std::string scene;
    std::int64_t discs;
    std::string width;
    std::string counts;                   // "events" or "collisions"
    double rate;                          // events per second
    std::optional<double> baseline_rate;  // empty without a baseline
    std::string baseline;
    std::optional<double> ratio_target;     // target of rate / baseline_rate
    std::optional<BenchTarget> comparison;  // comparison with another scene
    double bytes_per_disc;                  // memory of the loop
    // Counted by the event loop, per event.
    double invalidated, list_rebuilds, path_vertices;
    std::optional<double> vertex_share;  // share of the time at path vertices

    std::optional<double> ratio() const {
        if (!baseline_rate) return {};
        return rate / *baseline_rate;
    }
};

struct BenchResult {
    std::vector<BenchRow> rows;
    std::string machine;  // processor
};

/// Throws Interrupted when stopped.
BenchResult bench(const BenchSettings& settings);

/// All ratios to baselines that have a target.
std::vector<BenchTarget> targets_of_ratios(const BenchResult& result);
/// Comparisons between scenes, memory, growth with the number of discs, path vertices: those of
/// them that were measured.
std::vector<BenchTarget> targets_beyond_baselines(const BenchResult& result);

/// For people, for programs, and for bench/results/.
std::string bench_report(const BenchResult& result);
std::string bench_json(const BenchResult& result, const std::string& command);
std::string bench_csv(const BenchResult& result, const std::string& command);

}  // namespace swirl
