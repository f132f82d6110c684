#include "swirl/app/opened_tracks.hpp"

#include <fmt/format.h>

#include <utility>

#include "swirl/app/track_fit.hpp"
#include "swirl/run/failure.hpp"

namespace swirl {
namespace {

using Json = nlohmann::ordered_json;

Json camera_json(const Tracks& tracks, const SnapshotSeries& series, const TrackFit& fit) {
    return {{"filled_positions", tracks.mended.filled},
            {"renamed", tracks.mended.renamed},
            {"dropped_positions", tracks.mended.dropped},
            {"breaks", series.breaks.size()},
            {"frames_outside", fit.outside},
            {"frames_overlapping", fit.overlapping},
            {"wall_gap", fit.wall_gap},
            {"fitting_phase", fit.fitting_phase}};
}

}  // namespace

OpenedSeries open_tracks(const std::string& file, const TrackTexts& camera, double misfit) {
    const TrackScale scale = track_scale(camera, file);
    Tracks tracks = read_tracks(file, scale);
    if (tracks.frames.size() == 1 && tracks.frames.front().velocity.empty())
        throw Failure(fmt::format(
            "'{}' holds a single frame, which tells no velocities; two are the least.", file));
    OpenedSeries opened;
    opened.remarks = mended_text(tracks);
    opened.series = series_of(tracks, scale);
    const TrackFit fit = fit_of(opened.series, scale);
    refuse_misfit(fit, scale, misfit);
    opened.remarks += fit_text(fit);
    if (!opened.series.same_discs())
        opened.remarks += fmt::format(
            "Discs come or go at {} of {} frames; who is pinned is followed anew from there.\n",
            opened.series.breaks.size(), opened.series.frames);
    opened.camera = camera_json(tracks, opened.series, fit);
    return opened;
}

}  // namespace swirl
