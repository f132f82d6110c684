#include "swirl/run/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "swirl/run/config.hpp"

namespace swirl {
namespace {

std::string with_minus(const std::string& text) {
    return text.starts_with('-') ? "−" + text.substr(1) : text;
}

std::string with_error(const Estimate& e) { return swirl::with_error(e.mean, e.error); }

/// On the polygon, whose corners give more than they take.
bool gains_energy_for_ever(const RunConfig& c) {
    return c.conserves_energy() && c.amplitude > 0.0 && c.path == PathShape::polygon;
}

std::string energy_sentence(const RunResult& r) {
    const double growth = r.invariant - r.invariant_at_start;
    const double per_period = r.periods > 0.0 ? growth / r.periods : 0.0;
    if (r.config.path == PathShape::circle)
        return fmt::format(
            "Without friction on the true circle K − ΩL is conserved: it was {:.6g} at the start "
            "and "
            "changed by {:.1e}.",
            r.invariant_at_start, growth);
    return fmt::format(
        "Without friction the energy grows without bound on the polygon: from {:.4g} to {:.4g} in "
        "{:.1f} periods, {:.1f} times as much. K − ΩL, which a true circle (--path circle) would "
        "conserve, grew by {:.4g}, or {:.3g} per period; what depends on how fast the discs are "
        "has no steady state.",
        r.energy_at_start, r.energy, r.periods, r.energy / r.energy_at_start, growth, per_period);
}

/// "drifts from 0.33 to 1.00"; empty for a steady one.
std::string found_in(const SteadyState& steady) {
    const auto level = [](double value) { return with_minus(fmt::format("{:.3g}", value)); };
    const MeanChange& change = steady.change;
    switch (steady.verdict) {
        case SteadyState::Verdict::drifting:
            return fmt::format("drifts from {} to {}", level(change.before), level(change.after));
        case SteadyState::Verdict::jumping:
            return fmt::format("jumps at period {:.0f} from {} to {}", steady.period,
                               level(change.before), level(change.after));
        case SteadyState::Verdict::switching:
            return fmt::format("switches between two states, {} and {}, {} times",
                               level(steady.states.low), level(steady.states.high),
                               steady.states.changes);
        case SteadyState::Verdict::steady:
        case SteadyState::Verdict::too_short:
            break;
    }
    return {};
}

std::string not_steady_sentence(const RunResult& r) {
    const bool only_switches = r.steady_state() == SteadyState::Verdict::switching;
    return fmt::format("Not steady: {}. {}", steady_state_found(r),
                       only_switches ? "The average mixes both states. Use a longer run, or more "
                                       "seeds."
                                     : "Use a longer --warmup and a longer run.");
}

std::string no_swirl_sentence(const RunResult& r) {
    return fmt::format("The run made {:.2f} swirls{}; averages are over whole ones{}.", r.periods,
                       r.warmup > 0 ? fmt::format(", of which {} are warm-up", r.warmup) : "",
                       r.complete ? ", and more --events would be right" : "");
}

/// Nothing to be said of a single disc, which has no rotation about itself.
std::string too_short_sentence(const RunResult& r) {
    return fmt::format(
        "Too short to tell whether it is steady: {} periods after the warm-up, and it takes {}.",
        r.rotation.by_event.blocks, min_blocks_of_a_steady_state);
}

/// More than roundings of a place make: some 10⁻¹⁴ in the experiment's dish, 10⁻¹² at most.
constexpr double sunk = 1e-12;

bool sinks(const RunResult& r) {
    const RunConfig& c = r.config;
    return c.floor && c.contact_duration == 0.0 && r.max_overlap > sunk * c.radius;
}

std::string sunk_sentence(const RunResult& r) {
    return fmt::format(
        "Without a contact duration {}s that the floor drives along the wall hop on it ever lower, "
        "and "
        "sink into it by a rounding error with each hop: {:.1e} so far. A --contact-duration, "
        "1e-3 for example, would be right.",
        body_word(r.config), r.max_overlap);
}

std::string steady_text(const RunResult& r) {
    const bool is_energy_alone =
        r.steady_state() == SteadyState::Verdict::steady && gains_energy_for_ever(r.config);
    const std::string found =
        is_energy_alone ? "rotation and spins are, the energy is not" : verdict(r.steady_state());
    const MeanChange &rotation = r.steady.change, &spin = r.steady_spin.change;
    if (!std::isfinite(rotation.size) || !std::isfinite(spin.size)) return found;
    return fmt::format(
        "{}; largest change {:.1f} standard errors (limit {:.1f}), of the spins {:.1f} (limit "
        "{:.1f}); {:.2g} % of steady runs pass a limit",
        found, std::fabs(rotation.size), rotation.max_size, std::fabs(spin.size), spin.max_size,
        100.0 * (false_alarm_rate(rotation) + false_alarm_rate(spin)));
}

}  // namespace

std::string with_commas(std::uint64_t number) {
    std::string text;
    const std::string digits = std::to_string(number);
    for (std::size_t k = 0; k < digits.size(); ++k) {
        if (k > 0 && (digits.size() - k) % 3 == 0) text += ',';
        text += digits[k];
    }
    return text;
}

std::string with_error(double mean, double error) {
    if (std::isnan(mean)) return "not known";
    if (std::isnan(error) || error <= 0.0) return with_minus(fmt::format("{:.3g}", mean));
    if (error < 1e-9) return with_minus(fmt::format("{:.2g} ± {:.1g}", mean, error));
    // Two digits of an error that begins with 1, one of any other.
    const double exponent = std::floor(std::log10(error));
    const double leading = error / std::pow(10.0, exponent);
    const int digits = static_cast<int>((leading < 1.95 ? 1.0 : 0.0) - exponent);
    const int decimals = std::clamp(digits, 0, 12);
    return with_minus(fmt::format("{:.{}f} ± {:.{}f}", mean, decimals, error, decimals));
}

std::string sense_of_rotation(const Estimate& e) {
    if (std::isnan(e.mean)) return "have no rotation about their own centre";
    constexpr double rounding = 1e-12;
    const double uncertain = std::isnan(e.error) ? rounding : std::max(2.0 * e.error, rounding);
    if (std::fabs(e.mean) <= uncertain) return "stall";
    return e.mean > 0.0 ? "rotate" : "counterrotate";
}

std::string headline(const RunResult& r) {
    const Estimate& e = r.rotation.by_event;
    const char* const body = body_word(r.config);
    if (r.config.discs == 1)
        return fmt::format("1 {} has no rotation about its own centre of mass.", body);
    if (!r.has_whole_swirl())
        return fmt::format("{} {}s made no whole swirl{}, so nothing is averaged.", r.config.discs,
                           body, r.warmup > 0 ? " after the warm-up" : "");
    const std::string who = fmt::format("{} {}s {}", r.config.discs, body, sense_of_rotation(e));
    if (std::isnan(e.mean)) return who + ".";
    return fmt::format("{}: ϖ/Ω = {} by event, {} by time.", who, with_error(e),
                       with_error(r.rotation.by_time));
}

const char* verdict(SteadyState::Verdict verdict) {
    switch (verdict) {
        case SteadyState::Verdict::steady:
            return "steady";
        case SteadyState::Verdict::drifting:
            return "drifting";
        case SteadyState::Verdict::jumping:
            return "jumping";
        case SteadyState::Verdict::switching:
            return "switching";
        case SteadyState::Verdict::too_short:
            break;
    }
    return "too short to tell";
}

std::string steady_state_found(const RunResult& r) {
    std::string text;
    if (const std::string found = found_in(r.steady); !found.empty())
        text = "the rotation " + found;
    if (const std::string found = found_in(r.steady_spin); !found.empty())
        text += fmt::format("{}the mean spin {}", text.empty() ? "" : "; ", found);
    return text;
}

std::string report(const RunResult& r) {
    std::string text = headline(r) + "\n";
    const auto line = [&](std::string_view name, const std::string& value) {
        text += fmt::format("  {:<12}{}\n", name, value);
    };
    if (r.config.discs > 1 && r.has_whole_swirl()) {
        line("rigid", fmt::format("{} by event, {} by time", with_error(r.rotation.rigid_by_event),
                                  with_error(r.rotation.rigid_by_time)));
        line("errors",
             fmt::format("from {} blocks of whole periods, {:.0f} of them independent",
                         r.rotation.by_event.blocks, r.rotation.by_event.effective_samples));
    }
    const char* const body = body_word(r.config);
    line("events",
         fmt::format("{}: {} {}–{}, {} {}–wall, {} corners of the path{}",
                     with_commas(r.events.total()), with_commas(r.events.disc_disc), body, body,
                     with_commas(r.events.disc_wall), body, with_commas(r.events.path_vertex),
                     r.events.begins_to_roll == 0
                         ? ""
                         : fmt::format(", {} times one {}", with_commas(r.events.begins_to_roll),
                                       r.config.shape() == Shape::coin ? "stops on the floor"
                                       : r.config.rolling_resistance > 0.0
                                           ? "begins to roll or stops on the floor"
                                           : "begins to roll")));
    line("periods",
         fmt::format("{:.1f}; the first {} are warm-up{} and left out of the averages", r.periods,
                     r.warmup, r.config.warmup_found ? " (found automatically)" : ""));
    line("steady", steady_text(r));
    line("energy", fmt::format("{:.4g}; {:.4g} at the start", r.energy, r.energy_at_start));
    line("overlap", fmt::format("{:.1e} at most", r.max_overlap));
    line("state", fmt::format("{:016x} (seed {})", r.state_hash, r.config.seed));
    line("time", fmt::format("{:.2f} s, {:.2f} million events/s, {}", r.seconds,
                             r.events_per_second() / 1e6, r.simd));
    for (const std::string& warning : warnings(r)) text += warning + "\n";
    return text;
}

std::vector<std::string> warnings(const RunResult& r) {
    std::vector<std::string> all;
    if (!r.complete)
        all.push_back(
            fmt::format("Incomplete: stopped after {:.1f} periods and {} events, before its end.",
                        r.periods, with_commas(r.events.total())));
    if (!r.has_whole_swirl() && r.config.amplitude > 0.0) all.push_back(no_swirl_sentence(r));
    if (r.config.conserves_energy() && r.config.amplitude > 0.0)
        all.push_back(energy_sentence(r));
    else if (!steady_state_found(r).empty())
        all.push_back(not_steady_sentence(r));
    else if (r.steady.verdict == SteadyState::Verdict::too_short && r.config.discs > 1 &&
             r.has_whole_swirl())
        all.push_back(too_short_sentence(r));
    if (sinks(r)) all.push_back(sunk_sentence(r));
    return all;
}

}  // namespace swirl
