// swirl run: one simulation, from its seed to its averages.
#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/output.hpp"
#include "app/progress_line.hpp"
#include "app/run_options.hpp"
#include "app/stop_signal.hpp"
#include "lab/failure.hpp"
#include "lab/run.hpp"
#include "lab/run_json.hpp"
#include "lab/run_report.hpp"

namespace swirl {
namespace {

struct RunCall {
    std::shared_ptr<ParameterTexts> parameters;
    std::string json;
    bool quiet = false;
};

RunResult run_with_progress(const RunConfig& config, bool quiet) {
    ProgressLine line(fmt::format("{} discs", config.discs), quiet);
    const auto begin = std::chrono::steady_clock::now();
    RunControl control;
    control.stop = &stop_signal();
    control.progress = [&](const RunProgress& progress) {
        const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
        const double rate = static_cast<double>(progress.events) / elapsed.count();
        line.show(progress.fraction, short_number(rate) + " events/s");
    };
    return run(config, control);
}

void run_and_report(const RunCall& call) {
    const bool json_to_stdout = call.json == "-";
    const RunConfig config = resolve(*call.parameters);
    if (!call.json.empty() && !json_to_stdout) refuse_unwritable(call.json);

    const RunResult result = run_with_progress(config, call.quiet);

    const std::string text = call.quiet ? headline(result) + "\n" : report(result);
    if (json_to_stdout) {
        print_all(result_json(result).dump(2) + "\n");
        if (!call.quiet) fmt::print(stderr, "{}", text);
    } else {
        if (!call.json.empty()) write_output(call.json, result_json(result).dump(2) + "\n");
        if (!call.quiet || call.json.empty()) print_all(text);
    }
    if (!result.complete) throw Interrupted("Stopped before the end of the run.");
}

void add_run_command(CLI::App& subcommand) {
    const auto call = std::make_shared<RunCall>();
    call->parameters = add_run_options(subcommand);
    subcommand.add_option("--json", call->json, "write everything found to FILE, or - for stdout")
        ->type_name("FILE|-")
        ->group("Output");
    subcommand.add_flag("--quiet", call->quiet, "no progress, no report beyond one line")
        ->group("Output");
    set_examples(subcommand, {"swirl run --discs 48", "swirl run --discs 28 --mu 0.5 --json -",
                              "swirl run --discs 40 --mu-wall 0 --periods 500 --warmup 100"});
    subcommand.callback([call] { run_and_report(*call); });
}

const Command command(10, "run", "One simulation, from its seed to its averages.", add_run_command);

}  // namespace
}  // namespace swirl
