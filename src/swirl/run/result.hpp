// What a run has found, as every way to it tells it: the terminal, JSON, Python, a page.
#pragma once

#include <cstdint>

#include "swirl/engine/simulation.hpp"
#include "swirl/measure/cluster_rotation.hpp"
#include "swirl/measure/measurement_report.hpp"
#include "swirl/run/parameters.hpp"
#include "swirl/statistics/steady_state.hpp"

namespace swirl {

/// Of a result as JSON, its key `format`. Results without it are in format 1.
inline constexpr int result_format = 1;

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
    const char* simd = "";  // the vector instructions of the event loop
    double seconds = 0.0;

    /// Steady if both are; otherwise the worse of the two.
    SteadyState::Verdict steady_state() const {
        using Verdict = SteadyState::Verdict;
        for (const Verdict v :
             {Verdict::drifting, Verdict::jumping, Verdict::switching, Verdict::too_short})
            if (steady.verdict == v || steady_spin.verdict == v) return v;
        return Verdict::steady;
    }
    /// The numbers that every run has, as rows: visit(group, row). JSON, the page and the documents
    /// have them from here; a group is an object there, and what belongs to none stands beside it.
    template <class Visitor>
    void report(Visitor&& visit) const {
        const auto number = [&](const char* group, const char* name, const char* unit,
                                const char* description, double value) {
            visit(group, ReportRow{name, unit, description, {.mean = value}, {}, false});
        };
        rotation.report([&](const ReportRow& row) { visit("rotation", row); });
        number("", "events_per_rotation_sample", "1",
               "of the averages over events: 1 up to 128 discs, beyond that their number over 64",
               static_cast<double>(
                   events_per_rotation_sample(static_cast<std::size_t>(config.discs))));
        number("steady_state", "change", "1",
               "most likely change of the rotation, in standard errors", steady.change.size);
        number("steady_state", "change_limit", "1", "size that may be chance",
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
        number("steady_state", "change_of_the_spin", "1",
               "most likely change of the mean spin, in standard errors", steady_spin.change.size);
        number("steady_state", "change_limit_of_the_spin", "1", "size that may be chance",
               steady_spin.change.max_size);
        number("", "max_overlap", "r", "the largest overlap met at a contact: a rounding error",
               max_overlap);
        number("", "energy", "m v²", "kinetic energy in the lab frame at the end, spins included",
               energy);
        number("", "energy_at_start", "m v²", "the same at the beginning", energy_at_start);
        number("", "invariant", "m v²", "K − ΩL, conserved on the circle without friction",
               invariant);
        number("", "invariant_at_start", "m v²", "the same at the beginning", invariant_at_start);
    }

    bool has_whole_swirl() const { return rotation.by_event.blocks > 0; }
    double events_per_second() const {
        return seconds > 0.0 ? static_cast<double>(events.total()) / seconds : 0.0;
    }
};

}  // namespace swirl
