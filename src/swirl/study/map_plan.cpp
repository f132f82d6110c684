#include "swirl/study/map_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "swirl/measure/cluster_rotation.hpp"
#include "swirl/measure/observation.hpp"
#include "swirl/physics/container_path.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/reading.hpp"
#include "swirl/study/crossing_search.hpp"

namespace swirl {
namespace {

constexpr std::int64_t max_steps = 1000, max_runs_at_a_point = 10'000;

/// True if the parameter takes whole numbers only.
bool is_whole(const std::string& name) {
    const Parameter* const p = find_parameter(name);
    return p != nullptr &&
           (std::holds_alternative<std::int64_t RunConfig::*>(p->member) ||
            std::holds_alternative<int RunConfig::*>(p->member) ||
            std::holds_alternative<std::optional<std::int64_t> RunConfig::*>(p->member));
}

/// The values of FROM:TO, equally spaced; whole numbers are rounded and repeated ones omitted.
std::vector<std::string> equal_steps(const MapAxisText& axis, double from, double to,
                                     std::int64_t steps) {
    if (!(from < to))
        throw UsageError(fmt::format("{} is '{}', but FROM must be below TO.",
                                     option_name(axis.name), axis.values));
    std::vector<std::string> values;
    for (std::int64_t k = 0; k < steps; ++k) {
        double value = from + (to - from) * static_cast<double>(k) / double(steps - 1);
        if (is_whole(axis.name)) value = std::round(value);
        std::string text = fmt::format("{:.12g}", value);
        if (values.empty() || values.back() != text) values.push_back(std::move(text));
    }
    return values;
}

std::vector<std::string> values_of(const MapAxisText& axis, std::int64_t steps) {
    const std::size_t colon = axis.values.find(':');
    if (colon != std::string::npos &&
        axis.values.find_first_of(":,", colon + 1) == std::string::npos) {
        const auto from = read_number(std::string_view(axis.values).substr(0, colon));
        const auto to = read_number(std::string_view(axis.values).substr(colon + 1));
        if (from && to) return equal_steps(axis, *from, *to, steps);
    }
    const std::vector<std::string> values = list_of_values(axis.name, axis.values);
    double last = -INFINITY;
    for (const std::string& value : values) {
        const auto number = read_number(value);
        if (!number || !(*number > last))
            throw UsageError(
                fmt::format("{} is '{}', but the axis of a map needs ascending numbers.",
                            option_name(axis.name), axis.values));
        last = *number;
    }
    return values;
}

std::string comma_list(const std::vector<std::string>& values) {
    return fmt::format("{}", fmt::join(values, ","));
}

bool is_rotation_rate(const std::string& name) {
    return std::any_of(rotation_rates.begin(), rotation_rates.end(),
                       [&](const RotationRate& rate) { return rate.name == name; });
}

/// The measurement that reports the row MEASUREMENT.ROW. Throws UsageError if there is none.
std::string measurement_of(const std::string& quantity) {
    const std::string name = quantity.substr(0, quantity.find('.'));
    std::string rows;
    if (find_measurement(name)) {
        const Observation observation(paper_container_radius, paper_period, {name});
        const std::vector<MeasurementReport> reports = observation.report();
        for (const ReportRow& row : reports.front().report.rows) {
            if (quantity == name + "." + row.name) return name;
            rows += fmt::format("{}{}.{}", rows.empty() ? "" : ", ", name, row.name);
        }
    }
    throw UsageError(fmt::format(
        "--of is '{}', but it must be N_c, a rotation rate (by_time, by_event, rigid_by_time, "
        "rigid_by_event), or a number of a measurement, such as slip.cluster.\nhint: {}",
        quantity,
        rows.empty() ? "`swirl run --measure help` lists the measurements."
                     : name + " has " + rows + "."));
}

void validate_whole_number(const char* option, std::int64_t value, std::int64_t least,
                           std::int64_t most) {
    if (value < least || value > most)
        throw UsageError(fmt::format("{} is {}, but it must be a whole number from {} to {}.",
                                     option, value, least, most));
}

void validate_steps(std::int64_t steps) { validate_whole_number("--steps", steps, 2, max_steps); }

void validate_runs(std::int64_t runs) {
    validate_whole_number("--seeds", runs, 1, max_runs_at_a_point);
}

void validate_settings(const MapSettings& s) {
    const auto reject = [](const char* name, auto value, const std::string& must) {
        throw UsageError(fmt::format("{} is {}, but it must be {}.", name, value, must));
    };
    if (s.x.name.empty()) throw UsageError("missing required option --x NAME=VALUES.");
    if (s.x.name == s.y.name) throw UsageError(fmt::format("--x and --y are both {}.", s.x.name));
    validate_steps(s.steps);
    validate_runs(s.max_runs);
    if (!std::isfinite(s.level)) reject("--level", s.level, "a finite number");
    if (s.change && !(*s.change >= 0.0)) reject("--change", *s.change, "0 or above");
    if (!(s.tolerance > 0.0)) reject("--tolerance", s.tolerance, "above 0");
    for (const std::string& axis : {s.x.name, s.y.name}) {
        if (axis == "seed")
            throw UsageError("the seed cannot be an axis of a map: each run has its own seed.");
        if (s.parameters.contains(axis))
            throw UsageError(fmt::format(
                "{} is an axis of the map, so it cannot have another value.", option_name(axis)));
        if (s.of == "N_c" && axis == "discs")
            throw UsageError("the number of discs cannot be an axis of a map of N_c.");
    }
    if (s.of != "N_c") return;
    if (s.parameters.contains("discs"))
        throw UsageError(
            "--discs is given, but the search for N_c varies it.\nhint: use --from and --to.");
    if (s.level != 0.0) throw UsageError("--level cannot be used with --of N_c.");
    validate_range({.config = {}, .from = s.from, .to = s.to});
}

/// The values that an axis of the map does not have yet.
SweepAxis added_values(const SweepPlan& plan, const MapAxisText& given, std::int64_t steps) {
    constexpr double same = 1e-9;  // relative to the range: a rounding error of its steps
    if (given.name != plan.map->x && given.name != plan.map->y)
        throw UsageError(
            fmt::format("{} is not an axis of this map, which has {}{}.\nhint: use another folder.",
                        given.name, plan.map->x, plan.map->y.empty() ? "" : " and " + plan.map->y));
    std::vector<double> known;
    for (const std::string& value : plan.axis(given.name)->values)
        known.push_back(read_number(value).value_or(not_available));
    const auto [least, most] = std::minmax_element(known.begin(), known.end());
    const double range = *most - *least;
    SweepAxis added{given.name, {}};
    for (const std::string& value : values_of(given, steps))
        if (std::none_of(known.begin(), known.end(), [&](double k) {
                return std::abs(k - *read_number(value)) <= same * range;
            }))
            added.values.push_back(value);
    return added;
}

/// The numbers of discs in the larger range. The searches assume that a range has no gaps.
SweepAxis added_numbers(const SweepPlan& plan, const MapGrowth& growth) {
    if (!plan.map->is_of_crossing())
        throw UsageError(
            fmt::format("{} is given, but this map is of {}.\nhint: --from and --to belong to maps "
                        "of N_c.",
                        growth.from ? "--from" : "--to", plan.map->of));
    const SweepAxis& known = *plan.axis("discs");
    const std::vector<std::size_t> order = ascending_order(known);
    const auto number_at = [&](std::size_t index) {
        return read_whole_number(known.values[index]).value_or(0);
    };
    const std::int64_t least = number_at(order.front()), most = number_at(order.back()),
                       from = growth.from.value_or(least), to = growth.to.value_or(most);
    if (from > least || to < most)
        throw UsageError(fmt::format(
            "the range is --from {} --to {}, but the searches of this map cover {} to "
            "{} discs, and the range can only grow.\nhint: use another folder for a smaller range.",
            from, to, least, most));
    validate_range({.config = {}, .from = from, .to = to});
    SweepAxis added{"discs", {}};
    for (std::int64_t n = from; n <= to; ++n)
        if (n < least || n > most) added.values.push_back(std::to_string(n));
    return added;
}

}  // namespace

MapAxisText read_map_axis(const char* option, const std::string& text) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
        throw UsageError(fmt::format("{} is '{}', but it must be NAME=VALUES, for example mu=0:1.",
                                     option, text));
    std::string name = text.substr(0, equals);  // as given, for error messages
    std::replace(name.begin(), name.end(), '-', '_');
    return {name, text.substr(equals + 1)};
}

