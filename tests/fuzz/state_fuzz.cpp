// The state of a run that is to be resumed, damaged behind its checksum's back: bytes of a good one
// are replaced, and it is cut. Every three bytes of input are an offset and what to put there.
#include "fuzzed_file.hpp"
#include "swirl/files/file_error.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/measurements.hpp"
#include "swirl/run/run.hpp"

namespace {

using namespace swirl;

RunConfig small_run() {
    RunConfig config;
    config.discs = 5;
    config.events = 4'000;
    config.warmup = 1;
    return config;
}

std::string good_state() {
    Observation observation = observation_of(small_run(), {"density", "slip", "pinned"});
    RunControl control;
    control.observation = &observation;
    swirl::Run run(small_run(), control);
    for (int k = 0; k < 2'000 && run.next_event(); ++k) run.pass_event();
    return run.state();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const std::string good = good_state();
    std::string state = good;
    for (std::size_t k = 0; k + 2 < size; k += 3)
        state[(256u * data[k] + data[k + 1]) % state.size()] = static_cast<char>(data[k + 2]);
    if (size % 3 == 1) state.resize(state.size() - data[size - 1] - 1);
    Observation observation = observation_of(small_run(), {"density", "slip", "pinned"});
    RunControl control;
    control.observation = &observation;
    control.resume = state;
    read_or_refuse<FileError>([&] { swirl::Run(small_run(), control); });
    return 0;
}
