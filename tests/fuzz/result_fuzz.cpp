// The result of one run in the folder of a sweep, read by `collect`.
#include <fstream>

#include "fuzzed_file.hpp"
#include "swirl/io/file_error.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/study/collected_sweep.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace swirl;
    namespace fs = std::filesystem;
    static const fs::path folder = [] {
        fs::path made =
            fs::temp_directory_path() / ("swirl_result_fuzz_" + std::to_string(getpid()));
        write_plan(made, make_plan({{"discs", "5"}, {"periods", "4"}}, 1));
        return made;
    }();
    static const SweepPlan plan = read_plan(folder);
    fs::create_directories(folder / "results");
    std::ofstream(folder / "results" / "000000.json", std::ios::binary)
        .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    read_or_reject<FileError>([&] { collect_sweep(folder, plan); });
    return 0;
}
