#include "swirl/run/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "swirl/run/config.hpp"
#include "swirl/run/path_parameter.hpp"
#include "swirl/run/ramp.hpp"
#include "swirl/run/reading.hpp"
#include "swirl/run/units.hpp"
#include "swirl/statistics/zero_crossing.hpp"

namespace swirl {
namespace {

std::string with_minus(const std::string& text) {
    return text.starts_with('-') ? "−" + text.substr(1) : text;
}

std::string with_error(const Estimate& e) { return swirl::with_error(e.mean, e.error); }

/// On straight segments, the vertices of the path add energy on average.
bool energy_grows_without_bound(const RunConfig& c) {
    return c.conserves_energy() && c.amplitude > 0.0 && c.path != PathShape::circle;
}

std::string energy_warning(const RunResult& r) {
    const double growth = r.invariant - r.invariant_at_start;
    const double per_period = r.periods > 0.0 ? growth / r.periods : 0.0;
    if (r.config.path == PathShape::circle)
        return fmt::format(
            "without friction, K − ΩL (kinetic energy K, angular momentum L) is conserved on the "
            "circle: it was {:.6g} at the start and changed by {:.1e}.",
            r.invariant_at_start, growth);
    if (!has_m_frame(r.config))
        return fmt::format(
            "without friction, the energy grows without bound on this path: from {:.4g} to {:.4g} "
            "in {:.1f} periods. Quantities that depend on the speed of the discs have no steady "
            "state.",
            r.energy_at_start, r.energy, r.periods);
    return fmt::format(
        "without friction, the energy grows without bound on the polygon: from {:.4g} to {:.4g} in "
        "{:.1f} periods, by a factor of {:.1f}. K − ΩL (kinetic energy K, angular momentum L), "
        "which is conserved on a circle (--motion circle), grew by {:.4g}, or {:.3g} per period. "
        "Quantities that depend on the speed of the discs have no steady state.",
        r.energy_at_start, r.energy, r.periods, r.energy / r.energy_at_start, growth, per_period);
}

/// "drifts from 0.33 to 1.00"; empty for a steady series.
std::string finding(const SteadyState& steady) {
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

std::string not_steady_warning(const RunResult& r) {
    const bool only_switches = r.steady_state() == SteadyState::Verdict::switching;
    return fmt::format("not steady: {}.{}", steady_state_found(r),
                       only_switches
                           ? " The average mixes both states.\nhint: use a longer run, or "
                             "more seeds."
                           : "\nhint: use a longer --warmup and a longer run.");
}

/// "the first 20 are"
std::string first_periods(std::int64_t count) {
    return count == 1 ? "the first is" : fmt::format("the first {} are", count);
}

std::string no_period_warning(const RunResult& r) {
    const char* const hint =
        r.config.periods ? "\nhint: use more --periods." : "\nhint: use more --events.";
    return fmt::format(
        "the run covers {:.2g} periods{}; averages are over whole periods, so there "
        "are none.{}",
        r.periods, r.warmup > 0 ? fmt::format(", and {} warm-up", first_periods(r.warmup)) : "",
        r.complete ? hint : "");
}

std::string too_short_warning(const RunResult& r) {
    const auto blocks = r.rotation.mean_by_event.blocks;
    const std::string length = counted(std::int64_t(blocks), "period");
    if (blocks < min_blocks_of_a_steady_state)
        return fmt::format("steady state not verified: {} after the warm-up; the test needs {}.",
                           length, min_blocks_of_a_steady_state);
    return fmt::format(
        "steady state not verified: {} after the warm-up, but so few independent ones that the "
        "test "
        "cannot distinguish a change from chance.\nhint: use --warmup auto and a longer run.",
        length);
}

/// Unit r. Rounding errors of positions are about 10⁻¹⁴ in the experiment's container and at
/// most 10⁻¹²; a larger overlap grew with the number of bounces.
constexpr double max_rounding_overlap = 1e-12;

bool sinks_into_the_wall(const RunResult& r) {
    const RunConfig& c = r.config;
    return c.floor && c.contact_duration == 0.0 && r.max_overlap > max_rounding_overlap;
}

std::string sinking_warning(const RunResult& r) {
    return fmt::format(
        "without a contact duration, {}s that the floor drives along the wall bounce ever lower "
        "and sink into it by a rounding error per bounce: {:.1e} r so far.\nhint: use a "
        "--contact-duration, such as 1e-3.",
        body_word(r.config), r.max_overlap);
}

std::string steady_text(const RunResult& r) {
    if (r.config.discs == 1) return "n/a";  // the test is on the rotation about the centre of mass
    switch (r.steady_state()) {
        case SteadyState::Verdict::steady:
            return energy_grows_without_bound(r.config)
                       ? "rotation and spins: no change larger than chance; the energy grows"
                       : "yes: no change larger than chance";
        case SteadyState::Verdict::too_short:
            return "not verified: the run is too short";
        default:
            return "no: " + steady_state_found(r);
    }
}

/// The evidence of the steady-state tests; empty if they were not made.
std::string changes_text(const RunResult& r) {
    const MeanChange &rotation = r.steady.change, &spin = r.steady_spin.change;
    if (!std::isfinite(rotation.size) || !std::isfinite(spin.size)) return "";
    return fmt::format(
        "largest of the rotation {:.1f} standard errors (limit {:.1f}), of the spins {:.1f} (limit "
        "{:.1f}); {:.2g} % of steady runs exceed a limit",
        std::fabs(rotation.size), rotation.max_size, std::fabs(spin.size), spin.max_size,
        100.0 * (false_alarm_rate(rotation) + false_alarm_rate(spin)));
}

/// False if a longer run may show another direction of rotation, or that there is one.
bool is_direction_known(const Estimate& e) {
    constexpr std::size_t min_blocks = 5;  // fewer hardly determine the error itself
    if (e.blocks < min_blocks) return false;
    return direction_of(e) != 0 || e.blocks >= min_blocks_of_a_steady_state;
}

std::string ramp_warning(const RunResult& r) {
    std::string text =
        "the averages mix all values of the ramp.\nhint: --series FILE.csv writes the "
        "averages of each period.";
    if (r.periods <= static_cast<double>(end_of_ramps(r.config)))
        text = fmt::format(
            "the run ended after {:.1f} periods, but its ramp has its last value in period {}, "
            "which begins after {} periods; {}",
            r.periods, end_of_ramps(r.config), end_of_ramps(r.config), text);
    return text;
}

std::string average_text(const RunResult& r) {
    const std::string length = counted(std::int64_t(std::floor(r.periods)) - r.warmup, "period");
    if (r.warmup == 0) return length + ", no warm-up";
    return fmt::format("{} after a warm-up of {}{}", length, r.warmup,
                       r.config.warmup_found ? " (found automatically)" : "");
}

/// The events at which a particle changes its motion on the floor; empty if there are none.
std::string floor_events_text(const RunResult& r) {
    if (r.events.begins_to_roll == 0) return "";
    const char* const transition = r.config.shape() == Shape::coin     ? "stops on the floor"
                                   : r.config.rolling_resistance > 0.0 ? "starts of rolling and "
                                                                         "stops on the floor"
                                                                       : "starts of rolling";
    return fmt::format(", {} {}", with_commas(r.events.begins_to_roll), transition);
}

std::string events_text(const RunResult& r) {
    const char* const body = body_word(r.config);
    return fmt::format("{}: {} {}–{}, {} {}–wall, {} {} of the path{}",
                       with_commas(r.events.total()), with_commas(r.events.disc_disc), body, body,
                       with_commas(r.events.disc_wall), body, with_commas(r.events.path_vertex),
                       r.events.path_vertex == 1 ? "vertex" : "vertices", floor_events_text(r));
}

/// g in r and the container's speed v; g itself in a container at rest.
double gravity_ratio(const RunConfig& c) {
    const double v = c.amplitude * c.omega();
    return v > 0.0 ? c.gravity * c.radius / (v * v) : c.gravity;
}

/// The dish and its rotation in the user's units; empty if the run has none.
std::string units_lines(const RunResult& r, bool has_averages) {
    const auto units = user_units(r.config);
    if (!units) return "";
    std::string text = report_line("dish", dish_in_units(r.config, *units));
    const double rate = std::fabs(r.rotation.mean_by_time.mean);
    if (!has_averages || direction_of(r.rotation.mean_by_time) == 0) return text;
    return text + report_line("one turn", fmt::format("{:.3g} periods, {:.3g} s", 1.0 / rate,
                                                      r.config.period * units->time / rate));
}

/// The lines that only --verbose prints.
std::string details(const RunResult& r) {
    std::string text;
    const RotationEstimates& e = r.rotation;
    if (r.config.discs > 1 && r.has_whole_period()) {
        text += report_line("by time",
                            fmt::format("{} mean over the discs, {} rigid body",
                                        with_error(e.mean_by_time), with_error(e.rigid_by_time)));
        text += report_line("by event",
                            fmt::format("{} mean over the discs, {} rigid body",
                                        with_error(e.mean_by_event), with_error(e.rigid_by_event)));
        text += report_line(
            "errors", fmt::format("from {} blocks of whole periods, {:.0f} of them independent",
                                  e.mean_by_time.blocks, e.mean_by_time.effective_samples));
    }
    if (const std::string changes = changes_text(r); r.config.ramps.empty() && !changes.empty())
        text += report_line("changes", changes);
    text += report_line("events", events_text(r));
    text += report_line("periods", fmt::format("{:.1f}", r.periods));
    text += report_line("energy",
                        fmt::format("{:.4g}; {:.4g} at the start", r.energy, r.energy_at_start));
    text += report_line("overlap", fmt::format("{:.1e} at most", r.max_overlap));
    return text + report_line("time", fmt::format("{:.2f} s, {:.2f} million events/s, {}",
                                                  r.seconds, r.events_per_second() / 1e6, r.simd));
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
    if (!std::isfinite(mean)) return "n/a";
    // A constant has an error of rounding only.
    if (!std::isfinite(error) || error <= 1e-14 * std::fabs(mean))
        return with_minus(fmt::format("{:.3g}", mean));
    if (error < 1e-9) return with_minus(fmt::format("{:.2g} ± {:.1g}", mean, error));
    // Two digits for an error that begins with 1, one for any other.
    const double exponent = std::floor(std::log10(error));
    const double leading = error / std::pow(10.0, exponent);
    const int digits = static_cast<int>((leading < 1.95 ? 1.0 : 0.0) - exponent);
    const int decimals = std::clamp(digits, 0, 12);
    return with_minus(fmt::format("{:.{}f} ± {:.{}f}", mean, decimals, error, decimals));
}

std::string series_text(const PeriodSeries& series) {
    const std::vector<SeriesAverage> averages = series.averages();
    std::string text =
        fmt::format("  series of {} periods; correlation times in periods:\n", series.periods());
    for (const SeriesAverage& a : averages) {
        if (std::isnan(a.autocorrelation_time)) continue;
        text +=
            fmt::format("  {:<38}τ = {:.3g}, {:.0f} effective samples of {}\n", a.name,
                        a.autocorrelation_time, a.estimate.effective_samples, a.estimate.blocks);
    }
    text += "  fluctuations of the means of the periods:\n";
    const auto text_of = [](const Estimate& e) { return with_error(e.mean, e.error); };
    for (const SeriesAverage& a : std::span(averages).first(rotation_rates.size()))
        text += fmt::format("  {:<38}N var = {} Ω², skewness {}, Binder cumulant {}\n", a.name,
                            text_of(scaled(a.fluctuations.variance, series.discs())),
                            text_of(a.fluctuations.skewness), text_of(a.fluctuations.binder));
    return text;
}

const char* turning(bool clockwise) {
    return clockwise ? "rotate clockwise" : "rotate counter-clockwise";
}

int direction_of(const Estimate& e) {
    constexpr double rounding = 1e-12;
    const double resolution = std::isnan(e.error) ? rounding : std::max(2.0 * e.error, rounding);
    return e.mean > resolution ? 1 : e.mean < -resolution ? -1 : 0;
}

std::string rotation_words(const Estimate& e, bool with_a_swirl, bool clockwise) {
    if (std::isnan(e.mean)) return "have no rotation about their own centre";
    switch (direction_of(e)) {
        case 1:
            return with_a_swirl ? "rotate with the swirl" : turning(clockwise);
        case -1:
            return with_a_swirl ? "rotate against the swirl (counterrotation)"
                                : turning(!clockwise);
        default:
            return "stall, no rotation beyond the error";
    }
}

std::string report_line(std::string_view name, const std::string& value) {
    return fmt::format("  {:<12}{}\n", name, value);
}

std::string rigid_body_line(const RotationEstimates& e) {
    const Estimate &mean = e.mean_by_time, &rigid = e.rigid_by_time;
    // Both are from the same run, so the error of their difference is at most this.
    const bool differs =
        std::fabs(rigid.mean - mean.mean) > certain_sign * std::hypot(mean.error, rigid.error);
    if (!differs) return "";
    return report_line("rigid body", fmt::format("ϖ/Ω = {}, another rate than the mean over the "
                                                 "discs above",
                                                 with_error(rigid)));
}

std::string headline(const RunResult& r) {
    const Estimate e = r.rotation.mean_by_time;
    const char* const body = body_word(r.config);
    if (r.config.discs == 1)
        return fmt::format("1 {} has no rotation about its own centre of mass.", body);
    if (!r.has_whole_period())
        return fmt::format("{} {}s completed no whole period{}, so there are no averages.",
                           r.config.discs, body, r.warmup > 0 ? " after the warm-up" : "");
    const std::string motion =
        fmt::format("{} {}s {}", r.config.discs, body,
                    rotation_words(e, has_m_frame(r.config), r.config.turns_clockwise()));
    if (std::isnan(e.mean)) return motion + ".";
    const std::string rate = "ϖ/Ω = " + with_error(e);
    if (!r.config.ramps.empty())
        return fmt::format("{} {}s in a ramp, {}: on average {}", r.config.discs, body,
                           ramps_text(r.config.ramps), rate);
    if (!is_direction_known(e))
        return fmt::format("{} {}s: {}; {} too few to determine the direction of rotation",
                           r.config.discs, body, rate,
                           e.blocks == 1 ? "1 period is" : fmt::format("{} periods are", e.blocks));
    return fmt::format("{}: {}", motion, rate);
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
    if (const std::string rotation = finding(r.steady); !rotation.empty())
        text = "the rotation " + rotation;
    if (const std::string spin = finding(r.steady_spin); !spin.empty())
        text += fmt::format("{}the mean spin {}", text.empty() ? "" : "; ", spin);
    return text;
}

std::string rounded_share_text(const RunConfig& c) {
    if (!c.mixture || !c.mixture->percent) return "";
    return fmt::format("{} of {} {}s have radius {}: {} %, rounded to whole {}s", c.mixture->count,
                       c.discs, body_word(c), c.mixture->radius, *c.mixture->percent, body_word(c));
}

std::string report(const RunResult& r, bool verbose) {
    std::string text = headline(r) + "\n";
    const bool has_averages = r.config.discs > 1 && r.has_whole_period();
    if (has_averages && !has_m_frame(r.config))
        text += report_line(
            "Ω", fmt::format("2π/T, only a unit, because this path has no M-frame; ϖ > 0 is {}",
                             r.config.turns_clockwise() ? "clockwise" : "counter-clockwise"));
    text += units_lines(r, has_averages);
    if (r.config.floor)
        text += report_line("floor", fmt::format("μ_f = {}, g r/v² = {:.4g}",
                                                 r.config.floor_friction, gravity_ratio(r.config)));
    if (const std::string rounded = rounded_share_text(r.config); !rounded.empty())
        text += report_line("mixture", rounded);
    if (has_averages) text += rigid_body_line(r.rotation);
    if (r.has_whole_period()) text += report_line("average", average_text(r));
    if (r.config.ramps.empty()) text += report_line("steady", steady_text(r));
    text += report_line("repeat", fmt::format("seed {} gives final state {:016x} on every machine",
                                              r.config.seed, r.state_hash));
    return verbose ? text + details(r) : text;
}

std::string warning_lines(const RunResult& r) {
    std::string text;
    for (const std::string& warning : warnings(r)) text += "warning: " + warning + "\n";
    return text;
}

std::vector<std::string> warnings(const RunResult& r) {
    std::vector<std::string> all;
    if (!r.complete)
        all.push_back(fmt::format("incomplete: stopped after {:.1f} periods and {} events.",
                                  r.periods, with_commas(r.events.total())));
    if (!r.has_whole_period() && r.config.amplitude > 0.0) all.push_back(no_period_warning(r));
    if (!r.config.ramps.empty())
        all.push_back(ramp_warning(r));
    else if (r.config.conserves_energy() && r.config.amplitude > 0.0)
        all.push_back(energy_warning(r));
    else if (!steady_state_found(r).empty())
        all.push_back(not_steady_warning(r));
    else if (r.steady_state() == SteadyState::Verdict::too_short && r.config.discs > 1 &&
             r.has_whole_period())
        all.push_back(too_short_warning(r));
    if (sinks_into_the_wall(r)) all.push_back(sinking_warning(r));
    return all;
}

}  // namespace swirl
