// swirl.Simulation, event by event, and what is seen of it: Snapshot and Frames.
#include <pybind11/stl.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numeric>
#include <optional>

#include "arrays.hpp"
#include "calls.hpp"
#include "frames.hpp"
#include "swirl/engine/continuation.hpp"
#include "swirl/engine/simulation.hpp"
#include "swirl/io/checksum.hpp"
#include "swirl/io/file_error.hpp"
#include "swirl/io/range_checks.hpp"
#include "swirl/io/state_archive.hpp"
#include "swirl/measure/cluster_rotation.hpp"
#include "swirl/measure/m_frame.hpp"
#include "swirl/run/config.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/json.hpp"
#include "swirl/run/simd.hpp"

namespace swirl::python {
namespace {

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

// --- what was seen
// --------------------------------------------------------------------------------

/// One instant: frames of which there is one.
struct Look {
    Frames frames;

    explicit Look(const Snapshot& snapshot) {
        frames.reserve(1, snapshot.size());
        frames.add(snapshot);
    }
    Snapshot snapshot() const { return frames.frame(0); }
};

py::ssize_t signed_size(std::size_t n) { return static_cast<py::ssize_t>(n); }

template <class Owner, class Column, class Shape>
auto column(Column Frames::*member, Shape shape) {
    return [member, shape](const py::object& self) {
        const auto& owner = py::cast<const Owner&>(self);
        if constexpr (std::is_same_v<Owner, Look>)
            return view_of(owner.frames.*member, shape(owner.frames), self);
        else
            return view_of(owner.*member, shape(owner), self);
    };
}

using Extent = std::vector<py::ssize_t>;
Extent per_disc(const Frames& f) { return {signed_size(f.discs)}; }
Extent per_disc_xy(const Frames& f) { return {signed_size(f.discs), 2}; }
Extent per_frame(const Frames& f) { return {signed_size(f.size())}; }
Extent per_frame_xy(const Frames& f) { return {signed_size(f.size()), 2}; }
Extent per_frame_and_disc(const Frames& f) { return {signed_size(f.size()), signed_size(f.discs)}; }
Extent per_frame_and_disc_xy(const Frames& f) {
    return {signed_size(f.size()), signed_size(f.discs), 2};
}
Extent xy(const Frames&) { return {2}; }

py::tuple rotation_of(const Look& look) {
    const Snapshot s = look.snapshot();
    const RotationSample sample = cluster_rotation(s, selected_width());
    const double omega = 2.0 * pi / s.period;
    return py::make_tuple(sample.individual / omega, sample.rigid / omega);
}

/// Columns as bytes and back, for pickle: StateWriter's (io/state_archive.hpp).
template <class Visitor>
void visit_columns(Frames& f, Visitor&& visit) {
    visit(f.discs, f.period, f.container_radius, f.on_floor, f.are_spheres, f.lie_flat, f.radius,
          f.mass, f.inertia, f.periods, f.clock, f.time, f.container_centre, f.container_velocity,
          f.position, f.velocity, f.acceleration, f.rolling_spin, f.angle, f.spin);
}
py::bytes bytes_of(const Frames& frames) {
    StateWriter write;
    Frames copy = frames;
    visit_columns(copy, write);
    return py::bytes(write.bytes());
}
Frames frames_in(const py::bytes& bytes) {
    Frames f;
    StateReader read{std::string_view(bytes)};
    visit_columns(f, read);
    read.expect_end();
    const std::size_t n = f.size(), all = n * f.discs, floor = f.are_spheres ? 2 * all : 0;
    const auto is = [](std::size_t length, std::initializer_list<const std::vector<double>*> each) {
        return std::all_of(each.begin(), each.end(),
                           [&](const auto* column) { return column->size() == length; });
    };
    if (f.periods.size() != n || !is(n, {&f.clock, &f.time}) ||
        !is(2 * n, {&f.container_centre, &f.container_velocity}) ||
        !is(f.discs, {&f.radius, &f.mass, &f.inertia}) ||
        !is(2 * all, {&f.position, &f.velocity}) ||
        !is(floor, {&f.acceleration, &f.rolling_spin}) || !is(all, {&f.angle, &f.spin}))
        throw FileError("These are no frames of swirl.");
    for (std::size_t k = 0; k < n; ++k) require_possible(f.frame(k), Spins::maybe_unknown);
    return f;
}

/// Only we make them: what Python would begin by itself has nothing in it.
void reject_to_be_begun(py::object type) {
    type.attr("__new__") =
        py::module_::import("builtins")
            .attr("staticmethod")(py::cpp_function([](const py::args&, const py::kwargs&) {
                throw py::type_error("Simulations make these, and recordings.");
            }));
}

void bind_looks(py::module_& module) {
    module.def("snapshot_of", [](const py::bytes& bytes) {
        const Frames frames = frames_in(bytes);
        if (frames.size() != 1) throw FileError("This is no snapshot of swirl.");
        return Look(frames.frame(0));
    });
    module.def("frames_of",
               [](const py::bytes& bytes) { return std::make_shared<Frames>(frames_in(bytes)); });
    py::class_<Look> snapshot(
        module, "Snapshot",
        "All discs and the container at one instant, in the lab frame: position and velocity are\n"
        "[disc, xy], spin, angle, radius, mass and inertia [disc]. Read-only views, which never\n"
        "change. m_frame() turns it into the frame of the swirl.");
    reject_to_be_begun(snapshot);
    snapshot.def("archive", [](const Look& l) { return bytes_of(l.frames); })
        .def_property_readonly("position", column<Look>(&Frames::position, per_disc_xy))
        .def_property_readonly("velocity", column<Look>(&Frames::velocity, per_disc_xy))
        .def_property_readonly("angle", column<Look>(&Frames::angle, per_disc))
        .def_property_readonly("spin", column<Look>(&Frames::spin, per_disc))
        .def_property_readonly("rolling_spin",
                               [](const py::object& self) -> py::object {
                                   if (!py::cast<const Look&>(self).frames.are_spheres)
                                       return py::none();
                                   return column<Look>(&Frames::rolling_spin, per_disc_xy)(self);
                               })
        .def_property_readonly("radius", column<Look>(&Frames::radius, per_disc))
        .def_property_readonly("mass", column<Look>(&Frames::mass, per_disc))
        .def_property_readonly("inertia", column<Look>(&Frames::inertia, per_disc))
        .def_property_readonly("container_centre", column<Look>(&Frames::container_centre, xy))
        .def_property_readonly("container_velocity", column<Look>(&Frames::container_velocity, xy))
        .def_property_readonly("container_radius",
                               [](const Look& l) { return l.frames.container_radius; })
        .def_property_readonly("period", [](const Look& l) { return l.frames.period; })
        .def_property_readonly("swirls", [](const Look& l) { return l.frames.periods[0]; })
        .def_property_readonly("clock", [](const Look& l) { return l.frames.clock[0]; })
        .def_property_readonly("time", [](const Look& l) { return l.frames.time[0]; })
        .def("m_frame",
             [](const Look& l) {
                 const Snapshot s = l.snapshot();
                 return Look(seen_from(m_frame(s), s));
             })
        .def("rotation", &rotation_of)
        .def("__len__", [](const Look& l) { return l.frames.discs; });

    py::class_<Frames, std::shared_ptr<Frames>> frames(
        module, "Frames",
        "Snapshots of the same discs in order of time, as columns: position and velocity are\n"
        "[frame, disc, xy], spin and angle [frame, disc], time [frame]. frames[k] is a Snapshot.");
    reject_to_be_begun(frames);
    frames.def("archive", &bytes_of)
        .def_property_readonly("position", column<Frames>(&Frames::position, per_frame_and_disc_xy))
        .def_property_readonly("velocity", column<Frames>(&Frames::velocity, per_frame_and_disc_xy))
        .def_property_readonly("angle", column<Frames>(&Frames::angle, per_frame_and_disc))
        .def_property_readonly("spin", column<Frames>(&Frames::spin, per_frame_and_disc))
        .def_property_readonly("radius", column<Frames>(&Frames::radius, per_disc))
        .def_property_readonly("mass", column<Frames>(&Frames::mass, per_disc))
        .def_property_readonly("inertia", column<Frames>(&Frames::inertia, per_disc))
        .def_property_readonly("container_centre",
                               column<Frames>(&Frames::container_centre, per_frame_xy))
        .def_property_readonly("container_velocity",
                               column<Frames>(&Frames::container_velocity, per_frame_xy))
        .def_property_readonly("swirls", column<Frames>(&Frames::periods, per_frame))
        .def_property_readonly("clock", column<Frames>(&Frames::clock, per_frame))
        .def_property_readonly("time", column<Frames>(&Frames::time, per_frame))
        .def_property_readonly("container_radius",
                               [](const Frames& f) { return f.container_radius; })
        .def_property_readonly("period", [](const Frames& f) { return f.period; })
        .def_property_readonly("discs", [](const Frames& f) { return f.discs; })
        .def("m_frame",
             [](const Frames& f) {
                 auto turned = std::make_shared<Frames>();
                 turned->reserve(f.size(), f.discs);
                 for (std::size_t k = 0; k < f.size(); ++k) {
                     const Snapshot s = f.frame(k);
                     turned->add(seen_from(m_frame(s), s));
                 }
                 return turned;
             })
        .def("__len__", &Frames::size)
        .def("__getitem__", [](const Frames& f, py::ssize_t k) {
            if (k < 0) k += signed_size(f.size());
            if (k < 0 || k >= signed_size(f.size()))
                throw py::index_error(fmt::format("There are {} frames.", f.size()));
            return Look(f.frame(static_cast<std::size_t>(k)));
        });
}

// --- events
// ---------------------------------------------------------------------------------------

/// As a row of numpy; no holes, so that equal events are equal bytes.
struct EventRow {
    std::int64_t periods;
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

// --- the simulation
// -------------------------------------------------------------------------------

/// Discs that were given by their columns; radius, mass and inertia may be those of all.
struct GivenDiscs {
    Numbers position;
    std::optional<Numbers> velocity, angle, spin, radius, mass, inertia;
};

std::string shape_text(const Numbers& a) {
    std::string text;
    for (py::ssize_t d = 0; d < a.ndim(); ++d)
        text += fmt::format("{}{}", d ? " × " : "", a.shape(d));
    return a.ndim() == 0 ? "one number" : text;
}

/// Beyond, squares and products of them would not be numbers any more; the parameters of a run
/// cannot make a speed as large.
constexpr double largest_given = 1e15;

void expect_sound(const char* name, const Numbers& values) {
    for (py::ssize_t k = 0; k < values.size(); ++k)
        if (!(std::abs(values.data()[k]) <= largest_given))
            throw UsageError(
                fmt::format("{} has {} among its values, but all must be numbers from {} to {}.",
                            name, values.data()[k], -largest_given, largest_given));
}

void expect_pairs(const char* name, const Numbers& values, std::size_t rows) {
    if (values.ndim() != 2 || values.shape(1) != 2 ||
        (rows && values.shape(0) != signed_size(rows)))
        throw UsageError(fmt::format("{} is {}, but it must be {} × 2: x and y of each.", name,
                                     shape_text(values), rows ? fmt::format("{}", rows) : "N"));
    expect_sound(name, values);
}

/// One for each of n, or one for all.
std::vector<double> column_of(const char* name, const std::optional<Numbers>& values, std::size_t n,
                              double otherwise) {
    if (!values) return std::vector<double>(n, otherwise);
    expect_sound(name, *values);
    if (values->ndim() == 0) return std::vector<double>(n, *values->data());
    if (values->ndim() != 1 || values->shape(0) != signed_size(n))
        throw UsageError(fmt::format("{} is {}, but it must be {} numbers, or one for all discs.",
                                     name, shape_text(*values), n));
    return {values->data(), values->data() + n};
}

void expect_between(const char* name, const std::vector<double>& values, double from, double to) {
    for (const double value : values)
        if (!(value >= from && value <= to))
            throw UsageError(fmt::format("{} is {} of a disc, but it must be from {} to {}.", name,
                                         value, from, to));
}

/// The ranges of discs that are given one by one.
void expect_sizes_in_range(const std::vector<double>& radius, const std::vector<double>& mass,
                           const std::vector<double>& inertia) {
    expect_between("radius", radius, smallest_value, largest_value);
    expect_between("mass", mass, smallest_value, largest_value);
    expect_between("inertia", inertia, 1e-30, 1e30);
}

/// Throws for discs that lie in each other or in the wall, with the container at `centre`, by more
/// than this share of their radii.
void expect_apart(const InitialState& scene, const Vec2& centre, double rounding) {
    const std::vector<Disc>& discs = scene.discs;
    std::vector<std::size_t> order(discs.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return discs[a].position.x < discs[b].position.x;
    });
    double largest = 0.0;
    for (std::size_t i = 0; i < discs.size(); ++i) {
        const Disc& d = discs[i];
        largest = std::max(largest, d.radius);
        const double out = std::hypot(d.position.x - centre.x, d.position.y - centre.y) + d.radius -
                           scene.container_radius;
        if (out > rounding * d.radius)
            throw UsageError(fmt::format(
                "Disc {} at ({}, {}) sticks out of the container by {:.3g}: its centre is at ({}, "
                "{}), and its radius {}.",
                i, d.position.x, d.position.y, out, centre.x, centre.y, scene.container_radius));
    }
    for (std::size_t a = 0; a < order.size(); ++a)
        for (std::size_t b = a + 1; b < order.size(); ++b) {
            const Disc &p = discs[order[a]], &q = discs[order[b]];
            if (q.position.x - p.position.x > p.radius + largest) break;
            const double apart =
                std::hypot(p.position.x - q.position.x, p.position.y - q.position.y);
            const double minimum = p.radius + q.radius;
            if (apart < minimum * (1.0 - rounding))
                throw UsageError(fmt::format(
                    "Discs {} and {} are {:.6g} apart, but their radii add up to {:.6g}: no two "
                    "may "
                    "lie in each other.",
                    std::min(order[a], order[b]), std::max(order[a], order[b]), apart, minimum));
        }
}

std::vector<Disc> discs_of(const GivenDiscs& given, const RunConfig& config,
                           const Segment& segment) {
    expect_pairs("position", given.position, 0);
    const auto n = static_cast<std::size_t>(given.position.shape(0));
    if (n == 0) throw UsageError("position is 0 × 2, but there must be one disc at least.");
    if (static_cast<double>(n) > max_discs)
        throw UsageError(
            fmt::format("There are {} discs, but no more than {} can be simulated.", n, max_discs));
    if (given.velocity) expect_pairs("velocity", *given.velocity, n);
    const auto angle = column_of("angle", given.angle, n, 0.0);
    const auto spin = column_of("spin", given.spin, n, 0.0);
    const auto radius = column_of("radius", given.radius, n, config.radius);
    const auto mass = column_of("mass", given.mass, n, config.mass);
    // The same multiple of m r² for all, unless it is given.
    std::vector<double> inertia(n);
    const double multiple = config.inertia / (config.mass * config.radius * config.radius);
    for (std::size_t i = 0; i < n; ++i) inertia[i] = multiple * mass[i] * radius[i] * radius[i];
    if (given.inertia) inertia = column_of("inertia", given.inertia, n, 0.0);
    expect_sizes_in_range(radius, mass, inertia);
    std::vector<Disc> discs;
    discs.reserve(n);
    for (std::size_t i = 0; i < n; ++i) {
        const double* const p = given.position.data() + 2 * i;
        const Vec2 velocity =
            given.velocity ? Vec2{given.velocity->data()[2 * i], given.velocity->data()[2 * i + 1]}
                           : segment.velocity;
        discs.push_back(
            {{p[0], p[1]}, velocity, angle[i], spin[i], 0.0, radius[i], mass[i], inertia[i]});
    }
    return discs;
}

/// A closed way along the vertices: at each at its time, from there straight to the next; the
/// first again at the end of the period.
ContainerPath polyline(const Numbers& vertices, const std::optional<Numbers>& times,
                       double period) {
    expect_pairs("path", vertices, 0);
    const auto n = static_cast<std::size_t>(vertices.shape(0));
    if (n < 2) throw UsageError("path has one vertex, but a way needs two at least.");
    for (std::size_t k = 0; k < 2 * n; ++k)
        if (std::abs(vertices.data()[k]) > largest_value)
            throw UsageError(fmt::format("path goes to {}, but no farther than {} it may.",
                                         vertices.data()[k], largest_value));
    if (static_cast<double>(n) > max_sides)
        throw UsageError(fmt::format("path has {} vertices, but {} are the most.", n, max_sides));
    const auto vertex = [&](std::size_t k) {
        return Vec2{vertices.data()[2 * (k % n)], vertices.data()[2 * (k % n) + 1]};
    };
    std::vector<double> at(n + 1, 0.0);
    for (std::size_t k = 0; k < n; ++k) {
        const Vec2 way = vertex(k + 1) - vertex(k);
        at[k + 1] = at[k] + std::hypot(way.x, way.y);
    }
    if (!times) {
        // At one speed all the way.
        if (!(at[n] > 0.0)) throw UsageError("All vertices of the path are the same point.");
        for (double& t : at) t *= period / at[n];
    } else {
        const auto given = column_of("path_times", times, n, 0.0);
        std::copy(given.begin(), given.end(), at.begin());
    }
    at[n] = period;
    if (at[0] != 0.0)
        throw UsageError(fmt::format("path_times begins with {}, but must with 0.", at[0]));
    ContainerPath path{period, {}};
    for (std::size_t k = 0; k < n; ++k) {
        if (!(at[k + 1] - at[k] >= 1e-9 * period))
            throw UsageError(
                fmt::format("The container would be at vertex {} of its path at {} and at the next "
                            "at {}; times "
                            "must ascend up to the period {}, and no two vertices be the same.",
                            k, at[k], at[k + 1], period));
        path.segments.push_back({at[k], at[k + 1], vertex(k),
                                 (1.0 / (at[k + 1] - at[k])) * (vertex(k + 1) - vertex(k)), 0.0});
    }
    return path;
}

constexpr std::string_view archive_head = "swirl simulation 2\n";

[[noreturn]] void reject_archive(std::string_view what) {
    throw FileError(fmt::format("This is no simulation of swirl that could go on: {}.", what));
}

bool same_segments(const std::vector<Segment>& a, const std::vector<Segment>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const Segment& x, const Segment& y) {
                          return x.begin == y.begin && x.end == y.end && x.start.x == y.start.x &&
                                 x.start.y == y.start.y && x.velocity.x == y.velocity.x &&
                                 x.velocity.y == y.velocity.y && x.turning == y.turning;
                      });
}

