// Prints the hashes of the golden runs, computed by the baseline loop. compilers_test.py builds
// this with several compilers and levels of optimisation.
#include <cstdio>

#include "engine/golden_runs.hpp"

int main() {
    for (const swirl::GoldenRun& golden : swirl::golden_runs()) {
        swirl::Simulation simulation(golden.scene, {}, {0, swirl::Width::baseline});
        simulation.run(golden.events / 10);
        std::printf("%s: %016llx\n", golden.name,
                    static_cast<unsigned long long>(simulation.state_hash()));
    }
}
