#include "swirl/study/sweep_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "swirl/io/optional_file.hpp"

namespace swirl {

namespace fs = std::filesystem;

std::string number_of_point(std::size_t point) { return fmt::format("{:06}", point); }

fs::path part_of_sweep(const fs::path& folder, const char* part, const SweepPlan& plan) {
    return folder / (plan.generation > 1 ? fmt::format("{}-{}", part, plan.generation) : part);
}

fs::path result_file(const fs::path& folder, const SweepPlan& plan, std::size_t point) {
    return part_of_sweep(folder, "results", plan) / (number_of_point(point) + ".json");
}

fs::path failure_file(const fs::path& folder, std::size_t point) {
    return folder / "failures" / (number_of_point(point) + ".txt");
}

bool belongs_to_sweep(const fs::path& folder, const fs::path& file) {
    static constexpr std::string_view parts[] = {
        "plan.json",    "locks", "job.sh",   "slurm_job", "results", "checkpoints",
        "trajectories", "log",   "failures", "series",    "states"};
    for (const std::string& name : names_in_folder(folder)) {
        // results-2 after the sweep got further measurements
        const bool is_part = std::any_of(std::begin(parts), std::end(parts), [&](auto part) {
            return name == part || name.starts_with(std::string(part) + "-");
        });
        std::error_code ignored;
        const fs::path canonical = fs::weakly_canonical(folder / name, ignored);
        if (is_part &&
            std::mismatch(canonical.begin(), canonical.end(), file.begin(), file.end()).first ==
                canonical.end())
            return true;
    }
    return false;
}

std::vector<bool> numbered_files(const fs::path& folder, std::string_view ending,
                                 std::size_t points) {
    std::vector<bool> exists(points, false);
    for (const std::string& name : names_in_folder(folder)) {
        std::size_t point = 0;
        const auto [stop, status] = std::from_chars(name.data(), name.data() + name.size(), point);
        if (status == std::errc() && point < points &&
            std::string_view(stop, std::size_t(name.data() + name.size() - stop)) == ending)
            exists[point] = true;
    }
    return exists;
}

}  // namespace swirl