/// The path of an archive is that of its parameters, or what polyline() makes of its vertices.
void expect_path(const std::vector<Segment>& segments, const RunConfig& config, bool own) {
    if (same_segments(segments, make_path(config).segments)) return;
    if (!own) reject_archive("its path is not that of its parameters");
    Numbers vertices(std::vector<py::ssize_t>{signed_size(segments.size()), 2}),
        times(signed_size(segments.size()));
    for (std::size_t k = 0; k < segments.size(); ++k) {
        vertices.mutable_data()[2 * k] = segments[k].start.x;
        vertices.mutable_data()[2 * k + 1] = segments[k].start.y;
        times.mutable_data()[k] = segments[k].begin;
    }
    if (!same_segments(segments, polyline(vertices, times, config.period).segments))
        reject_archive("its path has a leg that does not lead to the next");
}

/// The discs of an archive: in the ranges of those that are given, or those of the parameters.
void expect_discs(const InitialState& scene, const RunConfig& config, bool own, double clock) {
    std::vector<double> radius, mass, inertia;
    InitialState now = scene;
    for (Disc& d : now.discs) {
        radius.push_back(d.radius);
        mass.push_back(d.mass);
        inertia.push_back(d.inertia);
        d = d.at(clock);
    }
    if (own) {
        expect_sizes_in_range(radius, mass, inertia);
        // Of contacts that went on for long, more than rounding is left.
        return expect_apart(now, scene.path.segment_at(clock).position_at(clock), 1e-3);
    }
    const auto second = static_cast<std::size_t>(config.mixture ? config.mixture->count : 0);
    const auto n = static_cast<std::size_t>(config.discs);
    const double multiple = config.inertia / (config.mass * config.radius * config.radius);
    bool same = radius.size() == n;
    for (std::size_t i = 0; same && i < n; ++i) {
        const bool first = i < n - second;
        const double r = first ? config.radius : config.mixture->radius;
        const double m = first ? config.mass : config.mixture->mass;
        same = radius[i] == r && mass[i] == m &&
               inertia[i] == (first ? config.inertia : multiple * m * r * r);
    }
    if (!same) reject_archive("its discs are not those of its parameters");
}

