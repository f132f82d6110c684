// How fast the engine is here: the same scenes as in docs/performance.md, on the user's own
// machine, beside the paper's method programmed plainly (simulation/reference_loop.hpp: all pairs,
// all times, the soonest), whose rate says what the machine is worth. Compare ratios, not rates:
// rates depend on the processor, on what else it does, and on the weather.
//
// One thread, processor time. Engine and plain loop run in turns of a fraction of a second; a rate
// is the median over the turns. The dish counts all events, the gas collisions.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "simulation/simulation.hpp"

namespace swirl {

struct BenchSettings {
    bool full = false;                          // a million discs, too
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
    std::optional<double> ratio_target;  // rate over plain_rate
    double bytes_per_disc;               // memory of the loop
    // The loop's own counts, per event.
    double stale, relists, path_vertices;
    std::optional<double> vertex_share;  // of the time, spent at path vertices (large dish)
};

struct BenchResult {
    std::vector<BenchRow> rows;
    std::string machine;         // processor
    double by_event_cost = 0.0;  // added time of the averages by event at N = 48, as a fraction
};

/// Throws Interrupted when stopped.
BenchResult bench(const BenchSettings& settings);

/// For people, for programs, and for bench/results/.
std::string bench_report(const BenchResult& result);
std::string bench_json(const BenchResult& result, const std::string& command);
std::string bench_csv(const BenchResult& result, const std::string& command);

}  // namespace swirl
