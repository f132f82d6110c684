// swirl.Simulation, event by event.
#include <pybind11/stl.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <optional>

#include "arrays.hpp"
#include "calls.hpp"
#include "custom_scene.hpp"
#include "frames.hpp"
#include "simulation_archive.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/json.hpp"
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

EventRow row_of(const Event& e, double period) {
    return {e.periods,
            e.clock,
            static_cast<double>(e.periods) * period + e.clock,
            static_cast<std::int64_t>(e.kind),
            e.i,
            e.j,
            e.normal.x,
            e.normal.y,
            e.impulse.normal,
            e.impulse.tangential,
            e.overlap};
}

/// A simulation that Python drives. Any thread may call it; simultaneous calls wait for each other.
class InteractiveSimulation {
  public:
    InteractiveSimulation(RunConfig config, bool is_custom, InitialState scene,
                          const Progress& progress, const std::atomic<bool>* stop = nullptr)
        : config_(std::move(config)),
          is_custom_(is_custom),
          scene_(std::move(scene)),
          simulation_(scene_, progress, selected_tuning(stop)) {
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
    template <class Work>
    auto exclusively(Work&& work) {
        std::unique_lock lock(mutex_, std::try_to_lock);
        if (!lock) {
            const WithoutInterpreter without;
            lock.lock();
        }
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
            for (const auto end = std::min(count, done + events_per_step); done < end; ++done)
                begin[done] = row_of(simulation_.step(), scene_.path.period);
            return done < count;
        });
        return rows;
    }
    Event next() {
        return exclusively([](Simulation& s) { return s.step(); });
    }
    void run(std::int64_t count) {
        if (count < 0)
            throw UsageError(fmt::format("events is {}, but it must be 0 or more.", count));
        repeat_interruptibly([&] {
            const std::int64_t part = std::min(count, events_per_step);
            simulation_.run(static_cast<std::uint64_t>(part));
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
    void advance_to(std::int64_t periods, double clock) {
        if (!(clock >= 0.0 && clock < scene_.path.period))
            throw UsageError(
                fmt::format("clock is {}, but it must be from 0 to below the period, {}.", clock,
                            scene_.path.period));
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
                frames->reserve(static_cast<std::size_t>(count), simulation_.size());
            }
            const Time time = normalised(
                {begin->periods + k / per_period,
                 begin->clock + scene_.path.period * double(k % per_period) / double(per_period)});
            if (!advance_towards(time)) return true;
            if (k == count) return false;
            frames->add(simulation_, scene_.path);
            ++k;
            return true;
        });
        return frames;
    }
    SingleFrame snapshot() {
        return exclusively([](Simulation& s) { return SingleFrame(s.snapshot()); });
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
    double period() const { return scene_.path.period; }
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
    template <class Step>
    void repeat_interruptibly(Step&& step) {
        PendingError error;
        exclusively([&](Simulation&) {
            const WithoutInterpreter without;
            constexpr auto interval = std::chrono::milliseconds(50);
            bool receives_signals = true;
            auto last = std::chrono::steady_clock::now();
            while (step()) {
                const auto now = std::chrono::steady_clock::now();
                if (!receives_signals || now - last < interval) continue;
                last = now;
                error.check_signals([&] { receives_signals = is_main_thread(); });
                if (error) break;
            }
        });
        error.rethrow();
    }

    /// Returns true when the time is reached.
    bool advance_towards(const Time& time) {
        return simulation_.advance_to(time.periods, time.clock,
                                      static_cast<std::uint64_t>(events_per_step));
    }
    /// The same time with a clock below the period.
    Time normalised(const Time& time) const {
        const double period = scene_.path.period;
        if (time.clock < period) return time;
        const double whole = std::floor(time.clock / period);
        const std::int64_t periods = time.periods + static_cast<std::int64_t>(whole);
        const double clock = std::max(0.0, time.clock - whole * period);
        return clock >= period ? Time{periods + 1, 0.0} : Time{periods, clock};
    }
    Time time_after(double duration) const {
        const double period = scene_.path.period;
        const double periods = std::floor(duration / period);
        return normalised({simulation_.periods() + static_cast<std::int64_t>(periods),
                           simulation_.clock() + (duration - periods * period)});
    }

    const RunConfig config_;
    const bool is_custom_;  // discs or path were given as arrays
    InitialState scene_;    // without discs
    // A signal handler may use the simulation that it interrupts.
    std::recursive_mutex mutex_;
    Simulation simulation_;
};

