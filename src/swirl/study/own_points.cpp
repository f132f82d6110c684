#include "swirl/study/own_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "swirl/io/file_error.hpp"
#include "swirl/io/number_table.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/parameter_files.hpp"
#include "swirl/run/reading.hpp"
#include "swirl/run/report.hpp"
#include "swirl/study/crossing.hpp"

namespace swirl {
namespace {

/// A mark is read at the beginning and at the end, each to about a twelfth of a turn, like the hour
/// on a clock.
const double reading_error = std::sqrt(2.0) / 12.0;

/// The columns of a table of own points.
struct OwnColumns {
    std::size_t discs;
    std::optional<std::size_t> rate, turns, circles, time, error;

    explicit OwnColumns(NumberTable& table)
        : discs(table.column({"n", "discs", "spheres", "number"})),
          rate(table.find({"rate", "rotation", "mean_by_time"})),
          time(table.find({"time", "seconds", "time_s"})),
          error(table.find({"error", "rate_error", "rotation_error", "mean_by_time_error"})) {
        if (rate) return;
        turns = table.column({"turns"});
        if (!time) circles = table.column({"circles", "periods"});
    }
};

class OwnPointReader {
  public:
    OwnPointReader(TextLines& lines, std::optional<double> period)
        : lines_(lines), table_(lines), columns_(table_), period_(period) {
        if (columns_.rate && !columns_.error)
            lines.fail("the table has rates without the column 'error'");
        if (columns_.time && !period)
            lines.fail(
                "the table has times, but the duration of a circle is unknown; give --period with "
                "a "
                "unit, or a column 'circles'");
    }

    std::vector<RotationPoint> read() {
        std::vector<RotationPoint> points;
        while (table_.next()) points.push_back(point());
        if (points.empty()) lines_.fail_without_rows();
        return points;
    }

  private:
    RotationPoint point() {
        const std::int64_t discs = table_.integer(columns_.discs);
        if (discs < 2) lines_.fail(fmt::format("the number of particles is {}", discs));
        if (columns_.rate)
            return {double(discs), table_.number(*columns_.rate),
                    positive(*columns_.error, "error")};
        const double circles = columns_.time ? positive(*columns_.time, "time") / *period_
                                             : positive(*columns_.circles, "number of circles");
        const double turns = table_.number(*columns_.turns);
        // A cluster rolls along the wall at most once per circle.
        constexpr double most_turns = 3.0;
        if (std::fabs(turns) > most_turns * circles + 1.0)
            lines_.fail(fmt::format("{} turns in {} circles are too many", turns, circles));
        const double error = columns_.error ? positive(*columns_.error, "error") : reading_error;
        return {double(discs), turns / circles, error / circles};
    }

    double positive(std::size_t column, const char* what) {
        const double value = table_.number(column);
        if (!(value > 0.0))
            lines_.fail(fmt::format("the {} is {}, but it must be above 0", what, value));
        return value;
    }

