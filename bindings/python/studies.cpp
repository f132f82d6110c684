// swirl.sweep(), swirl.crossing(), swirl.map(): many runs, as swirl/study plans and does them.
#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include <fmt/format.h>

#include <mutex>
#include <optional>

#include "calls.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/measurements.hpp"
#include "swirl/study/collected_sweep.hpp"
#include "swirl/study/crossing_search.hpp"
#include "swirl/study/sweep.hpp"

namespace swirl::python {
namespace {

using Told = std::optional<py::function>;

/// What other threads say while this one waits, handed on when it is asked for.
template <class... Parts>
class Latest {
  public:
    void say(Parts... parts) {
        const std::lock_guard turn(turn_);
        said_ = std::tuple(parts...);
        is_new_ = true;
    }
    void hand_on(const Told& told) {
        std::optional<std::tuple<Parts...>> said;
        {
            const std::lock_guard turn(turn_);
            if (is_new_) said = said_;
            is_new_ = false;
        }
        if (told && said) std::apply(*told, *said);
    }

  private:
    std::mutex turn_;
    std::tuple<Parts...> said_;
    bool is_new_ = false;
};

SweepPlan plan_of(const py::dict& given, std::int64_t replicas,
                  const std::vector<std::string>& measured, int frames) {
    if (replicas < 1 || replicas > 1'000'000)
        throw UsageError(
            fmt::format("seeds is {}, but it must be a whole number from 1 to 1000000.", replicas));
    if (frames < 0 || frames > 1'000'000)
        throw UsageError(
            fmt::format("frames is {}, but it must be a whole number from 0 to 1000000.", frames));
    SweepPlan plan = make_plan(lists_of(given), replicas);
    plan.measure = measured;
    plan.frames = frames;
    return plan;
}

/// The parameters of every point, as texts, with the seed that is its own.
std::vector<std::map<std::string, std::string>> points_of(const SweepPlan& plan) {
    std::vector<std::map<std::string, std::string>> points;
    for (std::size_t point = 0; point < plan.points(); ++point) {
        const ParameterTexts texts = swirl::texts_of(plan.config(point));
        points.emplace_back(texts.begin(), texts.end());
    }
    return points;
}

py::tuple sweep(const std::string& folder, unsigned threads, const Told& told) {
    const SweepPlan plan = read_plan(folder);
    SweepShare share;
    share.threads = threads;
    std::atomic<bool> stop = false;
    Latest<double, double, std::uint64_t> latest;
    SweepControl control;
    control.stop = &stop;
    control.progress = [&](double done, double all, std::uint64_t events) {
        latest.say(done, all, events);
    };
    const SweepOutcome outcome = listening(
        stop, [&] { return run_sweep(folder, plan, share, control); },
        [&] { latest.hand_on(told); });
    return py::make_tuple(outcome.done, outcome.failed, outcome.elsewhere, outcome.first_failure);
}

py::tuple collect(const std::string& folder) {
    const SweepPlan plan = read_plan(folder);
    const CollectedSweep collected = collect_sweep(folder, plan);
    const SweepStatus status = sweep_status(folder, plan);
    return py::make_tuple(collected.table.csv(), status.points, status.done, status.running,
                          status.failed, collected.disagreeing, collected.not_steady,
                          collected.without_period);
}

CrossingSettings crossing_settings(const py::dict& given, std::int64_t minimum,
                                   std::int64_t maximum, double tolerance,
                                   const std::string& rate) {
    if (minimum < 1 || maximum < minimum || static_cast<double>(maximum) > max_discs)
        throw UsageError(
            fmt::format("The range of discs is {} to {}, but it must go up, from 1 at least.",
                        minimum, maximum));
    if (!(tolerance > 0.0))
        throw UsageError(fmt::format("tolerance is {}, but it must be above 0.", tolerance));
    ParameterTexts texts = texts_of(given);
    texts.try_emplace("events", default_search_events);
    texts["discs"] = std::to_string(maximum);  // only what is searched has to fit
    CrossingSettings settings;
    settings.rate = rate_named(rate);
    settings.config = resolve(texts);
    settings.from = minimum;
    settings.to = maximum;
    settings.tolerance = tolerance;
    return settings;
}

py::tuple crossing(const py::dict& given, std::int64_t minimum, std::int64_t maximum,
                   double tolerance, const std::string& rate, unsigned threads,
                   const std::string& command, const Told& told) {
    const CrossingSettings settings = crossing_settings(given, minimum, maximum, tolerance, rate);
    std::atomic<bool> stop = false;
    Latest<std::string, double> latest;
    CrossingControl control;
    control.stop = &stop;
    control.threads = threads;
    control.progress = [&](const std::string& stage, double speed) { latest.say(stage, speed); };
    const CrossingSearch search = listening(
        stop, [&] { return search_crossing(settings, control); }, [&] { latest.hand_on(told); });
    return py::make_tuple(crossing_json(settings, search, command),
                          crossing_report(settings, search));
}

}  // namespace

void bind_studies(py::module_& module) {
    py::class_<SweepPlan>(module, "Plan")
        .def(py::init(&plan_of), py::arg("parameters"), py::arg("seeds"), py::arg("measured"),
             py::arg("frames"))
        .def("__len__", &SweepPlan::points)
        .def_property_readonly("axes",
                               [](const SweepPlan& plan) {
                                   py::dict axes;
                                   for (const SweepAxis& axis : plan.axes)
                                       axes[py::str(axis.name)] = axis.values;
                                   return axes;
                               })
        .def("points", &points_of)
        .def("write", [](const SweepPlan& plan, const std::string& folder) {
            std::error_code failed;
            std::filesystem::create_directories(folder, failed);
            if (failed)
                throw Failure(fmt::format("'{}' cannot be made: {}.", folder, failed.message()));
            write_plan(folder, plan);
        });
    module.def("grow", [](const std::string& folder, const py::dict& more, std::int64_t replicas,
                          const std::vector<std::string>& measured) {
        const SweepPlan before = read_plan(folder);
        write_plan(folder, grown(before, lists_of(more), replicas, measured), &before);
    });
    module.def("sweep", &sweep);
    module.def("collect", &collect);
    module.def("crossing", &crossing);
}

}  // namespace swirl::python
