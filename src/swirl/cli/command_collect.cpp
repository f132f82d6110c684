// swirl collect: the table of a sweep.
#include <memory>

#include "swirl/cli/commands.hpp"
#include "swirl/cli/sweep_tables.hpp"

namespace swirl {
namespace {

void add_collect_command(Subcommand& subcommand) {
    const auto call = std::make_shared<CollectCall>();
    subcommand.add({
        {"folder", &call->folder, "Folder of a sweep", "DIR", required},
        {"--csv", &call->table, "File for the table, or - for stdout [DIR/table.csv]", "FILE|-"},
        {"--crossings", &call->crossings, "File for a table of N_c, or - for stdout", "FILE|-"},
        {"--loops", &call->loops, "File for the areas of hysteresis loops, or - for stdout",
         "FILE|-"},
        {"--plot", &call->plot, "Draw the table as PNG and PDF next to it"},
        {"--my-points", &call->my_points, "Your table of N, turns, circles, to compare with",
         "FILE.csv"},
        {"--quantity", &call->quantity, "Column to draw [mean_by_time]", "NAME"},
    });
    subcommand.explain(
        "N_c is the number of discs at which the rotation (by time) changes its sign, for each "
        "combination of the other parameters. The area of a loop is the integral, over the "
        "parameter, of the curve with falling values minus the curve with rising values.\n");
    subcommand.set_examples({"swirl collect study", "swirl collect study --crossings N_c.csv",
                             "swirl collect study --csv -",
                             "swirl collect study --plot --quantity energy"});
    subcommand.callback([call] { collect(*call); });
}

const Command collect_command("collect", add_collect_command);

}  // namespace
}  // namespace swirl
