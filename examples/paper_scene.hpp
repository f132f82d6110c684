// The paper's container with N discs: the initial state of the examples.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "swirl/engine/placement.hpp"
#include "swirl/math/random.hpp"
#include "swirl/physics/container_path.hpp"
#include "swirl/physics/disc.hpp"
#include "swirl/physics/initial_state.hpp"

inline swirl::InitialState paper_scene(std::size_t n, double mu, std::uint64_t seed) {
    using namespace swirl;
    InitialState scene{};
    scene.path = polygon_path(paper_amplitude, paper_period, paper_sides);
    scene.container_radius = paper_container_radius;
    scene.disc_surface.mu = scene.wall_surface.mu = mu;

    // Discs do not overlap. They move with the container, and have small random velocities.
    const auto centres = place_discs(std::vector<double>(n, 1.0), scene.container_radius, seed);
    if (!centres) return scene;  // they do not fit into the container: no discs
    const Segment& segment = scene.path.segments.front();
    Random random(seed + 1);
    for (const Vec2& centre : *centres) {
        Disc disc{};
        disc.radius = disc.mass = 1.0;
        disc.inertia = paper_inertia;
        disc.position = segment.start + centre;
        disc.velocity = segment.velocity + random.in_disc(0.1);
        scene.discs.push_back(disc);
    }
    return scene;
}
