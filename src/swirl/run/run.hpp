// One simulation from its seed to its averages. Everything larger (figures, sweeps, the search for
// a crossing) is made of runs.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "swirl/measure/sample_times.hpp"
#include "swirl/physics/event.hpp"
#include "swirl/physics/snapshot.hpp"
#include "swirl/run/config.hpp"
#include "swirl/run/core_run.hpp"
#include "swirl/run/result.hpp"

namespace swirl {

class StateWriter;

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
    bool next_sample(SampleTimes& times) { return run_.next_sample(times); }
    /// Puts the snapshot behind the event; once for each.
    void pass_event() { run_.pass_event(); }

    const Event& event() const { return run_.event(); }
    /// Spheres brought up to date: an observer may take it that nobody is accelerated.
    const Snapshot& snapshot() { return run_.snapshot(); }

    /// k T / per_period from the beginning on; or k · interval, if that is above 0.
    SampleTimes sample_times(int per_period, double interval = 0.0) const {
        return {per_period, config_.period, interval};
    }

    bool complete() const { return run_.complete(); }
    /// Whether the warm-up is over, and what is seen counts.
    bool is_warm() const { return run_.is_warm(); }
    /// A run that goes on from the state of a shorter one has the bits of a run that was as long
    /// from the beginning, but not always its averages: says what they would lack.
    std::optional<std::string> problem_with_length(const RunConfig& shorter) const;
    /// Of the run as far as it has come.
    RunResult result();

    /// For RunControl::resume; between pass_event() and next_event().
    std::string state();
    /// The same, in its place among what else is kept of the run.
    void write(StateWriter& state);

  private:
    using Clock = std::chrono::steady_clock;

    double seconds() const;
    bool look_up();
    template <class Visitor>
    void fields(Visitor&& visit);

    const RunConfig config_;
    const RunControl control_;
    BareRun run_;
    double seconds_before_ = 0.0;  // by the runs that this one resumes
    Clock::time_point begin_ = Clock::now(), last_report_ = begin_;
};

/// From the beginning to the end.
RunResult run(const RunConfig& config, const RunControl& control = {});

}  // namespace swirl
