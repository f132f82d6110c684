#include "swirl/cli/track_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "swirl/io/atomic_file.hpp"
#include "swirl/io/optional_file.hpp"
#include "swirl/io/track_recording.hpp"
#include "swirl/io/track_repair.hpp"
#include "swirl/math/unit_circle.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/parameters.hpp"
#include "swirl/run/parse_json.hpp"
#include "swirl/run/reading.hpp"

namespace swirl {
namespace {

/// Also by name, so that the trajectory reader reports what is wrong with a damaged .h5 file.
bool is_hdf5(const std::string& file) {
    return file_signature(file).starts_with("\x89HDF") || file.ends_with(".h5");
}

/// A number of the calibration; `name` is the option and the key in a camera file.
struct CameraNumber {
    const char* name;
    std::string TrackTexts::*text;
    double otherwise, minimum;
};
constexpr double above_zero = 1e-12;
constexpr CameraNumber camera_numbers[] = {
    {"camera-fps", &TrackTexts::fps, 1.0, above_zero},
    {"scale", &TrackTexts::scale, 1.0, above_zero},
    {"omega", &TrackTexts::omega, 1.0, above_zero},
    {"phase", &TrackTexts::phase, 0.0, -std::numeric_limits<double>::infinity()},
    {"amplitude", &TrackTexts::amplitude, 0.0, 0.0},
    {"container-radius", &TrackTexts::container_radius, 1.0, above_zero},
};

double parse_number(const TrackTexts& texts, std::string_view name) {
    const auto number = std::find_if(std::begin(camera_numbers), std::end(camera_numbers),
                                     [&](const CameraNumber& n) { return n.name == name; });
    return number_option(number->name, texts.*number->text, number->otherwise, number->minimum);
}

/// Reads the calibration that `swirl track` wrote. Every field must appear exactly once with the
/// right type: a default instead of a missing field would give wrong results.
class CameraFile {
  public:
    explicit CameraFile(std::filesystem::path path) : path_(std::move(path)) {
        std::string repeated;
        const nlohmann::json json = parse_json(read_regular_file(path_), repeated);
        if (!repeated.empty()) fail(fmt::format("'{}' appears twice", repeated));
        if (json.is_object())
            if (const auto format = json.value("format", nlohmann::json(camera_format));
                format != camera_format)
                throw Failure(fmt::format("'{}' is in format {}, but this program reads format {}.",
                                          path_.string(), format.dump(), camera_format));
        if (!json.is_object() || !json.contains("camera") || !json["camera"].is_object())
            fail("it has no 'camera'");
        camera_ = json["camera"];
        json_ = json;
    }
    double number(const CameraNumber& number) const {
        const double value = number_in(field(number.name), number.name);
        if (value < number.minimum)
            fail(fmt::format("{} is {}, but it must be at least {}", number.name, value,
                             number.minimum));
        return value;
    }
    Vec2 point(const char* name) const {
        const nlohmann::json& value = field(name);
        if (!value.is_array() || value.size() != 2)
            fail(fmt::format("{} is {}, but it must be two numbers", name, value.dump()));
        return {number_in(value[0], name), number_in(value[1], name)};
    }
    CameraRecord record() const {
        CameraRecord record;
        if (const auto uneven = json_.find("uneven_times");
            uneven != json_.end() && !uneven->is_null())
            record.uneven_times = number_in(*uneven, "uneven_times");
        read_swaps(record);
        const auto motion = json_.find("camera_motion");
        if (motion == json_.end() || !motion->is_object()) return record;
        const auto frames = motion->find("frames");
        if (frames == motion->end()) return record;
        if (const auto first = motion->find("first_frame"); first != motion->end())
            record.first_frame = static_cast<std::int64_t>(number_in(*first, "first_frame"));
        for (const nlohmann::json& frame : *frames) {
            std::array<double, 4> pose{};
            if (!frame.is_array() || frame.size() != pose.size())
                fail(fmt::format("a pose of camera_motion is {}, but it must be four numbers",
                                 frame.dump()));
            for (std::size_t k = 0; k < pose.size(); ++k)
                pose[k] = number_in(frame[k], "camera_motion");
            if (pose[2] == 0.0 && pose[3] == 0.0) fail("a pose of camera_motion has the zoom 0");
            record.poses.push_back(pose);
        }
        return record;
    }
    bool flag(const char* name) const {
        const nlohmann::json& value = field(name);
        if (!value.is_boolean())
            fail(fmt::format("{} is {}, but it must be true or false", name, value.dump()));
        return value.get<bool>();
    }

