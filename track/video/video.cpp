#include "track/video/video.hpp"

#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>

#include "swirl/io/file_error.hpp"
#include "swirl/math/median.hpp"
#include "swirl/render/numbered_frames.hpp"
#include "swirl/run/failure.hpp"

namespace swirl::tracking {

namespace {

constexpr const char* no_ascending_times =
    "the times of the video's frames do not ascend\n"
    "hint: if the frames are equally spaced in time, give --fps";

bool is_stream(const std::string& source) {
    return source == "-" || source.find("://") != source.npos;
}
bool is_numbered(const std::string& source) {
    return source.find('%') != source.npos && !is_stream(source);
}

/// The least number for which there is an image. Throws Failure if there is none, and UsageError
/// for a wrong pattern.
std::int64_t first_number(const std::string& pattern) {
    constexpr std::size_t max_digits = 15;  // these fit into 64 bits
    if (const auto wrong = video_problem(pattern)) throw UsageError(*wrong);
    const std::filesystem::path path = pattern;
    const std::string name = path.filename().string();
    const std::size_t begin = name.find('%'), after = name.size() - name.find('d', begin) - 1;
    const std::filesystem::path folder =
        path.parent_path().empty() ? std::filesystem::path(".") : path.parent_path();
    std::optional<std::int64_t> minimum;
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
        const std::string file = entry.path().filename().string();
        if (!belongs_to_video(name, file)) continue;
        const std::string digits = file.substr(begin, file.size() - begin - after);
        if (digits.size() > max_digits) continue;
        const std::int64_t number = std::stoll(digits);
        minimum = std::min(minimum.value_or(number), number);
    }
    if (!minimum) throw Failure(fmt::format("there are no frames named '{}'", pattern));
    return *minimum;
}

void append(std::vector<std::string>& arguments, std::initializer_list<std::string> more) {
    arguments.insert(arguments.end(), more.begin(), more.end());
}

/// Throws unless the source is a file: frames are read more than once.
void require_file(const std::string& source) {
    constexpr const char* record_first = "record it first, for example with ffmpeg -t 60";
    if (is_stream(source))
        throw UsageError(fmt::format(
            "'{}' is a stream, but a video must be a file: it is read more than once.\nhint: {}.",
            source, record_first));
    std::error_code ignored;
    const auto type = std::filesystem::status(source, ignored).type();
    if (type == std::filesystem::file_type::regular) return;
    if (type == std::filesystem::file_type::directory)
        throw UsageError(fmt::format(
            "'{0}' is a folder, but a video must be a file.\n"
            "hint: for numbered images, mark the field of the number, as in '{0}/%05d.png'.",
            source));
    if (std::filesystem::exists(source, ignored) ||
        (source.starts_with("/dev/") && !source.starts_with("/dev/shm/")))
        throw UsageError(fmt::format(
            "'{}' is a device or a stream, but a video must be a file: it is read more than "
            "once.\nhint: {}.",
            source, record_first));
    throw Failure(fmt::format("there is no video '{}'", source));
}

/// ffmpeg's arguments up to the input.
std::vector<std::string> input_arguments(const std::string& source) {
    std::vector<std::string> arguments{"-hide_banner", "-nostats", "-loglevel", "error"};
    if (is_numbered(source))
        append(arguments, {"-f", "image2", "-start_number", std::to_string(first_number(source))});
    else
        require_file(source);
    append(arguments, {"-i", "file:" + source, "-map", "0:v:0"});
    return arguments;
}

std::string no_frames_message(const std::string& source, const std::string& problem) {
    const bool cut_off = problem.find("moov atom not found") != problem.npos;
    return fmt::format(
        "'{}' contains no readable frames{}{}", source, problem.empty() ? "" : ": " + problem,
        cut_off ? "\nhint: the file was cut off; this format has its index at the end" : "");
}

/// What ffmpeg writes until it closes its output.
std::string read_all(const Ffmpeg& ffmpeg) {
    std::string text;
    std::array<char, 65536> part{};
    for (;;) {
        const ssize_t got = ::recv(ffmpeg.socket(), part.data(), part.size(), 0);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return text;
        text.append(part.data(), static_cast<std::size_t>(got));
    }
}

/// Waits for ffmpeg to end. Throws Failure if a signal ended it, since its output is then
/// incomplete. Errors that ffmpeg itself reports are judged by its output.
void require_end(Ffmpeg& ffmpeg, const std::string& source) {
    constexpr int stopped = 255;  // its exit code after a signal that it handles
    const int status = ffmpeg.end();
    if (!WIFSIGNALED(status) && WEXITSTATUS(status) != stopped) return;
    throw Failure(
        fmt::format("ffmpeg was {} before the end of '{}'\n"
                    "hint: track the video again; the system kills programs if memory runs out",
                    WIFSIGNALED(status) ? fmt::format("killed by signal {}", WTERMSIG(status))
                                        : std::string("stopped by a signal"),
                    source));
}

/// Times in ffmpeg's framecrc format: "#tb 0: 1/TICKS", then "0, DTS, PTS, …" for each frame.
std::vector<double> framecrc_times(const std::string& text) {
    std::vector<double> seconds;
    double unit = 0.0;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        const std::string line = text.substr(at, end - at);
        at = end + 1;
        double above = 0.0, below = 0.0, dts = 0.0, pts = 0.0;
        if (std::sscanf(line.c_str(), "#tb 0: %lf/%lf", &above, &below) == 2 && below > 0.0)
            unit = above / below;
        else if (std::sscanf(line.c_str(), "0, %lf, %lf", &dts, &pts) == 2)
            seconds.push_back(unit * pts);
    }
    return seconds;
}

