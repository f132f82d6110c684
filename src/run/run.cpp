#include "swirl/run/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "swirl/files/file_error.hpp"
#include "swirl/files/state_archive.hpp"
#include "swirl/measure/sample_times.hpp"
#include "swirl/run/failure.hpp"

namespace swirl {
namespace {

using Clock = std::chrono::steady_clock;

/// Samples of the averages by time per swirl. Not a multiple of the paper's 30 sides, so that the
/// corners of the path are met at different phases.
constexpr int rotation_samples = 64;

/// Events between two glances at the clock and at the stop flag.
constexpr int patience = 256;
constexpr std::chrono::milliseconds progress_interval(100);

struct Budget {
    double energy = 0.0, invariant = 0.0;
};

/// Kinetic energy K, and K − ΩL with the angular momentum about the swirl centre.
Budget budget_of(const Snapshot& s) {
    double K = 0.0, L = 0.0;
    for (std::size_t i = 0; i < s.size(); ++i) {
        const Disc d = s.disc(i);
        K += kinetic_energy(d);
        L += d.mass * cross(s.position(i), d.velocity) + d.inertia * d.spin;
    }
    return {K, K - 2.0 * pi / s.period * L};
}

/// Mean spin of the discs, in units of Ω.
double mean_spin(const Snapshot& s) {
    double sum = 0.0;
    for (const double spin : s.spin) sum += spin;
    return sum / static_cast<double>(s.size()) * s.period / (2.0 * pi);
}

/// A trajectory between two events.
struct Moment {
    Progress progress;
    std::vector<Disc> discs;

    static Moment of(const Simulation& simulation) {
        Moment m{simulation.progress(), {}};
        for (std::size_t i = 0; i < simulation.size(); ++i) m.discs.push_back(simulation.disc(i));
        return m;
    }
    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(progress.swirls, progress.clock, progress.leg, progress.events);
        visit(discs);
    }
};

Simulation begin(const RunConfig& config, std::optional<StateReader>& kept) {
    InitialState scene = make_initial_state(config);
    Moment moment;
    if (kept) {
        (*kept)(moment);
        if (moment.discs.size() != scene.discs.size() ||
            moment.progress.leg >= scene.path.legs.size())
            throw FileError("The saved state is that of another run.");
        scene.discs = moment.discs;
    }
    return Simulation(scene, moment.progress);
}

class Run {
  public:
    Run(const RunConfig& config, const RunControl& control)
        : config_(config),
          control_(control),
          path_(make_path(config)),
          kept_(control.resume ? std::optional<StateReader>(*control.resume) : std::nullopt),
          simulation_(begin(config, kept_)),
          snapshot_(simulation_.snapshot()),
          rotation_times_(rotation_samples, config.period),
          observation_times_(samples_per_period, config.period),
          warm_(config.warmup == 0) {
        const Budget start = budget_of(snapshot_);
        result_.config = config;
        result_.energy_at_start = start.energy;
        result_.invariant_at_start = start.invariant;
        for (const RunControl::Sampler& sampler : control.samplers)
            caller_times_.emplace_back(sampler.per_period, config.period, sampler.interval);
        if (kept_) {
            fields(*kept_);
            kept_->expect_end();
        } else if (control.swirl_begins) {
            control.swirl_begins(warm_);
        }
    }

    RunResult operator()() {
        const auto begin = Clock::now();
        auto last_report = begin;
        while (!done()) {
            for (int k = 0; k < patience && !done(); ++k) step();
            refuse_collapse(collapse_window());
            const bool stopped = control_.stop && control_.stop->load(std::memory_order_relaxed);
            if (!done()) offer_state(stopped, seconds_before_ + seconds_since(begin));
            if (stopped) break;
            const auto now = Clock::now();
            if (!control_.progress || now - last_report < progress_interval) continue;
            last_report = now;
            control_.progress({fraction(), simulation_.events().total(), periods()});
        }
        refuse_collapse(least_collapse_window);
        result_.complete = done();
        result_.seconds = seconds_before_ + seconds_since(begin);
        finish();
        return result_;
    }

