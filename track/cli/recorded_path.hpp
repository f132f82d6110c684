// The motion of a container in a video as a file for `swirl run --motion`.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace swirl::tracking {
struct RecordedMotion;
struct TrackedVideo;
}  // namespace swirl::tracking

namespace swirl {

struct VideoSource;

/// Writes one period of the motion as a closed path of equal steps in time. Lengths are in disc
/// radii. Times are in the program's unit: the period is that of the paper.
void write_motion(const tracking::TrackedVideo& video, const tracking::RecordedMotion& motion,
                  const VideoSource& source, const std::filesystem::path& file);

/// Lines for the terminal: the motion with its errors, and the run that uses the file.
std::string motion_text(const tracking::TrackedVideo& video, const tracking::RecordedMotion& motion,
                        const VideoSource& source, const std::string& file);

/// Warnings about parts of the motion that a path of one period cannot describe.
std::vector<std::string> motion_warnings(const tracking::RecordedMotion& motion);

}  // namespace swirl
