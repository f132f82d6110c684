// Figures the paper does not have, about what it leaves open: the kind of average, the transient
// without disc friction, and every parameter that it holds fixed.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "swirl/io/atomic_file.hpp"
#include "swirl/measure/cluster_rotation.hpp"
#include "swirl/paper/figures.hpp"
#include "swirl/paper/points.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/report.hpp"
#include "swirl/study/crossing_search.hpp"

namespace swirl {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

/// One curve ϖ(N) at other parameters than the paper's.
struct VariedCurve {
    std::string name;  // in keys and tables
    double value;      // of the parameter
    std::function<void(RunConfig&)> change;
};

/// "For each N between 5 and 48" (SI).
constexpr std::int64_t max_discs_of_the_paper = 48;

/// Half the events of the paper: many curves, and the error is small enough.
std::int64_t events_of_a_curve(const PaperSettings& settings) {
    return settings.events.value_or(settings.quick ? 100'000 : 500'000);
}

FigurePlan plan_curves(const PaperSettings& settings, const std::string& name,
                       const std::string& parameter, const std::vector<VariedCurve>& curves,
                       const std::vector<std::int64_t>& numbers) {
    FigurePlan plan;
    plan.script = "figure_" + name + ".py";
    struct Point {
        std::size_t curve;
        std::int64_t discs;
    };
    std::vector<Point> points;
    for (std::size_t c = 0; c < curves.size(); ++c)
        for (const std::int64_t n : numbers) {
            RunConfig config = paper_config(settings, high_friction, n);
            config.events = events_of_a_curve(settings);
            // Denser than in the paper, where states last longer and events are many: by periods.
            if (n > max_discs_of_the_paper) {
                config.warmup = settings.periods(settings.quick ? 20 : 40, 1);
                config.periods = *config.warmup + settings.periods(settings.quick ? 60 : 200, 3);
            }
            curves[c].change(config);
            points.push_back({c, n});
            const std::string length =
                config.periods ? fmt::format("{}of{}periods", *config.warmup, *config.periods)
                               : fmt::format("{}events", config.events);
            plan.points.push_back(varied_point(
                settings, fmt::format("{}_{}_N{}_{}", name, curves[c].name, n, length), config));
        }
    plan.finish = [=](const std::vector<Json>& results, const fs::path& out) {
        Table table(joined({"curve", parameter, "discs"}, rotation_columns()));
        FigureOutcome outcome;
        std::vector<NamedCurve> named;
        for (std::size_t c = 0; c < curves.size(); ++c) {
            NamedCurve curve{curves[c].name};
            for (std::size_t k = 0; k < points.size(); ++k) {
                if (points[k].curve != c) continue;
                std::vector<Table::Cell> row{curves[c].name, curves[c].value, points[k].discs};
                add_rotation(row, results[k]);
                table.add(std::move(row));
                curve.add(static_cast<double>(points[k].discs), results[k]);
            }
            outcome.findings.push_back(
                fmt::format("{} {}: {}", parameter, curves[c].name, crossing_sentence(curve)));
            named.push_back(std::move(curve));
        }
        outcome.files.push_back(out / ("figure_" + name + ".csv"));
        table.write(outcome.files.back());
        outcome.files.push_back(out / ("figure_" + name + "_crossings.csv"));
        write_crossings(named, outcome.files.back());
        return outcome;
    };
    return plan;
}

}  // namespace

// --- by event and by time -------------------------------------------------------------------

namespace {

/// Where the two averages differ most.
std::string farthest_apart(const Friction& friction, std::span<const Json> results) {
    double maximum = -1.0;
    std::string found = "no runs";
    for (const Json& r : results) {
        const RotationPoint event = rotation_point(0.0, r, "by_event"),
                            time = rotation_point(0.0, r, "by_time");
        if (!(std::fabs(event.mean - time.mean) > maximum)) continue;
        maximum = std::fabs(event.mean - time.mean);
        found = fmt::format("farthest apart at N = {}, ϖ/Ω = {} by event and {} by time",
                            number(at(r, {"config", "discs"})), with_error(event.mean, event.error),
                            with_error(time.mean, time.error));
    }
    return fmt::format("{} (μ_d = {}, μ_w = {}): {}.", friction.words, friction.mu_disc,
                       friction.mu_wall, found);
}

}  // namespace

