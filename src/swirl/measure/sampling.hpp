// The contract between an observation and its measurements: one concept for each kind of sampling.
//
// A measurement is a class in this folder with a row in measurement_list.hpp. Observation
// (observation.hpp) finds at compile time which of the functions below the class has, and calls
// each of them when it is due. A measurement needs
//
//   - at least one sampling function: sample, sample_in_lab, sample_within_period,
//     sample_across_periods, sample_by_event or sample_event;
//   - close_block() or close_event_block(), called at the end of every period;
//   - merge(other), which adds the closed blocks of an independent run;
//   - fields(visitor), which visits everything that a checkpoint must store;
//   - report(visitor) or report(visitor, pinned_loose): see measurement_report.hpp.
//
// It may have `static constexpr bool any_path = true` (AnyPath); otherwise it is rejected on paths
// without an M-frame. It may have `min_frames_per_period` (NeedsFrameRate) and `reads_only_event`
// (ReadsOnlyEvent).
//
// Each name stands for one function; none of them is overloaded. SamplingContract rejects a class
// that has a function of one of these names with another signature, and a class without a sampling
// function. A function with any other name is an ordinary function that nothing calls.
#pragma once

#include <cstddef>

#include "swirl/measure/long_residence.hpp"
#include "swirl/measure/m_frame.hpp"
#include "swirl/measure/measurement_report.hpp"
#include "swirl/measure/pinned_loose.hpp"
#include "swirl/measure/voronoi.hpp"
#include "swirl/physics/event.hpp"
#include "swirl/physics/snapshot.hpp"

namespace swirl {

/// sample(view, cells, pinned): at every 100th of 511 samples per period, with the Voronoi cells of
/// that frame. If pinned discs are followed, the frame is that of seven samples ago.
template <class M>
concept SamplesCells = requires(M& m, const MFrameView& view, const Voronoi& cells,
                                PinnedFlags pinned) {
    m.sample(view, cells, pinned);
};

/// sample(view, pinned): at every sample, with the frame of seven samples ago and the discs that
/// were pinned then. It takes seven samples to determine which discs are pinned.
template <class M>
concept SamplesPinned = requires(M& m, const MFrameView& view, PinnedFlags pinned) {
    m.sample(view, pinned);
};

/// sample(view): at every sample, with the present frame in the M-frame.
template <class M>
concept SamplesMFrame =
    !SamplesCells<M> && !SamplesPinned<M> && requires(M & m, const MFrameView& view) {
    m.sample(view);
};

/// sample_residences(residences): after every sample. `residences` knows which discs were on a
/// long residence at the wall some time ago.
template <class M>
concept SamplesResidences = requires(M& m, const LongResidences& residences) {
    m.sample_residences(residences);
};

/// sample_in_lab(snapshot): at every sample, in the lab frame.
template <class M>
concept SamplesLab = requires(M& m, const Snapshot& lab) {
    m.sample_in_lab(lab);
};

/// sample_within_period(snapshot): at every 7th of 511 samples per period, in the lab frame.
template <class M>
concept SamplesWithinPeriod = requires(M& m, const Snapshot& lab) {
    m.sample_within_period(lab);
};

/// sample_across_periods(snapshot): at the first sample of every block, in the lab frame.
template <class M>
concept SamplesAcrossPeriods = requires(M& m, const Snapshot& lab) {
    m.sample_across_periods(lab);
};

/// begin_tracks(): the discs of the next sample are not those of the last. Needed together with
/// sample_within_period or sample_across_periods.
template <class M>
concept BeginsTracks = requires(M& m) {
    m.begin_tracks();
};

/// sample_by_event(view): the state after every 32nd event, in the M-frame.
template <class M>
concept SamplesByEvent = requires(M& m, const MFrameView& view) {
    m.sample_by_event(view);
};

/// sample_event(event): after every event.
template <class M>
concept SamplesEvents = requires(M& m, const Event& event) {
    m.sample_event(event);
};

/// sample_event(event, after): after every event, with the state after it.
template <class M>
concept SamplesEventStates = requires(M& m, const Event& event, const Snapshot& after) {
    m.sample_event(event, after);
};

/// A class that reads `after` only for the particles of the event says so by a member `static
/// constexpr bool reads_only_event = true`. Spheres then need not all be moved to its time.
template <class M>
concept ReadsOnlyEvent = SamplesEventStates<M> && M::reads_only_event;

/// close_block(): at the end of every period.
template <class M>
concept ClosesBlocks = requires(M& m) {
    m.close_block();
};

/// close_event_block(duration): at the end of every period, for the events in it. It is not called
/// if no event was ever sampled: then even "no collisions" would be an assumption.
template <class M>
concept ClosesEventBlocks = requires(M& m, double duration) {
    m.close_event_block(duration);
};

/// close_event_block(duration, discs): the same, with the number of discs.
template <class M>
concept ClosesEventBlocksOfDiscs = requires(M& m, double duration, std::size_t discs) {
    m.close_event_block(duration, discs);
};

/// add_energy(missing): once, at the end. ½⟨u²⟩ of a disc is larger by `missing` than its smoothed
/// velocities give.
template <class M>
concept AddsEnergy = requires(M& m, double missing) {
    m.add_energy(missing);
};

/// merge(other): adds the closed blocks of an independent run.
template <class M>
concept Merges = requires(M& m, const M& other) {
    m.merge(other);
};

/// report(visitor): the results (measurement_report.hpp).
template <class M>
concept Reports = requires(const M& m, Report& report) {
    m.report(report);
};

/// report(visitor, pinned_loose): the results, with those of the tracks of pinned discs.
template <class M>
concept ReportsTracks = requires(const M& m, Report& report, const PinnedLoose& tracks) {
    m.report(report, tracks);
};

/// any_path = true: the results do not depend on the M-frame, so the path of the container may have
/// any shape.
template <class M>
concept AnyPath = requires {
    requires M::any_path;
};

/// min_frames_per_period: with fewer samples its definition fails, so it receives none.
template <class M>
concept NeedsFrameRate = requires {
    M::min_frames_per_period;
};

/// Measurements that need frames: positions and velocities at equal time steps.
template <class M>
concept SamplesFrames = SamplesMFrame<M> || SamplesPinned<M> || SamplesCells<M> || SamplesLab<M> ||
    SamplesWithinPeriod<M> || SamplesAcrossPeriods<M>;
template <class M>
concept SamplesAnything =
    SamplesFrames<M> || SamplesByEvent<M> || SamplesEvents<M> || SamplesEventStates<M>;

// A class that inherits a name from two bases cannot use it: the name is ambiguous. So M has a
// member `name`, whatever it is, exactly if Both<M>::name cannot be formed.
#define SWIRL_HAS_MEMBER(name)      \
    namespace has_##name {          \
        struct Other {              \
            int name;               \
        };                          \
        template <class M>          \
        struct Both : M, Other {};  \
        template <class M>          \
        concept holds = !requires { \
            &Both<M>::name;         \
        };                          \
    }

