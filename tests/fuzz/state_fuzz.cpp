// The state of a run that is to be resumed, damaged behind its checksum's back: bytes of a good one
// are replaced, and it is cut. Every four bytes of input are an offset and what to put there.
#include <memory>

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
    for (std::size_t k = 0; k + 3 < size; k += 4)
        state[(65'536u * data[k] + 256u * data[k + 1] + data[k + 2]) % state.size()] =
            static_cast<char>(data[k + 3]);
    if (size % 4 == 1) state.resize(state.size() - data[size - 1] - 1);
    Observation observation = observation_of(small_run(), {"density", "slip", "pinned"});
    RunControl control;
    control.observation = &observation;
    control.resume = std::move(state);
    read_or_refuse<FileError>(
        [&] { std::make_unique<swirl::Run>(small_run(), std::move(control)); });
    return 0;
}
