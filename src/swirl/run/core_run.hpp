// One simulation with its measurements, from the first event to the result. It does no I/O, has no
// clock and throws no exceptions, and it does not decide when to stop. `Run` adds these for a
// program. The browser page, which has none of them, uses this class directly (bindings/wasm).
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>

#include "swirl/engine/simulation.hpp"
#include "swirl/measure/cluster_rotation.hpp"
#include "swirl/measure/event_states.hpp"
#include "swirl/measure/sample_times.hpp"
#include "swirl/physics/event.hpp"
#include "swirl/physics/snapshot.hpp"
#include "swirl/run/collapse.hpp"
#include "swirl/run/config.hpp"
#include "swirl/run/event_interval.hpp"
#include "swirl/run/ramp_schedule.hpp"
#include "swirl/run/result.hpp"
#include "swirl/run/run_observer.hpp"
#include "swirl/run/run_series.hpp"
#include "swirl/run/warm_up.hpp"

namespace swirl {

/// Event by event:
///
///     for (;;) {
///         if (run.is_check_due() && (run.complete() || run.problem())) break;
///         run.execute_event();
///         run.pass_event();
///     }
class CoreRun {
  public:
    /// `observer` measures from the end of the warm-up on. Null: only the rotation is measured.
    /// `begin` is in the surroundings of its period (ramp.hpp).
    CoreRun(const RunConfig& config, const InitialState& begin, RunObserver observer = nullptr,
            const Progress& progress = {}, const Tuning& tuning = {});
    /// Also adds every period to a series, which must outlive the run. Call it before the first
    /// event.
    void add_periods_to(FollowsPeriods* series) { series_.set(series); }

    /// Executes the next event. The snapshot keeps the state before it until pass_event().
    void execute_event();
    /// Executes and passes events together in the engine's loop until the period ends, or a sample
    /// of a measurement or a check is due; or the next event alone if each must be handed over. The
    /// results are bitwise those of execute_event() and pass_event(), but event() is not set.
    /// Returns the number of events.
    std::uint64_t execute_events();
    /// Moves the snapshot to the next of these sample times, if there is one before the event.
    bool next_sample(SampleTimes& times) { return times.next(snapshot_, path(), event_.clock); }
    /// Moves the snapshot to the state after the event. Call it once for each event.
    void pass_event();

    const Event& event() const { return event_; }
    /// For spheres, all states are moved to the snapshot's clock, so that observers need no
    /// accelerations.
    const Snapshot& snapshot() {
        update_snapshot();
        if (!snapshot_.are_spheres()) return snapshot_;
        snapshot_.up_to_date(synchronised_);
        return synchronised_;
    }
    /// The snapshot as the simulation stores it: each disc at its own time. After pass_event().
    const Snapshot& stored_snapshot() const { return snapshot_; }
    const Simulation& simulation() const { return simulation_; }
    const ContainerPath& path() const { return ramps_.path(); }
    /// Tracks the orientation of each sphere (Snapshot::turned). Call it before the first event.
    void follow_orientations() {
        if (snapshot_.are_spheres()) snapshot_.turned.assign(snapshot_.size(), {});
    }

    bool complete() const;
    /// Completed fraction of the run, 0 … 1.
    double fraction() const;
    double periods() const;
    /// True if the warm-up is over, so that samples count.
    bool is_warm() const { return warm_up_.is_over; }
    /// Whole periods and events of the warm-up; 0 before it is over.
    std::int64_t warmup() const { return result_.warmup; }
    const EventCounts& warmup_events() const { return result_.warmup_events; }

    /// Call it once before each event: whether it is time for the checks between events, such as
    /// complete() and problem(). It is always true when the run is complete.
    bool is_check_due() {
        if (events_to_check_ > 0) {
            --events_to_check_;
            return false;
        }
        events_to_check_ = std::max(events_until_check() - 1, 0);
        return true;
    }
    /// Why the run cannot continue: rounding errors have become too large, or a
    /// collapse has occurred. Empty if there is no problem.
    std::optional<Message> problem();
    /// Like problem(), but only for the last events of the run.
    std::optional<Message> problem_at_the_end() const;

    /// Separate from the rotation after the warm-up. A run too short for a warm-up reports it.
    const ClusterRotation& rotation_in_warmup() const { return warm_up_.rotation_before; }
    const ClusterRotation& rotation_after_warmup() const { return warm_up_.rotation_after; }
    /// The result up to now, without the elapsed time. Call it between two events.
    RunResult result();

    /// The sums and counters of the run, for checkpoints. Progress and disc states are saved by
    /// Run, and the observation's state by its owner.
    void fields(auto&& visit) {
        visit(warm_up_.is_over, rotation_times_, few_rotation_times_);
        visit(warm_up_.rotation_before, warm_up_.rotation_after);
        visit(result_.warmup, result_.warmup_events, result_.max_overlap);
        visit(result_.energy_at_start, result_.invariant_at_start);
        visit(warm_up_.spin_before, warm_up_.spin_after, warm_up_.next_test);
        by_event_.fields(visit);
        if (!config_.ramps.empty()) visit(snapshot_.periods_at_change, snapshot_.time_at_change);
        if (!snapshot_.turned.empty()) visit(std::span(snapshot_.turned));
        if (observer_.exists()) visit(observation_times_);
    }

  private:
    bool observes() const { return is_warm() && observer_.exists(); }
    bool samples_observations() const;
    bool observes_events() const;
    RunMark mark() const { return {simulation_.events().total(), periods()}; }
    int events_until_check() const;
    std::optional<Message> overlap_problem() const;
    bool hands_over_events() const;
    std::uint64_t execute(std::uint64_t maximum, Event* last);
    SampleTimes& rotation_times();
    RotationSampling rotation_sampling();
    /// What measurements see: a clockwise dish in its mirror image.
    const Snapshot& observed();
    EventStates states_after_event();
    void pass_to_measurements();
    void update_flights();
    void update_snapshot();
    void sample_series(double clock);
    void sample_observations(double clock);
    void begin_angles(std::uint64_t events);
    bool follows_angles() { return rotation().follows_angles(snapshot_); }
    void begin_period();
    SteadyState steady_state_of(const BlockSeries& series) const;
    ClusterRotation& rotation() { return warm_up_.rotation(); }

    RunConfig config_;
    RunObserver observer_;
    RunSeries series_;
    const Tuning tuning_;
    Simulation simulation_;
    RampSchedule ramps_;
    Snapshot snapshot_, synchronised_, mirrored_;
    Event event_;
    SampleTimes rotation_times_, few_rotation_times_, observation_times_;
    EventInterval by_event_;  // the rotation is sampled after as many events
    WarmUp warm_up_;
    int events_to_check_;  // number of events until the next check
    CollapseWatch watch_;
    EventSpan span_;               // the events since the snapshot was updated
    bool angles_are_old_ = false;  // the snapshot lacks the angles of these events
    RunResult result_;
};

}  // namespace swirl
