// My points next to the model: a table of rotations that were counted or measured at a real dish,
// and the curves of a sweep.
//
// The table has a row for each number of particles, and one of these sets of columns:
//
//     N, turns, circles            turns of the cluster, negative against the swirl, in circles of
//                                  the dish
//     N, turns, time               the same in seconds, if the duration of a circle is known
//     N, rate, error               ϖ/Ω and its standard error
//
// Turns have the error of reading a mark twice to a twelfth of a turn, unless a column `error`
// gives another one, in turns.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "swirl/statistics/model_comparison.hpp"
#include "swirl/study/collected_sweep.hpp"

namespace swirl {

/// Throws UsageError with the file, the line and the value. `period`: duration of a circle, in s.
std::vector<RotationPoint> read_own_points(const std::string& file,
                                           std::optional<double> period = {});

/// ϖ(N) of a model, and its parameters.
struct CurveOfModel {
    ParameterTexts parameters;
    std::vector<RotationPoint> points;
};

/// A curve with the parameters that distinguish it from the others.
struct ComparedCurve {
    std::string name;  // "mu 0.3, floor_friction 0.3"; empty for a single curve
    ModelCurve curve;
};

struct Comparison {
    std::vector<RotationPoint> points;       // that lie in the range of all curves
    std::size_t left_out = 0;                // points that do not
    std::string parameter;                   // the one that is fitted; empty if none can be
    std::vector<ComparedCurve> curves = {};  // sorted by the parameter, if there is one
    std::vector<double> chi_squares = {};
    std::optional<BestParameter> best = {};
};

/// The fitted parameter is the first of `varied` that differs between all curves.
Comparison compare_points(std::vector<CurveOfModel> models, const std::vector<std::string>& varied,
                          const std::vector<RotationPoint>& points);

/// Compares with the rotation by time. Throws UsageError if the sweep does not vary the number of
/// discs.
Comparison compare_with_sweep(const SweepPlan& plan, const CollectedSweep& collected,
                              const std::vector<RotationPoint>& points);

/// "mu = 0.31 ± 0.02 fits best: χ² = 4.1 of 6 points", with a line for each curve.
std::string comparison_text(const Comparison& comparison);

/// Columns discs, rate, error: for the drawing.
std::string own_points_csv(const std::vector<RotationPoint>& points);

}  // namespace swirl
