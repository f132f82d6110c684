#include "swirl/run/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "swirl/files/file_error.hpp"
#include "swirl/files/state_archive.hpp"
#include "swirl/measure/observation.hpp"
#include "swirl/run/budget.hpp"
#include "swirl/run/failure.hpp"

namespace swirl {
namespace {

/// Events between two looks at the clock and at the stop flag: an average by event looks at all
/// discs after each of them.
int events_between_looks(std::size_t discs) {
    constexpr std::size_t discs_looked_at = 1 << 22;
    return static_cast<int>(std::clamp<std::size_t>(discs_looked_at / discs, 1, 256));
}
constexpr std::chrono::milliseconds progress_interval(100);

constexpr std::uint64_t least_collapse_window = 500;

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

/// The simulation at its beginning, or where the text of a state says.
Simulation begin(const RunConfig& config, const std::optional<std::string>& state,
                 const std::atomic<bool>* stop) {
    InitialState scene = make_initial_state(config, stop);
    Moment moment;
    if (state) {
        StateReader read(*state);
        read(moment);
        if (moment.discs.size() != scene.discs.size() ||
            moment.progress.leg >= scene.path.legs.size())
            throw FileError("The saved state is that of another run.");
        scene.discs = moment.discs;
    }
    Simulation simulation(scene, moment.progress, stopped_by(stop));
    if (stop && stop->load())
        throw Interrupted(state ? "Stopped before the run went on; its checkpoint is as it was."
                                : "Stopped before the first event.");
    return simulation;
}

}  // namespace

Run::Run(const RunConfig& config, RunControl control)
    : config_(config),
      control_(std::move(control)),
      path_(make_path(config)),
      simulation_(begin(config, control_.resume, control_.stop)),
      snapshot_(simulation_.snapshot()),
      event_(),
      rotation_times_(sample_times(rotation_samples)),
      observation_times_(sample_times(samples_per_period)),
      events_to_look_up_(events_between_looks(simulation_.size())),
      mark_(now()),
      lately_{mark_, mark_},
      next_question_(least_blocks_of_a_steady_state),
      warm_(config.warmup == 0) {
    if (control_.orientations && snapshot_.are_spheres())
        snapshot_.turned.assign(snapshot_.size(), {});
    const Budget start = budget_of(snapshot());
    result_.config = config;
    result_.energy_at_start = start.energy;
    result_.invariant_at_start = start.invariant;
    if (!control_.resume) return;
    StateReader kept(*control_.resume);
    Moment moment;
    kept(moment);
    fields(kept);
    kept.expect_end();
}

/// What the run has gathered beside the moment it has reached.
template <class Visitor>
void Run::fields(Visitor&& visit) {
    visit(seconds_before_, warm_, rotation_times_, in_warmup_, after_warmup_);
    visit(result_.warmup, result_.warmup_events, result_.max_overlap);
    visit(result_.energy_at_start, result_.invariant_at_start);
    visit(spin_in_warmup_, spin_after_, next_question_);
    if (control_.orientations) visit(snapshot_.turned);
    if (control_.observation) visit(observation_times_, *control_.observation);
}

std::string Run::state() {
    sample_rotation_by_event();
    StateWriter state;
    Moment moment = Moment::of(simulation_);
    state(moment);
    const double before = std::exchange(seconds_before_, seconds());
    fields(state);
    seconds_before_ = before;
    return state.bytes();
}

bool Run::complete() const {
    if (config_.periods) return simulation_.swirls() >= *config_.periods;
    return simulation_.events().total() >= static_cast<std::uint64_t>(config_.events);
}
std::optional<std::string> Run::trouble_with_length(const RunConfig& shorter) const {
    const std::uint64_t events = simulation_.events().total();
    const bool is_past = config_.periods ? simulation_.swirls() > *config_.periods
                                         : events > static_cast<std::uint64_t>(config_.events);
    if (is_past)
        return fmt::format(
            "it has made {:.1f} swirls and {} events, which is more than is asked for", periods(),
            events);
    // The end of the warm-up may have followed from the length.
    if (!warm_ || config_.warmup) return {};
    const double share = shorter.periods
                             ? double(result_.warmup) / double(*shorter.periods)
                             : double(result_.warmup_events.total()) / double(shorter.events);
    if (config_.warmup_found ? share < 0.5 : result_.warmup >= default_warmup) return {};
    return fmt::format(
        "it was so short that only {} swirls were left out as warm-up, and a longer run leaves out "
        "more; begin anew, or give --warmup in both calls",
        result_.warmup);
}

double Run::seconds() const {
    return seconds_before_ + std::chrono::duration<double>(Clock::now() - begin_).count();
}
double Run::periods() const {
    return static_cast<double>(simulation_.swirls()) + simulation_.clock() / config_.period;
}
Run::Mark Run::now() const { return {simulation_.events().total(), periods()}; }
double Run::fraction() const {
    if (config_.periods) return periods() / static_cast<double>(*config_.periods);
    return static_cast<double>(simulation_.events().total()) / static_cast<double>(config_.events);
}

/// The snapshot holds the state before the event, and is sampled at all times that are due until
/// then.
bool Run::next_event() {
    if (complete()) {
        refuse_overlaps();
        refuse_collapse_lately();
        return false;
    }
    if (events_to_look_up_-- == 0 && !look_up()) return false;
    event_ = simulation_.step();
    sample_rotation_by_event();
    while (next_sample(rotation_times_)) {
        rotation().sample_by_time(snapshot_);
        spin().add(mean_spin(snapshot_));
    }
    if (observes())
        while (next_sample(observation_times_)) control_.observation->sample(snapshot());
    return true;
}

void Run::pass_event() {
    simulation_.refresh(snapshot_, event_);
    rotation().follow(snapshot_, event_);
    rotation_is_sampled_ = false;
    result_.max_overlap = std::max(result_.max_overlap, event_.overlap);
    if (observes()) control_.observation->sample(event_, snapshot());
    if (event_.kind == EventKind::path_vertex && simulation_.swirls() > event_.swirls)
        begin_period();
}

/// Between two events, now and then: false if the run is to stop.
bool Run::look_up() {
    events_to_look_up_ = events_between_looks(simulation_.size()) - 1;
    const bool stopped = control_.stop && control_.stop->load(std::memory_order_relaxed);
    refuse_overlaps();
    if (stopped) {
        refuse_collapse_lately();
        return false;
    }
    const Mark here = now();
    if (here.events - mark_.events >= collapse_window()) {
        refuse_collapse_since(mark_);
        mark_ = here;
    }
    if (here.events - lately_[1].events >= least_collapse_window) lately_ = {lately_[1], here};
    const auto time = Clock::now();
    if (!control_.progress || time - last_report_ < progress_interval) return true;
    last_report_ = time;
    control_.progress({fraction(), simulation_.events().total(), periods()});
    return true;
}

/// Rounding errors of places (docs/physics.md) must stay what they are called.
void Run::refuse_overlaps() const {
    constexpr double still_rounding = 1e-6;
    const double smallest =
        config_.mixture ? std::min(config_.radius, config_.mixture->radius) : config_.radius;
    if (result_.max_overlap <= still_rounding * smallest) return;
    throw Failure(fmt::format(
        "After {:.3f} swirls a disc is {:.2g} of the smallest radius deep in another or in the "
        "wall: "
        "rounding errors have grown too large for discs so small in a dish so wide or on a path so "
        "long. A smaller --container-radius or --amplitude, or fewer --events, would be right.",
        periods(), result_.max_overlap / smallest));
}

/// Collapse: infinitely many collisions in a finite time, by restitution or, with e = 1, by
/// friction alone (docs/physics.md). A disc of the paper's dish has about 70 events per swirl,
/// one that obeys a contact duration at most T/t_c.
void Run::refuse_collapse_since(const Mark& mark) const {
    constexpr double too_fast = 1e8;  // events per disc and swirl
    const auto [all, until_now] = now();
    const std::uint64_t events = all - mark.events;
    const double swirls = until_now - mark.periods;
    const double discs = static_cast<double>(simulation_.size());
    if (static_cast<double>(events) <= too_fast * discs * swirls) return;
    throw Failure(
        fmt::format("The last {} events took {:.2g} swirls, so time all but stands still after "
                    "{:.3f} swirls: {}",
                    events, swirls, until_now, reason_for_collapse()));
}

/// At the end, or when it is stopped: of the last few hundred events alone, for what was before
/// may have been as it should.
void Run::refuse_collapse_lately() const {
    for (const Mark& mark : {lately_[1], lately_[0]})
        if (now().events - mark.events >= least_collapse_window) return refuse_collapse_since(mark);
}

/// Some two hundred events for each disc: the two that collapse may be among thousands.
std::uint64_t Run::collapse_window() const {
    return std::max<std::uint64_t>(20'000, 200 * simulation_.size());
}

std::string Run::reason_for_collapse() const {
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

/// The sample by event of the snapshot as it stands, unless it is taken: at the last moment,
/// when nobody has to wait for it to be written (cluster_rotation.hpp).
void Run::sample_rotation_by_event() {
    if (!rotation_is_sampled_) rotation().sample(snapshot_);
    rotation_is_sampled_ = true;
}

/// Closes the blocks of the period that has ended; then, perhaps, ends the warm-up.
void Run::begin_period() {
    sample_rotation_by_event();
    rotation().close_block();
    spin().close_block();
    if (observes()) control_.observation->close_block();
    if (!warm_ && warm_now()) {
        warm_ = true;
        result_.warmup = simulation_.swirls();
        result_.warmup_events = simulation_.events();
    }
}

/// At the end of a swirl: is the warm-up over?
bool Run::warm_now() {
    if (config_.warmup_found) return found_warm() || fraction() >= 0.5;
    if (config_.warmup) return simulation_.swirls() >= *config_.warmup;
    return simulation_.swirls() >= default_warmup || fraction() >= 0.2;
}

/// Asked ever more seldom: the answer takes time that grows with the number of swirls.
bool Run::found_warm() {
    if (simulation_.swirls() < next_question_) return false;
    next_question_ += std::max<std::int64_t>(10, next_question_ / 10);
    return beginning_is_forgotten(in_warmup_.by_event().block_means()) &&
           beginning_is_forgotten(spin_in_warmup_.series().block_means());
}

RunResult Run::result() {
    result_.complete = complete();
    result_.seconds = seconds();
    sample_rotation_by_event();
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
    const Budget end = budget_of(snapshot());
    result_.energy = end.energy;
    result_.invariant = end.invariant;
    result_.state_hash = simulation_.state_hash();
    return result_;
}

RunResult run(const RunConfig& config, const RunControl& control) {
    Run run(config, control);
    while (run.next_event()) run.pass_event();
    return run.result();
}

}  // namespace swirl
