// swirl.run(): one run, with the caller's custom measurements.
#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "arrays.hpp"
#include "calls.hpp"
#include "frames.hpp"
#include "reports.hpp"
#include "swirl/io/atomic_file.hpp"
#include "swirl/io/short_values.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/json.hpp"
#include "swirl/run/measurements.hpp"
#include "swirl/run/period_series.hpp"
#include "swirl/run/recorded_run.hpp"
#include "swirl/run/report.hpp"
#include "swirl/run/run.hpp"
#include "swirl/run/version.hpp"
#include "swirl/statistics/block_average.hpp"
#include "swirl/statistics/few_blocks.hpp"

namespace swirl::python {
namespace {

/// Called with (fraction, events, periods) so far; None: no progress is reported.
using ProgressCallback = std::optional<py::function>;

/// `period_ended` is called with the frames of each period after the warm-up.
struct CustomMeasurement {
    int frames_per_period = samples_per_period;
    std::optional<py::function> period_ended;
};

/// Checks for Ctrl-C and reports progress a few times per second. The control of the run refers to
/// it, so it must not move.
class RunMonitor {
  public:
    RunMonitor(RunControl& control, ProgressCallback callback) : callback_(std::move(callback)) {
        control.stop = &stop_;
        if (callback_ || is_main_thread())
            control.progress = [this](const RunProgress& progress) {
                check_signals([&] {
                    if (callback_)
                        (*callback_)(progress.fraction, progress.events, progress.periods);
                });
            };
    }
    void check_signals(const std::function<void()>& more) {
        error_.check_signals(more);
        if (error_) stop_ = true;
    }
    const PendingError& error() const { return error_; }
    std::atomic<bool>& stop() { return stop_; }

