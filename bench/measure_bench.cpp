// What a look costs. The engine does an event in about 140 ns at N = 48; a look after every event
// must be well below.
#include <benchmark/benchmark.h>

#include "measure/cluster_rotation.hpp"
#include "measure/snapshots.hpp"

namespace swirl {
namespace {

void look_after_every_event(benchmark::State& state) {
    Snapshot s = held_earlier(random_discs(static_cast<std::size_t>(state.range(0)), 1));
    ClusterRotation rotation;
    for (auto _ : state) {
        s.clock += 1e-9;
        rotation.look(s);
    }
    rotation.close_block();
    benchmark::DoNotOptimize(rotation.estimates().by_event.mean);
}
BENCHMARK(look_after_every_event)->Arg(5)->Arg(28)->Arg(47)->Arg(48)->Arg(1000);

void look_of_each_width(benchmark::State& state) {
    const auto width = static_cast<VectorWidth>(state.range(0));
    if (!processor_has(width)) state.SkipWithError("this processor has no such registers");
    Snapshot s = held_earlier(random_discs(48, 1));
    double sum = 0.0;
    for (auto _ : state) {
        s.clock += 1e-9;
        sum += cluster_rotation(s, width).individual;
    }
    benchmark::DoNotOptimize(sum);
}
BENCHMARK(look_of_each_width)->DenseRange(0, 2)->ArgName("width");

}  // namespace
}  // namespace swirl

BENCHMARK_MAIN();
