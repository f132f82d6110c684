// One simulation from its seed to its averages. Everything larger (figures, sweeps, the search for
// a crossing) is made of runs.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "swirl/measure/cluster_rotation.hpp"
#include "swirl/measure/observation.hpp"
#include "swirl/physics/event.hpp"
#include "swirl/physics/snapshot.hpp"
#include "swirl/run/config.hpp"
#include "swirl/simulation/simulation.hpp"

namespace swirl {

struct RunResult {
    RunConfig config;
    bool complete = false;       // false: stopped before its end
    EventCounts events;          // all of them, warm-up included
    double periods = 0.0;        // swirls simulated, warm-up included
    std::int64_t warmup = 0;     // whole swirls left out
    EventCounts warmup_events;   // the events in them
    RotationEstimates rotation;  // in units of Ω, lab frame; by_event is the paper's average
    SteadyState steady;          // of the rotation by event, after the warm-up
    SteadyState steady_spin;     // of the mean spin of the discs, which may take much longer
    double max_overlap = 0.0;    // largest overlap met at a contact: a rounding error
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
///
/// The order, event by event: the samples that are due before it, first the observation's, then
/// those of each sampler; the event, for the observation, then for after_event; if it ends a
/// period, the observation's block is closed, and then swirl_begins is called.
struct RunControl {
    /// Set from outside (a signal) to end the run early; the result then says it is incomplete.
    const std::atomic<bool>* stop = nullptr;

    /// Called a few times a second at most.
    std::function<void(const RunProgress&)> progress;

    /// What is measured besides the rotation, from the end of the warm-up on. Must outlive the run;
    /// what it has gathered is part of the state that is kept.
    Observation* observation = nullptr;

    /// Called after every event, warm-up included, with the state just after it.
    std::function<void(const Snapshot&, const Event&)> after_event;

    /// Each looks at equal intervals, warm-up included: at the exact state at the exact times
    /// k T / per_period, or, if `interval` is above 0, k · interval.
    struct Sampler {
        int per_period;
        std::function<void(const Snapshot&)> look;
        double interval = 0.0;
    };
    std::vector<Sampler> samplers;

    /// Called at the beginning of every swirl, the first included, before anything is seen of it;
    /// `warm` says that it counts, the warm-up being over.
    std::function<void(bool warm)> swirl_begins;

    /// Asked every few hundred events, and once when the run is stopped: does the caller want to
    /// keep the state of the run?
    std::function<bool(bool stopped)> wants_state;
    /// Gets it (state_archive.hpp): a run that resumes from it goes on bit for bit, and ends with
    /// the same result.
    std::function<void(const std::string& state)> keep_state;
    /// What keep_state got, of a run with the same configuration, samplers and names of an
    /// observation that has seen nothing yet. Throws FileError if
    /// it is something else.
    std::optional<std::string> resume;
};

/// The configuration must have no problem().
RunResult run(const RunConfig& config, const RunControl& control = {});

}  // namespace swirl
