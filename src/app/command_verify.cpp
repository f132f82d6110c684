// swirl verify: runs again what a result says it is, and compares.
#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "swirl/app/commands.hpp"
#include "swirl/app/output.hpp"
#include "swirl/app/progress_line.hpp"
#include "swirl/app/stop_signal.hpp"
#include "swirl/files/event_log.hpp"
#include "swirl/files/trajectory.hpp"
#include "swirl/files/whole_file.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/json.hpp"
#include "swirl/run/run.hpp"
#include "swirl/run/version.hpp"

namespace swirl {
namespace {

using Json = nlohmann::ordered_json;

RunConfig config_in(const std::string& file, const std::string& text) {
    const Json json = Json::parse(text, nullptr, false);
    if (!json.is_object())
        throw Failure(fmt::format("'{}' does not say which run it is of.", file));
    try {
        return resolve(parameters_in(json));
    } catch (const WrongCall& wrong) {
        throw Failure(
            fmt::format("'{}' cannot be run again with this version: {}", file, wrong.what()));
    } catch (const nlohmann::json::exception&) {
        throw Failure(fmt::format("'{}' does not say which run it is of.", file));
    }
}

std::string of_version(const std::string& made_by) {
    return made_by == version()
               ? std::string()
               : fmt::format(" It was made by swirl {}, this is {}.", made_by, version());
}

void verify_result(const std::string& file, bool quiet) {
    const Json json = Json::parse(read_whole_file(file), nullptr, false);
    if (!json.is_object() || !json.contains("config") || !json.contains("state_hash"))
        throw Failure(fmt::format("'{}' is not the result of a run.", file));
    if (!json.value("complete", false))
        throw Failure(fmt::format(
            "'{}' is of a run that was stopped before its end, and cannot be compared.", file));
    const RunConfig config = config_in(file, json["config"].dump());
    ProgressLine line("again", quiet);
    RunControl control;
    control.stop = &stop_signal();
    control.progress = [&](const RunProgress& p) {
        line.show(p.fraction, fmt::format("{} events", p.events));
    };
    const RunResult again = run(config, control);
    line.clear();
    if (!again.complete) throw Interrupted("Stopped before the end of the run.");
    const Json result = result_json(again);
    for (const char* part : {"state_hash", "events", "rotation"})
        if (json.value(part, Json()) != result.at(part))
            throw Failure(fmt::format("'{}' differs: {} is {} there and {} now.{}", file, part,
                                      json.value(part, Json()).dump(), result.at(part).dump(),
                                      of_version(json.value("version", std::string("?")))));
    if (!quiet)
        print_all(fmt::format("The same, bit for bit: {} events, state {}.\n", again.events.total(),
                              json["state_hash"].get<std::string>()));
}

/// Every frame against the engine's state at that moment.
void verify_trajectory(const std::string& file, bool quiet) {
    TrajectoryReader reader(file);
    const RunConfig config = config_in(file, reader.provenance("parameters"));
    Simulation simulation(make_initial_state(config));
    ProgressLine line("again", quiet);
    for (std::uint64_t k = 0; k < reader.frames(); ++k) {
        if (stop_signal().load()) throw Interrupted("Stopped before the last frame.");
        const Snapshot frame = reader.frame(k);
        simulation.advance_to(frame.swirls, frame.clock);
        const Snapshot now = simulation.snapshot();
        bool same = frame.size() == now.size();
        for (std::size_t i = 0; same && i < now.size(); ++i) {
            const Vec2 p = now.position(i);
            same = p.x == frame.x[i] && p.y == frame.y[i] && now.vx[i] == frame.vx[i] &&
                   now.vy[i] == frame.vy[i] && now.orientation(i) == frame.angle[i] &&
                   now.spin[i] == frame.spin[i];
        }
        if (!same)
            throw Failure(fmt::format("'{}' differs from frame {} on (time {}).{}", file, k,
                                      frame.time(), of_version(reader.provenance("version"))));
        line.show(double(k + 1) / double(reader.frames()), fmt::format("frame {}", k + 1));
    }
    line.clear();
    if (!quiet) print_all(fmt::format("The same, bit for bit: {} frames.\n", reader.frames()));
}

bool same_events(const Event& a, const Event& b) {
    return a.swirls == b.swirls && a.clock == b.clock && a.kind == b.kind && a.i == b.i &&
           a.j == b.j && a.normal.x == b.normal.x && a.normal.y == b.normal.y &&
           a.impulse.normal == b.impulse.normal && a.impulse.tangential == b.impulse.tangential &&
           a.impulse.sticks == b.impulse.sticks;
}

/// Every event against the engine's, and the state that they lead to against its state.
void verify_event_log(const std::string& file, bool quiet) {
    EventLogReader log(file);
    Simulation simulation(make_initial_state(config_in(file, log.provenance("parameters"))));
    Replay replay(log.initial(), log.swirl_end());
    ProgressLine line("again", quiet);
    const auto refuse = [&](std::uint64_t event, const char* what) {
        throw Failure(fmt::format("'{}' differs from event {} on: {}.{}", file, event, what,
                                  of_version(log.provenance("version"))));
    };
    if (log.initial().size() != simulation.size()) refuse(0, "another number of discs");
    constexpr std::uint64_t at_once = 1 << 16;
    for (std::uint64_t first = 0; first < log.events(); first += at_once) {
        if (stop_signal().load()) throw Interrupted("Stopped before the last event.");
        std::uint64_t k = first;
        for (const Event& event : log.read(first, std::min(at_once, log.events() - first))) {
            if (!same_events(event, simulation.step())) refuse(k, "another event happens now");
            replay.apply(event);
            ++k;
        }
        line.show(double(k) / double(log.events()), fmt::format("event {}", k));
    }
    for (std::size_t i = 0; i < simulation.size(); ++i) {
        const Disc a = replay.discs()[i], b = simulation.disc(i);
        if (a.position.x != b.position.x || a.position.y != b.position.y ||
            a.velocity.x != b.velocity.x || a.velocity.y != b.velocity.y || a.angle != b.angle ||
            a.spin != b.spin || a.time != b.time)
            refuse(0, "the state that the events lead to is another");
    }
    line.clear();
    if (!quiet) print_all(fmt::format("The same, bit for bit: {} events.\n", log.events()));
}

void add_verify_command(CLI::App& subcommand) {
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
    set_examples(subcommand, {"swirl verify result.json", "swirl verify frames.h5"});
    subcommand.callback([call] {
        std::ifstream stream(call->file, std::ios::binary);
        if (!stream) throw Failure(fmt::format("'{}' cannot be opened.", call->file));
        if (stream.get() != 0x89) return verify_result(call->file, call->quiet);
        if (is_event_log(call->file)) return verify_event_log(call->file, call->quiet);
        verify_trajectory(call->file, call->quiet);
    });
}

const Command verify_command(42, "verify", "Runs a result again and compares every bit.",
                             add_verify_command);

}  // namespace
}  // namespace swirl
