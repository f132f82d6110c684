// swirl verify: repeats the run of a result or a recording and compares all bits.
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
#include "swirl/io/checksum.hpp"
#include "swirl/io/event_log.hpp"
#include "swirl/io/recording.hpp"
#include "swirl/io/trajectory.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/json.hpp"
#include "swirl/run/measurements.hpp"
#include "swirl/run/parse_json.hpp"
#include "swirl/run/reading.hpp"
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
        throw Failure(fmt::format("the run of '{}' cannot be repeated with this version: {}", file,
                                  wrong.what()));
    }
}

/// A second line for an error message, if another version made the file.
std::string version_note(const std::string& other) {
    return other == version()
               ? std::string()
               : fmt::format("\nhint: it was made by swirl {}, but this is {}.", other, version());
}

std::string version_of(const Json& result) {
    const Json by = result.value("version", Json());
    return by.is_string() ? by.get<std::string>() : "?";
}

/// Repeats a run. `pass_event` passes each event and returns false to end the run early.
RunResult repeat_run(const RunConfig& config, bool quiet, const auto& pass_event,
                     RunControl control = {}) {
    ProgressLine line("verifying", quiet);
    control.stop = &stop_signal();
    control.orientations = true;
    control.progress = [&](const RunProgress& p) {
        line.show(p.fraction, fmt::format("{} events", p.events));
    };
    Run run(config, control);
    while (run.next_event() && pass_event(run)) {
    }
    line.clear();
    if (stop_signal().load()) throw Interrupted("stopped before the end of the run.");
    return run.result();
}

/// The names of the measurements in a result.
std::vector<std::string> measurements_in(const std::string& file, const Json& result) {
    const Json measured = result.value("measured", Json::object());
    if (!measured.is_object())
        throw Failure(fmt::format("'{}' has an entry 'measured' that is not an object.", file));
    std::vector<std::string> names;
    for (const auto& [name, values] : measured.items()) names.push_back(name);
    return names;
}

/// The result in a file, if it can be verified.
Json verifiable_result(const std::string& file) {
    std::string repeated;
    const Json json = parse_json(read_regular_file(file), repeated);
    if (!json.is_object() || !json.contains("config") || !json.contains("state_hash"))
        throw Failure(fmt::format("'{}' is not the result of a run.", file));
    if (!repeated.empty()) throw Failure(fmt::format("'{}' holds '{}' twice.", file, repeated));
    if (const Json format = json.value("format", Json(1)); format != result_format)
        throw Failure(
            fmt::format("'{}' has format {} of swirl {}, but this program reads format {}.", file,
                        format.dump(), version_of(json), result_format));
    if (json.value("complete", Json()) != Json(true))
        throw Failure(
            fmt::format("'{}' cannot be verified: its run was stopped before its end.", file));
    if (json.contains("started_from") && !json["started_from"].is_null())
        throw Failure(fmt::format(
            "'{}' cannot be verified: its run started from the end of another one.\nhint: "
            "repeat the sweep in another folder and compare the tables.",
            file));
    return json;
}

/// The result of the repeated run, with all entries that the file of such a result has.
Json repeated_result(const std::string& file, const Json& json, bool quiet) {
    const RunConfig config = config_in(file, json["config"].dump());
    const std::vector<std::string> measured = measurements_in(file, json);
    Observation observation = observation_of(config, measured);
    RunControl control;
    control.observation = &observation;
    std::optional<PeriodSeries> series;
    if (json.contains("series") || json.contains("series_checksum"))
        control.series = &series.emplace(config, measured);
    RunResult run = repeat_run(
        config, quiet,
        [](Run& passed) {
            passed.pass_event();
            return true;
        },
        control);
    // The number of events per second follows from the seconds, which only the file knows.
    const Json seconds = json.value("seconds", Json());
    run.seconds = seconds.is_number() ? seconds.get<double>() : -1.0;
    Json result = result_json(run);
    // Older versions wrote no format number (result.hpp) and no units.
    for (const char* key : {"format", "units"})
        if (version_of(json) != version() && !json.contains(key)) result.erase(key);
    result["command"] = "";
    if (json.contains("point")) {  // a result of a sweep
        result["point"] = 0;
        result["replicate"] = 0;
        if (json.contains("direction")) {
            result["direction"] = "";
            result["started_from"] = nullptr;
        }
    } else {
        result["config_text"] = "";
    }
    if (json.contains("measured")) result["measured"] = measured_json(observation.report());
    if (json.contains("series_checksum"))
        result["series_checksum"] =
            fmt::format("{:016x}", checksum(series->header() + series->rows()));
    if (json.contains("series")) {
        result["series"] = series_json(*series);
        if (json["series"].contains("file")) result["series"]["file"] = "";
    }
    return result;
}

