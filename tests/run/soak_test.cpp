// A run as long as a study: 10⁹ events of the paper's full dish. Minutes; ./check --soak.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "swirl/engine/simulation.hpp"
#include "swirl/measure/energy_budget.hpp"
#include "swirl/run/config.hpp"

namespace swirl {
namespace {

TEST(Soak, ABillionEventsWithoutOverlapOrDriftOfTheEnergyBudget) {
    constexpr int blocks = 100, events_per_block = 10'000'000;
    Simulation simulation(make_initial_state(RunConfig{}));
    Snapshot snapshot = simulation.snapshot();
    const double start = kinetic_energy(snapshot);
    double deepest = -1.0, accounted = 0.0, residual = 0.0, largest_residual = 0.0;
    for (int block = 1; block <= blocks; ++block) {
        double change = 0.0;
        for (int k = 0; k < events_per_block; ++k) {
            const Event event = simulation.step();
            simulation.refresh(snapshot, event);
            if (event.kind == EventKind::path_vertex) continue;
            deepest = std::fmax(deepest, event.overlap);
            const EnergyChange e = energy_change(event, snapshot);
            change += e.work - e.friction_loss - e.inelastic_loss;
        }
        accounted += change;
        residual = kinetic_energy(snapshot) - start - accounted;
        largest_residual = std::fmax(largest_residual, std::fabs(residual));
    }
    std::printf("deepest overlap %.2g, budget off by %.2g (at most %.2g) after %llu swirls\n",
                deepest, residual, largest_residual,
                static_cast<unsigned long long>(simulation.periods()));
    EXPECT_LT(deepest, 1e-12);
    EXPECT_GT(deepest, -1e-12);  // the contacts were looked at
    // An event rounds energies of order 1 by some 10⁻¹⁶; √10⁹ of that, without preference, is
    // 3·10⁻¹². What is asked is less than a tenth of a rounding error, 2⁻⁵³, to one side per event:
    // the budget rounds the length of the normal, and so has a preference of its own, a
    // twenty-fifth in 2·10⁷ events.
    EXPECT_LT(largest_residual, 0.1 * 0x1p-53 * blocks * events_per_block);
}

}  // namespace
}  // namespace swirl
