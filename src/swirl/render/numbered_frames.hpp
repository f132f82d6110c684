// The pictures of a camera, by number: what tracks were made from.
//
//     frames/%05d.png   a file for each; the number stands in its name, here with five digits
//     frames/%05d.jpg   the same in any format that ffmpeg reads; the numbers must follow each
//     other dish.avi          a film that ffmpeg reads; its first picture has the number 0
//
// PNG files need no ffmpeg.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "swirl/render/ffmpeg.hpp"
#include "swirl/render/image.hpp"

namespace swirl {

/// Why `pattern` names no pictures, as a full sentence; nothing if it may.
std::optional<std::string> video_problem(const std::string& pattern);

/// Whether `name` is that of one of the pictures, both written in the same way.
bool is_of_video(const std::string& pattern, const std::string& name);

class NumberedFrames {
  public:
    explicit NumberedFrames(std::string pattern);

    /// Numbers must not decrease. Throws DrawFailure if there is no such picture.
    std::shared_ptr<const Image> picture(std::int64_t number);
    /// Whether there is a file for it; in a film nobody knows beforehand.
    bool may_have(std::int64_t number) const;
    /// The file of that number, or the film.
    std::string name(std::int64_t number) const;

  private:
    std::shared_ptr<const Image> decode(std::int64_t number);
    std::size_t read(std::uint8_t* into, std::size_t count);
    bool read_picture();

    std::string pattern_;
    std::shared_ptr<const Image> shown_;
    std::int64_t shown_number_ = -1;
    std::unique_ptr<Ffmpeg> ffmpeg_;
    std::int64_t next_ = 0;  // number of the next picture it will send
};

}  // namespace swirl
