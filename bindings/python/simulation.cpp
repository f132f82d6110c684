// swirl.Simulation, event by event.
#include <pybind11/stl.h>

#include <fmt/format.h>

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <optional>

#include "arrays.hpp"
#include "calls.hpp"
#include "custom_scene.hpp"
#include "frames.hpp"
#include "simulation_archive.hpp"
#include "swirl/run/collapse_guard.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/initial_parameter.hpp"
#include "swirl/run/json.hpp"
#include "swirl/run/ramp.hpp"
#include "swirl/run/simd.hpp"

namespace swirl::python {
namespace {

/// An event as a row of a numpy array. It has no padding, so equal events are equal bytes.
struct EventRow {
    std::int64_t whole_periods;
    double clock, time;
    std::int64_t kind, i, j;
    double normal_x, normal_y, normal_impulse, tangential_impulse, overlap;
};

EventRow row_of(const Event& e, double time) {
    return {e.periods,
            e.clock,
            time,
            static_cast<std::int64_t>(e.kind),
            e.i,
            e.j,
            e.normal.x,
            e.normal.y,
            e.impulse.normal,
            e.impulse.tangential,
            e.overlap};
}

bool ramps_change_path(const RunConfig& config) {
    return config.ramp_of("amplitude") != nullptr || config.ramp_of("period") != nullptr;
}

/// A simulation that Python drives. Any thread may call it; simultaneous calls wait for each other.
class InteractiveSimulation {
  public:
    InteractiveSimulation(RunConfig config, bool is_custom, InitialState scene,
                          const Progress& progress, const std::atomic<bool>* stop = nullptr)
        : config_(std::move(config)),
          is_custom_(is_custom),
          scene_(std::move(scene)),
          simulation_(scene_, progress, selected_tuning(stop)),
          guard_(simulation_, scene_.path.period),
          since_(last_period_change(config_, progress.periods)) {
        scene_.discs.clear();
        scene_.discs.shrink_to_fit();
    }
    static std::unique_ptr<InteractiveSimulation> from_bytes(std::string_view bytes) {
        ArchivedSimulation a = read_archive(bytes);
        return std::make_unique<InteractiveSimulation>(a.config, a.is_custom, std::move(a.scene),
                                                       a.progress);
    }

    /// Calls work(simulation) with exclusive access. It waits without the interpreter lock, which
    /// the thread that has access may need.
    auto exclusively(auto&& work) {
        std::unique_lock lock(mutex_, std::try_to_lock);
        if (!lock) {
            if (process_ != getpid())
                throw Failure(
                    "another thread was advancing this simulation when the process was forked, so "
                    "the copy in the child is unusable.\nhint: fork between two calls, or load a "
                    "saved simulation in the child.");
            const WithoutInterpreter without;
            lock.lock();
        }
        process_ = getpid();
        return work(simulation_);
    }

