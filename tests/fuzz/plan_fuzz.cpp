// The plan of a sweep.
#include <fstream>

#include "fuzzed_file.hpp"
#include "swirl/io/file_error.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/study/sweep_plan.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace swirl;
    namespace fs = std::filesystem;
    const fs::path folder =
        fs::temp_directory_path() / ("swirl_plan_fuzz_" + std::to_string(getpid()));
    fs::create_directories(folder);
    std::ofstream(folder / "plan.json", std::ios::binary)
        .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    read_or_reject<FileError, UsageError>([&] {
        const SweepPlan plan = read_plan(folder);
        for (std::size_t point = 0; point < plan.points() && point < 3; ++point) plan.config(point);
    });
    return 0;
}
