// The parts of a sweep's folder (sweep.hpp).
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "swirl/study/sweep_plan.hpp"

namespace swirl {

/// Of plans and of results.
constexpr int sweep_format = 1;

std::string number_of_point(std::size_t point);
/// Of the plan as it is now: what was measured less is another run.
std::filesystem::path part_of_sweep(const std::filesystem::path& folder, const char* part,
                                    const SweepPlan& plan);
std::filesystem::path result_file(const std::filesystem::path& folder, const SweepPlan& plan,
                                  std::size_t point);

/// Whether a file is one that the sweep keeps for itself, or lies in a folder of those: plan,
/// claims, results, checkpoints and so on, but not a table that was made of them. `file`: its one
/// name, whole and through links.
bool belongs_to_sweep(const std::filesystem::path& folder, const std::filesystem::path& file);

/// The numbers of the files NUMBER.ending in a folder; one look at the folder, whatever its size.
std::vector<bool> numbered_files(const std::filesystem::path& folder, std::string_view ending,
                                 std::size_t points);

}  // namespace swirl
