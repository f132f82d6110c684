// swirl.Trajectory, swirl.Tracks, swirl.analyse(): what was recorded, frame by frame.
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
#include "swirl/files/series.hpp"
#include "swirl/files/track_mending.hpp"
#include "swirl/files/tracks.hpp"
#include "swirl/files/trajectory.hpp"
#include "swirl/measure/cluster_rotation.hpp"
#include "swirl/measure/observation.hpp"
#include "swirl/run/failure.hpp"

namespace swirl::python {
namespace {

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;
using WholeNumbers = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;

/// Frames that are read, or worked out, when they are asked for. From any thread, in turns.
class Recording {
  public:
    explicit Recording(SnapshotSeries series) : series_(std::move(series)) {}
    static std::unique_ptr<Recording> open(const std::string& file) {
        auto reader = std::make_shared<TrajectoryReader>(file);
        auto recording = std::make_unique<Recording>(series_of(reader));
        recording->reader_ = std::move(reader);
        return recording;
    }

    std::uint64_t size() const { return series_.frames; }
    bool same_discs() const { return series_.same_discs(); }
    const std::vector<std::uint64_t>& breaks() const { return series_.breaks; }
    Snapshot frame(std::uint64_t k) {
        const std::lock_guard turn(turn_);
        return series_.frame(k);
    }
    std::shared_ptr<Frames> frames(std::uint64_t begin, std::uint64_t end, std::uint64_t step) {
        auto frames = std::make_shared<Frames>();
        for (std::uint64_t k = begin; k < end; k += step) {
            const Snapshot s = frame(k);
            if (!frames->fits(s))
                throw WrongCall(fmt::format(
                    "Frame {} has {} discs and the one before it {}; frames of different "
                    "discs can be asked for one by one.",
                    k, s.size(), frames->discs));
            frames->add(s);
        }
        return frames;
    }
    py::dict about() {
        py::dict about;
        if (!reader_) return about;
        const std::lock_guard turn(turn_);
        for (const std::string& name : reader_->provenance_names())
            about[py::str(name)] = reader_->provenance(name);
        return about;
    }
    bool complete() const { return !reader_ || reader_->complete(); }