/// A dish that goes on while nobody looks. May be called from any thread; two at once take turns.
class Container {
  public:
    Container(RunConfig config, bool own, InitialState scene, const Progress& progress,
              const std::atomic<bool>* stop = nullptr)
        : config_(std::move(config)),
          own_(own),
          scene_(std::move(scene)),
          simulation_(scene_, progress, selected_tuning(stop)) {
        scene_.discs.clear();
        scene_.discs.shrink_to_fit();
    }

    /// Waits for its turn without the interpreter: who has it may need that.
    template <class Work>
    auto in_turn(Work&& work) {
        std::unique_lock turn(turn_, std::try_to_lock);
        if (!turn) {
            const WithoutInterpreter without;
            turn.lock();
        }
        return work(simulation_);
    }

    /// As long as `unit()` says that there is more to do, Ctrl-C is heard, and others may run.
    template <class Unit>
    void for_long(Unit&& unit) {
        Raised raised;
        in_turn([&](Simulation&) {
            const WithoutInterpreter without;
            bool listens = true;
            auto heard = std::chrono::steady_clock::now();
            while (unit()) {
                const auto now = std::chrono::steady_clock::now();
                if (!listens || now - heard < std::chrono::milliseconds(50)) continue;
                heard = now;
                raised.listen([&] { listens = is_main_thread(); });
                if (raised) break;
            }
        });
        raised.raise_again();
    }

