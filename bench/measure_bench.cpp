// The cost of sampling: N = 48 in the paper's container, one period per iteration. Every line is a
// whole run, simulation included; the first line is the simulation alone. Samples by time: 511 per
// period, as the paper's camera. The last lines are single samples.
#include <benchmark/benchmark.h>

#include <functional>

#include "measure/snapshots.hpp"
#include "swirl/engine/placement.hpp"
#include "swirl/engine/simulation.hpp"
#include "swirl/measure/angular_profile.hpp"
#include "swirl/measure/cluster_rotation.hpp"
#include "swirl/measure/collision_angles.hpp"
#include "swirl/measure/collision_rates.hpp"
#include "swirl/measure/contact_network.hpp"
#include "swirl/measure/density_map.hpp"
#include "swirl/measure/diffusion.hpp"
#include "swirl/measure/energy_budget.hpp"
#include "swirl/measure/flow_map.hpp"
#include "swirl/measure/granular_temperature.hpp"
#include "swirl/measure/hexatic_order.hpp"
#include "swirl/measure/local_packing.hpp"
#include "swirl/measure/pair_correlation.hpp"
#include "swirl/measure/pinned_loose.hpp"
#include "swirl/measure/radial_density.hpp"
#include "swirl/measure/slip.hpp"
#include "swirl/measure/spin_frustration.hpp"
#include "swirl/measure/velocity_correlation.hpp"
#include "swirl/measure/velocity_distribution.hpp"
#include "swirl/measure/wall_stress.hpp"

namespace swirl {
namespace {

constexpr int camera = 511;
constexpr double R = paper_container_radius;

Simulation container(std::size_t discs) {
    const auto positions = place_discs(std::vector<double>(discs, 1.0), R, 1);
    InitialState scene{.path = polygon_path(paper_amplitude, paper_period, paper_sides),
                       .container_radius = R};
    const Segment& segment = scene.path.segments.front();
    for (const Vec2& p : *positions)
        scene.discs.push_back(
            {segment.start + p, segment.velocity, 0.0, 0.0, 0.0, 1.0, 1.0, paper_inertia});
    Simulation simulation(scene);
    simulation.advance_to(20, 0.0);
    return simulation;
}

struct Samples {
    std::function<void(const Snapshot&)> by_time;  // null: no_disc samples
    std::function<void(const Snapshot&, const Event&)> by_event;
    std::function<void()> close_block = [] {};
};

/// Swirl after swirl, with samples.
void periods(benchmark::State& state, const Samples& samples, std::size_t discs = 48) {
    Simulation simulation = container(discs);
    const ContainerPath path = polygon_path(paper_amplitude, paper_period, paper_sides);
    Snapshot snapshot = simulation.snapshot();
    const auto before = simulation.events().total();
    for (auto _ : state) {
        if (!samples.by_time && !samples.by_event) {
            simulation.advance_to(simulation.periods() + 1, 0.0);
            continue;
        }
        int next = 0;
        for (bool over = false; !over;) {
            const Event event = simulation.step();
            for (; samples.by_time && next < camera && paper_period * next / camera <= event.clock;
                 ++next) {
                snapshot.clock = paper_period * next / camera;
                const Segment& segment = path.segment_at(snapshot.clock);
                snapshot.container_centre = segment.position_at(snapshot.clock);
                snapshot.container_velocity = segment.velocity_at(snapshot.clock);
                samples.by_time(snapshot);
            }
            over = simulation.periods() > event.periods;
            simulation.refresh(snapshot, event);
            if (samples.by_event) samples.by_event(snapshot, event);
        }
        samples.close_block();
    }
    state.counters["events"] = benchmark::Counter(
        static_cast<double>(simulation.events().total() - before), benchmark::Counter::kIsRate);
}

void nobody_looks(benchmark::State& state) { periods(state, {}); }
BENCHMARK(nobody_looks);

void one_by_one(benchmark::State& state) {
    periods(state, {{}, [](const Snapshot&, const Event&) {}, [] {}});
}
BENCHMARK(one_by_one);

void rotation_by_event(benchmark::State& state) {
    ClusterRotation rotation;
    periods(state, {{},
                    [&](const Snapshot& s, const Event& event) { rotation.sample(s, event); },
                    [&] { rotation.close_block(); }});
}
BENCHMARK(rotation_by_event);

void rotation_by_time(benchmark::State& state) {
    ClusterRotation rotation;
    periods(state, {[&](const Snapshot& s) { rotation.sample_by_time(s); },
                    {},
                    [&] { rotation.close_block(); }});
}
BENCHMARK(rotation_by_time);

void view_alone(benchmark::State& state) {
    MFrameView view;
    periods(state, {[&](const Snapshot& s) { view.update(s); }, {}, [] {}});
}
BENCHMARK(view_alone);

template <class Map>
void view_and(benchmark::State& state, Map map) {
    MFrameView view;
    periods(state, {[&](const Snapshot& s) {
                        view.update(s);
                        map.sample(view);
                    },
                    {},
                    [&] { map.close_block(); }});
}
void density_map(benchmark::State& state) { view_and(state, DensityMap(R)); }
void flow_map(benchmark::State& state) { view_and(state, FlowMap(R)); }
void angular_profile(benchmark::State& state) { view_and(state, AngularProfile()); }
void radial_density(benchmark::State& state) { view_and(state, RadialDensity(R)); }
void granular_temperature(benchmark::State& state) { view_and(state, GranularTemperature(R)); }
void pinned_loose(benchmark::State& state) { view_and(state, PinnedLoose()); }
void slip(benchmark::State& state) { view_and(state, Slip()); }
void spin_frustration(benchmark::State& state) { view_and(state, SpinFrustration()); }
void pair_correlation(benchmark::State& state) { view_and(state, PairCorrelation(R)); }
void velocity_correlation(benchmark::State& state) { view_and(state, VelocityCorrelation(R)); }
void velocity_distribution(benchmark::State& state) { view_and(state, VelocityDistribution()); }
void contact_network(benchmark::State& state) { view_and(state, ContactNetwork()); }
BENCHMARK(density_map);
BENCHMARK(flow_map);
BENCHMARK(angular_profile);
BENCHMARK(radial_density);
BENCHMARK(granular_temperature);
BENCHMARK(pinned_loose);
BENCHMARK(slip);
BENCHMARK(spin_frustration);
BENCHMARK(pair_correlation);
BENCHMARK(velocity_correlation);
BENCHMARK(velocity_distribution);
BENCHMARK(contact_network);

void collision_angles(benchmark::State& state) {
    CollisionAngles angles;
    periods(state, {{},
                    [&](const Snapshot& s, const Event& event) { angles.sample_event(event, s); },
                    [&] { angles.close_event_block(paper_period); }});
}
BENCHMARK(collision_angles);

void collisions(benchmark::State& state) {
    CollisionRates rates;
    WallStress stress(R);
    EnergyBudget budget;
    PinnedByCollisions pinned;
    periods(state, {{},
                    [&](const Snapshot& s, const Event& event) {
                        rates.sample_event(event);
                        stress.sample_event(event, s);
                        budget.sample_event(event, s);
                        pinned.sample_event(event, s);
                    },
                    [&] {
                        rates.close_event_block(paper_period, 48);
                        stress.close_event_block(paper_period);
                        budget.close_event_block(paper_period);
                        pinned.close_block();
                    }});
}
BENCHMARK(collisions);

/// Everything at once. What follows the camera samples 511 times per swirl; the structure of the
/// cluster, which changes slowly and costs more, at every 300th of these, which in
/// time meets every phase of the swirl.
struct Everything {
    MFrameView view;
    ClusterRotation rotation;
    DensityMap density{R};
    FlowMap flow{R};
    AngularProfile profile;
    RadialDensity radial{R};
    GranularTemperature temperature{R};
    PinnedLoose pinned;
    Slip band;
    SpinFrustration frustration;
    Voronoi cells;
    HexaticOrder order;
    LocalPacking packing;
    Diffusion diffusion{8};
    int samples = 0;