/// Takes over from the file what a repeated run cannot give, if it has the right type. Returns the
/// names of these entries.
std::vector<std::string> take_unverifiable(const Json& json, Json& result) {
    std::vector<std::string> names;
    const auto take = [&](const char* name) {
        const Json::json_pointer path(name);
        if (!json.contains(path) || !result.contains(path)) return;
        const Json &there = json[path], &now = result[path];
        if (there.type() != now.type() && !(there.is_number_integer() && now.is_number_integer()))
            return;
        names.push_back(path == Json::json_pointer("/series/file") ? "series.file" : name + 1);
        result[path] = there;
    };
    for (const char* name :
         {"/command", "/config_text", "/point", "/replicate", "/direction", "/series/file"})
        take(name);
    std::vector<const char*> compared{"/version", "/build", "/simd"};
    // These follow from the averages, but by rules that may differ between versions.
    if (json.value("version", Json()) != result["version"])
        compared.insert(compared.end(), {"/steady_state", "/warnings"});
    for (const char* name : compared)
        if (const Json::json_pointer path(name); json.value(path, Json()) != result[path])
            take(name);
    names.push_back("seconds");
    return names;
}

void verify_result(const std::string& file, bool quiet) {
    const Json json = verifiable_result(file);
    Json result = repeated_result(file, json, quiet);
    const std::vector<std::string> unverifiable = take_unverifiable(json, result);
    const auto fail = [&](const std::string& part, const std::string& difference) {
        throw Failure(fmt::format("'{}' differs: {} {}.{}", file, part, difference,
                                  version_note(version_of(json))));
    };
    for (const auto& [part, now] : result.items())
        if (!json.contains(part) || json[part] != Json::parse(now.dump()))
            fail(part, fmt::format("is {} there, but {} now", json.value(part, Json()).dump(),
                                   now.dump()));
    for (const auto& [part, there] : json.items())
        if (!result.contains(part)) fail(part, "is not an entry of a result");
    if (quiet) return;
    const std::vector<std::string> measured = measurements_in(file, json);
    print_all(fmt::format("bitwise identical: {} events, state {}, {}\nnot verifiable: {}{}\n",
                          result["events"]["total"].dump(), result["state_hash"].get<std::string>(),
                          measured.empty() ? "no measurements in the file"
                                           : fmt::format("measured {}", fmt::join(measured, ", ")),
                          fmt::join(unverifiable, ", "),
                          version_note(version_of(json)).empty()
                              ? ""
                              : fmt::format(" (made by swirl {})", version_of(json))));
}

bool same_bits(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}
bool same_bits(Vec2 a, Vec2 b) { return same_bits(a.x, b.x) && same_bits(a.y, b.y); }

