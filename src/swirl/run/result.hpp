// The result of a run, as reported in the terminal, in JSON, in Python and on the page.
#pragma once

#include <cstdint>

#include "swirl/engine/simulation.hpp"
#include "swirl/measure/cluster_rotation.hpp"
#include "swirl/measure/measurement_report.hpp"
#include "swirl/run/parameters.hpp"
#include "swirl/statistics/steady_state.hpp"

namespace swirl {

/// The key `format` of a result in JSON. Results without this key are in format 1.
inline constexpr int result_format = 2;

struct RunResult {
    RunConfig config;
    bool complete = false;      // false: stopped early
    EventCounts events;         // including the warm-up
    double periods = 0.0;       // including the warm-up
    std::int64_t warmup = 0;    // whole periods excluded from the averages
    EventCounts warmup_events;  // events in the warm-up
    /// In units of Ω, in the lab frame, over whole periods; mean_by_event is the paper's average. All
    /// values are NaN if there is no whole period after the warm-up.
    RotationEstimates rotation;
    std::uint64_t events_per_rotation_sample = 1;  // value of the last period
    SteadyState steady;        // test of the rotation by event, after the warm-up
    SteadyState steady_spin;   // test of the mean spin, which may relax much more slowly
    double max_overlap = 0.0;  // largest overlap at a contact: a rounding error
    /// Kinetic energy in the lab frame, including spins, at the start and at the end.
    double energy_at_start = 0.0, energy = 0.0;
    /// K − ΩL (run/budget.hpp).
    double invariant_at_start = 0.0, invariant = 0.0;
    std::uint64_t state_hash = 0;
    const char* simd = "";  // vector instructions of the event loop
    double seconds = 0.0;

    /// Steady if rotation and spin are; otherwise the worse of the two verdicts.
    SteadyState::Verdict steady_state() const {
        using Verdict = SteadyState::Verdict;
        for (const Verdict v :
             {Verdict::drifting, Verdict::jumping, Verdict::switching, Verdict::too_short})
            if (steady.verdict == v || steady_spin.verdict == v) return v;
        return Verdict::steady;
    }
    /// Calls visit(group, row) for every number that each run has. JSON, the page and
    /// docs/reference/measurements.md use it; a group is an object in JSON, rows without group are
    /// plain keys.
    void report(auto&& visit) const {
        const auto number = [&](const char* group, const char* name, const char* unit,
                                const char* description, double value) {
            visit(group, ReportRow{name, unit, description, {.mean = value}, {}, false});
        };
        rotation.report([&](const ReportRow& row) { visit("rotation", row); });
        number("", "events_per_rotation_sample", "1", "of averages by event, in the last period",
               static_cast<double>(events_per_rotation_sample));
        number("steady_state", "change", "1",
               "most likely change of the rotation, in standard errors", steady.change.size);
        number("steady_state", "change_limit", "1", "limit of a change that may be random",
               steady.change.max_size);
        number("steady_state", "change_period", "1", "period at which the rotation changes",
               steady.period);
        number("steady_state", "change_before", "Ω", "rotation before the change",
               steady.change.before);
        number("steady_state", "change_after", "Ω", "rotation after the change",
               steady.change.after);
        const TwoStates states = steady.states.found() ? steady.states : TwoStates{};
        number("steady_state", "low_state", "Ω", "rotation in the lower of two states", states.low);
        number("steady_state", "high_state", "Ω", "rotation in the higher of two states",
               states.high);
        number("steady_state", "switches", "1", "changes between the two states",
               static_cast<double>(states.changes));
        number("steady_state", "spin_change", "1",
               "most likely change of the mean spin, in standard errors", steady_spin.change.size);
        number("steady_state", "spin_change_limit", "1", "limit of a change that may be random",
               steady_spin.change.max_size);
        number("", "max_overlap", "r", "largest overlap at a contact: a rounding error",
               max_overlap);
        number("", "energy", "m v²", "kinetic energy in the lab frame at the end, including spins",
               energy);
        number("", "energy_at_start", "m v²", "kinetic energy at the start", energy_at_start);
        number("", "invariant", "m v²", "K − ΩL, conserved on the circle without friction",
               invariant);
        number("", "invariant_at_start", "m v²", "K − ΩL at the start", invariant_at_start);
    }

    bool has_whole_period() const { return rotation.mean_by_event.blocks > 0; }
    double events_per_second() const {
        return seconds > 0.0 ? static_cast<double>(events.total()) / seconds : 0.0;
    }
};

}  // namespace swirl
