// swirl verify: runs again what a result says it is, and compares.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "swirl/cli/commands.hpp"
#include "swirl/cli/output.hpp"
#include "swirl/cli/progress_line.hpp"
#include "swirl/cli/stop_signal.hpp"
#include "swirl/cli/trial_reading.hpp"
#include "swirl/io/atomic_file.hpp"
#include "swirl/io/event_log.hpp"
#include "swirl/io/trajectory.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/json.hpp"
#include "swirl/run/measurements.hpp"
#include "swirl/run/recorded_run.hpp"
#include "swirl/run/run.hpp"
#include "swirl/run/simd.hpp"
#include "swirl/run/version.hpp"

namespace swirl {
namespace {

using Json = nlohmann::ordered_json;

RunConfig config_in(const std::string& file, const std::string& text) {
    try {
        return resolve(parameters_in(text));
    } catch (const UsageError& wrong) {
        throw Failure(
            fmt::format("'{}' cannot be run again with this version: {}", file, wrong.what()));
    }
}

std::string of_version(const std::string& other) {
    return other == version()
               ? std::string()
               : fmt::format(" It was made by swirl {}, this is {}.", other, version());
}

std::string made_by(const Json& result) {
    const Json by = result.value("version", Json());
    return by.is_string() ? by.get<std::string>() : "?";
}

/// What says how, when and by whom a result was made, and not what it is.
bool is_of_the_call(const std::string& name) {
    for (const char* other :
         {"format", "seconds", "events_per_second", "simd", "warnings", "version", "build"})
        if (name == other) return true;
    return false;
}

/// Runs again to the end, or until `look`, which passes one event after the other, has seen enough.
template <class Look>
RunResult run_again(const RunConfig& config, bool quiet, const Look& look,
                    Observation* observation = nullptr) {
    ProgressLine line("again", quiet);
    RunControl control;
    control.stop = &stop_signal();
    control.orientations = true;
    control.observation = observation;
    control.progress = [&](const RunProgress& p) {
        line.show(p.fraction, fmt::format("{} events", p.events));
    };
    Run run(config, control);
    while (run.next_event() && look(run)) {
    }
    line.clear();
    if (stop_signal().load()) throw Interrupted("Stopped before the end of the run.");
    return run.result();
}

/// What was measured beside the rotation.
std::vector<std::string> measurements_in(const std::string& file, const Json& result) {
    const Json measured = result.value("measured", Json::object());
    if (!measured.is_object())
        throw Failure(fmt::format("'{}' does not say what was measured.", file));
    std::vector<std::string> names;
    for (const auto& [name, values] : measured.items()) names.push_back(name);
    return names;
}

void verify_result(const std::string& file, bool quiet) {
    const Json json = Json::parse(read_regular_file(file), nullptr, false);
    if (!json.is_object() || !json.contains("config") || !json.contains("state_hash"))
        throw Failure(fmt::format("'{}' is not the result of a run.", file));
    if (const Json format = json.value("format", Json(result_format)); format != result_format)
        throw Failure(
            fmt::format("'{}' is in format {} of swirl {}, but this program reads format {}.", file,
                        format.dump(), made_by(json), result_format));
    if (json.value("complete", Json()) != Json(true))
        throw Failure(fmt::format(
            "'{}' is of a run that was stopped before its end, and cannot be compared.", file));
    const RunConfig config = config_in(file, json["config"].dump());
    Observation observation = observation_of(config, measurements_in(file, json));
    Json result = result_json(run_again(
        config, quiet,
        [](Run& run) {
            run.pass_event();
            return true;
        },
        &observation));
    if (json.contains("measured")) result["measured"] = measured_json(observation.report());
    // The verdict on the steady state follows from the averages by a test that may be another in
    // another version of the program.
    const bool judged_alike = json.value("version", Json()) == Json(version());
    for (const auto& [part, now] : result.items())
        if (!is_of_the_call(part) && (part != "steady_state" || judged_alike) &&
            json.value(part, Json()) != Json::parse(now.dump()))
            throw Failure(fmt::format("'{}' differs: {} is {} there and {} now.{}", file, part,
                                      json.value(part, Json()).dump(), now.dump(),
                                      of_version(made_by(json))));
    if (quiet) return;
    const auto& measured = observation.names();
    print_all(fmt::format("The same, bit for bit: {} events, state {}, {}.{}\n",
                          result["events"]["total"].dump(), result["state_hash"].get<std::string>(),
                          measured.empty() ? "no measurements in the file"
                                           : fmt::format("measured {}", fmt::join(measured, ", ")),
                          judged_alike ? ""
                                       : fmt::format(" Not compared: steady_state, as '{}' was "
                                                     "made by swirl {}.",
                                                     file, made_by(json))));
}

bool same_bits(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}
bool same_bits(Vec2 a, Vec2 b) { return same_bits(a.x, b.x) && same_bits(a.y, b.y); }

/// A frame as it was recorded and a moment of the run: everything that a frame consists of.
bool same_frame(const Snapshot& frame, const Snapshot& now) {
    bool same = frame.size() == now.size() && frame.periods == now.periods &&
                same_bits(frame.clock, now.clock) && same_bits(frame.period, now.period) &&
                same_bits(frame.container_radius, now.container_radius) &&
                same_bits(frame.container_centre, now.container_centre) &&
                same_bits(frame.container_velocity, now.container_velocity);
    for (std::size_t i = 0; same && i < now.size(); ++i)
        same = same_bits({frame.x[i], frame.y[i]}, now.position(i)) &&
               same_bits({frame.vx[i], frame.vy[i]}, {now.vx[i], now.vy[i]}) &&
               same_bits(frame.angle[i], now.orientation(i)) &&
               same_bits(frame.spin[i], now.spin[i]) && same_bits(frame.radius[i], now.radius[i]) &&
               same_bits(frame.mass[i], now.mass[i]) && same_bits(frame.inertia[i], now.inertia[i]);
    if (frame.are_spheres() != now.are_spheres() || frame.on_floor != now.on_floor ||
        frame.lie_flat != now.lie_flat)
        return false;
    for (std::size_t i = 0; same && now.are_spheres() && i < now.size(); ++i) {
        const Quaternion &a = frame.turned[i], &b = now.turned[i];
        same = same_bits({frame.spin_x[i], frame.spin_y[i]}, {now.spin_x[i], now.spin_y[i]}) &&
               same_bits({a.w, a.x}, {b.w, b.x}) && same_bits({a.y, a.z}, {b.y, b.z});
    }
    return same;
}

/// How a recording is compared with the run that it says it is of.
class Comparison {
  public:
    Comparison(std::string file, const char* what, std::uint64_t there, bool complete,
               std::string made_by)
        : file_(std::move(file)),
          what_(what),
          there_(there),
          complete_(complete),
          made_by_(std::move(made_by)) {}

