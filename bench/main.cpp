// swirl_bench: how fast the engine is on this machine (bench/run builds and starts it).
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <string>
#include <vector>

#include "scene_rates.hpp"
#include "swirl/io/atomic_file.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/reading.hpp"
#include "swirl/run/shell_word.hpp"
#include "swirl/run/simd.hpp"

namespace swirl {
namespace {

std::atomic<bool> interrupted{false};

struct Options {
    bool full = false, quiet = false;
    std::string width = "best", only, json, csv;
    double seconds = 0.0;
};

std::vector<Width> widths_of(const std::string& name) {
    if (name == "best") return {Width::best};
    std::vector<Width> found;
    for (const auto& [known, width] : named_widths)
        if (has_width(width) && (name == "all" || name == known)) found.push_back(width);
    if (found.empty())
        throw Failure(fmt::format(
            "this processor has no vectors of width '{}'\nhint: use --width all", name));
    return found;
}

std::string command_line(int argc, char** argv) {
    std::string line = "bench/run";
    for (int k = 1; k < argc; ++k) line += " " + shell_word(argv[k]);
    return line;
}

void print_or_write(const std::string& file, const std::string& text) {
    if (file == "-")
        fmt::print("{}", text);
    else
        write_file_atomically(file, text);
}

void measure(const Options& options, const std::string& command) {
    BenchSettings settings;
    settings.full = options.full;
    settings.only = options.only;
    settings.widths = widths_of(options.width);
    settings.seconds = options.seconds > 0.0 ? options.seconds : options.full ? 1.0 : 0.25;
    settings.stop = &interrupted;
    if (!options.quiet)
        settings.progress = [](double fraction, const std::string& scene) {
            fmt::print(stderr, "{:3.0f} %  {}\n", 100.0 * fraction, scene);
        };
    const BenchResult result = bench(settings);
    if (!options.json.empty()) print_or_write(options.json, bench_json(result, command));
    if (!options.csv.empty()) print_or_write(options.csv, bench_csv(result, command));
    if (options.json != "-" && options.csv != "-") fmt::print("{}", bench_report(result));
    if (std::fflush(stdout) != 0) throw Failure("standard output cannot be written");
}

int run(int argc, char** argv) {
    CLI::App app("Measures the engine against its baselines, scene by scene.", "bench/run");
    Options options;
    app.add_flag("--full", options.full, "Include the scenes with 10^5 and 10^6 discs");
    app.add_option("--width", options.width, "Vector width of the engine [best]")
        ->check(CLI::IsMember({"best", "all", baseline_name, "avx2", "avx512"}));
    app.add_option("--only", options.only, "Measure only scenes whose name contains TEXT")
        ->type_name("TEXT");
    app.add_option("--seconds", options.seconds,
                   "Processor time for each rate [0.25; 1 with --full]")
        ->check([](const std::string& text) {
            const auto seconds = read_number(text);
            return seconds && *seconds >= 0.001 && *seconds <= 3600.0
                       ? std::string()
                       : fmt::format("'{}' is not a number of seconds from 0.001 to 3600", text);
        });
    app.add_option("--json", options.json, "Write the result as JSON to FILE (-: stdout)")
        ->type_name("FILE");
    app.add_option("--csv", options.csv, "Write the result as CSV to FILE (-: stdout)")
        ->type_name("FILE");
    app.add_flag("--quiet", options.quiet, "Print no progress");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app.exit(error);
        fmt::print(stderr, "error: {}\n", error.what());
        return 2;
    }
    std::signal(SIGINT, [](int) { interrupted = true; });
    try {
        measure(options, command_line(argc, argv));
    } catch (const Interrupted& error) {
        fmt::print(stderr, "error: {}\n", error.what());
        return 130;
    } catch (const std::exception& error) {
        fmt::print(stderr, "error: {}\n", error.what());
        return 1;
    }
    return 0;
}

}  // namespace
}  // namespace swirl

int main(int argc, char** argv) { return swirl::run(argc, argv); }