    py::array step(std::int64_t count) {
        constexpr std::int64_t maximum = std::int64_t{1} << 26;
        if (count < 0 || count > maximum)
            throw UsageError(fmt::format(
                "The number of events is {}, but it must be from 0 to {}: more do not fit into an "
                "array of reasonable size. advance(events=...) has no such limit.",
                count, maximum));
        py::array_t<EventRow> rows(count);
        EventRow* const begin = rows.mutable_data();
        std::int64_t done = 0;
        for_long([&] {
            for (const auto end = std::min(count, done + unit_of_work()); done < end; ++done)
                begin[done] = row_of(simulation_.step(), scene_.path.period);
            return done < count;
        });
        return rows;
    }
    Event next() {
        return in_turn([](Simulation& s) { return s.step(); });
    }
    void run(std::int64_t count) {
        if (count < 0)
            throw UsageError(fmt::format("events is {}, but it must be 0 or more.", count));
        for_long([&] {
            const std::int64_t part = std::min(count, unit_of_work());
            simulation_.run(static_cast<std::uint64_t>(part));
            count -= part;
            return count > 0;
        });
    }
    void advance(double time) {
        for_long([&, to = std::optional<Moment>()]() mutable {
            if (!to) to = later(time);
            return !simulation_.advance_to(to->periods, to->clock,
                                           static_cast<std::uint64_t>(unit_of_work()));
        });
    }
    void advance_to(std::int64_t periods, double clock) {
        if (!(clock >= 0.0 && clock < scene_.path.period))
            throw UsageError(
                fmt::format("clock is {}, but it must be from 0 to below the period, {}.", clock,
                            scene_.path.period));
        for_long([&, checked = false]() mutable {
            const Progress now = simulation_.progress();
            if (!checked &&
                (periods < now.periods || (periods == now.periods && clock < now.clock)))
                throw UsageError(fmt::format(
                    "It is swirl {} and {} on the clock already; time does not go back.",
                    now.periods, now.clock));
            checked = true;
            return !simulation_.advance_to(periods, clock,
                                           static_cast<std::uint64_t>(unit_of_work()));
        });
    }
    std::shared_ptr<Frames> sample(std::int64_t count, std::int64_t per_period) {
        auto frames = std::make_shared<Frames>();
        const double period = scene_.path.period;
        Moment begin{0, 0.0};
        std::int64_t k = -1;
        for_long([&] {
            if (k < 0) {
                begin = {simulation_.periods(), simulation_.clock()};
                frames->reserve(static_cast<std::size_t>(count), simulation_.size());
                k = 0;
            }
            Moment m{begin.periods + k / per_period,
                     begin.clock + period * double(k % per_period) / double(per_period)};
            carry(m);
            if (!simulation_.advance_to(m.periods, m.clock,
                                        static_cast<std::uint64_t>(unit_of_work())))
                return true;
            if (k == count) return false;
            frames->add(simulation_, scene_.path);
            ++k;
            return true;
        });
        return frames;
    }
    Look look() {
        return in_turn([](Simulation& s) { return Look(s.snapshot()); });
    }

