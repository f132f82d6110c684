// swirl dish: from the sizes of a laboratory dish to the options of a run and its N_c.
#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <set>

#include "swirl/cli/commands.hpp"
#include "swirl/cli/output.hpp"
#include "swirl/cli/progress_line.hpp"
#include "swirl/cli/run_options.hpp"
#include "swirl/cli/stop_signal.hpp"
#include "swirl/cli/sweep_options.hpp"
#include "swirl/cli/sweep_tables.hpp"
#include "swirl/engine/placement.hpp"
#include "swirl/run/config.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/json.hpp"
#include "swirl/run/report.hpp"
#include "swirl/run/shell_word.hpp"
#include "swirl/run/units.hpp"
#include "swirl/study/crossing.hpp"
#include "swirl/study/own_points.hpp"
#include "swirl/study/point_table.hpp"
#include "swirl/study/sweep.hpp"

namespace swirl {
namespace {

/// One friction coefficient for all contacts, fitted to the paper's smooth spheres, and its preset.
constexpr const char* preset_of_spheres = "experiment";
constexpr double search_tolerance = 0.5;

struct DishCall {
    std::shared_ptr<ParameterTexts> parameters;
    std::string rpm, json, my_points, out;
    std::optional<std::int64_t> from, to;
    double tolerance = search_tolerance;
    std::int64_t replicates = 2;
    ShareOptions sharing;
    bool no_search = false, quiet = false;
};

bool has_spheres(const ParameterTexts& given) {
    const auto body = given.find("body");
    return body == given.end() || body->second == "sphere";
}

/// The parameters of the run: those of the experiment, except what is given.
ParameterTexts dish_parameters(const DishCall& call) {
    ParameterTexts given = *call.parameters;
    if (!call.rpm.empty()) {
        if (given.contains("period"))
            throw UsageError("--rpm and --period are both given.\nhint: omit one of the two.");
        const std::string unit = call.rpm.ends_with("rpm") ? "" : "rpm";
        given["period"] = call.rpm + unit;
    }
    if (!given.contains("preset"))
        for (const char* name : {"container_radius", "radius", "amplitude", "period"})
            if (!given.contains(name) &&
                !(name == std::string("period") && given.contains("speed")))
                throw UsageError(fmt::format(
                    "missing option {} {}.",
                    name == std::string("period") ? "--rpm" : option_name(name),
                    name == std::string("period") ? "78" : "NUMBER with a unit, such as 8mm"));
    given.try_emplace("discs", "2");  // every container holds so many
    if (!has_spheres(given)) return given;
    given.try_emplace("preset", preset_of_spheres);
    if (const auto mu = given.find("mu"); mu != given.end())
        given.try_emplace("floor_friction", mu->second);
    return given;
}

/// The options that make this configuration from a preset or from the defaults.
ParameterTexts options_of(const RunConfig& config) {
    const bool spheres = config.body == Shape::sphere && config.floor;
    ParameterTexts base;
    if (spheres) base["preset"] = preset_of_spheres;
    const ParameterTexts of_base = texts_of(resolve(base)), wanted = texts_of(config);
    ParameterTexts options = base;
    for (const auto& [name, text] : wanted) {
        const auto same = of_base.find(name);
        if (name == "discs" || name == "seed" || name == "events" || name == "periods") continue;
        if (same == of_base.end() || same->second != text) options[name] = text;
    }
    return options;
}

std::string option_text(const ParameterTexts& options) {
    std::string text;
    for (const Parameter& p : run_parameters)
        if (const auto found = options.find(p.name); found != options.end())
            text += fmt::format(" {} {}", option_name(p.name), shell_word(found->second));
    return text;
}

/// The dimensionless numbers of a dish.
struct DishNumbers {
    double container, amplitude, amplitude_ratio, gravity, froude;
};
DishNumbers numbers_of(const RunConfig& c) {
    const double v = c.amplitude * c.omega();
    return {c.container_radius / c.radius, c.amplitude / c.radius, c.amplitude / c.container_radius,
            c.gravity * c.radius / (v * v), c.omega() * c.omega() * c.amplitude / c.gravity};
}

std::string ratios_text(const RunConfig& c) {
    const DishNumbers n = numbers_of(c);
    std::string text = fmt::format("R/r = {:.4g}, A/r = {:.4g}, A/R = {:.3g}", n.container,
                                   n.amplitude, n.amplitude_ratio);
    if (c.floor) text += fmt::format(", g r/v² = {:.4g}, AΩ²/g = {:.3g}", n.gravity, n.froude);
    return text;
}

std::string friction_text(const RunConfig& c) {
    std::string text = fmt::format("μ = {}", c.mu_disc);
    if (c.mu_wall != c.mu_disc) text += fmt::format(" (wall {})", c.mu_wall);
    if (c.floor && c.floor_friction != c.mu_disc)
        text += fmt::format(" (floor {})", c.floor_friction);
    return text + fmt::format(", e = {}", c.restitution);
}

std::int64_t most_known(const RunConfig& c) {
    if (const auto known = discs_in_densest_known_arrangement(c.radius, c.container_radius))
        return *known;
    return std::int64_t(max_discs_in_container(c.radius, c.container_radius));
}

CrossingSettings settings_of(const DishCall& call, const RunConfig& config) {
    CrossingSettings settings;
    settings.config = config;
    settings.config.events = *read_whole_number(default_search_events);
    settings.config.periods.reset();
    settings.tolerance = call.tolerance;
    settings.from = call.from.value_or(settings.from);
    settings.to_is_default = !call.to;
    settings.to = call.to.value_or(settings.to);
    fit_range(settings);
    return settings;
}

CrossingResult search(const DishCall& call, const CrossingSettings& settings) {
    ProgressLine line("N_c", call.quiet);
    CrossingControl control;
    control.stop = &stop_signal();
    control.threads = call.sharing.share().threads;
    double done = 0.0;
    control.progress = [&](const std::string& stage, double rate) {
        constexpr double half = 20.0;  // runs
        done += 1.0;
        line.show(done / (half + done), fmt::format("{}, {} events/s", stage, short_number(rate)));
    };
    return search_crossing(settings, control);
}

/// "swirl run …" with the values as given, and in multiples of r and v.
struct DishCommands {
    std::string as_given, in_ratios;
};
DishCommands commands_of(const ParameterTexts& given, const RunConfig& config) {
    const std::string number = fmt::format(" --discs {}", config.discs);
    return {"swirl run" + option_text(given) + number,
            "swirl run" + option_text(options_of(config)) + number};
}

nlohmann::ordered_json dish_json(const RunConfig& config, const DishCommands& commands,
                                 const CrossingSettings& settings) {
    const DishNumbers n = numbers_of(config);
    nlohmann::ordered_json json{
        {"R/r", n.container}, {"A/r", n.amplitude}, {"A/R", n.amplitude_ratio}};
    if (config.floor) json.update({{"g r/v2", n.gravity}, {"A Omega2/g", n.froude}});
    json["config"] = config_json(config);
    json["command"] = commands.as_given;
    json["command_in_ratios"] = commands.in_ratios;
    json["fits"] = most_known(config);
    json["fits_easily"] = settings.to;
    return json;
}

/// One run for each friction coefficient, number of particles and seed: the parameters of all, and
/// a row for each pair.
SweepPlan plan_beside_points(const DishCall& call, const RunConfig& config,
                             const std::vector<RotationPoint>& points) {
    constexpr const char* friction_coefficients = "0.1:0.1:0.8";
    const auto mu = call.parameters->find("mu"), periods = call.parameters->find("periods");
    const auto none = call.parameters->end();
    const bool floor_follows = config.floor && !call.parameters->contains("floor_friction");
    ParameterTexts common = options_of(config);
    for (const char* name : {"mu", "mu_disc", "mu_wall"}) common.erase(name);
    if (floor_follows) common.erase("floor_friction");
    common["periods"] = periods == none ? std::to_string(experiment_periods) : periods->second;
    std::set<std::int64_t> numbers;
    for (const RotationPoint& point : points) numbers.insert(std::int64_t(point.discs));
    std::vector<PointRow> rows;
    for (const std::string& coefficient :
         list_of_values("mu", mu == none ? friction_coefficients : mu->second))
        for (const std::int64_t discs : numbers) {
            ParameterTexts cells{{"discs", std::to_string(discs)}, {"mu", coefficient}};
            if (floor_follows) cells["floor_friction"] = coefficient;
            rows.push_back(point_row(fmt::format("{} particles", discs), cells, call.replicates));
        }
    return make_plan(rows, common);
}

SweepOutcome run_with_progress(const DishCall& call, const SweepPlan& plan) {
    ProgressLine line(fmt::format("{} runs", plan.points()), call.quiet);
    SweepControl control;
    control.stop = &stop_signal();
    control.progress = [&](double done, double total, std::uint64_t events) {
        line.show_events(total > 0.0 ? done / total : 1.0, events);
    };
    return run_sweep(call.out, plan, call.sharing.share(), control);
}

/// Runs the dish at the numbers of the points for several friction coefficients, and draws both.
void compare_with_points(const DishCall& call, ParameterTexts given) {
    if (call.out.empty())
        throw UsageError("--my-points is given, but --out, the folder for the runs, is not.");
    validate_whole_number("--replicates", call.replicates, 1, max_replicas);
    if (const auto mu = given.find("mu"); mu != given.end()) {
        mu->second = list_of_values("mu", mu->second).front();
        if (!call.parameters->contains("floor_friction")) given.erase("floor_friction");
    }
    const RunConfig config = resolve(given);
    std::optional<double> period;
    if (const auto units = user_units(config)) period = config.period * units->time;
    const std::vector<RotationPoint> points = read_own_points(call.my_points, period);
    const SweepPlan plan = plan_beside_points(call, config, points);
    make_folder(call.out);
    write_plan(call.out, plan);
    const SweepOutcome outcome = run_with_progress(call, plan);
    if (outcome.stopped)
        throw Interrupted("stopped before the end.\nhint: repeat the call to continue.");
    if (outcome.failed > 0)
        throw Failure(fmt::format("{} of the runs failed, the first at {}", outcome.failed,
                                  outcome.first_failure));
    draw_sweep(call.out, call.my_points, call.quiet);
}

void describe_dish(DishCall& call) {
    ParameterTexts given = dish_parameters(call);
    if (!call.my_points.empty()) return compare_with_points(call, std::move(given));
    RunConfig config = resolve(given);
    const CrossingSettings settings = settings_of(call, config);
    given.erase("discs");
    if (!call.parameters->contains("discs")) config.discs = settings.to;
    const DishCommands commands = commands_of(given, config);
    const char* const body = body_word(config);
    std::string text;
    if (const auto units = user_units(config))
        text += report_line("dish", dish_in_units(config, *units));
    text += report_line("ratios", ratios_text(config));
    text += report_line("friction", friction_text(config));
    text += report_line("fits", fmt::format("at most {} {}s; {} without a search for their places",
                                            most_known(config), body, settings.to));
    text += report_line("run", commands.as_given);
    text += report_line("in ratios", commands.in_ratios);
    nlohmann::ordered_json json = dish_json(config, commands, settings);
    if (!call.quiet && call.json != "-") print_all(text);
    if (!call.no_search) {
        const CrossingResult found = search(call, settings);
        if (call.json != "-")
            print_all(report_line("N_c", crossing_report(settings, found) +
                                             fmt::format(" ({})", friction_text(config))));
        for (const std::string& warning : warnings(found)) print_warning(warning);
        json["crossing"] = nlohmann::ordered_json::parse(crossing_json(settings, found, ""));
    }
    if (!call.json.empty() && call.json != "-") write_output(call.json, json.dump(2) + "\n");
    if (call.json == "-") print_all(json.dump(2) + "\n");
}

void add_dish_command(Subcommand& subcommand) {
    const auto call = std::make_shared<DishCall>();
    call->parameters = add_run_options(
        subcommand, {"events", "ramp", "initial", "length_unit", "time_unit", "events_per_sample"});
    subcommand.in("Container")
        .add({{"--rpm", &call->rpm, "Turns of the dish per minute; replaces --period", "NUMBER"}});
    subcommand.in("N_c").add({
        {"--no-search", &call->no_search, "Do not search for N_c"},
        {"--tolerance", &call->tolerance, "Target standard error of N_c [0.5]", "NUMBER"},
        {"--from", &call->from, "Smallest number of the search [5]", "N"},
        {"--to", &call->to, "Largest number of the search [48, at most what fits]", "N"},
        threads_option(call->sharing),
    });
    subcommand.in("My points")
        .add({
            {"--my-points", &call->my_points, "Your table of N, turns, circles, to compare with",
             "FILE.csv"},
            {"--out", &call->out, "Folder for the runs; a repeated call completes it", "DIR"},
            {"--replicates", &call->replicates, "Number of runs of each point [2]", "N"},
        });
    subcommand.in("Output").add({
        {"--json", &call->json, "File for all numbers, or - for stdout", "FILE|-"},
        {"--quiet", &call->quiet, "Only N_c, and no progress"},
    });
    subcommand.explain(
        "Prints the dimensionless numbers of a dish, the commands that simulate it, the number of "
        "particles that fit, and N_c, the number at which the direction of rotation changes. N_c "
        "comes from a search with runs of this dish; it holds for the friction that is printed, "
        "which you know least. Spheres roll on the floor with the friction of the paper's smooth "
        "spheres (--preset experiment), and --mu sets it for all contacts.\n\nWith --my-points, "
        "the "
        "dish is simulated at your numbers for a list of friction coefficients (--mu, "
        "[0.1:0.1:0.8]). Table and figure in DIR show your points next to the curves. The report "
        "has χ² and the coefficient that fits best, with its error (docs/how-to/units.md).\n");
    subcommand.set_main_options({"--container-radius", "--radius", "--amplitude", "--rpm", "--mu",
                                 "--body", "--no-search", "--tolerance", "--my-points", "--out",
                                 "--json"});
    subcommand.set_examples(
        {"swirl dish --container-radius 60mm --radius 8mm --amplitude 15mm --rpm 78",
         "swirl dish --container-radius 60mm --radius 8mm --amplitude 15mm --rpm 78 --mu 0.2",
         "swirl dish --preset experiment --rpm 100 --no-search",
         "swirl dish --container-radius 60mm --radius 8mm --amplitude 15mm --rpm 78 --my-points "
         "mine.csv --out mine"});
    subcommand.callback([call] { describe_dish(*call); });
}

const Command dish_command("dish", add_dish_command);

}  // namespace
}  // namespace swirl
