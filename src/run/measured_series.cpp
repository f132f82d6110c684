#include "swirl/run/measured_series.hpp"

#include <algorithm>
#include <utility>

namespace swirl {

bool holds_tracks(const SnapshotSeries& series) {
    std::uint64_t begin = 0, longest = 0;
    for (const std::uint64_t end : series.breaks) {
        longest = std::max(longest, end - begin);
        begin = end;
    }
    longest = std::max(longest, series.frames - begin);
    return series.same_discs() || longest > std::uint64_t(PinnedLoose::width);
}

MeasuredSeries measure_series(const SnapshotSeries& series, std::vector<std::string> names,
                              double skip, const std::function<bool(std::uint64_t)>& next) {
    const Snapshot first = series.frame(0);
    Observation observation(first.container_radius, first.period, std::move(names),
                            holds_tracks(series));
    ClusterRotation rotation;
    MeasuredSeries found;
    std::int64_t swirl = first.swirls;
    auto next_break = series.breaks.begin();
    for (std::uint64_t k = 0; k < series.frames && next(k); ++k) {
        const Snapshot s = series.frame(k);
        const bool others = next_break != series.breaks.end() && *next_break == k;
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
        found.discs = std::max(found.discs, s.size());
        ++found.used;
    }
    rotation.close_block();
    observation.close_block();
    found.reports = observation.report();
    found.rotation = rotation.estimates();
    return found;
}

}  // namespace swirl
