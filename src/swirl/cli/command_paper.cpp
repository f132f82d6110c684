// swirl paper: the paper's figures and the report on its claims. Python plans the runs, draws and
// judges (paper/, on the Python module); this file checks the options.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "swirl/cli/command_line.hpp"
#include "swirl/cli/commands.hpp"
#include "swirl/cli/config_file.hpp"
#include "swirl/cli/output.hpp"
#include "swirl/cli/sweep_options.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/json.hpp"
#include "swirl/run/parameters.hpp"
#include "swirl/run/programs.hpp"
#include "swirl/run/python_script.hpp"
#include "swirl/run/version.hpp"

namespace swirl {
namespace {

namespace fs = std::filesystem;

struct PaperCall {
    std::string config_file, out = "out", events, seed;
    std::optional<int> replicates;
    std::vector<std::string> figures;
    ShareOptions share;
    bool quick = false, quiet = false, movies = false;
};

nlohmann::ordered_json json_of(const PaperCall& call) {
    ParameterTexts given{{"events", call.events.empty() ? "1e6" : call.events}};
    if (!call.seed.empty()) given["seed"] = call.seed;
    const RunConfig config = resolve(given);
    const SweepShare share = call.share.share();
    nlohmann::ordered_json json{{"figures", call.figures},
                                {"out", call.out},
                                {"quick", call.quick},
                                {"quiet", call.quiet},
                                {"movies", call.movies},
                                {"events", config.events},
                                {"seed", config.seed},
                                {"threads", share.threads},
                                {"command", command_line()},
                                {"version", version()},
                                {"build", build_description()},
                                {"defaults", config_json(config)},
                                {"program", main_program().string()}};
    if (call.replicates) json["first_seeds"] = *call.replicates;
    if (!call.share.part.empty()) json["part"] = {share.part, share.parts};
    // The module is next to the program (build tree), in the same prefix, or where Python looks.
    for (const char* const where : {"python", "../lib/python3/dist-packages"})
        if (const fs::path module = main_program().parent_path() / where;
            !json.contains("module") && fs::exists(module / "swirl"))
            json["module"] = module.lexically_normal().string();
    return json;
}

void add_paper_command(Subcommand& subcommand) {
    const auto call = std::make_shared<PaperCall>();
    subcommand.add({
        {"config", &call->config_file, "TOML file with option names; the command line overrides it",
         "FILE.toml"},
        {"--figure", &call->figures, "Figures or groups to make [all]; repeatable", "NAME"},
        {"--quick", &call->quick, "Fewer points and seeds, in runs of the same length"},
        {"--movies", &call->movies, "Movies of the paper, and movies.html that plays them"},
        {"--events", &call->events, "Events per run; scales lengths in periods [1e6]", "NUMBER"},
        {"--seed", &call->seed, "Random seed of the first run of each point [1]", "NUMBER"},
        {"--replicates", &call->replicates,
         "Runs per point; undecided claims get more [4, quick 3]", "NUMBER"},
        {"--out", &call->out, "Output folder [out]", "DIR"},
        {"--part", &call->share.part, "Part of the runs to make, such as 2/10", "K/M"},
        threads_option(call->share),
        omit_paths_option(),
        {"--quiet", &call->quiet, "No progress line"},
    });
    subcommand.set_examples({"swirl paper --figure 5b --quick",
                             "swirl paper --figure 5b --out fig5b",
                             "swirl paper --figure chapters --quick", "swirl paper --quick"});
    subcommand.explain([] { return output_of_python_script("catalogue").text; });
    subcommand.check([call] {
        if (call->figures.empty()) return;
        const ScriptOutput found = output_of_python_script("catalogue", call->figures);
        if (found.status == 2) throw UsageError(found.text);
    });
    subcommand.callback([call, &subcommand] {
        ParameterTexts parameters;
        take_config_file(subcommand, call->config_file, parameters, Lists::rejected, "paper");
        for (const auto& [name, into] :
             {std::pair("events", &call->events), std::pair("seed", &call->seed)})
            if (const auto found = parameters.find(name); found != parameters.end())
                if (into->empty()) *into = found->second;
        const std::string json = json_of(*call).dump();
        make_folder(call->out);
        become_python_script("command", {json});
    });
}

const Command paper_command("paper", add_paper_command);

}  // namespace
}  // namespace swirl
