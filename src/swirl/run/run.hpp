// One simulation from its seed to its averages. Figures, sweeps and the search for a crossing
// consist of runs.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "swirl/measure/sample_times.hpp"
#include "swirl/physics/disc.hpp"
#include "swirl/physics/event.hpp"
#include "swirl/physics/snapshot.hpp"
#include "swirl/run/config.hpp"
#include "swirl/run/core_run.hpp"
#include "swirl/run/result.hpp"

namespace swirl {

class PeriodSeries;
class StateWriter;

struct RunProgress {
    double fraction;       // part of the run
    std::uint64_t events;  // so far
    double periods;        // so far
};

/// The discs at the end of a period, and the container's centre then.
struct FinalState {
    Vec2 container_centre{0.0, 0.0};
    std::vector<Disc> discs;

    void fields(auto&& visit) { visit(container_centre.x, container_centre.y, discs); }
};

/// Optional services during a run. None of them changes the trajectory: it stays bitwise identical.
struct RunControl {
    /// Set by the caller (a signal handler) to end the run early. The result is then incomplete.
    const std::atomic<bool>* stop = nullptr;

    /// Called at most once per `progress_interval` (run.cpp).
    std::function<void(const RunProgress&)> progress;

    /// Further measurements, from the end of the warm-up on. Must outlive the run. Its data are
    /// part of the saved state.
    Observation* observation = nullptr;

    /// Receives the averages of every period. Must outlive the run. Its data are part of the saved
    /// state; with `resume` it must be empty.
    PeriodSeries* series = nullptr;

    /// Integrate the orientation of each sphere (Snapshot::turned).
    bool orientations = false;

    /// The final state of another run of whole periods, from which this run starts instead of from
    /// random positions (study/sweep_chain.hpp). Discs keep their positions relative to the
    /// container.
    std::optional<FinalState> begin_from = {};
    /// Receives the final state of a run of whole periods when it is complete.
    FinalState* final_state = nullptr;

    /// The state() of a run with the same configuration and the same measurements. The run
    /// continues from it, bitwise identical; `observation` must be empty at that point.
    std::optional<std::string> resume;
};

/// A run that the caller advances event by event:
///
///     Run run(config);
///     SampleTimes times = run.sample_times(30);
///     while (run.next_event()) {
///         while (run.next_sample(times)) inspect(run.snapshot());   // before the event
///         run.pass_event();
///         inspect(run.event(), run.snapshot());                     // after the event
///     }
///     RunResult result = run.result();
///
/// Inspection never changes the trajectory. The services of RunControl run in next_event().
class Run {
  public:
    /// The configuration must have no problem(). Throws FileError if RunControl::resume is not the
    /// state of such a run.
    explicit Run(const RunConfig& config, RunControl control = {});

    /// Finds the next event. Returns false at the end of the run, or if `stop` is set. Throws
    /// Failure in a collapse (run/collapse.hpp).
    bool next_event();
    /// Advances the snapshot to the next of these times; false if there is none before the event.
    bool next_sample(SampleTimes& times) { return run_.next_sample(times); }
    /// Advances the snapshot to just after the event. Call it once per event.
    void pass_event() { run_.pass_event(); }

    /// Instead of both, if no event is inspected: executes events together, in the engine's loop.
    /// Returns their number; 0 where next_event() returns false. The results are bitwise identical.
    std::uint64_t execute_events();

    const Event& event() const { return run_.event(); }
    /// Spheres on a floor are synchronised, so observers can treat all velocities as constant.
    const Snapshot& snapshot() { return run_.snapshot(); }

    /// The times k T / per_period from the start of the run; or k · interval if that is above 0.
    SampleTimes sample_times(int per_period, double interval = 0.0) const {
        return {per_period, config_.period, interval};
    }

    bool complete() const { return run_.complete(); }
    /// True if the warm-up is over and averages include the present state.
    bool is_warm() const { return run_.is_warm(); }
    /// A run resumed from a shorter run has the trajectory of an uninterrupted run of the same
    /// length, but its averages may start later. Returns the reason if they would differ.
    std::optional<std::string> problem_with_length(const RunConfig& shorter) const;
    /// The result up to now.
    RunResult result();

    /// At the end of a run of whole periods, for RunControl::begin_from.
    FinalState final_state() const;

    /// For RunControl::resume; between pass_event() and next_event().
    std::string state();
    /// Writes the same into a larger state.
    void write(StateWriter& state);

  private:
    using Clock = std::chrono::steady_clock;

    double seconds() const;
    bool check_progress();
    template <class Visitor>
    void fields(Visitor&& visit);

    const RunConfig config_;
    const RunControl control_;
    CoreRun run_;
    double seconds_before_ = 0.0;  // spent by the runs that this one resumes
    Clock::time_point begin_ = Clock::now(), last_report_ = begin_;
};

/// From the beginning to the end.
RunResult run(const RunConfig& config, const RunControl& control = {});

}  // namespace swirl
