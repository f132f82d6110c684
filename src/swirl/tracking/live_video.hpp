// Frames of a video while it is recorded, in grey. ffmpeg decodes them.
//
// A source is a camera of this machine (/dev/video0), a folder that receives numbered images, such
// images by their pattern ('frames/%05d.png'), or '-': a video, or images, on standard input.
//
// Numbered images are read in the order of their numbers, each as soon as its file is complete. A
// number that does not arrive ends the video, because the times of later frames would be wrong.
// ffmpeg returns an image when it has received the next two.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>

#include "swirl/render/ffmpeg.hpp"

namespace swirl {

struct LiveSource {
    std::string name;
    std::optional<double> fps;                // requested from a camera
    double timeout = 10.0;                    // seconds without a new frame that end the video
    std::int64_t max_frames = 0;              // 0: no limit
    const std::atomic<bool>* stop = nullptr;  // set: the video ends
};

class LiveVideo {
  public:
    /// Throws UsageError for a source of another kind, and Failure if there is no such source.
    explicit LiveVideo(LiveSource source);
    ~LiveVideo();
    LiveVideo(const LiveVideo&) = delete;
    LiveVideo& operator=(const LiveVideo&) = delete;

    /// Waits for the next frame (8 bits a pixel). False at the end. Throws Failure if none arrives.
    bool next(cv::Mat& grey);
    std::int64_t count() const { return count_; }
    /// Frames per second by the clock of this machine, for a camera; 0 for other sources.
    double camera_fps() const;
    /// Why the video ended, if it was not by `stop`, by `max_frames` or by the end of its source.
    const std::string& problem() const { return problem_; }
    /// The numbered images, to be read again; empty for other sources.
    const std::string& pattern() const { return pattern_; }

  private:
    using Clock = std::chrono::steady_clock;
    bool start();
    bool find_images();
    void load_next_image();
    bool load_standard_input();
    bool has_input() const { return sent_ < input_.size(); }
    bool exchange(int wait_ms);
    bool take_frame(cv::Mat& grey);
    bool is_over();
    void flush();
    std::string unfinished_text() const;
    [[noreturn]] void throw_no_frames() const;

    LiveSource source_;
    bool camera_ = false, standard_input_ = false;
    std::string pattern_, problem_;
    std::unique_ptr<Ffmpeg> ffmpeg_;
    std::string input_, output_;  // to and from ffmpeg
    std::size_t sent_ = 0;        // of `input_`
    std::int64_t next_number_ = 0, images_ = 0, count_ = 0;
    bool flushing_ = false;  // no input follows
    Clock::time_point last_, first_frame_, last_frame_;
};

}  // namespace swirl
