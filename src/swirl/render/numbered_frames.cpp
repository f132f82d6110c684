#include "swirl/render/numbered_frames.hpp"

#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <vector>

namespace swirl {

namespace {

/// "%05d": where it stands, and how many digits it asks for.
struct NumberPlace {
    std::size_t begin, end;
    int digits;
};

std::optional<NumberPlace> number_place(const std::string& pattern) {
    const std::size_t begin = pattern.find('%');
    if (begin == pattern.npos) return std::nullopt;
    std::size_t k = begin + 1;
    int digits = 0;
    while (k < pattern.size() && pattern[k] >= '0' && pattern[k] <= '9' && digits < 100)
        digits = 10 * digits + (pattern[k++] - '0');
    if (k == pattern.size() || pattern[k] != 'd') return std::nullopt;
    return NumberPlace{begin, k + 1, digits};
}

bool is_png(const std::string& name) { return name.ends_with(".png") || name.ends_with(".PNG"); }

}  // namespace

std::optional<std::string> video_problem(const std::string& pattern) {
    const auto place = number_place(pattern);
    const bool wrong = place ? pattern.find('%', place->end) != pattern.npos || place->digits > 20
                             : pattern.find('%') != pattern.npos;
    if (wrong)
        return "The camera's pictures are named '" + pattern +
               "', but there must be one place for the number, such as %d or %05d.";
    if (!place && is_png(pattern))
        return "The camera's pictures are named '" + pattern +
               "', one file for all; the place of the number must be marked, as in "
               "'frames/%05d.png'.";
    return std::nullopt;
}

bool is_of_video(const std::string& pattern, const std::string& name) {
    const auto place = number_place(pattern);
    if (!place) return name == pattern;
    const std::string before = pattern.substr(0, place->begin), after = pattern.substr(place->end);
    if (name.size() <= before.size() + after.size() || !name.starts_with(before) ||
        !name.ends_with(after))
        return false;
    const auto number =
        std::string_view(name).substr(before.size(), name.size() - before.size() - after.size());
    return number.find_first_not_of("0123456789") == number.npos &&
           number.size() >= static_cast<std::size_t>(place->digits);
}

NumberedFrames::NumberedFrames(std::string pattern) : pattern_(std::move(pattern)) {}

std::string NumberedFrames::name(std::int64_t number) const {
    const auto place = number_place(pattern_);
    if (!place) return pattern_;
    std::string digits = std::to_string(number);
    const auto wanted = static_cast<std::size_t>(place->digits);
    if (digits.size() < wanted) digits.insert(0, wanted - digits.size(), '0');
    return pattern_.substr(0, place->begin) + digits + pattern_.substr(place->end);
}

bool NumberedFrames::may_have(std::int64_t number) const {
    return number >= 0 && ::access(name(number).c_str(), R_OK) == 0;
}

std::shared_ptr<const Image> NumberedFrames::picture(std::int64_t number) {
    if (shown_ && number == shown_number_) return shown_;
    shown_ = is_png(pattern_) ? Image::from_png(name(number)) : decode(number);
    shown_number_ = number;
    return shown_;
}

std::shared_ptr<const Image> NumberedFrames::decode(std::int64_t number) {
    if (!ffmpeg_) {
        std::vector<std::string> arguments{"-hide_banner", "-nostats", "-loglevel", "error"};
        const auto add = [&](std::initializer_list<std::string> more) {
            arguments.insert(arguments.end(), more.begin(), more.end());
        };
        if (number_place(pattern_)) {
            add({"-f", "image2", "-start_number", std::to_string(number)});
            next_ = number;
        }
        add({"-i", "file:" + pattern_, "-an", "-fps_mode", "passthrough", "-c:v", "ppm", "-f",
             "image2pipe", "pipe:1"});
        ffmpeg_ = std::make_unique<Ffmpeg>(
            arguments, Ffmpeg::Side::output,
            "The pictures in " + pattern_ +
                " are read by the program ffmpeg, which was not found: install it (apt-get install "
                "ffmpeg), or give PNG files.");
    }
    while (next_ <= number) {
        if (!read_picture()) {
            const std::string words = ffmpeg_->problem();
            throw DrawFailure("The camera's picture " + std::to_string(next_) + " in " + pattern_ +
                              " cannot be read: " + (words.empty() ? "there are no more." : words));
        }
        ++next_;
    }
    return shown_;
}

std::size_t NumberedFrames::read(std::uint8_t* into, std::size_t count) {
    std::size_t got = 0;
    while (got < count) {
        const ssize_t more = ::recv(ffmpeg_->socket(), into + got, count - got, 0);
        if (more < 0 && errno == EINTR) continue;
        if (more <= 0) break;
        got += static_cast<std::size_t>(more);
    }
    return got;
}

/// A PPM picture: "P6\nWIDTH HEIGHT\n255\n" and three bytes a pixel.
bool NumberedFrames::read_picture() {
    std::string head;
    for (int lines = 0; lines < 3;) {
        std::uint8_t c = 0;
        if (read(&c, 1) != 1 || head.size() > 60) return false;
        head += static_cast<char>(c);
        if (c == '\n') ++lines;
    }
    Size size{0, 0};
    if (std::sscanf(head.c_str(), "P6 %d %d 255", &size.width, &size.height) != 2) return false;
    std::vector<std::uint8_t> rgb(std::size_t(3) * std::size_t(size.width) *
                                  std::size_t(size.height));
    if (read(rgb.data(), rgb.size()) != rgb.size()) return false;
    const auto image = std::make_shared<Image>(size);
    image->fill(rgb.data());
    shown_ = image;
    return true;
}

}  // namespace swirl
