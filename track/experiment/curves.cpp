#include "track/experiment/curves.hpp"

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

static const RotationPoint* extreme_of(std::span<const RotationPoint> curve, bool highest) {
    const RotationPoint* found = nullptr;
    for (const RotationPoint& p : curve)
        if (std::isfinite(p.mean) &&
            (!found || (highest ? p.mean > found->mean : p.mean < found->mean)))
            found = &p;
    return found;
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
    const RotationPoint* const next = extreme_of(curve.points(), counterrotates);
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

static std::vector<std::string> rates_columns() {
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
        const RotationPoint* const found = extreme_of(curve.points(), false);
        const RotationPoint lowest =
            found ? *found : RotationPoint{not_available, not_available, not_available};
        std::vector<Table::Cell> row{curve.name, std::string(rotation_rates[curve.rate].name),
                                     std::string(verdict_word(c.verdict))};
        for (const double value : {c.discs, c.error, c.lower, c.upper}) row.emplace_back(value);
        row.emplace_back(std::int64_t(c.changes.size()));
        row.emplace_back(spaced(c.undetermined));
        for (const double value : {lowest.mean, lowest.error, lowest.discs})
            row.emplace_back(value);
        for (const Crossing& by_rate : all)
            for (const double value : {by_rate.discs, by_rate.error, by_rate.lower, by_rate.upper})
                row.emplace_back(value);
        table.add(std::move(row));
    }
    table.write(file);
}

}  // namespace swirl