SweepPlan grown_map(const SweepPlan& plan, const MapGrowth& growth) {
    if (!plan.map)
        throw UsageError("the folder holds a sweep, not a map.\nhint: use swirl sweep --grow.");
    validate_steps(growth.steps);
    if (growth.max_runs) validate_runs(*growth.max_runs);
    std::vector<SweepAxis> more;
    for (const MapAxisText& given : growth.axes)
        if (!given.name.empty()) more.push_back(added_values(plan, given, growth.steps));
    if (growth.from || growth.to) more.push_back(added_numbers(plan, growth));
    return with_values(plan, more, growth.max_runs.value_or(plan.replicas), {});
}

SweepPlan make_map_plan(const MapSettings& s) {
    validate_settings(s);
    MapTarget target{.x = s.x.name, .y = s.y.name, .of = s.of, .rate = s.rate, .level = s.level};
    target.tolerance = s.tolerance;
    rate_named(s.rate);  // throws for an unknown name
    target.change = s.change.value_or(target.is_of_crossing() ? 2.0 : 0.0);

    ParameterTexts given = overridden({{"periods", default_map_periods}}, s.parameters);
    for (const MapAxisText& axis : {s.x, s.y})
        if (!axis.name.empty()) {
            if (!find_parameter(axis.name)) resolve({{axis.name, axis.values}});  // throws
            given[axis.name] = comma_list(values_of(axis, s.steps));
        }
    if (given.contains("events")) given.erase("periods");
    if (target.is_of_crossing()) given["discs"] = fmt::format("{}:{}", s.from, s.to);
    SweepPlan plan = make_plan(given, s.max_runs);
    for (const SweepAxis& axis : plan.axes)
        if (axis.values.size() > 1 && axis.name != s.x.name && axis.name != s.y.name &&
            !(target.is_of_crossing() && axis.name == "discs"))
            throw UsageError(
                fmt::format("{} is a list, but only the axes of a map may have several "
                            "values.",
                            option_name(axis.name)));
    if (!target.is_of_crossing() && !is_rotation_rate(target.of))
        plan.measure = {measurement_of(target.of)};
    if (target.is_of_crossing()) require_crossing(plan.config(0));
    plan.map = target;
    return plan;
}

}  // namespace swirl
