// The frames of a video in order, in grey or in colours. ffmpeg decodes them, and rotates them and
// makes their pixels square as the file asks.
//
// A source is a file that ffmpeg reads, or numbered images ('frames/%05d.png').
#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "swirl/render/ffmpeg.hpp"
#include "track/video/colour_plane.hpp"

namespace swirl::tracking {

/// When the frames were taken, according to the file.
struct VideoTimes {
    std::vector<double> seconds;   // ascending; empty if unknown
    std::int64_t frame_count = 0;  // 0: unknown
    double fps = 0.0;              // mean over the video; 0 if unknown
    double jitter = 0.0;           // largest deviation from equal steps, in steps
};

/// Reads the file without decoding its frames. Throws Failure if it is not a video, and UsageError
/// for a camera, a stream, or a wrong pattern of numbered images.
VideoTimes video_times(const std::string& source);

/// Strictly ascending times, and the frames for which the times in the video are not used.
struct AscendingTimes {
    std::vector<double> seconds;
    std::vector<std::size_t> untimed;  // ascending
};

/// Replaces missing, descending and shared times. A frame is untimed if its time is not finite, or
/// less than a hundredth of the median step from the time of another frame. Either of two such
/// frames may have the wrong time, so both are untimed. Untimed frames get evenly spaced times
/// between their timed neighbours. Throws Failure if fewer than two frames are timed.
AscendingTimes ascending_times(const std::vector<double>& seconds);

/// For errors if ffmpeg is not installed.
inline constexpr const char* missing_ffmpeg =
    "videos are read by the program ffmpeg, which was not found\n"
    "hint: install it (apt-get install ffmpeg)";

/// Whether the even rows of a frame were taken before the odd ones.
enum class FieldOrder { progressive, top_first, bottom_first };
/// ffmpeg's name of the order of the fields, for its filter bwdif.
inline const char* parity_of(FieldOrder order) {
    return order == FieldOrder::top_first ? "tff" : "bff";
}

/// Determined from the motion in the frames from number `first` on, by ffmpeg's filter idet.
FieldOrder field_order(const std::string& source, std::int64_t first);

/// How frames are read.
struct FrameReading {
    FieldOrder fields = FieldOrder::progressive;
    bool in_colours = false;                        // three channels of 8 bits: red, green, blue
    std::shared_ptr<const ColourPlane> plane = {};  // if set, replaces the usual grey
};

class Video {
  public:
    /// Every `every`th frame from number `first` on. The second field of interlaced frames is
    /// replaced: the frame is an estimate for the time of its first field. Throws Failure.
    explicit Video(std::string source, std::int64_t every = 1, std::int64_t first = 0,
                   FrameReading reading = {});

    /// The next frame (8 bits a pixel), or false at the end. Throws Failure if there are no frames.
    bool next(cv::Mat& frame);
    /// Number of frames read so far.
    std::int64_t count() const { return count_; }
    /// ffmpeg's error message for a damaged video, so far; empty if there is none.
    std::string problem() const { return ffmpeg_ ? ffmpeg_->problem() : problem_; }

  private:
    bool read(std::uint8_t* into, std::size_t bytes);
    bool read_frame(cv::Mat& frame);
    bool colours_from_file() const { return reading_.in_colours || reading_.plane; }

    std::string video_, problem_;
    FrameReading reading_;
    cv::Mat colours_;  // of the last frame, if `reading_` has a plane
    std::unique_ptr<Ffmpeg> ffmpeg_;
    std::int64_t count_ = 0;
};

}  // namespace swirl::tracking
