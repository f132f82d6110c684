// swirl paper: the paper's figures and the report on its claims.
#include <fmt/format.h>

#include <algorithm>

#include "swirl/cli/command_line.hpp"
#include "swirl/cli/commands.hpp"
#include "swirl/cli/config_file.hpp"
#include "swirl/cli/missing_parts.hpp"
#include "swirl/cli/output.hpp"
#include "swirl/cli/progress_line.hpp"
#include "swirl/cli/stop_signal.hpp"
#include "swirl/cli/sweep_options.hpp"
#include "swirl/paper/movies.hpp"
#include "swirl/paper/paper.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/parameters.hpp"
#include "swirl/run/report.hpp"

namespace swirl {
namespace {

struct PaperCall {
    PaperSettings settings;
    std::string config_file, out = "out", events, seed;
    std::optional<int> seeds;
    std::vector<std::string> figures;
    ShareOptions share;
    bool quiet = false, movies = false;

    bool is_all() const {
        return figures.empty() || std::find(figures.begin(), figures.end(), "all") != figures.end();
    }
};

#ifndef SWIRL_PAPER

void make_paper(const PaperCall&) { throw_no_paper_support("paper"); }

std::string figure_list() { return "Figures: `./swirl paper --help` lists them."; }

#else

void make_movies(const PaperCall& call) {
    PaperMoviesSettings settings;
    settings.out = call.out;
    settings.quick = call.settings.quick;
    settings.seed = call.settings.seed;
    PaperMovies made;
    {
        ProgressLine line("movies", call.quiet);
        PaperMoviesControl control;
        control.stop = &stop_signal();
        control.progress = [&](double fraction, const std::string& name) {
            line.show(fraction, name);
        };
        made = make_paper_movies(settings, control);
    }
    std::string text;
    if (made.reused > 0)
        text = fmt::format("{} of {} movies are from an earlier call.\n", made.reused,
                           made.files.size() - 1);
    for (const auto& file : made.files) text += fmt::format("wrote {}\n", file.string());
    print_all(text);
}

/// All other figures are made; a figure that could not be made makes the call fail.
void reject_missing(const PaperResult& result) {
    std::string names;
    for (const MadeFigure& figure : result.figures)
        if (!figure.problem.empty())
            names += fmt::format("{}{}", names.empty() ? "" : ", ", figure.name);
    if (!names.empty())
        throw Failure(fmt::format(
            "figures that could not be made: {}; the reasons are listed above.", names));
}

/// The findings and the files of the figures, and the report if all figures were made.
std::string report_on(const PaperResult& result, const PaperCall& call) {
    std::string text;
    std::vector<std::filesystem::path> files;
    for (const MadeFigure& figure : result.figures) {
        for (const std::string& finding : figure.outcome.findings)
            text += result.figures.size() == 1 ? finding + "\n"
                                               : fmt::format("{:<26}{}\n", figure.name, finding);
        files.insert(files.end(), figure.outcome.files.begin(), figure.outcome.files.end());
    }
    if (call.is_all())
        for (const auto& file : write_report(result, call.settings, command_line(), &stop_signal()))
            files.push_back(file);
    // Failed runs are listed with each figure. Figures share runs, so their number is printed here.
    if (result.failed > 0 && result.figures.size() > 1)
        text += fmt::format("{} runs failed; see above.\n", result.failed);
    text += fmt::format(
        "{} runs{} in {}.\n", result.tasks,
        result.reused > 0 ? fmt::format(", {} of them from an earlier call,", result.reused) : "",
        short_duration(result.seconds));
    if (call.is_all())
        text += fmt::format("wrote {} and {} more files in the same folder\n",
                            files.back().string(), files.size() - 1);
    else
        for (const auto& file : files) text += fmt::format("wrote {}\n", file.string());
    return text;
}

void make_paper(PaperCall& call) {
    call.settings.out = call.out;
    if (call.seeds) {
        const int budget = call.settings.max_seeds();
        if (*call.seeds < 2 || *call.seeds > budget)
            throw UsageError(
                fmt::format("--seeds is {}, but it must be from 2 to {}.", *call.seeds, budget));
        call.settings.first_seeds = *call.seeds;
    }
    if (!call.events.empty()) call.settings.events = resolve({{"events", call.events}}).events;
    if (!call.seed.empty()) call.settings.seed = resolve({{"seed", call.seed}}).seed;
    const SweepShare share = call.share.share();
    const std::vector<PaperFigure> figures =
        call.is_all() ? paper_figures() : figures_named(call.figures);
    make_folder(call.out);
    if (call.movies) {
        make_movies(call);
        if (call.figures.empty()) return;
    }

    PaperResult result;
    {
        const std::string what =
            figures.size() == 1 ? fmt::format("Figure {}", figures.front().name) : "paper";
        ProgressLine line(what, call.quiet);
        PaperControl control;
        control.stop = &stop_signal();
        control.threads = share.threads;
        control.progress = [&](double fraction, double rate) {
            line.show(fraction, short_number(rate) + " events/s");
        };
        // Claims are decided only if all figures are made.
        result = call.share.part.empty()
                     ? make_figures(figures, call.settings, control, call.is_all())
                     : run_share(figures, call.settings, control, {share.part, share.parts});
    }
    if (!call.share.part.empty()) {
        print_all(fmt::format("{} runs of part {} in {}; stored in '{}'.\n", result.tasks,
                              call.share.part, short_duration(result.seconds),
                              (call.settings.out / "parts").string()));
        if (result.failed > 0) throw Failure(fmt::format("{} runs failed.", result.failed));
        return;
    }
    print_all(report_on(result, call));
    reject_missing(result);
}

std::string figure_list() {
    std::string text = "Groups of figures:\n  all                 all figures, and the report";
    for (const FigureGroup& group : figure_groups)
        text += fmt::format("\n  {:<19} {}", group.name, group.description);
    text += "\n\nFigures:";
    for (const PaperFigure& figure : paper_figures())
        text += fmt::format("\n  {:<19} {}", figure.name, figure.description);
    return text;
}

#endif  // SWIRL_PAPER

void add_paper_command(Subcommand& subcommand) {
    const auto call = std::make_shared<PaperCall>();
    subcommand
        .add_option("config", call->config_file,
                    "TOML file with option names; the command line overrides it")
        ->type_name("FILE.toml");
    subcommand.add_option("--figure", call->figures, "Figures or groups to make [all]; repeatable")
        ->type_name("NAME");
    subcommand.add_flag("--quick", call->settings.quick,
                        "Fewer points and seeds, in runs of the same length");
    subcommand.add_flag("--movies", call->movies,
                        "Movies of the paper, and movies.html that plays them");
    subcommand
        .add_option("--events", call->events, "Events per run; scales lengths in periods [1e6]")
        ->type_name("NUMBER");
    subcommand.add_option("--seed", call->seed, "Random seed of the first run of each point [1]")
        ->type_name("NUMBER");
    subcommand
        .add_option("--seeds", call->seeds,
                    "Runs per point; undecided claims get more [8, quick 3]")
        ->type_name("NUMBER");
    subcommand.add_option("--out", call->out, "Output folder [out]")->type_name("DIR");
    subcommand.add_option("--part", call->share.part, "Part of the runs to make, such as 2/10")
        ->type_name("K/M");
    add_threads_option(subcommand, call->share, "");
    add_omit_paths_option(subcommand);
    subcommand.add_flag("--quiet", call->quiet, "No progress line");
    subcommand.set_examples({"swirl paper --figure 5b --quick",
                             "swirl paper --figure 5b --out fig5b",
                             "swirl paper --figure chapters --quick", "swirl paper --quick"});
    subcommand.explain(figure_list() + "\n");
    subcommand.callback([call, &subcommand] {
        ParameterTexts parameters;
        if (!call->config_file.empty())
            take_config_file(subcommand, call->config_file, parameters, Lists::rejected, "paper");
        for (const auto& [name, into] :
             {std::pair("events", &call->events), std::pair("seed", &call->seed)})
            if (const auto found = parameters.find(name); found != parameters.end())
                if (into->empty()) *into = found->second;
        make_paper(*call);
    });
}

const Command paper_command(20, "paper", "Make the paper's figures from simulation",
                            add_paper_command);

}  // namespace
}  // namespace swirl
