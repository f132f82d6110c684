#include "swirl/run/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "swirl/physics/container_path.hpp"
#include "swirl/run/config.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/parameter_readers.hpp"
#include "swirl/run/reading.hpp"

namespace swirl {
namespace {

struct InputUnit {
    const char* name;
    double factor;  // converts to µm and s
    Dimension dimension;
};
constexpr Dimension length{1, 0}, duration{0, 1}, rate{0, -1}, speed{1, -1}, acceleration{1, -2};
constexpr double mm = 1e3, cm = 1e4, m = micrometres_per_metre, inch = 25400.0;
constexpr auto units = std::to_array<InputUnit>({
    {"um", 1.0, length},
    {"µm", 1.0, length},
    {"mm", mm, length},
    {"cm", cm, length},
    {"m", m, length},
    {"in", inch, length},
    {"us", 1e-6, duration},
    {"µs", 1e-6, duration},
    {"ms", 1e-3, duration},
    {"s", 1.0, duration},
    {"min", 60.0, duration},
    {"rpm", 1.0 / 60.0, rate},
    {"Hz", 1.0, rate},
    {"mm/s", mm, speed},
    {"cm/s", cm, speed},
    {"m/s", m, speed},
    {"mm/s2", mm, acceleration},
    {"cm/s2", cm, acceleration},
    {"m/s2", m, acceleration},
    {"mm/s²", mm, acceleration},
    {"cm/s²", cm, acceleration},
    {"m/s²", m, acceleration},
    {"mm/s^2", mm, acceleration},
    {"cm/s^2", cm, acceleration},
    {"m/s^2", m, acceleration},
});

/// The unit at the end of a text, and the number before it.
struct Parts {
    double number;
    const InputUnit* unit;
};
std::optional<Parts> parts_of(std::string_view text) {
    for (const InputUnit& unit : units) {
        const std::string_view name = unit.name;
        if (!text.ends_with(name)) continue;
        std::string_view before = trimmed(text.substr(0, text.size() - name.size()));
        if (const auto number = read_number(before)) return Parts{*number, &unit};
    }
    return {};
}

Dimension dimension_of(const Parameter& parameter) {
    const std::string_view unit = parameter.unit;
    if (unit == "length") return length;
    if (unit == "time") return duration;
    if (unit == "length / time") return speed;
    if (unit == "length / time²") return acceleration;
    return {};
}

bool is_zero(std::string_view text) {
    const auto number = read_number(text);
    return number && *number == 0.0;
}

[[noreturn]] void reject_unit(const Parameter& p, std::string_view text) {
    const char* const example = example_with_unit(p);
    throw_usage_error(fmt::format(
        "{} is '{}', but it must be {}.", option_name(p.name), text,
        *example ? fmt::format("a value such as {}", example) : "a number without a unit"));
}

/// The texts of lengths within a text with colons: COUNT:RADIUS of a mixture, or the law of sizes.
std::vector<std::string> lengths_in(const std::string& text) {
    std::vector<std::string> found;
    for (const std::string_view part : split(text, ":"))
        if (const auto parts = parts_of(part); parts && parts->unit->dimension == length)
            found.emplace_back(part);
    return found;
}

bool is_compound(std::string_view name) { return name == "mixture" || name == "sizes"; }

bool has_unit(const std::string& name, const std::string& text) {
    return is_compound(name) ? !lengths_in(text).empty() : parts_of(text).has_value();
}

/// Converts texts with units to multiples of r and r/v.
class Conversion {
  public:
    explicit Conversion(ParameterTexts texts) : texts_(std::move(texts)) {}

    ParameterTexts converted() {
        reject_wrong_units();
        if (texts_.contains("length_unit") || texts_.contains("time_unit")) {
            use_stored_units();
        } else {
            add_sizes_of_preset();
            reject_numbers_alone();
            find_units();
        }
        for (auto& [name, text] : texts_)
            if (has_unit(name, text) && name != "length_unit" && name != "time_unit")
                text = is_compound(name) ? compound(text) : value(name, text);
        return std::move(texts_);
    }

