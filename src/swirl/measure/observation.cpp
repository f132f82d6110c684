#include "swirl/measure/observation.hpp"

#include <cmath>
#include <utility>

#include "swirl/measure/forget_blocks.hpp"

namespace swirl {
namespace {

template <class M>
constexpr double min_rate_of() {
    if constexpr (NeedsFrameRate<M>) return M::min_frames_per_period;
    return 0.0;
}

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
    return &recent_[(frames_ - 1 - delay()) % recent_.size()];
}

Observation::Observation(const ObservedDish& dish, std::vector<std::string> names, bool same_discs,
                         double frames_per_period)
    : period_(dish.period),
      units_(dish.units),
      frames_per_period_(frames_per_period),
      names_(std::move(names)),
      pinned_(frames_per_period) {
    const bool knows_pinned = same_discs && rate_suffices(frames_per_period, min_rate_of_pinned);
    const bool knows_resident =
        same_discs && rate_suffices(frames_per_period, min_rate_of_resident);
    const bool uses_every_frame = std::round(frames_per_period) < samples_per_period;
    if (uses_every_frame) per_structure_ = per_position_ = 1;
    std::erase_if(names_, [](const std::string& name) { return !find_measurement(name); });
    each_row(chosen_, [&]<class M>(const MeasurementRow<M>& row, std::optional<M>& chosen) {
        for (const std::string& name : names_)
            if (name == row.name) chosen.emplace(row.make(dish));
        if (!chosen) return;
        if constexpr (requires { chosen->use_every_sample(); }) {
            if (uses_every_frame) chosen->use_every_sample();
        }
        const MeasurementKind kind = kind_of(row);
        views_samples_ |= SamplesMFrame<M> || kind.needs_pinned || kind.needs_cells;
        // Residences are those of the frames in which pinned discs are known.
        knows_pinned_ |=
            knows_pinned && (kind.needs_pinned || kind.needs_cells || SamplesResidences<M>);
        follows_tracks_ |= knows_pinned_;
        finds_cells_ |= kind.needs_cells;
        follows_residences_ |= knows_resident && SamplesResidences<M>;
        samples_by_event_ |= SamplesByEvent<M>;
        samples_events_ |= SamplesByEvent<M> || SamplesEvents<M> || SamplesEventStates<M>;
    });
}

void Observation::sample(const Snapshot& lab) {
    if (views_samples_ && !follows_tracks_) view_.update(lab);
    const MFrameView& now = follows_tracks_ ? pinned_.sample(lab) : view_;
    const MFrameView* const known = knows_pinned_ ? pinned_.earlier() : &now;
    const PinnedFlags pinned =
        knows_pinned_ ? PinnedFlags(pinned_.pinned_loose().pinned()) : PinnedFlags();
    if (follows_residences_ && known) residences_.sample(*known);
    const bool positions = samples_ % per_position_ == 0;
    const bool structure = finds_cells_ && (samples_ + 1) % per_structure_ == 0;
    if (structure && known) cells_.find(*known);
    each([&]<class M>(M& m) {
        if (!rate_suffices(frames_per_period_, min_rate_of<M>())) return;
        if constexpr (SamplesCells<M>) {
            if (structure && known) m.sample(*known, cells_, pinned);
        } else if constexpr (SamplesPinned<M>) {
            if (known) m.sample(*known, pinned);
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

std::vector<MeasurementReport> Observation::report(std::size_t whole_periods) const {
    std::vector<MeasurementReport> reports;
    for (const std::string& name : names_)
        each_row(chosen_, [&](const auto& row, const auto& chosen) {
            if (name != row.name) return;
            Report report = report_of(*chosen, pinned_.pinned_loose());
            omit(report, [&](const Quantity& q) { return !has_rate(q); });
            in_printed_units(report, units_);
            correct_errors(report, whole_periods);
            reports.push_back({name, std::move(report)});
        });
    return reports;
}

bool Observation::has_rate(const Quantity& q) const {
    const double needed =
        velocities_are_differences_ ? q.min_rates.of_tracks : q.min_rates.of_frames;
    return rate_suffices(frames_per_period_, needed);
}

void Observation::forget_blocks() {
    pinned_.fields(ForgetBlocks());
    each([](auto& m) { m.fields(ForgetBlocks()); });
}

void Observation::merge(const Observation& other) {
    pinned_.merge(other.pinned_);
    each_row(chosen_, [&]<class M>(const MeasurementRow<M>&, std::optional<M>& mine) {
        const auto& theirs = std::get<std::optional<M>>(other.chosen_);
        if (mine && theirs) mine->merge(*theirs);
    });
}

}  // namespace swirl