  private:
    SnapshotSeries series_;
    std::shared_ptr<TrajectoryReader> reader_;
    std::mutex turn_;
};

/// Rows of a table in order of frames, as trackpy has them.
std::unique_ptr<Recording> tracks(const WholeNumbers& frame, const WholeNumbers& particle,
                                  const Numbers& x, const Numbers& y, const py::dict& scale) {
    const py::ssize_t n = frame.size();
    if (n == 0) throw WrongCall("There are no positions in the tracks.");
    if (particle.size() != n || x.size() != n || y.size() != n)
        throw WrongCall("The columns of the tracks have different lengths.");
    Tracks tracks;
    tracks.y_down = true;
    for (py::ssize_t k = 0; k < n; ++k) {
        if (!std::isfinite(x.data()[k]) || !std::isfinite(y.data()[k]))
            throw WrongCall(fmt::format("Row {} of the tracks has no finite position.", k));
        const std::int64_t number = frame.data()[k], id = particle.data()[k];
        if (tracks.frames.empty() || tracks.frames.back().number != number) {
            tracks.frames.emplace_back();
            tracks.frames.back().number = number;
        }
        TrackFrame& at = tracks.frames.back();
        if (!at.id.empty() && at.id.back() >= id)
            throw WrongCall(fmt::format("Particle {} is in frame {} twice.", id, number));
        at.id.push_back(id);
        at.position.push_back({x.data()[k], y.data()[k]});
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
        throw WrongCall(
            "The tracks are of a single frame, which tells no velocities; two are the "
            "least.");
    mend(tracks, s.pixels_per_radius);
    return std::make_unique<Recording>(series_of(std::move(tracks), s));
}

/// Frames that are there already.
std::unique_ptr<Recording> recording_of(const std::shared_ptr<const Frames>& frames) {
    SnapshotSeries series;
    series.frames = frames->size();
    series.frame = [frames](std::uint64_t k) { return frames->frame(k); };
    return std::make_unique<Recording>(std::move(series));
}

/// Whether the same discs are seen long enough for their tracks to say anything.
bool holds_tracks(const Recording& recording) {
    std::uint64_t begin = 0, longest = 0;
    for (const std::uint64_t end : recording.breaks()) {
        longest = std::max(longest, end - begin);
        begin = end;
    }
    longest = std::max(longest, recording.size() - begin);
    return recording.same_discs() || longest > std::uint64_t(PinnedLoose::width);
}

struct Analysed {
    std::vector<MeasurementReport> reports;
    RotationEstimates rotation;
    std::uint64_t used = 0;
};

/// As `swirl measure` does it: a block is what is seen of one swirl.
Analysed analysed(Recording& recording, std::vector<std::string> names, double skip,
                  const std::atomic<bool>& stop) {
    const bool tracked = holds_tracks(recording);
    const Snapshot first = recording.frame(0);
    Observation observation(first.container_radius, first.period, std::move(names), tracked);
    ClusterRotation rotation;
    Analysed found;
    std::int64_t swirl = first.swirls;
    auto next_break = recording.breaks().begin();
    for (std::uint64_t k = 0; k < recording.size() && !stop; ++k) {
        const Snapshot s = recording.frame(k);
        const bool others = next_break != recording.breaks().end() && *next_break == k;
        if (others) ++next_break;
        if (s.time() < skip * s.period) continue;
        if (found.used > 0 && s.swirls != swirl) {
            rotation.close_block();
            observation.close_block();
        }
        if (others) observation.begin_tracks();
        swirl = s.swirls;
        rotation.sample_by_time(s);
        observation.sample(s);
        ++found.used;
    }
    rotation.close_block();
    observation.close_block();
    found.reports = observation.report();
    found.rotation = rotation.estimates();
    return found;
}

/// Without those that frames cannot tell: refused where they were asked for by name.
std::vector<std::string> told_by_frames(const Recording& recording,
                                        const std::vector<std::string>& names, bool all) {
    std::vector<std::string> told;
    for (const std::string& name : names) {
        const MeasurementKind& kind = *find_measurement(name);
        const bool untold = kind.needs_events || (kind.needs_tracks && !holds_tracks(recording));
        if (!untold) told.push_back(name);
        if (!untold || all) continue;
        if (kind.needs_events)
            throw WrongCall(fmt::format(
                "measure has '{}' in its list, which needs every collision, and frames do not hold "
                "them; swirl.run(measure=\"{}\") can tell.",
                name, name));
        throw WrongCall(fmt::format(
            "The discs are never the same for {} frames in a row, so '{}' cannot be told of them; "
            "density, flow, profile, radial, temperature, order and packing can.",
            PinnedLoose::width + 1, name));
    }
    return told;
}

py::tuple estimate_tuple(const Estimate& e) {
    return py::make_tuple(e.mean, e.error, e.effective_samples, e.blocks);
}

py::tuple analyse(Recording& recording, const std::vector<std::string>& names, bool all,
                  double skip) {
    if (!(skip >= 0.0))
        throw WrongCall(fmt::format("skip is {}, but it must be 0 or more swirls.", skip));
    if (recording.size() == 0) throw WrongCall("The recording holds no frames.");
    const auto told = told_by_frames(recording, names, all);
    std::atomic<bool> stop = false;
    const Analysed found = listening(stop, [&] { return analysed(recording, told, skip, stop); });
    if (found.used == 0) throw WrongCall(fmt::format("skip {} leaves no frame.", skip));
    return py::make_tuple(reports_in_python(found.reports), estimate_tuple(found.rotation.by_time),
                          estimate_tuple(found.rotation.rigid_by_time), found.used);
}

}  // namespace

void bind_recordings(py::module_& module) {
    py::class_<Recording>(module, "Recording")
        .def_static("open", &Recording::open)
        .def_static("tracks", &tracks)
        .def_static("of_frames",
                    [](const std::shared_ptr<Frames>& frames) { return recording_of(frames); })
        .def("__len__", &Recording::size)
        .def("frames",
             [](Recording& r, std::uint64_t begin, std::uint64_t end, std::uint64_t step) {
                 return r.frames(begin, std::min(end, r.size()), std::max<std::uint64_t>(step, 1));
             })
        .def_property_readonly("same_discs", &Recording::same_discs)
        .def_property_readonly("complete", &Recording::complete)
        .def("about", &Recording::about)
        .def("analyse", &analyse);
}

}  // namespace swirl::python
