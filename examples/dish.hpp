// The paper's dish with N discs in it, as the examples start.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "swirl/engine/placement.hpp"
#include "swirl/math/random.hpp"
#include "swirl/physics/container_path.hpp"
#include "swirl/physics/disc.hpp"
#include "swirl/physics/initial_state.hpp"

inline swirl::InitialState paper_dish(std::size_t n, double mu, std::uint64_t seed) {
    using namespace swirl;
    InitialState dish{};
    dish.path = polygon_path(paper_amplitude, paper_period, paper_sides);
    dish.container_radius = paper_container_radius;
    dish.disc_surface.mu = dish.wall_surface.mu = mu;

    // Placed without overlap; they move with the dish, and a little on their own.
    const auto centres = place_discs(std::vector<double>(n, 1.0), dish.container_radius, seed);
    if (!centres) return dish;  // they do not fit: no discs
    const Leg& leg = dish.path.legs.front();
    Random random(seed + 1);
    for (const Vec2& centre : *centres) {
        Disc disc{};
        disc.radius = disc.mass = 1.0;
        disc.inertia = paper_inertia;
        disc.position = leg.start + centre;
        disc.velocity = leg.velocity + random.in_disc(0.1);
        dish.discs.push_back(disc);
    }
    return dish;
}