static FigurePlan plan_figure_averages(const PaperSettings& settings) {
    FigurePlan plan = plan_figure_5b(settings);  // the same runs
    const auto table_of_5b = plan.finish;
    plan.script = "figure_averages.py";
    const std::size_t numbers = numbers_of_discs(settings).size();
    plan.finish = [table_of_5b, numbers](const std::vector<Json>& results, const fs::path& out) {
        FigureOutcome outcome = table_of_5b(results, out);
        // The table has the runs of one friction after those of the other, and then the densest.
        const fs::path table = out / "figure_averages.csv";
        write_file_atomically(table, read_whole_file(outcome.files.front()));
        outcome.files = {table};
        outcome.findings.clear();
        for (std::size_t f = 0; f < std::size(friction_coefficients_of_5b); ++f)
            outcome.findings.push_back(farthest_apart(
                friction_coefficients_of_5b[f], std::span(results).subspan(f * numbers, numbers)));
        return outcome;
    };
    return plan;
}

// --- the transient without disc friction ----------------------------------------------------

namespace {

constexpr int seeds_of_the_transient = 4;

/// One swirl after the other, from rest.
Json transient(const RunConfig& config, const RunControl& control) {
    Json json{{"varpi", Json::array()}, {"spin", Json::array()}, {"events", Json::array()}};
    Run run(config, control);
    SampleTimes times = run.sample_times(64);
    double rotation = 0.0, spin = 0.0, looks = 0.0, events = 0.0;
    while (run.next_event()) {
        while (run.next_sample(times)) {
            const Snapshot& s = run.snapshot();
            rotation += cluster_rotation(s).individual / config.omega();
            double sum = 0.0;
            for (const double one : s.spin) sum += one;
            spin += sum / static_cast<double>(s.size()) / config.omega();
            looks += 1.0;
        }
        run.pass_event();
        events += 1.0;
        if (run.snapshot().periods == run.event().periods) continue;
        json["varpi"].push_back(rotation / looks);
        json["spin"].push_back(spin / looks);
        json["events"].push_back(events);
        rotation = spin = looks = 0.0;
    }
    if (!run.complete()) throw Interrupted("Stopped.");
    return json;
}

}  // namespace

