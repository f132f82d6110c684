// What is written of a film that was tracked: the tracks, and beside them all that was found.
#pragma once

#include <nlohmann/json.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace swirl {

class ProgressLine;
struct TrackedVideo;
struct TrackingSettings;
struct VideoSpins;

/// Where the pictures are from, and what is known of them.
struct VideoSource {
    std::string video;
    std::optional<double> container_diameter, disc_diameter;  // millimetres
};

/// Throws Failure: this build has no OpenCV.
[[noreturn]] void throw_no_eyes();

/// Throws WrongCall: --fps and --frames must be above 0.
void check_video_options(const std::optional<double>& fps,
                         const std::optional<std::int64_t>& frames);

/// What all who track a film set alike; `line` shows how far it is, and must outlive it.
TrackingSettings tracking_settings(const std::string& video, const std::optional<double>& fps,
                                   const std::optional<std::int64_t>& frames, ProgressLine& line);

/// The film's first picture with the discs drawn over it.
void draw_found(const TrackedVideo& tracked, const std::string& video, const std::string& caption,
                const std::filesystem::path& picture);

/// The report of one film, with the tables and the drawings that it is made of.
inline constexpr const char* video_report_files[] = {
    "report.html", "found.json",       "pictures.csv",    "discs.csv",
    "film.png",    "figure_found.png", "figure_found.pdf"};

/// Writes these; returns the path of report.html.
std::filesystem::path write_video_report(const TrackedVideo& video, const VideoSource& source,
                                         const nlohmann::ordered_json& found,
                                         const std::filesystem::path& folder);

/// Circle or polygon, as far as can be told.
std::string shape_text(const TrackedVideo& video);

/// How the camera leans, as far as can be told.
std::string tilt_text(const TrackedVideo& video);

/// The dish at the first picture, as one reads it off: from 0 to 360 degrees.
double phase_of(const TrackedVideo& video);

/// Both files, each whole or not at all; returns what stands in the second (camera_file()).
nlohmann::ordered_json write_tracks(const TrackedVideo& video, const VideoSource& source,
                                    const std::filesystem::path& out,
                                    const VideoSpins* spins = nullptr);

}  // namespace swirl
