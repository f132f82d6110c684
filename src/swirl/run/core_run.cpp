#include "swirl/run/core_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <new>

#include "swirl/measure/observation.hpp"
#include "swirl/run/budget.hpp"
#include "swirl/run/collapse_guard.hpp"
#include "swirl/run/particle_sizes.hpp"
#include "swirl/run/period_series.hpp"
#include "swirl/run/ramp.hpp"

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

CoreRun::CoreRun(const RunConfig& config, const InitialState& begin, Observation* observation,
                 const Progress& progress, const Tuning& tuning)
    : config_(config),
      path_(begin.path),
      observation_(observation),
      tuning_(tuning),
      simulation_(begin, progress, tuning),
      snapshot_(simulation_.snapshot()),
      event_(),
      rotation_times_(rotation_samples, config.period),
      few_rotation_times_(rotation_samples_of_few, config.period),
      observation_times_(samples_per_period, config.period),
      events_to_check_(events_until_check()),
      watch_(simulation_.size(), mark()),
      in_warmup_(tuning.width),
      after_warmup_(tuning.width),
      next_warmup_test_(min_blocks_of_a_steady_state),
      warm_(config.warmup == 0),
      events_per_sample_(config.events_per_sample > 0
                             ? static_cast<std::uint64_t>(config.events_per_sample)
                             : events_per_rotation_sample(simulation_.size())),
      events_to_sample_(events_per_sample_) {
    const Budget start = budget_of(snapshot());
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
    return static_cast<double>(simulation_.periods()) + simulation_.clock() / path_.period;
}
double CoreRun::fraction() const {
    if (config_.periods) return periods() / static_cast<double>(*config_.periods);
    return static_cast<double>(simulation_.events().total()) / static_cast<double>(config_.events);
}

/// Also samples the snapshot at all sample times before the event.
void CoreRun::execute_event() {
    update_snapshot();
    // Constructed in place: a copy would first have to wait for the stores of the event.
    new (&event_) Event(simulation_.step());
    sample_by_event();
    sample_by_time(event_.clock);
}

/// At all sample times up to this one, before the next event.
void CoreRun::sample_by_time(double clock) {
    SampleTimes& times = follows_angles() ? few_rotation_times_ : rotation_times_;
    while (times.next(snapshot_, path_, clock)) {
        rotation().sample_by_time(snapshot_);
        spin().add(mean_spin(snapshot_));
        if (series_) series_->sample(snapshot());
    }
    if (!samples_observations()) return;
    while (observation_times_.next(snapshot_, path_, clock)) {
        const Snapshot& now = snapshot();
        if (observes()) observation_->sample(now);
        if (measures_period()) series_->sample_measured(now);
    }
}

void CoreRun::pass_event() {
    simulation_.refresh(snapshot_, event_);
    const bool period_ended =
        event_.kind == EventKind::path_vertex && simulation_.periods() > event_.periods;
    if (events_per_sample_ == 1 || period_ended) rotation().follow(snapshot_, event_);
    count_to_sample(1);
    result_.max_overlap = std::max(result_.max_overlap, event_.overlap);
    if (observes_events()) observation_->sample(event_, snapshot());
    if (series_ && series_->samples_events()) series_->sample_measured(event_, snapshot());
    if (period_ended) begin_period();
}

void CoreRun::count_to_sample(std::uint64_t events) {
    events_to_sample_ -= events;
    if (events_to_sample_ > 0) return;
    events_to_sample_ = events_per_sample_;
    rotation_is_sampled_ = false;
}

bool CoreRun::measures_period() const { return series_ && series_->measures(); }

/// True if a measurement needs samples now; otherwise the sample times of the observation are
/// skipped.
bool CoreRun::samples_observations() const { return observes() || measures_period(); }

bool CoreRun::observes_events() const { return observes() && observation_->samples_events(); }