  private:
    void read_swaps(CameraRecord& record) const {
        const nlohmann::json none = nlohmann::json::array();
        const auto quality = json_.find("quality");
        if (quality == json_.end() || !quality->is_object()) return;
        for (const nlohmann::json& swap : quality->value("possible_swaps", none)) {
            if (!swap.is_object() || !swap.contains("linked_from")) continue;
            std::array<std::int64_t, 2> frames{};
            frames[0] = std::int64_t(number_in(swap["linked_from"], "linked_from"));
            frames[1] = std::int64_t(number_in(swap.value("frame", nlohmann::json()), "frame"));
            const auto [from, to] = std::minmax(frames[0], frames[1]);
            for (const nlohmann::json& disc : swap.value("discs", none))
                record.uncertain.push_back(
                    {.id = std::int64_t(number_in(disc, "discs")), .from = from, .to = to});
        }
    }
    [[noreturn]] void fail(const std::string& what) const {
        throw Failure(fmt::format(
            "'{}' is not a calibration by `swirl track`: {}.\nhint: remove it, or track the video "
            "again.",
            path_.string(), what));
    }
    const nlohmann::json& field(const char* name) const {
        const auto found = camera_.find(name);
        if (found == camera_.end()) fail(fmt::format("{} is missing", name));
        return *found;
    }
    double number_in(const nlohmann::json& value, const char* name) const {
        if (!value.is_number())
            fail(fmt::format("{} is {}, but it must be a number", name, value.dump()));
        return value.get<double>();
    }