    py::array step(std::int64_t count) {
        constexpr std::int64_t maximum = std::int64_t{1} << 26;
        if (count < 0 || count > maximum)
            throw UsageError(fmt::format(
                "count is {}, but it must be from 0 to {}: an array of events must fit into "
                "memory.\nhint: advance(events=...) has no such limit.",
                count, maximum));
        py::array_t<EventRow> rows(count);
        EventRow* const begin = rows.mutable_data();
        std::int64_t done = 0;
        repeat_interruptibly([&] {
            for (const auto end = std::min(count, done + events_per_step); done < end; ++done) {
                const Event event = simulation_.step();
                begin[done] = row_of(event, time_at(event.periods, event.clock));
                follow_ramps(event.periods);
            }
            return done < count;
        });
        return rows;
    }
    Event next() {
        return exclusively([&](Simulation& s) {
            const Event event = s.step();
            follow_ramps(event.periods);
            throw_if_collapsed();
            return event;
        });
    }
    void run(std::int64_t count) {
        if (count < 0)
            throw UsageError(fmt::format("events is {}, but it must be 0 or more.", count));
        repeat_interruptibly([&] {
            const std::int64_t part = std::min(count, events_per_step);
            execute(static_cast<std::uint64_t>(part));
            count -= part;
            return count > 0;
        });
    }
    void advance(double duration) {
        repeat_interruptibly([&, to = std::optional<Time>()]() mutable {
            if (!to) to = time_after(duration);
            return !advance_towards(*to);
        });
    }
    void advance_periods(double number) {
        repeat_interruptibly([&, to = std::optional<Time>()]() mutable {
            if (!to) to = time_after_periods(number);
            return !advance_towards(*to);
        });
    }
    void advance_to(std::int64_t periods, double clock) {
        if (const double period = period_in(periods); !(clock >= 0.0 && clock < period))
            throw UsageError(fmt::format(
                "clock is {}, but it must be from 0 to below the period, {}.", clock, period));
        repeat_interruptibly([&, checked = false]() mutable {
            const Progress now = simulation_.progress();
            if (!checked &&
                (periods < now.periods || (periods == now.periods && clock < now.clock)))
                throw UsageError(fmt::format(
                    "the target is period {} and clock {}, but the simulation is at period {} and "
                    "clock {} and cannot go back.",
                    periods, clock, now.periods, now.clock));
            checked = true;
            return !advance_towards({periods, clock});
        });
    }
    std::shared_ptr<Frames> sample(std::int64_t count, std::int64_t per_period) {
        auto frames = std::make_shared<Frames>();
        std::optional<Time> begin;
        std::int64_t k = 0;
        repeat_interruptibly([&] {
            if (!begin) {
                begin = {simulation_.periods(), simulation_.clock()};
                require_one_period(*begin, double(count - 1) / double(per_period));
                frames->reserve(static_cast<std::size_t>(count), simulation_.size());
            }
            const Time time = normalised(
                {begin->periods + k / per_period,
                 begin->clock + scene_.path.period * double(k % per_period) / double(per_period)},
                scene_.path.period);
            if (!advance_towards(time)) return true;
            if (k == count) return false;
            frames->add(simulation_, scene_.path, since_);
            ++k;
            return true;
        });
        return frames;
    }
    SingleFrame snapshot() {
        return exclusively([&](Simulation& s) {
            Snapshot now = s.snapshot();
            now.periods_at_change = since_.periods;
            now.time_at_change = since_.time;
            return SingleFrame(now);
        });
    }
    std::string to_bytes() {
        ArchivedSimulation archived{config_, is_custom_, scene_, {}};
        exclusively([&](Simulation& s) {
            archived.progress = s.progress();
            for (std::size_t i = 0; i < s.size(); ++i) archived.scene.discs.push_back(s.disc(i));
        });
        return archive_bytes(std::move(archived));
    }

    std::string config() const { return config_text(config_); }
    bool is_custom() const { return is_custom_; }
    double period() const { return scene_.path.period; }
    double time() {
        return exclusively([&](Simulation& s) { return time_at(s.periods(), s.clock()); });
    }
    double container_radius() const { return scene_.container_radius; }
    /// Time, x and y at the beginning of each segment.
    std::vector<double> path() const {
        std::vector<double> vertices;
        for (const Segment& segment : scene_.path.segments)
            vertices.insert(vertices.end(), {segment.begin, segment.start.x, segment.start.y});
        return vertices;
    }

  private:
    struct Time {
        std::int64_t periods;
        double clock;
    };

    /// Events between two checks for Ctrl-C. They take a few milliseconds.
    static constexpr std::int64_t events_per_step = 4096;

    /// Calls step() until it returns false. Other Python threads run meanwhile. Ctrl-C ends it
    /// between two steps.
    void repeat_interruptibly(auto&& step) {
        PendingError error;
        exclusively([&](Simulation&) {
            const WithoutInterpreter without;
            constexpr auto interval = std::chrono::milliseconds(50);
            bool receives_signals = true;
            auto last = std::chrono::steady_clock::now();
            while (step()) {
                throw_if_collapsed();
                const auto now = std::chrono::steady_clock::now();
                if (!receives_signals || now - last < interval) continue;
                last = now;
                error.check_signals([&] { receives_signals = is_main_thread(); });
                if (error) break;
            }
        });
        error.rethrow();
    }

