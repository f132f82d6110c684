// swirl experiment: from a set of films to the paper's figures beside simulation, and a report.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "swirl/cli/command_line.hpp"
#include "swirl/cli/commands.hpp"
#include "swirl/cli/output.hpp"
#include "swirl/cli/progress_line.hpp"
#include "swirl/cli/run_options.hpp"
#include "swirl/cli/stop_signal.hpp"
#include "swirl/cli/track_options.hpp"
#include "swirl/cli/tracked_video.hpp"
#include "swirl/cli/tracks_input.hpp"
#include "swirl/io/atomic_file.hpp"
#include "swirl/paper/experiment.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/json.hpp"
#include "swirl/run/measured_series.hpp"
#include "swirl/run/version.hpp"
#ifdef SWIRL_CAMERA
#include "swirl/tracking/spin.hpp"
#include "swirl/tracking/tracking.hpp"
#endif

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
    // Of numbered pictures the folder: 'frames/%05d.png'.
    if (video.find('%') != video.npos && path.has_parent_path())
        return path.parent_path().filename();
    return path.stem().string();
}

#ifdef SWIRL_CAMERA

/// What tells whether tracks that are there are of this film as it is now.
nlohmann::ordered_json identity_of(const ExperimentCall& call, const std::string& video) {
    std::error_code ignored;
    const bool file = fs::is_regular_file(video, ignored);
    return {{"film", video},
            {"size", file ? fs::file_size(video, ignored) : 0},
            {"modified", file ? fs::last_write_time(video, ignored).time_since_epoch().count() : 0},
            {"fps", call.fps ? nlohmann::ordered_json(*call.fps) : nullptr},
            {"frames", call.frames ? nlohmann::ordered_json(*call.frames) : nullptr},
            {"spin", call.spin},
            {"version", version()}};
}

/// Tracks the film unless that was done; returns the table.
fs::path tracks_of(const ExperimentCall& call, const std::string& video,
                   FilmedContainer& container) {
    const fs::path folder = fs::path(call.out) / "tracks";
    make_folder(folder);
    const fs::path table = folder / (container.name + ".csv"),
                   about = folder / (container.name + ".json"),
                   picture = fs::path(call.out) / fmt::format("film_{}.png", container.name);
    container.pictures = {picture.filename()};
    const std::string identity = identity_of(call, video).dump(2) + "\n";
    const bool known = video.find('%') == video.npos && fs::exists(about) && fs::exists(table) &&
                       fs::exists(picture) && fs::exists(camera_file(table)) &&
                       read_whole_file(about) == identity;
    if (known) return table;
    ProgressLine line(container.name, call.quiet);
    const TrackingSettings settings = tracking_settings(video, call.fps, call.frames, line);
    const TrackedVideo found = track_video(settings);
    std::optional<VideoSpins> spins;
    if (call.spin) spins = spins_of(found, settings);
    line.clear();
    // From here on until it is written anew, what is there is of no film.
    std::error_code absent;
    fs::remove(about, absent);
    write_tracks(found, {video, {}, {}}, table, spins ? &*spins : nullptr);
    draw_found(found, video, name_of_video(video), picture);
    write_output(about, identity);
    return table;
}

#else

fs::path tracks_of(const ExperimentCall&, const std::string&, FilmedContainer&) { throw_no_eyes(); }

#endif

