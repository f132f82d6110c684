// count_instructions SCENE EVENTS: runs so many events and nothing else, for
// instructions_test.py to count under valgrind. Baseline vectors, which valgrind and every
// processor know.
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "simulation/scenes.hpp"

int main(int argc, char** argv) {
    if (argc != 3) return 2;
    const auto is = [&](const char* name) { return std::strcmp(argv[1], name) == 0; };
    const swirl::InitialState scene = is("dish")  ? swirl::paper_dish(48)
                                      : is("few") ? swirl::paper_dish(28)
                                      : is("gas") ? swirl::gas_at_rest(1000, 0.7)
                                                  : swirl::gas_at_rest(1000, 0.2);
    swirl::Simulation simulation(scene, {}, {0, swirl::Width::baseline});
    simulation.run(std::strtoull(argv[2], nullptr, 10));
    std::printf("%016llx\n", static_cast<unsigned long long>(simulation.state_hash()));
}
