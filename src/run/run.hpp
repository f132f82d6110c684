// One simulation from its seed to its averages. Everything larger (figures, sweeps, the search for
// a crossing) is made of runs.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "swirl/measure/cluster_rotation.hpp"
#include "swirl/measure/sample_times.hpp"
#include "swirl/measure/statistics.hpp"
#include "swirl/physics/container_path.hpp"
#include "swirl/physics/event.hpp"
#include "swirl/physics/snapshot.hpp"
#include "swirl/run/config.hpp"
#include "swirl/simulation/simulation.hpp"

namespace swirl {

class Observation;

struct RunResult {
    RunConfig config;
    bool complete = false;      // false: stopped before its end
    EventCounts events;         // all of them, warm-up included
    double periods = 0.0;       // swirls simulated, warm-up included
    std::int64_t warmup = 0;    // whole swirls left out
    EventCounts warmup_events;  // the events in them
    /// In units of Ω, lab frame, over whole swirls; by_event is the paper's average. Without a
    /// whole swirl after the warm-up nothing is averaged, and all is NaN.
    RotationEstimates rotation;
    SteadyState steady;        // of the rotation by event, after the warm-up
    SteadyState steady_spin;   // of the mean spin of the discs, which may take much longer
    double max_overlap = 0.0;  // largest overlap met at a contact: a rounding error
    /// Kinetic energy in the lab frame, spins included: at the start, and at the end.
    double energy_at_start = 0.0, energy = 0.0;
    /// K − ΩL, L about the swirl centre, spins included: conserved on the exact circle when there
    /// is no friction (docs/physics.md).
    double invariant_at_start = 0.0, invariant = 0.0;
    std::uint64_t state_hash = 0;
    double seconds = 0.0;

    /// Steady if both are, drifting if either is.
    SteadyState::Verdict steady_state() const {
        using Verdict = SteadyState::Verdict;
        for (const Verdict v : {Verdict::drifting, Verdict::too_short})
            if (steady.verdict == v || steady_spin.verdict == v) return v;
        return Verdict::steady;
    }
    bool has_whole_swirl() const { return rotation.by_event.blocks > 0; }
    double events_per_second() const {
        return seconds > 0.0 ? static_cast<double>(events.total()) / seconds : 0.0;
    }
};

struct RunProgress {
    double fraction;       // of the run
    std::uint64_t events;  // so far
    double periods;        // so far
};

/// What a caller may want while the run goes on. Everything is optional, and nothing of it changes
/// a bit of the trajectory.
struct RunControl {
    /// Set from outside (a signal) to end the run early; the result then says it is incomplete.
    const std::atomic<bool>* stop = nullptr;

    /// Called a few times a second at most.
    std::function<void(const RunProgress&)> progress;

    /// What is measured besides the rotation, from the end of the warm-up on. Must outlive the run;
    /// what it has gathered is part of the state that is kept.
    Observation* observation = nullptr;

    /// Follow how each sphere is turned (Snapshot::turned).
    bool orientations = false;

    /// What state() said of a run with the same configuration and names of an observation that has
    /// seen nothing yet: the run goes on from there, bit for bit.
    std::optional<std::string> resume;
};

/// A run for who wants to see what happens in it, event by event:
///
///     Run run(config);
///     SampleTimes times = run.sample_times(30);
///     while (run.next_event()) {
///         while (run.next_sample(times)) look(run.snapshot());   // before the event
///         run.pass_event();
///         look(run.event(), run.snapshot());                     // after it
///     }
///     RunResult result = run.result();
///
/// Looking never changes a bit. What RunControl asks for is seen to on the way.
class Run {
  public:
    /// The configuration must have no problem(). Throws FileError if what it is to resume from is
    /// not the state of such a run.
    explicit Run(const RunConfig& config, RunControl control = {});

    /// Finds the event that comes next; false at the end of the run, or when it is to stop. Throws
    /// Failure when time all but stands still.
    bool next_event();
    /// Puts the snapshot to the next of these moments, if one is left up to the event.
    bool next_sample(SampleTimes& times) { return times.next(snapshot_, path_, event_.clock); }
    /// Puts the snapshot behind the event; once for each.
    void pass_event();

    const Event& event() const { return event_; }
    /// Spheres brought up to date: an observer may take it that nobody is accelerated.
    const Snapshot& snapshot() {
        if (!snapshot_.are_spheres()) return snapshot_;
        snapshot_.up_to_date(dated_);
        return dated_;
    }

    /// k T / per_period from the beginning on; or k · interval, if that is above 0.
    SampleTimes sample_times(int per_period, double interval = 0.0) const {
        return {per_period, config_.period, interval};
    }

    bool complete() const;
    /// Whether the warm-up is over, and what is seen counts.
    bool is_warm() const { return warm_; }
    /// A run that goes on from the state of a shorter one has the bits of a run that was as long
    /// from the beginning, but not always its averages: says what they would lack.
    std::optional<std::string> trouble_with_length(const RunConfig& shorter) const;
    /// Of the run as far as it has come.
    RunResult result();

    /// For RunControl::resume; between pass_event() and next_event().
    std::string state();

  private:
    using Clock = std::chrono::steady_clock;

    double seconds() const;
    double periods() const;
    double fraction() const;
    bool observes() const { return warm_ && control_.observation; }
    /// How far the run was at some time.
    struct Mark {
        std::uint64_t events;
        double periods;
    };
    Mark now() const;
    bool look_up();
    void refuse_overlaps() const;
    void refuse_collapse_since(const Mark& mark) const;
    void refuse_collapse_lately() const;
    std::uint64_t collapse_window() const;
    std::string reason_for_collapse() const;
    void sample_rotation_by_event();
    void begin_period();
    bool warm_now();
    bool found_warm();
    ClusterRotation& rotation() { return warm_ ? after_warmup_ : in_warmup_; }
    BlockMean& spin() { return warm_ ? spin_after_ : spin_in_warmup_; }
    template <class Visitor>
    void fields(Visitor&& visit);

    const RunConfig config_;
    const RunControl control_;
    const ContainerPath path_;
    Simulation simulation_;
    Snapshot snapshot_, dated_;
    Event event_;
    SampleTimes rotation_times_, observation_times_;
    int events_to_look_up_;        // until stop, progress and collapse are thought of again
    Mark mark_;                    // the last time that a collapse was looked for
    std::array<Mark, 2> lately_;   // some hundreds of events ago, and fewer
    double seconds_before_ = 0.0;  // by the runs that this one resumes
    Clock::time_point begin_ = Clock::now(), last_report_ = begin_;
    /// What is seen in the warm-up is kept apart: a run too short to have a warm-up needs it.
    ClusterRotation in_warmup_, after_warmup_;
    BlockMean spin_in_warmup_, spin_after_;
    std::int64_t next_question_;  // at this swirl: warm?
    bool warm_;
    bool rotation_is_sampled_ = true;  // after the last event
    RunResult result_;
};

/// From the beginning to the end.
RunResult run(const RunConfig& config, const RunControl& control = {});

}  // namespace swirl