  private:
    double in_base_units(const char* name) const {
        const std::string& text = texts_.at(name);
        if (is_zero(text)) return 0.0;
        return std::string_view(name) == "period" ? period_in_seconds(name, text)
                                                  : read_with_unit(text)->value;
    }

    void reject_wrong_units() const {
        for (const auto& [name, text] : texts_) {
            const auto parts = parts_of(text);
            if (!parts || is_compound(name) || name == "length_unit" || name == "time_unit")
                continue;
            const Parameter& p = *find_parameter(name);
            const Dimension wanted = dimension_of(p);
            const bool is_rate = name == "period" && parts->unit->dimension == rate;
            if (wanted == Dimension{} || !(parts->unit->dimension == wanted || is_rate))
                reject_unit(p, text);
        }
    }

    /// A stored configuration with some values of the command line.
    void use_stored_units() {
        for (const char* name : {"length_unit", "time_unit"})
            if (!texts_.contains(name))
                throw_usage_error(
                    "--length-unit and --time-unit belong together.\nhint: give both, or neither.");
        radius_ = read_with_unit(texts_.at("length_unit")).value_or(UnitValue{1.0, {}}).value;
        tau_ = read_with_unit(texts_.at("time_unit")).value_or(UnitValue{1.0, {}}).value;
    }

    void add_sizes_of_preset() {
        const auto preset = texts_.find("preset");
        if (preset == texts_.end()) return;
        for (const ExperimentPreset& each : experiment_presets) {
            if (preset->second != each.name) continue;
            texts_.try_emplace("radius", fmt::format("{}mm", sphere_radius_mm));
            texts_.try_emplace("container_radius", fmt::format("{}mm", container_radius_mm));
            texts_.try_emplace("amplitude", fmt::format("{}mm", each.amplitude));
            if (!texts_.contains("speed"))
                texts_.try_emplace("period", fmt::format("{}s", 2.0 * pi / experiment_omega));
        }
    }

    /// Each value with a dimension needs a unit; 0 does not.
    void reject_numbers_alone() const {
        for (const char* name : {"radius", "container_radius"})
            if (!texts_.contains(name)) reject_missing(name);
        int given = 0;
        for (const char* name : {"amplitude", "period", "speed"}) given += texts_.contains(name);
        if (given < 2) reject_missing(texts_.contains("amplitude") ? "period" : "amplitude");
        for (const auto& [name, text] : texts_) {
            const Parameter& p = *find_parameter(name);
            const bool is_number = dimension_of(p) != Dimension{} || name == "mixture" ||
                                   name == "sizes" || (name == "inertia" && read_number(text));
            if (is_number && !has_unit(name, text) && !is_zero(text)) reject_alone(p, text);
            if (name == "initial") reject_alone(p, "a table of numbers");
            if (name == "ramp" &&
                (text.find("amplitude") != text.npos || text.find("period") != text.npos))
                reject_alone(p, text);
        }
    }

    [[noreturn]] static void reject_missing(const char* name) {
        throw_usage_error(fmt::format(
            "some values have units, but {} has no value.\nhint: add {} {}, or use "
            "values without units, in multiples of the radius.",
            option_name(name), option_name(name), example_with_unit(*find_parameter(name))));
    }

    [[noreturn]] static void reject_alone(const Parameter& p, std::string_view text) {
        const std::string_view example = example_with_unit(p);
        throw_usage_error(fmt::format(
            "{} is {}, but other values have units.\nhint: {}, or see `swirl dish --help` for "
            "values without units.",
            option_name(p.name), text,
            example.empty() ? "omit it" : fmt::format("give it a unit, such as {}", example)));
    }

