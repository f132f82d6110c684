// How fast the engine is here: the scenes of docs/performance.md on the user's own machine, each
// beside a rival in the same run, as fast as it was made without what this engine is about: a loop
// over all pairs (rival/plain_loop.hpp), or lists of neighbours and a calendar of events
// (rival/plain_lists.hpp). Compare ratios, not rates: rates depend on the processor, on what else
// it does, and on the weather.
//
// One thread, processor time. Engine, rival and, where there is one, the scene to compare with run
// in turns of a fraction of a second; a rate is the median over the turns. Of the rivals the
// fastest in a short trial counts. Dishes count all events, gases collisions.
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
    std::vector<Width> widths = {Width::best};  // of the event loop
    double seconds = 1.0;                       // of processor time for each rate
    const std::atomic<bool>* stop = nullptr;
    std::function<void(double fraction, const std::string& scene)> progress;
};

/// Something measured, and what is aimed at.
struct BenchTarget {
    enum class Sense { at_least, at_most, below };
    std::string name, unit;  // unit: of value and target, "" for a ratio
    double value;
    Sense sense;
    std::optional<double> target;

    bool met() const {
        return !target || (sense == Sense::at_least  ? value >= *target
                           : sense == Sense::at_most ? value <= *target
                                                     : value < *target);
    }
};

struct BenchRow {
    std::string scene;
    std::int64_t discs;
    std::string width;
    std::string counts;                // "events" or "collisions"
    double rate;                       // of these, per second
    std::optional<double> rival_rate;  // where there is one
    std::string rival;
    std::optional<double> ratio_target;     // for rate over rival_rate
    std::optional<BenchTarget> comparison;  // with another scene of the engine
    double bytes_per_disc;                  // memory of the loop
    // The loop's own counts, per event.
    double invalidated, list_rebuilds, path_vertices;
    std::optional<double> vertex_share;  // of the time, spent at path vertices

    std::optional<double> ratio() const {
        if (!rival_rate) return {};
        return rate / *rival_rate;
    }
};

struct BenchResult {
    std::vector<BenchRow> rows;
    std::string machine;  // processor
};

/// Throws Interrupted when stopped.
BenchResult bench(const BenchSettings& settings);

/// All ratios to rivals that have a target.
std::vector<BenchTarget> targets_of_ratios(const BenchResult& result);
/// Comparisons between scenes, memory, growth with the number of discs, path vertices: those of
/// them that were measured.
std::vector<BenchTarget> targets_beyond_rivals(const BenchResult& result);

/// For people, for programs, and for bench/results/.
std::string bench_report(const BenchResult& result);
std::string bench_json(const BenchResult& result, const std::string& command);
std::string bench_csv(const BenchResult& result, const std::string& command);

}  // namespace swirl