    /// In a collapse time does not advance, and a call that waits for a time would never return.
    void throw_if_collapsed() {
        if (auto sentence = guard_.problem(simulation_, scene_.path.period, config_))
            throw Failure(*sentence);
    }

    /// To be called after each event with the period before it: at the start of a period, ramps
    /// change the surroundings.
    void follow_ramps(std::int64_t period_before) {
        const std::int64_t period = simulation_.periods();
        if (config_.ramps.empty() || period == period_before || !changes_in_period(config_, period))
            return;
        InitialState next = surroundings_in(config_, period);
        if (!ramps_change_path(config_)) next.path = scene_.path;  // it may be custom
        simulation_.change_surroundings(next, selected_tuning(nullptr));
        if (period_in(period) != scene_.path.period) since_ = {period, time_at(period, 0.0)};
        scene_ = std::move(next);
    }
    /// Executes all events of the present period but its last, at most `maximum`. Returns whether
    /// these were fewer.
    bool run_in_period(std::uint64_t& maximum) {
        EventSpan span;
        simulation_.run_before(never, maximum, span);
        maximum -= span.events;
        return maximum > 0;
    }
    void end_period() {
        const std::int64_t before = simulation_.periods();
        simulation_.step();
        follow_ramps(before);
    }
    void execute(std::uint64_t count) {
        if (config_.ramps.empty()) return simulation_.run(count);
        for (; count > 0 && run_in_period(count); --count) end_period();
    }
    /// Returns true when the time is reached.
    bool advance_towards(const Time& time) {
        auto left = static_cast<std::uint64_t>(events_per_step);
        while (!config_.ramps.empty() && simulation_.periods() < time.periods) {
            if (!run_in_period(left)) return false;
            end_period();
        }
        if (const auto problem = simulation_.problem_with_time(time.periods, time.clock))
            throw UsageError(*problem);
        return simulation_.advance_to(time.periods, time.clock, left);
    }

    double time_at(std::int64_t periods, double clock) const {
        return since_.time + static_cast<double>(periods - since_.periods) * scene_.path.period +
               clock;
    }
    /// Length of a period, which a ramp may change.
    double period_in(std::int64_t period) const {
        const Ramp* const ramp = config_.ramp_of("period");
        return ramp ? ramp->value_in(period) : scene_.path.period;
    }
    /// All frames have the same length of the period. `length`: from the first to the last one, in
    /// periods.
    void require_one_period(const Time& begin, double length) const {
        const Ramp* const ramp = config_.ramp_of("period");
        if (!ramp) return;
        const double last = std::floor(begin.clock / scene_.path.period + length);
        for (std::int64_t k = 1; double(k) <= last && begin.periods + k <= ramp->end; ++k)
            if (period_in(begin.periods + k) != scene_.path.period)
                throw UsageError(fmt::format(
                    "sample() returns frames of one length of the period, but the ramp changes it "
                    "in period {}.\nhint: call sample() for one period at a time.",
                    begin.periods + k));
    }
    /// The same time with a clock below the period, in periods of one length.
    static Time normalised(const Time& time, double period) {
        if (time.clock < period) return time;
        const double whole = std::floor(time.clock / period);
        const std::int64_t periods = time.periods + static_cast<std::int64_t>(whole);
        const double clock = std::max(0.0, time.clock - whole * period);
        return clock >= period ? Time{periods + 1, 0.0} : Time{periods, clock};
    }
    Time time_after_periods(double number) const {
        if (!config_.ramp_of("period")) return time_after(number * scene_.path.period);
        const double share = simulation_.clock() / scene_.path.period + number;
        const double whole = std::floor(share);
        const std::int64_t period = simulation_.periods() + static_cast<std::int64_t>(whole);
        return {period, (share - whole) * period_in(period)};
    }
    Time time_after(double duration) const {
        if (const Ramp* const ramp = config_.ramp_of("period")) {
            Time time{simulation_.periods(), simulation_.clock() + duration};
            for (; time.periods < ramp->end && time.clock >= period_in(time.periods);
                 ++time.periods)
                time.clock -= period_in(time.periods);
            return normalised(time, period_in(time.periods));
        }
        const double period = scene_.path.period;
        const double periods = std::floor(duration / period);
        return normalised({simulation_.periods() + static_cast<std::int64_t>(periods),
                           simulation_.clock() + (duration - periods * period)},
                          period);
    }

