// swirl.Trajectory, swirl.Tracks and swirl.analyse(): recorded frames and their analysis.
#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include <fmt/format.h>

#include <algorithm>
#include <mutex>
#include <optional>

#include "arrays.hpp"
#include "calls.hpp"
#include "frames.hpp"
#include "reports.hpp"
#include "swirl/io/equal_steps.hpp"
#include "swirl/io/series.hpp"
#include "swirl/io/track_repair.hpp"
#include "swirl/io/tracks.hpp"
#include "swirl/io/trajectory.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/measured_series.hpp"
#include "swirl/run/track_fit.hpp"

namespace swirl::python {
namespace {

/// Frames that are read or computed on demand. Any thread may call it; simultaneous calls wait.
class Recording {
  public:
    explicit Recording(SnapshotSeries series) : series_(std::move(series)) {
        series_.frame = [mutex = mutex_, read = std::move(series_.frame)](std::uint64_t k) {
            const std::lock_guard lock(*mutex);
            return read(k);
        };
        states_ = std::make_shared<PinnedSeries>(series_);
    }
    static std::unique_ptr<Recording> open(const std::string& file) {
        auto reader = std::make_shared<TrajectoryReader>(file);
        auto recording = std::make_unique<Recording>(series_of_run(reader));
        recording->reader_ = std::move(reader);
        return recording;
    }

    const SnapshotSeries& series() const { return series_; }
    std::uint64_t size() const { return series_.frames; }
    bool same_discs() const { return series_.same_discs(); }
    std::shared_ptr<Frames> frames(std::uint64_t begin, std::uint64_t end, std::uint64_t step) {
        auto frames = std::make_shared<Frames>();
        for (std::uint64_t k = begin; k < end; k += step) {
            const Snapshot s = series_.frame(k);
            if (!frames->fits(s))
                throw UsageError(
                    fmt::format("frame {} has {} discs, but the previous one has {}.\n"
                                "hint: read frames with different discs one by one.",
                                k, s.size(), frames->discs));
            frames->add(s);
            frames->numbers.push_back(k);
        }
        frames->recording = states_;
        return frames;
    }
    py::dict about() {
        py::dict about;
        if (!reader_) return about;
        const std::lock_guard lock(*mutex_);
        for (const std::string& name : reader_->provenance_names())
            about[py::str(name)] = reader_->provenance(name);
        return about;
    }
    bool complete() const { return !reader_ || reader_->complete(); }
    std::string remarks;  // sentences about tracks, one per line

