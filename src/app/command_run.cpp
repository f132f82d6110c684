// swirl run: one simulation.
#include <fmt/format.h>

#include <cstdio>

#include "app/commands.hpp"
#include "app/run_options.hpp"
#include "lab/run.hpp"
#include "lab/run_json.hpp"

namespace swirl {
namespace {

void add_run_command(CLI::App& subcommand) {
    const auto texts = add_run_options(subcommand);
    set_examples(subcommand, {"swirl run --discs 48", "swirl run --discs 28 --mu 0.5 --json -",
                              "swirl run --discs 40 --mu-wall 0 --periods 500 --warmup 100"});
    subcommand.callback([texts] {
        const RunResult result = run(resolve(*texts));
        fmt::print("{}\n", result_json(result).dump(2));
    });
}

const Command command(10, "run", "One simulation, from its seed to its averages.",
                      add_run_command);

}  // namespace
}  // namespace swirl
