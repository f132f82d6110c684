// One dish under observation, as the page shows it: between its events too, and taken up again with
// another path, other contacts, or a disc somewhere else.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "container_paths.hpp"
#include "swirl/measure/cluster_rotation.hpp"
#include "swirl/measure/observation.hpp"
#include "swirl/measure/sample_times.hpp"
#include "swirl/run/budget.hpp"
#include "swirl/run/config.hpp"
#include "swirl/run/run.hpp"
#include "swirl/simulation/simulation.hpp"

namespace swirl {

/// One dish under observation. An event is found first, by executing it: until then the state of
/// the snapshot holds, and can be looked at in between; then it is passed.
class Dish {
  public:
    Dish(const RunConfig& config, const InitialState& begin, std::vector<std::string> measured)
        : config_(config),
          path_(begin.path),
          simulation_(begin),
          snapshot_(simulation_.snapshot()),
          seen_(snapshot_),
          rotation_times_(rotation_samples, config.period),
          observation_times_(samples_per_period, config.period),
          measured_(std::move(measured)),
          observation_(config.container_radius, config.period, measured_),
          at_start_(budget_of(observed())) {
        if (snapshot_.are_balls()) snapshot_.turned.assign(snapshot_.size(), {});
    }

    /// The last one that was passed.
    const Event& event() const { return passed_; }
    /// The one to come. Nothing is executed for it: hash and counts stay those of the last one.
    Event next_event() const {
        if (found_) return event_;
        InitialState state = without_discs(config_, path_);
        for (std::uint32_t i = 0; i < snapshot_.size(); ++i)
            state.discs.push_back(simulation_.disc(i));
        return Simulation(state, simulation_.progress()).step();
    }
    /// An event that was found is passed, so that averages, counts and state are of the same
    /// moment.
    void settle() {
        if (found_) pass();
    }
    /// Of each disc, by the paper's criterion, some frames ago; none in the first frames, and none
    /// where nothing is measured.
    bool is_pinned(std::size_t i) const {
        const PinnedLoose& found = pinned_.pinned_loose();
        return found.knows() && found.pinned()[i] != 0;
    }
    const Simulation& simulation() const { return simulation_; }
    const RunConfig& config() const { return config_; }
    const ContainerPath& path() const { return path_; }
    /// The names that are measured.
    const std::vector<std::string>& measured() const { return measured_; }
    const ClusterRotation& in_warmup() const { return in_warmup_; }
    const ClusterRotation& rotation() const { return rotation_; }
    const Observation& observation() const { return observation_; }
    std::int64_t warmup() const { return config_.warmup.value_or(default_warmup); }

    /// As a run of the command line that ended with the last event would have it, but for the time
    /// that it took. None is found beyond that one (settle).
    RunResult result() {
        RunResult r;
        r.config = config_;
        r.events = simulation_.events();
        r.config.events = static_cast<std::int64_t>(r.events.total());
        r.complete = true;
        r.periods = periods();
        r.warmup = left_out_;
        r.warmup_events = left_out_events_;
        r.rotation = rotation_.estimates();
        r.steady = find_steady_state(rotation_.by_event().block_means());
        r.steady_spin = find_steady_state(spin_.series().block_means());
        r.max_overlap = max_overlap_;
        const Budget end = budget_of(observed());
        r.energy_at_start = at_start_.energy;
        r.invariant_at_start = at_start_.invariant;
        r.energy = end.energy;
        r.invariant = end.invariant;
        r.state_hash = simulation_.state_hash();
        return r;
    }

    void step() {
        if (!found_) find();
        pass();
    }

    /// All events up to a moment, but no more than `most`; says whether it has come to that moment.
    bool advance_to(double time, std::uint32_t most) {
        for (;;) {
            if (!found_) find();
            if (time_of(event_) > time) return true;
            if (most-- == 0) return false;
            pass();
        }
    }