std::uint64_t CoreRun::execute_events() {
    const bool each_event = events_per_sample_ == 1 || observes_events() ||
                            (series_ && series_->samples_events()) || !snapshot_.turned.empty();
    const double period_end = path_.segments.back().end;
    for (bool stopped = true; !each_event && stopped;) {
        double due = rotation_times_.due(snapshot_.periods);
        if (samples_observations()) due = std::min(due, observation_times_.due(snapshot_.periods));
        // is_check_due() has counted the first event.
        const std::uint64_t to_check = static_cast<std::uint64_t>(events_to_check_) + 1;
        const std::uint64_t maximum = std::min(events_to_sample_, to_check);
        const std::uint64_t events = execute_span(due, maximum);
        // Ended by the next sample time?
        stopped = events < maximum && due < period_end;
        if (stopped) {
            sample_by_event();
            update_flights();
            sample_by_time(due);
        }
        if (events > 0) return events;
    }
    execute_event();
    pass_event();
    return 1;
}

/// Executes at most this number of events, but none after the sample time `due` or the end of the
/// period. The snapshot is updated only if it is sampled, because that reads all discs.
std::uint64_t CoreRun::execute_span(double due, std::uint64_t maximum) {
    const std::uint64_t before = span_.events;
    simulation_.run_before(due, maximum, span_);
    const std::uint64_t events = span_.events - before;
    if (events == 0) return 0;
    events_to_check_ -= static_cast<int>(events) - 1;
    result_.max_overlap = std::max(result_.max_overlap, span_.max_overlap);
    sample_by_event();
    count_to_sample(events);
    if (!rotation_is_sampled_) update_flights();
    return events;
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
    const bool visits_all_discs = observation_ || series_ || config_.events_per_sample > 0;
    const int at_most =
        complete() ? 0 : events_between_checks(visits_all_discs ? simulation_.size() : 1);
    if (config_.periods) return at_most;
    const std::int64_t left =
        config_.events - static_cast<std::int64_t>(simulation_.events().total());
    return static_cast<int>(std::clamp<std::int64_t>(left, 0, at_most));
}

std::optional<std::string> CoreRun::problem() {
    if (auto sentence = overlap_problem()) return sentence;
    if (const auto found = watch_.check(mark())) return collapse_sentence(*found);
    return {};
}
std::optional<std::string> CoreRun::problem_at_the_end() const {
    if (auto sentence = overlap_problem()) return sentence;
    if (const auto found = watch_.check_at_end(mark())) return collapse_sentence(*found);
    return {};
}

/// Overlaps are rounding errors of positions (docs/explanation/physics.md) and must stay small.
std::optional<std::string> CoreRun::overlap_problem() const {
    constexpr double max_relative_overlap = 1e-6;
    const double smallest = radius_bounds(config_).smallest;
    if (result_.max_overlap <= max_relative_overlap * smallest) return {};
    return fmt::format(
        "after {:.3f} periods a disc overlaps another disc or the wall by {:.2g} of the smallest "
        "radius: rounding errors are too large for such small discs in such a wide container or "
        "on such a long path.\nhint: reduce --container-radius, --amplitude or --events.",
        periods(), result_.max_overlap / smallest);
}

std::string CoreRun::collapse_sentence(const Collapse& collapse) const {
    return swirl::collapse_sentence(collapse, periods(), reason_for_collapse());
}

std::string CoreRun::reason_for_collapse() const { return swirl::reason_for_collapse(config_); }

/// Takes the sample by event of the current state, if it is due. It is taken as late as possible,
/// so that the processor need not wait for the snapshot to be written (cluster_rotation.hpp).
void CoreRun::sample_by_event() {
    if (rotation_is_sampled_) return;
    rotation_is_sampled_ = true;
    if (events_per_sample_ == 1)
        rotation().sample(snapshot_);
    else
        rotation().sample_alone(snapshot_);
}

