#include "swirl/run/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "swirl/engine/continuation.hpp"
#include "swirl/io/file_error.hpp"
#include "swirl/io/state_archive.hpp"
#include "swirl/measure/observation.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/simd.hpp"

namespace swirl {
namespace {

constexpr std::chrono::milliseconds progress_interval(100);

/// A trajectory between two events.
struct Moment {
    Progress progress;
    std::vector<Disc> discs;

    static Moment of(const Simulation& simulation) {
        Moment m{simulation.progress(), {}};
        m.discs.reserve(simulation.size());
        for (std::size_t i = 0; i < simulation.size(); ++i) m.discs.push_back(simulation.disc(i));
        return m;
    }
    template <class Visitor>
    void fields(Visitor&& visit) {
        visit(progress.periods, progress.clock, progress.segment, progress.events);
        visit(discs);
    }
};

bool are_the_same_bodies(const std::vector<Disc>& a, const std::vector<Disc>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Disc& x, const Disc& y) {
        return x.radius == y.radius && x.mass == y.mass && x.inertia == y.inertia;
    });
}

/// The run at its beginning, or where the text of a state says.
BareRun begin(const RunConfig& config, const RunControl& control) {
    InitialState scene = make_initial_state(config, control.stop);
    Moment moment;
    if (control.resume) {
        StateReader read(*control.resume);
        read(moment);
        if (!are_the_same_bodies(moment.discs, scene.discs))
            throw FileError("The saved state is that of another run.");
        scene.discs = moment.discs;
        if (const char* const what = impossible_to_continue(scene, moment.progress))
            throw FileError(
                fmt::format("The saved state contradicts itself: it says that {}.", what));
    }
    BareRun run(config, scene, control.observation, moment.progress, asked_tuning(control.stop));
    if (control.stop && control.stop->load())
        throw Interrupted(control.resume
                              ? "Stopped before the run went on; its checkpoint is as it was."
                              : "Stopped before the first event.");
    return run;
}

void reject(const std::optional<std::string>& problem) {
    if (problem) throw Failure(*problem);
}

}  // namespace

Run::Run(const RunConfig& config, RunControl control)
    : config_(config), control_(std::move(control)), run_(begin(config, control_)) {
    if (control_.orientations) run_.follow_orientations();
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
    visit(seconds_before_);
    visit(run_);
    if (control_.observation) visit(*control_.observation);
}

void Run::write(StateWriter& state) {
    Moment moment = Moment::of(run_.simulation());
    state(moment);
    const double before = std::exchange(seconds_before_, seconds());
    fields(state);
    seconds_before_ = before;
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
            "it has made {:.1f} swirls and {} events, which is more than is asked for",
            run_.periods(), events);
    // The end of the warm-up may have followed from the length.
    if (!is_warm() || config_.warmup) return {};
    const double share = shorter.periods
                             ? double(run_.warmup()) / double(*shorter.periods)
                             : double(run_.warmup_events().total()) / double(shorter.events);
    if (config_.warmup_found ? share < 0.5 : run_.warmup() >= default_warmup) return {};
    return fmt::format(
        "it was so short that only {} swirls were left out as warm-up, and a longer run leaves out "
        "more; begin anew, or give --warmup in both calls",
        run_.warmup());
}

double Run::seconds() const {
    return seconds_before_ + std::chrono::duration<double>(Clock::now() - begin_).count();
}

bool Run::next_event() {
    if (run_.is_time_to_look() && !look_up()) return false;
    run_.find_event();
    return true;
}

/// Between two events, now and then: false if the run is complete, or is to stop.
bool Run::look_up() {
    const bool stopped = control_.stop && control_.stop->load(std::memory_order_relaxed);
    if (complete() || stopped) {
        reject(run_.problem_at_the_end());
        return false;
    }
    reject(run_.problem());
    const auto time = Clock::now();
    if (!control_.progress || time - last_report_ < progress_interval) return true;
    last_report_ = time;
    control_.progress({run_.fraction(), run_.simulation().events().total(), run_.periods()});
    return true;
}

RunResult Run::result() {
    if (!is_warm() && config_.warmup && complete())
        throw Failure(fmt::format(
            "The run ended after {:.1f} periods, inside its warm-up of --warmup {} periods; "
            "more --events or a shorter --warmup would be right.",
            run_.periods(), *config_.warmup));
    RunResult result = run_.result();
    result.seconds = seconds();
    return result;
}

RunResult run(const RunConfig& config, const RunControl& control) {
    Run run(config, control);
    while (run.next_event()) run.pass_event();
    return run.result();
}

}  // namespace swirl
