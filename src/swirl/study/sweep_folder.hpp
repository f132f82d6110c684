// The files in the folder of a sweep (sweep.hpp).
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "swirl/study/sweep_plan.hpp"

namespace swirl {

/// Format of plans and results.
constexpr int sweep_format = 2;

/// "000012"
std::string number_of_point(std::size_t point);
/// DIR/results and so on; DIR/results-2 after the plan got further measurements.
std::filesystem::path part_of_sweep(const std::filesystem::path& folder, const char* part,
                                    const SweepPlan& plan);
std::filesystem::path result_file(const std::filesystem::path& folder, const SweepPlan& plan,
                                  std::size_t point);

/// The error message of a failed run.
std::filesystem::path failure_file(const std::filesystem::path& folder, std::size_t point);

/// True if a file is part of the sweep (plan, locks, results, checkpoints, …) or lies in a folder
/// of it. Tables made from the sweep are not part of it. `file`: its canonical name.
bool belongs_to_sweep(const std::filesystem::path& folder, const std::filesystem::path& file);

/// Element k is true if the file of number k with this ending exists. Lists the folder once. Throws
/// FileError.
std::vector<bool> numbered_files(const std::filesystem::path& folder, std::string_view ending,
                                 std::size_t points);

}  // namespace swirl