static FigurePlan plan_figure_transient(const PaperSettings& settings) {
    FigurePlan plan;
    plan.script = "figure_transient.py";
    const std::vector<std::int64_t> numbers =
        settings.quick ? std::vector<std::int64_t>{48} : std::vector<std::int64_t>{40, 44, 46, 48};
    const std::int64_t periods = settings.periods(settings.quick ? 200 : 600, 20);
    for (const std::int64_t n : numbers)
        for (int s = 0; s < seeds_of_the_transient; ++s) {
            RunConfig config = paper_config(settings, no_disc_friction, n);
            config.periods = periods;
            config.warmup = 0;
            config.seed += static_cast<std::uint64_t>(s);
            plan.points.push_back(PaperTask{
                fmt::format("transient_N{}_{}swirls_seed{}", n, periods, config.seed),
                expected_events_per_swirl(config) * static_cast<double>(periods),
                [config](const RunControl& control) { return transient(config, control); }});
        }
    plan.finish = [=](const std::vector<Json>& results, const fs::path& out) {
        Table table({"discs", "swirl", "varpi", "varpi_error", "spin", "spin_error", "events"});
        FigureOutcome outcome;
        for (std::size_t k = 0; k < numbers.size(); ++k) {
            double early = 0.0, late = 0.0, spin = 0.0, reached = not_available;
            for (std::int64_t t = 0; t < periods; ++t) {
                std::vector<double> varpi, spins;
                double events = 0.0;
                for (int s = 0; s < seeds_of_the_transient; ++s) {
                    const Json& one = results[k * seeds_of_the_transient + std::size_t(s)];
                    if (failed(one)) continue;
                    varpi.push_back(number(one["varpi"][std::size_t(t)]));
                    spins.push_back(number(one["spin"][std::size_t(t)]));
                    events += number(one["events"][std::size_t(t)]);
                }
                events /= static_cast<double>(varpi.size());
                const Estimate v = estimate_of(varpi), w = estimate_of(spins);
                table.add({numbers[k], t + 1, v.mean, v.error, w.mean, w.error, events});
                if (t < periods / 10) early += v.mean / static_cast<double>(periods / 10);
                if (t >= periods / 2) late += v.mean / static_cast<double>(periods - periods / 2);
                if (t + 1 == periods) spin = w.mean;
                if (std::isnan(reached) && events >= 1e6) reached = static_cast<double>(t + 1);
            }
            outcome.findings.push_back(fmt::format(
                "μ_d = 0, N = {}: ϖ/Ω = {:.3f} in the first {} swirls, {:.4f} in the last {}, when "
                "the mean spin is {} Ω; 10^6 events last {} swirls.",
                numbers[k], early, periods / 10, late, periods - periods / 2,
                with_error(spin, not_available),
                std::isnan(reached) ? fmt::format("more than {}", periods)
                                    : fmt::format("{:.0f}", reached)));
        }
        outcome.files.push_back(out / "figure_transient.csv");
        table.write(outcome.files.back());
        return outcome;
    };
    return plan;
}

// --- the crossing against the friction ------------------------------------------------------

static FigurePlan plan_figure_friction(const PaperSettings& settings) {
    FigurePlan plan;
    plan.script = "figure_friction.py";
    const std::vector<double> friction_coefficients =
        settings.quick ? std::vector<double>{0.1, 0.5, 1.0}
                       : std::vector<double>{0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 1.0, 2.0};
    for (const double mu : friction_coefficients) {
        CrossingSettings search;
        search.config = paper_config(settings, {"", "", mu, mu}, 48);
        search.config.events = settings.events.value_or(settings.quick ? 100'000 : 300'000);
        search.from = 20;
        search.to = numbers_beyond(settings).back();  // μ = 0.2 crosses beyond the paper's numbers
        search.tolerance = settings.quick ? 0.5 : 0.2;
        if (settings.quick) search.rounds = 1;
        plan.points.push_back(PaperTask{
            fmt::format("N_c_mu{}_{}events_seed{}", mu, search.config.events, settings.seed),
            40.0 * static_cast<double>(search.config.events), [search](const RunControl& control) {
                CrossingControl inner;
                inner.stop = control.stop;
                inner.threads = 1;
                const CrossingSearch found = search_crossing(search, inner);
                Json numbers = Json::array();
                for (const Crossing& c : found.crossings)
                    for (const double value : {c.discs, c.error, c.lower, c.upper})
                        numbers.push_back(value);
                const Crossing& c = found.crossing();
                return Json{{"crosses", c.verdict == Crossing::Verdict::crosses},
                            {"not_steady", found.not_steady},
                            {"discs", c.discs},
                            {"error", c.error},
                            {"lower", c.lower},
                            {"upper", c.upper},
                            {"by_rate", numbers},
                            {"events", found.events},
                            {"runs", found.runs},
                            {"report", crossing_report(search, found)}};
            }});
    }
    plan.finish = [=](const std::vector<Json>& results, const fs::path& out) {
        Table table(joined({"mu", "crosses", "crossing", "crossing_error", "lower", "upper", "runs",
                            "events", "runs_not_steady", "steady_state"},
                           rates_columns()));
        FigureOutcome outcome;
        for (std::size_t k = 0; k < friction_coefficients.size(); ++k) {
            const Json& r = results[k];
            if (failed(r)) continue;
            std::vector<Table::Cell> row{
                friction_coefficients[k],
                std::int64_t{r["crosses"].get<bool>()},
                number(r["discs"]),
                number(r["error"]),
                number(r["lower"]),
                number(r["upper"]),
                whole(r["runs"]),
                whole(r["events"]),
                whole(r["not_steady"]),
                std::string(r["not_steady"] == 0 ? "steady" : "not steady")};
            for (const Json& value : r["by_rate"]) row.emplace_back(number(value));
            table.add(std::move(row));
            outcome.findings.push_back(fmt::format("μ = {}: {}", friction_coefficients[k],
                                                   r["report"].get<std::string>()));
        }
        outcome.files.push_back(out / "figure_friction.csv");
        table.write(outcome.files.back());
        return outcome;
    };
    return plan;
}