    std::uint64_t next() const { return next_; }
    /// Of an unfinished recording the run may have more.
    bool expects_more() const { return next_ < there_ || complete_; }

    void found(bool same, std::string_view how) {
        if (next_ >= there_) reject(fmt::format("it ends there, but the run has more {}s", what_));
        if (!same) reject(how);
        ++next_;
    }
    [[noreturn]] void reject(std::string_view how) const {
        throw Failure(fmt::format("'{}' differs from {} {} on: {}.{}", file_, what_, next_, how,
                                  of_version(made_by_)));
    }
    void report(bool quiet) const {
        if (next_ < there_) reject(fmt::format("the run has no more than {}", next_));
        if (quiet) return;
        print_all(complete_ ? fmt::format("The same, bit for bit: {} {}s.\n", next_, what_)
                            : fmt::format(
                                  "The same, bit for bit, as far as it goes: {} {}s of a run that "
                                  "was not finished.\n",
                                  next_, what_));
    }

  private:
    std::string file_;
    const char* what_;
    std::uint64_t there_, next_ = 0;
    bool complete_;
    std::string made_by_;
};

/// When its frames were taken, as the recording says.
FrameTimes frame_times_in(const std::string& file, const std::string& text) {
    const Json json = Json::parse(text, nullptr, false);
    FrameTimes times;
    try {
        if (json.contains("events"))
            times.events = json.at("events").get<std::int64_t>();
        else if (json.contains("interval"))
            times.interval = json.at("interval").get<double>();
        else
            times.per_swirl = json.at("per_swirl").get<int>();
    } catch (const nlohmann::json::exception&) {
        throw Failure(fmt::format(
            "'{}' does not say when its frames were taken, so nobody knows how many there must be.",
            file));
    }
    if (times.events.value_or(1) < 1 || !(times.interval.value_or(1.0) > 0.0) ||
        times.per_swirl < 1)
        throw Failure(fmt::format("'{}' says that no time lies between its frames.", file));
    return times;
}

/// Every frame against the engine's state at that moment.
void verify_trajectory(const std::string& file, bool quiet) {
    TrajectoryReader reader(file);
    const RunConfig config = config_in(file, reader.provenance("parameters"));
    const FrameTimes times = frame_times_in(file, reader.provenance("frames"));
    Comparison comparison(file, "frame", reader.frames(), reader.complete(),
                          reader.provenance("version"));
    std::uint64_t events = 0;
    const auto compare = [&](const Snapshot& now) {
        if (!comparison.expects_more()) return;
        const std::uint64_t k = comparison.next();
        comparison.found(k < reader.frames() && same_frame(reader.frame(k), now) &&
                             reader.events_before(k) == events,
                         "the run has another one");
    };
    SampleTimes frame_times(times.per_swirl, config.period, times.interval.value_or(0.0));
    run_again(config, quiet, [&](Run& run) {
        if (!times.events)
            while (run.next_sample(frame_times)) compare(run.snapshot());
        run.pass_event();
        ++events;
        if (times.events && events % std::uint64_t(*times.events) == 0) compare(run.snapshot());
        return comparison.expects_more();
    });
    if (const std::string column = reader.contradicted(); !column.empty())
        throw Failure(fmt::format("'{}' differs from its run: its column {} is another.{}", file,
                                  column, of_version(reader.provenance("version"))));
    comparison.report(quiet);
}

bool same_events(const Event& a, const Event& b) {
    return a.periods == b.periods && same_bits(a.clock, b.clock) && a.kind == b.kind &&
           a.i == b.i && a.j == b.j && same_bits(a.normal, b.normal) &&
           same_bits(a.impulse.normal, b.impulse.normal) &&
           same_bits(a.impulse.tangential, b.impulse.tangential) &&
           same_bits(a.impulse.vertical, b.impulse.vertical) &&
           a.impulse.sticks == b.impulse.sticks;
}

bool same_discs(const Disc& a, const Disc& b) {
    return same_bits(a.position, b.position) && same_bits(a.velocity, b.velocity) &&
           same_bits(a.angle, b.angle) && same_bits(a.spin, b.spin) && same_bits(a.time, b.time) &&
           same_bits(a.radius, b.radius) && same_bits(a.mass, b.mass) &&
           same_bits(a.inertia, b.inertia) && same_bits(a.rolling_spin, b.rolling_spin);
}

bool same_floors(const MovingFloor& a, const MovingFloor& b) {
    return same_bits(a.floor.deceleration, b.floor.deceleration) &&
           a.floor.bodies_lie_flat == b.floor.bodies_lie_flat &&
           std::equal(a.velocity.begin(), a.velocity.end(), b.velocity.begin(), b.velocity.end(),
                      [](const Vec2& u, const Vec2& v) { return same_bits(u, v); });
}

/// What the log says of the run before its first event.
void verify_beginning(const EventLogReader& log, const InitialState& scene,
                      const Simulation& simulation, const Comparison& comparison) {
    if (log.initial().size() != simulation.size()) comparison.reject("another number of discs");
    for (std::size_t i = 0; i < simulation.size(); ++i)
        if (!same_discs(log.initial()[i], simulation.disc(i)))
            comparison.reject(fmt::format("disc {} begins otherwise", i));
    if (!same_bits(log.period(), scene.path.period) ||
        !same_bits(log.swirl_end(), scene.path.segments.back().end) ||
        !same_bits(log.container_radius(), scene.container_radius))
        comparison.reject("the container is another");
    const bool has_floor = scene.shape != Shape::disc;
    if (log.floor().has_value() != has_floor ||
        (has_floor && !same_floors(*log.floor(), moving_floor(scene.floor, scene.path))))
        comparison.reject("the floor, or its velocity on a leg of the path, is another");
}

/// Every event against the engine's, and the state that they lead to against its state.
void verify_event_log(const std::string& file, bool quiet) {
    EventLogReader log(file);
    const RunConfig config = config_in(file, log.provenance("parameters"));
    Comparison comparison(file, "event", log.events(), log.complete(), log.provenance("version"));
    const InitialState scene = make_initial_state(config, &stop_signal());
    Simulation simulation(scene, {}, selected_tuning(&stop_signal()));
    if (stop_signal().load()) throw Interrupted("Stopped before the first event.");
    verify_beginning(log, scene, simulation, comparison);
    Replay replay(log.initial(), log.swirl_end(), log.floor());
    constexpr std::uint64_t at_once = 1 << 16;
    std::vector<Event> block;
    run_again(config, quiet, [&](Run& run) {
        run.pass_event();
        const Event& now = run.event();
        if (!comparison.expects_more()) return false;
        const std::uint64_t k = comparison.next();
        if (k < log.events() && k % at_once == 0)
            block = log.read(k, std::min(at_once, log.events() - k));
        const bool same = k < log.events() && same_events(block[k % at_once], now);
        comparison.found(same, "another event happens now");
        simulation.step();
        replay.apply(now);
        return true;
    });
    for (std::size_t i = 0; i < simulation.size(); ++i)
        if (!same_discs(replay.discs()[i], simulation.disc(i)))
            comparison.reject("the state that the events lead to is another");
    comparison.report(quiet);
}

void add_verify_command(Subcommand& subcommand) {
    struct Verify {
        std::string file;
        bool quiet = false;
    };
    const auto call = std::make_shared<Verify>();
    subcommand
        .add_option("file", call->file, "a result (JSON), a trajectory or an event log (HDF5)")
        ->type_name("FILE")
        ->required();
    subcommand.add_flag("--quiet", call->quiet, "no progress, no report");
    subcommand.set_examples({"swirl verify result.json", "swirl verify frames.h5"});
    subcommand.callback([call] {
        if (!first_bytes(call->file).starts_with('\x89'))
            return verify_result(call->file, call->quiet);
        try_reading(call->file);
        if (is_event_log(call->file)) return verify_event_log(call->file, call->quiet);
        verify_trajectory(call->file, call->quiet);
    });
}

const Command verify_command(42, "verify", "Runs a result again and compares every bit.",
                             add_verify_command);

}  // namespace
}  // namespace swirl
