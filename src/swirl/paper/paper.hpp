// The paper's figures, from simulation. A figure is a set of independent tasks, a table made of
// their results, and a function in paper/figures that draws the table.
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

#include "swirl/io/table.hpp"
#include "swirl/run/run.hpp"

namespace swirl {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

struct PaperSettings {
    bool quick = false;  // fewer points and seeds; all runs are those of the full study
    std::optional<std::int64_t> events;  // of a run; scales all lengths in periods likewise
    fs::path out = "out";
    std::uint64_t seed = 1;
    /// Points that need more seeds than the others, until a claim is decided.
    std::map<std::string, int> seeds_of_point = {};

    /// First seeds of a point of the paper's figures. 0: the default.
    int first_seeds = 0;

    /// Runs at a point of the paper's figures, and of the figures beyond the paper.
    int seeds() const { return first_seeds > 0 ? first_seeds : default_seeds(); }
    int seeds_beyond() const { return quick ? 2 : 3; }
    /// The budget of a point on which an undecided claim rests.
    int max_seeds() const { return 4 * default_seeds(); }
    int default_seeds() const { return quick ? 3 : 8; }

    /// SI: "10^6 iterations".
    static constexpr std::int64_t default_events = 1'000'000;
    std::int64_t events_of_a_run() const { return events.value_or(default_events); }
    /// A length in periods, scaled as `events` scales the other runs.
    std::int64_t periods(std::int64_t by_default, std::int64_t minimum) const;
};

/// One task. Its result is stored in OUT/parts/KEY.json: an interrupted study continues from there,
/// and two figures that need the same task run it once.
struct PaperTask {
    std::string key;  // two tasks with the same key must do the same work
    double cost;      // estimated, in events; orders the tasks and weights the progress
    /// Returns the result; throws Interrupted if it was stopped.
    std::function<Json(const RunControl&)> work;
    /// The key of a larger task whose result contains that of this one, or empty. Its result is
    /// used if that task is also needed, or was done before.
    std::string served_by = {};
    /// The configuration of a single run, to check that tasks with the same key are equal.
    std::string description = {};
};

/// A point of a curve or a map: the same task with several seeds, whose results are combined
/// (seed_ensemble.hpp), or a single task.
struct PaperPoint {
    std::string name;  // in tables and verdicts; empty if it cannot have more seeds
    std::vector<PaperTask> runs;

    PaperPoint(PaperTask only) : runs{std::move(only)} {}
    /// `run` makes the task of a seed. The number of seeds is `seeds`, or more if
    /// settings.seeds_of_point says so.
    PaperPoint(const PaperSettings& settings, std::string point, int seeds,
               const std::function<PaperTask(std::uint64_t seed)>& run);
};

/// The results of a figure, once its tasks are done.
struct FigureOutcome {
    std::vector<std::string> findings;  // sentences to print
    std::vector<fs::path> files;

    /// Writes OUT/figure_NAME.csv.
    void write(const Table& table, const std::string& name, const fs::path& out) {
        files.push_back(out / ("figure_" + name + ".csv"));
        table.write(files.back());
    }
};

struct FigurePlan {
    std::vector<PaperPoint> points;
    /// Gets one result for each point and writes the tables to the folder. The result of a point
    /// whose runs failed is {"failed": reason}; it leaves a gap in the figure.
    std::function<FigureOutcome(const std::vector<Json>& results, const fs::path& out)> finish;
    bool is_drawn = true;  // paper/draw.py draws the first file of the outcome
};

struct PaperFigure {
    std::string_view name;         // "5b"
    std::string_view description;  // one line
    FigurePlan (*plan)(const PaperSettings& settings);
    std::string_view group = {};  // one of figure_groups
};

/// A group of figures, which a call can name like a figure.
struct FigureGroup {
    std::string_view name, description;
};
inline constexpr FigureGroup figure_groups[] = {
    {"paper", "the figures of the paper"},
    {"beyond", "parameters, averages and times that the paper does not show"},
    {"rolling", "spheres that roll on the floor"},
    {"chapters", "questions that the paper leaves open"},
};

/// All figures, in the order of the report.
const std::vector<PaperFigure>& paper_figures();
/// Throws UsageError if there is none with this name.
const PaperFigure& paper_figure(const std::string& name);
/// The figures with these names, which may be names of groups or "all". Each figure is listed once.
/// Throws UsageError with a list of all names.
std::vector<PaperFigure> figures_named(const std::vector<std::string>& names);

struct PaperControl {
    const std::atomic<bool>* stop = nullptr;
    std::function<void(double fraction, double events_per_second)> progress;
    unsigned threads = 0;  // 0: all cores
};

/// The tasks of a call that shares the work with others: those with number ≡ part − 1 modulo parts.
struct PaperShare {
    std::size_t part = 1, parts = 1;
};

struct MadeFigure {
    std::string name, description;
    FigureOutcome outcome;
    std::string problem = {};  // why the figure could not be made, or empty
};

struct PaperResult {
    std::vector<MadeFigure> figures;
    std::size_t tasks = 0, reused = 0, failed = 0;
    std::size_t undecided_points = 0;  // points that used their whole budget and decided nothing
    double seconds = 0.0;
    double task_seconds = 0.0;  // of all tasks, each on one core, including reused ones
};

/// Runs the tasks in parallel, then writes tables and drawings. With `decide`, the seeds of points
/// on which undecided claims rest (paper/claims/) are doubled until the claims are decided or the
/// budget is used. Throws Interrupted when stopped; finished tasks are stored. A run that fails
/// leaves a gap in its figures. A figure that cannot be made is missing; the findings report it,
/// and all others are made.
PaperResult make_figures(const std::vector<PaperFigure>& figures, const PaperSettings& settings,
                         const PaperControl& control, bool decide = false);

/// Runs the tasks of a share and stores their results in OUT/parts, where make_figures() finds
/// them. No figure is made. Throws Interrupted when stopped.
PaperResult run_share(const std::vector<PaperFigure>& figures, const PaperSettings& settings,
                      const PaperControl& control, const PaperShare& share);

/// The report on all figures: OUT/paper.json, and from it and the tables OUT/report.md,
/// OUT/report.html and OUT/report.pdf. Returns these files.
std::vector<fs::path> write_report(const PaperResult& result, const PaperSettings& settings,
                                   const std::string& command,
                                   const std::atomic<bool>* stop = nullptr);

/// An estimate of the number of events in a period, for the progress and the order of the tasks.
double expected_events_per_period(const RunConfig& config);

/// A task that runs one configuration. It returns result_json(), with the measurements under
/// "measured".
PaperTask run_task(const std::string& key, const RunConfig& config,
                   const std::vector<std::string>& measurements = {});

/// Draws `table` to PNG and PDF next to it. Returns these files.
std::vector<fs::path> draw_figure(const fs::path& table, const std::atomic<bool>* stop = nullptr);

}  // namespace swirl
