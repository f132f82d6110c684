// The engine and a measurement behind two functions of plain numbers, as a page in a browser would
// call them. wasm32_test.py compiles this for wasm32 and for this machine and compares the bits.
#include <cstdint>
#include <cstring>

#include "dish.hpp"
#include "swirl/measure/cluster_rotation.hpp"
#include "swirl/simulation/simulation.hpp"

#if defined(__wasm__)
#define EXPORTED(name) extern "C" __attribute__((export_name(#name)))
#else
#include <cstdio>
#define EXPORTED(name) static
#endif

EXPORTED(state_hash) std::uint64_t state_hash(std::uint32_t discs, std::uint32_t events) {
    swirl::Simulation simulation(paper_dish(discs, 0.5, 7));
    simulation.run(events);
    return simulation.state_hash();
}

EXPORTED(rotation_bits) std::uint64_t rotation_bits(std::uint32_t discs, std::uint32_t events) {
    swirl::Simulation simulation(paper_dish(discs, 0.5, 7));
    swirl::ClusterRotation rotation;
    swirl::Snapshot snapshot = simulation.snapshot();
    for (std::uint32_t k = 0; k < events; ++k) {
        const swirl::Event event = simulation.step();
        simulation.refresh(snapshot, event);
        rotation.sample(snapshot, event);
    }
    rotation.close_block();
    const double varpi = rotation.estimates().by_event.mean;
    std::uint64_t bits;
    std::memcpy(&bits, &varpi, sizeof bits);
    return bits;
}

#if !defined(__wasm__)
int main() {
    for (const std::uint32_t discs : {1u, 28u, 50u})
        std::printf("%u %016llx %016llx\n", discs,
                    static_cast<unsigned long long>(state_hash(discs, 5000)),
                    static_cast<unsigned long long>(rotation_bits(discs, 5000)));
}
#endif