    /// What r and r/v are.
    void find_units() {
        radius_ = in_base_units("radius");
        if (!(radius_ > 0.0)) reject_unit(*find_parameter("radius"), texts_.at("radius"));
        const double amplitude = texts_.contains("amplitude") ? in_base_units("amplitude") : 0.0;
        const double v = texts_.contains("speed") ? in_base_units("speed") : 0.0;
        period_ = amplitude > 0.0 ? 2.0 * pi * (amplitude / radius_) : paper_period;
        tau_ = v > 0.0 ? radius_ / v : in_base_units("period") / period_;
        if (!(tau_ > 0.0)) reject_unit(*find_parameter("period"), texts_.at("period"));
        texts_["length_unit"] = texts_.at("radius");
        texts_["time_unit"] = fmt::format("{}s", tau_);
        if (has_floor()) texts_.try_emplace("gravity", "9.81m/s2");
    }

    bool has_floor() const {
        if (const auto floor = texts_.find("floor"); floor != texts_.end())
            return floor->second != "none";
        const auto body = texts_.find("body");
        return texts_.contains("preset") || (body != texts_.end() && body->second == "sphere");
    }

    std::string value(const std::string& name, const std::string& text) const {
        if (name == "period") return period_text(text);
        const UnitValue given = *read_with_unit(text);
        double number = given.value;
        if (given.dimension.length == 1) number /= radius_;
        if (given.dimension.time == 1) number /= tau_;
        if (given.dimension.time < 0) number *= tau_;
        if (given.dimension.time == -2) number *= tau_;
        return fmt::format("{}", number);
    }

    /// 2π A/r exactly, unless the speed is given, too.
    std::string period_text(const std::string& text) const {
        const bool defines_time = period_ > 0.0 && !texts_.contains("speed");
        return fmt::format("{}", defines_time ? period_ : period_in_seconds("period", text) / tau_);
    }

    std::string compound(const std::string& text) const {
        std::string result;
        for (const std::string_view part : split(text, ":")) {
            const auto parts = parts_of(part);
            const bool is_length = parts && parts->unit->dimension == length;
            result += result.empty() ? "" : ":";
            result += is_length ? fmt::format("{}", parts->number * parts->unit->factor / radius_)
                                : std::string(part);
        }
        return result;
    }

