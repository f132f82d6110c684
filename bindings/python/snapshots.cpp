// swirl.Snapshot and swirl.Frames: the arrays of one instant, and of many.
#include <pybind11/stl.h>

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "arrays.hpp"
#include "calls.hpp"
#include "frames.hpp"
#include "swirl/io/file_error.hpp"
#include "swirl/io/range_checks.hpp"
#include "swirl/io/series.hpp"
#include "swirl/io/state_archive.hpp"
#include "swirl/measure/cluster_rotation.hpp"
#include "swirl/measure/m_frame.hpp"
#include "swirl/run/simd.hpp"

namespace swirl::python {
namespace {

const Frames& frames_of(const SingleFrame& snapshot) { return snapshot.frames; }
const Frames& frames_of(const Frames& frames) { return frames; }

using Shape = std::vector<py::ssize_t>;
Shape per_disc(const Frames& f) { return {signed_size(f.discs)}; }

/// One value, or x and y, per frame. A snapshot has no frame axis.
template <class Owner, bool with_disc, bool with_xy>
Shape per_frame(const Frames& f) {
    Shape shape;
    if constexpr (std::is_same_v<Owner, Frames>) shape.push_back(signed_size(f.size()));
    if constexpr (with_disc) shape.push_back(signed_size(f.discs));
    if constexpr (with_xy) shape.push_back(2);
    return shape;
}

/// A property: the read-only view of a column.
template <class Owner, class Column>
auto column(Column Frames::*member, Shape (*shape)(const Frames&)) {
    return [member, shape](const py::object& self) {
        const Frames& frames = frames_of(py::cast<const Owner&>(self));
        return view_of(frames.*member, shape(frames), self);
    };
}

/// Properties that snapshots and frames share.
template <class Owner, class Class>
void bind_columns(Class& type) {
    constexpr auto disc = &per_frame<Owner, true, false>;
    constexpr auto disc_xy = &per_frame<Owner, true, true>;
    constexpr auto xy = &per_frame<Owner, false, true>;
    const char* const frame = std::is_same_v<Owner, Frames> ? "frame, " : "";
    const auto floats = [](const std::string& text) { return "-> _Floats\n\n" + text; };
    const auto per_frame_too = [&](const char* text) {
        return floats(fmt::format("[{}{}", frame, text));
    };
    type.def_property_readonly("position", column<Owner>(&Frames::position, disc_xy),
                               per_frame_too("disc, xy]").c_str())
        .def_property_readonly("velocity", column<Owner>(&Frames::velocity, disc_xy),
                               per_frame_too("disc, xy]").c_str())
        .def_property_readonly("angle", column<Owner>(&Frames::angle, disc),
                               per_frame_too("disc], in radians, not reduced to one turn").c_str())
        .def_property_readonly(
            "spin", column<Owner>(&Frames::spin, disc),
            per_frame_too("disc], counter-clockwise, in radians per unit of time").c_str())
        .def_property_readonly("radius", column<Owner>(&Frames::radius, per_disc),
                               floats("[disc]").c_str())
        .def_property_readonly("mass", column<Owner>(&Frames::mass, per_disc),
                               floats("[disc]").c_str())
        .def_property_readonly("inertia", column<Owner>(&Frames::inertia, per_disc),
                               floats("[disc]").c_str())
        .def_property_readonly("can_spin", column<Owner>(&Frames::can_spin, per_disc),
                               floats("[disc], 1, or 0 for a particle that cannot spin").c_str())
        .def_property_readonly("container_centre", column<Owner>(&Frames::container_centre, xy),
                               per_frame_too("xy]").c_str())
        .def_property_readonly("container_velocity", column<Owner>(&Frames::container_velocity, xy),
                               per_frame_too("xy]").c_str())
        .def_property_readonly(
            "container_radius", [](const Owner& o) { return frames_of(o).container_radius; },
            "-> float")
        .def_property_readonly(
            "period", [](const Owner& o) { return frames_of(o).period; }, "-> float")
        .def_property_readonly(
            "pinned",
            [](const Owner& o) { return owned_array(o.pinned().pinned, disc(frames_of(o))); },
            per_frame_too(R"(disc], 1 if the disc is pinned, 0 if not

NaN if that is unknown: it takes the frames before and after, at least 400 per period.)")
                .c_str())
        .def_property_readonly(
            "resident",
            [](const Owner& o) { return owned_array(o.pinned().resident, disc(frames_of(o))); },
            per_frame_too(R"(disc], 1 if the disc is resident at the wall, 0 if not

NaN if that is unknown: it takes the frames before and after, at least 120 per period.)")
                .c_str());
}

/// Order of the columns in a pickled object, for io/state_archive.hpp.
void visit_columns(Frames& f, auto&& visit) {
    visit(f.discs, f.period, f.container_radius, f.on_floor, f.are_spheres, f.lie_flat, f.radius,
          f.mass, f.inertia, f.can_spin, f.periods, f.clock, f.time, f.container_centre,
          f.container_velocity, f.position, f.velocity, f.acceleration, f.rolling_spin, f.angle,
          f.spin);
}

py::bytes to_bytes(const Frames& frames) {
    StateWriter write;
    Frames copy = frames;
    visit_columns(copy, write);
    return py::bytes(write.bytes());
}

/// Throws FileError unless the bytes hold possible frames.
Frames from_bytes(const py::bytes& bytes) {
    Frames f;
    StateReader read{std::string_view(bytes)};
    visit_columns(f, read);
    read.expect_end();
    const std::size_t n = f.size(), all = n * f.discs, floor = f.are_spheres ? 2 * all : 0;
    const auto have = [](std::size_t length,
                         std::initializer_list<const std::vector<double>*> columns) {
        return std::all_of(columns.begin(), columns.end(),
                           [&](const auto* column) { return column->size() == length; });
    };
    if (f.periods.size() != n || !have(n, {&f.clock, &f.time}) ||
        !have(2 * n, {&f.container_centre, &f.container_velocity}) ||
        !have(f.discs, {&f.radius, &f.mass, &f.inertia, &f.can_spin}) ||
        !have(2 * all, {&f.position, &f.velocity}) ||
        !have(floor, {&f.acceleration, &f.rolling_spin}) || !have(all, {&f.angle, &f.spin}))
        throw FileError("these bytes do not hold swirl frames.");
    for (std::size_t k = 0; k < n; ++k) require_possible(f.frame(k), Spins::maybe_unknown);
    return f;
}

py::tuple rotation_of(const SingleFrame& frame) {
    const Snapshot s = frame.snapshot();
    const RotationSample sample = cluster_rotation(s, selected_width());
    const double omega = (moves_clockwise(s) ? -2.0 : 2.0) * pi / s.period;
    return py::make_tuple(sample.individual / omega, sample.rigid / omega);
}

void bind_snapshot(py::module_& module) {
    py::class_<SingleFrame> type(
        module, "Snapshot",
        R"(All discs and the container at one instant in the lab frame. The swirl centre is the
origin.

Lengths are in disc radii, and the container's speed is 1. A value that is not available is NaN,
such as the spin of a disc in a camera's tracks. Arrays are read-only views that keep their data
alive and never change.)");
    forbid_construction(type);
    bind_columns<SingleFrame>(type);
    type.def_property_readonly(
            "rolling_spin",
            [](const py::object& self) -> py::object {
                if (!py::cast<const SingleFrame&>(self).frames.are_spheres) return py::none();
                return column<SingleFrame>(&Frames::rolling_spin,
                                           &per_frame<SingleFrame, true, true>)(self);
            },
            R"(-> Optional[_Floats]

[disc, xy], horizontal angular velocity of spheres; None for discs)")
        .def_property_readonly(
            "whole_periods", [](const SingleFrame& s) { return s.frames.periods[0]; }, R"(-> int

Whole periods since the start.)")
        .def_property_readonly(
            "clock", [](const SingleFrame& s) { return s.frames.clock[0]; }, R"(-> float

The time since the last whole period.)")
        .def_property_readonly(
            "time", [](const SingleFrame& s) { return s.frames.time[0]; }, R"(-> float

The time since the start: whole_periods * period + clock.)")
        .def(
            "m_frame",
            [](const SingleFrame& frame) {
                const Snapshot s = frame.snapshot();
                SingleFrame transformed(seen_from(m_frame(s), s));
                transformed.taken_from = frame.taken_from;
                transformed.number = frame.number;
                return transformed;
            },
            R"(m_frame(self) -> Snapshot

The snapshot in the M-frame, which rotates with the swirl (src/swirl/measure/m_frame.hpp): the
container rests at the origin, and the wall's point farthest from the swirl centre is at the
bottom.)")
        .def("rotation", &rotation_of, R"(rotation(self) -> tuple[float, float]

The cluster's rotation rate in units of Ω: the paper's mean over discs, and that of the
best-fitting rigid body (src/swirl/measure/cluster_rotation.hpp).)")
        .def(
            "to_bytes", [](const SingleFrame& s) { return to_bytes(s.frames); },
            "to_bytes(self) -> bytes")
        .def(
            "__len__", [](const SingleFrame& s) { return s.frames.discs; }, "__len__(self) -> int");
    module.def(
        "snapshot_from_bytes",
        [](const py::bytes& bytes) {
            const Frames frames = from_bytes(bytes);
            if (frames.size() != 1) throw FileError("these bytes do not hold a swirl snapshot.");
            return SingleFrame(frames.frame(0));
        },
        "snapshot_from_bytes(data: bytes) -> Snapshot");
}

void bind_frames(py::module_& module) {
    py::class_<Frames, std::shared_ptr<Frames>> type(
        module, "Frames",
        R"(Snapshots of the same discs in order of time, as columns: frames.position[frame, disc].

frames[k] is a Snapshot. Arrays are read-only views that keep their data alive and never change.)");
    forbid_construction(type);
    bind_columns<Frames>(type);
    constexpr auto per_time = &per_frame<Frames, false, false>;
    type.def_property_readonly("whole_periods", column<Frames>(&Frames::periods, per_time),
                               R"(-> npt.NDArray[np.int64]

[frame])")
        .def_property_readonly("clock", column<Frames>(&Frames::clock, per_time), R"(-> _Floats

[frame])")
        .def_property_readonly("time", column<Frames>(&Frames::time, per_time), R"(-> _Floats

[frame])")
        .def_property_readonly(
            "discs", [](const Frames& f) { return f.discs; }, "-> int")
        .def(
            "m_frame",
            [](const std::shared_ptr<const Frames>& frames) {
                const Frames& f = *frames;
                auto transformed = std::make_shared<Frames>();
                transformed->reserve(f.size(), f.discs);
                for (std::size_t k = 0; k < f.size(); ++k) {
                    const Snapshot s = f.frame(k);
                    transformed->add(seen_from(m_frame(s), s));
                }
                transformed->in_lab = frames;
                return transformed;
            },
            R"(m_frame(self) -> Frames

All frames in the M-frame, as Snapshot.m_frame().)")
        .def("to_bytes", &to_bytes, "to_bytes(self) -> bytes")
        .def("__len__", &Frames::size, "__len__(self) -> int")
        .def(
            "__getitem__",
            [](const std::shared_ptr<const Frames>& frames, py::ssize_t k) {
                const Frames& f = *frames;
                const py::ssize_t count = signed_size(f.size()), at = k < 0 ? k + count : k;
                if (at < 0 || at >= count)
                    throw py::index_error(
                        fmt::format("index {} is out of range: there are {} frames.", k, f.size()));
                SingleFrame frame(f.frame(static_cast<std::size_t>(at)));
                frame.taken_from = frames;
                frame.number = static_cast<std::size_t>(at);
                return frame;
            },
            "__getitem__(self, k: int) -> Snapshot");
    module.def(
        "frames_from_bytes",
        [](const py::bytes& bytes) { return std::make_shared<Frames>(from_bytes(bytes)); },
        "frames_from_bytes(data: bytes) -> Frames");
}

}  // namespace

void forbid_construction(py::object type) {
    type.attr("__new__") =
        py::module_::import("builtins")
            .attr("staticmethod")(py::cpp_function([](const py::args&, const py::kwargs&) {
                throw py::type_error("only simulations and recordings create these objects.");
            }));
}

void bind_snapshots(py::module_& module) {
    bind_snapshot(module);
    bind_frames(module);
}

}  // namespace swirl::python
