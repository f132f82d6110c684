#include "lab/paper.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <mutex>
#include <numeric>

#include "files/file_error.hpp"
#include "files/whole_file.hpp"
#include "lab/all_cores.hpp"
#include "lab/failure.hpp"
#include "lab/measurements.hpp"
#include "lab/paper_parts.hpp"
#include "lab/python_script.hpp"
#include "lab/run_json.hpp"
#include "lab/version.hpp"

namespace swirl {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

namespace {

/// How far all tasks are together, from what each says of itself.
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

Json work_on(const PaperTask& task, const PaperControl& control, StudyProgress& progress) {
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

/// Of a whole set of measurements, in events.
constexpr double cost_of_a_look = 6.0;

double seconds_since(std::chrono::steady_clock::time_point begin) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// What every run has unless its figure says otherwise.
RunConfig paper_run(const PaperSettings& settings) {
    RunConfig config;
    config.events = settings.events_of_a_run();
    config.seed = settings.seed;
    return config;
}

[[noreturn]] void throw_interrupted(const PaperSettings& settings) {
    throw Interrupted(fmt::format(
        "Stopped before the end; what is done is kept in '{}', and the same call continues there.",
        (settings.out / "parts").string()));
}

}  // namespace

const PaperFigure& paper_figure(const std::string& name) {
    std::string known;
    for (const PaperFigure& figure : paper_figures()) {
        if (figure.name == name) return figure;
        known += fmt::format("{}{}", known.empty() ? "" : ", ", figure.name);
    }
    throw WrongCall(fmt::format("--figure is '{}', but it must be one of: {}.", name, known));
}

// In the paper's dish 480 at N = 28 and 3400 at N = 48; few when it is thin, by the corners alone.
double expected_events_per_swirl(const RunConfig& config) {
    const double filled = static_cast<double>(config.discs) * config.radius * config.radius /
                          (config.container_radius * config.container_radius);
    return config.sides + static_cast<double>(config.discs) * (5.0 + 275.0 * std::pow(filled, 3.3));
}

PaperTask run_task(const std::string& key, const RunConfig& config,
                   const std::vector<std::string>& measurements) {
    const double events =
        config.periods ? expected_events_per_swirl(config) * static_cast<double>(*config.periods)
                       : static_cast<double>(config.events);
    const double swirls = events / expected_events_per_swirl(config);
    const double looks = measurements.empty() ? 0.0 : looks_per_swirl * swirls;
    const double cost = events + looks * cost_of_a_look;
    return {key, cost, [config, measurements](const RunControl& control) {
                const MeasuredRun done = measured_run(config, measurements, control);
                if (!done.run.complete) throw Interrupted("Stopped.");
                Json json = result_json(done.run);
                json["measured"] = done.measured;
                return json;
            }};
}

PaperResult make_figures(const std::vector<PaperFigure>& figures, const PaperSettings& settings,
                         const PaperControl& control) {
    const auto begin = std::chrono::steady_clock::now();
    const PaperParts parts(settings.out);
    PaperResult all;

    std::vector<FigurePlan> plans;
    std::map<std::string, PaperTask> tasks;
    for (const PaperFigure& figure : figures) {
        plans.push_back(figure.plan(settings));
        for (const PaperTask& task : plans.back().tasks) tasks.emplace(task.key, task);
    }
    std::map<std::string, Json> results;
    std::vector<const PaperTask*> left;
    std::map<std::string, std::string> served;  // by another task
    for (const auto& [key, task] : tasks) {
        if (auto known = parts.recall(key))
            results[key] = std::move(*known);
        else if (!task.served_by.empty() && tasks.contains(task.served_by))
            served[key] = task.served_by;
        else if (auto larger = parts.recall(task.served_by))
            results[key] = std::move(*larger);
        else
            left.push_back(&task);
    }
    all.tasks = tasks.size();
    all.remembered = results.size();
    std::stable_sort(left.begin(), left.end(),
                     [](const PaperTask* a, const PaperTask* b) { return a->cost > b->cost; });

    const double total =
        std::accumulate(left.begin(), left.end(), 0.0,
                        [](double sum, const PaperTask* t) { return sum + t->cost; });
    StudyProgress progress(control, total);
    std::mutex results_mutex;
    try {
        on_all_cores(
            left.size(),
            [&](std::size_t k) {
                if (stopped(control)) throw_interrupted(settings);
                const auto started = std::chrono::steady_clock::now();
                const Json result = work_on(*left[k], control, progress);
                Json part = parts.remember(left[k]->key, result, seconds_since(started));
                const std::lock_guard lock(results_mutex);
                results[left[k]->key] = std::move(part);
            },
            control.threads);
    } catch (const Interrupted&) {
        throw_interrupted(settings);
    }

    for (const auto& [key, part] : results) all.task_seconds += part["seconds"].get<double>();
    for (const auto& [key, larger] : served) results[key] = results.at(larger);

    for (std::size_t f = 0; f < plans.size(); ++f) {
        std::vector<Json> in_order;
        for (const PaperTask& task : plans[f].tasks)
            in_order.push_back(results.at(task.key)["result"]);
        all.figures.push_back(
            {figures[f].name, figures[f].description, plans[f].finish(in_order, settings.out)});
    }
    // The drawings are independent too, and take a second each.
    std::vector<std::vector<fs::path>> drawn(plans.size());
    on_all_cores(
        plans.size(),
        [&](std::size_t f) {
            if (stopped(control)) throw_interrupted(settings);
            if (!plans[f].script.empty())
                drawn[f] = draw_figure(plans[f].script, all.figures[f].outcome.files.front());
        },
        control.threads);
    for (std::size_t f = 0; f < plans.size(); ++f) {
        auto& files = all.figures[f].outcome.files;
        files.insert(files.end(), drawn[f].begin(), drawn[f].end());
    }
    all.seconds = seconds_since(begin);
    return all;
}

std::vector<fs::path> write_report(const PaperResult& result, const PaperSettings& settings,
                                   const std::string& command) {
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
                     {"runs", result.tasks},
                     {"runs_of_earlier_calls", result.remembered},
                     {"seconds", result.seconds},
                     {"seconds_on_one_core", result.task_seconds},
                     {"figures", figures}};
    const fs::path file = settings.out / "paper.json";
    write_whole_file(file, about.dump(2) + "\n");
    run_python_script("report.py", {settings.out.string()});
    return {file, settings.out / "report.md", settings.out / "report.html"};
}

std::vector<fs::path> draw_figure(const std::string& script, const fs::path& table) {
    run_python_script(script, {table.string()});
    std::vector<fs::path> drawn;
    for (const char* kind : {".png", ".pdf"})
        drawn.push_back(fs::path(table).replace_extension(kind));
    return drawn;
}

}  // namespace swirl