/// The size of a PGM or PPM image with 8 bits, from its first three lines; nothing if it is no such
/// image.
std::optional<cv::Size> image_size(const std::string& head, bool in_colours) {
    constexpr int max_side = 20000;  // pixels: larger is no frame
    int width = 0, height = 0;
    const char* const format = in_colours ? "P6 %d %d 255" : "P5 %d %d 255";
    if (std::sscanf(head.c_str(), format, &width, &height) != 2) return std::nullopt;
    if (width < 1 || height < 1 || width > max_side || height > max_side) return std::nullopt;
    return cv::Size(width, height);
}

}  // namespace

VideoTimes video_times(const std::string& source) {
    VideoTimes times;
    if (is_numbered(source)) {
        const NumberedFrames names(source);
        const std::int64_t first = first_number(source);
        while (names.has_file(first + times.frame_count)) ++times.frame_count;
        return times;
    }
    std::vector<std::string> arguments = input_arguments(source);
    append(arguments, {"-c", "copy", "-copyts", "-f", "framecrc", "pipe:1"});
    Ffmpeg ffmpeg(arguments, Ffmpeg::Side::output, missing_ffmpeg);
    times.seconds = framecrc_times(read_all(ffmpeg));
    require_end(ffmpeg, source);
    if (times.seconds.empty()) throw Failure(no_frames_message(source, ffmpeg.problem()));
    times.frame_count = static_cast<std::int64_t>(times.seconds.size());
    std::sort(times.seconds.begin(), times.seconds.end());
    const std::size_t n = times.seconds.size();
    const double length = times.seconds.back() - times.seconds.front();
    if (n < 2 || !(length > 0.0)) return times;
    const double step = length / double(n - 1);
    times.fps = 1.0 / step;
    for (std::size_t k = 1; k < n; ++k)
        times.jitter = std::max(times.jitter,
                                std::abs((times.seconds[k] - times.seconds[k - 1]) / step - 1.0));
    return times;
}

AscendingTimes ascending_times(const std::vector<double>& seconds) {
    constexpr double min_step = 0.01;  // of the median step
    std::vector<double> steps;
    for (std::size_t k = 1; k < seconds.size(); ++k)
        if (const double step = seconds[k] - seconds[k - 1]; std::isfinite(step) && step > 0.0)
            steps.push_back(step);
    if (steps.empty()) throw Failure(no_ascending_times);
    const double usual = median(steps);
    // A timed frame is later than all frames before it, and earlier than all frames after it.
    std::vector<char> timed(seconds.size(), 1);
    double latest = -std::numeric_limits<double>::infinity(), earliest = -latest;
    for (std::size_t k = 0; k < seconds.size(); ++k) {
        if (!std::isfinite(seconds[k]) || !(seconds[k] - latest > min_step * usual)) timed[k] = 0;
        if (std::isfinite(seconds[k])) latest = std::max(latest, seconds[k]);
    }
    for (std::size_t k = seconds.size(); k-- > 0;) {
        if (!(earliest - seconds[k] > min_step * usual)) timed[k] = 0;
        if (std::isfinite(seconds[k])) earliest = std::min(earliest, seconds[k]);
    }
    AscendingTimes found{seconds, {}};
    std::optional<std::size_t> last;  // timed frame
    for (std::size_t k = 0; k <= seconds.size(); ++k) {
        const bool at_end = k == seconds.size();
        if (!at_end && !timed[k]) {
            found.untimed.push_back(k);
            continue;
        }
        // Frames between two timed ones are spread evenly; those at the ends by the usual step.
        const double step =
            last && !at_end ? (seconds[k] - seconds[*last]) / double(k - *last) : usual;
        for (std::size_t j = last ? *last + 1 : 0; j < k; ++j)
            found.seconds[j] = last ? seconds[*last] + step * double(j - *last)
                                    : seconds[k] - step * double(k - j);
        last = k;
    }
    if (found.untimed.size() + 2 > seconds.size() ||
        !std::is_sorted(found.seconds.begin(), found.seconds.end(), std::less_equal<>()))
        throw Failure(no_ascending_times);
    return found;
}