    void follow_the_camera(const Snapshot& s) {
        view.update(s);
        rotation.sample_by_time(s);
        density.sample(view);
        flow.sample(view);
        profile.sample(view);
        radial.sample(view);
        temperature.sample(view);
        pinned.sample(view);
        band.sample(view, pinned.pinned());
        frustration.sample(view, pinned.pinned());
    }
    void sample_the_structure(const Snapshot& s) {
        if (++samples % 300 != 0) return;
        cells.find(view);
        order.sample(view, cells, pinned.pinned());
        packing.sample(view, cells, pinned.pinned());
        diffusion.sample(s);
    }
    void close_block() {
        rotation.close_block();
        density.close_block();
        flow.close_block();
        profile.close_block();
        radial.close_block();
        temperature.close_block();
        pinned.close_block();
        band.close_block();
        frustration.close_block();
        order.close_block();
        packing.close_block();
        diffusion.close_block();
    }
};

void camera_only(benchmark::State& state) {
    Everything all;
    periods(state,
            {[&](const Snapshot& s) { all.follow_the_camera(s); }, {}, [&] { all.close_block(); }});
}
BENCHMARK(camera_only);

void everything(benchmark::State& state) {
    Everything all;
    periods(state, {[&](const Snapshot& s) {
                        all.follow_the_camera(s);
                        all.sample_the_structure(s);
                    },
                    {},
                    [&] { all.close_block(); }});
}
BENCHMARK(everything);

void sample_after_every_event(benchmark::State& state) {
    Snapshot s = held_earlier(random_discs(static_cast<std::size_t>(state.range(0)), 1));
    ClusterRotation rotation;
    const Event event{0, s.clock, EventKind::disc_disc, 0, 1, {}, {}, 0.0};
    for (auto _ : state) {
        s.clock += 1e-9;
        rotation.sample(s, event);
    }
    rotation.close_block();
    benchmark::DoNotOptimize(rotation.estimates().mean_by_event.mean);
}
BENCHMARK(sample_after_every_event)->Arg(5)->Arg(28)->Arg(47)->Arg(48)->Arg(1000);

void sample_of_each_width(benchmark::State& state) {
    const auto width = static_cast<Width>(state.range(0));
    if (!has_width(width)) state.SkipWithError("this processor has no such registers");
    Snapshot s = held_earlier(random_discs(48, 1));
    double sum = 0.0;
    for (auto _ : state) {
        s.clock += 1e-9;
        sum += cluster_rotation(s, width).individual;
    }
    benchmark::DoNotOptimize(sum);
}
BENCHMARK(sample_of_each_width)->DenseRange(1, 3)->ArgName("width");

void voronoi_of_48(benchmark::State& state) {
    const MFrameView view(random_discs(48, 1));
    Voronoi cells;
    for (auto _ : state) cells.find(view);
    benchmark::DoNotOptimize(cells.area(0));
}
BENCHMARK(voronoi_of_48);

}  // namespace
}  // namespace swirl

BENCHMARK_MAIN();
