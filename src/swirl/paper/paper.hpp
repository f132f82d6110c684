// The paper's figures, from simulation: each is a set of independent pieces of work, a table made
// of their results, and a script in figures/ that draws the table.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <atomic>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "swirl/run/run.hpp"

namespace swirl {

struct PaperSettings {
    bool quick = false;  // fewer points, shorter runs: the shape of the figure in a minute
    std::optional<std::int64_t> events;  // of a run of the paper; shortens all others likewise
    std::filesystem::path out = "out";
    std::uint64_t seed = 1;
    /// Of the points, by their names, that need more seeds than others until a claim is decided.
    std::map<std::string, int> seeds_of_point = {};

    /// Runs at a point of the paper's figures, and of those beyond it.
    int seeds() const { return quick ? 3 : 8; }
    int seeds_beyond() const { return quick ? 2 : 3; }
    /// What a point gets at most, for the sake of a claim: the budget.
    int max_seeds() const { return 4 * seeds(); }

    /// Of one run of the paper: its 10^6, or fewer.
    std::int64_t events_of_a_run() const { return events.value_or(events_by_default()); }
    std::int64_t events_by_default() const { return quick ? 200'000 : 1'000'000; }
    /// A length in swirls, as many times shorter or longer as --events makes the other runs.
    std::int64_t periods(std::int64_t by_default, std::int64_t minimum) const;
};

/// One piece of work. Its result is remembered in OUT/parts/KEY.json, so a study that was
/// interrupted continues, and two figures that need the same piece do it once.
struct PaperTask {
    std::string key;  // names what is done: two tasks of one key must be the same work
    double cost;      // expected, in events: long tasks begin first, and the progress is weighted
    /// Returns the result; throws Interrupted if it was stopped.
    std::function<nlohmann::ordered_json(const RunControl&)> work;
    /// Key of a larger piece whose result holds all that this one's does; empty: there is none. If
    /// that is done anyway, or was done before, it serves.
    std::string served_by = {};
    /// The whole configuration, of a single run: tasks of one key must have the same.
    std::string what = {};
};

/// A point of a curve or a map: the same work with several seeds, whose results are put together
/// (several_seeds.hpp); or a single piece.
struct PaperPoint {
    std::string name;  // in tables, and of what needs more seeds; empty if it cannot have them
    std::vector<PaperTask> runs;

    PaperPoint(PaperTask only) : runs{std::move(only)} {}
    /// `run` makes the piece of a seed. As many as settings.seeds_of_point says, or `seeds`.
    PaperPoint(const PaperSettings& settings, std::string point, int seeds,
               const std::function<PaperTask(std::uint64_t seed)>& run);
};

/// What a figure leaves behind when its tasks are done.
struct FigureOutcome {
    std::vector<std::string> findings;  // sentences to print
    std::vector<std::filesystem::path> files;
};

struct FigurePlan {
    std::vector<PaperPoint> points;
    /// Gets a result for each point; writes the tables into the folder.
    /// That of a point whose runs failed is {"failed": why}, and leaves a hole.
    std::function<FigureOutcome(const std::vector<nlohmann::ordered_json>& results,
                                const std::filesystem::path& out)>
        finish;
    /// figures/SCRIPT draws from the first file of the outcome; empty: nothing to draw.
    std::string script;
};

struct PaperFigure {
    std::string_view name;         // "5b"
    std::string_view description;  // one line
    FigurePlan (*plan)(const PaperSettings& settings);
};

/// All figures there are, in the order of the report.
const std::vector<PaperFigure>& paper_figures();
/// Throws WrongCall, naming those there are.
const PaperFigure& paper_figure(const std::string& name);

struct PaperControl {
    const std::atomic<bool>* stop = nullptr;
    std::function<void(double fraction, double events_per_second)> progress;
    unsigned threads = 0;  // 0: all cores
};

struct MadeFigure {
    std::string name, description;
    FigureOutcome outcome;
    std::string problem = {};  // why there is no such figure; empty: there is
};

struct PaperResult {
    std::vector<MadeFigure> figures;
    std::size_t tasks = 0, remembered = 0, failed = 0;
    std::size_t undecided_points = 0;  // that got all the seeds of the budget and decided nothing
    double seconds = 0.0;
    double task_seconds = 0.0;  // of all pieces, each on one core, those remembered included
};

/// Makes the figures: tasks on all cores, tables, drawings. With `decide`, claims that the tables
/// leave undecided (figures/claims.py) get twice the seeds at the points they rest on, and again,
/// until they are decided or the budget is spent. Throws Interrupted when stopped; what
/// was done until then is remembered. A run that fails leaves a hole in its figures, a figure that
/// cannot be made is missing; the findings say so, and the rest is made.
PaperResult make_figures(const std::vector<PaperFigure>& figures, const PaperSettings& settings,
                         const PaperControl& control, bool decide = false);

/// The report of all that was made: OUT/paper.json, and from it and the tables OUT/report.md and
/// OUT/report.html. Returns the files.
std::vector<std::filesystem::path> write_report(const PaperResult& result,
                                                const PaperSettings& settings,
                                                const std::string& command,
                                                const std::atomic<bool>* stop = nullptr);

/// Events in a swirl, a fair guess for the progress and the order of work.
double expected_events_per_swirl(const RunConfig& config);

/// A task that runs one configuration and returns result_json(), with what was measured under
/// "measured".
PaperTask run_task(const std::string& key, const RunConfig& config,
                   const std::vector<std::string>& measurements = {});

/// The script must be one of figures/; draws `table` to PNG and PDF beside it. Returns the files.
std::vector<std::filesystem::path> draw_figure(const std::string& script,
                                               const std::filesystem::path& table,
                                               const std::atomic<bool>* stop = nullptr);

}  // namespace swirl
