// The mean over replicates, the sign changes of a curve, and the mean of a series, as the program
// computes them (src/swirl/statistics).
#include <pybind11/stl.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "arrays.hpp"
#include "calls.hpp"
#include "swirl/io/checksum.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/measurements.hpp"
#include "swirl/statistics/replicates.hpp"
#include "swirl/study/crossing.hpp"
#include "swirl/study/own_points.hpp"

namespace swirl::python {
namespace {

/// Each row of `means` has the values of all replicates. Returns the columns mean, error, effective
/// samples, scatter and disagreement of the rows.
py::tuple over_replicates(const Numbers& means, const Numbers& errors, const Numbers& effective,
                          const std::vector<double>& weights, bool directions) {
    if (means.ndim() != 2 || errors.size() != means.size() || effective.size() != means.size() ||
        !(weights.empty() || weights.size() == std::size_t(means.shape(1))))
        throw UsageError("means, errors and effective must have the same shape, [row, replicate].");
    const auto rows = std::size_t(means.shape(0)), runs = std::size_t(means.shape(1));
    std::vector<double> columns(5 * rows);
    for (std::size_t k = 0; k < rows; ++k) {
        std::vector<Estimate> estimates(runs);
        for (std::size_t r = 0; r < runs; ++r) {
            const std::size_t at = k * runs + r;
            estimates[r] = {means.data()[at], errors.data()[at], effective.data()[at]};
        }
        const Ensemble all =
            directions ? several_directions(estimates, weights) : ensemble(estimates, weights);
        const double found[] = {all.estimate.mean, all.estimate.error,
                                all.estimate.effective_samples, all.scatter,
                                all.disagree ? 1.0 : 0.0};
        for (std::size_t c = 0; c < std::size(found); ++c) columns[c * rows + k] = found[c];
    }
    const py::array all = owned_array(std::move(columns), {5, signed_size(rows)});
    return py::tuple(py::list(all));
}

py::dict change_dict(const SignChange& change) {
    py::dict found;
    found["before"] = change.before;
    found["after"] = change.after;
    found["to_counterrotation"] = change.to_counterrotation;
    found["discs"] = change.discs;
    found["error"] = change.error;
    found["lower"] = change.lower;
    found["upper"] = change.upper;
    found["location"] = change_location(change);
    return found;
}

py::dict zero_crossing(const std::vector<double>& discs, const std::vector<double>& means,
                       const std::vector<double>& errors) {
    if (means.size() != discs.size() || errors.size() != discs.size())
        throw UsageError("discs, means and errors must have the same length.");
    std::vector<RotationPoint> points;
    for (std::size_t k = 0; k < discs.size(); ++k)
        points.push_back({discs[k], means[k], errors[k]});
    const Crossing crossing = find_crossing(points);
    py::list changes;
    for (const SignChange& change : crossing.changes) changes.append(change_dict(change));
    py::dict found;
    found["verdict"] = verdict_word(crossing.verdict);
    found["points"] = crossing.points;
    found["discs"] = crossing.discs;
    found["error"] = crossing.error;
    found["lower"] = crossing.lower;
    found["upper"] = crossing.upper;
    found["changes"] = changes;
    found["last"] = crossing.last() ? py::object(change_dict(*crossing.last())) : py::none();
    found["undetermined"] = crossing.undetermined;
    found["undetermined_after"] = crossing.undetermined_after();
    found["words"] = crossing_words(crossing);
    return found;
}

/// (mean, error, effective samples, autocorrelation time).
py::tuple estimate_of_values(const std::vector<double>& values) {
    const SeriesEstimate found = estimate_of_series(values);
    return py::make_tuple(found.estimate.mean, found.estimate.error,
                          found.estimate.effective_samples, found.autocorrelation_time);
}

using PointTuple = std::tuple<double, double, double>;

std::vector<RotationPoint> rotation_points(const std::vector<PointTuple>& tuples) {
    std::vector<RotationPoint> points;
    for (const auto& [discs, mean, error] : tuples) points.push_back({discs, mean, error});
    return points;
}

std::vector<PointTuple> tuples_of(const std::vector<RotationPoint>& points) {
    std::vector<PointTuple> tuples;
    for (const RotationPoint& p : points) tuples.emplace_back(p.discs, p.mean, p.error);
    return tuples;
}

/// (points in the range of all curves, χ² of each curve, (value, lower, upper, χ², degrees of
/// freedom, whether the interval is open) of the best parameter or None).
py::tuple compare_curves(const std::vector<double>& parameters,
                         const std::vector<std::vector<PointTuple>>& given,
                         const std::vector<PointTuple>& measured) {
    if (parameters.size() != given.size())
        throw UsageError("there must be as many parameters as curves.");
    std::vector<ModelCurve> curves;
    for (std::size_t k = 0; k < given.size(); ++k)
        curves.push_back({parameters[k], rotation_points(given[k])});
    const std::vector<RotationPoint> points = comparable_points(curves, rotation_points(measured));
    std::vector<double> chi_squares;
    for (const ModelCurve& curve : curves) chi_squares.push_back(chi_square_of(curve, points));
    py::object best = py::none();
    const bool differ = std::none_of(parameters.begin(), parameters.end(),
                                     [](double value) { return std::isnan(value); });
    if (const auto found = differ ? best_parameter(curves, points) : std::nullopt)
        best = py::make_tuple(found->value, found->lower, found->upper, found->chi_square,
                              found->freedom, found->open_below || found->open_above);
    return py::make_tuple(tuples_of(points), chi_squares, best);
}

}  // namespace

void bind_statistics(py::module_& module) {
    module.def("over_replicates", &over_replicates,
               R"(over_replicates(means: npt.ArrayLike, errors: npt.ArrayLike,
    effective: npt.ArrayLike, weights: Sequence[float],
    directions: bool) -> tuple[_Floats, _Floats, _Floats, _Floats, _Floats])");
    module.def(
        "is_direction", [](const std::string& name) { return is_direction(name); },
        "is_direction(name: str) -> bool");
    module.def(
        "replicate_weights",
        [](const std::vector<double>& periods, bool by_time) {
            return replicate_weights(periods, by_time);
        },
        "replicate_weights(periods: Sequence[float], by_time: bool) -> list[float]");
    module.attr("min_averaged_periods") = min_averaged_periods;
    module.def("zero_crossing", &zero_crossing,
               R"(zero_crossing(discs: Sequence[float], means: Sequence[float],
    errors: Sequence[float]) -> dict[str, Any])");
    module.def(
        "read_own_points",
        [](const std::string& file, std::optional<double> period) {
            return tuples_of(read_own_points(file, period));
        },
        "read_own_points(file: str, period: Optional[float]) -> _Curve");
    module.def("compare_curves", &compare_curves,
               R"(compare_curves(parameters: list[float], curves: list[_Curve],
    measured: _Curve) -> tuple[_Curve, list[float],
    Optional[tuple[float, float, float, float, int, bool]]])");
    module.def("estimate_of_series", &estimate_of_values,
               "estimate_of_series(values: Sequence[float]) -> tuple[float, float, float, float]");
    module.def(
        "checksum", [](const std::string& text) { return fmt::format("{:016x}", checksum(text)); },
        "checksum(text: str) -> str");
}

}  // namespace swirl::python
