// swirl.sweep(), swirl.crossing(), swirl.parameter_map() and swirl.map(): many runs, planned and
// executed by swirl/study.
#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include <fmt/format.h>

#include <algorithm>
#include <mutex>
#include <optional>

#include "calls.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/measurements.hpp"
#include "swirl/study/collected_sweep.hpp"
#include "swirl/study/crossing.hpp"
#include "swirl/study/map.hpp"
#include "swirl/study/map_plan.hpp"
#include "swirl/study/point_table.hpp"
#include "swirl/study/search_folder.hpp"
#include "swirl/study/sweep.hpp"
#include "swirl/study/sweep_folder.hpp"

namespace swirl::python {
namespace {

using ProgressCallback = std::optional<py::function>;

/// The latest progress that worker threads have reported, for the thread that calls Python.
template <class... Parts>
class LatestProgress {
  public:
    void report(Parts... parts) {
        const std::lock_guard lock(mutex_);
        latest_ = std::tuple(parts...);
    }
    void forward_to(const ProgressCallback& callback) {
        std::optional<std::tuple<Parts...>> latest;
        {
            const std::lock_guard lock(mutex_);
            std::swap(latest, latest_);
        }
        if (callback && latest) std::apply(*callback, *latest);
    }

  private:
    std::mutex mutex_;
    std::optional<std::tuple<Parts...>> latest_;
};

using Rows = std::optional<std::vector<py::dict>>;

/// The rows of a table of points. A value None is not given.
std::vector<PointRow> point_rows(const std::vector<py::dict>& given, std::int64_t replicas) {
    std::vector<PointRow> rows;
    for (const py::dict& cells : given) {
        const std::string where = fmt::format("points, row {}", rows.size() + 1);
        const py::dict parameters = cells.attr("copy")();
        // A table may have the former name of the column.
        const py::object former = parameters.attr("pop")("seeds", py::none());
        const py::object own_replicates = parameters.attr("pop")("replicates", former);
        try {
            ParameterTexts texts = texts_of(parameters);
            if (!own_replicates.is_none()) texts["replicates"] = py::str(own_replicates);
            rows.push_back(point_row(where, texts, replicas));
        } catch (const py::type_error& error) {
            throw py::type_error(where + ": " + error.what());
        }
    }
    return rows;
}

SweepPlan plan_of(const py::dict& given, std::int64_t replicas,
                  const std::vector<std::string>& measured, int frames, const std::string& chain,
                  bool series, const Rows& rows) {
    SweepPlan plan = rows ? make_plan(point_rows(*rows, replicas), lists_of(given))
                          : make_plan(lists_of(given), replicas);
    plan.measure = measured;
    plan.frames = frames;
    plan.series = series;
    plan.chain = plain_name(chain);
    validate_extras(plan);
    return plan;
}

/// The parameters of every point as texts, including its seed.
std::vector<std::map<std::string, std::string>> points_of(const SweepPlan& plan) {
    std::vector<std::map<std::string, std::string>> points;
    for (std::size_t point = 0; point < plan.points(); ++point) {
        const ParameterTexts texts = swirl::texts_of(plan.config(point));
        points.emplace_back(texts.begin(), texts.end());
    }
    return points;
}

/// The files of the results of each row, and of the messages of failed runs; none for a row that
/// the sweep does not have.
std::vector<std::vector<std::pair<std::string, std::string>>> result_files(
    const std::string& folder, const std::vector<py::dict>& rows, std::int64_t replicas) {
    const SweepPlan plan = read_plan(folder);
    std::vector<std::vector<std::pair<std::string, std::string>>> files;
    for (const auto& points : points_of_rows(plan, point_rows(rows, replicas))) {
        files.emplace_back();
        for (const std::size_t point : points)
            files.back().emplace_back(result_file(folder, plan, point).string(),
                                      failure_file(folder, point).string());
    }
    return files;
}

/// Runs all points, or those of some rows in this order.
py::tuple sweep(const std::string& folder, unsigned threads, const ProgressCallback& callback,
                const Rows& rows) {
    const SweepPlan plan = read_plan(folder);
    SweepShare share;
    share.threads = threads;
    if (rows) {
        share.only.emplace();
        for (const auto& points : points_of_rows(plan, point_rows(*rows, 1)))
            share.only->insert(share.only->end(), points.begin(), points.end());
    }
    std::atomic<bool> stop = false;
    LatestProgress<double, double, std::uint64_t> latest;
    SweepControl control;
    control.stop = &stop;
    control.progress = [&](double done, double all, std::uint64_t events) {
        latest.report(done, all, events);
    };
    const SweepOutcome outcome = interruptible(
        stop, [&] { return run_sweep(folder, plan, share, control); },
        [&] { latest.forward_to(callback); });
    return py::make_tuple(outcome.done, outcome.failed, outcome.elsewhere, outcome.first_failure);
}

py::tuple collect(const std::string& folder) {
    const SweepPlan plan = read_plan(folder);
    const CollectedSweep collected = collect_sweep(folder, plan);
    const SweepStatus status = sweep_status(folder, plan, Counted::results);
    return py::make_tuple(
        collected.table.csv(), status.points, status.done, status.running, status.failed,
        collected.disagreeing, collected.not_steady, collected.without_period,
        plan.chain.empty() ? std::string()
                           : loop_table(plan, collected.loops, collected.loop_quantities).csv());
}

/// The parameters of all runs but their number of discs.
ParameterTexts search_parameters(const py::dict& given, std::int64_t minimum,
                                 std::int64_t maximum) {
    if (minimum < 1 || maximum < minimum || static_cast<double>(maximum) > max_discs)
        throw UsageError(fmt::format(
            "min_discs is {} and max_discs {}, but min_discs must be at least 1 and max_discs at "
            "least min_discs.",
            minimum, maximum));
    ParameterTexts texts = texts_of(given);
    texts.try_emplace("events", default_search_events);
    reject_listed_particles(texts);
    return texts;
}

py::tuple crossing(const std::optional<std::string>& folder, const py::dict& given,
                   std::int64_t minimum, std::int64_t maximum, double tolerance,
                   const std::string& rate, unsigned threads, const std::string& command,
                   const ProgressCallback& callback, std::int64_t min_periods) {
    ParameterTexts texts = search_parameters(given, minimum, maximum);
    if (!(tolerance > 0.0))
        throw UsageError(fmt::format("tolerance is {}, but it must be above 0.", tolerance));
    CrossingSettings settings;
    settings.rate = rate_named(rate);
    settings.from = minimum;
    settings.to = maximum;
    settings.to_is_default = maximum == CrossingRules{}.to;
    settings.tolerance = tolerance;
    settings.min_periods = min_periods;
    texts["discs"] = std::to_string(minimum);
    settings.config = resolve(texts);
    fit_range(settings);
    validate(settings);
    std::optional<SearchFolder> stored;
    if (folder) {
        const SweepPlan plan = search_plan(texts, minimum, maximum);
        write_plan(*folder, plan);
        stored.emplace(*folder, plan, plan.parameters(0));
    }
    std::atomic<bool> stop = false;
    LatestProgress<std::string, double> latest;
    CrossingControl control;
    control.stop = &stop;
    control.threads = threads;
    control.progress = [&](const std::string& stage, double speed) { latest.report(stage, speed); };
    if (stored) control.stored = &*stored;
    const CrossingResult search = interruptible(
        stop, [&] { return search_crossing(settings, control); },
        [&] { latest.forward_to(callback); });
    return py::make_tuple(crossing_json(settings, search, command),
                          crossing_report(settings, search));
}

MapAxisText axis_of(const py::dict& axis) {
    const ParameterTexts texts = lists_of(axis);
    if (texts.empty()) return {};
    return {texts.begin()->first, texts.begin()->second};
}

void write_map_plan(const std::string& folder, const py::dict& x, const py::dict& y,
                    const std::string& of, const std::string& rate, double level,
                    std::optional<double> change, double tolerance, std::int64_t steps,
                    std::int64_t replicates, std::int64_t minimum, std::int64_t maximum,
                    const py::dict& given) {
    MapSettings settings{.x = axis_of(x),
                         .y = axis_of(y),
                         .of = of,
                         .rate = rate,
                         .level = level,
                         .change = change,
                         .tolerance = tolerance};
    settings.steps = steps;
    settings.max_runs = replicates;
    settings.from = minimum;
    settings.to = maximum;
    settings.parameters = texts_of(given);
    const SweepPlan plan = make_map_plan(settings);
    write_plan(folder, plan);
}

/// What is not given does not change.
void grow_map(const std::string& folder, const py::dict& x, const py::dict& y, std::int64_t steps,
              std::optional<std::int64_t> replicates, std::optional<std::int64_t> minimum,
              std::optional<std::int64_t> maximum) {
    const SweepPlan before = read_plan(folder);
    const MapGrowth growth{.axes = {axis_of(x), axis_of(y)},
                           .steps = steps,
                           .max_runs = replicates,
                           .from = minimum,
                           .to = maximum};
    write_plan(folder, grown_map(before, growth), &before);
}

/// The table as CSV, and the report.
py::tuple make_map(const std::string& folder, unsigned threads, const ProgressCallback& callback) {
    const SweepPlan plan = read_plan(folder);
    SweepShare share;
    share.threads = threads;
    std::atomic<bool> stop = false;
    LatestProgress<std::size_t, std::size_t, std::uint64_t> latest;
    MapControl control;
    control.stop = &stop;
    control.progress = [&](std::size_t decided, std::size_t sites, double, double,
                           std::uint64_t events) { latest.report(decided, sites, events); };
    const MapOutcome outcome = interruptible(
        stop, [&] { return run_map(folder, plan, share, control); },
        [&] { latest.forward_to(callback); });
    return py::make_tuple(map_table(plan, outcome.state).csv(), map_summary(plan, outcome.state),
                          first_failure(folder, plan));
}

}  // namespace

void bind_studies(py::module_& module) {
    py::class_<SweepPlan>(module, "Plan")
        .def(py::init(&plan_of), py::arg("parameters"), py::arg("replicates"), py::arg("measured"),
             py::arg("frames"), py::arg("chain") = "", py::arg("series") = false,
             py::arg("rows") = py::none(),
             R"(__init__(self, parameters: dict[str, Any], replicates: int, measured: list[str],
    frames: int, chain: str = "", series: bool = False,
    rows: Optional[list[dict[str, Any]]] = None) -> None)")
        .def("__len__", &SweepPlan::points, "__len__(self) -> int")
        .def_property_readonly(
            "axes",
            [](const SweepPlan& plan) {
                py::dict axes;
                for (const SweepAxis& axis : plan.axes) axes[py::str(axis.name)] = axis.values;
                return axes;
            },
            "-> dict[str, list[str]]")
        .def("points", &points_of, "points(self) -> list[dict[str, str]]")
        .def(
            "write",
            [](const SweepPlan& plan, const std::string& folder) { write_plan(folder, plan); },
            "write(self, folder: str) -> None");
    module.def(
        "grow",
        [](const std::string& folder, const py::dict& more, std::int64_t replicas,
           const std::vector<std::string>& measured, const Rows& rows) {
            const SweepPlan before = read_plan(folder);
            const ParameterTexts texts = lists_of(more);
            const auto plan = [&] {
                if (!rows) return grown(before, texts, replicas, measured);
                return grown(before, point_rows(*rows, std::max<std::int64_t>(replicas, 1)), texts,
                             measured);
            };
            write_plan(folder, plan(), &before);
        },
        R"(grow(folder: str, more: dict[str, Any], replicates: int, measured: Sequence[str],
    rows: Optional[list[dict[str, Any]]]) -> None)");
    module.def(
        "run_identity",
        [](const py::dict& given) {
            return fmt::format("{:016x}", identity_of(resolve(texts_of(given))));
        },
        "run_identity(parameters: dict[str, Any]) -> str");
    module.def("result_files", &result_files,
               R"(result_files(folder: str, rows: list[dict[str, Any]],
    replicates: int) -> list[list[tuple[str, str]]])");
    module.def("sweep", &sweep, py::arg("folder"), py::arg("threads"), py::arg("progress"),
               py::arg("rows") = py::none(),
               R"(sweep(folder: str, threads: int,
    progress: Optional[Callable[[float, float, int], object]],
    rows: Optional[list[dict[str, Any]]] = None) -> tuple[int, int, int, str])");
    module.def("collect", &collect,
               "collect(folder: str) -> tuple[str, int, int, int, int, int, int, int, str]");
    module.def("crossing", &crossing, py::arg("folder"), py::arg("parameters"),
               py::arg("min_discs"), py::arg("max_discs"), py::arg("tolerance"), py::arg("rate"),
               py::arg("threads"), py::arg("command"), py::arg("progress"),
               py::arg("min_periods") = CrossingSettings{}.min_periods,
               R"(crossing(folder: Optional[str], parameters: dict[str, Any], min_discs: int,
    max_discs: int, tolerance: float, rate: str, threads: int, command: str,
    progress: Optional[Callable[[str, float], object]],
    min_periods: int = 50) -> tuple[str, str])");
    module.def("write_map_plan", &write_map_plan,
               R"(write_map_plan(folder: str, x: dict[str, Any], y: dict[str, Any], quantity: str,
    rate: str, level: float, change: Optional[float], tolerance: float, steps: int,
    replicates: int, min_discs: int, max_discs: int, parameters: dict[str, Any]) -> None)");
    module.def("grow_map", &grow_map,
               R"(grow_map(folder: str, x: dict[str, Any], y: dict[str, Any], steps: int,
    replicates: Optional[int], min_discs: Optional[int],
    max_discs: Optional[int]) -> None)");
    module.def("make_map", &make_map,
               R"(make_map(folder: str, threads: int,
    progress: Optional[Callable[[int, int, int], object]]) -> tuple[str, str, str])");
}

}  // namespace swirl::python
