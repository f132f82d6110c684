// Samples any choice of the measurements in a list: all of them (observation.hpp), or those of the
// browser page. A source of snapshots (a run, a recording, a camera's tracks) hands over what it
// has, in order of time:
//
//     Observation observation({container_radius, period, units}, names);
//     observation.sample(snapshot);       at equal time steps, samples_per_period of them
//     observation.sample(event, after);   after every event, if events are known at all; `after`
//                                         is a snapshot or moves its particles when asked to
//                                         (event_states.hpp)
//     observation.close_block();          at the end of every period
//     observation.begin_tracks();         if the discs of the next sample are not those of the
//                                         last: a camera has lost one, or swapped IDs
//
// The source omits the warm-up by not handing it over. sampling.hpp lists what a measurement can be
// given and when; each of these kinds of sampling is a concept.
//
// The list is a class with a tuple `rows` of MeasurementRow. Only what is listed becomes part of a
// program.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "swirl/measure/event_states.hpp"
#include "swirl/measure/forget_blocks.hpp"
#include "swirl/measure/long_residence.hpp"
#include "swirl/measure/m_frame.hpp"
#include "swirl/measure/measurement_report.hpp"
#include "swirl/measure/measurement_row.hpp"
#include "swirl/measure/observation_fwd.hpp"
#include "swirl/measure/pinned_frames.hpp"
#include "swirl/measure/strided.hpp"
#include "swirl/measure/voronoi.hpp"
#include "swirl/physics/event.hpp"
#include "swirl/physics/snapshot.hpp"