    const RunConfig config_;
    const bool is_custom_;  // discs or path were given as arrays
    InitialState scene_;    // a scene without discs
    // A signal handler may use the simulation that it interrupts.
    std::recursive_mutex mutex_;
    // The last one that locked the mutex. A fork copies the lock of a thread that the child lacks.
    std::atomic<pid_t> process_ = getpid();
    Simulation simulation_;
    CollapseGuard guard_;
    PeriodChange since_;
};

std::unique_ptr<InteractiveSimulation> make_simulation(const py::dict& parameters,
                                                       const std::optional<GivenDiscs>& given,
                                                       const std::optional<Numbers>& path,
                                                       const std::optional<Numbers>& path_times) {
    const RunConfig config = resolve(texts_of(parameters));
    if (path && ramps_change_path(config))
        throw UsageError(
            "ramp changes the amplitude or the period, but path defines the path.\nhint: give path "
            "as an array with the columns t, x and y.");
    const bool is_custom = given || path;
    if (is_custom && config.shape() != Shape::disc)
        throw UsageError("position and path are allowed only for discs without a floor.");
    if (path_times && !path) throw UsageError("motion_times is given, but motion is not.");
    std::atomic<bool> stop = false;
    InitialState scene;
    if (given) {
        RunConfig one_disc = config;
        one_disc.discs = 1;
        one_disc.mixture.reset();
        one_disc.sizes.reset();
        one_disc.initial.clear();
        scene = make_initial_state(one_disc);
    } else {
        scene = interruptible(stop, [&] { return make_initial_state(config, &stop); });
    }
    if (path) {
        const Segment before = scene.path.segments.front();
        scene.path = polygon(*path, path_times, config.period);
        const Segment& segment = scene.path.segments.front();
        for (Disc& d : scene.discs) {
            d.position = d.position + (segment.start - before.start);
            d.velocity = d.velocity + (segment.velocity - before.velocity);
        }
    }
    if (given) scene.discs = discs_of(*given, config, scene.path.segments.front());
    if (is_custom) require_valid_discs(scene, scene.path.segments.front().start, initial_overlap);
    return interruptible(stop, [&] {
        return std::make_unique<InteractiveSimulation>(config, is_custom, std::move(scene),
                                                       Progress{}, &stop);
    });
}

std::optional<GivenDiscs> discs_in(const py::dict& columns) {
    if (!columns.contains("position")) return std::nullopt;
    const auto array = [&](const char* name) -> std::optional<Numbers> {
        if (!columns.contains(name)) return {};
        return py::cast<Numbers>(columns[name]);
    };
    return GivenDiscs{*array("position"), array("velocity"),   array("angle"),
                      array("spin"),      array("radius"),     array("mass"),
                      array("inertia"),   array("cannot_spin")};
}

void bind_events(py::module_& module) {
    PYBIND11_NUMPY_DTYPE(EventRow, whole_periods, clock, time, kind, i, j, normal_x, normal_y,
                         normal_impulse, tangential_impulse, overlap);
    module.attr("event_dtype") = py::dtype::of<EventRow>();
    py::class_<Event> type(
        module, "Event",
        R"(An event: its kind (EventKind), its time, and the discs i and j (j = i at the wall).)");
    forbid_construction(type);
    type.def_readonly("whole_periods", &Event::periods, "-> int")
        .def_readonly("clock", &Event::clock, "-> float")
        .def_property_readonly(
            "kind", [](const Event& e) { return static_cast<int>(e.kind); }, "-> int")
        .def_readonly("i", &Event::i, "-> int")
        .def_readonly("j", &Event::j, "-> int")
        .def_property_readonly(
            "normal", [](const Event& e) { return py::make_tuple(e.normal.x, e.normal.y); },
            R"(-> tuple[float, float]

Unit vector from i to j, or from i to the wall.)")
        .def_property_readonly(
            "normal_impulse", [](const Event& e) { return e.impulse.normal; }, R"(-> float

Impulse on j or on the wall, along the normal.)")
        .def_property_readonly(
            "tangential_impulse", [](const Event& e) { return e.impulse.tangential; }, R"(-> float

Impulse on j or on the wall, along (n_y, −n_x).)")
        .def_readonly("overlap", &Event::overlap, R"(-> float

Depth of the contact: a rounding error.)");
}

}  // namespace

void bind_simulation(py::module_& module) {
    bind_events(module);
    using Self = InteractiveSimulation;
    py::class_<Self>(module, "Simulation")
        .def(py::init([](const py::dict& parameters, const py::dict& discs,
                         const std::optional<Numbers>& path,
                         const std::optional<Numbers>& path_times) {
                 return make_simulation(parameters, discs_in(discs), path, path_times);
             }),
             py::arg("parameters"), py::arg("discs"), py::arg("path"), py::arg("path_times"),
             R"(__init__(self, parameters: dict[str, Any], discs: dict[str, _Floats],
    path: Optional[_Floats], path_times: Optional[_Floats]) -> None)")
        .def("step", &Self::step, "step(self, count: int) -> npt.NDArray[np.void]")
        .def("next", &Self::next, "next(self) -> Event")
        .def("run", &Self::run, "run(self, count: int) -> None")
        .def("advance", &Self::advance, "advance(self, time: float) -> None")
        .def("advance_periods", &Self::advance_periods,
             "advance_periods(self, number: float) -> None")
        .def("advance_to", &Self::advance_to,
             "advance_to(self, whole_periods: int, clock: float) -> None")
        .def("sample", &Self::sample, "sample(self, count: int, per_period: int) -> Frames")
        .def("snapshot", &Self::snapshot, "snapshot(self) -> Snapshot")
        .def(
            "to_bytes", [](Self& s) { return py::bytes(s.to_bytes()); }, "to_bytes(self) -> bytes")
        .def_static(
            "from_bytes", [](const py::bytes& b) { return Self::from_bytes(std::string_view(b)); },
            "from_bytes(data: bytes) -> Simulation")
        .def("config", &Self::config, "config(self) -> str")
        .def_property_readonly("is_custom", &Self::is_custom, "-> bool")
        .def_property_readonly("period", &Self::period, "-> float")
        .def_property_readonly("time", &Self::time, "-> float")
        .def_property_readonly("container_radius", &Self::container_radius, "-> float")
        .def("path", &Self::path, "path(self) -> list[float]")
        .def(
            "__len__",
            [](Self& self) { return self.exclusively([](Simulation& s) { return s.size(); }); },
            "__len__(self) -> int")
        .def(
            "counts",
            [](Self& self) {
                const EventCounts c = self.exclusively([](Simulation& s) { return s.events(); });
                return py::make_tuple(c.disc_disc, c.disc_wall, c.path_vertex, c.elastic_by_tc,
                                      c.begins_to_roll);
            },
            "counts(self) -> tuple[int, int, int, int, int]")
        .def(
            "now",
            [](Self& self) {
                return self.exclusively(
                    [](Simulation& s) { return py::make_tuple(s.periods(), s.clock()); });
            },
            "now(self) -> tuple[int, float]")
        .def(
            "state_hash",
            [](Self& self) {
                return self.exclusively(
                    [](Simulation& s) { return fmt::format("{:016x}", s.state_hash()); });
            },
            "state_hash(self) -> str");
}

}  // namespace swirl::python
