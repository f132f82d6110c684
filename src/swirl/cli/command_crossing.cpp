// swirl crossing: at how many discs rotation turns into counterrotation.
#include <fmt/format.h>

#include "swirl/cli/command_line.hpp"
#include "swirl/cli/commands.hpp"
#include "swirl/cli/config_file.hpp"
#include "swirl/cli/output.hpp"
#include "swirl/cli/progress_line.hpp"
#include "swirl/cli/run_options.hpp"
#include "swirl/cli/stop_signal.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/report.hpp"
#include "swirl/study/crossing_search.hpp"
#include "swirl/study/sweep_plan.hpp"

namespace swirl {
namespace {

const ParameterTexts defaults{{"events", events_of_a_search}};

struct CrossingCall {
    std::shared_ptr<ParameterTexts> parameters;
    CrossingSettings settings;
    std::string config_file, json, table, rate;
    std::int64_t threads = 0;
    bool quiet = false;
};

std::string table_text(const CrossingSearch& search) {
    std::string text;
    for (std::size_t k = 0; k < search.points().size(); ++k) {
        const RotationPoint& p = search.points()[k];
        text += fmt::format("  N = {:<4.0f} ϖ/Ω = {:<20} {} run{}\n", p.discs,
                            with_error(p.mean, p.error), search.runs_made[k],
                            search.runs_made[k] == 1 ? "" : "s");
    }
    return text;
}

/// One search, with a line of progress of its own.
CrossingSearch search_one(const CrossingCall& call, const CrossingSettings& settings,
                          const std::string& which) {
    ProgressLine line(which, call.quiet);
    CrossingControl control;
    control.stop = &stop_signal();
    control.threads = static_cast<unsigned>(call.threads);
    int done = 0;
    control.progress = [&](const std::string& stage, double rate) {
        // How many runs it takes is not known beforehand: half of what is left, ever again.
        const double fraction = 1.0 - 20.0 / (20.0 + ++done);
        line.show(fraction, fmt::format("{}, {} events/s", stage, short_number(rate)));
    };
    return search_crossing(settings, control);
}

std::string text_of(const CrossingCall& call, const CrossingSettings& settings,
                    const CrossingSearch& search) {
    std::string text = crossing_report(settings, search) + "\n" + other_crossings_report(search);
    if (!call.quiet)
        text += table_text(search) + fmt::format("  {} runs, {} events, {}\n", search.runs,
                                                 with_commas(search.events),
                                                 short_duration(search.seconds));
    if (search.not_steady > 0)
        text += fmt::format(
            "{} of the runs that this rests on had not reached a steady state after the warm-up; a "
            "longer --warmup, or --warmup auto, would be right.\n",
            search.not_steady);
    if (search.too_short > 0)
        text += fmt::format(
            "{} of the runs that this rests on were too short to tell whether they are steady.\n",
            search.too_short);
    if (search.disagreeing > 0)
        text += fmt::format(
            "At {} of the numbers of discs that this rests on the seeds scatter more than the "
            "errors "
            "within their runs can explain; the errors are those between them.\n",
            search.disagreeing);
    return text;
}

/// "mu_disc 0.5, mu_wall 1": what a list makes different.
std::string name_of(const SweepPlan& plan, std::size_t point) {
    std::string name;
    const ParameterTexts texts = plan.parameters(point);
    for (const SweepAxis& axis : plan.axes)
        if (axis.values.size() > 1)
            name +=
                fmt::format("{}{} {}", name.empty() ? "" : ", ", axis.name, texts.at(axis.name));
    return name;
}

/// One search is an object, those of a list are an array of them.
std::string json_of(const std::vector<std::string>& found, bool single) {
    return single ? found.front() : fmt::format("[\n{}]\n", fmt::join(found, ","));
}

/// A search for every combination of the lists that were given. After each of them the files hold
/// all that is known, so nothing is lost when the next one takes too long.
void find(CrossingCall& call) {
    check_range(call.settings);
    if (call.threads < 0 || call.threads > 4096)
        throw UsageError(fmt::format(
            "--threads is {}, but it must be a whole number from 1 to 4096, or 0 for all cores.",
            call.threads));
    // Only what is searched has to fit.
    ParameterTexts given = overridden(defaults, *call.parameters);
    given["discs"] = std::to_string(call.settings.to);
    const SweepPlan plan = make_plan(given, 1);
    const bool single = plan.points() == 1;
    std::vector<CrossingSettings> searches;
    for (std::size_t point = 0; point < plan.points(); ++point) {
        searches.push_back(call.settings);
        searches.back().config = resolve(plan.parameters(point));
        check(searches.back());
    }
    for (const std::string* file : {&call.json, &call.table})
        if (!file->empty() && *file != "-") reject_unwritable(*file);
    reject_same_files({call.config_file, call.json, call.table});

    std::vector<std::string> columns;
    for (const SweepAxis& axis : plan.axes)
        if (axis.name != "discs") columns.push_back(axis.name);
    for (const std::string& name : crossing_columns()) columns.push_back(name);
    columns.insert(columns.end(), {"within_tolerance", "runs", "runs_failed", "events_in_all"});
    Table table(columns);
    const bool to_stdout = call.json == "-" || call.table == "-";
    std::vector<std::string> found;
    std::size_t empty = 0;
    for (std::size_t point = 0; point < plan.points(); ++point) {
        const CrossingSettings& settings = searches[point];
        const std::string name = name_of(plan, point);
        const CrossingSearch search = search_one(call, settings, single ? "crossing" : name);
        if (search.points().empty()) ++empty;
        std::vector<Table::Cell> row;
        const ParameterTexts texts = plan.parameters(point);
        for (const SweepAxis& axis : plan.axes)
            if (axis.name != "discs") row.emplace_back(texts.at(axis.name));
        add_crossings(row, search.crossings, search.rate);
        row.emplace_back(std::string(search.within_tolerance ? "yes" : "no"));
        row.emplace_back(std::int64_t(search.runs));
        row.emplace_back(search.failed());
        row.emplace_back(std::int64_t(search.events));
        table.add(std::move(row));
        found.push_back(crossing_json(settings, search, command_line()));
        if (!call.json.empty() && call.json != "-") write_output(call.json, json_of(found, single));
        if (!call.table.empty() && call.table != "-") write_output(call.table, table.csv());
        const std::string text = (single ? "" : name + ": ") + text_of(call, settings, search);
        if (!to_stdout)
            print_all(text);
        else if (!call.quiet)
            fmt::print(stderr, "{}", text);
    }
    if (call.table == "-") print_all(table.csv());
    if (call.json == "-") print_all(json_of(found, single));
    if (empty > 0)
        throw Failure(single ? "No run of the search could be made; see above for why."
                             : fmt::format("Of {} of {} searches no run could be made; see above "
                                           "for why.",
                                           empty, plan.points()));
}

void add_crossing_command(Subcommand& subcommand) {
    const auto call = std::make_shared<CrossingCall>();
    subcommand
        .add_option("config", call->config_file,
                    "a TOML file with the names of the options; options given here override it")
        ->type_name("FILE.toml");
    call->parameters = add_run_options(subcommand, {"discs", "periods"}, defaults);
    subcommand
        .add_option("--tolerance", call->settings.tolerance, "wanted standard error of N_c [0.3]")
        ->type_name("NUMBER");
    subcommand.add_option("--from", call->settings.from, "fewest discs [5]")->type_name("N");
    subcommand.add_option("--to", call->settings.to, "most discs [48]")->type_name("N");
    subcommand
        .add_option("--step", call->settings.step,
                    "between the numbers of the first look; small, where the sense may change "
                    "several times [about eight numbers]")
        ->type_name("N");
    subcommand
        .add_option("--rate", call->rate,
                    "rotation rate whose sign and tolerance decide: by_event, by_time, "
                    "rigid_by_event or rigid_by_time [by_time]")
        ->type_name("NAME");
    subcommand.add_option("--threads", call->threads, "runs at the same time [one for each core]")
        ->type_name("N");
    subcommand.add_option("--json", call->json, "write everything found to FILE, or - for stdout")
        ->type_name("FILE|-")
        ->group("Output");
    subcommand
        .add_option("--csv", call->table,
                    "a table to FILE, or - for stdout: one line for each search")
        ->type_name("FILE|-")
        ->group("Output");
    subcommand.add_flag("--quiet", call->quiet, "no progress, one line")->group("Output");
    subcommand.explain(
        "Every parameter may be a list, as for swirl sweep: then there is a search for each\n"
        "combination. However few the --events, a run covers a hundred swirls after its warm-up.\n"
        "Near the crossing there are more runs, each twice as long as the ones before, until\n"
        "--tolerance is reached, or for the eighth time; then the report says so. N_c is given by\n"
        "each of the four rotation rates; --rate says which of them decides.\n");
    subcommand.set_examples({"swirl crossing --mu 1", "swirl crossing --mu 0.2:0.2:1 --csv N_c.csv",
                             "swirl crossing --mu 0.5 --tolerance 0.1",
                             "swirl crossing --mu-wall 0.5 --from 20 --json -"});
    subcommand.callback([call, &subcommand] {
        if (!call->config_file.empty())
            take_config_file(subcommand, call->config_file, *call->parameters, Lists::taken,
                             "crossing");
        if (!call->rate.empty()) call->settings.rate = rate_named(call->rate);
        find(*call);
    });
}

const Command crossing_command(15, "crossing",
                               "The number of discs at which the rotation changes sign.",
                               add_crossing_command);

}  // namespace
}  // namespace swirl
