#include "swirl/run/recorded_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

#include "swirl/io/atomic_file.hpp"
#include "swirl/io/checkpoint.hpp"
#include "swirl/io/checksum.hpp"
#include "swirl/io/event_log.hpp"
#include "swirl/io/file_error.hpp"
#include "swirl/io/optional_file.hpp"
#include "swirl/io/recording.hpp"
#include "swirl/io/state_archive.hpp"
#include "swirl/io/trajectory.hpp"
#include "swirl/measure/observation.hpp"
#include "swirl/run/config.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/json.hpp"
#include "swirl/run/parse_json.hpp"
#include "swirl/run/period_series.hpp"
#include "swirl/run/simd.hpp"
#include "swirl/run/version.hpp"

namespace swirl {
namespace {

using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

Json frames_json(const RunFiles& files) {
    if (files.trajectory.empty()) return nullptr;
    if (files.frames.events) return Json{{"events", *files.frames.events}};
    if (files.frames.interval) return Json{{"interval", *files.frames.interval}};
    // The key is part of the file format.
    return Json{{"per_swirl", files.frames.per_period}};
}

/// The properties that must agree with a checkpoint for a run to be resumed from it.
Json identity(const RunConfig& config, const RunFiles& files, const Observation* observation) {
    Json measured = Json::array();
    if (observation && !observation->empty())
        measured.push_back(fmt::format("{}", fmt::join(observation->names(), ",")));
    Json identity{{"parameters", config_json(config)},
                  {"frames", frames_json(files)},
                  {"event_log", !files.event_log.empty()},
                  {"measured", measured}};
    if (!files.series.empty()) identity["series"] = true;
    return identity;
}

/// The JSON part of a checkpoint, with the entries that every checkpoint has.
Json read_about(const std::filesystem::path& file, const Checkpoint& checkpoint) {
    Json about = parse_json(checkpoint.about);
    const auto is_valid = [&] {
        if (!about.is_object()) return false;
        const Json identity = about.value("identity", Json()),
                   call = about.value("call", Json::object());
        return identity.is_object() && identity.value("parameters", Json()).is_object() &&
               identity.contains("frames") && about.value("run", Json("")).is_string() &&
               about.value("overwrites", Json(false)).is_boolean() && call.is_object() &&
               std::all_of(call.begin(), call.end(), [](const Json& v) { return v.is_string(); });
    };
    if (!is_valid())
        throw FileError(fmt::format(
            "the checkpoint '{}' does not identify its run.\nhint: remove it.", file.string()));
    return about;
}

/// The shape of the bodies whose state a checkpoint holds.
Shape shape_in(const Json& parameters) {
    if (parameters.value("body", Json()) == Json("sphere")) return Shape::sphere;
    return parameters.value("floor", Json()).is_string() ? Shape::coin : Shape::disc;
}

/// A state must be continued with the law of motion that led to it.
void require_same_law(const std::filesystem::path& file, const Json& about) {
    const Shape shape = shape_in(about.at("identity").at("parameters"));
    const Json law = about.value("law", Json(1));  // older files have no number
    if (law == law_of(shape)) return;
    throw FileError(fmt::format(
        "the checkpoint '{}' is of swirl {}, in which such bodies follow another law of motion "
        "({} there, {} here).\nhint: resume it with the program that wrote it, or start again.",
        file.string(), about.value("version", std::string("?")), law.dump(), law_of(shape)));
}

std::string difference(const Json& there, const Json& here) {
    for (const auto& [name, value] : here.at("parameters").items())
        if (there.at("parameters").value(name, Json()) != value)
            return fmt::format("{} is {} there and {} here", name,
                               there["parameters"].value(name, Json()).dump(), value.dump());
    if (there.at("frames") != here.at("frames"))
        return fmt::format("the frames of its trajectory are {} there and {} here",
                           there["frames"].dump(), here["frames"].dump());
    if (there.value("event_log", Json(false)) != here.at("event_log"))
        return "only one of them writes an event log";
    if (there.contains("series") != here.contains("series"))
        return "only one of them writes a series";
    return fmt::format("it measures {} there and {} here",
                       there.value("measured", Json::array()).dump(), here.at("measured").dump());
}

Json take_length(Json& identity) {
    Json length;
    for (const char* name : {"events", "periods"}) {
        length[name] = identity["parameters"].value(name, Json());
        identity["parameters"].erase(name);
    }
    return length;
}

/// True if the runs differ in length only. A recording in the checkpoint's run may be dropped here.
bool differs_only_in_length(Json there, Json here) {
    if (take_length(there) == take_length(here)) return false;
    for (const char* recording : {"frames", "event_log"})
        if (here[recording] == Json() || here[recording] == Json(false))
            there[recording] = here[recording];
    return there == here;
}

/// The run's name in its recordings. Equal names mean equal frames and events.
std::string run_name(const Json& identity) {
    return fmt::format("{:016x}", checksum(identity.dump() + version()));
}

/// The series of a run that is not finished, as NAME.partial: it grows by a line per period, so
/// that you can look at it. A killed run leaves it.
///
/// A run that was killed between its series and its result also leaves the series itself. A resumed
/// run writes the same lines again, so a file with other lines belongs to another run.
class LiveSeries {
  public:
    LiveSeries(const PeriodSeries& series, const std::filesystem::path& path, bool resumes)
        : series_(series), final_path_(path), path_(partial_name(path)) {
        if (resumes && regular_file_exists(path)) earlier_ = read_whole_file(path);
        require_replaceable(path_);
        file_.open(path_, std::ios::binary | std::ios::trunc);
        add(series_.header());
        update();
    }
    void update() {
        if (series_.periods() == periods_) return;
        add(series_.rows(periods_));
        periods_ = series_.periods();
    }
    /// Throws Failure if the earlier series has lines that this run does not have.
    void require_same_run() {
        if (compared_ < earlier_.size()) reject();
    }
    void remove() {
        file_.close();
        std::error_code ignored;
        std::filesystem::remove(path_, ignored);
    }

