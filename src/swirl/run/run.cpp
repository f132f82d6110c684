#include "swirl/run/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "swirl/engine/validate.hpp"
#include "swirl/io/file_error.hpp"
#include "swirl/io/state_archive.hpp"
#include "swirl/measure/observation.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/period_series.hpp"
#include "swirl/run/ramp.hpp"
#include "swirl/run/reading.hpp"
#include "swirl/run/simd.hpp"

namespace swirl {
namespace {

constexpr std::chrono::milliseconds progress_interval(100);

std::vector<Disc> discs_of(const Simulation& simulation) {
    std::vector<Disc> discs;
    discs.reserve(simulation.size());
    for (std::size_t i = 0; i < simulation.size(); ++i) discs.push_back(simulation.disc(i));
    return discs;
}

/// The state of a trajectory between two events.
struct SavedTrajectory {
    Progress progress;
    std::vector<Disc> discs;

    static SavedTrajectory of(const Simulation& simulation) {
        return {simulation.progress(), discs_of(simulation)};
    }
    void fields(auto&& visit) {
        visit(progress.periods, progress.clock, progress.segment, progress.events);
        visit(discs);
    }
};

bool have_equal_bodies(const std::vector<Disc>& a, const std::vector<Disc>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Disc& x, const Disc& y) {
        return x.radius == y.radius && x.mass == y.mass && x.inertia == y.inertia &&
               x.can_spin == y.can_spin;
    });
}

/// Replaces random positions by the final state of another run.
void begin_from(const FinalState& state, InitialState& initial) {
    if (!have_equal_bodies(state.discs, initial.discs))
        throw FileError("the state to start from belongs to another run.");
    initial.discs = state.discs;
    shift_discs(initial.discs, initial.path.segments.front().start - state.container_centre);
    if (const auto problem = validate(initial))
        throw FileError("the state to start from is inconsistent: " + *problem);
}

/// The run in its initial state, or in the state to resume from.
CoreRun begin(const RunConfig& config, const RunControl& control) {
    InitialState initial = make_initial_state(config, control.stop);
    SavedTrajectory saved;
    if (control.begin_from && !control.resume) begin_from(*control.begin_from, initial);
    if (control.resume) {
        StateReader read(*control.resume);
        read(saved);
        if (!have_equal_bodies(saved.discs, initial.discs))
            throw FileError("the saved state belongs to another run.");
        if (!config.ramps.empty()) initial = surroundings_in(config, saved.progress.periods);
        initial.discs = saved.discs;
        if (const auto problem = validate(initial, saved.progress))
            throw FileError("the saved state is inconsistent: " + *problem);
    }
    CoreRun run(config, initial, control.observation, saved.progress,
                selected_tuning(control.stop));
    run.add_periods_to(control.series);
    if (control.stop && control.stop->load())
        throw Interrupted(control.resume
                              ? "stopped before the run continued; its checkpoint is unchanged."
                              : "stopped before the first event.");
    return run;
}

void throw_if(const std::optional<std::string>& problem) {
    if (problem) throw Failure(*problem);
}

}  // namespace

Run::Run(const RunConfig& config, RunControl control)
    : config_(config), control_(std::move(control)), run_(begin(config, control_)) {
    if (control_.orientations) run_.follow_orientations();
    if (!control_.resume) return;
    StateReader state(*control_.resume);
    SavedTrajectory saved;
    state(saved);
    fields(state);
    state.expect_end();
}

/// The accumulated data, without the state of the trajectory.
template <class Visitor>
void Run::fields(Visitor&& visit) {
    visit(seconds_before_);
    visit(run_);
    if (control_.observation) visit(*control_.observation);
    if (control_.series) visit(*control_.series);
}

void Run::write(StateWriter& state) {
    SavedTrajectory saved = SavedTrajectory::of(run_.simulation());
    state(saved);
    const double before = std::exchange(seconds_before_, seconds());
    fields(state);
    seconds_before_ = before;
}

FinalState Run::final_state() const {
    return {run_.path().segments.front().start, discs_of(run_.simulation())};
}

std::string Run::state() {
    StateWriter state;
    write(state);
    return std::move(state).bytes();
}

std::optional<std::string> Run::problem_with_length(const RunConfig& shorter) const {
    const Simulation& simulation = run_.simulation();
    const std::uint64_t events = simulation.events().total();
    const bool is_past = config_.periods ? simulation.periods() > *config_.periods
                                         : events > static_cast<std::uint64_t>(config_.events);
    if (is_past)
        return fmt::format(
            "it has already simulated {:.1f} periods and {} events, more than requested",
            run_.periods(), events);
    // The end of the warm-up may depend on the length of the run.
    if (!is_warm() || config_.warmup) return {};
    const double share = shorter.periods
                             ? double(run_.warmup()) / double(*shorter.periods)
                             : double(run_.warmup_events().total()) / double(shorter.events);
    if (config_.warmup_found ? share < 0.5 : run_.warmup() >= default_warmup) return {};
    return fmt::format(
        "its warm-up was shortened to {}, and a longer run has a longer warm-up.\nhint: start "
        "again, or use --warmup in both calls",
        counted(run_.warmup(), "period"));
}

double Run::seconds() const {
    return seconds_before_ + std::chrono::duration<double>(Clock::now() - begin_).count();
}

bool Run::next_event() {
    if (run_.is_check_due() && !check_progress()) return false;
    run_.execute_event();
    return true;
}

std::uint64_t Run::execute_events() {
    if (run_.is_check_due() && !check_progress()) return 0;
    return run_.execute_events();
}

/// Called occasionally between two events. Returns false if the run is complete or must stop.
bool Run::check_progress() {
    const bool stopped = control_.stop && control_.stop->load(std::memory_order_relaxed);
    if (complete() || stopped) {
        throw_if(run_.problem_at_the_end());
        return false;
    }
    throw_if(run_.problem());
    const auto time = Clock::now();
    if (!control_.progress || time - last_report_ < progress_interval) return true;
    last_report_ = time;
    control_.progress({run_.fraction(), run_.simulation().events().total(), run_.periods()});
    return true;
}

RunResult Run::result() {
    if (!is_warm() && config_.warmup && complete())
        throw Failure(fmt::format(
            "the run ended after {:.1f} periods, within the warm-up of --warmup {} periods.\nhint: "
            "use more --events or a shorter --warmup.",
            run_.periods(), *config_.warmup));
    RunResult result = run_.result();
    result.seconds = seconds();
    return result;
}

RunResult run(const RunConfig& config, const RunControl& control) {
    Run run(config, control);
    while (run.execute_events() > 0) {
    }
    return run.result();
}

}  // namespace swirl
