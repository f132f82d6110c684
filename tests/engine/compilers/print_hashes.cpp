// Prints the hashes of the golden runs, and the rotation rates of their clusters over the last
// events, computed by the baseline loops. compilers_test.py builds this with several compilers and
// levels of optimisation.
#include <bit>
#include <cstdint>
#include <cstdio>

#include "engine/golden_runs.hpp"
#include "swirl/measure/cluster_rotation.hpp"

namespace {

unsigned long long bits(double value) { return std::bit_cast<std::uint64_t>(value); }

/// Twenty blocks of a hundred events.
void print_averages(const char* name, swirl::Simulation& simulation) {
    swirl::ClusterRotation rotation;
    swirl::Snapshot snapshot = simulation.snapshot();
    for (int block = 0; block < 20; ++block) {
        for (int k = 0; k < 100; ++k) {
            const swirl::Event event = simulation.step();
            simulation.refresh(snapshot, event);
            rotation.sample(snapshot, event);
        }
        rotation.close_block();
    }
    const auto estimates = rotation.estimates();
    std::printf("%s, rotation:", name);
    for (const swirl::Estimate& e : {estimates.mean_by_event, estimates.mean_by_time,
                                     estimates.rigid_by_event, estimates.rigid_by_time})
        std::printf(" %016llx %016llx", bits(e.mean), bits(e.error));
    std::printf("\n");
}

}  // namespace

int main() {
    for (const swirl::GoldenRun& golden : swirl::golden_runs()) {
        swirl::Simulation simulation(golden.scene, {}, {0, swirl::Width::baseline});
        simulation.run(golden.events / 10);
        std::printf("%s: %016llx\n", golden.name,
                    static_cast<unsigned long long>(simulation.state_hash()));
        print_averages(golden.name, simulation);
    }
}
