// The scenes that bench/run measures, and their initial states.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "swirl/physics/container_path.hpp"
#include "swirl/physics/initial_state.hpp"

namespace swirl {

/// Another scene of the engine with which a scene is compared.
enum class ComparedWith { nothing, paper_container, polygon };

struct BenchScene {
    enum class Kind { container, gas, spheres };
    std::string name;
    Kind kind;
    std::int64_t discs;
    double packing = 0.0;     // packing fraction; 0: the paper's container
    int sides = paper_sides;  // the exact circle has 0
    double mu_disc = 1.0;
    double second_radius = 1.0;  // radius of every second disc
    std::int64_t periods = 0;    // length before the measurement; a gas: ten collisions per disc
    /// Restarted from there after this many periods, because the discs gather later; 0: never.
    std::int64_t replayed_periods = 0;
    std::optional<double> ratio_target = {};
    ComparedWith compared_with = ComparedWith::nothing;
    std::optional<double> comparison_target = {};
    bool has_baseline = true;
    bool only_full = false;
};

inline constexpr const char* dense_gas = "gas, packing 0.7";

const std::vector<BenchScene>& bench_scenes();

/// Throws Interrupted when stopped.
InitialState state_of(const BenchScene& scene, const std::atomic<bool>* stop);

}  // namespace swirl
