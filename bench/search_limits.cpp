// search_limits: where do neighbour lists become faster than all pairs? Prints the time of an event
// for each vector width, number of discs and packing fraction. The limits in
// src/swirl/engine/simd/event_loop_*.cpp follow from this table.
//
// One thread; processor time, the least of several turns in which the searches alternate.
#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "swirl/engine/paper_scene.hpp"
#include "swirl/engine/simulation.hpp"
#include "swirl/run/simd.hpp"

namespace swirl {
namespace {

constexpr std::array methods{SearchMethod::all_pairs, SearchMethod::lists, SearchMethod::cells};
constexpr std::uint64_t events_per_turn = 20'000;
constexpr int turns = 8;

double now() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Nanoseconds per event, in the order of `methods`.
std::array<double, methods.size()> times_of(const InitialState& scene, Width width) {
    std::vector<Simulation> simulations;
    for (const SearchMethod method : methods) {
        simulations.emplace_back(scene, Progress{}, Tuning{.width = width, .search = method});
        simulations.back().run(events_per_turn);
    }
    std::array<double, methods.size()> least;
    least.fill(std::numeric_limits<double>::infinity());
    for (int turn = 0; turn < turns; ++turn)
        for (std::size_t k = 0; k < methods.size(); ++k) {
            const double begin = now();
            simulations[k].run(events_per_turn);
            least[k] = std::min(least[k], 1e9 * (now() - begin) / double(events_per_turn));
        }
    return least;
}

void print_width(const char* name, Width width) {
    fmt::print("\n{}\n{:>3} {:>8} {:>9} {:>9} {:>9} {:>12}\n", name, "N", "packing", "all pairs",
               "lists", "cells", "lists/pairs");
    for (const std::size_t discs : {24u, 28u, 32u, 36u, 40u})
        for (const double packing : {0.54, 0.48, 0.44, 0.40, 0.36, 0.30}) {
            InitialState scene = paper_scene(discs, 1.0, 1);
            const double radius = std::sqrt(double(discs) / packing);
            // The discs are placed in the paper's container.
            if (radius < scene.container_radius) continue;
            scene.container_radius = radius;
            const auto [pairs, lists, cells] = times_of(scene, width);
            fmt::print("{:3} {:8.3f} {:9.1f} {:9.1f} {:9.1f} {:12.2f}\n", discs, packing, pairs,
                       lists, cells, lists / pairs);
        }
}

}  // namespace
}  // namespace swirl

int main() {
    fmt::print("Nanoseconds per event. Without a loop for all pairs they are lists.\n");
    for (const auto& [name, width] : swirl::named_widths)
        if (swirl::has_width(width) && width != swirl::Width::best) swirl::print_width(name, width);
}