  private:
    void add(const std::string& lines) {
        file_ << lines << std::flush;
        const std::size_t both = std::min(lines.size(), earlier_.size() - compared_);
        if (lines.compare(0, both, earlier_, compared_, both) != 0) reject();
        compared_ += both;
    }
    [[noreturn]] void reject() {
        remove();
        throw Failure(
            fmt::format("'{}' is the series of another run, or of a longer one; it was left "
                        "unchanged.\nhint: choose another name, or use --overwrite to replace it.",
                        final_path_.string()));
    }

    const PeriodSeries& series_;
    std::filesystem::path final_path_, path_;
    std::ofstream file_;
    std::size_t periods_ = 0;   // periods in the file
    std::string earlier_;       // a series that is there already
    std::size_t compared_ = 0;  // characters of it that this run has written, too
};

/// Renames the checkpoint of an earlier run, so that it is not lost.
void back_up(const std::filesystem::path& checkpoint) {
    if (!checkpoint.empty() && file_exists(checkpoint))
        rename_durably(checkpoint, backup_name(checkpoint));
}

class Recorder {
  public:
    Recorder(const RunConfig& config, const RunFiles& files, const Provenance& provenance,
             const Observation* observation, const PeriodSeries* series,
             const std::atomic<bool>* stop)
        : config_(config),
          files_(files),
          observation_(observation),
          series_(series),
          overwrites_(files.overwrite),
          frame_times_(files.frames.per_period, config.period, files.frames.interval.value_or(0.0)),
          last_checkpoint_(Clock::now()) {
        resumes_checkpoint_ = files.resume && file_exists(files.checkpoint);
        if (resumes_checkpoint_)
            resume();
        else
            start(provenance, stop);
    }

    RunResult operator()(RunControl control) {
        control.resume = std::move(resumed_);
        control.orientations = !files_.trajectory.empty() && config_.shape() != Shape::disc;
        FinalState* const final_state = control.final_state;
        Run run(config_, std::move(control));
        if (extended_)
            if (const auto problem = run.problem_with_length(*extended_))
                throw UsageError(
                    fmt::format("the run of the checkpoint '{}' cannot be continued to another "
                                "length: {}.",
                                files_.checkpoint.string(), *problem));
        std::optional<LiveSeries> live;
        if (!files_.series.empty()) live.emplace(*series_, files_.series, may_be_of_another_run());
        while (const std::uint64_t events = execute(run)) {
            if (live) live->update();
            if (is_checkpoint_due(events) && !run.complete()) save(run);
        }
        if (!run.complete() || files_.keep_checkpoint) save(run);
        const RunResult result = run.result();
        if (live && result.complete) live->require_same_run();
        if (live) series_->write(files_.series);
        if (live) live->remove();
        if (!result.complete) {
            if (trajectory_) trajectory_->flush();
            if (event_log_) event_log_->flush();
            return result;
        }
        if (final_state) *final_state = run.final_state();
        if (trajectory_) trajectory_->finish();
        if (event_log_) event_log_->finish();
        return result;
    }

  private:
    /// A series that is there already. In the folder of a sweep it belongs to the run, even if it
    /// is damaged; the files of a call are the user's.
    bool may_be_of_another_run() const {
        return files_.resume && !resumes_checkpoint_ && !files_.in_folder_of_runs;
    }

