#include "swirl/study/map_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "swirl/measure/cluster_rotation.hpp"
#include "swirl/measure/observation.hpp"
#include "swirl/physics/container_path.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/reading.hpp"
#include "swirl/study/crossing.hpp"

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
                fmt::format("{} is '{}', but the axis of a map needs ascending numbers without "
                            "units.\nhint: `swirl crossing` and `swirl sweep` take lists of any "
                            "values.",
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
        const Observation observation({paper_container_radius, paper_period}, {name});
        const std::vector<MeasurementReport> reports = observation.report();
        for (const ReportRow& row : reports.front().report.rows) {
            if (quantity == name + "." + row.name) return name;
            rows += fmt::format("{}{}.{}", rows.empty() ? "" : ", ", name, row.name);
        }
    }
    throw UsageError(fmt::format(
        "--quantity is '{}', but it must be N_c, a rotation rate (mean_by_time, mean_by_event, "
        "rigid_by_time, "
        "rigid_by_event), or a number of a measurement, such as slip.cluster.\nhint: {}",
        quantity,
        rows.empty() ? "`swirl run --measure help` lists the measurements."
                     : name + " has " + rows + "."));
}

void validate_steps(std::int64_t steps) { validate_whole_number("--steps", steps, 2, max_steps); }

void validate_runs(std::int64_t runs) {
    validate_whole_number("--replicates", runs, 1, max_runs_at_a_point);
}

/// Checks that need only the target and the maximum of runs at a point.
void validate_target(const MapTarget& m, std::int64_t max_runs) {
    const auto reject = [](const char* name, auto value, const std::string& must) {
        throw UsageError(fmt::format("{} is {}, but it must be {}.", name, value, must));
    };
    if (m.x.empty()) throw UsageError("missing required option --x NAME=VALUES.");
    if (m.x == m.y) throw UsageError(fmt::format("--x and --y are both {}.", m.x));
    validate_runs(max_runs);
    if (!std::isfinite(m.level)) reject("--level", m.level, "a finite number");
    if (!(m.change >= 0.0)) reject("--change", m.change, "0 or above");
    if (!(m.tolerance > 0.0)) reject("--tolerance", m.tolerance, "above 0");
    rate_named(m.rate);  // throws for an unknown name
    for (const std::string& axis : {m.x, m.y}) {
        if (axis == "seed")
            throw UsageError("the seed cannot be an axis of a map: each run has its own seed.");
        if (m.is_of_crossing() && axis == "discs")
            throw UsageError("the number of discs cannot be an axis of a map of N_c.");
    }
    if (m.is_of_crossing() && m.level != 0.0)
        throw UsageError("--level cannot be used with --quantity N_c.");
}

MapTarget target_of(const MapSettings& s) {
    MapTarget target{.x = s.x.name, .y = s.y.name, .of = s.of, .rate = s.rate, .level = s.level};
    target.tolerance = s.tolerance;
    target.change = s.change.value_or(target.is_of_crossing() ? 2.0 : 0.0);
    return target;
}

void validate_settings(const MapSettings& s) {
    validate_target(target_of(s), s.max_runs);
    validate_steps(s.steps);
    for (const std::string& axis : {s.x.name, s.y.name})
        if (s.parameters.contains(axis))
            throw UsageError(fmt::format(
                "{} is an axis of the map, so it cannot have another value.", option_name(axis)));
    if (s.of != "N_c") return;
    if (s.parameters.contains("discs"))
        throw UsageError(
            "--discs is given, but the search for N_c varies it.\nhint: use --from and --to.");
    validate_range(s.from, s.to);
}

/// The axes x and y have numbers. Every other parameter has one value, and the numbers of discs of
/// a map of N_c have no gap.
void validate_axes(const SweepPlan& plan) {
    const MapTarget& m = *plan.map;
    for (const std::string& name : {m.x, m.y}) {
        if (name.empty()) continue;
        const SweepAxis* const axis = plan.axis(name);
        if (!axis) throw UsageError(fmt::format("{} is not a parameter of this map.", name));
        for (const std::string& value : axis->values)
            if (!read_number(value))
                throw UsageError(fmt::format("{} is '{}', but the axis of a map needs numbers.",
                                             option_name(name), value));
    }
    for (const SweepAxis& axis : plan.axes) {
        if (axis.name == m.x || axis.name == m.y || axis.values.size() == 1) continue;
        if (!m.is_of_crossing() || axis.name != "discs")
            throw UsageError(
                fmt::format("{} is a list, but only the axes of a map may have several "
                            "values.",
                            option_name(axis.name)));
    }
    if (!m.is_of_crossing()) return;
    const SweepAxis* const discs = plan.axis("discs");
    if (!discs) throw UsageError("a map of N_c needs numbers of discs.");
    std::vector<std::int64_t> numbers;
    for (const std::string& value : discs->values)
        numbers.push_back(read_whole_number(value).value_or(0));
    std::sort(numbers.begin(), numbers.end());
    validate_range(numbers.front(), numbers.back());
    for (std::size_t k = 0; k + 1 < numbers.size(); ++k)
        if (numbers[k + 1] != numbers[k] + 1)
            throw UsageError(fmt::format("the numbers of discs jump from {} to {}.", numbers[k],
                                         numbers[k + 1]));
}

/// The measurements that the runs of a map need.
std::vector<std::string> measurements_for(const MapTarget& target) {
    if (target.is_of_crossing() || is_rotation_rate(target.of)) return {};
    return {measurement_of(target.of)};
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
    validate_range(from, to);
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
    std::string name = text.substr(0, equals);  // error messages use it as given
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
    const MapTarget target = target_of(s);
    ParameterTexts given = overridden({{"periods", default_map_periods}}, s.parameters);
    for (const MapAxisText& axis : {s.x, s.y})
        if (!axis.name.empty()) {
            if (!find_parameter(axis.name)) resolve({{axis.name, axis.values}});  // throws
            given[axis.name] = comma_list(values_of(axis, s.steps));
        }
    if (given.contains("events")) given.erase("periods");
    if (target.is_of_crossing()) {
        reject_listed_particles(given);
        given["discs"] = fmt::format("{}:{}", s.from, s.to);
    }
    SweepPlan plan = plan_of_lists(given, s.max_runs);
    plan.measure = measurements_for(target);
    plan.map = target;
    validate(plan);
    validate_map(plan);
    return plan;
}

void validate_map(const SweepPlan& plan) {
    validate_target(*plan.map, plan.replicas);
    validate_axes(plan);
    if (plan.measure != measurements_for(*plan.map) || plan.frames > 0 || plan.series ||
        !plan.chain.empty() || plan.generation != 1)
        throw UsageError("a map measures only its quantity and has no recordings or chains.");
    if (plan.map->is_of_crossing()) require_crossing(plan.config(0));
}

}  // namespace swirl
