// The rotation rate ϖ of 48 discs: does the cluster rotate with the swirl or against it?
// `swirl run --discs 48` computes the same from another initial state.
#include <cstdio>

#include "swirl/engine/paper_scene.hpp"
#include "swirl/engine/simulation.hpp"
#include "swirl/measure/cluster_rotation.hpp"

int main() {
    swirl::Simulation simulation(swirl::paper_scene(48, 1.0, 1));
    const std::int64_t warmup = 20, end = 220;  // periods
    simulation.advance_to(warmup, 0.0);

    // Update the snapshot after every event and sample it. Each period is a block of the average.
    swirl::ClusterRotation rotation;
    swirl::Snapshot snapshot = simulation.snapshot();
    while (simulation.periods() < end) {
        const std::int64_t period = simulation.periods();
        const swirl::Event event = simulation.step();
        simulation.refresh(snapshot, event);
        rotation.sample(snapshot, event);
        if (simulation.periods() > period) rotation.close_block();
    }

    const swirl::Estimate varpi = rotation.estimates().mean_by_event;
    std::printf("48 discs %s: ϖ/Ω = %.4f ± %.4f\n", varpi.mean > 0.0 ? "rotate" : "counterrotate",
                varpi.mean, varpi.error);
    std::printf("state %016llx\n", static_cast<unsigned long long>(simulation.state_hash()));
}
