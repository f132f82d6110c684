#include "swirl/cli/track_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "swirl/io/atomic_file.hpp"
#include "swirl/io/track_recording.hpp"
#include "swirl/io/track_repair.hpp"
#include "swirl/math/unit_circle.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/parameters.hpp"

namespace swirl {
namespace {

/// By its name too: what is wrong with it is then said by who knows trajectories.
bool is_hdf5(const std::string& file) {
    return first_bytes(file).starts_with("\x89HDF") || file.ends_with(".h5");
}

/// A number of the calibration, by its name as an option and in a camera file.
struct CameraNumber {
    const char* name;
    std::string TrackTexts::*text;
    double otherwise, minimum;
};
constexpr CameraNumber camera_numbers[] = {
    {"camera-fps", &TrackTexts::fps, 1.0, 1e-12},
    {"scale", &TrackTexts::scale, 1.0, 1e-12},
    {"omega", &TrackTexts::omega, 1.0, 1e-12},
    {"phase", &TrackTexts::phase, 0.0, -std::numeric_limits<double>::infinity()},
    {"amplitude", &TrackTexts::amplitude, 0.0, 0.0},
    {"container-radius", &TrackTexts::container_radius, 1.0, 1e-12},
};

double given_number(const TrackTexts& texts, std::string_view name) {
    const auto number = std::find_if(std::begin(camera_numbers), std::end(camera_numbers),
                                     [&](const CameraNumber& n) { return n.name == name; });
    return number_option(number->name, texts.*number->text, number->otherwise, number->minimum);
}

/// What `swirl track` wrote of the dish. Every field must be there, once and of its type: a field
/// that is skipped would leave its default, and wrong results.
class CameraFile {
  public:
    explicit CameraFile(std::filesystem::path path) : path_(std::move(path)) {
        std::vector<std::set<std::string>> keys;  // of the objects that are open
        const auto check = [&](int, nlohmann::json::parse_event_t event, nlohmann::json& part) {
            using Event = nlohmann::json::parse_event_t;
            if (event == Event::object_start) keys.emplace_back();
            if (event == Event::object_end) keys.pop_back();
            if (event == Event::key && !keys.back().insert(part.get<std::string>()).second)
                wrong(fmt::format("'{}' appears twice", part.get<std::string>()));
            return true;
        };
        const auto json = nlohmann::json::parse(read_regular_file(path_), check, false);
        if (json.is_object())
            if (const auto format = json.value("format", nlohmann::json(camera_format));
                format != camera_format)
                throw Failure(fmt::format("'{}' is in format {}, but this program reads format {}.",
                                          path_.string(), format.dump(), camera_format));
        if (!json.is_object() || !json.contains("camera") || !json["camera"].is_object())
            wrong("it has no 'camera'");
        camera_ = json["camera"];
    }
    double number(const CameraNumber& number) const {
        const double value = number_in(field(number.name), number.name);
        if (value < number.minimum)
            wrong(fmt::format("{} is {}, but it must be at least {}", number.name, value,
                              number.minimum));
        return value;
    }
    Vec2 point(const char* name) const {
        const nlohmann::json& value = field(name);
        if (!value.is_array() || value.size() != 2)
            wrong(fmt::format("{} is {}, but it must be two numbers", name, value.dump()));
        return {number_in(value[0], name), number_in(value[1], name)};
    }
    bool flag(const char* name) const {
        const nlohmann::json& value = field(name);
        if (!value.is_boolean())
            wrong(fmt::format("{} is {}, but it must be true or false", name, value.dump()));
        return value.get<bool>();
    }

  private:
    [[noreturn]] void wrong(const std::string& what) const {
        throw Failure(fmt::format(
            "'{}' is not what `swirl track` writes beside its tracks: {}. Remove it, or track the "
            "film again.",
            path_.string(), what));
    }
    const nlohmann::json& field(const char* name) const {
        const auto found = camera_.find(name);
        if (found == camera_.end()) wrong(fmt::format("{} is missing", name));
        return *found;
    }
    double number_in(const nlohmann::json& value, const char* name) const {
        if (!value.is_number())
            wrong(fmt::format("{} is {}, but it must be a number", name, field(name).dump()));
        return value.get<double>();
    }

    std::filesystem::path path_;
    nlohmann::json camera_;
};

/// What `swirl track` found, where nothing else was said.
TrackTexts completed(TrackTexts texts, const std::string& file) {
    const std::filesystem::path beside = camera_file(file);
    if (!std::filesystem::is_regular_file(beside)) return texts;
    const CameraFile camera(beside);
    for (const CameraNumber& number : camera_numbers) {
        const std::string found = fmt::format("{}", camera.number(number));
        if ((texts.*number.text).empty()) texts.*number.text = found;
    }
    const Vec2 centre = camera.point("centre");
    if (texts.centre.empty()) texts.centre = fmt::format("{},{}", centre.x, centre.y);
    texts.clockwise = camera.flag("clockwise") || texts.clockwise;
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
        throw UsageError(fmt::format("--{} is '{}', but it must be a number{}.", name, text,
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
    const auto repaired = [&](Tracks tracks) {
        mend(tracks, scale.pixels_per_radius);
        return tracks;
    };
    if (is_hdf5(file)) return repaired(read_track_recording(file));
    if (begin.starts_with("ITEM:")) return repaired(read_lammps_dump(file));
    if (std::any_of(begin.begin(), begin.end(), [](char c) { return c >= 0 && c < '\t'; }))
        throw Failure(
            fmt::format("'{}' is neither a trajectory or tracks of swirl (HDF5), nor a table of "
                        "trackpy (CSV), nor a "
                        "LAMMPS text dump.",
                        file));
    return repaired(read_trackpy_csv(file));
}

TrackScale track_scale(const TrackTexts& given, const std::string& file) {
    const TrackTexts texts = completed(given, file);
    for (const auto& [name, text] :
         {std::pair("omega", &texts.omega), std::pair("container-radius", &texts.container_radius)})
        if (text->empty())
            throw UsageError(fmt::format(
                "'{}' does not say how the container moved; --{} is needed (and --camera-fps, "
                "--scale, --centre, --amplitude, --phase where they are not 1, 1, 0,0, 0, 0). "
                "Tracks that were "
                "made of a film here have a file beside them that says all that.",
                file, name));
    TrackScale scale;
    scale.frames_per_time = given_number(texts, "camera-fps");
    scale.pixels_per_radius = given_number(texts, "scale");
    scale.period = 2.0 * pi / given_number(texts, "omega");
    scale.amplitude = given_number(texts, "amplitude");
    scale.phase = given_number(texts, "phase") * pi / 180.0;
    scale.container_radius = given_number(texts, "container-radius");
    scale.clockwise = texts.clockwise;
    if (texts.centre.empty()) return scale;
    const std::size_t comma = texts.centre.find(',');
    const auto x = read_number(texts.centre.substr(0, comma));
    const auto y =
        comma == std::string::npos ? std::nullopt : read_number(texts.centre.substr(comma + 1));
    if (!x || !y)
        throw UsageError(fmt::format(
            "--centre is '{}', but it must be X,Y in pixels, for example 512,384.", texts.centre));
    scale.swirl_centre = {*x, *y};
    return scale;
}

}  // namespace swirl