void measure(const ExperimentCall& call, const fs::path& table, FilmedContainer& container) {
    const fs::path beside = camera_file(table);
    if (!fs::exists(beside))
        throw Failure(fmt::format(
            "beside '{}' there is no '{}', which says how the dish moved; `swirl track` writes it.",
            table.string(), beside.filename().string()));
    container.found = nlohmann::ordered_json::parse(read_whole_file(beside), nullptr, false);
    if (!container.found.is_object() || !container.found.contains("camera") ||
        !container.found.contains("discs"))
        throw Failure(fmt::format("'{}' is not what `swirl track` writes beside its tracks.",
                                  beside.string()));
    for (const auto& warning : container.found.value("warnings", nlohmann::ordered_json::array()))
        if (warning.is_string()) container.remarks.push_back(warning.get<std::string>());
    const OpenedSeries opened = open_tracks(table.string(), {});
    for (std::size_t begin = 0, end; begin < opened.remarks.size(); begin = end + 1) {
        end = opened.remarks.find('\n', begin);
        container.remarks.push_back(opened.remarks.substr(begin, end - begin));
    }
    const bool followed = holds_tracks(opened.series);
    ProgressLine line(container.name, call.quiet);
    MeasuringControl control;
    control.stop = &stop_signal();
    control.progress = [&](std::uint64_t k, std::uint64_t of) {
        line.show(double(k) / double(of), "measuring");
    };
    const MeasuredSeries measured = measure_series(
        opened.series, measurable(measurements_of_a_video(), followed), 0.0, control);
    if (!fits_criteria(measured.frames_per_period()))
        container.remarks.push_back(fmt::format(
            "There are {:.0f} pictures per swirl; the criteria for pinned discs are made for {}. "
            "The simulation is seen as often, so the two can be compared with each other, but not "
            "with the paper.",
            measured.frames_per_period(), samples_per_period));
    container.result = {{"periods", measured.periods},
                        {"rotation",
                         {{"by_time", estimate_json(measured.rotation.by_time)},
                          {"rigid_by_time", estimate_json(measured.rotation.rigid_by_time)}}},
                        {"measured", measured_json(measured.reports)}};
}

FilmedContainer filmed(const ExperimentCall& call, const std::string& video, bool smooth) {
    FilmedContainer container;
    container.name = name_of_video(video);
    container.smooth = smooth;
    container.video = video;
    try {
        measure(call,
                is_named_as_tracks(video) ? fs::path(video) : tracks_of(call, video, container),
                container);
    } catch (const Interrupted&) {
        throw;
    } catch (const std::exception& failure) {  // of a file, a film, a drawing: a hole
        container.result = {{"failed", failure.what()}};
        if (!call.quiet) fmt::print(stderr, "{}: {}\n", video, failure.what());
    }
    return container;
}

void check(const ExperimentCall& call) {
    if (call.out.empty())
        throw UsageError("There is nowhere for the report to go: give --out DIR.");
    check_video_options(call.fps, call.frames);
    std::set<std::string> names;
    for (const auto* videos : {&call.rough, &call.smooth})
        for (const std::string& video : *videos)
            if (!names.insert(name_of_video(video)).second)
                throw UsageError(fmt::format(
                    "Two films are called '{}', and so would be their files; rename one.",
                    name_of_video(video)));
    if (!call.json.empty() && call.json != "-") reject_unwritable(call.json);
    std::vector<fs::path> all{call.json};
    for (const auto* videos : {&call.rough, &call.smooth})
        all.insert(all.end(), videos->begin(), videos->end());
    reject_same_files(all);
    check(call.settings);
}

std::string text_of(const ExperimentResult& result) {
    std::string text;
    for (const std::string& finding : result.findings) text += finding + "\n";
    if (result.runs > 0)
        text += fmt::format("{} simulated runs{}.\n", result.runs,
                            result.remembered > 0 ? fmt::format(", {} of them from an earlier call",
                                                                result.remembered)
                                                  : "");
    return text + fmt::format("wrote {} and {} more files there\n", result.files.back().string(),
                              result.files.size() - 1);
}

