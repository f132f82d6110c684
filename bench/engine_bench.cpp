// The cost of the parts of an event (Google Benchmark): the collision law, one contact time, eight
// contact times at once, an event, an updated snapshot, a sample of the rotation.
//
//     bench_engine [--benchmark_filter=...]
//
// bench/run measures the rates of whole scenes.
#include <benchmark/benchmark.h>

#include <vector>

#include "engine/scenes.hpp"
#include "swirl/math/lanes.hpp"
#include "swirl/measure/cluster_rotation.hpp"
#include "swirl/physics/collision_law.hpp"
#include "swirl/physics/contact_time.hpp"

namespace swirl {
namespace {

Flight<double> flight(Random& random) {
    return {random.in_disc(8.0), random.in_disc(1.0), random.uniform()};
}

void collision_law(benchmark::State& state) {
    Random random(1);
    Body i{random.in_disc(1.0), 0.1, 1.0, 1.0, 0.1}, j{random.in_disc(1.0), -0.2, 1.0, 1.0, 0.1};
    const Vec2 separations[2] = {{1.2, 1.6}, {-1.2, -1.6}};
    unsigned k = 0;
    for (auto _ : state) {
        // The directions alternate, so that the bodies approach each other in every call.
        const Impulse J = collide(i, j, separations[k++ & 1], {.mu = 0.5});
        benchmark::DoNotOptimize(J);
    }
}
BENCHMARK(collision_law);

void contact_time_of_one_pair(benchmark::State& state) {
    Random random(2);
    std::vector<Flight<double>> discs;
    for (int k = 0; k < 64; ++k) discs.push_back(flight(random));
    unsigned k = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(time_of_contact(discs[k & 63], discs[(k + 7) & 63], 2.0));
        ++k;
    }
}
BENCHMARK(contact_time_of_one_pair);

void contact_times_of_eight_pairs(benchmark::State& state) {
    Random random(3);
    alignas(64) double x[8], y[8], vx[8], vy[8], held[8];
    for (int k = 0; k < 8; ++k) {
        const Flight<double> f = flight(random);
        x[k] = f.position.x, y[k] = f.position.y, vx[k] = f.velocity.x, vy[k] = f.velocity.y;
        held[k] = f.time;
    }
    using Eight = Lanes<8>;
    const Flight<Eight> mine{{Eight(0.3), Eight(0.1)}, {Eight(0.2), Eight(-0.4)}, Eight(0.5)};
    for (auto _ : state) {
        benchmark::ClobberMemory();
        const Flight<Eight> others{{Eight::load(x), Eight::load(y)},
                                   {Eight::load(vx), Eight::load(vy)},
                                   Eight::load(held)};
        benchmark::DoNotOptimize(smallest(time_of_contact(mine, others, Eight(2.0))));
    }
}
BENCHMARK(contact_times_of_eight_pairs);  // vectors have the baseline's width

void wall_contact_time(benchmark::State& state) {
    const ContainerPath path = state.range(0) == 0
                                   ? polygon_path(paper_amplitude, paper_period, paper_sides)
                                   : circular_path(paper_amplitude, paper_period);
    Random random(4);
    std::vector<Disc> discs;
    for (int k = 0; k < 64; ++k) {
        Disc d = unit_disc();
        d.position = path.segments[0].start + random.in_disc(7.5);
        d.velocity = random.in_disc(2.0);
        discs.push_back(d);
    }
    unsigned k = 0;
    for (auto _ : state)
        benchmark::DoNotOptimize(
            time_of_wall_contact(discs[k++ & 63], path.segments[0], paper_container_radius));
}
BENCHMARK(wall_contact_time)->ArgName("circle")->Arg(0)->Arg(1);

void event(benchmark::State& state) {
    const auto width = static_cast<Width>(state.range(1));
    if (!has_width(width)) {
        state.SkipWithError("this processor has no such vectors");
        return;
    }
    Simulation simulation(paper_container(static_cast<std::size_t>(state.range(0))), {},
                          {0, width});
    simulation.run(20000);
    for (auto _ : state) simulation.run(100);
    state.SetItemsProcessed(100 * state.iterations());
}
BENCHMARK(event)->ArgNames({"N", "width"})->ArgsProduct({{5, 28, 48}, {1, 2, 3}});

void step_and_refresh(benchmark::State& state) {
    Simulation simulation(paper_container(48));
    simulation.run(20000);
    Snapshot snapshot = simulation.snapshot();
    for (auto _ : state) simulation.refresh(snapshot, simulation.step());
}
BENCHMARK(step_and_refresh);

void step_refresh_and_look_at_the_rotation(benchmark::State& state) {
    Simulation simulation(paper_container(48));
    simulation.run(20000);
    Snapshot snapshot = simulation.snapshot();
    ClusterRotation rotation;
    for (auto _ : state) {
        const Event event = simulation.step();
        rotation.sample(snapshot);
        simulation.refresh(snapshot, event);
        rotation.follow(snapshot, event);
    }
}
BENCHMARK(step_refresh_and_look_at_the_rotation);

}  // namespace
}  // namespace swirl

BENCHMARK_MAIN();
