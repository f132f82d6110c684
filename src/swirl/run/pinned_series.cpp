#include "swirl/run/pinned_series.hpp"

#include <algorithm>
#include <cmath>

#include "swirl/measure/long_residence.hpp"
#include "swirl/measure/m_frame.hpp"
#include "swirl/measure/pinned_loose.hpp"
#include "swirl/run/measured_series.hpp"

namespace swirl {
namespace {

constexpr std::uint64_t frames_per_chunk = 512;

}  // namespace

PinnedSeries::PinnedSeries(SnapshotSeries series)
    : series_(std::move(series)), rate_(frames_per_period(series_)) {
    const bool has_tracks = series_.has_m_frame && holds_tracks(series_);
    knows_pinned_ = has_tracks && rate_suffices(rate_, min_rate_of_pinned);
    knows_resident_ = has_tracks && rate_suffices(rate_, min_rate_of_resident);
    // A disc is pinned after as many frames in a row as half a window has, and one more.
    const auto window = static_cast<std::uint64_t>(frame_window(rate_).width());
    const auto residence = static_cast<std::uint64_t>(std::ceil(long_residence * rate_));
    margin_ = std::max(2 * window, residence + 2);
}

const PinnedColumns& PinnedSeries::at(std::uint64_t frame) {
    if (frame < begin_ || frame >= end_) find(frame);
    return columns_of(frame);
}

/// Determines the states of the chunk that begins with this frame.
void PinnedSeries::find(std::uint64_t begin) {
    begin_ = begin;
    end_ = std::min(begin + frames_per_chunk, series_.frames);
    first_ = begin - std::min(begin, margin_);
    const std::uint64_t last = std::min(end_ + margin_, series_.frames);
    found_.assign(last - first_, {});
    const FrameWindow window = frame_window(rate_);
    PinnedLoose tracks(window);
    std::vector<Stay> stays;
    MFrameView view;
    for (std::uint64_t k = first_; k < last; ++k) {
        view.update(series_.observed(k));
        const std::size_t n = view.size();
        const bool breaks =
            std::binary_search(series_.breaks.begin(), series_.breaks.end(), k) || k == first_;
        if (breaks) {
            for (std::size_t i = 0; i < stays.size(); ++i) end_stay(stays[i], i, k, false);
            stays.assign(n, {});
            tracks.begin_tracks();
        }
        const double period = view.frame.period();
        minimum_ = least_length(long_residence, period / rate_, period);
        columns_of(k).pinned.assign(n, not_available);
        columns_of(k).resident.assign(n, not_available);
        if (knows_pinned_) tracks.sample(view);
        if (knows_pinned_ && tracks.is_known()) {
            const auto& pinned = tracks.pinned();
            auto& column = columns_of(k - static_cast<std::uint64_t>(window.half_width)).pinned;
            std::copy(pinned.begin(), pinned.end(), column.begin());
        }
        for (std::size_t i = 0; knows_resident_ && i < n; ++i) {
            const bool is_inside = in_wall_layer(view, i);
            if (!is_inside) end_stay(stays[i], i, k, true);
            if (!is_inside) columns_of(k).resident[i] = 0.0;
            if (is_inside && !stays[i].is_inside) stays[i] = {k, view.time, true, !breaks};
        }
        last_time_ = view.time;
    }
    for (std::size_t i = 0; i < stays.size(); ++i) end_stay(stays[i], i, last, false);
}

/// The disc was in the wall layer from the beginning of the stay up to the frame before `end`. A
/// stay of which only a part was seen may have been longer.
void PinnedSeries::end_stay(Stay& stay, std::size_t disc, std::uint64_t end, bool knows_end) {
    if (!stay.is_inside) return;
    const bool is_long = last_time_ - stay.time >= minimum_;
    const double value = is_long ? 1.0 : stay.knows_begin && knows_end ? 0.0 : not_available;
    for (std::uint64_t k = stay.begin; k < end; ++k) columns_of(k).resident[disc] = value;
    stay = {};
}

SnapshotSeries with_pinned_discs(const SnapshotSeries& series) {
    const auto states = std::make_shared<PinnedSeries>(series);
    if (!states->knows_any()) return series;
    SnapshotSeries with = series;
    with.pinned = [states](std::uint64_t k) -> const PinnedColumns& { return states->at(k); };
    return with;
}

}  // namespace swirl
