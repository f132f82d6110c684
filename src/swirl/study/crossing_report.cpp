#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "swirl/run/failure.hpp"
#include "swirl/run/json.hpp"
#include "swirl/run/reading.hpp"
#include "swirl/run/report.hpp"
#include "swirl/run/version.hpp"
#include "swirl/study/collected_sweep.hpp"
#include "swirl/study/crossing.hpp"

namespace swirl {
namespace {

using Json = nlohmann::ordered_json;

/// "2 runs failed and are excluded: 1 of 3 at N = 47, 1 of 3 at N = 48. …", or nothing.
std::string failures_report(const CrossingResult& search) {
    if (search.failures.empty()) return {};
    const std::int64_t failed = search.failed();
    std::string where;
    for (const FailedRuns& f : search.failures)
        where += fmt::format("{}{} of {} at N = {}", where.empty() ? "" : ", ", f.failed, f.runs,
                             f.discs);
    return fmt::format(" {} run{} failed and {} excluded: {}. {}: {}", failed,
                       failed == 1 ? "" : "s", failed == 1 ? "is" : "are", where,
                       failed == 1 ? "The error" : "The first error", search.first_failure);
}

Json change_json(const SignChange& change) {
    return {{"N", change.discs},
            {"N_error", change.error},
            {"N_lower", change.lower},
            {"N_upper", change.upper},
            {"from", change.before},
            {"to", change.after},
            {"direction", change.to_counterrotation ? "to counterrotation" : "to rotation"},
            {"undetermined", change.between}};
}

/// The key for a number of discs is N, because "discs" is a parameter of a run.
Json crossing_json(const Crossing& c) {
    Json changes = Json::array();
    for (const SignChange& change : c.changes) changes.push_back(change_json(change));
    return {{"verdict", verdict_word(c.verdict)},
            {"N_c", c.discs},
            {"N_c_error", c.error},
            {"N_c_lower", c.lower},
            {"N_c_upper", c.upper},
            {"sign_changes", changes},
            {"undetermined", c.undetermined}};
}

Json points_json(const CrossingResult& s) {
    Json points = Json::array();
    for (std::size_t k = 0; k < s.points().size(); ++k) {
        Json point{{"discs", s.points()[k].discs},
                   {"mean", s.points()[k].mean},
                   {"error", s.points()[k].error},
                   {"runs", s.runs_made[k]}};
        for (std::size_t r = 0; r < rotation_rates.size(); ++r) {
            const std::string name = rotation_rates[r].name;
            point[name] = s.curves[r][k].mean;
            point[name + "_error"] = s.curves[r][k].error;
        }
        points.push_back(std::move(point));
    }
    return points;
}

/// Why the search stopped with an error above the tolerance.
std::string stop_reason(const CrossingSettings& settings, const CrossingResult& search) {
    if (search.within_tolerance) return {};
    if (search.stopped)
        return fmt::format(" The search was stopped before --tolerance {} was reached.",
                           settings.tolerance);
    if (!search.crossing().last()->resolved())
        return fmt::format(
            " The search stopped here because every run in between failed; --tolerance {} was not "
            "reached.",
            settings.tolerance);
    if (search.disagreeing > 0)
        return fmt::format(
            " The search stopped before --tolerance {} was reached: seeds differ by more than "
            "their "
            "errors, and the number of runs is limited.",
            settings.tolerance);
    return fmt::format(
        " The search stopped before --tolerance {} was reached, after {} batches of "
        "longer runs. Use more --events.",
        settings.tolerance, settings.rounds);
}

/// Points beyond N_c at which the curve may change its sign again.
std::string later_change_note(const Crossing& c) {
    const std::vector<double> beyond = c.undetermined_after();
    if (beyond.empty()) return {};
    return fmt::format(" The sign is undetermined at N = {}: a later change of sign is possible.",
                       listed(beyond));
}

/// "between N = 8 and 20 the lowest is ϖ/Ω = 0.21 ± 0.01 at N = 20"
std::string evidence(const CrossingResult& search, const char* which, const RotationPoint& point) {
    return fmt::format("between N = {:.0f} and {:.0f} the {} is ϖ/Ω = {} at N = {:.0f}",
                       search.points().front().discs, search.points().back().discs, which,
                       with_error(point.mean, point.error), point.discs);
}

std::string crossing_sentence(const CrossingSettings& settings, const CrossingResult& search) {
    const Crossing& c = search.crossing();
    const std::string rate = search.rate == default_rate
                                 ? ""
                                 : fmt::format(" ({})", rotation_rates[search.rate].description);
    const std::string remarks = stop_reason(settings, search) + later_change_note(c);
    if (!c.last()->resolved())
        return fmt::format("N_c is {}{}.{}", crossing_words(c), rate, remarks);
    return fmt::format("N_c = {}{}: fewer {}s rotate with the swirl, more rotate against it.{}",
                       crossing_words(c), rate, body_word(settings.config), remarks);
}

std::string verdict_report(const CrossingSettings& settings, const CrossingResult& search) {
    if (search.points().empty())
        return fmt::format("Undecided: every run between N = {} and {} failed.", settings.from,
                           settings.to);
    const Crossing& c = search.crossing();
    if (search.stopped && c.verdict != Crossing::Verdict::crosses)
        return "Undecided: the search was stopped before it found a change of direction.";
    // The rate nearest to zero decides.
    const auto [lowest, highest] = std::minmax_element(
        search.points().begin(), search.points().end(),
        [](const RotationPoint& a, const RotationPoint& b) { return a.mean < b.mean; });
    const char* const body = body_word(settings.config);
    switch (c.verdict) {
        case Crossing::Verdict::crosses:
            return crossing_sentence(settings, search);
        case Crossing::Verdict::always_rotates:
            return fmt::format(
                "No crossing: the {}s always rotate; {}, {:.0f} standard errors above zero.", body,
                evidence(search, "lowest", *lowest), lowest->mean / lowest->error);
        case Crossing::Verdict::always_counterrotates:
            return fmt::format(
                "No crossing: the {}s always counterrotate; {}, {:.0f} standard errors below zero.",
                body, evidence(search, "highest", *highest), -highest->mean / highest->error);
        case Crossing::Verdict::undecided:
            break;
    }
    return fmt::format("Undecided: {}; the sign is undetermined at N = {}. Use more --events.",
                       evidence(search, "lowest", *lowest), listed(c.undetermined));
}

}  // namespace

std::vector<std::string> rate_names() {
    std::vector<std::string> names;
    for (const RotationRate& rate : rotation_rates) names.emplace_back(rate.name);
    return names;
}

std::size_t rate_named(const std::string& name) {
    for (std::size_t r = 0; r < rotation_rates.size(); ++r)
        if (name == rotation_rates[r].name) return r;
    reject_choice("rate", name, rate_names());
}

const char* verdict_word(Crossing::Verdict verdict) {
    switch (verdict) {
        case Crossing::Verdict::crosses:
            return "crosses";
        case Crossing::Verdict::always_rotates:
            return "always rotates";
        case Crossing::Verdict::always_counterrotates:
            return "always counterrotates";
        case Crossing::Verdict::undecided:
            break;
    }
    return "undecided";
}

std::string listed(const std::vector<double>& discs) {
    return fmt::format("{:g}", fmt::join(discs, ", "));
}
std::string spaced(const std::vector<double>& discs) {
    return fmt::format("{:g}", fmt::join(discs, " "));
}

std::string change_words(const SignChange& change) {
    return change.resolved() ? with_error(change.discs, change.error)
                             : fmt::format("between {:g} and {:g}", change.before, change.after);
}

std::string change_location(const SignChange& change) {
    return change.resolved()
               ? fmt::format("at N = {}", change_words(change))
               : fmt::format("between N = {:g} and {:g}", change.before, change.after);
}

std::string crossing_words(const Crossing& crossing) {
    const SignChange* const change = crossing.last();
    return change ? change_words(*change) : verdict_word(crossing.verdict);
}

std::string other_rates_report(const Crossings& crossings, std::size_t excluded) {
    const bool any_crosses = std::any_of(crossings.begin(), crossings.end(),
                                         [](const Crossing& c) { return c.last() != nullptr; });
    std::string text;
    for (std::size_t r = 0; any_crosses && r < crossings.size(); ++r)
        if (r != excluded && crossings[r].points > 0)
            text += fmt::format("{}{} ({})", text.empty() ? " By the other rates: " : ", ",
                                crossing_words(crossings[r]), rotation_rates[r].description);
    return text.empty() ? text : text + ".";
}

std::vector<std::string> crossing_columns() {
    std::vector<std::string> columns{"rate",      "verdict",   "N_c",
                                     "N_c_error", "N_c_lower", "N_c_upper"};
    for (const RotationRate& rate : rotation_rates)
        for (const char* what : {"", "_error", "_lower", "_upper"})
            columns.push_back(fmt::format("N_c_{}{}", rate.name, what));
    columns.insert(columns.end(), {"sign_changes", "undetermined"});
    return columns;
}

void add_crossings(std::vector<Table::Cell>& row, const Crossings& crossings, std::size_t rate) {
    const auto add = [&](const Crossing& c) {
        for (const double value : {c.discs, c.error, c.lower, c.upper}) row.emplace_back(value);
    };
    row.emplace_back(std::string(rotation_rates[rate].name));
    row.emplace_back(std::string(verdict_word(crossings[rate].verdict)));
    add(crossings[rate]);
    for (const Crossing& crossing : crossings) add(crossing);
    row.emplace_back(std::int64_t(crossings[rate].changes.size()));
    row.emplace_back(spaced(crossings[rate].undetermined));
}

std::string crossing_json(const CrossingSettings& settings, const CrossingResult& s,
                          const std::string& command) {
    Json failures = Json::array();
    for (const FailedRuns& f : s.failures)
        failures.push_back({{"discs", f.discs}, {"failed", f.failed}, {"runs", f.runs}});
    Json json{{"rate", rotation_rates[s.rate].name}, {"from", settings.from}, {"to", settings.to}};
    json.update(crossing_json(s.crossing()));
    Json& by_rate = json["by_rate"];
    for (std::size_t r = 0; r < rotation_rates.size(); ++r)
        by_rate[rotation_rates[r].name] = crossing_json(s.crossings[r]);
    json.update({{"within_tolerance", s.within_tolerance},
                 {"tolerance", settings.tolerance},
                 {"points", points_json(s)},
                 {"runs", s.runs},
                 {"runs_not_steady", s.not_steady},
                 {"runs_too_short", s.too_short},
                 {"numbers_with_disagreeing_seeds", s.disagreeing},
                 {"runs_failed", failures},
                 {"first_failure", s.first_failure.empty() ? Json() : Json(s.first_failure)},
                 {"events", s.events},
                 {"seconds", s.seconds},
                 {"config", config_json(settings.config)},
                 {"command", command},
                 {"version", version()}});
    return json.dump(2) + "\n";
}

std::string other_crossings_report(const CrossingResult& search) {
    const Crossing& c = search.crossing();
    std::string text;
    if (c.changes.size() > 1) {
        text = fmt::format(
            "ϖ(N) is not monotonic: its sign changes {} times (by more than three errors on either "
            "side). N_c is the last change to counterrotation:\n",
            c.changes.size());
        for (const SignChange& change : c.changes)
            text += fmt::format("  N = {:<14} to {}, between {:.0f} and {:.0f}\n",
                                change.resolved() ? change_words(change) : "n/a",
                                change.to_counterrotation ? "counterrotation" : "rotation",
                                change.before, change.after);
    }
    if (c.verdict == Crossing::Verdict::crosses && !c.undetermined.empty())
        text += fmt::format("The sign is undetermined at N = {}.\n", listed(c.undetermined));
    return text;
}

std::vector<std::string> warnings(const CrossingResult& search) {
    std::vector<std::string> all;
    const char* const decisive = search.crossing().last() ? " that N_c depends on" : "";
    if (search.not_steady > 0)
        all.push_back(
            fmt::format("{} of the runs{} {} not steady after the warm-up.\nhint: use a "
                        "longer --warmup, or --warmup auto.",
                        search.not_steady, decisive, search.not_steady == 1 ? "was" : "were"));
    if (search.too_short > 0)
        all.push_back(fmt::format("steady state not verified for {} of the runs{}: too short.",
                                  search.too_short, decisive));
    if (search.disagreeing > 0)
        all.push_back(disagreement_warning(
            search.disagreeing,
            fmt::format("{} numbers of discs{}", search.decisive_numbers, decisive)));
    return all;
}

std::string crossing_report(const CrossingSettings& settings, const CrossingResult& search) {
    return verdict_report(settings, search) + failures_report(search);
}

std::string rigid_body_crossing(const CrossingResult& search) {
    const Crossing &c = search.crossing(), &rigid = search.crossings[rate_named("rigid_by_time")];
    const bool differs =
        std::fabs(c.discs - rigid.discs) > certain_sign * std::hypot(c.error, rigid.error);
    if (!differs) return "";
    return fmt::format("N_c = {}, another number than by the mean over the discs above",
                       crossing_words(rigid));
}

std::string nearest_points(const CrossingResult& search) {
    std::string text;
    const double zero = search.crossing().discs;
    for (const RotationPoint& p : search.points())
        if (std::fabs(p.discs - zero) < 1.0)
            text += fmt::format("{}{} at N = {:.0f}", text.empty() ? "ϖ/Ω = " : ", ",
                                with_error(p.mean, p.error), p.discs);
    return text;
}

}  // namespace swirl