  private:
    SnapshotSeries series_;
    std::shared_ptr<TrajectoryReader> reader_;
    std::shared_ptr<PinnedSeries> states_;
    std::shared_ptr<std::mutex> mutex_ = std::make_shared<std::mutex>();
};

/// The columns of a trackpy table in a file. The radius is there only if `swirl track` wrote it.
py::dict read_tracks(const std::string& file) {
    std::vector<std::int64_t> frame, particle;
    std::vector<double> x, y, radius, time;
    for (const TrackFrame& at : read_track_table(file).frames)
        for (std::size_t i = 0; i < at.id.size(); ++i) {
            frame.push_back(at.number);
            particle.push_back(at.id[i]);
            x.push_back(at.position[i].x);
            y.push_back(at.position[i].y);
            if (!at.radius.empty()) radius.push_back(at.radius[i]);
            if (at.time) time.push_back(*at.time);
        }
    py::dict columns;
    const auto add = [&](const char* name, auto&& column) {
        const py::ssize_t rows = signed_size(column.size());
        if (rows > 0) columns[name] = owned_array(std::forward<decltype(column)>(column), {rows});
    };
    add("frame", std::move(frame));
    add("particle", std::move(particle));
    add("x", std::move(x));
    add("y", std::move(y));
    add("radius", std::move(radius));
    add("time", std::move(time));
    return columns;
}

/// Rows of a trackpy table in order of frames. `radius` and `time` may be empty.
std::unique_ptr<Recording> tracks(const WholeNumbers& frame, const WholeNumbers& particle,
                                  const Numbers& x, const Numbers& y, const Numbers& radius,
                                  const Numbers& time, const py::dict& scale, double max_invalid) {
    const py::ssize_t n = frame.size();
    if (n == 0) throw UsageError("the tracks are empty.");
    if (particle.size() != n || x.size() != n || y.size() != n ||
        (radius.size() != n && radius.size() != 0) || (time.size() != n && time.size() != 0))
        throw UsageError("the columns of the tracks have different lengths.");
    Tracks tracks;
    tracks.y_down = true;
    for (py::ssize_t k = 0; k < n; ++k) {
        if (!std::isfinite(x.data()[k]) || !std::isfinite(y.data()[k]))
            throw UsageError(fmt::format("row {} of the tracks has no finite position.", k));
        const std::int64_t number = frame.data()[k], id = particle.data()[k];
        if (tracks.frames.empty() || tracks.frames.back().number != number) {
            tracks.frames.emplace_back();
            tracks.frames.back().number = number;
            if (time.size() == n) tracks.frames.back().time = time.data()[k];
        }
        TrackFrame& at = tracks.frames.back();
        if (!at.id.empty() && at.id.back() >= id)
            throw UsageError(fmt::format("particle {} appears twice in frame {}.", id, number));
        at.id.push_back(id);
        at.position.push_back({x.data()[k], y.data()[k]});
        if (radius.size() == n) at.radius.push_back(radius.data()[k]);
    }
    const auto number = [&](const char* name) { return py::cast<double>(scale[name]); };
    TrackScale s;
    s.frames_per_time = number("camera_fps");
    s.pixels_per_radius = number("scale");
    s.period = 2.0 * pi / number("omega");
    s.amplitude = number("amplitude");
    s.phase = number("phase") * pi / 180.0;
    s.container_radius = number("container_radius");
    s.clockwise = py::cast<bool>(scale["clockwise"]);
    s.swirl_centre = {number("centre_x"), number("centre_y")};
    if (tracks.frames.size() == 1)
        throw UsageError("the tracks have a single frame, but velocities need at least two.");
    tracks = at_equal_steps(std::move(tracks), s);
    repair(tracks, s.pixels_per_radius);
    FittedSeries fitted = fitted_series(tracks, s, max_invalid);
    auto recording = std::make_unique<Recording>(std::move(fitted.series));
    recording->remarks = std::move(fitted.remarks);
    return recording;
}

/// A recording of frames in memory.
std::unique_ptr<Recording> recording_of(const std::shared_ptr<const Frames>& frames) {
    SnapshotSeries series;
    series.frames = frames->size();
    series.frame = [frames](std::uint64_t k) { return frames->frame(k); };
    if (series.frames > 0) {
        const Snapshot first = series.frame(0);
        series.units = units_in(first);
        series.clockwise = moves_clockwise(first);
    }
    return std::make_unique<Recording>(std::move(series));
}

/// Throws UsageError for measurements that these frames do not allow.
void reject_unmeasurable(const std::vector<std::string>& names, bool tracked) {
    for (const std::string& name : names) {
        const MeasurementKind& kind = *find_measurement(name);
        if (kind.needs_events)
            throw UsageError(fmt::format(
                "measure contains '{}', which needs every collision, but frames do not hold them.\n"
                "hint: use swirl.run(measure=\"{}\").",
                name, name));
        if (kind.needs_tracks && !tracked)
            throw UsageError(fmt::format(
                "measure contains '{1}', which needs the same discs in {0} consecutive frames, but "
                "the recording does not have them.\nhint: density, flow, profile, radial, "
                "temperature, order and packing do not need this.",
                FrameWindow().width() + 1, name));
    }
}

py::tuple estimate_tuple(const Estimate& e) {
    return py::make_tuple(e.mean, e.error, e.effective_samples, e.blocks);
}

py::tuple analyse(Recording& recording, const std::vector<std::string>& names, bool all,
                  double warmup) {
    if (!(warmup >= 0.0))
        throw UsageError(fmt::format("warmup is {}, but it must be 0 periods or more.", warmup));
    if (recording.size() == 0) throw UsageError("the recording has no frames.");
    const SnapshotSeries& series = recording.series();
    const bool tracked = holds_tracks(series);
    const bool m_frame = series.has_m_frame;
    if (!all) reject_unmeasurable(names, tracked);
    if (!all && !m_frame) require_m_frame_for(names);
    const auto measured = measurable(names, tracked, m_frame);
    const Snapshot last = series.frame(series.frames - 1);
    if (last.time() < warmup * last.period)
        throw UsageError(fmt::format("warmup is {}, but the recording ends earlier.", warmup));
    std::atomic<bool> stop = false;
    MeasuringControl control;
    control.stop = &stop;
    const MeasuredSeries found =
        interruptible(stop, [&] { return measure_series(series, measured, warmup, control); });
    return py::make_tuple(reports_in_python(found.reports),
                          estimate_tuple(found.rotation.mean_by_time),
                          estimate_tuple(found.rotation.rigid_by_time), found.frames, found.remark);
}

}  // namespace

void bind_recordings(py::module_& module) {
    py::class_<Recording>(module, "Recording")
        .def_static("open", &Recording::open, "open(file: str) -> Recording")
        .def_static(
            "tracks", &tracks,
            R"(tracks(frame: npt.NDArray[Any], particle: npt.NDArray[Any], x: npt.NDArray[Any],
    y: npt.NDArray[Any], radius: npt.NDArray[Any], time: npt.NDArray[Any],
    scale: dict[str, Any], max_invalid: float) -> Recording)")
        .def_static("read_tracks", &read_tracks,
                    "read_tracks(file: str) -> dict[str, npt.NDArray[Any]]")
        .def_static(
            "of_frames", [](const std::shared_ptr<Frames>& frames) { return recording_of(frames); },
            "of_frames(frames: Frames) -> Recording")
        .def("__len__", &Recording::size, "__len__(self) -> int")
        .def(
            "frames",
            [](Recording& r, std::uint64_t begin, std::uint64_t end, std::uint64_t step) {
                return r.frames(begin, std::min(end, r.size()), std::max<std::uint64_t>(step, 1));
            },
            "frames(self, begin: int, end: int, step: int) -> Frames")
        .def_property_readonly("same_discs", &Recording::same_discs, "-> bool")
        .def_property_readonly("complete", &Recording::complete, "-> bool")
        .def_readonly("remarks", &Recording::remarks, "-> str")
        .def("about", &Recording::about, "about(self) -> dict[str, str]")
        .def("analyse", &analyse,
             R"(analyse(self, measured: list[str], all: bool, warmup: float) -> tuple[list[Report],
    _Estimate, _Estimate, int, str])");
}

}  // namespace swirl::python
