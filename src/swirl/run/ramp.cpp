#include "swirl/run/ramp.hpp"

#include <algorithm>

#include "swirl/run/config.hpp"

namespace swirl {

std::vector<double RunConfig::*> members_of(const std::string& name) {
    if (name == "mu") return {&RunConfig::mu_disc, &RunConfig::mu_wall};
    return {std::get<double RunConfig::*>(find_parameter(name)->member)};
}

double Ramp::value_in(std::int64_t period) const {
    if (period <= begin) return values.front();
    if (period >= end) return values.back();
    const auto steps = static_cast<std::int64_t>(values.size()) - 1;
    const std::int64_t length = end - begin, passed = (period - begin) * steps;
    const auto k = static_cast<std::size_t>(passed / length);
    const double share = static_cast<double>(passed % length) / static_cast<double>(length);
    return values[k] + share * (values[k + 1] - values[k]);
}

RunConfig in_period(const RunConfig& config, std::int64_t period) {
    RunConfig now = config;
    now.ramps.clear();
    for (const Ramp& ramp : config.ramps)
        for (const auto member : members_of(ramp.name)) now.*member = ramp.value_in(period);
    return now;
}

bool changes_in_period(const RunConfig& config, std::int64_t period) {
    return std::any_of(config.ramps.begin(), config.ramps.end(), [&](const Ramp& ramp) {
        return ramp.value_in(period) != ramp.value_in(period - 1);
    });
}

InitialState surroundings_in(const RunConfig& config, std::int64_t period) {
    RunConfig now = in_period(config, period);
    const Ramp* const amplitudes = config.ramp_of("amplitude");
    const bool rests_now_only = amplitudes && now.amplitude == 0.0 &&
                                std::any_of(amplitudes->values.begin(), amplitudes->values.end(),
                                            [](double amplitude) { return amplitude != 0.0; });
    if (!rests_now_only) return without_discs(now, make_path(now));
    // The number of path vertices must be the same in all periods (validate.hpp).
    RunConfig moving = now;
    moving.amplitude = 1.0;
    return without_discs(now, at_rest(make_path(moving)));
}

PeriodChange last_period_change(const RunConfig& config, std::int64_t periods) {
    PeriodChange last;
    const Ramp* const ramp = config.ramp_of("period");
    if (!ramp) return last;
    for (std::int64_t k = ramp->begin + 1; k <= std::min(periods, ramp->end); ++k) {
        const double before = ramp->value_in(k - 1);
        if (ramp->value_in(k) != before)
            last = {k, last.time + static_cast<double>(k - last.periods) * before};
    }
    return last;
}

std::int64_t end_of_ramps(const RunConfig& config) {
    std::int64_t end = 0;
    for (const Ramp& ramp : config.ramps) end = std::max(end, ramp.end);
    return end;
}

}  // namespace swirl
