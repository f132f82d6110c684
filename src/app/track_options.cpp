#include "swirl/app/track_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "swirl/files/track_mending.hpp"
#include "swirl/files/track_recording.hpp"
#include "swirl/files/whole_file.hpp"
#include "swirl/math/unit_circle.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/parameters.hpp"

namespace swirl {
namespace {

/// By its name too: what is wrong with it is then said by who knows trajectories.
bool is_hdf5(const std::string& file) {
    return first_bytes(file).starts_with("\x89HDF") || file.ends_with(".h5");
}

/// What `swirl track` found, where nothing else was said.
TrackTexts completed(TrackTexts texts, const std::string& file) {
    const std::filesystem::path beside = camera_file(file);
    if (!std::filesystem::is_regular_file(beside)) return texts;
    const auto json = nlohmann::json::parse(read_regular_file(beside), nullptr, false);
    const auto camera = json.is_object() ? json.find("camera") : json.end();
    if (!json.is_object() || camera == json.end() || !camera->is_object())
        throw Failure(fmt::format(
            "'{}' is not what `swirl track` writes beside its tracks; remove it, or track the film "
            "again.",
            beside.string()));
    if (const auto format = json.value("format", nlohmann::json(camera_format));
        format != camera_format)
        throw Failure(fmt::format("'{}' is in format {}, but this program reads format {}.",
                                  beside.string(), format.dump(), camera_format));
    // Any of these would be of another calibration than the rest.
    const bool clockwise = texts.clockwise;
    for (const auto& [name, text] :
         {std::pair("camera-fps", &texts.fps), std::pair("scale", &texts.scale),
          std::pair("omega", &texts.omega), std::pair("phase", &texts.phase),
          std::pair("amplitude", &texts.amplitude),
          std::pair("container-radius", &texts.container_radius)}) {
        const auto value = camera->find(name);
        if (text->empty() && value != camera->end() && value->is_number())
            *text = fmt::format("{}", value->get<double>());
    }
    const auto centre = camera->find("centre");
    if (texts.centre.empty() && centre != camera->end() && centre->is_array() &&
        centre->size() == 2 && (*centre)[0].is_number() && (*centre)[1].is_number())
        texts.centre = fmt::format("{},{}", (*centre)[0].get<double>(), (*centre)[1].get<double>());
    const auto sense = camera->find("clockwise");
    texts.clockwise =
        clockwise || (sense != camera->end() && sense->is_boolean() && sense->get<bool>());
    return texts;
}

}  // namespace

std::filesystem::path camera_file(std::filesystem::path tracks) {
    return tracks.replace_extension(".camera.json");
}

double number_option(const std::string& name, const std::string& text, double otherwise,
                     double from) {
    if (text.empty()) return otherwise;
    const auto value = read_number(text);
    if (!value || *value < from)
        throw WrongCall(fmt::format("--{} is '{}', but it must be a number{}.", name, text,
                                    from > -1e300 ? fmt::format(" of at least {}", from) : ""));
    return *value;
}

void add_track_options(Subcommand& subcommand, TrackTexts& texts, const std::string& group) {
    const auto text = [&](const std::string& name, std::string& into, const char* type,
                          const char* description) {
        subcommand.add_option(name, into, description)->type_name(type)->group(group);
    };
    text("--camera-fps", texts.fps, "NUMBER", "frames per unit of time (LAMMPS: steps) [1]");
    text("--scale", texts.scale, "NUMBER", "pixels per disc radius [1]");
    text("--omega", texts.omega, "NUMBER",
         "angular velocity of the swirl, in radians per unit of time");
    text("--centre", texts.centre, "X,Y", "the swirl centre, in pixels [0,0]");
    text("--phase", texts.phase, "DEGREES",
         "of the container at frame 0, as the camera saw it, counter-clockwise from the right [0]");
    subcommand.add_flag("--clockwise", texts.clockwise, "the swirl ran clockwise in the picture")
        ->group(group);
}

bool is_named_as_tracks(const std::string& file) {
    return file.ends_with(".csv") || file.ends_with(".h5");
}

bool is_trajectory(const std::string& file) { return is_hdf5(file) && !is_track_recording(file); }

Tracks read_tracks(const std::string& file, const TrackScale& scale) {
    const std::string begin = first_bytes(file);
    const auto mended = [&](Tracks tracks) {
        mend(tracks, scale.pixels_per_radius);
        return tracks;
    };
    if (is_hdf5(file)) return mended(read_track_recording(file));
    if (begin.starts_with("ITEM:")) return mended(read_lammps_dump(file));
    if (std::any_of(begin.begin(), begin.end(), [](char c) { return c >= 0 && c < '\t'; }))
        throw Failure(
            fmt::format("'{}' is neither a trajectory or tracks of swirl (HDF5), nor a table of "
                        "trackpy (CSV), nor a "
                        "LAMMPS text dump.",
                        file));
    return mended(read_trackpy_csv(file));
}

TrackScale track_scale(const TrackTexts& given, const std::string& file) {
    const TrackTexts texts = completed(given, file);
    constexpr double any = -std::numeric_limits<double>::infinity();
    for (const auto& [name, text] :
         {std::pair("omega", &texts.omega), std::pair("container-radius", &texts.container_radius)})
        if (text->empty())
            throw WrongCall(fmt::format(
                "'{}' does not say how the container moved; --{} is needed (and --camera-fps, "
                "--scale, --centre, --amplitude, --phase where they are not 1, 1, 0,0, 0, 0). "
                "Tracks that were "
                "made of a film here have a file beside them that says all that.",
                file, name));
    TrackScale scale;
    scale.frames_per_time = number_option("camera-fps", texts.fps, 1.0, 1e-12);
    scale.pixels_per_radius = number_option("scale", texts.scale, 1.0, 1e-12);
    scale.period = 2.0 * pi / number_option("omega", texts.omega, 1.0, 1e-12);
    scale.amplitude = number_option("amplitude", texts.amplitude, 0.0, 0.0);
    scale.phase = number_option("phase", texts.phase, 0.0, any) * pi / 180.0;
    scale.container_radius = number_option("container-radius", texts.container_radius, 1.0, 1e-12);
    scale.clockwise = texts.clockwise;
    if (texts.centre.empty()) return scale;
    const std::size_t comma = texts.centre.find(',');
    const auto x = read_number(texts.centre.substr(0, comma));
    const auto y =
        comma == std::string::npos ? std::nullopt : read_number(texts.centre.substr(comma + 1));
    if (!x || !y)
        throw WrongCall(fmt::format(
            "--centre is '{}', but it must be X,Y in pixels, for example 512,384.", texts.centre));
    scale.swirl_centre = {*x, *y};
    return scale;
}

}  // namespace swirl
