#include "swirl/run/core_run.hpp"

#include <algorithm>
#include <cmath>

#include "swirl/measure/strided.hpp"
#include "swirl/physics/mirrored.hpp"
#include "swirl/run/budget.hpp"
#include "swirl/run/collapse_guard.hpp"
#include "swirl/run/particle_sizes.hpp"

namespace swirl {
namespace {

/// Measurements by event visit all discs after each event, so with many discs there are fewer
/// events between two checks.
int events_between_checks(std::size_t discs) {
    constexpr std::size_t visits_between_checks = 1 << 22;
    constexpr std::size_t max_events = 256;
    const std::size_t events = visits_between_checks / std::max<std::size_t>(discs, 1);
    return static_cast<int>(std::clamp<std::size_t>(events, 1, max_events));
}

}  // namespace

CoreRun::CoreRun(const RunConfig& config, const InitialState& begin, RunObserver observer,
                 const Progress& progress, const Tuning& tuning)
    : config_(config),
      observer_(observer),
      tuning_(tuning),
      simulation_(begin, progress, tuning),
      ramps_(begin.path),
      snapshot_(simulation_.snapshot()),
      event_(),
      rotation_times_(rotation_samples, config.period),
      few_rotation_times_(rotation_samples_of_few, config.period),
      observation_times_(samples_per_period, config.period),
      by_event_(config.events_per_sample, simulation_.size()),
      warm_up_(config, tuning.width),
      events_to_check_(events_until_check()),
      watch_(simulation_.size(), mark()) {
    const Budget start = budget_of(snapshot(), config.swirl_sign());
    result_.config = config;
    result_.energy_at_start = start.energy;
    result_.invariant_at_start = start.invariant;
    begin_angles(0);
}

bool CoreRun::complete() const {
    if (config_.periods) return simulation_.periods() >= *config_.periods;
    return simulation_.events().total() >= static_cast<std::uint64_t>(config_.events);
}

double CoreRun::periods() const {
    return static_cast<double>(simulation_.periods()) + simulation_.clock() / path().period;
}
double CoreRun::fraction() const {
    if (config_.periods) return periods() / static_cast<double>(*config_.periods);
    return static_cast<double>(simulation_.events().total()) / static_cast<double>(config_.events);
}

/// Also samples the snapshot at all sample times before the event.
void CoreRun::execute_event() {
    update_snapshot();
    execute(1, &event_);
    span_.events = 0;
}

void CoreRun::pass_event() {
    simulation_.refresh(snapshot_, event_);
    result_.max_overlap = std::max(result_.max_overlap, event_.overlap);
    if (observes_events() || series_.samples_events()) pass_to_measurements();
    const bool period_ended =
        event_.kind == EventKind::path_vertex && simulation_.periods() > event_.periods;
    if (period_ended) begin_period();
}

void CoreRun::pass_to_measurements() {
    const Event event = config_.turns_clockwise() ? mirrored(event_) : event_;
    const EventStates after = states_after_event();
    if (observes_events()) observer_.sample(event, after);
    if (series_.samples_events()) series_.sample_measured(event, after);
}

/// Spheres are moved to the time of the event when a measurement asks for them.
EventStates CoreRun::states_after_event() {
    if (config_.turns_clockwise() || !snapshot_.are_spheres()) return observed();
    const auto all = [](void* run) -> const Snapshot& {
        return static_cast<CoreRun*>(run)->snapshot();
    };
    return {snapshot_, all, this};
}

const Snapshot& CoreRun::observed() {
    if (!config_.turns_clockwise()) return snapshot();
    mirrored_ = snapshot();
    mirror(mirrored_);
    return mirrored_;
}

/// True if a measurement needs samples now; otherwise the sample times of the observation are
/// skipped.
bool CoreRun::samples_observations() const { return observes() || series_.measures(); }

bool CoreRun::observes_events() const { return observes() && observer_.samples_events(); }

bool CoreRun::hands_over_events() const {
    return observes_events() || series_.samples_events() || !snapshot_.turned.empty();
}

std::uint64_t CoreRun::execute_events() {
    if (hands_over_events()) {
        execute_event();
        pass_event();
        return 1;
    }
    // is_check_due() has counted the first event.
    const std::uint64_t events = execute(static_cast<std::uint64_t>(events_to_check_) + 1, nullptr);
    events_to_check_ -= static_cast<int>(events) - 1;
    result_.max_overlap = std::max(result_.max_overlap, span_.max_overlap);
    if (simulation_.periods() > snapshot_.periods) {
        update_flights();
        begin_period();
    }
    return events;
}

/// Executes at least one event and at most this number, but none after the end of the period, and
/// takes all samples before the last of them. The snapshot is updated only if it is sampled,
/// because that reads all discs. The event loop itself samples the rotation and the spins.
std::uint64_t CoreRun::execute(std::uint64_t maximum, Event* last) {
    for (;;) {
        const std::uint64_t before = span_.events;
        const double due =
            samples_observations() ? observation_times_.due(snapshot_.periods) : never;
        RotationSampling sampling = rotation_sampling();
        simulation_.observe_before(due, maximum, sampling, span_, last);
        rotation_times().taken(snapshot_.periods, snapshot_.period, sampling.index);
        const std::uint64_t events = span_.events - before;
        if (sampling.paused_at != never)
            sample_series(sampling.paused_at);
        else if (events < maximum && simulation_.periods() == snapshot_.periods)
            sample_observations(due);
        if (events > 0) return events;
    }
}

/// A period with exact means has fewer samples by time.
SampleTimes& CoreRun::rotation_times() {
    return follows_angles() ? few_rotation_times_ : rotation_times_;
}

RotationSampling CoreRun::rotation_sampling() {
    const SampleTimes& times = rotation_times();
    Block& spin = warm_up_.spin().open();
    RotationSampling sampling{.rotation = rotation().follower(snapshot_),
                              .interval = by_event_.events(),
                              .left = &by_event_.left(),
                              .index = times.next_in_period(snapshot_.periods),
                              .per_period = times.per_period(),
                              .due = never,
                              .pauses = series_.exists(),
                              .spin = &spin.sum,
                              .spins = &spin.weight,
                              .swirl_sign = config_.swirl_sign()};
    sampling.set_due(snapshot_.period);
    return sampling;
}

/// At a sample time of the rotation, before the next event.
void CoreRun::sample_series(double clock) {
    update_flights();
    SampleTimes::move(snapshot_, path(), clock);
    series_.sample(observed());
}

/// At all sample times of measurements up to this one, before the next event.
void CoreRun::sample_observations(double clock) {
    update_flights();
    while (observation_times_.next(snapshot_, path(), clock)) {
        const Snapshot& now = observed();
        if (observes()) observer_.sample(now);
        series_.sample_measured(now);
    }
}

/// Brings the snapshot up to date after spans of events, except for the angles.
void CoreRun::update_flights() {
    if (span_.events == 0) return;
    simulation_.refresh(snapshot_, span_);
    span_.events = 0;
    angles_are_old_ = true;
}

/// The same with the angles.
void CoreRun::update_snapshot() {
    update_flights();
    if (angles_are_old_) simulation_.refresh_angles(snapshot_);
    angles_are_old_ = false;
}

/// A run with a given number of events is also checked at its end; one with a number of periods is
/// checked at the end of each period (begin_period).
int CoreRun::events_until_check() const {
    const bool visits_all_discs =
        observer_.exists() || series_.exists() || config_.events_per_sample > 0;
    const int at_most =
        complete() ? 0 : events_between_checks(visits_all_discs ? simulation_.size() : 1);
    if (config_.periods) return at_most;
    const std::int64_t left =
        config_.events - static_cast<std::int64_t>(simulation_.events().total());
    return static_cast<int>(std::clamp<std::int64_t>(left, 0, at_most));
}

std::optional<Message> CoreRun::problem() {
    if (auto message = overlap_problem()) return message;
    if (const auto found = watch_.check(mark()))
        return collapse_message(*found, periods(), config_);
    return {};
}
std::optional<Message> CoreRun::problem_at_the_end() const {
    if (auto message = overlap_problem()) return message;
    if (const auto found = watch_.check_at_end(mark()))
        return collapse_message(*found, periods(), config_);
    return {};
}

/// Overlaps are rounding errors of positions (docs/explanation/physics.md) and must stay small.
std::optional<Message> CoreRun::overlap_problem() const {
    constexpr double max_relative_overlap = 1e-6;
    const double smallest = radius_bounds(config_).smallest;
    if (result_.max_overlap <= max_relative_overlap * smallest) return {};
    return Message("overlap", {with_decimals("periods", periods(), 3),
                               rounded("overlap", result_.max_overlap / smallest, 2)});
}

/// Closes the blocks of the period that has ended, and ends the warm-up or the run if it is time.
void CoreRun::begin_period() {
    const bool exact = follows_angles();
    if (exact) rotation().end_angles(snapshot_);
    const std::uint64_t events = simulation_.events().total();
    constexpr double few = rotation_samples_of_few;
    const double weight_by_time = exact ? rotation_samples / few : 1.0;
    if (series_.exists())  // the blocks of the period are still open
        series_.add_period(
            {.period = simulation_.periods() - 1,
             .is_counted = is_warm(),
             .rotation = rotation().open_means(),
             .rotation_weights = rotation().open_weights(by_event_.events(), weight_by_time),
             .spin = warm_up_.spin().open_mean(),
             .events = events});
    rotation().close_block(by_event_.events(), weight_by_time);
    warm_up_.spin().close_block();
    if (observes()) observer_.close_block();
    if (warm_up_.ends(config_, simulation_.periods(), fraction())) {
        result_.warmup = simulation_.periods();
        result_.warmup_events = simulation_.events();
    }
    if (ramps_.begin_period(config_, simulation_, tuning_, snapshot_))
        rotation().renew_centre(snapshot_);
    if (complete()) events_to_check_ = 0;
    begin_angles(by_event_.begin_period(simulation_.size(), events));
}

/// The period that begins has the exact mean rotation by time if the last one had few events.
void CoreRun::begin_angles(std::uint64_t events) {
    if (by_event_.events() == 1 && events < events_of_exact_means && !snapshot_.are_spheres())
        rotation().begin_angles(snapshot_);
}

/// Smaller spins, in units of Ω, are none: those of discs that cannot spin, but for a huge moment
/// of inertia. Their changes mean nothing.
constexpr double smallest_spin = 1e-6;

std::vector<double> without_tiny_values(std::vector<double> blocks) {
    const bool all_tiny = std::all_of(blocks.begin(), blocks.end(),
                                      [](double b) { return std::fabs(b) < smallest_spin; });
    if (all_tiny) std::fill(blocks.begin(), blocks.end(), 0.0);
    return blocks;
}

SteadyState CoreRun::steady_state_of(const BlockSeries& series) const {
    SteadyState state = find_steady_state(without_tiny_values(series.block_means()));
    if (!std::isnan(state.change.size))
        state.period = static_cast<double>(result_.warmup) +
                       static_cast<double>(state.change.at * series.periods_per_block());
    return state;
}

RunResult CoreRun::result() {
    result_.complete = complete();
    result_.rotation = corrected(rotation().estimates());
    result_.events_per_rotation_sample = by_event_.events();
    result_.steady = steady_state_of(rotation().mean_by_event());
    result_.steady_spin = steady_state_of(warm_up_.spin().series());
    result_.events = simulation_.events();
    result_.periods = periods();
    const Budget end = budget_of(snapshot(), config_.swirl_sign());
    result_.energy = end.energy;
    result_.invariant = end.invariant;
    result_.state_hash = simulation_.state_hash();
    result_.simd = simulation_.loop_counts().width;
    // Sums and checkpoints are in the units of the configuration.
    const MeasuredUnits units = units_of(config_);
    RunResult printed = result_;
    printed.max_overlap /= units.r;
    for (double* energy : {&printed.energy, &printed.energy_at_start, &printed.invariant,
                           &printed.invariant_at_start})
        *energy /= units.of("m v²");
    return printed;
}

}  // namespace swirl