  private:
    static double seconds_since(Clock::time_point begin) {
        return std::chrono::duration<double>(Clock::now() - begin).count();
    }

    /// What the run has gathered beside the moment it has reached.
    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(seconds_before_, warm_, rotation_times_, in_warmup_, after_warmup_);
        visit(result_.warmup, result_.warmup_events, result_.max_overlap);
        visit(result_.energy_at_start, result_.invariant_at_start);
        visit(spin_in_warmup_, spin_after_, next_question_);
        for (SampleTimes& times : caller_times_) visit(times);
        if (control_.observation) visit(observation_times_, *control_.observation);
    }

    /// Collapse: infinitely many collisions in a finite time, by restitution or, with e = 1, by
    /// friction alone (docs/physics.md). A disc of the paper's dish has about 70 events per swirl,
    /// one that obeys a contact duration at most T/t_c. Asked whenever so many events have passed,
    /// and of what is left at the end.
    void refuse_collapse(std::uint64_t window) {
        constexpr double too_fast = 1e8;  // events per disc and swirl
        const std::uint64_t events = simulation_.events().total() - events_at_mark_;
        if (events < window) return;
        const double swirls = periods() - periods_at_mark_;
        const double discs = static_cast<double>(simulation_.size());
        if (static_cast<double>(events) > too_fast * discs * swirls)
            throw Failure(fmt::format(
                "The last {} events took {:.2g} swirls, so time all but stands still after {:.3f} "
                "swirls: {}",
                events, swirls, periods(), reason_for_collapse()));
        events_at_mark_ += events;
        periods_at_mark_ += swirls;
    }

