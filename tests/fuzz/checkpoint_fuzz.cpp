// A checkpoint from outside: first line, lengths, checksum, identity of the run, and state. The
// mutator corrects the checksum, so that the code behind the check is reached. Accepted checkpoints
// are resumed and run for some hundred events.
#include <cstring>

#include "fuzzed_file.hpp"
#include "swirl/io/checkpoint.hpp"
#include "swirl/io/checksum.hpp"
#include "swirl/io/file_error.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/json.hpp"
#include "swirl/run/measurements.hpp"
#include "swirl/run/recorded_run.hpp"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t maximum);

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t maximum, unsigned seed) {
    size = LLVMFuzzerMutate(data, size, maximum);
    if (size < 8 || seed % 16 == 0) return size;  // sometimes keeps a wrong checksum
    const std::uint64_t sum =
        swirl::checksum({reinterpret_cast<const char*>(data), size - sizeof sum});
    std::memcpy(data + size - sizeof sum, &sum, sizeof sum);
    return size;
}

namespace {

using namespace swirl;

/// Resumes like `swirl run --checkpoint FILE --resume --events …`, if the run is small.
void resume(const std::filesystem::path& path) {
    const CheckpointedCall saved = call_in_checkpoint(path);
    RunConfig config = resolve(parameters_in(saved.configuration));
    if (config.discs > 30 || config.periods || config.events > 5'000 || config.sides > 1'000)
        return;
    RunFiles files;
    files.checkpoint = path;
    files.resume = true;
    run_recorded(config, files, {}, {});
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const FuzzedFile file(data, size);
    read_or_reject<FileError, UsageError, Failure>([&] { resume(file.path()); });
    return 0;
}
