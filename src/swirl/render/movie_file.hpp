// Writes a movie file frame by frame through ffmpeg, which runs as a child process.
//
//     .mp4    H.264, 4:2:0, with the index in front so that browsers can start at once
//     .webm   VP9
//     .gif    one palette for the whole movie, without dithering, so that flat colours stay flat
//
// ffmpeg uses a fixed number of threads and writes no dates, so equal frames give equal bytes on
// one machine. The movie is written to a temporary file and renamed when it is complete.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "swirl/render/canvas.hpp"
#include "swirl/render/ffmpeg.hpp"

namespace swirl {

enum class MovieFormat { mp4, webm, gif };

/// The format by the file extension; nothing if it is no movie format.
std::optional<MovieFormat> movie_format(const std::string& path);

/// An error message if no movie of this kind can be made.
std::optional<std::string> movie_problem(MovieFormat format, Size size, int frames_per_second);

/// How H.264 compresses.
struct Compression {
    /// The constant rate factor; 0 is lossless. With 24, ten seconds of 48 discs at 1280x720 take
    /// less than 3 MB.
    int loss = 24;
    /// As a camera, which has no time to look for the best description of a frame. Every number
    /// about tracked synthetic videos depends on it.
    bool by_camera = false;
};

class MovieWriter {
  public:
    /// Starts ffmpeg. Throws DrawFailure if ffmpeg is not installed or does not start.
    MovieWriter(const std::string& path, MovieFormat format, Size size, int frames_per_second,
                const Compression& compression = {});
    /// Without finish(): ends ffmpeg and removes the temporary file.
    ~MovieWriter();
    MovieWriter(const MovieWriter&) = delete;
    MovieWriter& operator=(const MovieWriter&) = delete;

    /// Adds a frame: planes (planar.hpp) for mp4 and webm, Canvas::pixels() for gif. Throws
    /// DrawFailure with the output of ffmpeg if that has died.
    void write(std::span<const std::uint8_t> frame);
    /// Waits for ffmpeg and gives the file its name. Throws DrawFailure.
    void finish();

  private:
    [[noreturn]] void fail(int status);
    void open_temporary();

    std::string path_, temporary_;
    std::unique_ptr<Ffmpeg> ffmpeg_;
    int lock_ = -1;          // lock of the temporary file, which ffmpeg opens for itself
    bool finished_ = false;  // the temporary file is gone
};

}  // namespace swirl