void make_experiment_report(ExperimentCall& call) {
    call.settings.out = call.out;
    call.settings.parameters = *call.parameters;
    call.settings.simulate = !call.no_simulation;
    call.settings.command = command_line();
    check(call);
    make_folder(call.out);
    std::vector<FilmedContainer> videos;
    for (const std::string& video : call.rough) videos.push_back(filmed(call, video, false));
    for (const std::string& video : call.smooth) videos.push_back(filmed(call, video, true));
    const auto good = std::count_if(videos.begin(), videos.end(),
                                    [](const FilmedContainer& video) { return video.good(); });
    if (good == 0)
        throw Failure(videos.size() == 1
                          ? fmt::format("The film could not be used: {}",
                                        videos.front().result["failed"].get<std::string>())
                          : fmt::format("None of the {} films could be used; the first, {}: {}",
                                        videos.size(), videos.front().video,
                                        videos.front().result["failed"].get<std::string>()));
    ExperimentResult result;
    {
        ProgressLine line("simulation", call.quiet);
        PaperControl control;
        control.stop = &stop_signal();
        control.progress = [&](double fraction, double) { line.show(fraction, "runs"); };
        result = make_experiment(videos, call.settings, control);
    }
    if (call.json == "-")
        print_all(result.json.dump(2) + "\n");
    else if (!call.json.empty())
        write_output(call.json, result.json.dump(2) + "\n");
    if (!call.quiet && call.json != "-") print_all(text_of(result));
    if (good < std::ptrdiff_t(videos.size()))
        throw Failure(fmt::format("{} of {} films could not be used; the report says why.",
                                  videos.size() - std::size_t(good), videos.size()));
}

void add_experiment_command(Subcommand& subcommand) {
    const auto call = std::make_shared<ExperimentCall>();
    const auto add = [&](const char* name, auto& into, const char* type, const char* description,
                         const char* group) {
        return subcommand.add_option(name, into, description)->type_name(type)->group(group);
    };
    const char* const videos = "The films";
    subcommand
        .add_option("films", call->rough,
                    "films as `swirl track` takes them, or tables that it wrote (.csv, .h5)")
        ->type_name("VIDEO")
        ->required();
    add("--smooth", call->smooth, "VIDEO",
        "films of a second, smoother kind of disc (Figure 4c); may be given several times", videos);
    add("--fps", call->fps, "NUMBER", "pictures per second, of all films [as each film says]",
        videos);
    add("--frames", call->frames, "NUMBER", "only the first so many pictures of each", videos);
    subcommand
        .add_flag("--spin", call->spin,
                  "measure how fast discs turn, from their texture (Figure 4b)")
        ->group(videos);
    call->parameters = add_run_options(subcommand, {"discs", "mixture", "radius"},
                                       {{"events", "5e5"},
                                        {"container_radius", "the films'"},
                                        {"amplitude", "the films'"},
                                        {"period", "such that the speed is 1"},
                                        {"path", "circle"}});
    const char* const simulation = "The simulation beside them";
    add("--seeds", call->settings.seeds, "NUMBER", "runs at each number of discs [3]", simulation);
    add("--smooth-mu", call->settings.smooth_mu, "NUMBER",
        "friction of the discs of --smooth films [0.1]", simulation);
    subcommand.add_flag("--no-simulation", call->no_simulation, "the films alone")
        ->group(simulation);
    add("--out", call->out, "DIR",
        "the report, its figures and tables; what is there of an earlier call and still holds is "
        "not done again",
        "Output");
    add("--json", call->json, "FILE|-", "write everything found to FILE, or - for stdout",
        "Output");
    subcommand.add_flag("--quiet", call->quiet, "no progress, no report")->group("Output");
    subcommand.set_examples(
        {"swirl experiment N24.mp4 N36.mp4 N48.mp4 --mu 0.5 --out marbles",
         "swirl experiment films/*.mp4 --preset experiment --out marbles",
         "swirl experiment rough36.mp4 rough48.mp4 --smooth smooth36.mp4 --smooth smooth48.mp4 "
         "--out both",
         "swirl experiment tracks.csv --no-simulation --out look"});
    subcommand.callback([call] { make_experiment_report(*call); });
}

const Command experiment_command(42, "experiment",
                                 "From a set of films to the paper's figures beside simulation.",
                                 add_experiment_command);

}  // namespace
}  // namespace swirl
