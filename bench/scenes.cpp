#include "scenes.hpp"

#include "swirl/engine/placement.hpp"
#include "swirl/math/random.hpp"
#include "swirl/run/config.hpp"
#include "swirl/run/failure.hpp"

namespace swirl {
namespace {

// The packing fraction of the paper's container at N = 48: 48 / 8.6².
constexpr double paper_packing = 48.0 / (paper_container_radius * paper_container_radius);
// The packing fraction of the paper's experiment at N = 48.
constexpr double spheres_packing =
    48.0 / (experiment_container_radius * experiment_container_radius);
// The spheres' scenes have A = 5.75 mm (--preset experiment-half), so that their hashes last.
constexpr double spheres_amplitude = 5.75 / 3.0;

// Targets: twice the rate of the baseline everywhere; in a container at least a third of the rate
// at N = 48, and 0.8 of it where many discs have settled; on the exact circle at most 1.3 times the
// time per period on the polygon.
constexpr double twice = 2.0, third = 1.0 / 3.0, settled = 0.8, circle = 1.3;

BenchScene container_of(std::int64_t discs) {
    return {.name = "container, mu = 1",
            .kind = BenchScene::Kind::container,
            .discs = discs,
            .periods = 30,
            .ratio_target = twice};
}
BenchScene variant(const char* name) {
    BenchScene scene = container_of(48);
    scene.name = name;
    scene.compared_with = ComparedWith::paper_container;
    scene.comparison_target = third;
    return scene;
}
BenchScene with_sides(const char* name, int sides) {
    BenchScene scene = variant(name);
    scene.sides = sides;
    return scene;
}
BenchScene mixture() {
    BenchScene scene = variant("container, radii 1 and 0.7");
    scene.second_radius = 0.7;
    return scene;
}
BenchScene smooth() {
    BenchScene scene = variant("container, mu_disc = 0");
    scene.mu_disc = 0.0;
    return scene;
}
BenchScene on_circle(std::int64_t discs) {
    BenchScene scene = container_of(discs);
    scene.name = "container, exact circle";
    if (discs > 48) scene.packing = paper_packing;
    scene.sides = 0;
    scene.compared_with = ComparedWith::polygon;
    scene.comparison_target = circle;
    return scene;
}
BenchScene large(std::int64_t discs, std::int64_t periods, std::optional<double> target) {
    BenchScene scene = container_of(discs);
    scene.name = "large container, period " + std::to_string(periods) + " on";
    scene.packing = paper_packing;
    scene.periods = periods;
    scene.compared_with = ComparedWith::paper_container;
    scene.comparison_target = target;
    scene.only_full = discs > 2000;
    return scene;
}
/// Starts with the third period: later all discs have gathered in one place.
BenchScene dilute(const char* name, double packing, std::int64_t replayed_periods) {
    BenchScene scene = variant(name);
    scene.discs = 2000;
    scene.packing = packing;
    scene.periods = 2;
    scene.replayed_periods = replayed_periods;
    return scene;
}
BenchScene elastic(const char* name, double packing, std::int64_t discs, bool only_full = false) {
    return {.name = name,
            .kind = BenchScene::Kind::gas,
            .discs = discs,
            .packing = packing,
            .mu_disc = 0.0,
            .ratio_target = discs == 1000000 ? 2.5 : twice,
            .only_full = only_full};
}
BenchScene unequal(const char* name, double packing) {
    BenchScene scene = elastic(name, packing, 10000);
    scene.second_radius = 0.1;
    return scene;
}
BenchScene of_spheres(std::int64_t discs) {
    return {.name = "spheres, mu = 0.2",
            .kind = BenchScene::Kind::spheres,
            .discs = discs,
            .packing = spheres_packing,
            .ratio_target = 10.0,
            .has_baseline = discs <= 500,
            .only_full = discs > 500};
}

}  // namespace

const std::vector<BenchScene>& bench_scenes() {
    static const std::vector<BenchScene> all = {
        container_of(48),
        container_of(28),
        container_of(5),
        with_sides("container, 300 sides", 300),
        with_sides("container, 3000 sides", 3000),
        mixture(),
        smooth(),
        on_circle(5),
        on_circle(28),
        on_circle(48),
        on_circle(500),
        large(500, 30, settled),
        large(2000, 30, settled),
        large(100000, 2, {}),  // thirty periods would be 10⁹ events
        dilute("dilute container, packing 0.38", 0.38, 1),
        dilute("dilute container, packing 0.2", 0.2, 5),
        dilute("dilute container, packing 0.1", 0.1, 10),
        elastic("gas, packing 0.85", 0.85, 10000),
        elastic(dense_gas, 0.70, 1000),
        elastic(dense_gas, 0.70, 10000),
        elastic(dense_gas, 0.70, 100000),
        elastic(dense_gas, 0.70, 1000000, true),
        elastic("gas, packing 0.2", 0.20, 1000),
        elastic("gas, packing 0.2", 0.20, 10000),
        elastic("gas, packing 0.2", 0.20, 100000, true),
        elastic("gas, packing 0.01", 0.01, 1000),
        elastic("gas, packing 0.01", 0.01, 100000, true),
        unequal("gas, radii 1 and 0.1, packing 0.6", 0.6),
        unequal("gas, radii 1 and 0.1, packing 0.2", 0.2),
        of_spheres(48),
        of_spheres(500),
        of_spheres(100000),
    };
    return all;
}

InitialState state_of(const BenchScene& scene, const std::atomic<bool>* stop) {
    const bool rolls = scene.kind == BenchScene::Kind::spheres,
               still = scene.kind == BenchScene::Kind::gas;
    const double mu_wall = still ? 0.0 : 1.0;
    InitialState initial{.container_radius = paper_container_radius,
                         .disc_surface = {.mu = scene.mu_disc},
                         .wall_surface = {.mu = mu_wall}};
    if (still)
        initial.path = still_path(10.0);
    else if (scene.sides == 0)
        initial.path = circular_path(paper_amplitude, paper_period);
    else if (!rolls)
        initial.path = polygon_path(paper_amplitude, paper_period, scene.sides);
    else
        initial.path = polygon_path(spheres_amplitude, 2.0 * pi * spheres_amplitude, paper_sides);
    if (rolls) {
        for (Surface* surface : {&initial.disc_surface, &initial.wall_surface})
            *surface = {.mu = 0.2,
                        .restitution = experiment_restitution,
                        .contact_duration = RunConfig{}.contact_duration};
        initial.shape = Shape::sphere;
        initial.floor.deceleration = 0.3 * experiment_gravity(5.75);
    }
    std::vector<double> radii(static_cast<std::size_t>(scene.discs), 1.0);
    double squares = 0.0;
    for (std::size_t i = 0; i < radii.size(); ++i) {
        if (i % 2 == 1) radii[i] = scene.second_radius;
        squares += radii[i] * radii[i];
    }
    if (scene.packing > 0.0) initial.container_radius = square_root(squares / scene.packing);
    const auto centres =
        place_discs(radii, initial.container_radius, 1, stopped_by(stop).is_stopped);
    if (stop && stop->load()) throw Interrupted("stopped before the benchmark was complete");
    if (!centres) throw Failure("the discs of a benchmark do not fit into their container");
    Random random(2);
    const Segment& segment = initial.path.segments.front();
    for (std::size_t i = 0; i < radii.size(); ++i) {
        const double r = radii[i], mass = r * r;
        // In a gas all discs start with the same energy on average.
        const Vec2 velocity = random.in_disc(still ? 1.0 / r : 0.1);
        initial.discs.push_back(
            {segment.start + (*centres)[i], segment.velocity + velocity, 0.0, 0.0, 0.0, r, mass,
             rolls ? solid_sphere_inertia(mass, r) : paper_inertia * mass * r * r});
    }
    return initial;
}

}  // namespace swirl
