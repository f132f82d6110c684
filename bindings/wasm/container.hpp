// The simulation as the page shows it: also at times between events. It can be continued with
// another path, other contact parameters, or a moved disc.
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
#include "page_measurements.hpp"
#include "spin_map.hpp"
#include "swirl/engine/simulation.hpp"
#include "swirl/measure/cluster_rotation.hpp"
#include "swirl/measure/sample_times.hpp"
#include "swirl/measure/slip.hpp"
#include "swirl/measure/spin_frustration.hpp"
#include "swirl/run/config.hpp"
#include "swirl/run/core_run.hpp"

namespace swirl {

/// A collision for the drawing of contacts.
struct ContactMark {
    double time;
    std::uint32_t i, j;  // equal for a contact with the wall
    bool sticks;
};

/// The rotation of the cluster, or of a single disc about itself: a pancake.
inline RotationSample rotation_of(const Snapshot& s) {
    if (s.size() == 1) return {s.spin[0], s.spin[0]};
    const RotationSample rate = cluster_rotation(s);
    return std::isfinite(rate.individual + rate.rigid) ? rate : RotationSample{0.0, 0.0};
}

/// A simulated container with its measurements. An event is found by executing it. At first
/// the snapshot still holds the state before it, for frames in between. When the event is passed,
/// the snapshot gets the state after it.
class Container {
  public:
    Container(const RunConfig& config, const InitialState& begin, std::vector<std::string> measured)
        : config_(config),
          measured_(std::move(measured)),
          observation_(dish_of(config), measured_),
          run_(endless(config), begin, measured_.empty() ? nullptr : &observation_),
          shown_(run_.stored_snapshot()),
          turned_times_(rotation_samples, config.period),
          map_times_(samples_per_period, config.period),
          cause_times_(8, config.period),  // the rate of Slip and SpinFrustration elsewhere
          spins_(config.container_radius) {
        run_.follow_orientations();
    }
    Container(const Container&) = delete;
    Container& operator=(const Container&) = delete;

    /// Passes an event that was found, so that averages, counts and state belong to the same time.
    void pass_found_event() {
        if (found_) pass();
    }
    /// Maps, profile and pinned criterion take 511 samples per period, which cost several times the
    /// simulation. They are taken only while they are shown, from the next period on.
    void show_maps(bool shown) {
        if (shown && !maps_)
            maps_.emplace(dish_of(config_), std::vector<std::string>{"density", "flow", "profile"});
        if (shown && !maps_are_shown_) {
            maps_begin_ = run_.stored_snapshot().periods + 1;
            pinned_ = PinnedFrames();
        }
        maps_are_shown_ = shown;
    }
    /// Null if they have never been shown.
    const PageObservation* maps() const { return maps_ ? &*maps_ : nullptr; }
    /// True if disc i is pinned by the paper's criterion, which is known some frames later. False
    /// in the first frames, and if no maps are shown.
    bool is_pinned(std::size_t i) const {
        const PinnedLoose& found = pinned_.pinned_loose();
        return found.is_known() && found.pinned()[i] != 0;
    }
    const SpinMap& spins() const { return spins_; }
    /// What shows the cause, averaged since the warm-up: how well the cluster grips the wall, and
    /// how touching discs spin.
    const Slip& slip() const { return slip_; }
    const SpinFrustration& frustration() const { return frustration_; }
    /// The collisions since the last call, or the later ones of too many.
    std::vector<ContactMark> take_contacts() { return std::exchange(contacts_, {}); }
    const Simulation& simulation() const { return run_.simulation(); }
    const RunConfig& config() const { return config_; }
    const ContainerPath& path() const { return run_.path(); }
    /// The names of the measurements.
    const std::vector<std::string>& measured() const { return measured_; }
    const ClusterRotation& rotation_in_warmup() { return run_.rotation_in_warmup(); }
    const ClusterRotation& rotation() { return run_.rotation_after_warmup(); }
    const PageObservation& observation() const { return observation_; }
    /// Turns of the cluster since the averages began, or during the warm-up since its start: the
    /// integral of the rotation rate, by the same samples as its average by time. So turns divided
    /// by periods are the average. The movies count turns in the same way (page.hpp of the layer
    /// render).
    const RotationSample& turns() const { return turns_; }
    std::int64_t warmup() const { return config_.warmup.value_or(default_warmup); }
    bool is_warm() const { return run_.stored_snapshot().periods >= warmup(); }

    /// The result of a run that ends with the last passed event, without its duration. During the
    /// warm-up there are no averages. Call pass_found_event() first.
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

    /// The error message with which a run of the command line would end here. After it there are no
    /// more events.
    const std::optional<Message>& problem() const { return problem_; }
    /// The same message if the run ends with this event.
    std::optional<Message> problem_at_the_end() const {
        return problem_ || is_by_hand(path()) ? problem_ : run_.problem_at_the_end();
    }

