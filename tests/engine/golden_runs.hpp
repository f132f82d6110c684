// Some trajectories and the hashes of their final states. A change of a hash means that the
// physics, the order of rounding, or the definition of the hash has changed. It must be in the
// CHANGELOG.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/scenes.hpp"

namespace swirl {

struct GoldenRun {
    const char* name;
    InitialState scene;
    std::uint64_t events;
    std::uint64_t hash;  // Simulation::state_hash() after `events` events
};

inline InitialState golden_circle() {
    InitialState scene = paper_container(28);
    scene.path = circular_path(paper_amplitude, paper_period);
    return scene;
}
inline InitialState golden_walton() {
    InitialState scene = paper_container(36);
    scene.disc_surface = {.mu = 0.5, .restitution = 0.97, .tangential_restitution = 0.4};
    scene.wall_surface = {.mu = 0.8, .restitution = 0.95, .tangential_restitution = 0.2};
    return scene;
}

inline std::vector<GoldenRun> golden_runs() {
    return {
        {"48 discs, mu = 1", paper_container(48), 50000, 0xfa8f17a6b78853c0u},
        {"28 discs, mu = 1", paper_container(28), 50000, 0x6eb38e0dd0a3178bu},
        {"mixture", mixture_container(), 50000, 0x54d636010ea73d68u},
        {"exact circle", golden_circle(), 5000, 0xf40e59448fab6240u},
        {"restitution", golden_walton(), 20000, 0xb89cac39392593cfu},
        {"gas of 2000", gas_at_rest(2000, 0.7), 50000, 0x802cf8bbd151c318u},
        {"48 spheres on a floor", sphere_container(48), 20000, 0x267ebf43bc3a9349u},
        {"spheres of three species", sphere_mixture(), 20000, 0xc3d231d32b19022bu},
        {"coins", coin_container(36), 20000, 0xb9396db00e95ef24u},
        {"48 discs that cannot spin", with_held_spins(paper_container(48)), 50000,
         0x566e1ca4c30f3992u},
        {"mixture, every third cannot spin", with_held_spins(mixture_container(), 3), 50000,
         0x172083a558701704u},
        {"48 spheres that cannot spin", with_held_spins(sphere_container(48)), 20000,
         0xbfe23aa02c175137u},
    };
}

}  // namespace swirl
