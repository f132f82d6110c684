#include "swirl/run/parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "swirl/run/config.hpp"
#include "swirl/run/failure.hpp"

namespace swirl {
namespace {

template <class... Cases>
struct Either : Cases... {
    using Cases::operator()...;
};

[[noreturn]] void unreadable(std::string_view name, std::string_view text, const char* right) {
    throw_wrong_call(fmt::format("{} is '{}', but it must be {}.", option_name(name), text, right));
}

double number_from(std::string_view name, std::string_view text) {
    const auto value = read_number(text);
    if (!value) unreadable(name, text, "a finite number, for example 0.5 or 1e3");
    return *value;
}

std::int64_t whole_from(std::string_view name, std::string_view text) {
    const auto value = read_whole_number(text);
    if (!value) unreadable(name, text, "a whole number below 10^18, for example 48 or 1e6");
    return *value;
}

std::uint64_t seed_from(std::string_view name, std::string_view text) {
    std::uint64_t seed = 0;
    const char* const last = text.data() + text.size();
    const auto [end, error] = std::from_chars(text.data(), last, seed);
    if (error != std::errc() || end != last)
        unreadable(name, text, "a whole number from 0 to 18446744073709551615");
    return seed;
}

/// Still outside the range of every number of this type if it was.
int clamped(std::int64_t value) {
    return static_cast<int>(std::clamp<std::int64_t>(value, -1, 1'000'000'000));
}

/// Into the member of which the row is.
void read_member(const Parameter& p, std::string_view text, RunConfig& config) {
    std::visit(Either{[](std::monostate) {},
                      [&](double RunConfig::*m) { config.*m = number_from(p.name, text); },
                      [&](std::int64_t RunConfig::*m) { config.*m = whole_from(p.name, text); },
                      [&](int RunConfig::*m) { config.*m = clamped(whole_from(p.name, text)); },
                      [&](std::uint64_t RunConfig::*m) { config.*m = seed_from(p.name, text); },
                      [&](std::optional<std::int64_t> RunConfig::*m) {
                          config.*m = whole_from(p.name, text);
                      }},
               p.member);
}

ParameterValue member_value(const Parameter& p, const RunConfig& config) {
    return std::visit(
        Either{[](std::monostate) -> ParameterValue { return {}; },
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

std::string as_text(const ParameterValue& value) {
    return std::visit(
        Either{[](std::monostate) { return std::string(); }, [](const std::string& s) { return s; },
               [](const Mixture& m) { return fmt::format("{}:{}:{}", m.count, m.radius, m.mass); },
               [](auto number) { return fmt::format("{}", number); }},
        value);
}

/// 1e6 for 1000000.
std::string in_few_characters(const std::string& number) {
    const std::size_t zeros = number.size() - 1 - number.find_last_not_of('0');
    if (zeros < 4 || !read_whole_number(number)) return number;
    return fmt::format("{}e{}", number.substr(0, number.size() - zeros), zeros);
}

/// The same names in one spelling; all of them known.
ParameterTexts known_texts(const ParameterTexts& given) {
    ParameterTexts texts;
    for (const auto& [name, text] : given) {
        const Parameter* const row = find_parameter(name);
        if (row == nullptr || !row->can_be_given()) {
            const auto meant = nearest_name(plain_name(name), parameter_names());
            throw_wrong_call(fmt::format("There is no parameter '{}'{}", name,
                                         meant ? fmt::format("; did you mean '{}'?", *meant)
                                               : "; `swirl run --help` lists them."));
        }
        if (!texts.emplace(row->name, text).second)
            throw_wrong_call(fmt::format("{} is given twice.", option_name(row->name)));
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

/// Of the same material as the others: m ~ r², of spheres r³.
double mass_of_second_size(double radius, const RunConfig& config) {
    const double ratio = radius / config.radius;
    return config.mass * ratio * ratio * (config.body == Shape::sphere ? ratio : 1.0);
}

/// Amplitude, period and speed: two of them make the third. Of three, one that only the file says
/// goes; the speed first, which is made of the others.
void leave_two_of_three(ParameterTexts& texts, const ParameterTexts& by_hand) {
    constexpr const char* three[] = {"speed", "period", "amplitude"};
    for (const char* name : three)
        if (!texts.contains(name)) return;
    for (const char* name : three)
        if (!by_hand.contains(name)) return void(texts.erase(name));
}

/// A circle has no sides.
void leave_path_or_sides(ParameterTexts& texts, const ParameterTexts& by_hand) {
    const auto path = texts.find("path");
    if (path == texts.end() || path->second.find("circle") == std::string::npos) return;
    if (by_hand.contains("path") && !by_hand.contains("sides")) texts.erase("sides");
    if (by_hand.contains("sides") && !by_hand.contains("path")) texts.erase("path");
}

std::optional<std::string> outside(const Parameter& p, double value) {
    if (value >= p.lowest && value <= p.highest) return {};
    return fmt::format("{} is {}, but it must be a number from {} to {}.", option_name(p.name),
                       value, p.lowest, p.highest);
}

std::optional<std::string> outside(const Parameter& p, std::int64_t value) {
    const auto lowest = static_cast<std::int64_t>(p.lowest);
    const auto highest = static_cast<std::int64_t>(p.highest);
    if (value >= lowest && value <= highest) return {};
    return fmt::format("{} is {}, but it must be a whole number from {} to {}.",
                       option_name(p.name), value, lowest, highest);
}

std::optional<std::string> out_of_range(const Parameter& p, const RunConfig& config) {
    const ParameterValue value = member_value(p, config);
    if (const auto* number = std::get_if<double>(&value)) return outside(p, *number);
    if (const auto* whole = std::get_if<std::int64_t>(&value)) return outside(p, *whole);
    return {};
}

}  // namespace

void read_mu(std::string_view text, const ParameterTexts&, RunConfig& config) {
    const double mu = number_from("mu", text);
    if (mu < 0.0) unreadable("mu", text, "0 or more; friction cannot be negative");
    config.mu_disc = config.mu_wall = mu;
}

void read_preset(std::string_view text, const ParameterTexts&, RunConfig& config) {
    if (text != "experiment") unreadable("preset", text, "experiment");
    config.body = Shape::sphere;
    config.floor = true;
    config.mu_disc = config.mu_wall = experiment_friction;
    config.restitution = experiment_restitution;
    config.container_radius = experiment_container_radius;
    config.amplitude = experiment_amplitude;
    config.period = experiment_period;
    config.floor_friction = experiment_floor_friction;
    config.gravity = experiment_gravity;
}

void read_body(std::string_view text, const ParameterTexts&, RunConfig& config) {
    if (text != "disc" && text != "sphere") unreadable("body", text, "disc or sphere");
    config.body = text == "sphere" ? Shape::sphere : Shape::disc;
}
/// Nothing is said of discs, which are the rule.
ParameterValue write_body(const RunConfig& config) {
    return config.body == Shape::sphere ? ParameterValue("sphere") : ParameterValue();
}

void read_floor(std::string_view text, const ParameterTexts&, RunConfig& config) {
    if (text != "none" && text != "sliding")
        unreadable("floor", text,
                   "none or sliding: on a perfectly rough floor spheres would collide without end, "
                   "and a large --floor-friction, 100 for example, comes to the same");
    config.floor = text == "sliding";
}
ParameterValue write_floor(const RunConfig& config) {
    return config.floor ? ParameterValue("sliding") : ParameterValue();
}
/// Said where there is a floor, or somebody asks for another.
ParameterValue write_floor_friction(const RunConfig& config) {
    return config.floor ? ParameterValue(config.floor_friction) : ParameterValue();
}
ParameterValue write_rolling_resistance(const RunConfig& config) {
    return config.rolling_resistance == 0.0 ? ParameterValue()
                                            : ParameterValue(config.rolling_resistance);
}
ParameterValue write_vertical_disc(const RunConfig& config) {
    return config.vertical_disc == 1.0 ? ParameterValue() : ParameterValue(config.vertical_disc);
}
ParameterValue write_vertical_wall(const RunConfig& config) {
    return config.vertical_wall == 1.0 ? ParameterValue() : ParameterValue(config.vertical_wall);
}
ParameterValue write_gravity(const RunConfig& config) {
    return config.floor ? ParameterValue(config.gravity) : ParameterValue();
}

/// Names are multiples of m r²; a number is the moment of inertia itself. Not given: the paper's,
/// or that of a solid sphere.
void read_inertia(std::string_view text, const ParameterTexts& given, RunConfig& config) {
    if (config.body == Shape::sphere && !given.contains("inertia")) text = "sphere";
    for (const char* name : inertia_names)
        if (text == name) {
            config.inertia = inertia_named(text, config.mass, config.radius);
            return;
        }
    const auto value = read_number(text);
    if (!value)
        unreadable("inertia", text,
                   "a number above 0, or paper (10 m r^2), ring (m r^2), solid (m r^2 / 2), sphere "
                   "(2/5 m r^2) or shell (2/3 m r^2)");
    config.inertia = *value;
}

/// By its name where it has one, so that it follows another mass or radius.
std::string spell_inertia(const RunConfig& config) {
    for (const char* name : inertia_names)
        if (config.inertia == inertia_named(name, config.mass, config.radius)) return name;
    return fmt::format("{}", config.inertia);
}

void read_mixture(std::string_view text, const ParameterTexts&, RunConfig& config) {
    constexpr auto right =
        "COUNT:RADIUS or COUNT:RADIUS:MASS, for example 12:1.4 for twelve discs of radius 1.4";
    const auto first = text.find(':');
    if (first == text.npos) unreadable("mixture", text, right);
    const auto second = text.find(':', first + 1);
    const auto count = read_whole_number(text.substr(0, first));
    const auto radius =
        read_number(text.substr(first + 1, second == text.npos ? second : second - first - 1));
    if (!count || !radius) unreadable("mixture", text, right);
    config.mixture = Mixture{*count, *radius, mass_of_second_size(*radius, config)};
    if (second == text.npos) return;
    const auto mass = read_number(text.substr(second + 1));
    if (!mass) unreadable("mixture", text, right);
    config.mixture->mass = *mass;
}

ParameterValue write_mixture(const RunConfig& config) {
    return config.mixture ? ParameterValue(*config.mixture) : ParameterValue();
}

/// Without the mass where it follows from the radius, so that it follows another mass too.
std::string spell_mixture(const RunConfig& config) {
    const Mixture& m = *config.mixture;
    if (m.mass == mass_of_second_size(m.radius, config))
        return fmt::format("{}:{}", m.count, m.radius);
    return as_text(m);
}

void read_speed(std::string_view text, const ParameterTexts& given, RunConfig& config) {
    const double speed = number_from("speed", text);
    const bool period_given = given.contains("period");
    if (!(speed >= 0.0 && speed <= largest_value))
        unreadable("speed", text, "from 0 (a container that stands still) to 1e6");
    if (period_given && given.contains("amplitude")) {
        const double actual = container_speed(config);
        if (std::fabs(actual - speed) <= 1e-6 * std::fmax(actual, speed)) return;
        throw_wrong_call(fmt::format(
            "--speed is {}, but --amplitude {} and --period {} make the container move at {:.6g}; "
            "leave one of the three away.",
            speed, config.amplitude, config.period, actual));
    }
    if ((speed == 0.0) != (config.amplitude == 0.0) && !period_given)
        throw_wrong_call(fmt::format(
            "--speed is {}, but with --amplitude {} the container {}; give 0 for both or for "
            "neither.",
            speed, config.amplitude, speed == 0.0 ? "must move" : "stands still"));
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

void read_path(std::string_view text, const ParameterTexts&, RunConfig& config) {
    if (text != "polygon" && text != "circle") unreadable("path", text, "polygon or circle");
    config.path = text == "circle" ? PathShape::circle : PathShape::polygon;
}

ParameterValue write_path(const RunConfig& config) {
    return config.path == PathShape::circle ? "circle" : "polygon";
}

void read_sides(std::string_view text, const ParameterTexts&, RunConfig& config) {
    const std::int64_t sides = whole_from("sides", text);
    if (config.path == PathShape::circle)
        throw_wrong_call(fmt::format(
            "--sides is {}, but --path circle has no sides; leave one of the two away.", sides));
    config.sides = clamped(sides);
}

ParameterValue write_sides(const RunConfig& config) {
    if (config.path == PathShape::circle) return {};
    return std::int64_t{config.sides};
}

ParameterValue write_events(const RunConfig& config) {
    return config.periods ? ParameterValue() : ParameterValue(config.events);
}

void read_periods(std::string_view text, const ParameterTexts& given, RunConfig& config) {
    if (const auto events = given.find("events"); events != given.end())
        throw_wrong_call(fmt::format(
            "--events {} and --periods {} both give the length of the run; leave one away.",
            events->second, text));
    config.periods = whole_from("periods", text);
}

void read_warmup(std::string_view text, const ParameterTexts&, RunConfig& config) {
    config.warmup_found = text == "auto";
    if (config.warmup_found) return;
    config.warmup = read_whole_number(text);
    if (!config.warmup)
        unreadable("warmup", text, "a whole number of swirls, for example 20, or auto");
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
        if (p.can_be_given()) names.emplace_back(p.name);
    return names;
}

ParameterValue value_of(const Parameter& p, const RunConfig& config) {
    return p.write ? p.write(config) : member_value(p, config);
}

std::string default_of(const Parameter& p) {
    return p.by_default ? p.by_default : in_few_characters(as_text(value_of(p, {})));
}

RunConfig resolve(const ParameterTexts& given) {
    const ParameterTexts texts = known_texts(given);
    RunConfig config;
    const auto read_all = [&](ReadingOrder order) {
        for (const Parameter& p : run_parameters) {
            if (p.order != order) continue;
            if (const auto found = texts.find(p.name); found != texts.end())
                read_parameter(p, found->second, texts, config);
            else if (order == ReadingOrder::then && p.by_default)
                read_parameter(p, p.by_default, texts, config);  // in terms of what was given
        }
    };
    read_all(ReadingOrder::first);
    read_all(ReadingOrder::then);
    // What the last ones are made of must be sound.
    if (const auto wrong = problem(config)) throw_wrong_call(*wrong);
    read_all(ReadingOrder::last);
    if (const auto wrong = problem(config)) throw_wrong_call(*wrong);
    return config;
}

ParameterTexts texts_of(const RunConfig& config) {
    ParameterTexts texts;
    for (const Parameter& p : run_parameters) {
        const ParameterValue value = value_of(p, config);
        if (p.follows || std::holds_alternative<std::monostate>(value)) continue;
        texts[p.name] = p.spell ? p.spell(config) : as_text(value);
    }
    return texts;
}

ParameterTexts overridden(ParameterTexts file, const ParameterTexts& by_hand) {
    // A preset takes the place of all that it sets, and of what is made of that.
    if (by_hand.contains("preset"))
        for (const char* name :
             {"body", "inertia", "floor", "floor_friction", "gravity", "mu", "mu_disc", "mu_wall",
              "restitution", "container_radius", "amplitude", "period", "speed"})
            file.erase(name);
    for (const auto& [name, text] : by_hand)
        if (const Parameter* const p = find_parameter(name))
            for (const char* other : p->instead_of)
                if (other) file.erase(other);
    for (const auto& [name, text] : by_hand) file.insert_or_assign(name, text);
    leave_two_of_three(file, by_hand);
    leave_path_or_sides(file, by_hand);
    return file;
}

std::optional<std::string> out_of_range(const RunConfig& config) {
    // What others are made of is named first: a mass of 0, not the inertia that follows.
    for (const ReadingOrder order : {ReadingOrder::first, ReadingOrder::then, ReadingOrder::last})
        for (const Parameter& p : run_parameters)
            if (p.order == order)
                if (auto wrong = out_of_range(p, config)) return wrong;
    return {};
}

}  // namespace swirl