    /// Everything, as bytes; a dish made of them goes on with the same bits.
    std::string archive() {
        StateWriter write;
        in_turn([&](Simulation& s) {
            std::string config = config_text(config_);
            write(config, own_, scene_.path.segments);
            Progress progress = s.progress();
            write(progress.periods, progress.clock, progress.segment, progress.events);
            std::vector<Disc> discs;
            for (std::size_t i = 0; i < s.size(); ++i) discs.push_back(s.disc(i));
            write(discs);
        });
        const std::uint64_t sum = checksum(write.bytes());
        std::string bytes(archive_head);
        bytes.append(reinterpret_cast<const char*>(&sum), sizeof sum);
        return bytes + write.bytes();
    }
    static std::unique_ptr<Container> of_archive(std::string_view bytes) {
        std::uint64_t sum = 0;
        if (!bytes.starts_with(archive_head) || bytes.size() < archive_head.size() + sizeof sum)
            reject_archive("it begins otherwise, or is of another version");
        std::memcpy(&sum, bytes.data() + archive_head.size(), sizeof sum);
        bytes.remove_prefix(archive_head.size() + sizeof sum);
        if (checksum(bytes) != sum) reject_archive("it is damaged");
        StateReader read(bytes);
        std::string text;
        bool own = false;
        std::vector<Segment> segments;
        Progress progress;
        std::vector<Disc> discs;
        read(text, own, segments);
        read(progress.periods, progress.clock, progress.segment, progress.events);
        read(discs);
        read.expect_end();
        try {
            const RunConfig config = resolve(parameters_in(text));
            if (own && config.shape() != Shape::disc) reject_archive("only discs can be one's own");
            expect_path(segments, config, own);
            InitialState scene = without_discs(config, {config.period, std::move(segments)});
            scene.discs = std::move(discs);
            if (const char* const what = impossible_to_continue(scene, progress))
                reject_archive(what);
            expect_discs(scene, config, own, progress.clock);
            return std::make_unique<Container>(config, own, std::move(scene), progress);
        } catch (const UsageError& wrong) {
            reject_archive(wrong.what());
        }
    }

