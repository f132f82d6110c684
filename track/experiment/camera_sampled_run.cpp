#include "track/experiment/camera_sampled_run.hpp"

#include <cmath>
#include <utility>

#include "swirl/io/tracks.hpp"
#include "swirl/math/random.hpp"
#include "swirl/math/unit_circle.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/json.hpp"
#include "swirl/run/measured_series.hpp"
#include "swirl/run/track_fit.hpp"

namespace swirl {
namespace {

/// Two independent standard normal numbers (Box–Muller).
Vec2 normal_pair(Random& random) {
    const double size = std::sqrt(-2.0 * std::log(1.0 - random.uniform()));
    return size * unit_circle(random.uniform());
}

TrackFrame camera_frame(const Snapshot& s, std::int64_t number, double error, Random& random) {
    TrackFrame frame;
    frame.number = number;
    for (std::size_t i = 0; i < s.size(); ++i) {
        frame.id.push_back(static_cast<std::int64_t>(i));
        frame.position.push_back(s.position(i) + error * normal_pair(random));
        frame.radius.push_back(s.radius[i]);
        frame.spin.push_back(s.spin[i]);
    }
    return frame;
}

}  // namespace

nlohmann::ordered_json camera_sampled_run(const RunConfig& config, const CameraSampling& sampling,
                                          const std::vector<std::string>& measurements,
                                          const RunControl& control) {
    Run run(config, control);
    SampleTimes times = run.sample_times(sampling.frames_per_period);
    Random random(config.seed);
    Tracks tracks;
    TrackScale scale;
    std::int64_t number = 0;
    while (run.next_event()) {
        while (run.next_sample(times)) {
            ++number;
            if (!run.is_warm()) continue;
            const Snapshot& s = run.snapshot();
            if (tracks.frames.empty())
                scale.phase = std::atan2(s.container_centre.y, s.container_centre.x);
            tracks.frames.push_back(camera_frame(s, number, sampling.position_error, random));
        }
        run.pass_event();
    }
    if (!run.complete()) throw Interrupted("stopped.");
    if (tracks.frames.size() < static_cast<std::size_t>(sampling.frames_per_period))
        throw Failure(
            "the run has less than one period after the warm-up.\nhint: increase --events.");
    const std::int64_t first = tracks.frames.front().number;
    for (TrackFrame& frame : tracks.frames) frame.number -= first;
    scale.period = config.period;
    scale.frames_per_time = sampling.frames_per_period / config.period;
    scale.pixels_per_radius = config.radius;  // a pixel is the unit of length of the run
    scale.amplitude = config.amplitude / config.radius;
    scale.container_radius = config.container_radius / config.radius;
    scale.clockwise = config.turns_clockwise();
    TrackSmoothing smoothing;
    const SnapshotSeries series = smoothed_series(std::move(tracks), scale, smoothing);
    MeasuringControl measuring;
    measuring.stop = control.stop;
    const MeasuredSeries found =
        measure_series(series, measurable(measurements, true), 0.0, measuring);

    nlohmann::ordered_json json = result_json(run.result());
    json["rotation"]["mean_by_time"] = estimate_json(found.rotation.mean_by_time);
    json["rotation"]["rigid_by_time"] = estimate_json(found.rotation.rigid_by_time);
    json["measured"] = measured_json(found.reports);
    return json;
}

}  // namespace swirl
