#include "swirl/paper/paper.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <mutex>
#include <numeric>
#include <optional>

#include "swirl/io/atomic_file.hpp"
#include "swirl/io/file_error.hpp"
#include "swirl/paper/result_store.hpp"
#include "swirl/paper/results.hpp"
#include "swirl/paper/seed_ensemble.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/json.hpp"
#include "swirl/run/measurements.hpp"
#include "swirl/run/parallel_for.hpp"
#include "swirl/run/version.hpp"
#include "swirl/study/python_script.hpp"

namespace swirl {

namespace {

/// The progress of all tasks together.
class StudyProgress {
  public:
    StudyProgress(const PaperControl& control, double total) : control_(control), total_(total) {}

    void add(double cost) {
        const std::lock_guard lock(mutex_);
        done_ += cost;
        if (!control_.progress) return;
        const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin_;
        control_.progress(done_ / total_, done_ / elapsed.count());
    }

  private:
    const PaperControl& control_;
    const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
    std::mutex mutex_;
    double total_, done_ = 0.0;
};

bool stopped(const PaperControl& control) {
    return control.stop && control.stop->load(std::memory_order_relaxed);
}

Json run_with_progress(const PaperTask& task, const PaperControl& control,
                       StudyProgress& progress) {
    double reported = 0.0;
    RunControl inner;
    inner.stop = control.stop;
    inner.progress = [&](const RunProgress& p) {
        progress.add(task.cost * (p.fraction - reported));
        reported = p.fraction;
    };
    Json result = task.work(inner);
    progress.add(task.cost * (1.0 - reported));
    return result;
}

/// Cost of one sample of all measurements, in events.
constexpr double cost_of_a_sample = 6.0;

double seconds_since(std::chrono::steady_clock::time_point begin) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// The defaults of every run.
RunConfig paper_run(const PaperSettings& settings) {
    RunConfig config;
    config.events = settings.events_of_a_run();
    config.seed = settings.seed;
    return config;
}

[[noreturn]] void throw_interrupted(const PaperSettings& settings) {
    throw Interrupted(
        fmt::format("stopped before the end; finished tasks are stored in '{}'.\n"
                    "hint: the same call continues from there.",
                    (settings.out / "parts").string()));
}

}  // namespace

/// True if the call with this name means the figure: by its own name or by that of a group.
static bool is_named(const PaperFigure& figure, const std::string& name) {
    return name == "all" || figure.name == name || figure.group == name;
}

std::vector<PaperFigure> figures_named(const std::vector<std::string>& names) {
    std::vector<PaperFigure> found;
    for (const std::string& name : names) {
        std::vector<std::string> known{"all"};
        for (const FigureGroup& group : figure_groups) known.emplace_back(group.name);
        bool exists = false;
        for (const PaperFigure& figure : paper_figures()) {
            known.emplace_back(figure.name);
            if (!is_named(figure, name)) continue;
            exists = true;
            const auto same = [&](const PaperFigure& f) { return f.name == figure.name; };
            if (std::none_of(found.begin(), found.end(), same)) found.push_back(figure);
        }
        if (!exists)
            throw UsageError(fmt::format("--figure is '{}', but it must be one of: {}.{}", name,
                                         fmt::join(known, ", "), nearest_value_hint(name, known)));
    }
    return found;
}

const PaperFigure& paper_figure(const std::string& name) {
    for (const PaperFigure& figure : paper_figures())
        if (figure.name == name) return figure;
    throw UsageError(fmt::format("there is no figure '{}'.", name));
}

// In the paper's container 480 at N = 28 and 3400 at N = 48. For small N the vertices of the path
// dominate.
double expected_events_per_period(const RunConfig& config) {
    const double packing_fraction = static_cast<double>(config.discs) * config.radius *
                                    config.radius /
                                    (config.container_radius * config.container_radius);
    // A sphere begins to roll after most collisions, and after every vertex. Discs with only one of
    // disc and wall friction end up rolling on their partners, and collide gently and often
    // (measured at N = 11 … 48: 11 to 30 times as often without wall friction, 2.5 to 15 without
    // disc friction).
    const double factor = config.floor                                     ? 3.0
                          : config.mu_wall == 0.0 && config.mu_disc != 0.0 ? 20.0
                          : config.mu_disc == 0.0 && config.mu_wall != 0.0 ? 8.0
                                                                           : 1.0;
    return config.sides + factor * static_cast<double>(config.discs) *
                              (5.0 + 275.0 * std::pow(packing_fraction, 3.3));
}

PaperTask run_task(const std::string& key, const RunConfig& config,
                   const std::vector<std::string>& measurements) {
    const double events =
        config.periods ? expected_events_per_period(config) * static_cast<double>(*config.periods)
                       : static_cast<double>(config.events);
    const double periods = events / expected_events_per_period(config);
    const double samples = measurements.empty() ? 0.0 : samples_per_period * periods;
    const double cost = events + samples * cost_of_a_sample;
    PaperTask task{key, cost, [config, measurements](const RunControl& control) {
                       const MeasuredRun done = measured_run(config, measurements, control);
                       if (!done.run.complete) throw Interrupted("Stopped.");
                       Json json = result_json(done.run);
                       json["measured"] = done.measured;
                       return json;
                   }};
    task.description =
        fmt::format("{} {}", config_json(config).dump(), fmt::join(measurements, ","));
    return task;
}

std::int64_t PaperSettings::periods(std::int64_t by_default, std::int64_t minimum) const {
    const double share =
        static_cast<double>(events_of_a_run()) / static_cast<double>(default_events);
    const double periods = std::round(static_cast<double>(by_default) * share);
    return std::max(minimum, static_cast<std::int64_t>(periods));
}

namespace {

/// The tasks of all figures, the results that exist, and the tasks that remain.
struct Work {
    std::map<std::string, PaperTask> tasks;
    std::map<std::string, Json> results;
    std::vector<const PaperTask*> left;         // by falling cost
    std::map<std::string, std::string> served;  // by the result of this task

