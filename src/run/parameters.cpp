#include "swirl/run/parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <numeric>

#include "swirl/run/failure.hpp"

namespace swirl {
namespace {

std::optional<std::string_view> text_of(const ParameterTexts& given, std::string_view name) {
    const auto found = given.find(name);
    if (found == given.end()) return {};
    return std::string_view(found->second);
}

[[noreturn]] void unreadable(std::string_view name, std::string_view text, const char* right) {
    throw WrongCall(fmt::format("--{} is '{}', but it must be {}.", name, text, right));
}

double number_from(std::string_view name, std::string_view text) {
    const auto value = read_number(text);
    if (!value) unreadable(name, text, "a finite number, for example 0.5 or 1e3");
    return *value;
}

void take(const ParameterTexts& given, std::string_view name, double& into) {
    if (const auto text = text_of(given, name)) into = number_from(name, *text);
}

std::optional<std::int64_t> whole(const ParameterTexts& given, std::string_view name) {
    const auto text = text_of(given, name);
    if (!text) return {};
    const auto value = read_whole_number(*text);
    if (!value) unreadable(name, *text, "a whole number below 10^18, for example 48 or 1e6");
    return value;
}

std::optional<std::int64_t> warmup_from(const ParameterTexts& given) {
    const auto text = text_of(given, "warmup");
    if (text && !read_whole_number(*text))
        unreadable("warmup", *text, "a whole number of swirls, for example 20, or auto");
    return whole(given, "warmup");
}

/// Names are multiples of m r²; a number is the moment of inertia itself.
double inertia_from(std::string_view text, double mass, double radius) {
    if (text == "paper") return paper_inertia * mass * radius * radius;
    if (text == "ring") return ring_inertia(mass, radius);
    if (text == "solid") return solid_inertia(mass, radius);
    const auto value = read_number(text);
    if (!value)
        unreadable("inertia", text,
                   "a number above 0, or paper (10 m r^2), ring (m r^2) or solid (m r^2 / 2)");
    return *value;
}

/// COUNT:RADIUS or COUNT:RADIUS:MASS; without a mass, of the same material (m ~ r²).
Mixture mixture_from(std::string_view text, const RunConfig& config) {
    constexpr auto right =
        "COUNT:RADIUS or COUNT:RADIUS:MASS, for example 12:1.4 for twelve discs of radius 1.4";
    const auto first = text.find(':');
    if (first == text.npos) unreadable("mixture", text, right);
    const auto second = text.find(':', first + 1);
    const auto count = read_whole_number(text.substr(0, first));
    const auto radius =
        read_number(text.substr(first + 1, second == text.npos ? second : second - first - 1));
    if (!count || !radius) unreadable("mixture", text, right);
    const double ratio = *radius / config.radius;
    double mass = config.mass * ratio * ratio;
    if (second != text.npos) {
        const auto given = read_number(text.substr(second + 1));
        if (!given) unreadable("mixture", text, right);
        mass = *given;
    }
    return {*count, *radius, mass};
}

/// Amplitude, period and speed: two of them make the third.
void resolve_speed(const ParameterTexts& given, RunConfig& config) {
    const auto text = text_of(given, "speed");
    if (!text) return;
    const double speed = number_from("speed", *text);
    const bool period_given = text_of(given, "period").has_value();
    const bool amplitude_given = text_of(given, "amplitude").has_value();
    if (!(speed >= 0.0)) unreadable("speed", *text, "0 (a container that stands still) or more");
    if (period_given && amplitude_given) {
        const double actual = container_speed(config);
        if (std::fabs(actual - speed) <= 1e-6 * std::fmax(actual, speed)) return;
        throw WrongCall(fmt::format(
            "--speed is {}, but --amplitude {} and --period {} make the container move at {:.6g}; "
            "leave one of the three away.",
            speed, config.amplitude, config.period, actual));
    }
    if ((speed == 0.0) != (config.amplitude == 0.0) && !period_given)
        throw WrongCall(fmt::format(
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

std::vector<std::string> names() {
    std::vector<std::string> all;
    for (const RunParameter& p : run_parameters()) all.emplace_back(p.name);
    return all;
}

void refuse_unknown(const ParameterTexts& given) {
    const auto known = names();
    for (const auto& [name, text] : given) {
        if (std::find(known.begin(), known.end(), name) != known.end()) continue;
        const auto meant = nearest_name(name, known);
        throw WrongCall(fmt::format("There is no parameter '{}'{}.", name,
                                    meant ? fmt::format("; did you mean '{}'?", *meant)
                                          : "; `swirl run --help` lists them"));
    }
}

std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i + 1;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t change = diagonal + (a[i] != b[j]);
            diagonal = row[j + 1];
            row[j + 1] = std::min({change, row[j] + 1, row[j + 1] + 1});
        }
    }
    return row.back();
}

}  // namespace

const std::vector<RunParameter>& run_parameters() {
    static const std::vector<RunParameter> all = {
        {"discs", "N", "number of discs [48]", "The discs"},
        {"mu", "NUMBER", "friction of discs with discs and with the wall [1]", "The discs"},
        {"mu-disc", "NUMBER", "friction between discs, if it differs from --mu", "The discs"},
        {"mu-wall", "NUMBER", "friction with the wall, if it differs from --mu", "The discs"},
        {"inertia", "NUMBER|paper|ring|solid",
         "moment of inertia of a disc: paper = 10 m r^2, ring = m r^2, solid = m r^2 / 2 [paper]",
         "The discs"},
        {"mass", "NUMBER", "mass of a disc [1]", "The discs"},
        {"radius", "NUMBER", "radius of a disc [1]", "The discs"},
        {"mixture", "COUNT:RADIUS[:MASS]",
         "COUNT of the discs have this radius instead (and this mass; by default of the same "
         "material, m ~ r^2)",
         "The discs"},
        {"restitution", "0..1", "normal restitution e; 1 is elastic [1]", "The discs"},
        {"tangential-restitution", "0..1",
         "the fraction of its slip that a sticking contact gives back [0]", "The discs"},
        {"contact-duration", "TIME",
         "with --restitution below 1: a collision this soon after a disc's last one is elastic "
         "[0.001]",
         "The discs"},
        {"container-radius", "NUMBER", "radius of the container [8.6]", "The container"},
        {"amplitude", "NUMBER", "distance of its centre from the swirl centre [1.892]",
         "The container"},
        {"period", "NUMBER", "time for one swirl [11.866071]", "The container"},
        {"speed", "NUMBER", "its speed: instead of --period (or of --amplitude)", "The container"},
        {"path", "polygon|circle", "shape of its path [polygon]", "The container"},
        {"sides", "M", "sides of the polygon [30]", "The container"},
        {"events", "NUMBER", "length of the run in events of all kinds [1e6]", "The run"},
        {"periods", "NUMBER", "length of the run in swirls, instead of --events", "The run"},
        {"warmup", "PERIODS|auto",
         "swirls at the start that do not count; auto finds out how many it takes (MSER-5 and "
         "Geweke's test of rotation and spins; at most half of the run) [20, or a fifth of the run "
         "if that is shorter]",
         "The run"},
        {"seed", "NUMBER", "decides places and velocities at the start [1]", "The run"},
    };
    return all;
}

RunConfig resolve(const ParameterTexts& given) {
    refuse_unknown(given);
    RunConfig config;
    if (const auto text = text_of(given, "mu"))
        config.mu_disc = config.mu_wall = number_from("mu", *text);
    if (const auto text = text_of(given, "mu"); text && config.mu_disc < 0.0)
        unreadable("mu", *text, "0 or more; friction cannot be negative");
    take(given, "mu-disc", config.mu_disc);
    take(given, "mu-wall", config.mu_wall);
    take(given, "restitution", config.restitution);
    take(given, "tangential-restitution", config.tangential_restitution);
    take(given, "contact-duration", config.contact_duration);
    take(given, "mass", config.mass);
    take(given, "radius", config.radius);
    take(given, "container-radius", config.container_radius);
    take(given, "amplitude", config.amplitude);
    take(given, "period", config.period);
    config.discs = whole(given, "discs").value_or(config.discs);
    config.inertia =
        inertia_from(text_of(given, "inertia").value_or("paper"), config.mass, config.radius);

    if (const auto text = text_of(given, "path")) {
        if (*text != "polygon" && *text != "circle") unreadable("path", *text, "polygon or circle");
        config.path = *text == "circle" ? PathShape::circle : PathShape::polygon;
    }
    if (const auto sides = whole(given, "sides")) {
        if (config.path == PathShape::circle)
            throw WrongCall(fmt::format(
                "--sides is {}, but --path circle has no sides; leave one of the two away.",
                *sides));
        config.sides = static_cast<int>(std::clamp<std::int64_t>(*sides, -1, 1'000'000'000));
    }
    if (text_of(given, "events") && text_of(given, "periods"))
        throw WrongCall(fmt::format(
            "--events {} and --periods {} both give the length of the run; leave one away.",
            *text_of(given, "events"), *text_of(given, "periods")));
    config.events = whole(given, "events").value_or(config.events);
    config.periods = whole(given, "periods");
    config.warmup_found = text_of(given, "warmup") == std::optional<std::string_view>("auto");
    if (!config.warmup_found) config.warmup = warmup_from(given);
    if (const auto text = text_of(given, "seed")) {
        const auto [end, error] =
            std::from_chars(text->data(), text->data() + text->size(), config.seed);
        if (error != std::errc() || end != text->data() + text->size())
            unreadable("seed", *text, "a whole number from 0 to 18446744073709551615");
    }
    if (const auto text = text_of(given, "mixture")) config.mixture = mixture_from(*text, config);
    // The speed is made of amplitude, period and sides; make sure of them first.
    if (const auto wrong = problem(config)) throw WrongCall(*wrong);
    resolve_speed(given, config);
    if (const auto wrong = problem(config)) throw WrongCall(*wrong);
    return config;
}

std::optional<double> read_number(std::string_view text) {
    double value = 0.0;
    const char* const last = text.data() + text.size();
    const auto [end, error] = std::from_chars(text.data(), last, value);
    if (error != std::errc() || end != last || !std::isfinite(value)) return {};
    return value;
}

std::optional<std::int64_t> read_whole_number(std::string_view text) {
    std::int64_t whole_value = 0;
    const char* const last = text.data() + text.size();
    const auto [end, error] = std::from_chars(text.data(), last, whole_value);
    if (error == std::errc() && end == last) return whole_value;
    const auto value = read_number(text);  // "1e6"
    if (!value || std::trunc(*value) != *value || std::fabs(*value) > 1e18) return {};
    return static_cast<std::int64_t>(*value);
}

std::optional<std::string> nearest_name(std::string_view wrong,
                                        const std::vector<std::string>& names) {
    std::optional<std::string> best;
    std::size_t least = std::max<std::size_t>(2, wrong.size() / 3) + 1;
    for (const std::string& name : names) {
        const std::size_t distance = edit_distance(wrong, name);
        if (distance >= least) continue;
        least = distance;
        best = name;
    }
    return best;
}

}  // namespace swirl
