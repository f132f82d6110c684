#include "swirl/measure/observation.hpp"

#include <utility>

namespace swirl {
namespace {

template <class M>
constexpr MeasurementKind kind_of(const MeasurementRow<M>& row) {
    const bool pinned = SamplesPinned<M> || ReportsTracks<M>;
    const bool positions = SamplesWithinPeriod<M> || SamplesAcrossPeriods<M>;
    return {.name = row.name,
            .header = row.header,
            .description = row.description,
            .needs_pinned = pinned,
            .needs_tracks = pinned || positions,
            .needs_cells = SamplesCells<M>,
            .needs_events = !pinned && !SamplesFrames<M>,
            .needs_m_frame = !AnyPath<M>};
}

constexpr auto kinds =
    std::apply([](const auto&... row) { return std::array{kind_of(row)...}; }, measurement_list);

template <class M>
Report report_of(const M& m, const PinnedLoose& tracks) {
    Report report;
    if constexpr (ReportsTracks<M>)
        m.report(report, tracks);
    else
        m.report(report);
    return report;
}

}  // namespace

std::span<const MeasurementKind> measurement_kinds() { return kinds; }

const MeasurementKind* find_measurement(std::string_view name) {
    for (const MeasurementKind& kind : kinds)
        if (kind.name == name) return &kind;
    return nullptr;
}

const MFrameView& PinnedFrames::sample(const Snapshot& lab) {
    MFrameView& now = recent_[frames_++ % recent_.size()];
    now.update(lab);
    pinned_loose_.sample(now);
    return now;
}

const MFrameView* PinnedFrames::earlier() const {
    if (!pinned_loose_.is_known()) return nullptr;
    return &recent_[(frames_ - 1 - PinnedLoose::half_width) % recent_.size()];
}

Observation::Observation(double container_radius, double period, std::vector<std::string> names,
                         bool same_discs)
    : period_(period), names_(std::move(names)) {
    std::erase_if(names_, [](const std::string& name) { return !find_measurement(name); });
    each_row(chosen_, [&]<class M>(const MeasurementRow<M>& row, std::optional<M>& chosen) {
        for (const std::string& name : names_)
            if (name == row.name) chosen.emplace(row.make(container_radius));
        if (!chosen) return;
        const MeasurementKind kind = kind_of(row);
        views_samples_ |= SamplesMFrame<M> || kind.needs_pinned || kind.needs_cells;
        // Residences are those of the frames in which pinned discs are known.
        follows_pinned_ |=
            same_discs && (kind.needs_pinned || kind.needs_cells || SamplesResidences<M>);
        finds_cells_ |= kind.needs_cells;
        follows_residences_ |= same_discs && SamplesResidences<M>;
        samples_by_event_ |= SamplesByEvent<M>;
        samples_events_ |= SamplesByEvent<M> || SamplesEvents<M> || SamplesEventStates<M>;
    });
}

void Observation::sample(const Snapshot& lab) {
    if (views_samples_ && !follows_pinned_) view_.update(lab);
    const MFrameView& now = follows_pinned_ ? pinned_.sample(lab) : view_;
    const MFrameView* const earlier = pinned_.earlier();
    const PinnedFlags pinned = pinned_.pinned_loose().pinned();
    if (follows_residences_ && earlier) residences_.sample(*earlier);
    const bool positions = samples_ % samples_per_position == 0;
    const bool structure = finds_cells_ && (samples_ + 1) % samples_per_structure == 0;
    const MFrameView* const with_cells = structure ? frame_with_cells(now) : nullptr;
    each([&]<class M>(M& m) {
        if constexpr (SamplesCells<M>) {
            if (with_cells) m.sample(*with_cells, cells_, pinned);
        } else if constexpr (SamplesPinned<M>) {
            if (earlier) m.sample(*earlier, pinned);
        } else if constexpr (SamplesMFrame<M>) {
            m.sample(now);
        }
        if constexpr (SamplesResidences<M>) {
            if (follows_residences_) m.sample_residences(residences_);
        }
        if constexpr (SamplesLab<M>) m.sample_in_lab(lab);
        if constexpr (SamplesWithinPeriod<M>) {
            if (positions) m.sample_within_period(lab);
        }
        if constexpr (SamplesAcrossPeriods<M>) {
            if (block_begins_) m.sample_across_periods(lab);
        }
    });
    block_begins_ = false;
    ++samples_;
}

/// Finds the cells of the frame whose pinned discs are known, and returns that frame; null if there
/// is none yet.
const MFrameView* Observation::frame_with_cells(const MFrameView& now) {
    const MFrameView* const frame = follows_pinned_ ? pinned_.earlier() : &now;
    if (frame) cells_.find(*frame);
    return frame;
}

void Observation::sample(const Event& event, const Snapshot& after) {
    discs_ = after.size();
    period_ = after.period;
    const bool by_event = samples_by_event_ && (events_ + 1) % events_per_sample == 0;
    if (by_event) view_.update(after);
    each([&]<class M>(M& m) {
        if constexpr (SamplesEventStates<M>)
            m.sample_event(event, after);
        else if constexpr (SamplesEvents<M>)
            m.sample_event(event);
        if constexpr (SamplesByEvent<M>) {
            if (by_event) m.sample_by_event(view_);
        }
    });
    ++events_;
}

void Observation::begin_tracks() {
    pinned_.begin_tracks();
    residences_.begin_tracks();
    each([]<class M>(M& m) {
        if constexpr (BeginsTracks<M>) m.begin_tracks();
    });
}

void Observation::add_energy(double missing) {
    each([&]<class M>(M& m) {
        if constexpr (AddsEnergy<M>) m.add_energy(missing);
    });
}

void Observation::close_block() {
    pinned_.close_block();
    each([&]<class M>(M& m) {
        if constexpr (ClosesBlocks<M>) m.close_block();
        if constexpr (ClosesEventBlocksOfDiscs<M>) {
            if (events_ > 0) m.close_event_block(period_, discs_);
        } else if constexpr (ClosesEventBlocks<M>) {
            if (events_ > 0) m.close_event_block(period_);
        }
    });
    block_begins_ = true;
}

std::vector<MeasurementReport> Observation::report() const {
    std::vector<MeasurementReport> reports;
    for (const std::string& name : names_)
        each_row(chosen_, [&](const auto& row, const auto& chosen) {
            if (name == row.name)
                reports.push_back({name, report_of(*chosen, pinned_.pinned_loose())});
        });
    return reports;
}

void Observation::merge(const Observation& other) {
    pinned_.merge(other.pinned_);
    each_row(chosen_, [&]<class M>(const MeasurementRow<M>&, std::optional<M>& mine) {
        const auto& theirs = std::get<std::optional<M>>(other.chosen_);
        if (mine && theirs) mine->merge(*theirs);
    });
}

}  // namespace swirl