    std::string config() const { return config_text(config_); }
    bool is_own() const { return own_; }
    double period() const { return scene_.path.period; }
    double container_radius() const { return scene_.container_radius; }
    std::vector<double> path() const {
        std::vector<double> vertices;
        for (const Segment& segment : scene_.path.segments)
            vertices.insert(vertices.end(), {segment.begin, segment.start.x, segment.start.y});
        return vertices;
    }

  private:
    struct Moment {
        std::int64_t periods;
        double clock;
    };

    /// Events of a few thousandths of a second, and no more: then Ctrl-C is asked for.
    static constexpr std::int64_t unit_of_work() { return 4096; }

    void carry(Moment& m) const {
        const double period = scene_.path.period;
        if (m.clock < period) return;
        const double whole = std::floor(m.clock / period);
        m.periods += static_cast<std::int64_t>(whole);
        m.clock = std::max(0.0, m.clock - whole * period);
        if (m.clock >= period) m = {m.periods + 1, 0.0};
    }
    Moment later(double time) const {
        const double period = scene_.path.period;
        const double periods = std::floor(time / period);
        Moment m{simulation_.periods() + static_cast<std::int64_t>(periods),
                 simulation_.clock() + (time - periods * period)};
        carry(m);
        return m;
    }

    const RunConfig config_;
    const bool own_;  // discs or path are none that the parameters could say
    InitialState scene_;
    std::recursive_mutex turn_;  // a signal handler may look at what it interrupts
    Simulation simulation_;
};

