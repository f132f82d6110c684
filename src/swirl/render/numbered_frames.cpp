#include "swirl/render/numbered_frames.hpp"

#include <fmt/format.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <vector>

namespace swirl {

namespace {

/// The position of "%05d" in a pattern, and its number of digits.
struct NumberField {
    std::size_t begin, end;
    int digits;
};

std::optional<NumberField> number_field(const std::string& pattern) {
    const std::size_t begin = pattern.find('%');
    if (begin == pattern.npos) return std::nullopt;
    std::size_t k = begin + 1;
    int digits = 0;
    while (k < pattern.size() && pattern[k] >= '0' && pattern[k] <= '9' && digits < 100)
        digits = 10 * digits + (pattern[k++] - '0');
    if (k == pattern.size() || pattern[k] != 'd') return std::nullopt;
    return NumberField{begin, k + 1, digits};
}

bool is_png(const std::string& name) { return name.ends_with(".png") || name.ends_with(".PNG"); }

}  // namespace

std::optional<std::string> video_problem(const std::string& pattern) {
    const auto field = number_field(pattern);
    const bool wrong = field ? pattern.find('%', field->end) != pattern.npos || field->digits > 20
                             : pattern.find('%') != pattern.npos;
    if (wrong)
        return fmt::format(
            "the camera images are '{}', but the name must have one field for the number, such as "
            "%d or %05d.",
            pattern);
    if (!field && is_png(pattern))
        return fmt::format(
            "the camera images are '{}', which is a single file.\n"
            "hint: mark the field of the number, as in 'frames/%05d.png'.",
            pattern);
    return std::nullopt;
}

bool belongs_to_video(const std::string& pattern, const std::string& name) {
    const auto field = number_field(pattern);
    if (!field) return name == pattern;
    const std::string before = pattern.substr(0, field->begin), after = pattern.substr(field->end);
    if (name.size() <= before.size() + after.size() || !name.starts_with(before) ||
        !name.ends_with(after))
        return false;
    const auto number =
        std::string_view(name).substr(before.size(), name.size() - before.size() - after.size());
    return number.find_first_not_of("0123456789") == number.npos &&
           number.size() >= static_cast<std::size_t>(field->digits);
}

NumberedFrames::NumberedFrames(std::string pattern) : pattern_(std::move(pattern)) {}

std::string NumberedFrames::name(std::int64_t number) const {
    const auto field = number_field(pattern_);
    if (!field) return pattern_;
    std::string digits = std::to_string(number);
    const auto width = static_cast<std::size_t>(field->digits);
    if (digits.size() < width) digits.insert(0, width - digits.size(), '0');
    return pattern_.substr(0, field->begin) + digits + pattern_.substr(field->end);
}

bool NumberedFrames::has_file(std::int64_t number) const {
    return number >= 0 && ::access(name(number).c_str(), R_OK) == 0;
}

std::shared_ptr<const Image> NumberedFrames::image(std::int64_t number) {
    if (current_ && number == current_number_) return current_;
    current_ = is_png(pattern_) ? Image::from_png(name(number)) : decode(number);
    current_number_ = number;
    return current_;
}

void NumberedFrames::start_ffmpeg(std::int64_t number) {
    std::vector<std::string> arguments{"-hide_banner", "-nostats", "-loglevel", "error"};
    const auto add = [&](std::initializer_list<std::string> more) {
        arguments.insert(arguments.end(), more.begin(), more.end());
    };
    if (number_field(pattern_)) {
        add({"-f", "image2", "-start_number", std::to_string(number)});
        next_ = number;
    }
    add({"-i", "file:" + pattern_, "-an", "-fps_mode", "passthrough", "-vf", square_pixels, "-c:v",
         "ppm", "-f", "image2pipe", "pipe:1"});
    ffmpeg_ = std::make_unique<Ffmpeg>(
        arguments, Ffmpeg::Side::output,
        fmt::format("reading '{}' needs the program ffmpeg, which was not found.\n"
                    "hint: install it (apt-get install ffmpeg), or use PNG files.",
                    pattern_));
}

std::shared_ptr<const Image> NumberedFrames::decode(std::int64_t number) {
    if (!ffmpeg_) start_ffmpeg(number);
    for (; next_ <= number; ++next_)
        if (!read_ppm()) {
            const std::string cause = ffmpeg_->problem();
            throw DrawFailure(fmt::format("cannot read camera image {} from '{}': {}", next_,
                                          pattern_,
                                          cause.empty() ? "there are no more images." : cause));
        }
    return current_;
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

/// A PPM image: "P6\nWIDTH HEIGHT\n255\n" and three bytes per pixel. False at the end.
bool NumberedFrames::read_ppm() {
    constexpr std::size_t max_head = 60;
    std::string head;
    for (int lines = 0; lines < 3;) {
        std::uint8_t c = 0;
        if (read(&c, 1) != 1 || head.size() > max_head) return false;
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
    current_ = image;
    return true;
}

}  // namespace swirl