    TextLines& lines_;
    NumberTable table_;
    OwnColumns columns_;
    std::optional<double> period_;
};

/// The parameters other than the number of discs with several values in the sweep.
std::vector<std::string> varied_parameters(const SweepPlan& plan) {
    std::vector<std::string> names;
    for (const SweepAxis& axis : plan.axes) {
        std::vector<std::string> values = axis.values;
        std::sort(values.begin(), values.end());
        values.erase(std::unique(values.begin(), values.end()), values.end());
        if (axis.name != "discs" && values.size() > 1) names.push_back(axis.name);
    }
    if (!plan.chain.empty()) names.emplace_back("direction");
    return names;
}

/// The first of these parameters that is a number in every curve and different in each; "" if none
/// is.
std::string fitted_parameter(const std::vector<std::string>& varied,
                             const std::vector<CurveOfModel>& curves) {
    for (const std::string& name : varied) {
        std::vector<double> values;
        for (const CurveOfModel& curve : curves)
            if (const auto found = curve.parameters.find(name); found != curve.parameters.end())
                if (const auto number = read_number(found->second)) values.push_back(*number);
        std::sort(values.begin(), values.end());
        if (values.size() == curves.size() &&
            std::adjacent_find(values.begin(), values.end()) == values.end())
            return name;
    }
    return "";
}

/// "mu 0.3, floor_friction 0.3"
std::string name_of(const std::vector<std::string>& varied, const ParameterTexts& parameters) {
    std::string name;
    for (const std::string& each : varied)
        if (const auto found = parameters.find(each); found != parameters.end())
            name += fmt::format("{}{} {}", name.empty() ? "" : ", ", each, found->second);
    return name;
}

}  // namespace

std::vector<RotationPoint> read_own_points(const std::string& file, std::optional<double> period) {
    const std::string text = text_of_table_file("--my-points", file);
    TextLines lines(fmt::format("'{}'", file), text);
    try {
        return OwnPointReader(lines, period).read();
    } catch (const FileError& error) {
        throw UsageError(fmt::format(
            "{}\nhint: the columns are N, turns and circles, or N, rate and error.",
            std::string_view(error.what()).substr(0, std::string_view(error.what()).find('\n'))));
    }
}

Comparison compare_points(std::vector<CurveOfModel> models, const std::vector<std::string>& varied,
                          const std::vector<RotationPoint>& points) {
    Comparison comparison;
    comparison.parameter = fitted_parameter(varied, models);
    std::vector<ComparedCurve> named;
    for (CurveOfModel& model : models) {
        std::sort(model.points.begin(), model.points.end(),
                  [](const RotationPoint& a, const RotationPoint& b) { return a.discs < b.discs; });
        named.push_back({name_of(varied, model.parameters), {.points = std::move(model.points)}});
        if (!comparison.parameter.empty())
            named.back().curve.parameter = *read_number(model.parameters.at(comparison.parameter));
    }
    if (!comparison.parameter.empty())
        std::sort(named.begin(), named.end(), [](const ComparedCurve& a, const ComparedCurve& b) {
            return a.curve.parameter < b.curve.parameter;
        });
    std::vector<ModelCurve> curves;
    for (const ComparedCurve& each : named) curves.push_back(each.curve);
    comparison.points = comparable_points(curves, points);
    comparison.left_out = points.size() - comparison.points.size();
    for (const ModelCurve& curve : curves)
        comparison.chi_squares.push_back(chi_square_of(curve, comparison.points));
    if (!comparison.parameter.empty()) comparison.best = best_parameter(curves, comparison.points);
    comparison.curves = std::move(named);
    return comparison;
}

Comparison compare_with_sweep(const SweepPlan& plan, const CollectedSweep& collected,
                              const std::vector<RotationPoint>& points) {
    if (!plan.axis("discs"))
        throw UsageError(
            "--my-points is given, but --discs is not a parameter of this sweep.\nhint: give the "
            "numbers of particles of your points.");
    const std::vector<std::string> varied = varied_parameters(plan);
    std::vector<CurveOfModel> models;
    for (const CollectedRow& row : collected.rows) {
        const Estimate& rate = row.rotation[default_rate];
        if (!std::isfinite(rate.mean)) continue;
        const ParameterTexts& all = row.parameters;
        ParameterTexts group;
        for (const std::string& name : varied)
            if (const auto found = all.find(name); found != all.end()) group.insert(*found);
        auto model = std::find_if(models.begin(), models.end(), [&](const CurveOfModel& each) {
            return each.parameters == group;
        });
        if (model == models.end()) model = models.insert(models.end(), {group, {}});
        model->points.push_back({*read_number(row.parameters.at("discs")), rate.mean,
                                 std::isfinite(rate.error) ? rate.error : 0.0});
    }
    return compare_points(std::move(models), varied, points);
}

std::string comparison_text(const Comparison& c) {
    const std::size_t count = c.points.size();
    if (count == 0) return "my points: none lies in the range of numbers of the model.\n";
    std::string text;
    for (std::size_t k = 0; k < c.curves.size(); ++k)
        text += report_line("my points",
                            fmt::format("χ² = {:.3g} of {} for {}", c.chi_squares[k],
                                        counted(std::int64_t(count), "point"),
                                        c.curves[k].name.empty() ? "the model" : c.curves[k].name));
    if (c.left_out > 0)
        text += report_line("left out", fmt::format("{} outside the numbers of the model",
                                                    counted(std::int64_t(c.left_out), "point")));
    if (!c.best) return text;
    const BestParameter& best = *c.best;
    const bool is_open = best.open_below || best.open_above;
    std::string words = fmt::format("{} = {}", c.parameter, with_error(best.value, best.error()));
    if (is_open)
        words = fmt::format("{} = {:.3g}, at the end of the range of the curves: try {} values",
                            c.parameter, best.value, best.open_above ? "larger" : "smaller");
    words += fmt::format("; χ² = {:.3g} with {} of freedom", best.chi_square,
                         counted(std::int64_t(best.freedom), "degree"));
    if (best.chi_square > 2.0 * double(best.freedom))
        words += fmt::format(", so the model does not fit within the errors{}",
                             is_open ? "" : "; the error of the parameter is scaled");
    return text + report_line("best fit", words);
}

std::string own_points_csv(const std::vector<RotationPoint>& points) {
    std::string text = "discs,rate,error\n";
    for (const RotationPoint& point : points)
        text += fmt::format("{},{},{}\n", point.discs, point.mean, point.error);
    return text;
}

}  // namespace swirl