/// Closes the blocks of the period that has ended, and ends the warm-up or the run if it is time.
void CoreRun::begin_period() {
    sample_by_event();
    const bool exact = follows_angles();
    if (exact) rotation().end_angles(snapshot_);
    if (series_) add_period_to_series();
    constexpr double few = rotation_samples_of_few;
    rotation().close_block(events_per_sample_, exact ? rotation_samples / few : 1.0);
    spin().close_block();
    if (observes()) observation_->close_block();
    if (!warm_ && is_warmup_over()) {
        warm_ = true;
        result_.warmup = simulation_.periods();
        result_.warmup_events = simulation_.events();
    }
    if (!config_.ramps.empty() && changes_in_period(config_, simulation_.periods()))
        continue_ramps();
    if (complete()) events_to_check_ = 0;
    // The interval follows from the last period alone, so a resumed run has the same samples.
    const std::uint64_t events = simulation_.events().total();
    if (config_.events_per_sample == 0) {
        events_per_sample_ =
            events_per_rotation_sample(simulation_.size(), events - events_before_);
        events_to_sample_ = std::min(events_to_sample_, events_per_sample_);
    }
    begin_angles(events - events_before_);
    events_before_ = events;
}

/// The period that begins has the exact mean rotation by time if the last one had few events.
void CoreRun::begin_angles(std::uint64_t events) {
    if (events_per_sample_ == 1 && events < events_of_exact_means && !snapshot_.are_spheres())
        rotation().begin_angles(snapshot_);
}

/// The blocks of the period are still open.
void CoreRun::add_period_to_series() {
    series_->add_period({.period = simulation_.periods() - 1,
                         .is_counted = warm_,
                         .rotation = rotation().open_means(),
                         .spin = spin().open_mean(),
                         .events = simulation_.events().total()});
}

/// Continues with the values of the period that begins.
void CoreRun::continue_ramps() {
    const InitialState next = surroundings_in(config_, simulation_.periods());
    const bool period_changes = next.path.period != path_.period;
    const double now = snapshot_.time();
    simulation_.change_surroundings(next, tuning_);
    path_ = next.path;
    Snapshot begin = simulation_.snapshot();
    begin.turned = std::move(snapshot_.turned);
    begin.periods_at_change = period_changes ? begin.periods : snapshot_.periods_at_change;
    begin.time_at_change = period_changes ? now : snapshot_.time_at_change;
    snapshot_ = std::move(begin);
    rotation().follow(snapshot_, event_);
}

/// Called at the end of each period of the warm-up.
bool CoreRun::is_warmup_over() {
    if (config_.warmup_found) return is_warmup_detected() || fraction() >= 0.5;
    if (config_.warmup) return simulation_.periods() >= *config_.warmup;
    return simulation_.periods() >= default_warmup || fraction() >= 0.2;
}

/// The test takes time proportional to the number of periods, so the intervals between tests grow.
bool CoreRun::is_warmup_detected() {
    if (simulation_.periods() < next_warmup_test_) return false;
    next_warmup_test_ += std::max<std::int64_t>(10, next_warmup_test_ / 10);
    return beginning_is_forgotten(in_warmup_.mean_by_event().block_means()) &&
           beginning_is_forgotten(spin_in_warmup_.series().block_means());
}

SteadyState CoreRun::steady_state_of(const BlockSeries& series) const {
    SteadyState state = find_steady_state(series.block_means());
    if (!std::isnan(state.change.size))
        state.period = static_cast<double>(result_.warmup) +
                       static_cast<double>(state.change.at * series.periods_per_block());
    return state;
}

RunResult CoreRun::result() {
    sample_by_event();
    result_.complete = complete();
    result_.rotation = rotation().estimates();
    result_.events_per_rotation_sample = events_per_sample_;
    result_.steady = steady_state_of(rotation().mean_by_event());
    result_.steady_spin = steady_state_of(spin().series());
    result_.events = simulation_.events();
    result_.periods = periods();
    const Budget end = budget_of(snapshot());
    result_.energy = end.energy;
    result_.invariant = end.invariant;
    result_.state_hash = simulation_.state_hash();
    result_.simd = simulation_.loop_counts().width;
    return result_;
}

}  // namespace swirl