FieldOrder field_order(const std::string& source, std::int64_t first) {
    constexpr std::int64_t frames = 60;  // examined
    constexpr int min_share = 2;         // one in so many
    std::vector<std::string> arguments = input_arguments(source);
    append(arguments, {"-an", "-vf",
                       fmt::format("trim=start_frame={}:end_frame={},idet,metadata=mode=print:"
                                   "key=lavfi.idet.multiple.current_frame:file='pipe\\:1'",
                                   first, first + frames),
                       "-f", "null", "-"});
    Ffmpeg ffmpeg(arguments, Ffmpeg::Side::output, missing_ffmpeg);
    const std::string text = read_all(ffmpeg);
    require_end(ffmpeg, source);
    const auto number = [&](const std::string& value) {
        const std::string line = "current_frame=" + value + "\n";
        int count = 0;
        for (std::size_t at = 0; (at = text.find(line, at)) != text.npos; at += line.size())
            ++count;
        return count;
    };
    const int top = number("tff"), bottom = number("bff");
    const int all = top + bottom + number("progressive") + number("undetermined");
    if (min_share * std::max(top, bottom) <= all) return FieldOrder::progressive;
    return top > bottom ? FieldOrder::top_first : FieldOrder::bottom_first;
}

Video::Video(std::string source, std::int64_t every, std::int64_t first, FrameReading reading)
    : video_(std::move(source)), reading_(std::move(reading)) {
    std::vector<std::string> arguments = input_arguments(video_);
    append(arguments, {"-an", "-fps_mode", "passthrough"});
    const std::string deinterlace =
        reading_.fields == FieldOrder::progressive
            ? ""
            : fmt::format("bwdif=mode=send_frame:parity={}:deint=all,", parity_of(reading_.fields));
    // Frames get new times, since ffmpeg reports errors for times that do not advance.
    const std::string select =
        every > 1 || first > 0
            ? fmt::format("select=gte(n\\,{0})*not(mod(n-{0}\\,{1})),", first, every)
            : "";
    append(arguments, {"-vf", deinterlace + select + square_pixels + ",settb=1/25,setpts=N",
                       "-enc_time_base", "1:25"});
    append(arguments, {"-pix_fmt", colours_from_file() ? "rgb24" : "gray", "-c:v",
                       colours_from_file() ? "ppm" : "pgm", "-f", "image2pipe", "pipe:1"});
    ffmpeg_ = std::make_unique<Ffmpeg>(arguments, Ffmpeg::Side::output, missing_ffmpeg);
}

bool Video::read(std::uint8_t* into, std::size_t bytes) {
    std::size_t got = 0;
    while (got < bytes) {
        const ssize_t more = ::recv(ffmpeg_->socket(), into + got, bytes - got, 0);
        if (more < 0 && errno == EINTR) continue;
        if (more <= 0) return false;
        got += static_cast<std::size_t>(more);
    }
    return true;
}

/// A PGM image, "P5\nWIDTH HEIGHT\n255\n" and a byte a pixel, or a PPM image, "P6\n…" and three.
bool Video::read_frame(cv::Mat& frame) {
    constexpr std::size_t max_head = 60;  // characters: enough for any size below
    std::string head;
    for (int lines = 0; lines < 3;) {
        std::uint8_t c = 0;
        if (!read(&c, 1) || head.size() > max_head) return false;
        head += static_cast<char>(c);
        if (c == '\n') ++lines;
    }
    const std::optional<cv::Size> size = image_size(head, colours_from_file());
    if (!size) return false;
    cv::Mat& pixels = reading_.plane ? colours_ : frame;
    pixels.create(*size, colours_from_file() ? CV_8UC3 : CV_8UC1);
    if (!read(pixels.ptr(), pixels.total() * pixels.elemSize())) return false;
    if (reading_.plane) reading_.plane->project(colours_, frame);
    return true;
}

bool Video::next(cv::Mat& frame) {
    if (!ffmpeg_) return false;
    if (read_frame(frame)) {
        ++count_;
        return true;
    }
    require_end(*ffmpeg_, video_);
    problem_ = ffmpeg_->problem();
    ffmpeg_.reset();
    if (count_ == 0) throw Failure(no_frames_message(video_, problem_));
    return false;
}

}  // namespace swirl::tracking
