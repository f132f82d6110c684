// replay container|large|gas: the cost of mispredicted branches (bench/NOTES.md, "Branches").
// Repeats the same few events from the same state until the processor has learnt every branch, and
// compares them with as many new events. Prints nanoseconds of processor time per event.
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <vector>

#include "engine/scenes.hpp"
#include "swirl/math/median.hpp"

namespace {

double now() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return 1e9 * static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_nsec);
}

swirl::InitialState large_container(std::size_t n) {
    return swirl::state_of(
        {swirl::unit_disc()}, n,
        swirl::paper_container_radius * swirl::square_root(static_cast<double>(n) / 48.0),
        swirl::polygon_path(swirl::paper_amplitude, swirl::paper_period, swirl::paper_sides), 1.0,
        1.0);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    const bool gas = std::strcmp(argv[1], "gas") == 0, large = std::strcmp(argv[1], "large") == 0;
    swirl::InitialState scene = gas     ? swirl::gas_at_rest(1000, 0.7)
                                : large ? large_container(500)
                                        : swirl::paper_container(48);
    constexpr int positions = 12, times = 2000, few = 300;
    swirl::Simulation simulation(scene);
    std::int64_t period = 30;
    std::vector<double> learnt, unseen;
    for (int position = 0; position < positions; ++position) {
        // At the beginning of a period, where the clocks are at 0.
        simulation.advance_to(period += 3, 0.0);
        for (std::size_t i = 0; i < scene.discs.size(); ++i) scene.discs[i] = simulation.disc(i);
        std::vector<double> turns;
        for (int turn = 0; turn < times; ++turn) {
            swirl::Simulation again(scene);
            const double begin = now();
            again.run(few);
            turns.push_back((now() - begin) / few);
        }
        learnt.push_back(swirl::median(turns));
        swirl::Simulation onwards(scene);
        constexpr int many = 100'000;
        const double begin = now();
        onwards.run(many);
        unseen.push_back((now() - begin) / many);
    }
    std::printf("%d learnt events: %.1f, unseen: %.1f ns per event\n", few, swirl::median(learnt),
                swirl::median(unseen));
}
