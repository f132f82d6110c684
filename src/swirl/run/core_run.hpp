// One simulation under observation, from its first event to its result, and nothing around it: no
// file, no clock, no exception, no end of its own. `Run` adds those for a program; a page in a
// browser, which has none of them, builds its dish on this (bindings/wasm).
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "swirl/engine/simulation.hpp"
#include "swirl/measure/cluster_rotation.hpp"
#include "swirl/measure/sample_times.hpp"
#include "swirl/physics/container_path.hpp"
#include "swirl/physics/event.hpp"
#include "swirl/physics/snapshot.hpp"
#include "swirl/run/collapse.hpp"
#include "swirl/run/config.hpp"
#include "swirl/run/result.hpp"
#include "swirl/statistics/block_average.hpp"
#include "swirl/statistics/steady_state.hpp"

namespace swirl {

class Observation;

/// Event by event:
///
///     for (;;) {
///         if (run.is_time_to_look() && (run.complete() || run.trouble())) break;
///         run.find_event();
///         run.pass_event();
///     }
class BareRun {
  public:
    /// What is observed besides the rotation, from the end of the warm-up on, must outlive the run.
    BareRun(const RunConfig& config, const InitialState& begin, Observation* observation = nullptr,
            const Progress& progress = {}, const Tuning& tuning = {});

    /// Executes the event that comes next. The snapshot still holds the state before it.
    void find_event();
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
    /// As the simulation keeps it.
    const Snapshot& kept_snapshot() const { return snapshot_; }
    const Simulation& simulation() const { return simulation_; }
    const ContainerPath& path() const { return path_; }
    /// Follow how each sphere is turned (Snapshot::turned); from the beginning.
    void follow_orientations() {
        if (snapshot_.are_spheres()) snapshot_.turned.assign(snapshot_.size(), {});
    }

    bool complete() const;
    /// Of the run.
    double fraction() const;
    double periods() const;
    /// Whether the warm-up is over, and what is seen counts.
    bool is_warm() const { return warm_; }
    /// Whole swirls and events that are left out; none before the warm-up is over.
    std::int64_t warmup() const { return result_.warmup; }
    const EventCounts& warmup_events() const { return result_.warmup_events; }

    /// Between two events, once for each: whether it is time to ask whether the run is complete,
    /// for trouble, and for whatever else is asked now and then. It always is when the run is
    /// complete.
    bool is_time_to_look() {
        if (events_to_look_ > 0) {
            --events_to_look_;
            return false;
        }
        events_to_look_ = std::max(events_until_look() - 1, 0);
        return true;
    }
    /// Why it cannot go on, as a full sentence: rounding errors have grown too large, or time all
    /// but stands still.
    std::optional<std::string> problem();
    /// The same, of the last events alone.
    std::optional<std::string> problem_at_the_end() const;

    /// What is seen in the warm-up is kept apart: a run too short to have a warm-up needs it.
    const ClusterRotation& rotation_in_warmup() {
        sample_by_event();
        return in_warmup_;
    }
    const ClusterRotation& rotation_after_warmup() {
        sample_by_event();
        return after_warmup_;
    }
    /// As far as the run has come, but for the time that it took; between two events.
    RunResult result();

    /// What the run has gathered beside the moment it has reached (checkpoints). What it is
    /// observed by is kept by whom it belongs to.
    template <class Visitor>
    void fields(Visitor&& visit) {
        sample_by_event();
        visit(warm_, rotation_times_, in_warmup_, after_warmup_);
        visit(result_.warmup, result_.warmup_events, result_.max_overlap);
        visit(result_.energy_at_start, result_.invariant_at_start);
        visit(spin_in_warmup_, spin_after_, next_question_);
        if (!snapshot_.turned.empty()) visit(std::span(snapshot_.turned));
        if (observation_) visit(observation_times_);
    }

  private:
    bool observes() const { return warm_ && observation_; }
    RunMark mark() const { return {simulation_.events().total(), periods()}; }
    int events_until_look() const;
    std::optional<std::string> overlap_problem() const;
    std::string collapse_sentence(const Collapse& collapse) const;
    std::string reason_for_collapse() const;
    void sample_by_event();
    void begin_period();
    bool warm_now();
    bool found_warm();
    SteadyState steady_state_of(const BlockSeries& series) const;
    ClusterRotation& rotation() { return warm_ ? after_warmup_ : in_warmup_; }
    BlockMean& spin() { return warm_ ? spin_after_ : spin_in_warmup_; }

    RunConfig config_;
    ContainerPath path_;
    Observation* observation_;
    Simulation simulation_;
    Snapshot snapshot_, dated_;
    Event event_;
    SampleTimes rotation_times_, observation_times_;
    int events_to_look_;  // until somebody looks again
    CollapseWatch watch_;
    ClusterRotation in_warmup_, after_warmup_;
    BlockMean spin_in_warmup_, spin_after_;
    std::int64_t next_question_;  // at this swirl: warm?
    bool warm_;
    const std::uint64_t events_per_sample_;
    std::uint64_t events_to_sample_;   // until the next sample of the rotation by event
    bool rotation_is_sampled_ = true;  // as it stands, if it is to be
    RunResult result_;
};

}  // namespace swirl