    /// `earlier`: the results of this call so far, including failed runs, which would fail again.
    Work(const std::vector<FigurePlan>& plans, const ResultStore& store,
         std::map<std::string, Json> earlier)
        : results(std::move(earlier)) {
        for (const FigurePlan& plan : plans)
            for (const PaperPoint& point : plan.points)
                for (const PaperTask& task : point.runs) tasks.emplace(task.key, task);
        for (const auto& [key, task] : tasks) {
            if (results.contains(key)) continue;
            if (auto stored = store.find(key))
                results[key] = std::move(*stored);
            else if (!task.served_by.empty() && tasks.contains(task.served_by))
                served[key] = task.served_by;
            else if (auto larger = store.find(task.served_by))
                results[key] = std::move(*larger);
            else
                left.push_back(&task);
        }
        std::stable_sort(left.begin(), left.end(), is_longer);
    }
    /// Leaves only the tasks of a share. The share does not depend on the results that exist.
    void keep(const PaperShare& share) {
        std::vector<const PaperTask*> all;
        for (const auto& [key, task] : tasks) all.push_back(&task);
        std::stable_sort(all.begin(), all.end(), is_longer);
        const auto is_of_others = [&](const PaperTask* task) {
            const auto number =
                static_cast<std::size_t>(std::find(all.begin(), all.end(), task) - all.begin());
            return number % share.parts != share.part - 1;
        };
        std::erase_if(left, is_of_others);
    }
    static bool is_longer(const PaperTask* a, const PaperTask* b) { return a->cost > b->cost; }
    double cost() const {
        return std::accumulate(left.begin(), left.end(), 0.0,
                               [](double sum, const PaperTask* t) { return sum + t->cost; });
    }
};

/// Runs one task. A failed run is a result, too, but it is not stored.
Json result_of(const PaperTask& task, const PaperControl& control, const ResultStore& store,
               StudyProgress& progress) {
    const auto started = std::chrono::steady_clock::now();
    try {
        const Json result = run_with_progress(task, control, progress);
        return store.store(task.key, result, seconds_since(started));
    } catch (const Failure& failure) {
        return {{"seconds", seconds_since(started)}, {"result", {{"failed", failure.what()}}}};
    }
}

/// The first names of a list, and the number of the others, for a sentence.
std::string first_few(const std::vector<std::string>& names) {
    constexpr std::size_t few = 5;
    if (names.size() <= few + 1) return fmt::format("{}", fmt::join(names, ", "));
    return fmt::format("{}, and {} more", fmt::join(names.begin(), names.begin() + few, ", "),
                       names.size() - few);
}

/// The failed runs, with the reason of the first.
std::optional<std::string> remark_on_failures(const FigurePlan& plan,
                                              const std::map<std::string, Json>& runs) {
    std::vector<std::string> points;
    std::string reason;
    std::size_t failures = 0;
    for (const PaperPoint& point : plan.points) {
        std::size_t here = 0;
        for (const PaperTask& task : point.runs)
            if (const Json& run = runs.at(task.key)["result"]; failed(run)) {
                if (failures + here++ == 0) reason = run["failed"].get<std::string>();
            }
        if (here == 0) continue;
        failures += here;
        const std::string& name = point.name.empty() ? point.runs.front().key : point.name;
        points.push_back(fmt::format("{} of {} at {}{}", here, point.runs.size(), name,
                                     here == point.runs.size() ? " (no result)" : ""));
    }
    if (failures == 0) return {};
    return fmt::format("{} run{} failed and {} omitted: {}. {}: {}", failures,
                       failures == 1 ? "" : "s", failures == 1 ? "is" : "are", first_few(points),
                       failures == 1 ? "Reason" : "Reason of the first", reason);
}

/// Remarks on the runs of a figure: failures, drifting runs, points where the seeds disagree.
std::vector<std::string> remarks_on(const FigurePlan& plan, const std::vector<Json>& results,
                                    const std::map<std::string, Json>& runs) {
    std::vector<std::string> remarks;
    std::map<std::string, std::int64_t> count;
    std::int64_t unaveraged = 0, judged = 0;
    std::vector<std::string> disagreeing;
    if (auto failures = remark_on_failures(plan, runs)) remarks.push_back(*failures);
    for (std::size_t k = 0; k < results.size(); ++k) {
        const Json& seeds = at(results[k], {"seeds"});
        if (!seeds.is_object()) continue;
        judged += seeds["runs"].get<std::int64_t>();
        for (const char* verdict : {"drifting", "jumping", "switching", "too_short"})
            count[verdict] += seeds[verdict].get<std::int64_t>();
        unaveraged += seeds["too_short_to_average"].get<std::int64_t>();
        if (at(seeds, {"disagree"}) == true) disagreeing.push_back(plan.points[k].name);
    }
    const std::int64_t not_steady =
        count["drifting"] + count["jumping"] + count["switching"] + count["too_short"];
    if (not_steady > 0)
        remarks.push_back(
            fmt::format("Steady state not verified after the warm-up: {} of {} runs ({} drifting, "
                        "{} jumping, {} switching between two states, {} too short for the test). "
                        "They are marked in the figure and in its table.",
                        not_steady, judged, count["drifting"], count["jumping"], count["switching"],
                        count["too_short"]));
    if (unaveraged > 0)
        remarks.push_back(fmt::format(
            "{} of them have fewer than {} periods after their warm-up and are not averaged.",
            unaveraged, min_periods_of_an_average));
    if (!disagreeing.empty())
        remarks.push_back(fmt::format(
            "At {} of {} points the seeds scatter more than the errors within the runs explain: "
            "{}. The errors given there are those between the seeds; if the runs are steady, these "
            "points are mixtures of states that last longer than a run.",
            disagreeing.size(), results.size(), first_few(disagreeing)));
    return remarks;
}

MadeFigure finished(const PaperFigure& figure, const FigurePlan& plan,
                    const std::map<std::string, Json>& runs, const fs::path& out) {
    std::vector<Json> in_order;
    for (const PaperPoint& point : plan.points) {
        std::vector<Json> seeds;
        for (const PaperTask& task : point.runs) seeds.push_back(runs.at(task.key)["result"]);
        in_order.push_back(seed_ensemble(seeds));
        if (!point.name.empty()) in_order.back()["point"] = point.name;
    }
    MadeFigure made{std::string(figure.name), std::string(figure.description), {}};
    const std::vector<std::string> remarks = remarks_on(plan, in_order, runs);
    try {
        made.outcome = plan.finish(in_order, out);
    } catch (const Failure& failure) {
        made.problem = failure.what();
    }
    auto& findings = made.outcome.findings;
    findings.insert(findings.end(), remarks.begin(), remarks.end());
    return made;
}

void draw(MadeFigure& made, const FigurePlan& plan, const PaperControl& control) {
    if (!plan.is_drawn || !made.problem.empty()) return;
    auto& files = made.outcome.files;
    try {
        const std::vector<fs::path> drawn = draw_figure(files.front(), control.stop);
        files.insert(files.end(), drawn.begin(), drawn.end());
    } catch (const Failure& failure) {
        made.problem = failure.what();
    }
}

/// Runs the remaining tasks in parallel.
void run_all(Work& work, const PaperSettings& settings, const PaperControl& control,
             const ResultStore& store, PaperResult& all) {
    StudyProgress progress(control, work.cost());
    std::mutex results_mutex;
    try {
        parallel_for(
            work.left.size(),
            [&](std::size_t k) {
                if (stopped(control)) throw_interrupted(settings);
                Json part = result_of(*work.left[k], control, store, progress);
                const std::lock_guard lock(results_mutex);
                all.failed += failed(part["result"]) ? 1 : 0;
                work.results[work.left[k]->key] = std::move(part);
            },
            control.threads);
    } catch (const Interrupted&) {
        throw_interrupted(settings);
    }
    for (const PaperTask* task : work.left)
        all.task_seconds += work.results[task->key]["seconds"].get<double>();
}

/// Doubles the seeds of the points on which undecided claims rest. Returns false if there are none,
/// or if their budget is used.
bool add_seeds_to_undecided(PaperSettings& settings, const std::vector<FigurePlan>& plans,
                            const PaperControl& control, PaperResult& all) {
    run_python_script("judge_claims.py", {settings.out.string()}, control.stop);
    const Json found = Json::parse(read_whole_file(settings.out / "verdicts.json"));
    std::map<std::string, int> seeds;
    for (const FigurePlan& plan : plans)
        for (const PaperPoint& point : plan.points)
            seeds[point.name] = static_cast<int>(point.runs.size());
    bool more = false;
    all.undecided_points = 0;
    for (const Json& name : found["points_to_decide"]) {
        const auto known = seeds.find(name.get<std::string>());
        if (known == seeds.end()) continue;
        if (2 * known->second > settings.max_seeds()) {
            ++all.undecided_points;
            continue;
        }
        settings.seeds_of_point[known->first] = 2 * known->second;
        more = true;
    }
    return more;
}

}  // namespace

PaperResult make_figures(const std::vector<PaperFigure>& figures, const PaperSettings& given,
                         const PaperControl& control, bool decide) {
    const auto begin = std::chrono::steady_clock::now();
    const ResultStore store(given.out);
    PaperSettings settings = given;
    std::vector<FigurePlan> plans;
    PaperResult all;
    std::map<std::string, Json> results;
    for (bool first = true;; first = false) {
        plans.clear();
        for (const PaperFigure& figure : figures) plans.push_back(figure.plan(settings));
        Work work(plans, store, std::move(results));
        all.tasks = work.tasks.size();
        if (first) {
            all.reused = work.results.size();
            for (const auto& [key, part] : work.results)
                all.task_seconds += part["seconds"].get<double>();
        }
        run_all(work, settings, control, store, all);
        for (const auto& [key, larger] : work.served) work.results[key] = work.results.at(larger);
        all.figures.clear();
        for (std::size_t f = 0; f < plans.size(); ++f)
            all.figures.push_back(finished(figures[f], plans[f], work.results, settings.out));
        results = std::move(work.results);
        if (!decide || !add_seeds_to_undecided(settings, plans, control, all)) break;
    }
    // The drawings are also independent, and take a second each.
    parallel_for(
        plans.size(),
        [&](std::size_t f) {
            if (stopped(control)) throw_interrupted(settings);
            draw(all.figures[f], plans[f], control);
        },
        control.threads);
    for (MadeFigure& made : all.figures)
        if (!made.problem.empty())
            made.outcome.findings.push_back(
                fmt::format("This figure could not be made: {}", made.problem));
    all.seconds = seconds_since(begin);
    return all;
}

PaperResult run_share(const std::vector<PaperFigure>& figures, const PaperSettings& settings,
                      const PaperControl& control, const PaperShare& share) {
    const auto begin = std::chrono::steady_clock::now();
    const ResultStore store(settings.out);
    std::vector<FigurePlan> plans;
    for (const PaperFigure& figure : figures) plans.push_back(figure.plan(settings));
    PaperResult all;
    Work work(plans, store, {});
    work.keep(share);
    all.tasks = work.left.size();
    run_all(work, settings, control, store, all);
    all.seconds = seconds_since(begin);
    return all;
}

std::vector<fs::path> write_report(const PaperResult& result, const PaperSettings& settings,
                                   const std::string& command, const std::atomic<bool>* stop) {
    Json figures = Json::array();
    for (const MadeFigure& figure : result.figures) {
        Json files = Json::array();
        for (const fs::path& file : figure.outcome.files) files.push_back(file.filename().string());
        figures.push_back({{"name", figure.name},
                           {"description", figure.description},
                           {"findings", figure.outcome.findings},
                           {"files", files}});
    }
    const Json about{{"command", command},
                     {"version", version()},
                     {"build", build_description()},
                     {"quick", settings.quick},
                     {"seed", settings.seed},
                     {"events_of_a_run", settings.events_of_a_run()},
                     {"defaults", config_json(paper_run(settings))},
                     {"seeds_of_a_point", settings.seeds()},
                     {"max_seeds_of_a_point", settings.max_seeds()},
                     {"undecided_points", result.undecided_points},
                     {"runs", result.tasks},
                     {"runs_of_earlier_calls", result.reused},
                     {"runs_that_failed", result.failed},
                     {"seconds", result.seconds},
                     {"seconds_on_one_core", result.task_seconds},
                     {"figures", figures}};
    const fs::path file = settings.out / "paper.json";
    write_file_atomically(file, about.dump(2) + "\n");
    run_python_script("report.py", {settings.out.string()}, stop);
    return {file, settings.out / "report.md", settings.out / "report.html",
            settings.out / "report.pdf"};
}

std::vector<fs::path> draw_figure(const fs::path& table, const std::atomic<bool>* stop) {
    run_python_script("draw.py", {table.string()}, stop);
    std::vector<fs::path> drawn;
    for (const char* kind : {".png", ".pdf"})
        drawn.push_back(fs::path(table).replace_extension(kind));
    return drawn;
}

}  // namespace swirl
