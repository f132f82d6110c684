// The pictures of a film, one after the other, in grey: decoded by ffmpeg, which also turns what a
// telephone says is to be turned. A film is a file that ffmpeg reads, numbered pictures
// ('frames/%05d.png'), or a camera of this machine (/dev/video0).
#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "swirl/render/ffmpeg.hpp"

namespace swirl {

/// When the pictures were taken, as the file says.
struct VideoTimes {
    std::vector<double> seconds;  // ascending; empty where it does not say
    std::int64_t pictures = 0;    // 0: not known
    double fps = 0.0;             // of the whole film; 0 where it does not say
    double jitter = 0.0;          // largest deviation from equal steps, in steps
};

/// Reads the file through without decoding a picture. Throws Failure if it is no film.
VideoTimes video_times(const std::string& source);

/// Strictly ascending times, and which frames of the video had no time of their own.
struct AscendingTimes {
    std::vector<double> seconds;
    std::vector<std::size_t> untimed;  // ascending
};

/// Frames without a finite time, and frames that share theirs: a step below a hundredth of the
/// median step is none. Which of two such frames has the wrong time cannot be known, so both are
/// untimed, and get times spread evenly between the neighbouring frames that have one. Throws
/// Failure if fewer than two frames are left. `seconds` ascending.
AscendingTimes ascending_times(const std::vector<double>& seconds);

class Video {
  public:
    /// Every `every`th picture, the first one first. Throws Failure.
    explicit Video(std::string source, std::int64_t every = 1);

    /// The next picture (8 bits a pixel), or false at the end. Throws Failure if there is not one.
    bool next(cv::Mat& grey);
    /// How many there were so far.
    std::int64_t count() const { return count_; }
    /// What ffmpeg had to say about a damaged film; empty if nothing.
    std::string problem() const { return problem_; }

  private:
    bool read(std::uint8_t* into, std::size_t bytes);
    bool read_picture(cv::Mat& grey);

    std::string video_, problem_;
    std::unique_ptr<Ffmpeg> ffmpeg_;
    std::int64_t count_ = 0;
};

}  // namespace swirl