std::unique_ptr<Container> make_container(const py::dict& parameters,
                                          const std::optional<GivenDiscs>& given,
                                          const std::optional<Numbers>& path,
                                          const std::optional<Numbers>& path_times) {
    const RunConfig config = resolve(texts_of(parameters));
    const bool own = given || path;
    if (own && config.shape() != Shape::disc)
        throw UsageError(
            "Only discs without a floor can begin at places or follow a path of one's own.");
    if (path_times && !path) throw UsageError("path_times needs the path of which it is.");
    std::atomic<bool> stop = false;
    InitialState scene;
    if (given) {
        RunConfig one = config;
        one.discs = 1;
        one.mixture.reset();
        scene = make_initial_state(one);
    } else {
        scene = listening(stop, [&] { return make_initial_state(config, &stop); });
    }
    if (path) {
        const Segment before = scene.path.segments.front();
        scene.path = polyline(*path, path_times, config.period);
        const Segment& segment = scene.path.segments.front();
        for (Disc& d : scene.discs) {
            d.position = d.position + (segment.start - before.start);
            d.velocity = d.velocity + (segment.velocity - before.velocity);
        }
    }
    if (given) scene.discs = discs_of(*given, config, scene.path.segments.front());
    // What an overlap may be for rounding: what a snapshot shows is a contact now and then.
    if (own) expect_apart(scene, scene.path.segments.front().start, 1e-9);
    return listening(stop, [&] {
        return std::make_unique<Container>(config, own, std::move(scene), Progress{}, &stop);
    });
}

}  // namespace