// --- inertia, restitution, path -------------------------------------------------------------

static FigurePlan plan_figure_inertia(const PaperSettings& settings) {
    std::vector<VariedCurve> curves;
    for (const double inertia : {0.5, 1.0, 3.0, 10.0, 100.0, 1e4})
        curves.push_back({fmt::format("{}", inertia), inertia,
                          [inertia](RunConfig& c) { c.inertia = inertia; }});
    // Discs with an inertia that they can have cross beyond the paper's numbers, if at all.
    std::vector<std::int64_t> numbers = sparse_numbers(settings);
    for (const std::int64_t n : numbers_beyond(settings)) numbers.push_back(n);
    return plan_curves(settings, "inertia", "inertia", curves, numbers);
}

static FigurePlan plan_figure_restitution(const PaperSettings& settings) {
    std::vector<VariedCurve> curves;
    for (const double e : {1.0, 0.99, 0.9})
        curves.push_back({fmt::format("{}", e), e, [e](RunConfig& c) { c.restitution = e; }});
    return plan_curves(settings, "restitution", "restitution", curves, sparse_numbers(settings));
}

static FigurePlan plan_figure_tangential(const PaperSettings& settings) {
    std::vector<VariedCurve> curves;
    for (const double beta : {0.0, 0.5, 1.0})
        curves.push_back({fmt::format("{}", beta), beta, [beta](RunConfig& c) {
                              c.tangential_restitution = beta;
                              c.inertia = solid_inertia(c.mass, c.radius);
                          }});
    return plan_curves(settings, "tangential", "tangential_restitution", curves,
                       sparse_numbers(settings));
}

static FigurePlan plan_figure_polygon(const PaperSettings& settings) {
    FigurePlan plan;
    plan.script = "figure_polygon.py";
    const std::vector<int> sides = settings.quick
                                       ? std::vector<int>{6, 30, 300, 0}
                                       : std::vector<int>{6, 10, 20, 30, 60, 100, 300, 0};
    const std::vector<std::int64_t> numbers{28, 48};
    for (const std::int64_t n : numbers)
        for (const int m : sides) {
            RunConfig config = paper_config(settings, high_friction, n);
            // Corners are events too: swirls, not events, so that every path gets the same time.
            const std::int64_t periods =
                n == 28 ? (settings.quick ? 300 : 2000) : (settings.quick ? 60 : 300);
            config.periods = settings.periods(periods, 5);
            if (m > 0)
                config.sides = m;
            else
                config.path = PathShape::circle;
            plan.points.push_back(varied_point(
                settings, fmt::format("polygon_M{}_N{}_{}periods", m, n, *config.periods), config));
        }
    plan.finish = [=](const std::vector<Json>& results, const fs::path& out) {
        Table table(joined({"sides", "discs"}, rotation_columns()));
        FigureOutcome outcome;
        std::size_t k = 0;
        for (const std::int64_t n : numbers) {
            std::string sentence = fmt::format("N = {}: ϖ/Ω by time =", n);
            for (const int m : sides) {
                std::vector<Table::Cell> row{std::int64_t{m}, n};
                add_rotation(row, results[k]);
                table.add(std::move(row));
                const RotationPoint p = rotation_point(0.0, results[k], "by_time");
                sentence += fmt::format("{} {} on {}", m == sides.front() ? "" : ",",
                                        with_error(p.mean, p.error),
                                        m > 0 ? fmt::format("{} sides", m) : "the circle");
                ++k;
            }
            outcome.findings.push_back(sentence + ".");
        }
        outcome.files.push_back(out / "figure_polygon.csv");
        table.write(outcome.files.back());
        return outcome;
    };
    return plan;
}

