// How fast the cluster turns about its own centre of mass. Lab frame; positive is rotation (the
// sense of the swirl), negative is counterrotation.
//
//   individual   ϖ = (1/N) Σ_i ϖ_i,   ϖ_i = (r_i − r_cm) × (v_i − v_cm) / |r_i − r_cm|²
//                the paper's (main text, definition of ϖ, in the limit of frames infinitely close)
//   rigid        ϖ = Σ_i (r_i − r_cm) × (v_i − v_cm) / Σ_i |r_i − r_cm|²
//                the rotation of the rigid body that fits the velocities best. It weighs a disc
//                with its distance squared, so those near the centre, which make the individual
//                estimator noisy (its variance diverges, logarithmically, at |r_i − r_cm| → 0),
//                count little.
//
// r_cm is weighted with the masses; the sums over discs are not. Both are averaged twice:
//   by event     one sample after every event, as the paper's Figure 5b (SI, "Simulation
//                parameters"): busy moments weigh more than quiet ones. In a large dish one after
//                every so many (events_per_rotation_sample)
//   by time      samples at equal time steps: what a camera sees
//
// Units: results in units of Ω = 2π/T. Errors from blocks of whole periods (statistics.hpp).
// Limits: a disc on the centre of mass (closer than 2⁻⁴⁰ container radii) has no angular velocity
// about it and is left out of the individual mean; if no disc is left (one disc, all discs on one
// point) the sample is NaN, and so is a mean that contains it. No discs: NaN.
//
// A sample after every event must cost less than the event. The centre of mass is therefore not
// summed up each time: discs that collide push each other, so only the wall changes its velocity,
// by −J/M, and between two such pushes it moves uniformly. What rounding makes of that is forgotten
// at every path vertex, where it is summed up anew. (Spheres on a floor are pushed by it all the
// time; their centre of mass is summed up for every sample.) Eight discs are treated side by side,
// always with eight partial sums added up in the same order, so the bits of the result do not
// depend on the width of the processor's vectors.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "swirl/math/cpu_width.hpp"
#include "swirl/measure/cluster_rotation_kernel.hpp"
#include "swirl/measure/measurement_report.hpp"
#include "swirl/physics/event.hpp"
#include "swirl/physics/snapshot.hpp"
#include "swirl/statistics/block_average.hpp"

namespace swirl {

/// Rotation of the cluster at one instant, in radians per unit time.
struct RotationSample {
    double individual, rigid;
};

/// Both estimators for one snapshot.
/// Every width gives the same bits.
RotationSample cluster_rotation(const Snapshot& snapshot, Width width = Width::best);

/// Samples of the averages by time per swirl. Not a multiple of the paper's 30 sides, so that the
/// corners of the path are met at different phases.
inline constexpr int rotation_samples = 64;

/// A sample looks at all discs, an event at about eight. In a dish larger than any of the paper's
/// one after every event would take most of the run: 9 of 10 parts of it with 2,000 discs. Samples
/// from event to event differ by what two discs do; one after every so many has the same mean, and
/// costs as much per event as 64 discs do.
constexpr std::uint64_t events_per_rotation_sample(std::size_t discs) {
    constexpr std::size_t always_sampled = 128, looked_at_per_event = 64;
    return discs <= always_sampled ? 1 : (discs + looked_at_per_event - 1) / looked_at_per_event;
}

/// The rotation rates of a run, in the order of its report.
struct RotationRate {
    const char *name, *words;
};
inline constexpr std::array<RotationRate, 4> rotation_rates{
    {{"by_event", "mean over the discs, by event"},
     {"by_time", "mean over the discs, by time"},
     {"rigid_by_event", "rigid body, by event"},
     {"rigid_by_time", "rigid body, by time"}}};
/// What a search for N_c goes by: the mean over the discs, by time.
inline constexpr std::size_t default_rate = 1;

/// In units of Ω.
struct RotationEstimates {
    Estimate by_event, by_time, rigid_by_event, rigid_by_time;

    /// In the order of rotation_rates.
    std::array<Estimate, rotation_rates.size()> all() const {
        return {by_event, by_time, rigid_by_event, rigid_by_time};
    }

    template <class Visitor>
    void report(Visitor&& visit) const {
        visit(ReportRow{"by_event", "Ω", "rotation ϖ, averaged over events", by_event});
        visit(ReportRow{"by_time", "Ω", "rotation ϖ, averaged over time", by_time});
        visit(ReportRow{"rigid_by_event", "Ω", "of the fitted rigid body, over events",
                        rigid_by_event});
        visit(
            ReportRow{"rigid_by_time", "Ω", "of the fitted rigid body, over time", rigid_by_time});
    }
};

class ClusterRotation {
  public:
    explicit ClusterRotation(Width width = Width::best);

    /// Call after every event, with the snapshot brought up to date.
    void follow(const Snapshot& snapshot, const Event& event) {
        if (event.kind != EventKind::disc_disc && !snapshot.on_floor)
            follow_centre(snapshot, event);
    }
    /// One sample of the average by event, after an event that was followed. Whoever is in a hurry
    /// takes it just before the snapshot is brought up to date for the next event: a wide load
    /// right behind narrow stores to the same place waits for them.
    RotationSample sample(const Snapshot& snapshot);
    RotationSample sample(const Snapshot& snapshot, const Event& event) {
        follow(snapshot, event);
        return sample(snapshot);
    }
    /// One sample of the average by time: call at equal time steps.
    RotationSample sample_by_time(const Snapshot& snapshot);

    /// Call at the end of every period. What was seen since the last call becomes a block; what
    /// has not been closed does not count.
    void close_block();

    RotationEstimates estimates() const;
    /// Blocks in units of Ω: for the search for a steady state, and as a time series.
    const BlockSeries& by_event() const { return individual_by_event_; }
    const BlockSeries& by_time() const { return individual_by_time_; }
    const BlockSeries& rigid_by_event() const { return rigid_by_event_; }
    const BlockSeries& rigid_by_time() const { return rigid_by_time_; }

    /// Adds the closed blocks of an independent run.
    void merge(const ClusterRotation& other);

    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(centre_);
        visit(event_);
        visit(time_);
        visit(individual_by_event_);
        visit(individual_by_time_);
        visit(rigid_by_event_);
        visit(rigid_by_time_);
    }

  private:
    struct OpenBlock {
        double individual = 0.0, rigid = 0.0, samples = 0.0, period = not_available;

        void add(const RotationSample& sample, double snapshot_period) {
            individual += sample.individual;
            rigid += sample.rigid;
            samples += 1.0;
            period = snapshot_period;
        }
        void close_into(BlockSeries& individual_series, BlockSeries& rigid_series);
        template <class Visitor>
        void fields(Visitor&& visit) {
            visit(individual);
            visit(rigid);
            visit(samples);
            visit(period);
        }
    };

    void follow_centre(const Snapshot& snapshot, const Event& event);

    const RotationKernel* kernel_;  // for this processor's vectors
    RotationCentre centre_{};       // as the wall left it, or the last vertex of the path
    OpenBlock event_, time_;
    BlockSeries individual_by_event_, individual_by_time_, rigid_by_event_, rigid_by_time_;
};

}  // namespace swirl