    void step() {
        if (find()) pass();
    }

    /// Passes all events up to `time`, at most `maximum`. Returns whether `time` was reached.
    bool advance_to(double time, std::uint32_t maximum) {
        while (find()) {
            if (time_of(run_.event()) > time) return true;
            if (maximum-- == 0) return false;
            pass();
        }
        return false;
    }

    /// The state at `time`, between the last event and the next.
    const Snapshot& snapshot_at(double time) {
        shown_ = run_.stored_snapshot();
        const double clock = time - static_cast<double>(shown_.periods) * config_.period;
        // Sampling may have advanced the snapshot towards the next event.
        shown_.clock = std::fmin(std::fmax(passed_clock_, clock), config_.period);
        const Segment& segment = path().segment_at(shown_.clock);
        shown_.container_centre = segment.position_at(shown_.clock);
        shown_.container_velocity = segment.velocity_at(shown_.clock);
        return shown_;
    }
    /// The time of the last passed event.
    double time() const {
        return static_cast<double>(run_.stored_snapshot().periods) * config_.period + passed_clock_;
    }

    /// The initial state of a simulation that continues from `time`. The container is moved to the
    /// start of `path`, and the discs keep their positions relative to it. Velocities are not
    /// changed: the discs experience a vertex of the path.
    InitialState continued_from(double time, const RunConfig& config, const ContainerPath& path) {
        InitialState state = without_discs(config, path);
        const Snapshot now = snapshot_at(time).up_to_date();
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
    /// A run on the page has no end, so its warm-up cannot be a fraction of its length.
    static RunConfig endless(RunConfig config) {
        config.events = std::numeric_limits<std::int64_t>::max();
        config.periods.reset();
        config.warmup = config.warmup.value_or(default_warmup);
        config.warmup_found = false;
        return config;
    }

    /// Finds the next event unless it is already found; false if there is none.
    bool find() {
        if (found_) return true;
        // A path by hand has no period to check by.
        if (!problem_ && run_.is_check_due() && !is_by_hand(path())) problem_ = run_.problem();
        if (problem_) return false;
        run_.execute_event();
        found_ = true;
        while (run_.next_sample(turned_times_)) add_turns();
        while (run_.next_sample(cause_times_))
            if (run_.is_warm()) {
                const MFrameView view(run_.snapshot());
                slip_.sample(view);
                frustration_.sample(view);
            }
        if (samples_maps())
            while (run_.next_sample(map_times_)) {
                const Snapshot& now = run_.snapshot();
                spins_.sample(pinned_.sample(now));
                if (run_.is_warm()) maps_->sample(now);
            }
        return true;
    }
    bool samples_maps() const {
        return maps_are_shown_ && run_.stored_snapshot().periods >= maps_begin_;
    }
    void add_turns() {
        const Snapshot& s = run_.snapshot();
        if (!turns_are_averaged_ && s.periods >= warmup()) {
            turns_ = {0.0, 0.0};
            turns_are_averaged_ = true;
        }
        const RotationSample rate = rotation_of(s);
        const double turns = config_.period / rotation_samples / (2.0 * pi);
        turns_.individual += turns * rate.individual;
        turns_.rigid += turns * rate.rigid;
    }
    void pass() {
        const std::int64_t period = run_.stored_snapshot().periods;
        run_.pass_event();
        if (run_.stored_snapshot().periods > period) {
            if (samples_maps()) maps_->close_block();
            slip_.close_block();
            frustration_.close_block();
        }
        found_ = false;
        add_contact(run_.event());
        passed_clock_ = run_.stored_snapshot().clock;
    }

    void add_contact(const Event& event) {
        constexpr std::size_t most = 4096;
        if (event.kind != EventKind::disc_disc && event.kind != EventKind::disc_wall) return;
        if (contacts_.size() == most)
            contacts_.erase(contacts_.begin(), contacts_.end() - most / 2);
        contacts_.push_back({time_of(event), event.i, event.j, event.impulse.sticks});
        if (run_.is_warm()) frustration_.sample_event(event, run_.stored_snapshot());
    }

    const RunConfig config_;
    std::vector<std::string> measured_;
    PageObservation observation_;
    CoreRun run_;
    Snapshot shown_;
    RotationSample turns_{0.0, 0.0};
    bool turns_are_averaged_ = false;
    SampleTimes turned_times_;
    SampleTimes map_times_;
    SampleTimes cause_times_;
    Slip slip_{1};
    SpinFrustration frustration_{0.1, 1};
    std::vector<ContactMark> contacts_;
    PinnedFrames pinned_;
    std::optional<PageObservation> maps_;
    bool maps_are_shown_ = false;
    std::int64_t maps_begin_ = 0;  // the period
    SpinMap spins_;
    bool found_ = false;
    double passed_clock_ = 0.0;  // clock of the last passed event
    std::optional<Message> problem_;
};

}  // namespace swirl