namespace swirl {

/// Every 32nd event suffices for averages by event: the mean stays, and the error hardly grows.
inline constexpr int events_per_sample = 32;

/// Cells are found at every 100th sample: they cost as much as twenty samples, and the structure
/// changes slowly. 100 and 511 have no common divisor, so every phase of the swirl occurs.
inline constexpr int samples_per_structure = 100;

/// Displacements within a period are taken at every 7th sample, 73 times per period.
inline constexpr int samples_per_position = 7;

/// A row of the list, and what follows from the functions of its class.
struct MeasurementKind {
    std::string_view name, header, description;
    bool needs_pinned;   // has no result if the pinned discs are unknown
    bool needs_tracks;   // the same discs in every frame
    bool needs_cells;    // Voronoi cells
    bool needs_events;   // every collision: frames are not enough
    bool needs_m_frame;  // undefined on a path without an M-frame
};

template <class M>
constexpr double min_frame_rate_of() {
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

struct MeasurementReport {
    std::string name;
    Report report;
};

template <class Measurements>
class BasicObservation {
  public:
    /// The names are those of the rows, each once; other names are ignored. `dish` is
    /// that of the snapshots to come. `same_discs` is false if no disc can be followed
    /// for some frames in a row: then it is never known which discs are pinned. The same holds if
    /// there are too few frames per period. With fewer than 511 every frame is used; otherwise
    /// expensive measurements use a part of them (strided.hpp).
    BasicObservation(const ObservedDish& dish, std::vector<std::string> names,
                     bool same_discs = true, double frames_per_period = samples_per_period);

    /// True if a row has this name.
    static bool has(std::string_view name);

    const std::vector<std::string>& names() const { return names_; }
    bool empty() const { return names_.empty(); }
    /// True if a measurement samples events, so that the caller must pass each event.
    bool samples_events() const { return samples_events_; }

    void sample(const Snapshot& lab);
    void sample(const Event& event, const EventStates& after);
    /// To be called if the discs of the next sample are not those of the last one.
    void begin_tracks();
    void close_block();
    /// For smoothed velocities: ½⟨u²⟩ of a disc, relative to the container, is larger by `missing`.
    void add_energy(double missing);

    /// One report for each measurement, in the order of their names: in r, v and m, with errors for
    /// few periods (few_blocks.hpp). A recording has at most `whole_periods` independent blocks.
    std::vector<MeasurementReport> report(
        std::size_t whole_periods = std::numeric_limits<std::size_t>::max()) const;
    /// The velocities of the frames are differences of positions, as those of tracks.
    void takes_differences() { velocities_are_differences_ = true; }
    /// False if these frames are too few for the number, which is then n/a.
    bool has_rate(const Quantity& quantity) const;
    /// Removes all closed blocks; what is followed across periods stays (forget_blocks.hpp).
    void forget_blocks();

    /// Adds the closed blocks of another observation with the same names.
    void merge(const BasicObservation& other);

    /// The complete state, for checkpoints.
    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(samples_, events_, discs_, block_begins_, pinned_, residences_);
        each([&](auto& m) { visit(m); });
    }

  private:
    template <class List>
    struct ChosenFrom;
    template <class... M>
    struct ChosenFrom<std::tuple<MeasurementRow<M>...>> {
        using Type = std::tuple<std::optional<M>...>;
    };

    /// Calls visit(row, chosen) for all rows of the list.
    template <class Chosen, class Visit>
    static void each_row(Chosen& chosen, Visit&& visit) {
        [&]<std::size_t... K>(std::index_sequence<K...>) {
            (visit(std::get<K>(Measurements::rows), std::get<K>(chosen)), ...);
        }
        (std::make_index_sequence<std::tuple_size_v<Chosen>>{});
    }
    /// Calls visit(measurement) for all that were chosen.
    template <class Visit>
    void each(Visit&& visit) {
        std::apply([&](auto&... m) { ((m ? visit(*m) : void()), ...); }, chosen_);
    }

    double period_;  // the present one
    MeasuredUnits units_;
    double frames_per_period_;
    int per_structure_ = samples_per_structure, per_position_ = samples_per_position;
    std::vector<std::string> names_;
    ChosenFrom<std::remove_cvref_t<decltype(Measurements::rows)>>::Type chosen_;
    bool views_samples_ = false, follows_tracks_ = false, follows_residences_ = false;
    bool knows_pinned_ = false, velocities_are_differences_ = false;
    bool finds_cells_ = false, samples_by_event_ = false, samples_events_ = false;

    std::int64_t samples_ = 0;
    std::uint64_t events_ = 0;
    std::size_t discs_ = 0;     // number at the last event
    bool block_begins_ = true;  // the present block has no sample yet
    PinnedFrames pinned_;
    LongResidences residences_;  // covers the frames that pinned_ knows
    MFrameView view_;  // the present sample if pinned discs are not followed; also the last event
    Voronoi cells_;
};

template <class M>
Report report_of(const M& m, const PinnedLoose& tracks) {
    Report report;
    if constexpr (ReportsTracks<M>)
        m.report(report, tracks);
    else
        m.report(report);
    return report;
}

template <class Measurements>
bool BasicObservation<Measurements>::has(std::string_view name) {
    return std::apply([&](const auto&... row) { return ((name == row.name) || ...); },
                      Measurements::rows);
}

template <class Measurements>
BasicObservation<Measurements>::BasicObservation(const ObservedDish& dish,
                                                 std::vector<std::string> names, bool same_discs,
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
    std::erase_if(names_, [](const std::string& name) { return !has(name); });
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

template <class Measurements>
void BasicObservation<Measurements>::sample(const Snapshot& lab) {
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
        if (!rate_suffices(frames_per_period_, min_frame_rate_of<M>())) return;
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

template <class Measurements>
void BasicObservation<Measurements>::sample(const Event& event, const EventStates& after) {
    discs_ = after.of_event().size();
    period_ = after.of_event().period;
    const bool by_event = samples_by_event_ && (events_ + 1) % events_per_sample == 0;
    if (by_event) view_.update(after.of_all());
    each([&]<class M>(M& m) {
        if constexpr (ReadsOnlyEvent<M>)
            m.sample_event(event, after.of_event());
        else if constexpr (SamplesEventStates<M>)
            m.sample_event(event, after.of_all());
        else if constexpr (SamplesEvents<M>)
            m.sample_event(event);
        if constexpr (SamplesByEvent<M>) {
            if (by_event) m.sample_by_event(view_);
        }
    });
    ++events_;
}

template <class Measurements>
void BasicObservation<Measurements>::begin_tracks() {
    pinned_.begin_tracks();
    residences_.begin_tracks();
    each([]<class M>(M& m) {
        if constexpr (BeginsTracks<M>) m.begin_tracks();
    });
}

template <class Measurements>
void BasicObservation<Measurements>::add_energy(double missing) {
    each([&]<class M>(M& m) {
        if constexpr (AddsEnergy<M>) m.add_energy(missing);
    });
}

template <class Measurements>
void BasicObservation<Measurements>::close_block() {
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

template <class Measurements>
std::vector<MeasurementReport> BasicObservation<Measurements>::report(
    std::size_t whole_periods) const {
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

template <class Measurements>
bool BasicObservation<Measurements>::has_rate(const Quantity& q) const {
    const double needed =
        velocities_are_differences_ ? q.min_rates.of_tracks : q.min_rates.of_frames;
    return rate_suffices(frames_per_period_, needed);
}

template <class Measurements>
void BasicObservation<Measurements>::forget_blocks() {
    pinned_.fields(ForgetBlocks());
    each([](auto& m) { m.fields(ForgetBlocks()); });
}

template <class Measurements>
void BasicObservation<Measurements>::merge(const BasicObservation& other) {
    pinned_.merge(other.pinned_);
    each_row(chosen_, [&]<class M>(const MeasurementRow<M>&, std::optional<M>& mine) {
        const auto& theirs = std::get<std::optional<M>>(other.chosen_);
        if (mine && theirs) mine->merge(*theirs);
    });
}

}  // namespace swirl
