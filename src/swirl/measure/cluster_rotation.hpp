// How fast the cluster rotates about its own centre of mass. Lab frame. Averages are positive with
// the swirl and negative for counterrotation, in a clockwise dish, too; a RotationSample is
// counter-clockwise.
//
//   individual   ϖ = (1/N) Σ_i ϖ_i,   ϖ_i = (r_i − r_cm) × (v_i − v_cm) / |r_i − r_cm|²
//                the paper's (main text, definition of ϖ, in the limit of frames infinitely close)
//   rigid        ϖ = Σ_i (r_i − r_cm) × (v_i − v_cm) / Σ_i |r_i − r_cm|²
//                the rotation of the rigid body that fits the velocities best. It weights a disc
//                with its distance squared, so discs near the centre count little. They make the
//                individual estimator noisy: its variance diverges, logarithmically, at
//                |r_i − r_cm| → 0
//
// r_cm is weighted with the masses; the sums over discs are not. Both are averaged in two ways:
//
//   by event     equal weight for every event, as in the paper's Figure 5b (SI, "Simulation
//                parameters"): busy moments weigh more than quiet ones. If a period has many
//                events, there is one sample per several (events_per_rotation_sample)
//   by time      samples at equal time steps, as a camera takes them. In runs of few discs the
//                exact mean of the individual rates replaces theirs: ∫ϖ_i dt is the change of
//                the polar angle of disc i about the centre of mass (swept_angles.hpp)
//
// Units: results in units of Ω = 2π/T. Errors: from blocks of whole periods (block_average.hpp).
// Limits: a disc on the centre of mass (closer than 2⁻⁴⁰ container radii) has no angular velocity
// about it and is omitted from the individual mean. If no disc is left (one disc, all discs at one
// point) the sample is NaN, and so is a mean that contains it. No discs: NaN.
//
// A sample after every event must cost less than the event. So the centre of mass is then not
// summed up for every sample, but followed (rotation_follower.hpp). At every path vertex it is
// summed up again, which removes the accumulated rounding; with exact means by time, once per
// period. (A floor accelerates spheres all the time; there the centre of mass is summed up for
// every sample.) Eight discs are processed in parallel, always with eight partial
// sums added in the same order. So the result does not depend on the vector width of the processor.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <tuple>

#include "swirl/math/cpu_width.hpp"
#include "swirl/measure/cluster_rotation_kernel.hpp"
#include "swirl/measure/measurement_report.hpp"
#include "swirl/measure/quantities.hpp"
#include "swirl/measure/swept_angles.hpp"
#include "swirl/physics/event.hpp"
#include "swirl/physics/rotation_follower.hpp"
#include "swirl/physics/snapshot.hpp"
#include "swirl/statistics/block_average.hpp"

namespace swirl {

/// Rotation of the cluster at one instant, in radians per unit time.
struct RotationSample {
    double individual, rigid;
};

inline RotationColumns rotation_columns(const Snapshot& s) {
    RotationColumns columns{s.x.data(), s.y.data(), s.vx.data(), s.vy.data(), s.held_at.data()};
    if (!s.are_spheres()) return columns;
    columns.ax = s.ax.data();
    columns.ay = s.ay.data();
    return columns;
}

/// Both estimators for one snapshot; bitwise the same for every width.
RotationSample cluster_rotation(const Snapshot& snapshot, Width width = Width::best);

/// Samples per period of the averages by time. Not a multiple of the paper's 30 sides, so that
/// samples fall on different phases of a side.
inline constexpr int rotation_samples = 64;
/// If every event is followed and a period has fewer than `events_of_exact_means`, its individual
/// mean is exact. Samples by time remain for the rigid body and the spins, whose errors need no
/// more. With more events, following them costs more than 64 samples.
inline constexpr std::uint64_t events_of_exact_means = 384;
inline constexpr int rotation_samples_of_few = 16;

/// Averages by event take about `samples` per period, and one after every event if a period
/// has fewer than `few_events`. Consecutive samples differ by the change of two discs, so a sample
/// after every k-th event has the same mean and hardly a larger error. In loose clusters, which
/// have few events, a disc sometimes flies past the centre of mass. These rare samples decide about
/// the error, and none is omitted: with every fourth, it grows by 5 % at N = 28.
struct RotationSamplesByEvent {
    static constexpr std::uint64_t samples = 128, few_events = 2048;
};

/// k in the first period. A sample reads all discs, an event about eight. The more discs, the less
/// one that flies past the centre of mass counts, and the fewer samples the mean needs.
constexpr std::uint64_t events_per_rotation_sample(std::size_t discs) {
    constexpr std::size_t always_sampled = 128, many = 500;
    const std::size_t read_per_event = discs < many ? 4 : 2;
    return discs <= always_sampled ? 1 : (discs + read_per_event - 1) / read_per_event;
}
/// k in a period that follows one with this number of events.
constexpr std::uint64_t events_per_rotation_sample(std::size_t discs, std::uint64_t events) {
    const bool few = events < RotationSamplesByEvent::few_events;
    return std::max(events_per_rotation_sample(discs),
                    few ? 1 : events / RotationSamplesByEvent::samples);
}

/// The rotation rates of a run, in the order of its report.
struct RotationRate {
    const char *name, *description;
};
inline constexpr std::array<RotationRate, 4> rotation_rates{
    {{"mean_by_event", "mean over the discs, by event"},
     {"mean_by_time", "mean over the discs, by time"},
     {"rigid_by_event", "rigid body, by event"},
     {"rigid_by_time", "rigid body, by time"}}};
/// Index of the rate that a search for N_c uses: the mean over the discs, by time.
inline constexpr std::size_t default_rate = 1;

/// In units of Ω.
struct RotationEstimates {
    Estimate mean_by_event, mean_by_time, rigid_by_event, rigid_by_time;

