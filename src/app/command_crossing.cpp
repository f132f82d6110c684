// swirl crossing: at how many discs rotation turns into counterrotation.
#include <fmt/format.h>

#include "swirl/app/command_line.hpp"
#include "swirl/app/commands.hpp"
#include "swirl/app/config_file.hpp"
#include "swirl/app/output.hpp"
#include "swirl/app/progress_line.hpp"
#include "swirl/app/run_options.hpp"
#include "swirl/app/stop_signal.hpp"
#include "swirl/run/report.hpp"
#include "swirl/study/crossing.hpp"

namespace swirl {
namespace {

/// A run of a search is shorter than one that is made for its own sake.
const ParameterTexts defaults{{"events", "2e5"}};

struct CrossingCall {
    std::shared_ptr<ParameterTexts> parameters;
    CrossingSettings settings;
    std::string config_file, json;
    bool quiet = false;
};

std::string table_text(const CrossingSearch& search) {
    std::string text;
    for (std::size_t k = 0; k < search.points.size(); ++k)
        text += fmt::format("  N = {:<4.0f} ϖ/Ω = {:<20} {} run{}\n", search.points[k].discs,
                            with_error(search.points[k].mean, search.points[k].error),
                            search.runs_made[k], search.runs_made[k] == 1 ? "" : "s");
    return text;
}

void find(CrossingCall& call) {
    const bool json_to_stdout = call.json == "-";
    call.settings.config = resolve(overridden(defaults, *call.parameters));
    if (!call.json.empty() && !json_to_stdout) refuse_unwritable(call.json);

    CrossingSearch search;
    {
        ProgressLine line("crossing", call.quiet);
        CrossingControl control;
        control.stop = &stop_signal();
        int done = 0;
        control.progress = [&](const std::string& stage, double rate) {
            // How many runs it takes is not known beforehand: half of what is left, ever again.
            const double fraction = 1.0 - 20.0 / (20.0 + ++done);
            line.show(fraction, fmt::format("{}, {} events/s", stage, short_number(rate)));
        };
        search = search_crossing(call.settings, control);
    }
    std::string text = crossing_report(call.settings, search) + "\n";
    if (!call.quiet)
        text += table_text(search) + fmt::format("  {} runs, {} events, {}\n", search.runs,
                                                 with_commas(search.events),
                                                 short_duration(search.seconds));
    if (search.drifting > 0)
        text += fmt::format(
            "{} of the runs that this rests on had not reached a steady state after the warm-up; a "
            "longer --warmup, or --warmup auto, would be right.\n",
            search.drifting);
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
    const std::string json = crossing_json(call.settings, search, command_line());
    if (json_to_stdout) {
        print_all(json);
        if (!call.quiet) fmt::print(stderr, "{}", text);
        return;
    }
    if (!call.json.empty()) write_output(call.json, json);
    print_all(text);
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
    subcommand.add_option("--json", call->json, "write everything found to FILE, or - for stdout")
        ->type_name("FILE|-")
        ->group("Output");
    subcommand.add_flag("--quiet", call->quiet, "no progress, one line")->group("Output");
    subcommand.set_examples({"swirl crossing --mu 1", "swirl crossing --mu 0.5 --tolerance 0.1",
                             "swirl crossing --mu-wall 0 --from 20 --json -"});
    subcommand.callback([call, &subcommand] {
        if (!call->config_file.empty())
            take_config_file(subcommand, call->config_file, *call->parameters, Lists::refused,
                             "crossing");
        find(*call);
    });
}

const Command crossing_command(15, "crossing",
                               "The number of discs at which the rotation changes sign.",
                               add_crossing_command);

}  // namespace
}  // namespace swirl
