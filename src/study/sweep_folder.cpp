#include "swirl/study/sweep_folder.hpp"

#include <fmt/format.h>

#include <charconv>

namespace swirl {

namespace fs = std::filesystem;

std::string number_of_point(std::size_t point) { return fmt::format("{:06}", point); }

fs::path part_of_sweep(const fs::path& folder, const char* part, const SweepPlan& plan) {
    return folder / (plan.generation > 1 ? fmt::format("{}-{}", part, plan.generation) : part);
}

fs::path result_file(const fs::path& folder, const SweepPlan& plan, std::size_t point) {
    return part_of_sweep(folder, "results", plan) / (number_of_point(point) + ".json");
}

std::vector<bool> numbered_files(const fs::path& folder, std::string_view ending,
                                 std::size_t points) {
    std::vector<bool> there(points, false);
    std::error_code error;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
        const std::string name = it->path().filename().string();
        std::size_t point = 0;
        const auto [stop, wrong] = std::from_chars(name.data(), name.data() + name.size(), point);
        if (wrong == std::errc() && point < points &&
            std::string_view(stop, std::size_t(name.data() + name.size() - stop)) == ending)
            there[point] = true;
    }
    return there;
}

}  // namespace swirl
