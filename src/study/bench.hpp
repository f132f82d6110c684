// How fast the engine is here: the same scenes as in docs/performance.md, on the user's own
// machine, beside the paper's method programmed plainly (rival/plain_loop.hpp: all pairs,
// all times, the soonest), whose rate says what the machine is worth. Compare ratios, not rates:
// rates depend on the processor, on what else it does, and on the weather.
//
// One thread, processor time. Engine and plain loop run in turns of a fraction of a second; a rate
// is the median over the turns. The plain loop runs with every width of vectors that the processor
// has, and its fastest counts. The dish counts all events, the gas collisions.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "swirl/simulation/simulation.hpp"

namespace swirl {

struct BenchSettings {
    bool full = false;  // a million discs, too, and a large dish through a whole swirl
    std::vector<Width> widths = {Width::best};  // of the event loop
    double seconds = 1.0;                       // of processor time for each rate
    const std::atomic<bool>* stop = nullptr;
    std::function<void(double fraction, const std::string& scene)> progress;
};

struct BenchRow {
    std::string scene;
    std::int64_t discs;
    std::string width;
    std::string counts;                  // "events" or "collisions"
    double rate;                         // of these, per second
    std::optional<double> target;        // for the rate
    std::optional<double> plain_rate;    // where the plain loop is not hopeless
    std::string plain_width;             // with which it is the fastest
    std::optional<double> ratio_target;  // rate over plain_rate
    double bytes_per_disc;               // memory of the loop
    // The loop's own counts, per event.
    double invalidated, list_rebuilds, path_vertices;
    std::optional<double> vertex_share;  // of the time, spent at path vertices (large dish)
};

/// What is aimed at, and what was found.
struct BenchTarget {
    enum class Sense { at_least, at_most, below };
    std::string name, unit;  // unit: of value and target, "" for a ratio
    double value;
    Sense sense;
    double target;

    bool met() const {
        return sense == Sense::at_least  ? value >= target
               : sense == Sense::at_most ? value <= target
                                         : value < target;
    }
};

/// The paper's dish on the true circle.
struct CircleRow {
    std::int64_t discs;
    double over_polygon;  // time per swirl, over that on the paper's polygon
};

struct BenchResult {
    std::vector<BenchRow> rows;
    std::vector<CircleRow> circles;
    std::string machine;         // processor
    double by_event_cost = 0.0;  // added time of the averages by event at N = 48, as a fraction
};

/// Throws Interrupted when stopped.
BenchResult bench(const BenchSettings& settings);

/// The rows' rates and ratios against their targets.
std::vector<BenchTarget> targets_of_rows(const BenchResult& result);
/// Memory, growth with the number of discs, path vertices, averages by event: those of them that
/// were measured.
std::vector<BenchTarget> targets_beyond_rates(const BenchResult& result);

/// For people, for programs, and for bench/results/.
std::string bench_report(const BenchResult& result);
std::string bench_json(const BenchResult& result, const std::string& command);
std::string bench_csv(const BenchResult& result, const std::string& command);

}  // namespace swirl
