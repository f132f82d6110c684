// swirl experiment: the paper's figures from a set of videos, compared with simulations.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>
#include <system_error>

#include "swirl/cli/called_command.hpp"
#include "swirl/cli/command_line.hpp"
#include "swirl/cli/commands.hpp"
#include "swirl/cli/output.hpp"
#include "swirl/cli/progress_line.hpp"
#include "swirl/cli/run_options.hpp"
#include "swirl/cli/stop_signal.hpp"
#include "swirl/cli/track_options.hpp"
#include "swirl/cli/tracks_input.hpp"
#include "swirl/io/atomic_file.hpp"
#include "swirl/io/optional_file.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/json.hpp"
#include "swirl/run/measured_series.hpp"
#include "swirl/run/parse_json.hpp"
#include "swirl/run/python_script.hpp"
#include "swirl/run/version.hpp"
#include "track/cli/video_options.hpp"
#include "track/experiment/experiment.hpp"

namespace swirl {
namespace {

namespace fs = std::filesystem;

struct ExperimentCall {
    std::shared_ptr<ParameterTexts> parameters;
    ExperimentSettings settings;
    std::vector<std::string> rough, smooth;
    std::string out, json;
    std::optional<double> fps;
    std::optional<std::int64_t> frames;
    bool spin = false, no_simulation = false, quiet = false;
};

std::string name_of_video(const std::string& video) {
    fs::path path = video;
    // For numbered images ('frames/%05d.png'), the name of their folder.
    if (video.find('%') != video.npos && path.has_parent_path())
        return path.parent_path().filename();
    return path.stem().string();
}

/// Identifies the video and the options that its tracks were made with.
nlohmann::ordered_json tracking_key(const ExperimentCall& call, const std::string& video) {
    std::error_code ignored;
    const bool file = fs::is_regular_file(video, ignored);
    return {{"video", video},
            {"size", file ? fs::file_size(video, ignored) : 0},
            {"modified", file ? fs::last_write_time(video, ignored).time_since_epoch().count() : 0},
            {"fps", call.fps ? nlohmann::ordered_json(*call.fps) : nullptr},
            {"frames", call.frames ? nlohmann::ordered_json(*call.frames) : nullptr},
            {"spin", call.spin},
            {"version", version()}};
}

/// Calls `swirl track`, so that this program needs no OpenCV. Throws Failure with its error.
void track(const ExperimentCall& call, const std::string& video, const fs::path& table,
           const fs::path& image) {
    std::vector<std::string> words{"track", "--out",       table,    "--image",
                                   image,   "--overwrite", "--quiet"};
    if (call.fps) words.insert(words.end(), {"--fps", fmt::format("{}", *call.fps)});
    if (call.frames) words.insert(words.end(), {"--max-frames", std::to_string(*call.frames)});
    if (call.spin) words.emplace_back("--spin");
    words.insert(words.end(), {"--", video});
    // Its warnings are in the calibration, too.
    output_of_command(words, "stopped before the end; finished parts are kept.");
}

/// Returns the table of tracks; reuses one from an earlier call with the same video and options.
fs::path tracks_of(const ExperimentCall& call, const std::string& video,
                   ContainerVideo& container) {
    const fs::path folder = fs::path(call.out) / "tracks";
    make_folder(folder);
    const fs::path table = folder / (container.name + ".csv"),
                   about = folder / (container.name + ".json"),
                   image = fs::path(call.out) / fmt::format("video_{}.png", container.name);
    container.images = {image.filename()};
    const std::string key = tracking_key(call, video).dump(2) + "\n";
    const bool reusable = video.find('%') == video.npos && file_exists(about) &&
                          file_exists(table) && file_exists(image) &&
                          file_exists(camera_file(table)) && read_whole_file(about) == key;
    if (reusable) return table;
    ProgressLine line(container.name, call.quiet);
    line.show(0.0, "tracking");
    // Until the key is written again, the other files do not belong to any video.
    std::error_code absent;
    fs::remove(about, absent);
    track(call, video, table, image);
    line.clear();
    write_output(about, key);
    return table;
}

void measure(const ExperimentCall& call, const fs::path& table, ContainerVideo& container) {
    const fs::path calibration = camera_file(table);
    if (!file_exists(calibration))
        throw Failure(
            fmt::format("there is no calibration '{}' next to '{}'.\nhint: give a video, or tracks "
                        "by `swirl track`, which writes both files.",
                        calibration.filename().string(), table.string()));
    container.found = parse_json(read_whole_file(calibration));
    if (!container.found.is_object() || !container.found.contains("camera") ||
        !container.found.contains("discs"))
        throw Failure(
            fmt::format("'{}' is not a calibration by `swirl track`.", calibration.string()));
    for (const auto& warning : container.found.value("warnings", nlohmann::ordered_json::array()))
        if (warning.is_string()) container.remarks.push_back(warning.get<std::string>());
    const OpenedSeries opened = open_tracks(table.string(), {});
    for (std::size_t begin = 0, end; begin < opened.remarks.size(); begin = end + 1) {
        end = opened.remarks.find('\n', begin);
        container.remarks.push_back(opened.remarks.substr(begin, end - begin));
    }
    const bool tracked = holds_tracks(opened.series);
    ProgressLine line(container.name, call.quiet);
    MeasuringControl control;
    control.stop = &stop_signal();
    control.progress = [&](std::uint64_t k, std::uint64_t of) {
        line.show(double(k) / double(of), "measuring");
    };
    const MeasuredSeries measured =
        measure_series(opened.series, measurable(measurements_of_a_video(), tracked), 0.0, control);
    if (!rate_suffices(measured.frames_per_period, min_rate_of_pinned))
        container.remarks.push_back(
            fmt::format("The video has {:.0f} frames per period, but pinned discs need {:.0f}. The "
                        "simulation is sampled at the same rate, so neither has them.",
                        measured.frames_per_period, min_rate_of_pinned));
    container.result = {{"periods", measured.periods},
                        {"rotation",
                         {{"mean_by_time", estimate_json(measured.rotation.mean_by_time)},
                          {"rigid_by_time", estimate_json(measured.rotation.rigid_by_time)}}},
                        {"measured", measured_json(measured.reports)}};
}

ContainerVideo measure_video(const ExperimentCall& call, const std::string& video, bool smooth) {
    ContainerVideo container;
    container.name = name_of_video(video);
    container.smooth = smooth;
    container.video = video;
    try {
        measure(call,
                is_named_as_tracks(video) ? fs::path(video) : tracks_of(call, video, container),
                container);
    } catch (const Interrupted&) {
        throw;
    } catch (const std::exception& failure) {  // the report then omits this video
        container.result = {{"failed", failure.what()}};
        const bool is_only_video = call.rough.size() + call.smooth.size() == 1;  // error follows
        if (!is_only_video) print_warning(fmt::format("{}: {}", video, failure.what()));
    }
    return container;
}

void validate(const ExperimentCall& call) {
    if (call.out.empty()) throw UsageError("missing required option --out DIR.");
    check_video_options(call.fps, call.frames);
    std::set<std::string> names;
    for (const auto* videos : {&call.rough, &call.smooth})
        for (const std::string& video : *videos)
            if (!names.insert(name_of_video(video)).second)
                throw UsageError(fmt::format(
                    "two videos are called '{}', so their output files would have the same names.\n"
                    "hint: rename one.",
                    name_of_video(video)));
    if (!call.json.empty() && call.json != "-") reject_unwritable(call.json);
    std::vector<fs::path> all{call.json};
    for (const auto* videos : {&call.rough, &call.smooth})
        all.insert(all.end(), videos->begin(), videos->end());
    reject_same_files(all);
    check(call.settings);
}

std::string summary(const ExperimentResult& result) {
    std::string text;
    for (const std::string& finding : result.findings) text += finding + "\n";
    if (result.runs > 0)
        text += fmt::format("{} simulated runs{}.\n", result.runs,
                            result.remembered > 0 ? fmt::format(", {} of them from an earlier call",
                                                                result.remembered)
                                                  : "");
    return text + fmt::format("wrote {} and {} more files in the same folder\n",
                              result.files.back().string(), result.files.size() - 1);
}

void make_experiment_report(ExperimentCall& call) {
    call.settings.out = call.out;
    call.settings.parameters = *call.parameters;
    call.settings.simulate = !call.no_simulation;
    call.settings.command = command_line();
    validate(call);
    require_figure_packages();
    make_folder(call.out);
    std::vector<ContainerVideo> videos;
    for (const std::string& video : call.rough) videos.push_back(measure_video(call, video, false));
    for (const std::string& video : call.smooth) videos.push_back(measure_video(call, video, true));
    const auto good = std::count_if(videos.begin(), videos.end(),
                                    [](const ContainerVideo& video) { return video.good(); });
    if (good == 0)
        throw Failure(
            videos.size() == 1
                ? fmt::format("the video could not be used: {}",
                              videos.front().result["failed"].get<std::string>())
                : fmt::format("none of the {} videos could be used; the first one, {}: {}",
                              videos.size(), videos.front().video,
                              videos.front().result["failed"].get<std::string>()));
    ExperimentResult result;
    {
        ProgressLine line("simulation", call.quiet);
        ExperimentControl control;
        control.stop = &stop_signal();
        control.progress = [&](double fraction) { line.show(fraction, "runs"); };
        result = make_experiment(videos, call.settings, control);
    }
    if (call.json == "-")
        print_all(result.json.dump(2) + "\n");
    else if (!call.json.empty())
        write_output(call.json, result.json.dump(2) + "\n");
    if (!call.quiet && call.json != "-") print_all(summary(result));
    if (good < std::ptrdiff_t(videos.size()))
        throw Failure(
            fmt::format("{} of {} videos could not be used; the report lists the reasons.",
                        videos.size() - std::size_t(good), videos.size()));
}

void add_experiment_command(Subcommand& subcommand) {
    const auto call = std::make_shared<ExperimentCall>();
    const char* group = "Videos";
    const auto add = [&](const char* name, auto& into, const char* type, const char* description) {
        subcommand.in(group).add({{name, &into, description, type}});
    };
    const auto flag = [&](const char* name, bool& into, const char* description) {
        subcommand.in(group).add({{name, &into, description}});
    };
    subcommand.add({{"videos", &call->rough, "Videos or image sequences, or tracks (.csv, .h5)",
                     "VIDEO", required}});
    add("--smooth-discs", call->smooth, "VIDEO",
        "Videos of smoother discs (Figure 4c); repeatable");
    add("--fps", call->fps, "N", "Frames per second of all videos [from each video]");
    add("--max-frames", call->frames, "N", "Number of frames of each video [all]");
    flag("--spin", call->spin, "Measure spins from textures (Figure 4b)");
    call->parameters = add_run_options(subcommand, {"discs", "mixture", "radius", "ramp"},
                                       {{"events", "5e5"},
                                        {"container_radius", "from the videos"},
                                        {"amplitude", "from the videos"},
                                        {"period", "such that the speed is 1"},
                                        {"path", "circle"}});
    group = "Simulation";
    add("--replicates", call->settings.seeds, "N", "Runs for each number of discs [3]");
    add("--smooth-mu", call->settings.smooth_mu, "NUMBER",
        "Friction coefficient of the smoother discs [0.1]");
    flag("--no-simulation", call->no_simulation, "Videos only, without simulations");
    group = "Output";
    add("--out", call->out, "DIR", "Folder for report and figures; valid results are reused");
    add("--json", call->json, "FILE|-", "File for all results, or - for standard output");
    flag("--quiet", call->quiet, "No progress line and no summary");
    subcommand.set_main_options({"--smooth-discs", "--fps", "--spin", "--mu", "--preset",
                                 "--events", "--replicates", "--no-simulation", "--out", "--json"});
    subcommand.set_examples({"swirl experiment N24.mp4 N36.mp4 N48.mp4 --mu 0.5 --out marbles",
                             "swirl experiment videos/*.mp4 --preset experiment --out marbles",
                             "swirl experiment rough36.mp4 rough48.mp4 --smooth-discs smooth36.mp4 "
                             "--smooth-discs smooth48.mp4 --out both",
                             "swirl experiment tracks.csv --no-simulation --out measured"});
    subcommand.callback([call] { make_experiment_report(*call); });
}

const Command experiment_command("experiment", add_experiment_command);

}  // namespace
}  // namespace swirl
