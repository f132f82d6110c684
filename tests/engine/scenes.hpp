// Initial states that several tests use.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <vector>

#include "swirl/engine/placement.hpp"
#include "swirl/engine/simulation.hpp"
#include "swirl/math/random.hpp"
#include "swirl/physics/container_path.hpp"

namespace swirl {

/// The sanitizers make programs twenty times slower, so only the release build runs long tests.
#if defined(__SANITIZE_ADDRESS__)
inline constexpr bool sanitized = true;
#else
inline constexpr bool sanitized = false;
#endif
/// An eighth of a number of repetitions under the sanitizers, which look for wrong accesses and
/// broken invariants, not for rare events; Overlap.Slow_Search runs millions of events under them.
constexpr int fewer_if_sanitized(int repetitions) {
    return sanitized ? (repetitions + 7) / 8 : repetitions;
}

inline InitialState state_of(const std::vector<Disc>& species, std::size_t n,
                             double container_radius, ContainerPath path, double mu_disc,
                             double mu_wall, double speed = 0.1, std::uint64_t seed = 1) {
    std::vector<double> radii;
    for (std::size_t i = 0; i < n; ++i) radii.push_back(species[i % species.size()].radius);
    const auto centres = place_discs(radii, container_radius, seed);
    if (!centres) throw std::runtime_error("the test's discs do not fit");
    InitialState scene{.path = std::move(path),
                       .container_radius = container_radius,
                       .disc_surface = {.mu = mu_disc},
                       .wall_surface = {.mu = mu_wall}};
    Random random(seed + 1);
    const Segment& segment = scene.path.segments.front();
    for (std::size_t i = 0; i < n; ++i) {
        Disc d = species[i % species.size()];
        d.position = segment.start + (*centres)[i];
        d.velocity = segment.velocity + random.in_disc(speed);
        scene.discs.push_back(d);
    }
    return scene;
}

inline Disc unit_disc(double inertia = paper_inertia) {
    return {{0, 0}, {0, 0}, 0, 0, 0, 1.0, 1.0, inertia};
}

/// The paper's container.
inline InitialState paper_container(std::size_t n, double mu_disc = 1.0, double mu_wall = 1.0,
                                    std::uint64_t seed = 1) {
    return state_of({unit_disc()}, n, paper_container_radius,
                    polygon_path(paper_amplitude, paper_period, paper_sides), mu_disc, mu_wall, 0.1,
                    seed);
}

/// Three species of discs.
inline InitialState mixture_container(std::size_t n = 40) {
    return state_of({{{0, 0}, {0, 0}, 0, 0, 0, 1.0, 1.0, 10.0},
                     {{0, 0}, {0, 0}, 0, 0, 0, 0.6, 0.36, 0.0648},
                     {{0, 0}, {0, 0}, 0, 0, 0, 1.4, 2.0, 3.92}},
                    n, 10.0, polygon_path(paper_amplitude, paper_period, paper_sides), 0.7, 0.4);
}

/// Large discs among small ones of the same material, in a moving container. The small ones come
/// first.
inline InitialState large_among_small(std::size_t large, std::size_t small, double small_radius,
                                      double container_radius) {
    const double r = small_radius;
    std::vector<double> radii(small, r);
    radii.resize(small + large, 1.0);
    const auto centres = place_discs(radii, container_radius, 1);
    if (!centres) throw std::runtime_error("the test's discs do not fit");
    const double scale = container_radius / paper_container_radius;
    InitialState scene{
        .path = polygon_path(scale * paper_amplitude, scale * paper_period, paper_sides),
        .container_radius = container_radius,
        .disc_surface = {.mu = 0.7},
        .wall_surface = {.mu = 0.4}};
    Random random(2);
    const Segment& segment = scene.path.segments.front();
    for (std::size_t i = 0; i < radii.size(); ++i) {
        const double m = radii[i] * radii[i], inertia = paper_inertia * m * m;
        scene.discs.push_back({segment.start + (*centres)[i],
                               segment.velocity + random.in_disc(0.1), 0.0, 0.0, 0.0, radii[i], m,
                               inertia});
    }
    return scene;
}

/// Particles 0, `step`, 2·`step`, … of a scene cannot spin.
inline InitialState with_held_spins(InitialState scene, std::size_t step = 1) {
    for (std::size_t i = 0; i < scene.discs.size(); i += step) {
        scene.discs[i].can_spin = 0.0;
        scene.discs[i].spin = 0.0;
    }
    return scene;
}

/// An elastic gas of smooth discs in a container at rest.
inline InitialState gas_at_rest(std::size_t n, double packing_fraction, double speed = 1.0) {
    return state_of({unit_disc()}, n, square_root(static_cast<double>(n) / packing_fraction),
                    still_path(10.0), 0.0, 0.0, speed, 3);
}

/// Solid spheres on a floor, in the paper's container.
inline InitialState sphere_container(std::size_t n, double deceleration = 1.92, double mu = 0.2,
                                     double restitution = 0.9) {
    InitialState scene =
        state_of({unit_disc(solid_sphere_inertia(1.0, 1.0))}, n, paper_container_radius,
                 polygon_path(paper_amplitude, paper_period, paper_sides), mu, mu);
    scene.disc_surface =
        scene.wall_surface = {.mu = mu, .restitution = restitution, .contact_duration = 1e-3};
    scene.shape = Shape::sphere;
    scene.floor.deceleration = deceleration;
    return scene;
}
/// The same with rolling resistance μ_r g; the default brings many spheres to rest on the floor.
inline InitialState resisting_container(std::size_t n, double resistance = 1.5) {
    InitialState scene = sphere_container(n);
    scene.floor.rolling_resistance = resistance;
    return scene;
}
/// The same with coins, discs that lie flat on the floor.
inline InitialState coin_container(std::size_t n, double deceleration = 1.92) {
    InitialState scene = sphere_container(n, deceleration);
    for (Disc& d : scene.discs) d.inertia = solid_inertia(d.mass, d.radius);
    scene.shape = Shape::coin;
    scene.floor.bodies_lie_flat = true;
    return scene;
}
/// Three species of spheres, solid and hollow.
inline InitialState sphere_mixture() {
    InitialState scene = mixture_container(30);
    for (std::size_t i = 0; i < scene.discs.size(); ++i) {
        Disc& d = scene.discs[i];
        d.inertia =
            i % 2 ? shell_inertia(d.mass, d.radius) : solid_sphere_inertia(d.mass, d.radius);
        d.rolling_spin = {0.1 * d.velocity.y, 0.3};
    }
    scene.disc_surface = {
        .mu = 0.3, .restitution = 0.8, .tangential_restitution = 0.3, .contact_duration = 2e-3};
    scene.wall_surface = {
        .mu = 0.2, .restitution = 0.7, .tangential_restitution = 0.1, .contact_duration = 2e-3};
    scene.shape = Shape::sphere;
    scene.floor.deceleration = 0.8;
    return scene;
}

}  // namespace swirl
