// One dish under observation, as the page shows it: between its events too, and taken up again with
// another path, other contacts, or a disc somewhere else.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "container_paths.hpp"
#include "swirl/engine/simulation.hpp"
#include "swirl/measure/cluster_rotation.hpp"
#include "swirl/measure/observation.hpp"
#include "swirl/measure/sample_times.hpp"
#include "swirl/run/config.hpp"
#include "swirl/run/core_run.hpp"

namespace swirl {

/// One dish under observation. An event is found first, by executing it: until then the state of
/// the snapshot holds, and can be looked at in between; then it is passed.
class Container {
  public:
    Container(const RunConfig& config, const InitialState& begin, std::vector<std::string> measured)
        : config_(config),
          measured_(std::move(measured)),
          observation_(config.container_radius, config.period, measured_),
          run_(endless(config), begin, measured_.empty() ? nullptr : &observation_),
          seen_(run_.stored_snapshot()),
          pinned_times_(samples_per_period, config.period) {
        run_.follow_orientations();
    }
    Container(const Container&) = delete;
    Container& operator=(const Container&) = delete;

    /// The last one that was passed.
    const Event& event() const { return passed_; }
    /// The one to come. Nothing is executed for it: hash and counts stay those of the last one.
    Event next_event() const {
        if (found_) return run_.event();
        InitialState state = without_discs(config_, path());
        for (std::uint32_t i = 0; i < simulation().size(); ++i)
            state.discs.push_back(simulation().disc(i));
        return Simulation(state, simulation().progress()).step();
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
        return found.is_known() && found.pinned()[i] != 0;
    }
    const Simulation& simulation() const { return run_.simulation(); }
    const RunConfig& config() const { return config_; }
    const ContainerPath& path() const { return run_.path(); }
    /// The names that are measured.
    const std::vector<std::string>& measured() const { return measured_; }
    const ClusterRotation& rotation_in_warmup() { return run_.rotation_in_warmup(); }
    const ClusterRotation& rotation() { return run_.rotation_after_warmup(); }
    const Observation& observation() const { return observation_; }
    std::int64_t warmup() const { return config_.warmup.value_or(default_warmup); }
    bool is_warm() const { return run_.stored_snapshot().periods >= warmup(); }

    /// As a run of the command line that ended with the last event would have it, but for the time
    /// that it took. Nothing is said of a warm-up that has not ended. No event is found beyond the
    /// last one (settle).
    RunResult result() {
        RunResult r = run_.result();
        r.config = config_;
        r.config.events = static_cast<std::int64_t>(r.events.total());
        r.complete = true;
        if (!run_.is_warm()) {
            r.rotation = {};
            r.steady = r.steady_spin = {};
        }
        return r;
    }

    /// In the words of a run of the command line, which would end here; from then on there are no
    /// more events.
    const std::optional<std::string>& problem() const { return problem_; }
    /// The same, if this is the end.
    std::optional<std::string> problem_at_the_end() const {
        return problem_ || is_by_hand(path()) ? problem_ : run_.problem_at_the_end();
    }

    void step() {
        if (find()) pass();
    }

    /// All events up to a moment, but no more than `most`; says whether it has come to that moment.
    bool advance_to(double time, std::uint32_t maximum) {
        while (find()) {
            if (time_of(run_.event()) > time) return true;
            if (maximum-- == 0) return false;
            pass();
        }
        return false;
    }

    /// The dish at a moment between the last event and the next.
    const Snapshot& seen_at(double time) {
        seen_ = run_.stored_snapshot();
        const double clock = time - static_cast<double>(seen_.periods) * config_.period;
        // The samples may have moved the snapshot on towards the next event.
        seen_.clock = std::fmin(std::fmax(passed_clock_, clock), config_.period);
        const Segment& segment = path().segment_at(seen_.clock);
        seen_.container_centre = segment.position_at(seen_.clock);
        seen_.container_velocity = segment.velocity_at(seen_.clock);
        return seen_;
    }
    /// Of the last event that was passed.
    double time() const {
        return static_cast<double>(run_.stored_snapshot().periods) * config_.period + passed_clock_;
    }

    /// What another dish begins with whose discs are where they are at this moment, as seen from
    /// the container, which is put where that dish's path begins. Velocities stay as they are: to
    /// the discs it is a corner.
    InitialState going_on(double time, const RunConfig& config, const ContainerPath& path) {
        InitialState state = without_discs(config, path);
        const Snapshot now = seen_at(time).up_to_date();
        const Segment& segment = path.segments.front();
        for (std::size_t i = 0; i < now.size(); ++i) {
            Disc disc = now.disc(i);
            disc.position = disc.position + (segment.start - now.container_centre);
            disc.time = 0.0;
            state.discs.push_back(disc);
        }
        return state;
    }

  private:
    double time_of(const Event& event) const {
        return static_cast<double>(event.periods) * config_.period + event.clock;
    }
    /// A page's dish goes on for ever, and has no length of which the warm-up could be a part.
    static RunConfig endless(RunConfig config) {
        config.events = std::numeric_limits<std::int64_t>::max();
        config.periods.reset();
        config.warmup = config.warmup.value_or(default_warmup);
        config.warmup_found = false;
        return config;
    }

    /// Finds the event to come, unless it is found; false where there is none.
    bool find() {
        if (found_) return true;
        // By hand there is no swirl to go by.
        if (!problem_ && run_.is_check_due() && !is_by_hand(path())) problem_ = run_.problem();
        if (problem_) return false;
        run_.execute_event();
        found_ = true;
        // Who is pinned is asked by who looks on, and costs more than the dish: 511 looks a swirl.
        if (!measured_.empty())
            while (run_.next_sample(pinned_times_)) pinned_.sample(run_.snapshot());
        return true;
    }
    void pass() {
        run_.pass_event();
        found_ = false;
        passed_ = run_.event();
        passed_clock_ = run_.stored_snapshot().clock;
    }

    const RunConfig config_;
    std::vector<std::string> measured_;
    Observation observation_;
    CoreRun run_;
    Snapshot seen_;
    Event passed_{};
    SampleTimes pinned_times_;
    PinnedFrames pinned_;
    bool found_ = false;
    double passed_clock_ = 0.0;  // of the last event that was passed
    std::optional<std::string> problem_;
};

}  // namespace swirl