// --- energy without any friction ------------------------------------------------------------

namespace {

/// Energy at the beginning of every swirl.
Json energy_series(const RunConfig& config, const RunControl& control) {
    Json json{{"energy", Json::array()}, {"invariant", Json::array()}};
    Run run(config, control);
    SampleTimes times = run.sample_times(1);
    while (run.next_event()) {
        while (run.next_sample(times)) {
            const Snapshot& s = run.snapshot();
            double K = 0.0, L = 0.0;
            for (std::size_t i = 0; i < s.size(); ++i) {
                const Disc d = s.disc(i);
                K += kinetic_energy(d);
                L += d.mass * cross(s.position(i), d.velocity) + d.inertia * d.spin;
            }
            json["energy"].push_back(K);
            json["invariant"].push_back(K - config.omega() * L);
        }
        run.pass_event();
    }
    if (!run.complete()) throw Interrupted("Stopped.");
    return json;
}

}  // namespace

static FigurePlan plan_figure_energy(const PaperSettings& settings) {
    FigurePlan plan;
    plan.script = "figure_energy.py";
    const std::int64_t discs = 28, periods = settings.periods(settings.quick ? 100 : 400, 10);
    const std::vector<int> sides{6, 30, 300, 0};
    const int seeds = settings.seeds();
    for (const int m : sides)
        for (int s = 0; s < seeds; ++s) {
            RunConfig config = paper_config(settings, {"", "", 0.0, 0.0}, discs);
            config.periods = periods;
            config.warmup = 0;
            config.seed += static_cast<std::uint64_t>(s);
            if (m > 0)
                config.sides = m;
            else
                config.path = PathShape::circle;
            plan.points.push_back(PaperTask{
                fmt::format("energy_M{}_N{}_{}swirls_seed{}", m, discs, periods, config.seed),
                3.0 * expected_events_per_swirl(config) * static_cast<double>(periods),
                [config](const RunControl& control) { return energy_series(config, control); }});
        }
    plan.finish = [=](const std::vector<Json>& results, const fs::path& out) {
        Table table({"sides", "discs", "seed", "swirl", "energy", "invariant"});
        FigureOutcome outcome;
        for (std::size_t k = 0; k < results.size(); ++k) {
            if (failed(results[k])) continue;
            const int m = sides[k / std::size_t(seeds)];
            const auto seed = static_cast<std::int64_t>(k % std::size_t(seeds)) + 1;
            const Json &energy = results[k]["energy"], &invariant = results[k]["invariant"];
            for (std::size_t t = 0; t < energy.size(); ++t)
                table.add({std::int64_t{m}, discs, seed, static_cast<std::int64_t>(t),
                           number(energy[t]), number(invariant[t])});
            if (seed > 1) continue;
            outcome.findings.push_back(fmt::format(
                "No friction at all, {}: in {} swirls the energy goes from {:.0f} to {:.0f}, and "
                "K − ΩL changes by {} (first seed).",
                m > 0 ? fmt::format("{} sides", m) : "the true circle", periods,
                number(energy.front()), number(energy.back()),
                with_error(number(invariant.back()) - number(invariant.front()), not_available)));
        }
        outcome.files.push_back(out / "figure_energy.csv");
        table.write(outcome.files.back());
        return outcome;
    };
    return plan;
}

