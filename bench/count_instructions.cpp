// count_instructions SCENE EVENTS: executes that many events; instructions_test.py counts its
// instructions under valgrind. Uses baseline vectors, which valgrind and every processor support.
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "engine/scenes.hpp"

int main(int argc, char** argv) {
    if (argc != 3) return 2;
    const auto is = [&](const char* name) { return std::strcmp(argv[1], name) == 0; };
    swirl::InitialState scene = is("container") || is("circle")  ? swirl::paper_container(48)
                                : is("few") || is("few, circle") ? swirl::paper_container(28)
                                : is("gas")                      ? swirl::gas_at_rest(1000, 0.7)
                                                                 : swirl::gas_at_rest(1000, 0.2);
    if (std::strstr(argv[1], "circle"))
        scene.path = swirl::circular_path(swirl::paper_amplitude, swirl::paper_period);
    swirl::Simulation simulation(scene, {}, {0, swirl::Width::baseline});
    simulation.run(std::strtoull(argv[2], nullptr, 10));
    std::printf("%016llx\n", static_cast<unsigned long long>(simulation.state_hash()));
}
