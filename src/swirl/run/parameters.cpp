#include "swirl/run/parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>

#include "swirl/run/config.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/initial_parameter.hpp"
#include "swirl/run/parameter_readers.hpp"
#include "swirl/run/particle_sizes.hpp"
#include "swirl/run/path_parameter.hpp"
#include "swirl/run/ramp.hpp"
#include "swirl/run/units.hpp"

namespace swirl {
namespace {

template <class... Cases>
struct Overloaded : Cases... {
    using Cases::operator()...;
};

/// A sentence about the text of an option.
Message about(Code code, std::string_view name, std::string_view text) {
    return {code, {{"name", option_name(name)}, {"text", text}}};
}

/// Adds why a text is no number, if it has a unit or a decimal comma, or is a list or a range.
void add_hint_on_number(Message& message, std::string_view text) {
    if (!text.empty() && std::isdigit(static_cast<unsigned char>(text.front())) &&
        std::isalpha(static_cast<unsigned char>(text.back()))) {
        message += Message("units");
        return;
    }
    const auto parts = split(text, ",:");
    const bool has_numbers =
        parts.size() > 1 && std::all_of(parts.begin(), parts.end(), read_number);
    if (!has_numbers) return;
    const bool is_decimal = text.find(':') == text.npos && parts.size() == 2 &&
                            text.find('.') == text.npos && parts[0].size() < 4;
    if (is_decimal)
        message += Message("decimal_point", {{"whole", parts[0]}, {"decimals", parts[1]}});
    else
        message += Message("one_number");
}

[[noreturn]] void reject_number(Code code, std::string_view name, std::string_view text) {
    Message message = about(code, name, text);
    add_hint_on_number(message, text);
    throw_usage_error(message);
}

double number_from(std::string_view name, std::string_view text) {
    const auto value = read_number(text);
    if (!value) reject_number("not_a_number", name, text);
    return *value;
}

std::int64_t whole_number_from(std::string_view name, std::string_view text) {
    const auto value = read_whole_number(text);
    if (!value) reject_number("not_whole", name, text);
    return *value;
}

std::uint64_t seed_from(std::string_view name, std::string_view text) {
    std::uint64_t seed = 0;
    const char* const last = text.data() + text.size();
    const auto [end, error] = std::from_chars(text.data(), last, seed);
    if (error != std::errc() || end != last) throw_usage_error(about("not_a_seed", name, text));
    return seed;
}

/// A value outside the range of every parameter of type int stays outside.
int clamped(std::int64_t value) {
    return static_cast<int>(std::clamp<std::int64_t>(value, -1, 1'000'000'000));
}

void read_member(const Parameter& p, std::string_view text, RunConfig& config) {
    std::visit(
        Overloaded{[](std::monostate) {},
                   [&](double RunConfig::*m) { config.*m = number_from(p.name, text); },
                   [&](std::int64_t RunConfig::*m) { config.*m = whole_number_from(p.name, text); },
                   [&](int RunConfig::*m) { config.*m = clamped(whole_number_from(p.name, text)); },
                   [&](std::uint64_t RunConfig::*m) { config.*m = seed_from(p.name, text); },
                   [&](std::optional<std::int64_t> RunConfig::*m) {
                       config.*m = whole_number_from(p.name, text);
                   }},
        p.member);
}

ParameterValue member_value(const Parameter& p, const RunConfig& config) {
    return std::visit(
        Overloaded{[](std::monostate) -> ParameterValue { return {}; },
                   [&](int RunConfig::*m) -> ParameterValue { return std::int64_t{config.*m}; },
                   [&](std::optional<std::int64_t> RunConfig::*m) -> ParameterValue {
                       return config.*m ? ParameterValue(*(config.*m)) : ParameterValue();
                   },
                   [&](auto RunConfig::*m) -> ParameterValue { return config.*m; }},
        p.member);
}

void read_parameter(const Parameter& p, std::string_view text, const ParameterTexts& given,
                    RunConfig& config) {
    if (p.read)
        p.read(text, given, config);
    else
        read_member(p, text, config);
}

std::string count_text(const Mixture& m) {
    return m.percent ? fmt::format("{}%", *m.percent) : std::to_string(m.count);
}

std::string as_text(const ParameterValue& value) {
    return std::visit(Overloaded{[](std::monostate) { return std::string(); },
                                 [](const std::string& s) { return s; },
                                 [](const Mixture& m) {
                                     return fmt::format("{}:{}:{}", count_text(m), m.radius,
                                                        m.mass);
                                 },
                                 [](auto number) { return fmt::format("{}", number); }},
                      value);
}

/// 1e6 for 1000000.
std::string shortened(const std::string& number) {
    const std::size_t zeros = number.size() - 1 - number.find_last_not_of('0');
    if (zeros < 4 || !read_whole_number(number)) return number;
    return fmt::format("{}e{}", number.substr(0, number.size() - zeros), zeros);
}

/// The same texts with names in one spelling. Throws UsageError for unknown and repeated names.
ParameterTexts normalized(const ParameterTexts& given) {
    ParameterTexts texts;
    for (const auto& [name, text] : given) {
        const Parameter* const row = find_parameter(name);
        if (row == nullptr || !row->is_settable()) {
            const auto meant = nearest_name(plain_name(name), parameter_names());
            throw_usage_error(
                Message("unknown_parameter", {{"name", name}}) +
                (meant ? Message("did_you_mean", {{"name", *meant}}) : Message("see_help")));
        }
        if (!texts.emplace(row->name, text).second)
            throw_usage_error(Message("given_twice", {{"name", option_name(row->name)}}));
    }
    return texts;
}

constexpr const char* inertia_names[] = {"paper", "ring", "solid", "sphere", "shell"};

double inertia_named(std::string_view name, double mass, double radius) {
    if (name == "sphere") return solid_sphere_inertia(mass, radius);
    if (name == "shell") return shell_inertia(mass, radius);
    if (name == "ring") return ring_inertia(mass, radius);
    if (name == "solid") return solid_inertia(mass, radius);
    return paper_inertia * mass * radius * radius;
}

/// Two of amplitude, period and speed determine the third. If all three are present, removes one
/// that only the file gives; the speed first, because it follows from the others.
void keep_two_of_three(ParameterTexts& texts, const ParameterTexts& command_line) {
    constexpr const char* three[] = {"speed", "period", "amplitude"};
    for (const char* name : three)
        if (!texts.contains(name)) return;
    for (const char* name : three)
        if (!command_line.contains(name)) return void(texts.erase(name));
}

std::optional<Message> outside(const Parameter& p, double value) {
    if (value >= p.range.lowest && value <= p.range.highest) return {};
    return Message("out_of_range", {{"name", option_name(p.name)},
                                    {"value", value},
                                    {"from", p.range.lowest},
                                    {"to", p.range.highest}});
}

std::optional<Message> outside(const Parameter& p, std::int64_t value) {
    const auto lowest = static_cast<std::int64_t>(p.range.lowest);
    const auto highest = static_cast<std::int64_t>(p.range.highest);
    if (value >= lowest && value <= highest) return {};
    return Message(
        "out_of_whole_range",
        {{"name", option_name(p.name)}, {"value", value}, {"from", lowest}, {"to", highest}});
}

std::optional<Message> out_of_range(const Parameter& p, const RunConfig& config) {
    const ParameterValue value = member_value(p, config);
    if (const auto* number = std::get_if<double>(&value)) return outside(p, *number);
    if (const auto* whole = std::get_if<std::int64_t>(&value)) return outside(p, *whole);
    return {};
}

}  // namespace

void read_mu(std::string_view text, const ParameterTexts&, RunConfig& config) {
    const double mu = number_from("mu", text);
    if (mu < 0.0) throw_usage_error(about("negative", "mu", text));
    config.mu_disc = config.mu_wall = mu;
}

/// In the order of Frictionless.
static constexpr std::array frictionless_names{"none", "wall", "boundary", "bulk"};

void read_frictionless(std::string_view text, const ParameterTexts& given, RunConfig& config) {
    const auto found = std::find(frictionless_names.begin(), frictionless_names.end(), text);
    if (found == frictionless_names.end())
        reject_choice("frictionless", text, {frictionless_names.begin(), frictionless_names.end()});
    config.frictionless = static_cast<Frictionless>(found - frictionless_names.begin());
    if (config.frictionless != Frictionless::wall) return;
    if (given.contains("mu_wall") && config.mu_wall != 0.0)
        throw_usage_error(Message("smooth_wall", {{"value", config.mu_wall}}));
    config.mu_wall = 0.0;
}
ParameterValue write_frictionless(const RunConfig& config) {
    if (config.frictionless == Frictionless::none) return {};
    return frictionless_names[static_cast<std::size_t>(config.frictionless)];
}

void read_preset(std::string_view text, const ParameterTexts& given, RunConfig& config) {
    std::vector<std::string> names;
    for (const ExperimentPreset& preset : experiment_presets) {
        names.emplace_back(preset.name);
        if (text != preset.name) continue;
        config.body = Shape::sphere;
        config.floor = true;
        config.mu_disc = config.mu_wall = config.floor_friction = preset.friction;
        config.restitution = experiment_restitution;
        config.container_radius = experiment_container_radius;
        config.amplitude = preset.amplitude / sphere_radius_mm;
        config.period = 2.0 * pi * config.amplitude;
        config.gravity = experiment_gravity(preset.amplitude);
        if (!given.contains("events") && !given.contains("ramp"))
            config.periods = experiment_periods;
        return;
    }
    reject_choice("preset", text, names);
}

namespace {

/// True if a call with a preset has its own unit of length or time. The units of a preset are r and
/// AΩ, so in them the container keeps the speed 1. An amplitude without a period keeps Ω and
/// gravity, and thus the unit of time.
bool has_own_units(const ParameterTexts& given, const RunConfig& config) {
    constexpr double rounding = 0.01;  // a period may be given in a few digits
    const auto is_one = [](double speed) { return std::fabs(speed - 1.0) <= rounding; };
    if (config.radius != 1.0) return true;
    if (!given.contains("period") && !given.contains("speed")) return false;
    return !is_one(config.amplitude * config.omega()) && !is_one(container_speed(config));
}

/// "--radius 3, --period 0.532"
std::string given_units(const ParameterTexts& given) {
    std::string text;
    for (const char* name : {"radius", "amplitude", "period", "speed"})
        if (const auto found = given.find(name); found != given.end())
            text +=
                fmt::format("{}{} {}", text.empty() ? "" : ", ", option_name(name), found->second);
    return text;
}

/// A preset consists of ratios: R/r, A/r, t_c/T and g in (AΩ)²/r. What is not given follows a given
/// radius or period. Gravity cannot follow, because the same numbers may be another unit or another
/// dish.
void follow_preset(const ParameterTexts& given, RunConfig& config) {
    if (!given.contains("preset") || !has_own_units(given, config)) return;
    if (config.floor && !given.contains("gravity"))
        throw_usage_error(Message("preset_needs_gravity",
                                  {{"preset", given.at("preset")}, {"given", given_units(given)}}));
    RunConfig preset;
    read_preset(given.at("preset"), {}, preset);
    for (const Parameter& p : run_parameters)
        if (p.in_preset == InPreset::duration && !given.contains(p.name))
            config.*p.number() = preset.*p.number() * (config.period / preset.period);
}

/// Lengths of a preset are multiples of r.
void scale_preset_lengths(const ParameterTexts& given, RunConfig& config) {
    if (!given.contains("preset")) return;
    for (const Parameter& p : run_parameters) {
        if (p.in_preset != InPreset::length || given.contains(p.name)) continue;
        const bool is_of_given_path =
            p.number() == &RunConfig::amplitude && config.path == PathShape::points;
        if (!is_of_given_path) config.*p.number() *= config.radius;
    }
}

}  // namespace

void RunConfig::remove_floor() {
    const RunConfig defaults;
    floor = false;
    for (const Parameter& p : run_parameters)
        if (needs_floor(p.applies_to)) this->*p.number() = defaults.*p.number();
}

void read_body(std::string_view text, const ParameterTexts&, RunConfig& config) {
    if (text != "disc" && text != "sphere") reject_choice("body", text, {"disc", "sphere"});
    config.body = text == "sphere" ? Shape::sphere : Shape::disc;
    if (config.body == Shape::sphere) config.floor = true;
}
/// Results of discs omit the type.
ParameterValue write_body(const RunConfig& config) {
    return config.body == Shape::sphere ? ParameterValue("sphere") : ParameterValue();
}

void read_floor(std::string_view text, const ParameterTexts&, RunConfig& config) {
    if (text != "none" && text != "sliding") throw_usage_error(about("not_a_floor", "floor", text));
    config.floor = text == "sliding";
    if (!config.floor) config.remove_floor();
}
ParameterValue write_floor(const RunConfig& config) {
    if (config.floor) return "sliding";
    return config.body == Shape::sphere ? ParameterValue("none") : ParameterValue();
}

/// Names are multiples of m r²; a number is the moment of inertia itself. The default is the
/// paper's for discs, and a solid sphere for spheres.
void read_inertia(std::string_view text, const ParameterTexts& given, RunConfig& config) {
    if (config.body == Shape::sphere && !given.contains("inertia")) text = "sphere";
    for (const char* name : inertia_names)
        if (text == name) {
            config.inertia = inertia_named(text, config.mass, config.radius);
            return;
        }
    const auto value = read_number(text);
    if (!value) {
        Message message = about("not_an_inertia", "inertia", text);
        add_nearest_value(message, text, {std::begin(inertia_names), std::end(inertia_names)});
        throw_usage_error(message);
    }
    config.inertia = *value;
}

/// The name, if there is one, so that the inertia adapts to another mass or radius.
std::string format_inertia(const RunConfig& config) {
    for (const char* name : inertia_names)
        if (config.inertia == inertia_named(name, config.mass, config.radius)) return name;
    return fmt::format("{}", config.inertia);
}

void read_mixture(std::string_view text, const ParameterTexts&, RunConfig& config) {
    const auto require = [&](bool is_valid) {
        if (!is_valid) throw_usage_error(about("not_a_mixture", "mixture", text));
    };
    const auto parts = split(text, ":");
    require(parts.size() == 2 || parts.size() == 3);
    const bool is_share = parts[0].ends_with('%');
    const auto percent =
        is_share ? read_number(parts[0].substr(0, parts[0].size() - 1)) : std::nullopt;
    const auto count = is_share ? std::nullopt : read_whole_number(parts[0]);
    const auto radius = read_number(parts[1]);
    require((count || percent) && radius);
    const auto mass =
        parts.size() == 3 ? read_number(parts[2]) : mass_of_same_material(*radius, config);
    require(mass.has_value());
    config.mixture = Mixture{count.value_or(0), *radius, *mass, percent};
    if (percent && *percent >= 0.0 && *percent <= 100.0)  // others are rejected (config.cpp)
        config.mixture->count = std::llround(*percent * double(config.discs) / 100.0);
}

ParameterValue write_mixture(const RunConfig& config) {
    return config.mixture ? ParameterValue(*config.mixture) : ParameterValue();
}

/// Omits a default mass, so that it adapts to another mass of the first species.
std::string format_mixture(const RunConfig& config) {
    const Mixture& m = *config.mixture;
    if (m.mass == mass_of_same_material(m.radius, config))
        return fmt::format("{}:{}", count_text(m), m.radius);
    return as_text(m);
}

void read_speed(std::string_view text, const ParameterTexts& given, RunConfig& config) {
    const double speed = number_from("speed", text);
    const bool period_given = given.contains("period");
    if (!(speed >= 0.0 && speed <= largest_value))
        throw_usage_error(about("not_a_speed", "speed", text));
    if (period_given && given.contains("amplitude")) {
        const double actual = container_speed(config);
        if (std::fabs(actual - speed) <= 1e-6 * std::fmax(actual, speed)) return;
        throw_usage_error(Message("speed_contradicts", {{"speed", speed},
                                                        {"amplitude", config.amplitude},
                                                        {"period", config.period},
                                                        rounded("actual", actual, 6)}));
    }
    if ((speed == 0.0) != (config.amplitude == 0.0) && !period_given)
        throw_usage_error(Message(speed == 0.0 ? Code("speed_is_zero") : Code("speed_at_rest"),
                                  {{"speed", speed}, {"amplitude", config.amplitude}}));
    // The speed is proportional to amplitude / period.
    if (period_given) {
        RunConfig unit = config;
        unit.amplitude = 1.0;
        config.amplitude = speed / container_speed(unit);
    } else if (speed > 0.0) {
        config.period *= container_speed(config) / speed;
    }
}

ParameterValue write_speed(const RunConfig& config) { return container_speed(config); }
ParameterValue write_omega(const RunConfig& config) { return config.omega(); }

void read_sides(std::string_view text, const ParameterTexts&, RunConfig& config) {
    const std::int64_t sides = whole_number_from("sides", text);
    if (config.path == PathShape::circle || config.path == PathShape::points)
        throw_usage_error(Message(config.path == PathShape::circle ? Code("circle_has_no_sides")
                                                                   : Code("path_has_its_sides"),
                                  {{"sides", sides}}));
    config.sides = clamped(sides);
}
ParameterValue write_sides(const RunConfig& config) {
    if (config.path == PathShape::circle || config.path == PathShape::points) return {};
    return std::int64_t{config.sides};
}

ParameterValue write_events(const RunConfig& config) {
    return config.periods ? ParameterValue() : ParameterValue(config.events);
}

void read_periods(std::string_view text, const ParameterTexts& given, RunConfig& config) {
    if (const auto events = given.find("events"); events != given.end())
        throw_usage_error(Message("two_lengths", {{"events", events->second}, {"periods", text}}));
    config.periods = whole_number_from("periods", text);
}

void read_warmup(std::string_view text, const ParameterTexts&, RunConfig& config) {
    config.warmup_found = text == "auto";
    if (config.warmup_found) return;
    config.warmup = read_whole_number(text);
    if (!config.warmup) throw_usage_error(about("not_a_warmup", "warmup", text));
}

ParameterValue write_warmup(const RunConfig& config) {
    if (config.warmup_found) return "auto";
    return config.warmup ? ParameterValue(*config.warmup) : ParameterValue();
}

const Parameter* find_parameter(std::string_view name) {
    const std::string plain = plain_name(name);
    for (const Parameter& p : run_parameters)
        if (plain == p.name) return &p;
    return nullptr;
}

std::vector<std::string> parameter_names() {
    std::vector<std::string> names;
    for (const Parameter& p : run_parameters)
        if (p.is_settable()) names.push_back(user_name(p.name));
    return names;
}

ParameterValue value_of(const Parameter& p, const RunConfig& config) {
    if (p.write) return p.write(config);
    const ParameterValue value = member_value(p, config);
    if (p.written == WrittenIf::floor && !config.floor) return {};
    if (p.written == WrittenIf::not_default && value == member_value(p, {})) return {};
    return value;
}

std::string default_of(const Parameter& p) {
    if (p.default_text) return p.default_text;
    const ParameterValue written = value_of(p, {});
    const bool is_unset = std::holds_alternative<std::monostate>(written);
    return shortened(as_text(is_unset ? member_value(p, {}) : written));
}

/// An explicit `--floor none` switches the floor's parameters off, for example in a sweep. A ramp
/// of one of them is an error in any case.
static void reject_parameters_without_floor(const ParameterTexts& texts, const RunConfig& config) {
    if (config.floor) return;
    for (const Parameter& p : run_parameters) {
        if (!needs_floor(p.applies_to)) continue;
        if (config.ramp_of(p.name))
            throw_usage_error(Message("ramp_without_floor", {{"name", p.name}}));
        if (texts.contains("floor")) continue;
        if (const auto found = texts.find(p.name); found != texts.end())
            throw_usage_error(about("no_floor", p.name, found->second));
    }
}

RunConfig resolve(const ParameterTexts& given) {
    const ParameterTexts texts = without_units(normalized(given));
    RunConfig config;
    const auto read_all = [&](ReadingOrder order) {
        for (const Parameter& p : run_parameters) {
            if (p.order != order) continue;
            if (const auto found = texts.find(p.name); found != texts.end())
                read_parameter(p, found->second, texts, config);
            else if (order == ReadingOrder::second && p.default_text)
                read_parameter(p, p.default_text, texts, config);  // depends on other parameters
        }
    };
    read_all(ReadingOrder::first);
    read_all(ReadingOrder::second);
    scale_preset_lengths(texts, config);
    // The last pass computes with these values, so they must be valid.
    if (const auto message = out_of_range(config)) throw_usage_error(*message);
    if (!texts.contains("speed")) follow_preset(texts, config);
    if (const auto message = problem(config)) throw_usage_error(*message);
    read_all(ReadingOrder::last);
    follow_preset(texts, config);
    reject_parameters_without_floor(texts, config);
    if (const auto message = problem(config)) throw_usage_error(*message);
    // It depends on the final path and sizes, so it is not part of problem().
    if (const auto message = problem_with_initial(config)) throw_usage_error(*message);
    return config;
}

ParameterTexts texts_of(const RunConfig& config) {
    ParameterTexts texts;
    for (const Parameter& p : run_parameters) {
        const ParameterValue value = value_of(p, config);
        if (p.is_derived || std::holds_alternative<std::monostate>(value)) continue;
        texts[p.name] = p.format ? p.format(config) : as_text(value);
    }
    return texts;
}

RunConfig with_discs(const RunConfig& config, std::int64_t discs) {
    ParameterTexts texts = texts_of(config);
    texts["discs"] = std::to_string(discs);
    return resolve(texts);
}

ParameterTexts overridden(ParameterTexts file, const ParameterTexts& command_line) {
    // A preset replaces all parameters that it sets, and those that follow from them.
    if (command_line.contains("preset"))
        for (const Parameter& p : run_parameters)
            if (p.in_preset != InPreset::unchanged) file.erase(p.name);
    // A ramp replaces the file's values of its parameters.
    if (const auto ramp = command_line.find("ramp"); ramp != command_line.end())
        for (const std::string& name : parameters_set_by_ramps(ramp->second)) file.erase(name);
    if (const auto smooth = command_line.find("frictionless");
        smooth != command_line.end() && smooth->second == "wall")
        file.erase("mu_wall");
    for (const auto& [name, text] : command_line)
        if (const Parameter* const p = find_parameter(name))
            for (const char* other : p->overrides)
                if (other) file.erase(other);
    for (const auto& [name, text] : command_line) file.insert_or_assign(name, text);
    keep_two_of_three(file, command_line);
    keep_path_or_sides(file, command_line);
    return file;
}

std::optional<Message> out_of_range(const RunConfig& config) {
    // Reports the cause and not its consequence: a mass of 0, not the inertia computed from it.
    for (const ReadingOrder order : {ReadingOrder::first, ReadingOrder::second, ReadingOrder::last})
        for (const Parameter& p : run_parameters)
            if (p.order == order)
                if (auto message = out_of_range(p, config)) return message;
    return {};
}

}  // namespace swirl