std::unique_ptr<InteractiveSimulation> make_simulation(const py::dict& parameters,
                                                       const std::optional<GivenDiscs>& given,
                                                       const std::optional<Numbers>& path,
                                                       const std::optional<Numbers>& path_times) {
    const RunConfig config = resolve(texts_of(parameters));
    if (!config.ramps.empty())
        throw UsageError(
            "ramp is given, but a Simulation has none.\nhint: swirl.run(ramp=...) runs it; "
            "series=True returns the averages of every period.");
    const bool is_custom = given || path;
    if (is_custom && config.shape() != Shape::disc)
        throw UsageError("position and path are allowed only for discs without a floor.");
    if (path_times && !path) throw UsageError("path_times is given, but path is not.");
    std::atomic<bool> stop = false;
    InitialState scene;
    if (given) {
        RunConfig one_disc = config;
        one_disc.discs = 1;
        one_disc.mixture.reset();
        one_disc.sizes.reset();
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
    // Discs of a snapshot may be in contact, and then overlap by a rounding error.
    constexpr double rounding = 1e-9;
    if (is_custom) require_no_overlap(scene, scene.path.segments.front().start, rounding);
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
    return GivenDiscs{*array("position"), array("velocity"), array("angle"),  array("spin"),
                      array("radius"),    array("mass"),     array("inertia")};
}

void bind_events(py::module_& module) {
    PYBIND11_NUMPY_DTYPE(EventRow, whole_periods, clock, time, kind, i, j, normal_x, normal_y,
                         normal_impulse, tangential_impulse, overlap);
    module.attr("event_dtype") = py::dtype::of<EventRow>();
    py::class_<Event> type(module, "Event",
                           "An event: its kind (swirl.EventKind), its time (whole_periods and\n"
                           "clock), and the discs i and j.");
    forbid_construction(type);
    type.def_readonly("whole_periods", &Event::periods)
        .def_readonly("clock", &Event::clock)
        .def_property_readonly("kind", [](const Event& e) { return static_cast<int>(e.kind); })
        .def_readonly("i", &Event::i)
        .def_readonly("j", &Event::j)
        .def_property_readonly(
            "normal", [](const Event& e) { return py::make_tuple(e.normal.x, e.normal.y); })
        .def_property_readonly("normal_impulse", [](const Event& e) { return e.impulse.normal; })
        .def_property_readonly("tangential_impulse",
                               [](const Event& e) { return e.impulse.tangential; })
        .def_readonly("overlap", &Event::overlap);
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
             py::arg("parameters"), py::arg("discs"), py::arg("path"), py::arg("path_times"))
        .def("step", &Self::step)
        .def("next", &Self::next)
        .def("run", &Self::run)
        .def("advance", &Self::advance)
        .def("advance_to", &Self::advance_to)
        .def("sample", &Self::sample)
        .def("snapshot", &Self::snapshot)
        .def("to_bytes", [](Self& s) { return py::bytes(s.to_bytes()); })
        .def_static("from_bytes",
                    [](const py::bytes& b) { return Self::from_bytes(std::string_view(b)); })
        .def("config", &Self::config)
        .def_property_readonly("period", &Self::period)
        .def_property_readonly("container_radius", &Self::container_radius)
        .def("path", &Self::path)
        .def("__len__",
             [](Self& self) { return self.exclusively([](Simulation& s) { return s.size(); }); })
        .def("counts",
             [](Self& self) {
                 const EventCounts c = self.exclusively([](Simulation& s) { return s.events(); });
                 return py::make_tuple(c.disc_disc, c.disc_wall, c.path_vertex, c.elastic_by_tc,
                                       c.begins_to_roll);
             })
        .def("now",
             [](Self& self) {
                 return self.exclusively(
                     [](Simulation& s) { return py::make_tuple(s.periods(), s.clock()); });
             })
        .def("state_hash", [](Self& self) {
            return self.exclusively(
                [](Simulation& s) { return fmt::format("{:016x}", s.state_hash()); });
        });
}

}  // namespace swirl::python
