// swirl.run(): one run, with what its caller measures himself on the way.
#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "arrays.hpp"
#include "calls.hpp"
#include "frames.hpp"
#include "reports.hpp"
#include "swirl/io/atomic_file.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/json.hpp"
#include "swirl/run/measurements.hpp"
#include "swirl/run/recorded_run.hpp"
#include "swirl/run/report.hpp"
#include "swirl/run/run.hpp"
#include "swirl/run/version.hpp"
#include "swirl/statistics/block_average.hpp"

namespace swirl::python {
namespace {

/// Called with the fraction, the events and the periods so far; None: nobody wants to know.
using Told = std::optional<py::function>;

/// What the caller measures: once in every period after the warm-up, told its frames.
struct OwnMeasurement {
    int frames_per_period = samples_per_period;
    std::optional<py::function> period_ended;
};

/// Ctrl-C and progress, a few times a second. Its address goes into the control of the run.
class Listening {
  public:
    Listening(RunControl& control, Told told)
        : told_(std::move(told)), listens_(told_ || is_main_thread()) {
        control.stop = &stop_;
        if (listens_)
            control.progress = [this](const RunProgress& progress) {
                listen([&] {
                    if (told_) (*told_)(progress.fraction, progress.events, progress.periods);
                });
            };
    }
    void listen(const std::function<void()>& more) {
        raised_.listen(more);
        if (raised_) stop_ = true;
    }
    const Raised& raised() const { return raised_; }
    std::atomic<bool>& stop() { return stop_; }

  private:
    const Told told_;
    const bool listens_;
    std::atomic<bool> stop_ = false;
    Raised raised_;
};

RunResult run_with_own(Run& run, const OwnMeasurement& own, Listening& listening) {
    SampleTimes times = run.sample_times(own.frames_per_period);
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
        listening.listen([&] {
            (*own.period_ended)(frames);
            frames = std::make_shared<Frames>();  // who kept those keeps them
        });
    }
    return run.result();
}

RunResult run_alone(Run& run) {
    while (run.next_event()) run.pass_event();
    return run.result();
}

/// The JSON of the result, the reports, and what was raised on the way or None.
py::tuple run_once(const py::dict& given, const std::vector<std::string>& measured,
                   const std::string& command, const Told& told, const OwnMeasurement& own,
                   const RunFiles& files, const std::string& recorded_as) {
    const RunConfig config = resolve(texts_of(given));
    Observation observation = observation_of(config, measured);
    RunControl control;
    if (!observation.empty()) control.observation = &observation;
    Listening listens(control, told);

    const bool records =
        !files.trajectory.empty() || !files.event_log.empty() || !files.checkpoint.empty();
    if (records && own.period_ended)
        throw UsageError(
            "A run that is recorded cannot have measurements of one's own; swirl.analyse() of its "
            "recording can.");
    RunResult result;
    if (records) {
        const WithoutInterpreter without;
        result = run_recorded(config, files, control, provenance_of(config, recorded_as, ""));
        if (result.complete) forget_checkpoint(files);
    } else {
        // Places for many discs may be sought for seconds.
        const auto run =
            listening(listens.stop(), [&] { return std::make_unique<Run>(config, control); });
        const WithoutInterpreter without;
        result = own.period_ended ? run_with_own(*run, own, listens) : run_alone(*run);
    }
    nlohmann::ordered_json json = result_json(result);
    json["command"] = command;
    json["config_text"] = "";
    const MeasurementReports reports = observation.report();
    if (!reports.empty()) json["measured"] = measured_json(reports);
    return py::make_tuple(json.dump(2), reports_in_python(reports), listens.raised().object(),
                          headline(result), report(result) + warning_lines(result));
}

/// Rows of numbers, a row for every block, as series of their own.
py::tuple estimates(const py::array_t<double, py::array::c_style | py::array::forcecast>& sums,
                    const py::array_t<double, py::array::c_style | py::array::forcecast>& weights) {
    if (sums.ndim() != 2 || weights.ndim() != 2 || sums.shape(0) != weights.shape(0) ||
        sums.shape(1) != weights.shape(1))
        throw UsageError("Sums and weights of blocks must be tables of the same shape.");
    const auto blocks = static_cast<std::size_t>(sums.shape(0));
    const auto columns = static_cast<std::size_t>(sums.shape(1));
    std::vector<double> means, errors, effective;
    for (std::size_t c = 0; c < columns; ++c) {
        BlockSeries series;
        for (std::size_t b = 0; b < blocks; ++b)
            series.add(sums.data()[b * columns + c], weights.data()[b * columns + c]);
        const Estimate e = series.estimate();
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
    if (given.contains("frames")) files.frames.per_swirl = py::cast<int>(given["frames"]);
    files.resume = given.contains("resume") && py::cast<bool>(given["resume"]);
    files.overwrite = given.contains("overwrite") && py::cast<bool>(given["overwrite"]);
    return files;
}

py::list parameter_table() {
    py::list table;
    for (const Parameter& p : run_parameters)
        if (p.is_settable())
            table.append(py::make_tuple(p.name, p.symbol, p.unit, plain_sentence(p.description),
                                        default_of(p), p.range.lowest, p.range.highest, p.group));
    return table;
}

}  // namespace

void bind_runs(py::module_& module) {
    module.def(
        "run",
        [](const py::dict& given, const std::vector<std::string>& measured,
           const std::string& command, const Told& told, int frames_per_period,
           const std::optional<py::function>& period_ended, const py::dict& files) {
            return run_once(given, measured, command, told, {frames_per_period, period_ended},
                            run_files(files), command);
        },
        py::arg("parameters"), py::arg("measured"), py::arg("command"), py::arg("progress"),
        py::arg("frames_per_period"), py::arg("period_ended"), py::arg("files"));
    module.def("resolve",
               [](const py::dict& given) { return config_text(resolve(texts_of(given))); });
    module.def("measurement_list",
               [](const std::string& list) { return read_measurement_list(list); });
    module.def("measurement_kinds", [] {
        py::list kinds;
        for (const MeasurementKind& kind : measurement_kinds())
            kinds.append(py::make_tuple(kind.name, kind.header, kind.description));
        return kinds;
    });
    module.def("estimates", &estimates);
    module.def("with_error", &with_error);
    module.def("parameters", &parameter_table);
    module.def("version", &version);
    module.def("build_description", &build_description);
    module.attr("samples_per_period") = samples_per_period;
}

}  // namespace swirl::python
