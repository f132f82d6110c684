#include "swirl/paper/curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "swirl/run/report.hpp"
#include "swirl/study/crossing.hpp"

namespace swirl {

RotationPoint rotation_point(double x, const Json& r, const char* average) {
    return {x, number(at(r, {"rotation", average, "mean"})),
            number(at(r, {"rotation", average, "error"}))};
}

const RotationPoint* lowest_of(std::span<const RotationPoint> curve) {
    const RotationPoint* lowest = nullptr;
    for (const RotationPoint& p : curve)
        if (std::isfinite(p.mean) && (!lowest || p.mean < lowest->mean)) lowest = &p;
    return lowest;
}

const RotationPoint* highest_of(std::span<const RotationPoint> curve) {
    const RotationPoint* highest = nullptr;
    for (const RotationPoint& p : curve)
        if (std::isfinite(p.mean) && (!highest || p.mean > highest->mean)) highest = &p;
    return highest;
}

std::int64_t count_counterrotating(std::span<const RotationPoint> points) {
    return std::count_if(points.begin(), points.end(),
                         [](const RotationPoint& p) { return p.mean < -3.0 * p.error; });
}

void NamedCurve::add(double discs, const Json& result) {
    for (std::size_t r = 0; r < curves.size(); ++r)
        curves[r].push_back(rotation_point(discs, result, rotation_rates[r].name));
}

// --- Curves of a figure ---------------------------------------------------------------------

FigureCurve curve_of(const Friction& friction) {
    return {friction.name,
            {std::string(friction.name), friction.mu_disc, friction.mu_wall},
            friction.words};
}

void CurveFigure::add_points(const std::vector<std::int64_t>& numbers) {
    for (std::size_t c = 0; c < curves.size(); ++c)
        for (const std::int64_t n : numbers) points.push_back({c, n});
}

std::vector<NamedCurve> CurveFigure::named_curves(const std::vector<Json>& results) const {
    std::vector<NamedCurve> named;
    for (const FigureCurve& curve : curves) named.push_back({curve.name, rate});
    for (std::size_t k = 0; k < points.size(); ++k)
        named[points[k].curve].add(static_cast<double>(points[k].discs), results[k]);
    return named;
}

void CurveFigure::write_points(const std::vector<Json>& results, const fs::path& out,
                               FigureOutcome& outcome) const {
    Table table(
        joined(joined(joined(columns, {"discs"}), number_columns(measured)), rotation_columns()));
    for (std::size_t k = 0; k < points.size(); ++k) {
        std::vector<Table::Cell> row = curves[points[k].curve].cells;
        row.emplace_back(points[k].discs);
        add_numbers(row, measured, results[k]);
        add_rotation(row, results[k]);
        table.add(std::move(row));
    }
    outcome.write(table, name, out);
}

void CurveFigure::write_crossings(const std::vector<Json>& results, const fs::path& out,
                                  FigureOutcome& outcome) const {
    outcome.files.push_back(out / ("figure_" + name + "_crossings.csv"));
    swirl::write_crossings(named_curves(results), outcome.files.back());
}

std::string CurveFigure::at_both_ends(std::size_t curve, const std::string& what,
                                      const std::string& quantity,
                                      const std::vector<Json>& results) const {
    const std::size_t dot = quantity.find('.');
    const std::string measurement = quantity.substr(0, dot), name = quantity.substr(dot + 1);
    std::vector<std::string> values;
    for (std::size_t k = 0; k < points.size(); ++k) {
        if (points[k].curve != curve) continue;
        const Json& found = at(results[k], {"measured", measurement, name});
        if (std::isnan(number(at(found, {"mean"})))) continue;
        values.push_back(fmt::format("{} at N = {}", mean_in_words(found), points[k].discs));
    }
    if (values.empty()) return fmt::format("{} ({}): n/a.", what, curves[curve].words);
    return fmt::format("{} ({}): {}, {}.", what, curves[curve].words, values.front(),
                       values.back());
}

// --- Crossings ------------------------------------------------------------------------------

static std::string crossing_of_rate(const NamedCurve& curve, const Crossing& crossing) {
    const char* const words = rotation_rates[curve.rate].description;
    if (const SignChange* const change = crossing.last()) {
        const std::string interval = change->resolved() ? fmt::format("95 %: {:.1f} to {:.1f}; ",
                                                                      change->lower, change->upper)
                                                        : "";
        const std::vector<double> beyond = crossing.undetermined_after();
        return fmt::format(
            "crosses zero {} ({}{}){}", change_location(*change), interval, words,
            beyond.empty() ? ""
                           : fmt::format("; its sign is undetermined at N = {}", listed(beyond)));
    }
    // The point that is nearest to the other direction.
    const bool counterrotates = crossing.verdict == Crossing::Verdict::always_counterrotates;
    const RotationPoint* const next =
        counterrotates ? highest_of(curve.points()) : lowest_of(curve.points());
    if (!next) return "has no points";
    const std::string undetermined =
        crossing.undetermined.empty()
            ? "no sign is certain"
            : fmt::format("its sign is undetermined at N = {}", listed(crossing.undetermined));
    return fmt::format("{}; {} is ϖ/Ω = {} at N = {:.0f} ({})",
                       crossing.verdict == Crossing::Verdict::undecided
                           ? "whether it crosses zero is undecided, " + undetermined
                           : verdict_word(crossing.verdict),
                       counterrotates ? "highest" : "lowest", with_error(next->mean, next->error),
                       next->discs, words);
}

std::string crossing_sentence(const NamedCurve& curve) {
    const Crossings crossings = find_crossings(curve.curves);
    return crossing_of_rate(curve, crossings[curve.rate]) + "." +
           other_rates_report(crossings, curve.rate);
}

std::vector<std::string> rates_columns() {
    std::vector<std::string> columns;
    for (const RotationRate& rate : rotation_rates)
        for (const char* part : {"", "_error", "_lower", "_upper"})
            columns.push_back(fmt::format("crossing_{}{}", rate.name, part));
    return columns;
}

void write_crossings(const std::vector<NamedCurve>& curves, const fs::path& file) {
    Table table(joined({"curve", "rate", "verdict", "crossing", "crossing_error", "lower", "upper",
                        "sign_changes", "undetermined", "lowest", "lowest_error", "lowest_discs"},
                       rates_columns()));
    for (const NamedCurve& curve : curves) {
        const Crossings all = find_crossings(curve.curves);
        const Crossing& c = all[curve.rate];
        const RotationPoint* const found = lowest_of(curve.points());
        const RotationPoint lowest =
            found ? *found : RotationPoint{not_available, not_available, not_available};
        std::vector<Table::Cell> row{curve.name,
                                     std::string(rotation_rates[curve.rate].name),
                                     std::string(verdict_word(c.verdict)),
                                     c.discs,
                                     c.error,
                                     c.lower,
                                     c.upper,
                                     std::int64_t(c.changes.size()),
                                     spaced(c.undetermined),
                                     lowest.mean,
                                     lowest.error,
                                     lowest.discs};
        for (const Crossing& by_rate : all)
            for (const double value : {by_rate.discs, by_rate.error, by_rate.lower, by_rate.upper})
                row.emplace_back(value);
        table.add(std::move(row));
    }
    table.write(file);
}

}  // namespace swirl