  private:
    const ProgressCallback callback_;
    std::atomic<bool> stop_ = false;
    PendingError error_;
};

RunResult run_with_custom(Run& run, const CustomMeasurement& custom, RunMonitor& monitor) {
    SampleTimes times = run.sample_times(custom.frames_per_period);
    auto frames = std::make_shared<Frames>();
    std::int64_t periods = 0;
    while (run.next_event()) {
        while (run.next_sample(times))
            if (run.is_warm()) frames->add(run.snapshot());
        run.pass_event();
        if (run.event().kind != EventKind::path_vertex || run.snapshot().periods == periods)
            continue;
        periods = run.snapshot().periods;
        if (frames->size() == 0) continue;
        monitor.check_signals([&] {
            (*custom.period_ended)(frames);
            frames = std::make_shared<Frames>();  // Python may still use the old ones
        });
    }
    return run.result();
}

RunResult run_plain(Run& run) {
    while (run.execute_events() > 0) {
    }
    return run.result();
}

/// (names, units, descriptions, values [period, column]); None without a series.
py::object series_in_python(const std::optional<PeriodSeries>& series) {
    if (!series) return py::none();
    std::vector<std::string> names, units, descriptions;
    for (const SeriesColumn& column : series->columns()) {
        names.push_back(column.name);
        units.push_back(column.unit);
        descriptions.push_back(column.description);
    }
    return py::make_tuple(names, units, descriptions,
                          owned_array(std::vector<double>(series->values()),
                                      {static_cast<py::ssize_t>(series->periods()),
                                       static_cast<py::ssize_t>(names.size())}));
}

/// Returns (JSON of the result, reports, exception during the run or None, headline, report,
/// series).
py::tuple run_once(const py::dict& given, const std::vector<std::string>& measured,
                   const std::string& command, const ProgressCallback& callback,
                   const CustomMeasurement& custom, const RunFiles& files, bool has_series,
                   const std::string& recorded_as) {
    const RunConfig config = resolve(texts_of(given));
    Observation observation = observation_of(config, measured);
    RunControl control;
    if (!observation.empty()) control.observation = &observation;
    std::optional<PeriodSeries> series;
    if (has_series) control.series = &series.emplace(config, measured);
    RunMonitor monitor(control, callback);

    const bool records = !files.trajectory.empty() || !files.event_log.empty() ||
                         !files.checkpoint.empty() ||
                         (!files.series.empty() && !custom.period_ended);
    if (records && custom.period_ended)
        throw UsageError(
            "a run with trajectory, event_log or checkpoint cannot have custom measurements.\n"
            "hint: use swirl.analyse() on the recording.");
    RunResult result;
    if (records) {
        const WithoutInterpreter without;
        result = run_recorded(config, files, control, provenance_of(config, recorded_as, ""));
        if (result.complete) remove_checkpoint(files);
    } else {
        // Placing many discs may take seconds.
        const auto run =
            interruptible(monitor.stop(), [&] { return std::make_unique<Run>(config, control); });
        const WithoutInterpreter without;
        result = custom.period_ended ? run_with_custom(*run, custom, monitor) : run_plain(*run);
    }
    if (!records && !files.series.empty()) series->write(files.series);
    nlohmann::ordered_json json = result_json(result);
    json["command"] = command;
    json["config_text"] = "";
    if (series) json["series"] = series_json(*series);
    const MeasurementReports reports = observation.report();
    if (!reports.empty()) json["measured"] = measured_json(reports);
    return py::make_tuple(json.dump(2), reports_in_python(reports), monitor.error().object(),
                          headline(result), report(result, true) + warning_lines(result),
                          series_in_python(series));
}

/// Means, errors and effective samples of each column. Rows are blocks.
py::tuple estimates(const Numbers& sums, const Numbers& weights) {
    if (sums.ndim() != 2 || weights.ndim() != 2 || sums.shape(0) != weights.shape(0) ||
        sums.shape(1) != weights.shape(1))
        throw UsageError("sums and weights must have the same shape, [block, column].");
    const auto blocks = static_cast<std::size_t>(sums.shape(0));
    const auto columns = static_cast<std::size_t>(sums.shape(1));
    std::vector<double> means, errors, effective;
    for (std::size_t c = 0; c < columns; ++c) {
        BlockSeries series;
        for (std::size_t b = 0; b < blocks; ++b)
            series.add(sums.data()[b * columns + c], weights.data()[b * columns + c]);
        const Estimate e = corrected(series.estimate());
        means.push_back(e.mean);
        errors.push_back(e.error);
        effective.push_back(e.effective_samples);
    }
    const auto n = static_cast<py::ssize_t>(columns);
    return py::make_tuple(owned_array(std::move(means), {n}), owned_array(std::move(errors), {n}),
                          owned_array(std::move(effective), {n}));
}

RunFiles run_files(const py::dict& given) {
    RunFiles files;
    const auto path = [&](const char* name) {
        return given.contains(name) ? std::filesystem::path(py::cast<std::string>(given[name]))
                                    : std::filesystem::path();
    };
    files.trajectory = path("trajectory");
    files.event_log = path("event_log");
    files.checkpoint = path("checkpoint");
    files.series = path("series");
    if (given.contains("frames_per_period"))
        files.frames.per_period = py::cast<int>(given["frames_per_period"]);
    files.resume = given.contains("resume") && py::cast<bool>(given["resume"]);
    files.overwrite = given.contains("overwrite") && py::cast<bool>(given["overwrite"]);
    return files;
}

py::list parameter_table() {
    py::list table;
    for (const Parameter& p : run_parameters)
        if (p.is_settable())
            table.append(py::make_tuple(user_name(p.name), p.symbol, p.unit,
                                        python_message(p.description), default_of(p),
                                        p.range.lowest, p.range.highest, p.group));
    return table;
}

}  // namespace

void bind_runs(py::module_& module) {
    module.def(
        "run",
        [](const py::dict& given, const std::vector<std::string>& measured,
           const std::string& command, const ProgressCallback& callback, int frames_per_period,
           const std::optional<py::function>& period_ended, const py::dict& files,
           bool has_series) {
            return run_once(given, measured, command, callback, {frames_per_period, period_ended},
                            run_files(files), has_series, command);
        },
        py::arg("parameters"), py::arg("measured"), py::arg("command"), py::arg("progress"),
        py::arg("frames_per_period"), py::arg("period_ended"), py::arg("files"), py::arg("series"),
        R"(run(parameters: dict[str, Any], measured: list[str], command: str,
    progress: Optional[Callable[[float, int, float], object]],
    frames_per_period: int, period_ended: Optional[Callable[[Frames], None]],
    files: dict[str, Any], series: bool) -> tuple[str, list[Report],
    Optional[BaseException], str, str, Optional[_SeriesColumns]])");
    module.def(
        "resolve", [](const py::dict& given) { return config_text(resolve(texts_of(given))); },
        "resolve(parameters: dict[str, Any]) -> str");
    module.def(
        "measurement_list", [](const std::string& list) { return read_measurement_list(list); },
        "measurement_list(names: str) -> list[str]");
    module.def(
        "measurement_kinds",
        [] {
            py::list kinds;
            for (const MeasurementKind& kind : measurement_kinds())
                kinds.append(py::make_tuple(kind.name, kind.header, kind.description));
            return kinds;
        },
        "measurement_kinds() -> list[tuple[str, str, str]]");
    module.def("estimates", &estimates,
               "estimates(sums: _Floats, weights: _Floats) -> tuple[_Floats, _Floats, _Floats]");
    module.def("with_error", &with_error, "with_error(mean: float, error: float) -> str");
    module.def(
        "shortened", [](const std::string& text) { return shortened(text); },
        "shortened(text: str) -> str");
    module.def("parameters", &parameter_table,
               "parameters() -> list[tuple[str, str, str, str, str, float, float, str]]");
    module.def("version", &version, "version() -> str");
    module.def("build_description", &build_description, "build_description() -> str");
    module.attr("samples_per_period") = samples_per_period;
}

}  // namespace swirl::python
