#include "swirl/cli/tracks_input.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "swirl/io/equal_steps.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/track_fit.hpp"

namespace swirl {
namespace {

using Json = nlohmann::ordered_json;

/// Null if the tracks were not smoothed.
Json smoothing_json(const TrackSmoothing& s) {
    if (!s.done) return nullptr;
    return {{"noise_pixels", s.noise},
            {"window_frames", s.window},
            {"bend_pixels", s.bend},
            {"position_error_pixels", s.position_error},
            {"velocity_error", s.velocity_error()},
            {"kicks_per_frame", s.kicks},
            {"added_to_temperature", s.missing_energy}};
}

Json camera_json(const Tracks& tracks, const FittedSeries& fitted) {
    return {{"filled_positions", tracks.repaired.filled},
            {"relabelled", tracks.repaired.relabelled},
            {"dropped_positions", tracks.repaired.dropped},
            {"breaks", fitted.series.breaks.size()},
            {"frames_outside", fitted.fit.outside},
            {"frames_overlapping", fitted.fit.overlapping},
            {"wall_gap", fitted.fit.wall_gap},
            {"fitting_phase", fitted.fit.fitting_phase},
            {"smoothing", smoothing_json(fitted.smoothing)}};
}

}  // namespace

OpenedSeries open_tracks(const std::string& file, const TrackTexts& camera, double misfit) {
    const TrackScale scale = track_scale(camera, file);
    Tracks tracks = at_equal_steps(read_tracks(file, scale, table_layout(camera)), scale);
    if (tracks.frames.size() == 1 && tracks.frames.front().velocity.empty())
        throw Failure(
            fmt::format("'{}' holds a single frame, but velocities need at least two.", file));
    const CameraRecord record = camera_record(file);
    FittedSeries fitted = fitted_series(tracks, scale, misfit);
    Json found = camera_json(tracks, fitted);
    found["uneven_times"] = record.uneven_times ? Json(*record.uneven_times) : Json(nullptr);
    OpenedSeries opened;
    opened.series = std::move(fitted.series);
    opened.remarks = std::move(fitted.remarks);
    opened.camera = found.dump();
    if (record.uncertain.empty()) return opened;
    cut(tracks, record.uncertain);
    TrackSmoothing ignored;
    opened.without_swaps = smoothed_series(std::move(tracks), scale, ignored);
    opened.swaps = record.uncertain.size() / 2;
    return opened;
}

}  // namespace swirl
