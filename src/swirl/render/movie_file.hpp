// A movie file, written frame by frame through ffmpeg, which runs as a process of its own.
//
//     .mp4    H.264, 4:2:0, its index in front so that browsers start at once
//     .webm   VP9
//     .gif    a palette made for the whole movie, without dithering, so that flat colours stay flat
//
// ffmpeg works with a fixed number of threads and writes no dates, so the same frames give the same
// bytes on one machine. The file is written aside and appears under its name when it is complete.
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

/// By the ending of the name; nothing for any other ending.
std::optional<MovieFormat> movie_format(const std::string& path);

/// Why no such movie can be made, as a full sentence; nothing if it can.
std::optional<std::string> movie_problem(MovieFormat format, Size size, int frames_per_second);

class MovieWriter {
  public:
    /// Starts ffmpeg. `loss` is what H.264 calls its constant rate factor: 0 is none, 18 invisible
    /// in a drawing. Throws DrawFailure if ffmpeg is missing or does not start.
    MovieWriter(const std::string& path, MovieFormat format, Size size, int frames_per_second,
                int loss = 18);
    /// Without finish(): ends ffmpeg and leaves no file.
    ~MovieWriter();
    MovieWriter(const MovieWriter&) = delete;
    MovieWriter& operator=(const MovieWriter&) = delete;

    /// One frame: planes (planar.hpp) for mp4 and webm, Canvas::pixels() for gif. Throws
    /// DrawFailure with what ffmpeg said if it has died.
    void write(std::span<const std::uint8_t> frame);
    /// Waits for ffmpeg and puts the file in place.
    void finish();

  private:
    [[noreturn]] void fail(int status);
    void open_aside();

    std::string path_, aside_;
    std::unique_ptr<Ffmpeg> ffmpeg_;
    int lock_ = -1;          // on the file aside, which ffmpeg opens for itself
    bool finished_ = false;  // the file aside is gone
};

}  // namespace swirl
