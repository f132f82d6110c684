// 10⁹ events of the paper's system with 48 discs, which take minutes: ./check --soak.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "swirl/engine/simulation.hpp"
#include "swirl/measure/energy_budget.hpp"
#include "swirl/run/config.hpp"

namespace swirl {
namespace {

TEST(Soak, ABillionEventsWithoutOverlapOrEnergyDrift) {
    constexpr int blocks = 100, events_per_block = 10'000'000;
    Simulation simulation(make_initial_state(RunConfig{}));
    Snapshot snapshot = simulation.snapshot();
    const double start = kinetic_energy(snapshot);
    double largest_overlap = -1.0, accounted = 0.0, residual = 0.0, largest_residual = 0.0;
    for (int block = 1; block <= blocks; ++block) {
        double change = 0.0;
        for (int k = 0; k < events_per_block; ++k) {
            const Event event = simulation.step();
            simulation.refresh(snapshot, event);
            if (event.kind == EventKind::path_vertex) continue;
            largest_overlap = std::fmax(largest_overlap, event.overlap);
            const EnergyChange e = energy_change(event, snapshot);
            change += e.work - e.friction_loss - e.inelastic_loss;
        }
        accounted += change;
        residual = kinetic_energy(snapshot) - start - accounted;
        largest_residual = std::fmax(largest_residual, std::fabs(residual));
    }
    std::printf("largest overlap %.2g, budget off by %.2g (at most %.2g) after %llu periods\n",
                largest_overlap, residual, largest_residual,
                static_cast<unsigned long long>(simulation.periods()));
    EXPECT_LT(largest_overlap, 1e-12);
    EXPECT_GT(largest_overlap, -1e-12);  // overlaps were recorded
    // An event rounds energies of order 1 by about 10⁻¹⁶. Without bias, 10⁹ events would give
    // √10⁹ times that, 3·10⁻¹². The budget itself is biased by the rounding of the length of the
    // normal: a twenty-fifth of a rounding error, 2⁻⁵³, per event in 2·10⁷ events. The bound is a
    // tenth of a rounding error per event.
    EXPECT_LT(largest_residual, 0.1 * 0x1p-53 * blocks * events_per_block);
}

}  // namespace
}  // namespace swirl
