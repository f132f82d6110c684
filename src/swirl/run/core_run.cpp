#include "swirl/run/core_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <new>

#include "swirl/measure/observation.hpp"
#include "swirl/run/budget.hpp"

namespace swirl {
namespace {

/// An observation by event looks at all discs after each of them.
int events_between_looks(std::size_t discs) {
    constexpr std::size_t discs_looked_at = 1 << 22;
    return static_cast<int>(
        std::clamp<std::size_t>(discs_looked_at / std::max<std::size_t>(discs, 1), 1, 256));
}

}  // namespace

BareRun::BareRun(const RunConfig& config, const InitialState& begin, Observation* observation,
                 const Progress& progress, const Tuning& tuning)
    : config_(config),
      path_(begin.path),
      observation_(observation),
      simulation_(begin, progress, tuning),
      snapshot_(simulation_.snapshot()),
      event_(),
      rotation_times_(rotation_samples, config.period),
      observation_times_(samples_per_period, config.period),
      events_to_look_(events_until_look()),
      watch_(simulation_.size(), mark()),
      in_warmup_(tuning.width),
      after_warmup_(tuning.width),
      next_question_(min_blocks_of_a_steady_state),
      warm_(config.warmup == 0),
      events_per_sample_(events_per_rotation_sample(simulation_.size())),
      events_to_sample_(events_per_sample_ - simulation_.events().total() % events_per_sample_) {
    const Budget start = budget_of(snapshot());
    result_.config = config;
    result_.energy_at_start = start.energy;
    result_.invariant_at_start = start.invariant;
}

bool BareRun::complete() const {
    if (config_.periods) return simulation_.periods() >= *config_.periods;
    return simulation_.events().total() >= static_cast<std::uint64_t>(config_.events);
}

double BareRun::periods() const {
    return static_cast<double>(simulation_.periods()) + simulation_.clock() / config_.period;
}
double BareRun::fraction() const {
    if (config_.periods) return periods() / static_cast<double>(*config_.periods);
    return static_cast<double>(simulation_.events().total()) / static_cast<double>(config_.events);
}

/// The snapshot is sampled at all times that are due until the event.
void BareRun::find_event() {
    // Written where it is kept: what is copied waits until it has been written.
    new (&event_) Event(simulation_.step());
    sample_by_event();
    while (next_sample(rotation_times_)) {
        rotation().sample_by_time(snapshot_);
        spin().add(mean_spin(snapshot_));
    }
    if (observes())
        while (next_sample(observation_times_)) observation_->sample(snapshot());
}

void BareRun::pass_event() {
    simulation_.refresh(snapshot_, event_);
    rotation().follow(snapshot_, event_);
    if (--events_to_sample_ == 0) {
        events_to_sample_ = events_per_sample_;
        rotation_is_sampled_ = false;
    }
    result_.max_overlap = std::max(result_.max_overlap, event_.overlap);
    if (observes()) observation_->sample(event_, snapshot());
    if (event_.kind == EventKind::path_vertex && simulation_.periods() > event_.periods)
        begin_period();
}

/// The end of the run comes with an event or with a swirl.
int BareRun::events_until_look() const {
    const int at_most = complete() ? 0 : events_between_looks(simulation_.size());
    if (config_.periods) return at_most;
    const std::int64_t left =
        config_.events - static_cast<std::int64_t>(simulation_.events().total());
    return static_cast<int>(std::clamp<std::int64_t>(left, 0, at_most));
}

std::optional<std::string> BareRun::problem() {
    if (auto sentence = overlap_problem()) return sentence;
    if (const auto found = watch_.check(mark())) return collapse_sentence(*found);
    return {};
}
std::optional<std::string> BareRun::problem_at_the_end() const {
    if (auto sentence = overlap_problem()) return sentence;
    if (const auto found = watch_.check_at_end(mark())) return collapse_sentence(*found);
    return {};
}

/// Rounding errors of places (docs/physics.md) must stay what they are called.
std::optional<std::string> BareRun::overlap_problem() const {
    constexpr double still_rounding = 1e-6;
    const double smallest =
        config_.mixture ? std::min(config_.radius, config_.mixture->radius) : config_.radius;
    if (result_.max_overlap <= still_rounding * smallest) return {};
    return fmt::format(
        "After {:.3f} swirls a disc is {:.2g} of the smallest radius deep in another or in the "
        "wall: "
        "rounding errors have grown too large for discs so small in a dish so wide or on a path so "
        "long. A smaller --container-radius or --amplitude, or fewer --events, would be right.",
        periods(), result_.max_overlap / smallest);
}

std::string BareRun::collapse_sentence(const Collapse& collapse) const {
    return fmt::format(
        "The last {} events took {:.2g} swirls, so time all but stands still after {:.3f} swirls: "
        "{}",
        collapse.events, collapse.periods, periods(), reason_for_collapse());
}

std::string BareRun::reason_for_collapse() const {
    if (config_.restitution < 1.0)
        return fmt::format(
            "with restitution {} the {}s collide ever faster (inelastic collapse). A longer "
            "--contact-duration than {} would keep them apart.",
            config_.restitution, body_word(config_), config_.contact_duration);
    return fmt::format(
        "friction has taken the energy out of the relative motion of {}s that lie pressed "
        "together, and they collide ever faster (a collapse; docs/physics.md). The model has "
        "no state after it. Another --seed than {} may "
        "not meet it.",
        body_word(config_), config_.seed);
}

/// The sample by event of the snapshot as it stands, unless it is taken: at the last moment,
/// when nobody has to wait for it to be written (cluster_rotation.hpp).
void BareRun::sample_by_event() {
    if (!rotation_is_sampled_) rotation().sample(snapshot_);
    rotation_is_sampled_ = true;
}

/// Closes the blocks of the period that has ended; then, perhaps, ends the warm-up, or the run.
void BareRun::begin_period() {
    sample_by_event();
    rotation().close_block();
    spin().close_block();
    if (observes()) observation_->close_block();
    if (!warm_ && warm_now()) {
        warm_ = true;
        result_.warmup = simulation_.periods();
        result_.warmup_events = simulation_.events();
    }
    if (complete()) events_to_look_ = 0;
}

/// At the end of a swirl: is the warm-up over?
bool BareRun::warm_now() {
    if (config_.warmup_found) return found_warm() || fraction() >= 0.5;
    if (config_.warmup) return simulation_.periods() >= *config_.warmup;
    return simulation_.periods() >= default_warmup || fraction() >= 0.2;
}

/// Asked ever more seldom: the answer takes time that grows with the number of swirls.
bool BareRun::found_warm() {
    if (simulation_.periods() < next_question_) return false;
    next_question_ += std::max<std::int64_t>(10, next_question_ / 10);
    return beginning_is_forgotten(in_warmup_.by_event().block_means()) &&
           beginning_is_forgotten(spin_in_warmup_.series().block_means());
}

SteadyState BareRun::steady_state_of(const BlockSeries& series) const {
    SteadyState state = find_steady_state(series.block_means());
    if (state.verdict != SteadyState::Verdict::too_short)
        state.period = static_cast<double>(result_.warmup) +
                       static_cast<double>(state.change.at * series.periods_per_block());
    return state;
}

RunResult BareRun::result() {
    sample_by_event();
    result_.complete = complete();
    result_.rotation = rotation().estimates();
    result_.steady = steady_state_of(rotation().by_event());
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
