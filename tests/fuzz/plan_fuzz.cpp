// The plan of a sweep or a map, and what they do with it.
#include <fstream>

#include "fuzzed_file.hpp"
#include "swirl/io/file_error.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/study/map_search.hpp"
#include "swirl/study/sweep_chain.hpp"
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
        constexpr std::size_t max_points = 100'000;  // larger ones only take longer
        if (plan.points() > max_points) return;
        if (!plan.chain.empty()) chains_of(plan);
        if (!plan.map) return;
        // Values on both sides of the level, and failed runs.
        const MapRun runs[] = {{.value = {.mean = plan.map->level + 1.0, .error = 0.1}},
                               {.value = {.mean = plan.map->level - 1.0, .error = 0.1}},
                               {.failed = true}};
        explore_map(plan, [&](std::size_t point) { return &runs[point / 5 % 3]; });
    });
    return 0;
}