    std::filesystem::path path_;
    nlohmann::json json_, camera_;
};

/// Fills options that were not given from the calibration next to `file`, if it exists.
TrackTexts with_calibration(TrackTexts texts, const std::string& file) {
    const std::filesystem::path calibration = camera_file(file);
    if (!file_exists(calibration)) return texts;
    const CameraFile camera(calibration);
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
    subcommand.in(group).add({
        {"--camera-fps", &texts.fps, "Frames (LAMMPS: steps) per unit of time [1]", "NUMBER"},
        {"--scale", &texts.scale, "Image scale, pixels per disc radius [1]", "NUMBER"},
        {"--omega", &texts.omega, "Angular velocity of the container, rad per unit of time",
         "NUMBER"},
        {"--centre", &texts.centre, "Centre of the container's path, in pixels [0,0]", "X,Y"},
        {"--phase", &texts.phase, "Container phase at frame 0, counter-clockwise from +x [0]",
         "DEG"},
        {"--clockwise", &texts.clockwise, "The container moves clockwise in the image"},
        {"--columns", &texts.columns, "Columns of a table, frame=NAME,particle=NAME,x=NAME,y=NAME",
         "LIST"},
        {"--y-up", &texts.y_up, "Upward y axis in a table, not downward"},
    });
}

void throw_option_of_tracks(std::string_view name, const std::string& file) {
    throw UsageError(fmt::format(
        "--{} applies to a camera's tracks, but {}.", name,
        file.empty() ? "no FILE is given" : fmt::format("'{}' is a trajectory of swirl", file)));
}

void reject_track_options(const TrackTexts& given, const std::string& file) {
    for (const CameraNumber& number : camera_numbers)
        if (!(given.*number.text).empty()) throw_option_of_tracks(number.name, file);
    if (!given.centre.empty()) throw_option_of_tracks("centre", file);
    if (given.clockwise) throw_option_of_tracks("clockwise", file);
    if (!given.columns.empty()) throw_option_of_tracks("columns", file);
    if (given.y_up) throw_option_of_tracks("y-up", file);
}

bool is_named_as_tracks(const std::string& file) {
    return file.ends_with(".csv") || file.ends_with(".h5");
}

bool is_trajectory(const std::string& file) { return is_hdf5(file) && !is_track_recording(file); }

namespace {

/// The tracks as they are in the file.
Tracks read_unrepaired_tracks(const std::string& file, const TableLayout& layout) {
    const std::string begin = file_signature(file);
    const bool is_table = !is_hdf5(file) && !begin.starts_with("ITEM:");
    if (!is_table && (layout.has_names() || layout.y_up))
        throw UsageError(fmt::format("--{} applies to a table, but '{}' is none.",
                                     layout.y_up ? "y-up" : "columns", file));
    if (is_hdf5(file)) return read_track_recording(file);
    if (begin.starts_with("ITEM:")) return read_lammps_dump(file);
    if (std::any_of(begin.begin(), begin.end(), [](char c) { return c >= 0 && c < '\t'; }))
        throw Failure(fmt::format(
            "'{}' is none of these: swirl trajectory or tracks (HDF5), table of a tracker "
            "(CSV), LAMMPS text dump.",
            file));
    return read_track_table(file, layout);
}

}  // namespace

TableLayout table_layout(const TrackTexts& given) {
    TableLayout layout{.y_up = given.y_up};
    if (given.columns.empty()) return layout;
    for (const std::string_view part : split(given.columns, ",")) {
        const std::size_t sign = std::min(part.find('='), part.size());
        const std::string_view key = part.substr(0, sign);
        std::string* const name = key == "frame"      ? &layout.frame
                                  : key == "particle" ? &layout.particle
                                  : key == "x"        ? &layout.x
                                  : key == "y"        ? &layout.y
                                                      : nullptr;
        if (name == nullptr || !name->empty() || sign + 1 >= part.size())
            throw UsageError(fmt::format(
                "--columns is '{}', but it must give names to frame, particle, x or y, for example "
                "frame=Slice,particle=Track.",
                given.columns));
        *name = part.substr(sign + 1);
    }
    return layout;
}

Tracks read_tracks(const std::string& file, const TrackScale& scale, const TableLayout& layout) {
    Tracks tracks = read_unrepaired_tracks(file, layout);
    repair(tracks, scale.pixels_per_radius);
    return tracks;
}

CameraRecord camera_record(const std::string& file) {
    const std::filesystem::path calibration = camera_file(file);
    if (!file_exists(calibration)) return {};
    return CameraFile(calibration).record();
}

TrackScale track_scale(const TrackTexts& given, const std::string& file) {
    const TrackTexts texts = with_calibration(given, file);
    for (const auto& [name, text] :
         {std::pair("omega", &texts.omega), std::pair("container-radius", &texts.container_radius)})
        if (text->empty()) {
            // A file of another kind is the first problem.
            (void)read_unrepaired_tracks(file, table_layout(given));
            throw UsageError(fmt::format(
                "'{}' has no calibration next to it (a .camera.json file), so --{} is required.\n"
                "hint: also check the defaults --camera-fps 1, --scale 1, --centre 0,0, "
                "--amplitude 0 and --phase 0.",
                file, name));
        }
    TrackScale scale;
    scale.frames_per_time = parse_number(texts, "camera-fps");
    scale.pixels_per_radius = parse_number(texts, "scale");
    scale.period = 2.0 * pi / parse_number(texts, "omega");
    scale.amplitude = parse_number(texts, "amplitude");
    scale.phase = parse_number(texts, "phase") * pi / 180.0;
    scale.container_radius = parse_number(texts, "container-radius");
    scale.clockwise = texts.clockwise;
    scale.calibrated = given.scale.empty() && file_exists(camera_file(file));
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