SWIRL_HAS_MEMBER(sample)
SWIRL_HAS_MEMBER(sample_residences)
SWIRL_HAS_MEMBER(sample_in_lab)
SWIRL_HAS_MEMBER(sample_within_period)
SWIRL_HAS_MEMBER(sample_across_periods)
SWIRL_HAS_MEMBER(begin_tracks)
SWIRL_HAS_MEMBER(sample_by_event)
SWIRL_HAS_MEMBER(sample_event)
SWIRL_HAS_MEMBER(close_block)
SWIRL_HAS_MEMBER(close_event_block)
SWIRL_HAS_MEMBER(add_energy)
SWIRL_HAS_MEMBER(fields)
#undef SWIRL_HAS_MEMBER

/// If M has a member `name`, one of the concepts must hold. The message lists the valid signatures.
#define SWIRL_CHECK_SIGNATURE(name, right, signatures) \
    static_assert(!has_##name::holds<M> || (right), "'" #name "' must be callable as " signatures)

/// Fails to compile if M breaks the contract. The compiler names M next to the message.
template <class M>
struct SamplingContract {
    SWIRL_CHECK_SIGNATURE(sample, SamplesMFrame<M> || SamplesPinned<M> || SamplesCells<M>,
                          "sample(const MFrameView&), sample(const MFrameView&, PinnedFlags) or "
                          "sample(const MFrameView&, const Voronoi&, PinnedFlags)");
    SWIRL_CHECK_SIGNATURE(sample_residences, SamplesResidences<M>,
                          "sample_residences(const LongResidences&)");
    SWIRL_CHECK_SIGNATURE(sample_in_lab, SamplesLab<M>, "sample_in_lab(const Snapshot&)");
    SWIRL_CHECK_SIGNATURE(sample_within_period, SamplesWithinPeriod<M>,
                          "sample_within_period(const Snapshot&)");
    SWIRL_CHECK_SIGNATURE(sample_across_periods, SamplesAcrossPeriods<M>,
                          "sample_across_periods(const Snapshot&)");
    SWIRL_CHECK_SIGNATURE(begin_tracks, BeginsTracks<M>, "begin_tracks()");
    SWIRL_CHECK_SIGNATURE(sample_by_event, SamplesByEvent<M>, "sample_by_event(const MFrameView&)");
    SWIRL_CHECK_SIGNATURE(sample_event, SamplesEvents<M> || SamplesEventStates<M>,
                          "sample_event(const Event&) or "
                          "sample_event(const Event&, const Snapshot&)");
    SWIRL_CHECK_SIGNATURE(close_block, ClosesBlocks<M>, "close_block()");
    SWIRL_CHECK_SIGNATURE(close_event_block, ClosesEventBlocks<M> || ClosesEventBlocksOfDiscs<M>,
                          "close_event_block(double) or close_event_block(double, std::size_t)");
    SWIRL_CHECK_SIGNATURE(add_energy, AddsEnergy<M>, "add_energy(double)");
    static_assert(SamplesAnything<M>,
                  "a measurement needs a sampling function: sample, sample_in_lab, "
                  "sample_within_period, sample_across_periods, sample_by_event or sample_event");
    static_assert(BeginsTracks<M> || !(SamplesWithinPeriod<M> || SamplesAcrossPeriods<M>),
                  "sample_within_period and sample_across_periods need 'begin_tracks'");
    static_assert(ClosesBlocks<M> || ClosesEventBlocks<M> || ClosesEventBlocksOfDiscs<M>,
                  "a measurement needs 'close_block' or 'close_event_block'");
    static_assert(Merges<M>, "'merge' must be callable as merge(const M&)");
    static_assert(has_fields::holds<M>, "a measurement needs a member template 'fields'");
    static_assert(Reports<M> || ReportsTracks<M>,
                  "'report' must be callable as report(visitor) const or "
                  "report(visitor, const PinnedLoose&) const");
    static constexpr bool holds = true;
};
#undef SWIRL_CHECK_SIGNATURE

}  // namespace swirl
