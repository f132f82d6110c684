// The result of one point of a sweep, as far as tables and maps need it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "swirl/run/measurements.hpp"
#include "swirl/run/result.hpp"
#include "swirl/statistics/block_average.hpp"
#include "swirl/study/sweep_plan.hpp"

namespace swirl {

struct PointResult {
    bool exists = false, has_whole_period = true;
    /// The four rotation rates, then the measured numbers.
    std::vector<MeasuredNumber> quantities;
    double energy = 0.0, periods = 0.0;
    double averaged_periods = 0.0;  // length after the warm-up; 0 if the run ended before
    std::string state_hash, verdict, version;

    /// Checks `expected_index` first, because the quantity is nearly always there.
    Estimate quantity(std::size_t expected_index, const std::string& name) const {
        if (expected_index < quantities.size() && quantities[expected_index].name == name)
            return quantities[expected_index].estimate;
        for (const MeasuredNumber& other : quantities)
            if (other.name == name) return other.estimate;
        return {.mean = not_available, .error = not_available};
    }
};

/// A result file that was cut off counts as missing: its run is repeated and replaces it. Throws
/// FileError as read_result() does.
bool has_whole_result(const std::filesystem::path& folder, const SweepPlan& plan,
                      std::size_t point);
/// The same for all points that matter, on all cores; false for the others.
std::vector<bool> whole_results(const std::filesystem::path& folder, const SweepPlan& plan,
                                const std::function<bool(std::size_t point)>& matters);

/// The checksum of the point's series that its result holds; "" without one, as in results of older
/// versions.
std::string series_checksum(const std::filesystem::path& folder, const SweepPlan& plan,
                            std::size_t point);

/// Reads DIR/results/NUMBER.json; the result does not exist if the file is not whole. Throws
/// FileError if the file cannot be read, is in another format, lacks a part, or is the result of
/// another point.
PointResult read_result(const std::filesystem::path& folder, const SweepPlan& plan,
                        std::size_t point);

/// "swirl run --discs 5 --seed 1" with `more` options before the seed.
std::string command_of_run(const ParameterTexts& parameters, const std::string& more,
                           std::uint64_t seed);

/// The content of a result file without measurements. `started_from` of a chain is null.
nlohmann::ordered_json point_json(const SweepPlan& plan, std::size_t point, const RunResult& result,
                                  const std::string& command);

}  // namespace swirl
