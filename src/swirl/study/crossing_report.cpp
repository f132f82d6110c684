#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "swirl/run/failure.hpp"
#include "swirl/run/json.hpp"
#include "swirl/run/report.hpp"
#include "swirl/run/version.hpp"
#include "swirl/study/crossing_search.hpp"

namespace swirl {
namespace {

using Json = nlohmann::ordered_json;

/// "2 runs failed and are left out: 1 of 3 at N = 47, 1 of 3 at N = 48. Why: …", or nothing.
std::string failures_report(const CrossingSearch& search) {
    if (search.failures.empty()) return {};
    const std::int64_t failed = search.failed();
    std::string where;
    for (const FailedRuns& f : search.failures)
        where += fmt::format("{}{} of {} at N = {}", where.empty() ? "" : ", ", f.failed, f.runs,
                             f.discs);
    return fmt::format(" {} run{} failed and {} left out: {}. Why{}: {}", failed,
                       failed == 1 ? "" : "s", failed == 1 ? "is" : "are", where,
                       failed == 1 ? "" : ", of the first", search.first_failure);
}

Json change_json(const SignChange& change) {
    return {{"N", change.discs},
            {"N_error", change.error},
            {"N_lower", change.lower},
            {"N_upper", change.upper},
            {"from", change.before},
            {"to", change.after},
            {"sense", change.to_counterrotation ? "to counterrotation" : "to rotation"},
            {"undetermined", change.between}};
}

/// "discs" would be a number of a run's discs.
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

Json points_json(const CrossingSearch& s) {
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

/// Why the error is still above the tolerance.
std::string why_it_stopped(const CrossingSettings& settings, const CrossingSearch& search) {
    const Crossing& c = search.crossing();
    if (search.within_tolerance) return {};
    if (!c.last()->resolved())
        return fmt::format(
            " The search stopped there, since no run in between could be made, and --tolerance {} "
            "was not reached.",
            settings.tolerance);
    return fmt::format(
        " The search stopped before --tolerance {} was reached: {} times it made runs twice as "
        "long as the ones before. A larger --events would be right.",
        settings.tolerance, settings.rounds);
}

/// Points beyond N_c at which the curve may come back.
std::string what_may_follow(const Crossing& c) {
    const std::vector<double> beyond = c.undetermined_after();
    if (beyond.empty()) return {};
    return fmt::format(
        " The sign is undetermined at N = {}: a later change of sign is not excluded.",
        listed(beyond));
}

std::string verdict_report(const CrossingSettings& settings, const CrossingSearch& search) {
    if (search.points().empty())
        return fmt::format("Undecided: no run between N = {} and {} could be made.", settings.from,
                           settings.to);
    const Crossing& c = search.crossing();
    const auto lowest = std::min_element(
        search.points().begin(), search.points().end(),
        [](const RotationPoint& a, const RotationPoint& b) { return a.mean < b.mean; });
    const std::string evidence =
        fmt::format("between N = {:.0f} and {:.0f} the lowest is ϖ/Ω = {} at N = {:.0f}",
                    search.points().front().discs, search.points().back().discs,
                    with_error(lowest->mean, lowest->error), lowest->discs);
    const char* const words = rotation_rates[search.rate].description;
    switch (c.verdict) {
        case Crossing::Verdict::crosses:
            if (!c.last()->resolved())
                return fmt::format("N_c is {} ({}).{}{}", crossing_words(c), words,
                                   why_it_stopped(settings, search), what_may_follow(c));
            return fmt::format("N_c = {} (95 %: {:.1f} to {:.1f}; {}).{}{}", crossing_words(c),
                               c.lower, c.upper, words, why_it_stopped(settings, search),
                               what_may_follow(c));
        case Crossing::Verdict::always_rotates:
            return fmt::format("No crossing: the {}s always rotate; {}, {:.0f} errors above zero.",
                               body_word(settings.config), evidence, lowest->mean / lowest->error);
        case Crossing::Verdict::always_counterrotates:
            return fmt::format("No crossing: the {}s always counterrotate; {}.",
                               body_word(settings.config), evidence);
        case Crossing::Verdict::undecided:
            break;
    }
    return fmt::format(
        "Undecided: {}; the sign is undetermined at N = {}. More --events would be right.",
        evidence, listed(c.undetermined));
}

}  // namespace

std::size_t rate_named(const std::string& name) {
    std::string names;
    for (std::size_t r = 0; r < rotation_rates.size(); ++r) {
        if (name == rotation_rates[r].name) return r;
        names += fmt::format("{}{}",
                             r == 0                          ? ""
                             : r + 1 < rotation_rates.size() ? ", "
                                                             : " or ",
                             rotation_rates[r].name);
    }
    throw UsageError(fmt::format("--rate is '{}', but it must be {}.", name, names));
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

std::string change_place(const SignChange& change) {
    return change.resolved()
               ? fmt::format("at N = {}", change_words(change))
               : fmt::format("between N = {:g} and {:g}", change.before, change.after);
}

std::string crossing_words(const Crossing& crossing) {
    const SignChange* const change = crossing.last();
    return change ? change_words(*change) : verdict_word(crossing.verdict);
}

std::string other_rates_report(const Crossings& crossings, std::size_t without) {
    const bool some = std::any_of(crossings.begin(), crossings.end(),
                                  [](const Crossing& c) { return c.last() != nullptr; });
    std::string text;
    for (std::size_t r = 0; some && r < crossings.size(); ++r)
        if (r != without && crossings[r].points > 0)
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

std::string crossing_json(const CrossingSettings& settings, const CrossingSearch& s,
                          const std::string& command) {
    Json failures = Json::array();
    for (const FailedRuns& f : s.failures)
        failures.push_back({{"discs", f.discs}, {"failed", f.failed}, {"runs", f.runs}});
    Json json{{"rate", rotation_rates[s.rate].name}};
    json.update(crossing_json(s.crossing()));
    Json& by_rate = json["by_rate"];
    for (std::size_t r = 0; r < rotation_rates.size(); ++r)
        by_rate[rotation_rates[r].name] = crossing_json(s.crossings[r]);
    json.update({{"within_tolerance", s.within_tolerance},
                 {"tolerance", settings.tolerance},
                 {"points", points_json(s)},
                 {"runs", s.runs},
                 {"runs_not_steady", s.not_steady},
                 {"runs_too_short_to_tell", s.too_short},
                 {"numbers_whose_seeds_disagree", s.disagreeing},
                 {"runs_failed", failures},
                 {"first_failure", s.first_failure.empty() ? Json() : Json(s.first_failure)},
                 {"events", s.events},
                 {"seconds", s.seconds},
                 {"config", config_json(settings.config)},
                 {"command", command},
                 {"version", version()}});
    return json.dump(2) + "\n";
}

std::string other_crossings_report(const CrossingSearch& search) {
    const Crossing& c = search.crossing();
    std::string text;
    if (c.changes.size() > 1) {
        text = fmt::format(
            "ϖ(N) is not monotonic: its sign changes {} times between the numbers that were looked "
            "at (by more than three errors on either side); N_c is the last change to "
            "counterrotation:\n",
            c.changes.size());
        for (const SignChange& change : c.changes)
            text += fmt::format("  N = {:<14} to {}, between {:.0f} and {:.0f}\n",
                                change.resolved() ? change_words(change) : "not known",
                                change.to_counterrotation ? "counterrotation" : "rotation",
                                change.before, change.after);
    }
    if (c.verdict == Crossing::Verdict::crosses && !c.undetermined.empty())
        text += fmt::format("The sign is undetermined at N = {}.\n", listed(c.undetermined));
    return text;
}

std::string crossing_report(const CrossingSettings& settings, const CrossingSearch& search) {
    return verdict_report(settings, search) + other_rates_report(search.crossings, search.rate) +
           failures_report(search);
}

}  // namespace swirl
