// The result of a run, as reported in the terminal, in JSON, in Python and on the page.
#pragma once

#include <cstdint>
#include <string>

#include "swirl/engine/simulation.hpp"
#include "swirl/measure/cluster_rotation.hpp"
#include "swirl/measure/measurement_report.hpp"
#include "swirl/measure/quantities.hpp"
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
    /// In units of Ω, in the lab frame, over whole periods; mean_by_event is the paper's average.
    /// All values are NaN if there is no whole period after the warm-up.
    RotationEstimates rotation;
    std::uint64_t events_per_rotation_sample = 1;  // value of the last period
    SteadyState steady;        // test of the rotation by event, after the warm-up
    SteadyState steady_spin;   // test of the mean spin, which may relax much more slowly
    double max_overlap = 0.0;  // largest overlap at a contact: a rounding error; unit r
    /// Kinetic energy in the lab frame, including spins, at the start and at the end; unit m v².
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
        const auto number = [&](const Quantity& its_quantity, double value) {
            visit(std::string(its_quantity.group()), number_row(its_quantity, value));
        };
        rotation.report([&](const ReportRow& row) { visit("rotation", row); });
        number(quantity("events_per_rotation_sample"),
               static_cast<double>(events_per_rotation_sample));
        number(quantity("steady_state.change"), steady.change.size);
        number(quantity("steady_state.change_limit"), steady.change.max_size);
        number(quantity("steady_state.change_period"), steady.period);
        number(quantity("steady_state.change_before"), steady.change.before);
        number(quantity("steady_state.change_after"), steady.change.after);
        const TwoStates states = steady.states.found() ? steady.states : TwoStates{};
        number(quantity("steady_state.low_state"), states.low);
        number(quantity("steady_state.high_state"), states.high);
        number(quantity("steady_state.switches"), static_cast<double>(states.changes));
        number(quantity("steady_state.spin_change"), steady_spin.change.size);
        number(quantity("steady_state.spin_change_limit"), steady_spin.change.max_size);
        number(quantity("max_overlap"), max_overlap);
        number(quantity("energy"), energy);
        number(quantity("energy_at_start"), energy_at_start);
        number(quantity("invariant"), invariant);
        number(quantity("invariant_at_start"), invariant_at_start);
    }

    bool has_whole_period() const { return rotation.mean_by_event.blocks > 0; }
    double events_per_second() const {
        return seconds > 0.0 ? static_cast<double>(events.total()) / seconds : 0.0;
    }
};

}  // namespace swirl