    /// The dish at a moment between the last event and the next.
    const Snapshot& seen_at(double time) {
        seen_ = snapshot_;
        const double clock = time - static_cast<double>(seen_.swirls) * config_.period;
        // The samples may have moved the snapshot on towards the next event.
        seen_.clock = std::fmin(std::fmax(passed_clock_, clock), config_.period);
        const Leg& leg = path_.leg_at(seen_.clock);
        seen_.container_centre = leg.position_at(seen_.clock);
        seen_.container_velocity = leg.velocity_at(seen_.clock);
        return seen_;
    }
    /// Of the last event that was passed.
    double time() const {
        return static_cast<double>(snapshot_.swirls) * config_.period + passed_clock_;
    }

    double periods() const {
        return static_cast<double>(snapshot_.swirls) + passed_clock_ / config_.period;
    }

    /// What another dish begins with whose discs are where they are at this moment, as seen from
    /// the container, which is put where that dish's path begins. Velocities stay as they are: to
    /// the discs it is a corner.
    InitialState going_on(double time, const RunConfig& config, const ContainerPath& path) {
        InitialState state = without_discs(config, path);
        const Snapshot now = seen_at(time).up_to_date();
        const Leg& leg = path.legs.front();
        for (std::size_t i = 0; i < now.size(); ++i) {
            Disc disc = now.disc(i);
            disc.position = disc.position + (leg.start - now.container_centre);
            disc.time = 0.0;
            state.discs.push_back(disc);
        }
        return state;
    }

  private:
    double time_of(const Event& event) const {
        return static_cast<double>(event.swirls) * config_.period + event.clock;
    }
    /// Spheres brought up to date, as a run shows them: an observer takes it that nobody is
    /// accelerated.
    const Snapshot& observed() {
        if (!snapshot_.are_spheres()) return snapshot_;
        snapshot_.up_to_date(dated_);
        return dated_;
    }
    bool counts() const { return snapshot_.swirls >= warmup(); }
    ClusterRotation& rotation_now() { return counts() ? rotation_ : in_warmup_; }

    void find() {
        event_ = simulation_.step();
        found_ = true;
        while (rotation_times_.next(snapshot_, path_, event_.clock)) {
            rotation_now().sample_by_time(snapshot_);
            if (counts()) spin_.add(mean_spin(snapshot_));
        }
        // Who is pinned is asked by who looks on, and costs more than the dish: 511 looks a swirl.
        if (measured_.empty()) return;
        const bool watched = observes();
        while (observation_times_.next(snapshot_, path_, event_.clock)) {
            const Snapshot& now = observed();
            pinned_.sample(now);
            if (watched) observation_.sample(now);
        }
    }
    void pass() {
        found_ = false;
        passed_ = event_;
        ClusterRotation& rotation = rotation_now();
        const bool watched = observes();
        simulation_.refresh(snapshot_, event_);
        passed_clock_ = snapshot_.clock;
        rotation.follow(snapshot_, event_);
        rotation.sample(snapshot_);
        max_overlap_ = std::max(max_overlap_, event_.overlap);
        if (watched) observation_.sample(event_, observed());
        if (snapshot_.swirls == event_.swirls) return;
        if (&rotation == &rotation_) spin_.close_block();
        rotation.close_block();
        if (watched) observation_.close_block();
        if (snapshot_.swirls != warmup()) return;
        left_out_ = warmup();
        left_out_events_ = simulation_.events();
    }
    bool observes() const { return counts() && !observation_.empty(); }

    const RunConfig config_;
    const ContainerPath path_;
    Simulation simulation_;
    Snapshot snapshot_, seen_, dated_;
    Event event_{}, passed_{};
    PinnedFrames pinned_;
    bool found_ = false;
    double passed_clock_ = 0.0;  // of the last event that was passed
    /// What no average has seen: nothing is said of it before it has ended.
    std::int64_t left_out_ = 0;  // swirls
    EventCounts left_out_events_;
    SampleTimes rotation_times_, observation_times_;
    ClusterRotation in_warmup_, rotation_;
    std::vector<std::string> measured_;
    Observation observation_;
    BlockMean spin_;  // of the discs, after the warm-up
    double max_overlap_ = 0.0;
    Budget at_start_;
};

}  // namespace swirl