    void start(Provenance provenance, const std::atomic<bool>* stop) {
        reject_ramps_in_recordings();
        if (files_.overwrite) back_up(files_.checkpoint);
        if (files_.trajectory.empty() && files_.event_log.empty()) return;
        provenance.emplace_back(run_entry, name());
        provenance.emplace_back("frames", frames_entry(files_));
        for (const auto& file : {files_.trajectory, files_.event_log})
            if (!file.empty() && !files_.overwrite) reject_foreign_recording(file, name());
        const InitialState scene = make_initial_state(config_, stop);
        const Snapshot first = Simulation(scene, {}, selected_tuning(stop)).snapshot();
        if (stop && stop->load()) throw Interrupted("stopped before the first event.");
        if (!files_.trajectory.empty())
            trajectory_.emplace(files_.trajectory, first, provenance, files_.compression,
                                config_.ramp_of("period") != nullptr);
        if (!files_.event_log.empty())
            event_log_.emplace(files_.event_log, first, scene.path.segments.back().end, provenance,
                               files_.compression, moving_floor(scene.floor, scene.path));
    }

    /// An event log has one path, and frames at an interval have one period.
    void reject_ramps_in_recordings() const {
        for (const char* name : {"amplitude", "period"}) {
            if (!config_.ramp_of(name)) continue;
            if (!files_.event_log.empty())
                throw UsageError(fmt::format(
                    "an event log cannot record a ramp of {}: it holds one path of the container."
                    "\nhint: use --trajectory without --log-events.",
                    name));
        }
        if (config_.ramp_of("period") && !files_.trajectory.empty() && files_.frames.interval)
            throw UsageError(
                "--frame-interval cannot be used with a ramp of the period.\nhint: use "
                "--frames-per-period, "
                "the number of frames per period.");
    }

    void resume() {
        const Checkpoint checkpoint = read_checkpoint(files_.checkpoint);
        const Json about = read_about(files_.checkpoint, checkpoint),
                   here = identity(config_, files_, observation_);
        require_same_law(files_.checkpoint, about);
        if (differs_only_in_length(about.at("identity"), here)) {
            if (!files_.trajectory.empty() || !files_.event_log.empty())
                throw UsageError(fmt::format(
                    "the checkpoint '{}' belongs to a run of another length, and the length of a "
                    "recorded run cannot be changed.\nhint: start again with --overwrite, or "
                    "repeat the call without --trajectory and --log-events.",
                    files_.checkpoint.string()));
            extended_ = resolve(parameters_in(about.at("identity").at("parameters").dump()));
        } else if (about.at("identity") != here)
            reject_checkpoint(difference(about.at("identity"), here));
        StateReader state(checkpoint.state);
        std::uint64_t frames = 0, logged = 0;
        resumed_.emplace();
        state(frames, logged, events_, frame_times_, *resumed_);
        state.expect_end();
        if (!files_.event_log.empty() && logged != events_)
            throw FileError(fmt::format(
                "the checkpoint '{}' is inconsistent: it counts {} events, but {} in its log.",
                files_.checkpoint.string(), events_, logged));
        run_name_ = about.value("run", std::string());
        overwrites_ = about.value("overwrites", false);
        try {
            reopen_recordings(frames, logged);
        } catch (const DamagedFile& error) {
            throw DamagedFile(fmt::format("{}\nhint: {}", error.what(), how_to_start_again()));
        }
    }

    void reopen_recordings(std::uint64_t frames, std::uint64_t logged) {
        if (!files_.trajectory.empty())
            trajectory_ = TrajectoryWriter::resume(files_.trajectory, frames, name());
        if (!files_.event_log.empty())
            event_log_ = EventLogWriter::resume(files_.event_log, logged, name());
    }

    /// The checkpoint is that of another run.
    [[noreturn]] void reject_checkpoint(const std::string& difference) const {
        const std::string problem = fmt::format("the checkpoint '{}' belongs to another run: {}.",
                                                files_.checkpoint.string(), difference);
        if (files_.in_folder_of_runs)
            throw DamagedFile(problem + "\nhint: remove it to start its run again.");
        throw UsageError(problem +
                         "\nhint: resume with the same parameters, or choose another checkpoint "
                         "with --checkpoint.");
    }

    /// The only way on if the checkpoint continues a recording that is lost, damaged or exchanged.
    std::string how_to_start_again() const {
        if (!files_.in_folder_of_runs)
            return "start the run again with --overwrite instead of --resume.";
        return fmt::format("remove '{}' to start its run again.", files_.checkpoint.string());
    }

    /// The run's name in its recordings, which a short run does not need.
    const std::string& name() {
        if (!run_name_) run_name_ = run_name(identity(config_, files_, observation_));
        return *run_name_;
    }

    /// Returns the number of events executed; 0 at the end of the run.
    std::uint64_t execute(Run& run) {
        if (!trajectory_ && !event_log_) {
            const std::uint64_t events = run.execute_events();
            events_ += events;
            return events;
        }
        if (!run.next_event()) return 0;
        record(run);
        return 1;
    }

