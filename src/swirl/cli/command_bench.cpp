// swirl bench: how fast the engine is on this machine.
#include <fmt/format.h>

#include "swirl/cli/command_line.hpp"
#include "swirl/cli/commands.hpp"
#include "swirl/cli/output.hpp"
#include "swirl/cli/progress_line.hpp"
#include "swirl/cli/stop_signal.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/parameters.hpp"
#include "swirl/run/simd.hpp"
#include "swirl/study/bench.hpp"

namespace swirl {
namespace {

struct BenchCall {
    bool full = false, quiet = false;
    std::string width = "best", seconds, json, csv;
};

std::vector<Width> read_widths(const std::string& text) {
    if (text == "best") return {Width::best};
    std::vector<Width> found;
    for (const auto& [name, width] : named_widths)
        if ((text == "all" && has_width(width)) || text == name) found.push_back(width);
    if (found.empty())
        throw UsageError(fmt::format(
            "The width of the vectors cannot be '{}'; it must be best, all, {}, avx2 or "
            "avx512.",
            text, baseline_name));
    for (const Width width : found)
        if (!has_width(width))
            throw Failure(
                fmt::format("This processor has no vectors of the width {}; "
                            "--width all takes those that it has.",
                            text));
    return found;
}

void make_bench(const BenchCall& call) {
    BenchSettings settings;
    settings.full = call.full;
    settings.widths = read_widths(call.width);
    const auto seconds =
        call.seconds.empty() ? (call.full ? 1.0 : 0.25) : read_number(call.seconds);
    if (!seconds || !(*seconds > 0.0 && *seconds <= 3600.0))
        throw UsageError(
            fmt::format("The time for each rate cannot be '{}'; it must be a number of "
                        "seconds, above 0 and at most 3600.",
                        call.seconds));
    settings.seconds = *seconds;
    for (const std::string& file : {call.json, call.csv})
        if (!file.empty() && file != "-") reject_unwritable(file);
    reject_same_files({call.json, call.csv});

    BenchResult result;
    {
        ProgressLine line("bench", call.quiet);
        settings.stop = &stop_signal();
        settings.progress = [&](double fraction, const std::string& scene) {
            line.show(fraction, scene);
        };
        result = bench(settings);
    }
    const auto write = [](const std::string& file, const std::string& text) {
        file == "-" ? print_all(text) : write_output(file, text);
    };
    if (!call.json.empty()) write(call.json, bench_json(result, command_line()));
    if (!call.csv.empty()) write(call.csv, bench_csv(result, command_line()));
    if (call.json != "-" && call.csv != "-") print_all(bench_report(result));
}

void add_bench_command(Subcommand& subcommand) {
    const auto call = std::make_shared<BenchCall>();
    subcommand.add_flag("--full", call->full, "10^5 and 10^6 discs, too");
    subcommand
        .add_option(
            "--width", call->width,
            fmt::format("of the vectors: best, all, {}, avx2 or avx512 [best]", baseline_name))
        ->type_name("NAME");
    subcommand
        .add_option("--seconds", call->seconds,
                    "of processor time for each rate [0.25; 1 with --full]")
        ->type_name("NUMBER");
    subcommand.add_option("--json", call->json, "write the result as JSON (- prints it)")
        ->type_name("FILE");
    subcommand.add_option("--csv", call->csv, "write the result as a table (- prints it)")
        ->type_name("FILE");
    subcommand.add_flag("--quiet", call->quiet, "no progress");
    subcommand.set_examples({"swirl bench", "swirl bench --width all --json bench.json",
                             "swirl bench --full --seconds 5"});
    subcommand.callback([call] { make_bench(*call); });
}

const Command bench_command(90, "bench", "How fast the engine is on this machine.",
                            add_bench_command);

}  // namespace
}  // namespace swirl
