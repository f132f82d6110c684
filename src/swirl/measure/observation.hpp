// What an observer of a dish sees: any choice of the measurements (measurement_list.hpp), each
// given its samples when they are due. Whoever has a dish to show, a run, a recording or a camera's
// tracks, hands over what there is, in order of time:
//
//     Observation observation(container_radius, period, names);
//     observation.sample(snapshot);       at equal steps of time, samples_per_period of them
//     observation.sample(event, after);   after every event, if events are known at all
//     observation.close_block();          at the end of every period
//     observation.begin_tracks();         where the discs to come are not those of before: a camera
//                                         has lost one, or names it otherwise
//
// Warm-up is what is not handed over. A measurement is a class with close_block(), merge(),
// fields(), report(visitor), and those of the following that it needs; which they are is found out
// when this is compiled:
//
//     sample(view)                     every sample, in the M-frame
//     sample(view, pinned)             the frame of seven samples ago and who was pinned then,
//                                      which is not known sooner (pinned_loose.hpp)
//     sample(view, cells, pinned)      every 100th sample and its Voronoi cells; seven samples late
//                                      too where somebody follows the pinned
//     sample_stays(stays)              after every sample, beside those of the pinned: by now it is
//                                      known who was on a long stay at the wall some time ago
//     sample_in_lab(snapshot)          every sample, in the lab
//     sample_within_period(snapshot)   every 7th sample, in the lab
//     sample_across_periods(snapshot)  the first sample of every block, in the lab
//     sample(event[, after])           every event
//     begin_anew()                     beside sample_within_period: other discs from here on
//     sample_by_event(view)            the state after every 32nd event, in the M-frame
//     close_block(duration[, discs])   instead of close_block() or beside it: of the collisions
//                                      alone. Without events it is not called: then nothing is
//                                      known, not even that nothing happened
//     add_energy(missing)              ½⟨u²⟩ of a disc is so much more than its velocities say: who
//                                      gives smoothed ones knows
//     report(visitor, pinned_loose)    instead of report(visitor): what the tracks say of pinned
//                                      discs belongs to it too
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

#include "swirl/measure/long_residence.hpp"
#include "swirl/measure/m_frame.hpp"
#include "swirl/measure/measurement_list.hpp"
#include "swirl/measure/measurement_report.hpp"
#include "swirl/measure/pinned_loose.hpp"
#include "swirl/measure/voronoi.hpp"
#include "swirl/physics/event.hpp"
#include "swirl/physics/snapshot.hpp"

namespace swirl {

/// The paper's camera took 960 frames per second of a table turning at 11.81 rad/s.
inline constexpr int samples_per_period = 511;

/// By event every 32nd will do: that changes the error, hardly, and not the mean.
inline constexpr int events_per_sample = 32;

/// Cells are found at every hundredth sample: they cost as much as twenty others, and the structure
/// changes slowly. 100 and 511 have no common divisor, so every phase of the swirl is met.
inline constexpr int samples_per_structure = 100;

/// Displacements within a period are taken at every seventh sample, 73 times per period.
inline constexpr int samples_per_position = 7;

/// A row of the list, and what follows from the functions of its class.
struct MeasurementKind {
    std::string_view name, header, description;
    bool needs_pinned;  // has nothing to say if it is not known who is pinned
    bool needs_tracks;  // the same discs in every frame
    bool needs_cells;   // Voronoi's
    bool needs_events;  // collision by collision: frames are not enough
};

/// In the order of the list.
std::span<const MeasurementKind> measurement_kinds();
/// Null if there is none of this name.
const MeasurementKind* find_measurement(std::string_view name);

struct MeasurementReport {
    std::string name;
    Report report;
};

/// Who is pinned, and the frames of the last moments, so that a disc found pinned can be seen where
/// it was then.
class PinnedFrames {
  public:
    const MFrameView& sample(const Snapshot& lab);
    void begin_tracks() { pinned_loose_.begin_anew(); }
    void close_block() { pinned_loose_.close_block(); }
    const PinnedLoose& pinned_loose() const { return pinned_loose_; }
    /// The frame that pinned() speaks of; null in the first frames of the tracks.
    const MFrameView* earlier() const;

    void merge(const PinnedFrames& other) { pinned_loose_.merge(other.pinned_loose_); }
    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(pinned_loose_);
        visit(recent_);
        visit(frames_);
    }

  private:
    PinnedLoose pinned_loose_;
    std::array<MFrameView, PinnedLoose::half_width + 1> recent_;
    std::size_t frames_ = 0;
};

class Observation {
  public:
    /// The names are those of measurement_kinds(), each once; others are passed over. Without the
    /// same discs for some frames in a row nobody follows which are pinned. Radius and period are
    /// those of the snapshots to come.
    Observation(double container_radius, double period, std::vector<std::string> names,
                bool same_discs = true);

    const std::vector<std::string>& names() const { return names_; }
    bool empty() const { return names_.empty(); }

    void sample(const Snapshot& lab);
    void sample(const Event& event, const Snapshot& after);
    /// The discs of the next sample are not those of the last.
    void begin_tracks();
    void close_block();
    /// Velocities are smoothed: ½⟨u²⟩ of a disc, relative to the container, is so much more.
    void add_energy(double missing);

    /// In the order of the names.
    std::vector<MeasurementReport> report() const;

    /// Takes in the closed blocks of another observation of the same names.
    void merge(const Observation& other);

    /// Checkpointable: everything gathered, to the last bit.
    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(samples_);
        visit(events_);
        visit(discs_);
        visit(block_begins_);
        visit(pinned_);
        visit(residences_);
        each([&](auto& m) { visit(m); });
    }

  private:
    template <class List>
    struct ChosenFrom;
    template <class... Kinds>
    struct ChosenFrom<std::tuple<MeasurementRow<Kinds>...>> {
        using Type = std::tuple<std::optional<Kinds>...>;
    };

    /// Calls visit(measurement) for all that were chosen.
    template <class Visit>
    void each(Visit&& visit) {
        std::apply([&](auto&... m) { ((m ? visit(*m) : void()), ...); }, chosen_);
    }
    const MFrameView* frame_with_cells(const MFrameView& now);

    double period_;
    std::vector<std::string> names_;
    ChosenFrom<std::remove_const_t<decltype(measurement_list)>>::Type chosen_;
    bool views_samples_ = false, follows_pinned_ = false, follows_residences_ = false;
    bool finds_cells_ = false, samples_by_event_ = false;

    std::int64_t samples_ = 0;
    std::uint64_t events_ = 0;
    std::size_t discs_ = 0;     // at the last event
    bool block_begins_ = true;  // nothing has been sampled of it
    PinnedFrames pinned_;
    LongResidences residences_;  // of the frames that pinned_ knows
    MFrameView view_;            // of now, where the pinned are not followed; and of the last event
    Voronoi cells_;
};

}  // namespace swirl
