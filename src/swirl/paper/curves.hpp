// Curves ϖ(N) of a figure: their table, and where they cross zero.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "swirl/measure/rotation_crossings.hpp"
#include "swirl/paper/paper_parameters.hpp"
#include "swirl/paper/results.hpp"

namespace swirl {

/// A point of a curve, with "by_event", "by_time", … as the average. NaN for a failed run, which
/// crossings ignore.
RotationPoint rotation_point(double x, const Json& result, const char* average);

/// The point with the lowest (highest) mean; null if no point has a mean.
const RotationPoint* lowest_of(std::span<const RotationPoint> curve);
const RotationPoint* highest_of(std::span<const RotationPoint> curve);

/// ϖ(N) by each of rotation_rates; `rate` is the one that the figure shows.
struct NamedCurve {
    std::string name;
    std::size_t rate = default_rate;
    RotationCurves curves = {};

    void add(double discs, const Json& result);
    const std::vector<RotationPoint>& points() const { return curves[rate]; }
};

/// How many of these points are below zero by more than three errors.
std::int64_t count_counterrotating(std::span<const RotationPoint> points);

/// A curve of a figure, or a row of a map.
struct FigureCurve {
    std::string name;
    std::vector<Table::Cell> cells;  // of the columns before "discs"
    std::string words = {};          // for sentences
};
FigureCurve curve_of(const Friction& friction);  // with columns_of_friction

inline const std::vector<std::string> columns_of_friction{"setting", "mu_disc", "mu_wall"};

/// The points of a figure with curves ϖ(N), in the order of its results.
struct CurveFigure {
    struct Point {
        std::size_t curve;
        std::int64_t discs;
    };
    std::string name;                  // of the figure
    std::vector<std::string> columns;  // before "discs"
    std::vector<FigureCurve> curves;
    std::vector<Point> points = {};
    std::vector<std::string> measured = {};  // quantities as in number_columns()
    std::size_t rate = default_rate;         // that the figure shows, of rotation_rates

    /// All curves at these N.
    void add_points(const std::vector<std::int64_t>& numbers);
    std::vector<NamedCurve> named_curves(const std::vector<Json>& results) const;
    /// figure_NAME.csv: a row for each point.
    void write_points(const std::vector<Json>& results, const fs::path& out,
                      FigureOutcome& outcome) const;
    /// figure_NAME_crossings.csv
    void write_crossings(const std::vector<Json>& results, const fs::path& out,
                         FigureOutcome& outcome) const;
    /// "what (words): 0.5 at N = 24, 0.9 at N = 48.": a measured quantity of a curve, such as
    /// "slip.cluster", at its first and last N.
    std::string at_both_ends(std::size_t curve, const std::string& what,
                             const std::string& quantity, const std::vector<Json>& results) const;
};

/// "crosses zero at N = 36.4 ± 0.3 (95 %: 35.9 to 37.0; mean over the discs, by time)", "crosses
/// zero between N = 36 and 40 (…)", or "always rotates" with the lowest point; then the other
/// rates. A sentence with its full stop.
std::string crossing_sentence(const NamedCurve& curve);

/// Columns with N_c by each of rotation_rates: "crossing_by_event", its error and interval, ….
std::vector<std::string> rates_columns();

/// The table of crossings: where each curve crosses zero, and its lowest point.
void write_crossings(const std::vector<NamedCurve>& curves, const fs::path& file);

}  // namespace swirl
