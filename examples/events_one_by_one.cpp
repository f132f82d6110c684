// Events one by one: step() returns what happened.
#include <cstdio>

#include "swirl/engine/paper_scene.hpp"
#include "swirl/engine/simulation.hpp"

int main() {
    swirl::Simulation simulation(swirl::paper_scene(28, 0.5, 7));
    std::puts("       t  what");
    for (int shown = 0; shown < 10; ++shown) {
        const swirl::Event e = simulation.step();
        std::printf("%8.5f  ", e.clock);
        switch (e.kind) {
            case swirl::EventKind::disc_disc:
                std::printf("discs %u and %u: impulse %.4f\n", e.i, e.j, e.impulse.normal);
                break;
            case swirl::EventKind::disc_wall:
                std::printf("disc %u and the wall: impulse %.4f\n", e.i, e.impulse.normal);
                break;
            case swirl::EventKind::path_vertex:
                std::printf("the container passes a vertex of its path\n");
                break;
            case swirl::EventKind::begins_to_roll:
                std::printf("sphere %u begins to roll; discs never do\n", e.i);
                break;
        }
    }

    // Execute many events at once. The hash of the state is the same on every machine.
    simulation.run(9990);
    const swirl::EventCounts events = simulation.events();
    std::printf("%llu events, %llu of them with the wall\n",
                static_cast<unsigned long long>(events.total()),
                static_cast<unsigned long long>(events.disc_wall));
    std::printf("state %016llx\n", static_cast<unsigned long long>(simulation.state_hash()));
}