// --- both frictions at once -----------------------------------------------------------------

namespace {

std::string lowest_of_the_map(const std::vector<std::pair<double, double>>& points,
                              const std::vector<Json>& results) {
    std::size_t lowest = points.size(), counterrotating = 0;
    RotationPoint minimum{};
    for (std::size_t k = 0; k < points.size(); ++k) {
        const RotationPoint p = rotation_point(0.0, results[k], "by_time");
        if (p.mean < -3.0 * p.error) ++counterrotating;
        if (!std::isfinite(p.mean) || (lowest < points.size() && p.mean >= minimum.mean)) continue;
        lowest = k;
        minimum = p;
    }
    if (lowest == points.size()) return "No run came to its end.";
    return fmt::format(
        "48 discs certainly counterrotate at {} of {} pairs of frictions; lowest is ϖ/Ω = {} at "
        "μ_d = {}, μ_w = {}.",
        counterrotating, points.size(), with_error(minimum.mean, minimum.error),
        points[lowest].first, points[lowest].second);
}

}  // namespace

static FigurePlan plan_figure_map(const PaperSettings& settings) {
    FigurePlan plan;
    plan.script = "figure_map.py";
    const std::vector<double> friction_coefficients =
        settings.quick ? std::vector<double>{0.0, 0.1, 0.3, 1.0}
                       : std::vector<double>{0.0, 0.02, 0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 1.0};
    std::vector<std::pair<double, double>> points;
    for (const double mu_disc : friction_coefficients)
        for (const double mu_wall : friction_coefficients) {
            if (mu_disc == 0.0 && mu_wall == 0.0) continue;  // no steady state there
            RunConfig config = paper_config(settings, {"", "", mu_disc, mu_wall}, 48);
            config.warmup = settings.periods(settings.quick ? 30 : 100, 2);
            config.periods = *config.warmup + settings.periods(settings.quick ? 60 : 200, 4);
            points.emplace_back(mu_disc, mu_wall);
            plan.points.push_back(
                varied_point(settings,
                             fmt::format("map_d{}_w{}_{}of{}periods", mu_disc, mu_wall,
                                         *config.warmup, *config.periods),
                             config));
        }
    plan.finish = [=](const std::vector<Json>& results, const fs::path& out) {
        Table table(joined({"mu_disc", "mu_wall", "discs"}, rotation_columns()));
        FigureOutcome outcome;
        for (std::size_t k = 0; k < points.size(); ++k) {
            std::vector<Table::Cell> row{points[k].first, points[k].second, std::int64_t{48}};
            add_rotation(row, results[k]);
            table.add(std::move(row));
        }
        outcome.findings.push_back(lowest_of_the_map(points, results));
        outcome.files.push_back(out / "figure_map.csv");
        table.write(outcome.files.back());
        return outcome;
    };
    return plan;
}

std::vector<PaperFigure> figures_beyond() {
    return {
        {"averages", "beyond the paper: by event and by time", plan_figure_averages},
        {"transient", "beyond the paper: spin and rotation from rest, μ_d = 0",
         plan_figure_transient},
        {"friction", "beyond the paper: the crossing N_c against μ", plan_figure_friction},
        {"inertia", "beyond the paper: moment of inertia ½ to 10⁴", plan_figure_inertia},
        {"restitution", "beyond the paper: restitution e = 1, 0.99, 0.9", plan_figure_restitution},
        {"tangential", "beyond the paper: tangential restitution, solid discs",
         plan_figure_tangential},
        {"polygon", "beyond the paper: the polygon's sides, and the true circle",
         plan_figure_polygon},
        {"energy", "beyond the paper: energy without any friction", plan_figure_energy},
        {"map", "beyond the paper: both frictions at N = 48", plan_figure_map}};
}

}  // namespace swirl