    static constexpr std::uint64_t least_collapse_window = 2000;
    /// Some two hundred events for each disc: the two that collapse may be among thousands.
    std::uint64_t collapse_window() const {
        return std::max<std::uint64_t>(20'000, 200 * simulation_.size());
    }

    std::string reason_for_collapse() const {
        if (config_.restitution < 1.0)
            return fmt::format(
                "with restitution {} the discs collide ever faster (inelastic collapse). A longer "
                "--contact-duration than {} would keep them apart.",
                config_.restitution, config_.contact_duration);
        return fmt::format(
            "friction has taken the energy out of the relative motion of discs that lie pressed "
            "together, and they collide ever faster (a collapse; docs/physics.md). The model has "
            "no state after it. Another --seed than {} may "
            "not meet it.",
            config_.seed);
    }

    void offer_state(bool stopped, double seconds) {
        if (!control_.wants_state || !control_.wants_state(stopped)) return;
        sample_rotation_by_event();
        StateWriter state;
        Moment moment = Moment::of(simulation_);
        state(moment);
        const double before = std::exchange(seconds_before_, seconds);
        fields(state);
        seconds_before_ = before;
        control_.keep_state(state.bytes());
    }

    bool done() const {
        if (config_.periods) return simulation_.swirls() >= *config_.periods;
        return simulation_.events().total() >= static_cast<std::uint64_t>(config_.events);
    }
    double periods() const {
        return static_cast<double>(simulation_.swirls()) + simulation_.clock() / config_.period;
    }
    double fraction() const {
        if (config_.periods) return periods() / static_cast<double>(*config_.periods);
        return static_cast<double>(simulation_.events().total()) /
               static_cast<double>(config_.events);
    }

    /// One event. The snapshot holds the state before it, and is sampled at all times that are due
    /// until then; after it, it holds the state that the event has left behind.
    void step() {
        const Event event = simulation_.step();
        sample_rotation_by_event();
        while (rotation_times_.next(snapshot_, path_, event.clock)) {
            rotation().sample_by_time(snapshot_);
            spin().add(mean_spin(snapshot_));
        }
        if (observes())
            while (observation_times_.next(snapshot_, path_, event.clock))
                control_.observation->sample(snapshot_);
        for (std::size_t k = 0; k < caller_times_.size(); ++k)
            while (caller_times_[k].next(snapshot_, path_, event.clock))
                control_.samplers[k].look(snapshot_);

        simulation_.refresh(snapshot_, event);
        rotation().follow(snapshot_, event);
        rotation_is_sampled_ = false;
        result_.max_overlap = std::max(result_.max_overlap, event.overlap);
        if (observes()) control_.observation->sample(event, snapshot_);
        if (control_.after_event) control_.after_event(snapshot_, event);
        if (event.kind == EventKind::path_vertex && simulation_.swirls() > event.swirls)
            begin_period();
    }
    bool observes() const { return warm_ && control_.observation; }

    /// The sample by event of the snapshot as it stands, unless it is taken: at the last moment,
    /// when nobody has to wait for it to be written (cluster_rotation.hpp).
    void sample_rotation_by_event() {
        if (!rotation_is_sampled_) rotation().sample(snapshot_);
        rotation_is_sampled_ = true;
    }

    /// Closes the blocks of the period that has ended; then, perhaps, ends the warm-up.
    void begin_period() {
        rotation_times_.begin_period();
        observation_times_.begin_period();
        for (SampleTimes& times : caller_times_) times.begin_period();
        sample_rotation_by_event();
        rotation().close_block();
        spin().close_block();
        if (observes()) control_.observation->close_block();
        if (!warm_ && warm_now()) {
            warm_ = true;
            result_.warmup = simulation_.swirls();
            result_.warmup_events = simulation_.events();
        }
        if (control_.swirl_begins) control_.swirl_begins(warm_);
    }

    /// At the end of a swirl: is the warm-up over?
    bool warm_now() {
        if (config_.warmup_found) return found_warm() || fraction() >= 0.5;
        if (config_.warmup) return simulation_.swirls() >= *config_.warmup;
        return simulation_.swirls() >= default_warmup || fraction() >= 0.2;
    }

    /// Asked ever more seldom: the answer takes time that grows with the number of swirls.
    bool found_warm() {
        if (simulation_.swirls() < next_question_) return false;
        next_question_ += std::max<std::int64_t>(10, next_question_ / 10);
        return beginning_is_forgotten(in_warmup_.by_event().block_means()) &&
               beginning_is_forgotten(spin_in_warmup_.series().block_means());
    }

    /// What is seen in the warm-up is kept apart: a run too short to have a warm-up needs it.
    ClusterRotation& rotation() { return warm_ ? after_warmup_ : in_warmup_; }
    BlockMean& spin() { return warm_ ? spin_after_ : spin_in_warmup_; }

    void finish() {
        sample_rotation_by_event();
        // A run too short for a single whole swirl still has a mean, though no error.
        if (warm_ && after_warmup_.by_event().empty()) after_warmup_.close_block();
        if (!warm_ && in_warmup_.by_event().empty()) in_warmup_.close_block();
        if (!warm_ && config_.warmup && result_.complete)
            throw Failure(fmt::format(
                "The run ended after {:.1f} periods, inside its warm-up of --warmup {} periods; "
                "more --events or a shorter --warmup would be right.",
                periods(), *config_.warmup));
        result_.rotation = rotation().estimates();
        result_.steady = find_steady_state(rotation().by_event().block_means());
        result_.steady_spin = find_steady_state(spin().series().block_means());
        result_.events = simulation_.events();
        result_.periods = periods();
        const Budget end = budget_of(snapshot_);
        result_.energy = end.energy;
        result_.invariant = end.invariant;
        result_.state_hash = simulation_.state_hash();
    }

    const RunConfig config_;
    const RunControl& control_;
    const ContainerPath path_;
    std::optional<StateReader> kept_;
    Simulation simulation_;
    Snapshot snapshot_;
    SampleTimes rotation_times_, observation_times_;
    std::vector<SampleTimes> caller_times_;
    std::uint64_t events_at_mark_ = simulation_.events().total();
    double periods_at_mark_ = periods();
    double seconds_before_ = 0.0;  // by the runs that this one resumes
    ClusterRotation in_warmup_, after_warmup_;
    BlockMean spin_in_warmup_, spin_after_;
    std::int64_t next_question_ = least_blocks_of_a_steady_state;  // at this swirl: warm?
    bool warm_;
    bool rotation_is_sampled_ = true;  // after the last event
    RunResult result_;
};

}  // namespace

RunResult run(const RunConfig& config, const RunControl& control) { return Run(config, control)(); }

}  // namespace swirl
