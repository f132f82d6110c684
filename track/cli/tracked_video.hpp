// Output of a tracked video: the tracks, the calibration next to them, and a report.
#pragma once

#include <nlohmann/json.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace swirl::tracking {
struct TrackedVideo;
struct TrackingSettings;
struct VideoSpins;
}  // namespace swirl::tracking

namespace swirl {

class ProgressLine;

/// The video, and known lengths in it.
struct VideoSource {
    std::string video;
    std::optional<double> container_diameter, disc_diameter;  // millimetres
};

/// Settings with a stop signal; `line` shows the progress and must outlive them.
tracking::TrackingSettings tracking_settings(const std::string& video,
                                             const std::optional<double>& fps,
                                             const std::optional<std::int64_t>& frames,
                                             ProgressLine& line);

/// Writes the first frame of the video with the discs drawn over it to `image`.
void draw_found(const tracking::TrackedVideo& tracked, const std::string& video,
                const std::filesystem::path& image);

/// Files of the report of one video.
inline constexpr const char* video_report_files[] = {
    "report.html", "found.json",       "frames.csv",      "discs.csv",
    "video.png",   "figure_found.png", "figure_found.pdf"};

/// Writes video_report_files into `folder`; returns the path of report.html.
std::filesystem::path write_video_report(const tracking::TrackedVideo& video,
                                         const VideoSource& source,
                                         const nlohmann::ordered_json& found,
                                         const std::filesystem::path& folder);

/// Tilt of the camera with its error, or its upper bound.
std::string camera_text(const tracking::TrackedVideo& video);

/// Phase of the container in the first frame: 0 to 360 degrees, counter-clockwise from +x.
double first_phase(const tracking::TrackedVideo& video);

/// Writes the tracks and the calibration (camera_file()), each atomically; returns the latter.
nlohmann::ordered_json write_tracks(const tracking::TrackedVideo& video, const VideoSource& source,
                                    const std::filesystem::path& out,
                                    const tracking::VideoSpins* spins = nullptr);

}  // namespace swirl
