// Samples any choice of the measurements in measurement_list.hpp. A source of snapshots (a run, a
// recording, a camera's tracks) hands over what it has, in order of time:
//
//     Observation observation({container_radius, period, units}, names);
//     observation.sample(snapshot);       at equal time steps, samples_per_period of them
//     observation.sample(event, after);   after every event, if events are known at all
//     observation.close_block();          at the end of every period
//     observation.begin_tracks();         if the discs of the next sample are not those of the
//                                         last: a camera has lost one, or swapped IDs
//
// The source omits the warm-up by not handing it over. sampling.hpp lists what a measurement can be
// given and when; each of these kinds of sampling is a concept.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "swirl/measure/long_residence.hpp"
#include "swirl/measure/m_frame.hpp"
#include "swirl/measure/measurement_list.hpp"
#include "swirl/measure/measurement_report.hpp"
#include "swirl/measure/pinned_loose.hpp"
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

/// In the order of the list.
std::span<const MeasurementKind> measurement_kinds();
/// Null if no measurement has this name.
const MeasurementKind* find_measurement(std::string_view name);

struct MeasurementReport {
    std::string name;
    Report report;
};

/// Determines which discs are pinned, and stores the last frames. The result for a frame is
/// available half a window later, so a measurement of pinned discs needs the stored frame.
class PinnedFrames {
  public:
    explicit PinnedFrames(double frames_per_period = samples_per_period)
        : pinned_loose_(frame_window(frames_per_period)), recent_(delay() + 1) {}
    const MFrameView& sample(const Snapshot& lab);
    void begin_tracks() { pinned_loose_.begin_tracks(); }
    void close_block() { pinned_loose_.close_block(); }
    const PinnedLoose& pinned_loose() const { return pinned_loose_; }
    /// The frame to which pinned() belongs; null in the first frames of the tracks.
    const MFrameView* earlier() const;

    void merge(const PinnedFrames& other) { pinned_loose_.merge(other.pinned_loose_); }
    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(pinned_loose_, recent_, frames_);
    }
    bool is_consistent() const { return recent_.size() == delay() + 1; }

  private:
    std::size_t delay() const {
        return static_cast<std::size_t>(pinned_loose_.window().half_width);
    }

    PinnedLoose pinned_loose_;
    std::vector<MFrameView> recent_;
    std::size_t frames_ = 0;
};

class Observation {
  public:
    /// The names are those of measurement_kinds(), each once; other names are ignored. `dish` is
    /// that of the snapshots to come. `same_discs` is false if no disc can be followed
    /// for some frames in a row: then it is never known which discs are pinned. The same holds if
    /// there are too few frames per period. With fewer than 511 every frame is used; otherwise
    /// expensive measurements use a part of them (strided.hpp).
    Observation(const ObservedDish& dish, std::vector<std::string> names, bool same_discs = true,
                double frames_per_period = samples_per_period);

    const std::vector<std::string>& names() const { return names_; }
    bool empty() const { return names_.empty(); }
    /// True if a measurement samples events, so that the caller must pass each event.
    bool samples_events() const { return samples_events_; }

    void sample(const Snapshot& lab);
    void sample(const Event& event, const Snapshot& after);
    /// To be called if the discs of the next sample are not those of the last one.
    void begin_tracks();
    void close_block();
    /// For smoothed velocities: ½⟨u²⟩ of a disc, relative to the container, is larger by `missing`.
    void add_energy(double missing);

    /// One report for each measurement, in the order of their names: in r, v and m, with errors
    /// for few periods (few_blocks.hpp). A recording has at most `whole_periods` independent blocks.
    std::vector<MeasurementReport> report(
        std::size_t whole_periods = std::numeric_limits<std::size_t>::max()) const;
    /// The velocities of the frames are differences of positions, as those of tracks.
    void takes_differences() { velocities_are_differences_ = true; }
    /// False if these frames are too few for the number, which is then n/a.
    bool has_rate(const Quantity& quantity) const;
    /// Removes all closed blocks; what is followed across periods stays (forget_blocks.hpp).
    void forget_blocks();

    /// Adds the closed blocks of another observation with the same names.
    void merge(const Observation& other);

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
            (visit(std::get<K>(measurement_list), std::get<K>(chosen)), ...);
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
    ChosenFrom<std::remove_const_t<decltype(measurement_list)>>::Type chosen_;
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

}  // namespace swirl
