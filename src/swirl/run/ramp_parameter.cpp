// Reads and validates the ramps of a run (ramp.hpp). The browser page has no ramps, so its
// sentences have no codes.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "swirl/run/config.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/parameter_readers.hpp"
#include "swirl/run/ramp.hpp"
#include "swirl/run/reading.hpp"

namespace swirl {
namespace {

constexpr std::size_t max_ramp_values = 1000;
constexpr auto last_ramp_period = static_cast<std::int64_t>(max_periods) - 1;

[[noreturn]] void reject(std::string_view text, const std::string& why) {
    throw_usage_error(
        fmt::format("--ramp is '{}', but {}\nhint: a ramp is NAME=FROM:TO@P..Q with periods P and "
                    "Q, for example mu=0.1:1@20..220, or mu=0.1:1:0.1@20..420 up and down.",
                    text, why));
}

std::string name_of_ramp(std::string_view text, std::string_view given) {
    const std::string name = plain_name(given);
    const std::vector<std::string> names = ramp_parameter_names();
    if (std::find(names.begin(), names.end(), name) != names.end()) return name;
    const Parameter* const row = find_parameter(name);
    if (row == nullptr) {
        const std::string meant = nearest_value_hint(name, names);
        throw_usage_error(fmt::format(
            "--ramp is '{}', but there is no parameter '{}'.{}", text, given,
            meant.empty() ? fmt::format("\nhint: these can change: {}.", fmt::join(names, ", "))
                          : meant));
    }
    const bool is_of_the_discs =
        name == "inertia" || name == "mass" || name == "radius" || name == "mixture";
    throw_usage_error(fmt::format(
        "--ramp is '{}', but {} cannot change during a run{}.\nhint: these can: {}.", text, name,
        is_of_the_discs ? ": it is a property of the particles" : "", fmt::join(names, ", ")));
}

Ramp read_ramp_text(std::string_view text) {
    const std::size_t equals = text.find('='), at = text.find('@');
    if (equals == text.npos) reject(text, "it has no '='.");
    Ramp ramp{.name = name_of_ramp(text, trimmed(text.substr(0, equals))), .values = {}};
    if (at == text.npos || at < equals) reject(text, "it has no '@' with periods.");
    for (const std::string_view part : split(text.substr(equals + 1, at - equals - 1), ":")) {
        const auto value = read_number(part);
        if (!value) reject(text, fmt::format("'{}' is not a finite number.", part));
        ramp.values.push_back(*value);
    }
    if (ramp.values.size() < 2) reject(text, "it has only one value.");
    if (ramp.values.size() > max_ramp_values)
        reject(text, fmt::format("it has more than {} values.", max_ramp_values));
    const std::string_view periods = text.substr(at + 1);
    const std::size_t dots = periods.find("..");
    if (dots == periods.npos) reject(text, "its periods lack '..'.");
    const auto begin = read_whole_number(periods.substr(0, dots));
    const auto end = read_whole_number(periods.substr(dots + 2));
    if (!begin || !end || *begin < 0 || *end > last_ramp_period)
        reject(text, fmt::format("'{}' is not a pair of periods from 0 to {}.", periods,
                                 last_ramp_period));
    if (*end <= *begin)
        reject(text, fmt::format("period {} is not after period {}.", *end, *begin));
    const auto steps = static_cast<std::int64_t>(ramp.values.size()) - 1;
    if (*end - *begin < steps)
        reject(text, fmt::format("{} periods are too few for {} values.", *end - *begin,
                                 ramp.values.size()));
    ramp.begin = *begin;
    ramp.end = *end;
    return ramp;
}

void reject_two_ramps_of_one_parameter(std::string_view text, const std::vector<Ramp>& ramps) {
    std::vector<double RunConfig::*> seen;
    for (const Ramp& ramp : ramps)
        for (const auto member : members_of(ramp.name)) {
            if (std::find(seen.begin(), seen.end(), member) != seen.end())
                throw_usage_error(fmt::format(
                    "--ramp is '{}', but two ramps change the same parameter ({}).\nhint: one ramp "
                    "can have several values, for example mu=0.1:1:0.1@20..420.",
                    text, ramp.name));
            seen.push_back(member);
        }
}

/// A value that the user gave must be the first of its ramp.
void reject_other_first_value(const Ramp& ramp, const ParameterTexts& given,
                              const RunConfig& config) {
    const double first = ramp.values.front();
    const auto reject_if = [&](const char* name, double value) {
        if (given.contains(name) && value != first)
            throw_usage_error(
                fmt::format("{} is {}, but its ramp starts at {}.\nhint: omit {}; the ramp sets it "
                            "from the first period on.",
                            option_name(name), value, first, option_name(name)));
    };
    if (ramp.name == "mu") {
        if (given.contains("mu")) reject_if("mu", config.mu_disc);
        reject_if("mu_disc", config.mu_disc);
        reject_if("mu_wall", config.mu_wall);
        return;
    }
    reject_if(ramp.name.c_str(), config.*members_of(ramp.name).front());
    if ((ramp.name == "amplitude" || ramp.name == "period") && given.contains("speed"))
        throw_usage_error(fmt::format(
            "--speed is {}, but the ramp of {} changes the speed.\nhint: give --amplitude and "
            "--period instead.",
            given.at("speed"), ramp.name));
}

}  // namespace

std::vector<Ramp> read_ramps(std::string_view text) {
    std::vector<Ramp> ramps;
    for (const std::string_view part : split(text, ";")) {
        if (trimmed(part).empty()) reject(text, "a part of it is empty.");
        ramps.push_back(read_ramp_text(trimmed(part)));
    }
    reject_two_ramps_of_one_parameter(text, ramps);
    return ramps;
}

std::vector<std::string> parameters_set_by_ramps(std::string_view text) {
    std::vector<std::string> names;
    for (const std::string_view ramp : split(text, ",;")) {
        const std::string name = plain_name(trimmed(ramp.substr(0, ramp.find('='))));
        names.push_back(name);
        if (name == "mu") names.insert(names.end(), {"mu_disc", "mu_wall"});
        if (name == "amplitude" || name == "period") names.emplace_back("speed");
    }
    return names;
}

std::string ramps_text(const std::vector<Ramp>& ramps) {
    std::string text;
    for (const Ramp& ramp : ramps)
        text += fmt::format("{}{}={}@{}..{}", text.empty() ? "" : ";", ramp.name,
                            fmt::join(ramp.values, ":"), ramp.begin, ramp.end);
    return text;
}

std::vector<std::string> ramp_parameter_names() {
    std::vector<std::string> names;
    for (const Parameter& p : run_parameters)
        if (p.can_ramp()) names.emplace_back(p.name);
    return names;
}

void read_ramp(std::string_view text, const ParameterTexts& given, RunConfig& config) {
    config.ramps = read_ramps(text);
    for (const Ramp& ramp : config.ramps) reject_other_first_value(ramp, given, config);
    const std::vector<Ramp> ramps = config.ramps;
    config = in_period(config, 0);
    config.ramps = ramps;
    // Without a length, the run ends with its ramps: after the first period with the last values.
    if (!given.contains("events") && !given.contains("periods"))
        config.periods = end_of_ramps(config) + 1;
}

ParameterValue write_ramp(const RunConfig& config) {
    return config.ramps.empty() ? ParameterValue() : ParameterValue(ramps_text(config.ramps));
}

/// Between the periods checked here, every parameter is linear in time.
std::optional<Message> problem_with_ramps(const RunConfig& config) {
    for (const Ramp& ramp : config.ramps) {
        const auto steps = static_cast<std::int64_t>(ramp.values.size()) - 1;
        for (std::int64_t k = 0; k <= steps; ++k) {
            const std::int64_t period = ramp.begin + (ramp.end - ramp.begin) * k / steps;
            if (auto message = problem(in_period(config, period)))
                return without_code(fmt::format("in period {} of --ramp {}: {}", period,
                                                ramps_text(config.ramps), message->english()));
        }
    }
    return {};
}

}  // namespace swirl