/// Compares all values of a recorded frame with the state of the run.
bool same_frame(const Snapshot& frame, const Snapshot& now) {
    bool same = frame.size() == now.size() && frame.periods == now.periods &&
                frame.can_spin == now.can_spin && same_bits(frame.clock, now.clock) &&
                same_bits(frame.period, now.period) &&
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

/// Compares the texts of a recording on its run. Returns the names of those that a repeated run
/// cannot give. `verified`: the name of a text that the comparison of the frames confirms.
std::string verify_provenance(const std::string& file, auto& recording, const RunConfig& config,
                              const std::string& verified = "") {
    std::vector<std::string> unverifiable;
    const std::string by = recording.provenance("version");
    for (const auto& [name, now] : provenance_of(config, "", "")) {
        const std::string there = recording.provenance(name);
        const bool is_known = name != "command" && name != "config";
        if (is_known && there == now) continue;
        // Names and defaults of parameters may differ between versions.
        const bool may_differ = name == "command"
                                    ? !there.empty()
                                    : name == "config" || name == "version" || name == "build" ||
                                          (name == "parameters" && by != version());
        if (!may_differ)
            throw Failure(
                fmt::format("'{}' differs from its run: {} is '{}' there, but '{}' now.{}", file,
                            name, there, now, version_note(by)));
        unverifiable.push_back(name);
    }
    // The name of the run contains what it measured; an event log has no frames.
    for (const std::string& name : {std::string(run_entry), std::string("frames")})
        if (name != verified && !recording.provenance(name).empty()) unverifiable.push_back(name);
    return fmt::format("not verifiable: {}\n", fmt::join(unverifiable, ", "));
}

/// Compares the frames or events (`item`) of a recording with those of its run, and counts them.
class Comparison {
  public:
    Comparison(std::string file, const char* item, std::uint64_t recorded, bool complete,
               std::string version)
        : file_(std::move(file)),
          item_(item),
          recorded_(recorded),
          complete_(complete),
          version_(std::move(version)) {}

    std::uint64_t next() const { return next_; }
    /// An unfinished recording ends before its run.
    bool expects_more() const { return next_ < recorded_ || complete_; }

    /// Takes the next item of the run. Throws Failure if it differs from the recorded one.
    void add(bool same, std::string_view difference) {
        if (next_ >= recorded_) fail(fmt::format("it ends there, but the run has more {}s", item_));
        if (!same) fail(difference);
        ++next_;
    }
    [[noreturn]] void fail(std::string_view difference) const {
        throw Failure(fmt::format("'{}' differs from {} {} on: {}.{}", file_, item_, next_,
                                  difference, version_note(version_)));
    }
    void report(bool quiet, const std::string& remark) const {
        if (next_ < recorded_)
            fail(fmt::format("the run has only {}", counted(std::int64_t(next_), item_)));
        if (quiet) return;
        print_all(
            complete_
                ? fmt::format("bitwise identical: {}\n", counted(std::int64_t(next_), item_))
                : fmt::format("bitwise identical: {}, all that an unfinished run has recorded\n",
                              counted(std::int64_t(next_), item_)));
        print_all(remark);
    }

  private:
    std::string file_;
    const char* item_;
    std::uint64_t recorded_, next_ = 0;
    bool complete_;
    std::string version_;
};

/// The frame times that the provenance entry `frames` of a recording gives.
FrameTimes frame_times_in(const std::string& file, const std::string& text) {
    const Json json = parse_json(text);
    FrameTimes times;
    try {
        if (json.contains("events"))
            times.events = json.at("events").get<std::int64_t>();
        else if (json.contains("interval"))
            times.interval = json.at("interval").get<double>();
        else
            times.per_period = json.at("per_swirl").get<int>();
    } catch (const nlohmann::json::exception&) {
        throw Failure(fmt::format(
            "'{}' cannot be verified: it does not store the times of its frames.", file));
    }
    if (times.events.value_or(1) < 1 || !(times.interval.value_or(1.0) > 0.0) ||
        times.per_period < 1)
        throw Failure(fmt::format("'{}' gives a frame interval that is not positive.", file));
    return times;
}

/// Compares every frame with the engine's state at its time.
void verify_trajectory(const std::string& file, bool quiet) {
    TrajectoryReader reader(file);
    const RunConfig config = config_in(file, reader.provenance("parameters"));
    const std::string frames = reader.provenance("frames");
    const FrameTimes times = frame_times_in(file, frames);
    RunFiles files;
    files.trajectory = file;
    files.frames = times;
    const bool says_only_times = frames == frames_entry(files);
    const std::string remark =
        verify_provenance(file, reader, config, says_only_times ? "frames" : "");
    Comparison comparison(file, "frame", reader.frames(), reader.complete(),
                          reader.provenance("version"));
    std::uint64_t events = 0;
    const auto compare = [&](const Snapshot& now) {
        if (!comparison.expects_more()) return;
        const std::uint64_t k = comparison.next();
        comparison.add(k < reader.frames() && same_frame(reader.frame(k), now) &&
                           reader.events_before(k) == events,
                       "the run has another frame");
    };
    SampleTimes frame_times(times.per_period, config.period, times.interval.value_or(0.0));
    repeat_run(config, quiet, [&](Run& run) {
        if (!times.events)
            while (run.next_sample(frame_times)) compare(run.snapshot());
        run.pass_event();
        ++events;
        if (times.events && events % std::uint64_t(*times.events) == 0) compare(run.snapshot());
        return comparison.expects_more();
    });
    if (const std::string column = reader.inconsistent_dataset(); !column.empty())
        throw Failure(fmt::format("'{}' differs from its run in its dataset {}.{}", file, column,
                                  version_note(reader.provenance("version"))));
    comparison.report(quiet, remark);
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
           same_bits(a.inertia, b.inertia) && same_bits(a.rolling_spin, b.rolling_spin) &&
           a.can_spin == b.can_spin;
}

bool same_floors(const MovingFloor& a, const MovingFloor& b) {
    return same_bits(a.floor.deceleration, b.floor.deceleration) &&
           a.floor.bodies_lie_flat == b.floor.bodies_lie_flat &&
           std::equal(a.velocity.begin(), a.velocity.end(), b.velocity.begin(), b.velocity.end(),
                      [](const Vec2& u, const Vec2& v) { return same_bits(u, v); });
}

/// Compares the initial state, the container and the floor.
void verify_initial_state(const EventLogReader& log, const InitialState& scene,
                          const Simulation& simulation, const Comparison& comparison) {
    if (log.initial().size() != simulation.size()) comparison.fail("the number of discs differs");
    for (std::size_t i = 0; i < simulation.size(); ++i)
        if (!same_discs(log.initial()[i], simulation.disc(i)))
            comparison.fail(fmt::format("the initial state of disc {} differs", i));
    if (!same_bits(log.period(), scene.path.period) ||
        !same_bits(log.period_end(), scene.path.segments.back().end) ||
        !same_bits(log.container_radius(), scene.container_radius))
        comparison.fail("the container differs");
    const bool has_floor = scene.shape != Shape::disc;
    if (log.floor().has_value() != has_floor ||
        (has_floor && !same_floors(*log.floor(), moving_floor(scene.floor, scene.path))))
        comparison.fail("the floor, or its velocity on a path segment, differs");
}

/// Compares every event with the engine's, and the replayed final state with the engine's state.
void verify_event_log(const std::string& file, bool quiet) {
    EventLogReader log(file);
    const RunConfig config = config_in(file, log.provenance("parameters"));
    const std::string remark = verify_provenance(file, log, config);
    Comparison comparison(file, "event", log.events(), log.complete(), log.provenance("version"));
    const InitialState scene = make_initial_state(config, &stop_signal());
    Simulation simulation(scene, {}, selected_tuning(&stop_signal()));
    if (stop_signal().load()) throw Interrupted("stopped before the first event.");
    verify_initial_state(log, scene, simulation, comparison);
    Replay replay(log.initial(), log.period_end(), log.floor());
    constexpr std::uint64_t events_per_read = 1 << 16;
    std::vector<Event> block;
    repeat_run(config, quiet, [&](Run& run) {
        run.pass_event();
        const Event& now = run.event();
        if (!comparison.expects_more()) return false;
        const std::uint64_t k = comparison.next();
        if (k < log.events() && k % events_per_read == 0)
            block = log.read(k, std::min(events_per_read, log.events() - k));
        const bool same = k < log.events() && same_events(block[k % events_per_read], now);
        comparison.add(same, "the run has another event");
        simulation.step();
        replay.apply(now);
        return true;
    });
    for (std::size_t i = 0; i < simulation.size(); ++i)
        if (!same_discs(replay.discs()[i], simulation.disc(i)))
            comparison.fail("the replayed state differs");
    comparison.report(quiet, remark);
}

void add_verify_command(Subcommand& subcommand) {
    struct Verify {
        std::string file;
        bool quiet = false;
    };
    const auto call = std::make_shared<Verify>();
    subcommand.add({
        {"file", &call->file, "Result (JSON), trajectory or event log (HDF5)", "FILE", required},
        {"--quiet", &call->quiet, "Print neither progress nor report"},
    });
    subcommand.set_examples({"swirl verify result.json", "swirl verify frames.h5"});
    subcommand.callback([call] {
        if (!file_signature(call->file).starts_with('\x89'))
            return verify_result(call->file, call->quiet);
        try_reading(call->file);
        if (is_event_log(call->file)) return verify_event_log(call->file, call->quiet);
        verify_trajectory(call->file, call->quiet);
    });
}

const Command verify_command("verify", add_verify_command);

}  // namespace
}  // namespace swirl
