// Curves ϖ(N) of a figure: their table, and where they cross zero.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "swirl/measure/rotation_crossings.hpp"
#include "track/experiment/results.hpp"

namespace swirl {

/// A point of a curve, with "mean_by_event", "mean_by_time", … as the average. NaN for a failed
/// run, which crossings ignore.
RotationPoint rotation_point(double x, const Json& result, const char* average);

/// ϖ(N) by each of rotation_rates; `rate` is the one that the figure shows.
struct NamedCurve {
    std::string name;
    std::size_t rate = default_rate;
    RotationCurves curves = {};

    const std::vector<RotationPoint>& points() const { return curves[rate]; }
};

/// "crosses zero at N = 36.4 ± 0.3 (95 %: 35.9 to 37.0; mean over the discs, by time)", "crosses
/// zero between N = 36 and 40 (…)", or "always rotates" with the lowest point; then the other
/// rates. A sentence with its full stop.
std::string crossing_sentence(const NamedCurve& curve);

/// The table of crossings: where each curve crosses zero, and its lowest point.
void write_crossings(const std::vector<NamedCurve>& curves, const fs::path& file);

}  // namespace swirl