void bind_simulations(py::module_& module) {
    bind_looks(module);
    PYBIND11_NUMPY_DTYPE(EventRow, periods, clock, time, kind, i, j, normal_x, normal_y,
                         normal_impulse, tangential_impulse, overlap);
    module.attr("event_dtype") = py::dtype::of<EventRow>();

    py::class_<Event> event(module, "Event",
                            "What happened: kind (swirl.EventKind), when (swirls and clock), and\n"
                            "to which discs, i and j.");
    reject_to_be_begun(event);
    event.def_readonly("swirls", &Event::periods)
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

    py::class_<Container>(module, "Dish")
        .def(py::init([](const py::dict& parameters, const py::dict& discs,
                         const std::optional<Numbers>& path,
                         const std::optional<Numbers>& path_times) {
                 std::optional<GivenDiscs> given;
                 if (discs.contains("position")) {
                     const auto array = [&](const char* name) -> std::optional<Numbers> {
                         if (!discs.contains(name)) return {};
                         return py::cast<Numbers>(discs[name]);
                     };
                     given = GivenDiscs{*array("position"), array("velocity"), array("angle"),
                                        array("spin"),      array("radius"),   array("mass"),
                                        array("inertia")};
                 }
                 return make_container(parameters, given, path, path_times);
             }),
             py::arg("parameters"), py::arg("discs"), py::arg("path"), py::arg("path_times"))
        .def("step", &Container::step)
        .def("next", &Container::next)
        .def("run", &Container::run)
        .def("advance", &Container::advance)
        .def("advance_to", &Container::advance_to)
        .def("sample", &Container::sample)
        .def("snapshot", &Container::look)
        .def("archive", [](Container& d) { return py::bytes(d.archive()); })
        .def_static(
            "of_archive",
            [](const py::bytes& bytes) { return Container::of_archive(std::string_view(bytes)); })
        .def("config", &Container::config)
        .def_property_readonly("is_own", &Container::is_own)
        .def_property_readonly("period", &Container::period)
        .def_property_readonly("container_radius", &Container::container_radius)
        .def("path", &Container::path)
        .def("__len__",
             [](Container& d) { return d.in_turn([](Simulation& s) { return s.size(); }); })
        .def("counts",
             [](Container& d) {
                 const EventCounts c = d.in_turn([](Simulation& s) { return s.events(); });
                 return py::make_tuple(c.disc_disc, c.disc_wall, c.path_vertex, c.elastic_by_tc,
                                       c.begins_to_roll);
             })
        .def("now",
             [](Container& d) {
                 return d.in_turn(
                     [](Simulation& s) { return py::make_tuple(s.periods(), s.clock()); });
             })
        .def("state_hash", [](Container& d) {
            return d.in_turn([](Simulation& s) { return fmt::format("{:016x}", s.state_hash()); });
        });
}

}  // namespace swirl::python