    ParameterTexts texts_;
    double radius_ = 0.0, tau_ = 0.0;  // µm, s
    double period_ = 0.0;              // unit: r/v; 0 if the units are stored ones
};

std::string short_value(double value) { return fmt::format("{:.4g}", value); }

}  // namespace

std::optional<UnitValue> read_with_unit(std::string_view text) {
    const auto parts = parts_of(text);
    if (!parts) return {};
    const InputUnit& unit = *parts->unit;
    // Division by 1000 is exact where a factor of 0.001 is not.
    const double value = unit.factor < 1.0 && unit.dimension == duration
                             ? parts->number / std::round(1.0 / unit.factor)
                             : parts->number * unit.factor;
    return UnitValue{value, unit.dimension};
}

const char* example_with_unit(const Parameter& p) {
    const std::string_view name = p.name;
    if (name == "mixture") return "12:4mm";
    if (name == "sizes") return "uniform:2mm:4mm";
    if (name == "period") return "0.77s or 78rpm";
    const Dimension dimension = dimension_of(p);
    if (dimension == length) return "3mm";
    if (dimension == duration) return "0.02ms";
    if (dimension == speed) return "136mm/s";
    if (dimension == acceleration) return "9.81m/s2";
    return "";
}

double period_in_seconds(std::string_view name, std::string_view text) {
    const auto parts = parts_of(text);
    if (parts && parts->number > 0.0 && parts->unit->dimension == duration)
        return read_with_unit(text)->value;
    if (parts && parts->number > 0.0 && parts->unit->dimension == rate)
        return std::string_view(parts->unit->name) == "rpm" ? 60.0 / parts->number
                                                            : 1.0 / parts->number;
    throw_usage_error(
        fmt::format("{} is '{}', but it must be a value above 0, such as 0.77s or "
                    "78rpm.",
                    option_name(name), text));
}

ParameterTexts without_units(ParameterTexts texts) {
    for (const auto& [name, text] : texts)
        if (name != "length_unit" && name != "time_unit" && has_unit(name, text))
            return Conversion(std::move(texts)).converted();
    return texts;
}

namespace {

/// The text of --length-unit or --time-unit, which are given together.
std::string checked_unit(std::string_view name, std::string_view text, const Dimension& dimension,
                         const char* example, bool has_other) {
    const auto parts = parts_of(text);
    if (!parts || parts->unit->dimension != dimension || !(parts->number > 0.0))
        throw_usage_error(
            fmt::format("{} is '{}', but it must be {}.", option_name(name), text, example));
    if (!has_other)
        throw_usage_error(
            "--length-unit and --time-unit belong together.\nhint: give both, or neither.");
    return std::string(text);
}

}  // namespace

void read_length_unit(std::string_view text, const ParameterTexts& given, RunConfig& config) {
    config.length_unit = checked_unit("length_unit", text, length, "a length, such as 3mm",
                                      given.contains("time_unit"));
}
void read_time_unit(std::string_view text, const ParameterTexts& given, RunConfig& config) {
    config.time_unit = checked_unit("time_unit", text, duration, "a time, such as 22ms",
                                    given.contains("length_unit"));
}
ParameterValue write_length_unit(const RunConfig& config) {
    return config.length_unit.empty() ? ParameterValue() : ParameterValue(config.length_unit);
}
ParameterValue write_time_unit(const RunConfig& config) {
    return config.time_unit.empty() ? ParameterValue() : ParameterValue(config.time_unit);
}

std::optional<UserUnits> user_units(const RunConfig& config) {
    const auto radius = parts_of(config.length_unit);
    const auto time = read_with_unit(config.time_unit);
    if (!radius || !time) return {};
    return UserUnits{radius->number, radius->unit->name, time->value};
}

namespace {

/// Appends "mm²" for a positive power.
void append_power(std::string& text, std::string_view unit, int power) {
    static constexpr const char* exponents[] = {"", "", "²", "³"};
    if (power <= 0) return;
    if (!text.empty() && !text.ends_with('/')) text += ' ';
    text += unit;
    text += power < 4 ? exponents[power] : fmt::format("^{}", power);
}

}  // namespace

std::optional<PrintedUnit> in_user_units(const Unit& unit, const RunConfig& config,
                                         const UserUnits& user) {
    const int length = unit.length(), time = unit.time();
    if (length == 0 && time == 0) return {};
    const MeasuredUnits measured = units_of(config);
    const MeasuredUnits in_user{measured.r * user.length, measured.v * user.length / user.time,
                                1.0};
    const double rate = config.omega() / user.time, period = config.period * user.time;
    PrintedUnit found{.factor = in_user.of(unit) * integer_power(rate, std::max(unit.omega, 0)) *
                                integer_power(period, std::max(-unit.omega, 0)),
                      .text = {}};
    // Not "m", which would be metres.
    append_power(found.text, "particle mass", unit.m);
    append_power(found.text, "rad", unit.omega);
    append_power(found.text, user.length_unit, length);
    append_power(found.text, "s", time);
    if (length >= 0 && time >= 0) return found;
    if (found.text.empty()) found.text = "1";
    std::string below;
    append_power(below, user.length_unit, -length);
    append_power(below, "s", -time);
    found.text += "/" + below;
    return found;
}

std::string dish_in_units(const RunConfig& config, const UserUnits& units) {
    const auto in_units = [&](double number) {
        return fmt::format("{} {}", short_value(number * units.length), units.length_unit);
    };
    const double v = config.amplitude * config.omega();
    return fmt::format("r = {}, R = {}, A = {}, {} rpm, v = {} {}/s", in_units(config.radius),
                       in_units(config.container_radius), in_units(config.amplitude),
                       short_value(60.0 / (config.period * units.time)),
                       short_value(v * units.length / units.time), units.length_unit);
}

}  // namespace swirl
