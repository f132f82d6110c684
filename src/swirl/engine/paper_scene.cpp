#include "swirl/engine/paper_scene.hpp"

#include <vector>

#include "swirl/engine/placement.hpp"
#include "swirl/math/random.hpp"

namespace swirl {

InitialState paper_scene(std::size_t discs, double mu, std::uint64_t seed) {
    InitialState scene{};
    scene.path = polygon_path(paper_amplitude, paper_period, paper_sides);
    scene.container_radius = paper_container_radius;
    scene.disc_surface.mu = scene.wall_surface.mu = mu;
    // More of them might not fit into the memory.
    if (static_cast<double>(discs) > max_discs_in_container(1.0, scene.container_radius))
        return scene;
    const auto centres = place_discs(std::vector<double>(discs, 1.0), scene.container_radius, seed);
    if (!centres) return scene;
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

}  // namespace swirl