    /// In the order of rotation_rates.
    std::array<Estimate, rotation_rates.size()> all() const {
        return {mean_by_event, mean_by_time, rigid_by_event, rigid_by_time};
    }

    template <class Visitor>
    void report(Visitor&& visit) const {
        visit(ReportRow{quantity("rotation.mean_by_event"), mean_by_event});
        visit(ReportRow{quantity("rotation.mean_by_time"), mean_by_time});
        visit(ReportRow{quantity("rotation.rigid_by_event"), rigid_by_event});
        visit(ReportRow{quantity("rotation.rigid_by_time"), rigid_by_time});
    }
};

/// With errors for few blocks (few_blocks.hpp).
inline RotationEstimates corrected(RotationEstimates e) {
    for (Estimate* const rate :
         {&e.mean_by_event, &e.mean_by_time, &e.rigid_by_event, &e.rigid_by_time})
        *rate = corrected(*rate);
    return e;
}

class ClusterRotation : public MergedAverages<ClusterRotation> {
  public:
    static auto averages(auto& s) {
        return std::tie(s.individual_by_event_, s.individual_by_time_, s.rigid_by_event_,
                        s.rigid_by_time_);
    }

    /// `clockwise`: the direction of the swirl in the snapshots to come.
    explicit ClusterRotation(Width width = Width::best, bool clockwise = false);

    /// Call after every event, with the snapshot brought up to date. An event loop can do that, and
    /// sample, by itself (follower()).
    void follow(const Snapshot& snapshot, const Event& event) {
        follower(snapshot).follow(rotation_columns(snapshot), event, snapshot.clock,
                                  snapshot.periods > event.periods);
    }
    /// From a time between two events on, the individual mean by time is exact; follow() must be
    /// called after every event up to end_angles(). Only for discs, whose flights are straight.
    void begin_angles(const Snapshot& snapshot);
    /// Before close_block(): replaces the individual samples by time by the mean since
    /// begin_angles().
    void end_angles(const Snapshot& snapshot);
    bool follows_angles(const Snapshot& snapshot) const {
        return angles_.are_followed(snapshot.size());
    }
    /// One sample of the average by event, after an event passed to follow(). It is fastest just
    /// before the snapshot is updated for the next event: a wide load waits for narrow stores to
    /// the same address that came shortly before.
    RotationSample sample(const Snapshot& snapshot) {
        return in_words(follower(snapshot).sample(rotation_columns(snapshot), snapshot.clock));
    }
    RotationSample sample(const Snapshot& snapshot, const Event& event) {
        follow(snapshot, event);
        return sample(snapshot);
    }
    /// One sample of the average by time; call it at equal time steps, or with weights.
    RotationSample sample_by_time(const Snapshot& snapshot, double weight = 1.0) {
        return in_words(
            follower(snapshot).sample_by_time(rotation_columns(snapshot), snapshot.clock, weight));
    }
    /// Sums up the centre of mass, because the discs were moved.
    void renew_centre(const Snapshot& snapshot);
    /// For an event loop that follows and samples by itself the discs of which this is a snapshot.
    /// It is valid until one of the functions here is called.
    RotationFollower follower(const Snapshot& snapshot);

    /// Call at the end of every period. The samples since the last call become a block; an open
    /// block does not count. Blocks by event are weighted with their events, and blocks by time
    /// with their samples, each of which counts `weight_by_time`.
    void close_block(std::uint64_t events_of_a_sample = 1, double weight_by_time = 1.0);

    /// The means over the samples since the last close_block(), in units of Ω, in the order of
    /// rotation_rates.
    std::array<double, rotation_rates.size()> open_means() const;
    /// What they count, with the arguments of close_block().
    std::array<double, rotation_rates.size()> open_weights(std::uint64_t events_of_a_sample,
                                                           double weight_by_time) const;

    RotationEstimates estimates() const;
    /// Blocks in units of Ω, for the test of the steady state and as time series.
    const BlockSeries& mean_by_event() const { return individual_by_event_; }
    const BlockSeries& mean_by_time() const { return individual_by_time_; }
    const BlockSeries& rigid_by_event() const { return rigid_by_event_; }
    const BlockSeries& rigid_by_time() const { return rigid_by_time_; }

    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(centre_, event_, time_, angles_);
        this->visit_averages(visit);
    }

  private:
    struct OpenBlock : RotationSums {
        double period = not_available;  // its sign is − if the swirl is clockwise

        void close_into(BlockSeries& individual_series, BlockSeries& rigid_series,
                        double weight_of_a_sample);
        template <class Visitor>
        void fields(Visitor&& visit) {
            visit(individual, rigid, samples, period);
        }
    };

    static RotationSample in_words(const RotationRates& rates) { return {rates[0], rates[1]}; }

    const RotationKernel* kernel_;  // fits this processor's vector width
    double swirl_sign_;             // 1, or −1 if the swirl is clockwise
    RotationCentre centre_{};       // value after the last wall impulse or path vertex
    SweptAngles angles_;
    OpenBlock event_, time_;
    BlockSeries individual_by_event_, individual_by_time_, rigid_by_event_, rigid_by_time_;
};

}  // namespace swirl
