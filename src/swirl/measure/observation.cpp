#include "swirl/measure/observation.hpp"

#include <utility>

namespace swirl {
namespace {

using Pinned = std::span<const std::uint8_t>;

template <class M>
concept TakesCells = requires(M& m, const MFrameView& view, const Voronoi& cells, Pinned pinned) {
    m.sample(view, cells, pinned);
};
template <class M>
concept TakesPinned = requires(M& m, const MFrameView& view, Pinned pinned) {
    m.sample(view, pinned);
};
template <class M>
concept TakesResidences = requires(M& m, const LongResidences& residences) {
    m.sample_residences(residences);
};
template <class M>
concept TakesView = !TakesCells<M> && !TakesPinned<M> && requires(M & m, const MFrameView& view) {
    m.sample(view);
};
template <class M>
concept TakesLab = requires(M& m, const Snapshot& lab) {
    m.sample_in_lab(lab);
};
template <class M>
concept TakesPositions = requires(M& m, const Snapshot& lab) {
    m.sample_within_period(lab);
    m.sample_across_periods(lab);
    m.begin_anew();
};
template <class M>
concept TakesEventAndState = requires(M& m, const Event& event, const Snapshot& after) {
    m.sample(event, after);
};
template <class M>
concept TakesEvent = requires(M& m, const Event& event) {
    m.sample(event);
};
template <class M>
concept TakesViewByEvent = requires(M& m, const MFrameView& view) {
    m.sample_by_event(view);
};
template <class M>
concept ClosesSamples = requires(M& m) {
    m.close_block();
};
template <class M>
concept ClosesWithDurationAndDiscs = requires(M& m, double duration, std::size_t discs) {
    m.close_block(duration, discs);
};
template <class M>
concept ClosesWithDuration = requires(M& m, double duration) {
    m.close_block(duration);
};
template <class M>
concept AddsEnergy = requires(M& m, double missing) {
    m.add_energy(missing);
};
template <class M>
concept ReportsTracks = requires(const M& m, Report& report, const PinnedLoose& tracks) {
    m.report(report, tracks);
};

template <class M>
constexpr MeasurementKind kind_of(const MeasurementRow<M>& row) {
    const bool pinned = TakesPinned<M> || ReportsTracks<M>;
    const bool frames = pinned || TakesCells<M> || TakesView<M> || TakesLab<M> || TakesPositions<M>;
    return {.name = row.name,
            .header = row.header,
            .description = row.description,
            .needs_pinned = pinned,
            .needs_tracks = pinned || TakesPositions<M>,
            .needs_cells = TakesCells<M>,
            .needs_events = !frames};
}

constexpr auto kinds =
    std::apply([](const auto&... row) { return std::array{kind_of(row)...}; }, measurement_list);

template <class M>
void sample_event(M& m, const Event& event, const Snapshot& after) {
    if constexpr (TakesEventAndState<M>)
        m.sample(event, after);
    else if constexpr (TakesEvent<M>)
        m.sample(event);
}

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
    if (!pinned_loose_.knows()) return nullptr;
    return &recent_[(frames_ - 1 - PinnedLoose::half_width) % recent_.size()];
}

Observation::Observation(double container_radius, double period, std::vector<std::string> names,
                         bool same_discs)
    : period_(period), names_(std::move(names)) {
    std::erase_if(names_, [](const std::string& name) { return !find_measurement(name); });
    const auto choose = [&]<class M>(const MeasurementRow<M>& row, std::optional<M>& chosen) {
        for (const std::string& name : names_)
            if (name == row.name) chosen.emplace(row.make(container_radius));
        if (!chosen) return;
        const MeasurementKind kind = kind_of(row);
        views_samples_ |= TakesView<M> || kind.needs_pinned || kind.needs_cells;
        follows_pinned_ |= same_discs && (kind.needs_pinned || kind.needs_cells);
        finds_cells_ |= kind.needs_cells;
        follows_residences_ |= same_discs && TakesResidences<M>;
        samples_by_event_ |= TakesViewByEvent<M>;
    };
    std::apply(
        [&](auto&... chosen) {
            std::apply([&](const auto&... row) { (choose(row, chosen), ...); }, measurement_list);
        },
        chosen_);
}

void Observation::sample(const Snapshot& lab) {
    if (views_samples_ && !follows_pinned_) view_.update(lab);
    const MFrameView& now = follows_pinned_ ? pinned_.sample(lab) : view_;
    const MFrameView* const then = pinned_.earlier();
    const Pinned pinned = pinned_.pinned_loose().pinned();
    if (follows_residences_ && then) residences_.sample(*then);
    const bool positions = samples_ % samples_per_position == 0;
    const bool structure = finds_cells_ && (samples_ + 1) % samples_per_structure == 0;
    const MFrameView* const with_cells = structure ? frame_with_cells(now) : nullptr;
    each([&]<class M>(M& m) {
        if constexpr (TakesCells<M>) {
            if (with_cells) m.sample(*with_cells, cells_, pinned);
        } else if constexpr (TakesPinned<M>) {
            if (then) m.sample(*then, pinned);
        } else if constexpr (TakesView<M>) {
            m.sample(now);
        }
        if constexpr (TakesResidences<M>) {
            if (follows_residences_) m.sample_residences(residences_);
        }
        if constexpr (TakesLab<M>) m.sample_in_lab(lab);
        if constexpr (TakesPositions<M>) {
            if (positions) m.sample_within_period(lab);
            if (block_begins_) m.sample_across_periods(lab);
        }
    });
    block_begins_ = false;
    ++samples_;
}

/// Finds the cells of the frame whose pinned discs are known, and returns it; null while there is
/// none.
const MFrameView* Observation::frame_with_cells(const MFrameView& now) {
    const MFrameView* const frame = follows_pinned_ ? pinned_.earlier() : &now;
    if (frame) cells_.find(*frame);
    return frame;
}

void Observation::sample(const Event& event, const Snapshot& after) {
    discs_ = after.size();
    const bool by_event = samples_by_event_ && (events_ + 1) % events_per_sample == 0;
    if (by_event) view_.update(after);
    each([&]<class M>(M& m) {
        sample_event(m, event, after);
        if constexpr (TakesViewByEvent<M>) {
            if (by_event) m.sample_by_event(view_);
        }
    });
    ++events_;
}

void Observation::begin_tracks() {
    pinned_.begin_tracks();
    residences_.begin_anew();
    each([]<class M>(M& m) {
        if constexpr (TakesPositions<M>) m.begin_anew();
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
        if constexpr (ClosesSamples<M>) m.close_block();
        if constexpr (ClosesWithDurationAndDiscs<M>) {
            if (events_ > 0) m.close_block(period_, discs_);
        } else if constexpr (ClosesWithDuration<M>) {
            if (events_ > 0) m.close_block(period_);
        }
    });
    block_begins_ = true;
}

std::vector<MeasurementReport> Observation::report() const {
    std::vector<MeasurementReport> reports;
    const auto add = [&](std::string_view name, std::string_view row, const auto& chosen) {
        if (name == row)
            reports.push_back({names_[reports.size()], report_of(*chosen, pinned_.pinned_loose())});
    };
    for (const std::string& name : names_)
        std::apply(
            [&](const auto&... chosen) {
                std::apply([&](const auto&... row) { (add(name, row.name, chosen), ...); },
                           measurement_list);
            },
            chosen_);
    return reports;
}

void Observation::merge(const Observation& other) {
    pinned_.merge(other.pinned_);
    const auto take_in = [](auto& mine, const auto& theirs) {
        if (mine && theirs) mine->merge(*theirs);
    };
    std::apply(
        [&](auto&... mine) {
            std::apply([&](const auto&... theirs) { (take_in(mine, theirs), ...); }, other.chosen_);
        },
        chosen_);
}

}  // namespace swirl
