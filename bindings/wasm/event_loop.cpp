// The bare event loop without measurements: web/test/speed.mjs compares it with
// `bench/run --width sse2`. It is not part of the browser page.
#include <cstdint>
#include <memory>
#include <string>

#include "swirl/engine/simulation.hpp"
#include "swirl/run/config.hpp"
#include "swirl/run/failure.hpp"

#define EXPORTED(name) extern "C" __attribute__((export_name(#name)))

namespace swirl {

// Never called: this program only times valid configurations.
void throw_usage_error(const Message&) { __builtin_trap(); }
void throw_interrupted(const std::string&) { __builtin_trap(); }

namespace {
std::unique_ptr<Simulation> simulation;
}

EXPORTED(begin) void begin(std::uint32_t discs) {
    RunConfig config;
    config.discs = discs;
    simulation = std::make_unique<Simulation>(make_initial_state(config));
}

EXPORTED(run_events) void run_events(std::uint32_t count) {
    for (std::uint32_t k = 0; k < count; ++k) simulation->step();
}

}  // namespace swirl
