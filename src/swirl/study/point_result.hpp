// The result of one point of a sweep, as far as tables and maps need it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "swirl/run/measurements.hpp"
#include "swirl/statistics/block_average.hpp"
#include "swirl/study/sweep_plan.hpp"

namespace swirl {

struct PointResult {
    bool exists = false, has_whole_period = true;
    /// The four rotation rates, then the measured numbers.
    std::vector<MeasuredNumber> quantities;
    double energy = 0.0, periods = 0.0;
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

/// Reads DIR/results/NUMBER.json. Throws FileError if the file is damaged, in another format, or
/// the result of another point.
PointResult read_result(const std::filesystem::path& folder, const SweepPlan& plan,
                        std::size_t point);

}  // namespace swirl
