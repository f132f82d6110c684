// The state of a run to be resumed, with damage that a checksum does not detect: numbers of a good
// state are replaced, and it is truncated. Accepted states run for some hundred events, are
// measured and saved again. Each change takes eight bytes of input: two select the field, two the
// number in it, and four give its new value.
#include <bit>
#include <cstring>
#include <limits>
#include <memory>
#include <vector>

#include "fuzzed_file.hpp"
#include "swirl/io/file_error.hpp"
#include "swirl/io/state_archive.hpp"
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

const std::vector<std::string>& names() {
    static const std::vector<std::string> chosen{"radial",    "slip",  "pinned",      "residence",
                                                 "diffusion", "order", "frustration", "energy"};
    return chosen;
}

struct Saved {
    std::string bytes;
    std::vector<SavedField> fields;
};

Saved good_state() {
    Observation observation = observation_of(small_run(), names());
    RunControl control;
    control.observation = &observation;
    swirl::Run run(small_run(), control);
    for (int k = 0; k < 2'000 && run.next_event(); ++k) run.pass_event();
    Saved saved;
    StateWriter write(&saved.fields);
    run.write(write);
    saved.bytes = std::move(write).bytes();
    return saved;
}

/// Small and huge numbers, whole and real, from four bytes.
std::uint64_t word_of(const std::uint8_t* data) {
    constexpr double special[] = {std::numeric_limits<double>::quiet_NaN(),
                                  std::numeric_limits<double>::infinity(),
                                  -std::numeric_limits<double>::infinity(),
                                  1e308,
                                  1e18,
                                  -1.0,
                                  0.5,
                                  1e-300};
    const auto value = static_cast<std::uint64_t>(data[1] | data[2] << 8 | data[3] << 16);
    switch (data[0] % 4) {
        case 0:
            return value;
        case 1:
            return value << (data[3] % 64);
        case 2:
            return ~value;
        default:
            return std::bit_cast<std::uint64_t>(special[value % std::size(special)]);
    }
}

void run_on(std::string state) {
    Observation observation = observation_of(small_run(), names());
    RunControl control;
    control.observation = &observation;
    control.resume = std::move(state);
    swirl::Run run(small_run(), std::move(control));
    for (int k = 0; k < 300 && run.next_event(); ++k) run.pass_event();
    observation.report();
    run.result();
    run.state();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const Saved good = good_state();
    std::string state = good.bytes;
    for (std::size_t k = 0; k + 7 < size; k += 8) {
        const auto two = [&](std::size_t at) { return 256u * data[k + at] + data[k + at + 1]; };
        const SavedField& field = good.fields[two(0) % good.fields.size()];
        if (field.count == 0) continue;
        const std::uint64_t word = word_of(data + k + 4);
        const std::size_t at = field.begin + field.width * (two(2) % field.count);
        std::memcpy(state.data() + at, &word, field.width);
    }
    if (size % 8 == 1) state.resize(state.size() - data[size - 1] - 1);
    read_or_reject<FileError, Failure>([&] { run_on(std::move(state)); });
    return 0;
}