    /// Passes the next event and records the frames before it, the event, and the frame after it.
    void record(Run& run) {
        if (trajectory_ && !files_.frames.events)
            while (run.next_sample(frame_times_)) trajectory_->write(run.snapshot(), events_);
        run.pass_event();
        ++events_;
        if (event_log_) event_log_->write(run.event());
        if (trajectory_ && files_.frames.events &&
            events_ % std::uint64_t(*files_.frames.events) == 0)
            trajectory_->write(run.snapshot(), events_);
    }

    /// After these events.
    bool is_checkpoint_due(std::uint64_t events) const {
        constexpr std::uint64_t events_per_clock_read = 256;
        return events_ % events_per_clock_read < events && !files_.checkpoint.empty() &&
               std::chrono::duration<double>(Clock::now() - last_checkpoint_).count() >=
                   files_.checkpoint_every;
    }

    void save(Run& run) {
        if (files_.checkpoint.empty() || is_disabled_) return;
        try {
            write_checkpoint_of(run);
        } catch (const FileError& error) {
            if (files_.checkpoint_needed) throw;
            is_disabled_ = true;
            if (files_.warn)
                files_.warn(fmt::format("{} The run continues without checkpoints.", error.what()));
        }
    }

    /// The recordings are flushed first: the checkpoint counts their frames and events.
    void write_checkpoint_of(Run& run) {
        if (trajectory_) trajectory_->flush();
        if (event_log_) event_log_->flush();
        StateWriter state;
        std::uint64_t frames = trajectory_ ? trajectory_->frames() : 0;
        std::uint64_t logged = event_log_ ? event_log_->events() : 0;
        state(frames, logged, events_, frame_times_);
        state.as_text([&](StateWriter& text) { run.write(text); });
        const Json about{{"version", version()},
                         {"law", law_of(config_.shape())},
                         {"identity", identity(config_, files_, observation_)},
                         {"run", name()},
                         {"call", files_.call},
                         {"overwrites", overwrites_}};
        write_checkpoint(files_.checkpoint, {about.dump(), std::move(state).bytes()});
        last_checkpoint_ = Clock::now();
    }

    const RunConfig& config_;
    const RunFiles& files_;
    const Observation* observation_;
    const PeriodSeries* series_;
    std::optional<std::string> run_name_;
    bool resumes_checkpoint_ = false;
    bool overwrites_;  // stays true when a run that was started with --overwrite is resumed
    std::optional<TrajectoryWriter> trajectory_;
    std::optional<EventLogWriter> event_log_;
    std::optional<std::string> resumed_;
    std::optional<RunConfig> extended_;  // the run of the checkpoint, if it has another length
    SampleTimes frame_times_;
    std::uint64_t events_ = 0;  // count since the start of the run
    bool is_disabled_ = false;  // a checkpoint could not be written
    Clock::time_point last_checkpoint_;
};

}  // namespace

RunResult run_recorded(const RunConfig& config, const RunFiles& files, const RunControl& control,
                       const Provenance& provenance) {
    return Recorder(config, files, provenance, control.observation, control.series,
                    control.stop)(control);
}

void remove_checkpoint(const RunFiles& files) {
    if (!files.checkpoint.empty()) remove_atomic_file(files.checkpoint);
}

bool has_whole_trajectory(const RunConfig& config, const RunFiles& files) {
    if (!file_exists(files.trajectory)) return false;
    try {
        TrajectoryReader reader(files.trajectory);
        return reader.complete() && reader.provenance("frames") == frames_entry(files) &&
               reader.provenance("parameters") == config_json(config).dump();
    } catch (const DamagedFile&) {
        return false;
    }
}

std::string frames_entry(const RunFiles& files) { return frames_json(files).dump(); }

std::filesystem::path backup_name(const std::filesystem::path& checkpoint) {
    return unused_name(checkpoint.string() + ".backup");
}

CheckpointedCall call_in_checkpoint(const std::filesystem::path& checkpoint) {
    const Json about = read_about(checkpoint, read_checkpoint(checkpoint));
    return {.configuration = about.at("identity").at("parameters").dump(),
            .options = about.value("call", ParameterTexts()),
            .overwrites = about.value("overwrites", false),
            .run = about.value("run", std::string())};
}

Provenance provenance_of(const RunConfig& config, const std::string& command,
                         const std::string& config_text) {
    return {{"version", version()},
            {"build", build_description()},
            {"command", command},
            {"config", config_text},
            {"parameters", config_json(config).dump()},
            {"seed", fmt::format("{}", config.seed)},
            {"generator", random_generator}};
}

}  // namespace swirl
