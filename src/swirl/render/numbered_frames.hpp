// Reads the images of a camera by number.
//
//     frames/%05d.png   one file per image; its name holds the number, here with five digits
//     frames/%05d.jpg   the same in any format that ffmpeg reads; numbers must be consecutive
//     dish.avi          a video that ffmpeg reads; its first frame has number 0
//
// PNG files do not need ffmpeg.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "swirl/render/ffmpeg.hpp"
#include "swirl/render/image.hpp"

namespace swirl {

/// An error message if `pattern` is not a valid name of images or of a video.
std::optional<std::string> video_problem(const std::string& pattern);

/// True if `name` is the video or one of the images. Both names must be written in the same way.
bool belongs_to_video(const std::string& pattern, const std::string& name);

class NumberedFrames {
  public:
    explicit NumberedFrames(std::string pattern);

    /// Numbers must not decrease. Throws DrawFailure if there is no such image.
    std::shared_ptr<const Image> image(std::int64_t number);
    /// True if the file name(number) is readable. It does not check whether a video is long enough.
    bool has_file(std::int64_t number) const;
    /// The name of the image file with this number, or of the video.
    std::string name(std::int64_t number) const;

  private:
    std::shared_ptr<const Image> decode(std::int64_t number);
    void start_ffmpeg(std::int64_t number);
    std::size_t read(std::uint8_t* into, std::size_t count);
    bool read_ppm();

    std::string pattern_;
    std::shared_ptr<const Image> current_;
    std::int64_t current_number_ = -1;
    std::unique_ptr<Ffmpeg> ffmpeg_;
    std::int64_t next_ = 0;  // number of the next image from ffmpeg
};

}  // namespace swirl
