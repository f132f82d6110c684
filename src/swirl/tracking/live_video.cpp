#include "swirl/tracking/live_video.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>
#include <vector>

#include "swirl/io/atomic_file.hpp"
#include "swirl/io/system_calls.hpp"
#include "swirl/render/numbered_frames.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/shell_word.hpp"
#include "swirl/tracking/video.hpp"

namespace swirl {

namespace {

namespace fs = std::filesystem;

/// Formats of images that show by themselves whether a file is complete.
struct ImageFormat {
    const char *extension, *decoder;
};
constexpr ImageFormat image_formats[] = {
    {".png", "png"}, {".jpg", "mjpeg"}, {".jpeg", "mjpeg"}, {".pgm", "pgm"}};

const ImageFormat* image_format(const std::string& name) {
    for (const ImageFormat& format : image_formats)
        if (name.ends_with(format.extension)) return &format;
    return nullptr;
}

/// False if an image file ends before its image does.
bool is_complete_image(const std::string& name, const std::string& bytes) {
    const std::string decoder = image_format(name)->decoder;
    if (decoder == "png") return bytes.ends_with("IEND\xAE\x42\x60\x82");
    if (decoder == "mjpeg") return bytes.ends_with("\xFF\xD9");
    std::size_t head = 0;
    for (int lines = 0; lines < 3 && head != bytes.npos; ++lines) {
        head = bytes.find('\n', head);
        if (head != bytes.npos) ++head;
    }
    if (head == bytes.npos) return false;
    const std::optional<cv::Size> size = pgm_size(bytes.substr(0, head));
    return size && bytes.size() >= head + static_cast<std::size_t>(size->area());
}

/// "frame_00017.png" → "frame_%05d.png"; empty if the name has no number before the extension.
std::string pattern_of(const std::string& name) {
    const ImageFormat* const format = image_format(name);
    if (!format || name.find('%') != name.npos) return "";
    const std::size_t end = name.size() - std::strlen(format->extension);
    std::size_t begin = end;
    while (begin > 0 && std::isdigit(static_cast<unsigned char>(name[begin - 1]))) --begin;
    if (begin == end) return "";
    const std::string field =
        name[begin] == '0' && end - begin > 1 ? fmt::format("%0{}d", end - begin) : "%d";
    return name.substr(0, begin) + field + name.substr(end);
}

std::string format_list() { return "PNG (.png), JPEG (.jpg) or PGM (.pgm)"; }

}  // namespace

LiveVideo::LiveVideo(LiveSource source) : source_(std::move(source)), last_(Clock::now()) {
    const std::string& name = source_.name;
    std::error_code ignored;
    camera_ = is_camera_device(name);
    standard_input_ = name == "-";
    if (camera_ && !fs::exists(name, ignored))
        throw Failure(
            fmt::format("there is no camera '{}'\nhint: list the cameras with ls "
                        "/dev/video*; this user must be allowed to read them",
                        name));
    if (is_numbered(name)) {
        if (const auto wrong = video_problem(name)) throw UsageError(*wrong);
        if (!image_format(name))
            throw UsageError(fmt::format("the images are '{}', but live images must be {}.", name,
                                         format_list()));
    } else if (!camera_ && !standard_input_ && !fs::is_directory(name, ignored)) {
        if (fs::exists(name, ignored))
            throw UsageError(fmt::format(
                "--live is '{}', but it must be a camera (/dev/video0), a folder of numbered "
                "images, or - for standard input.\nhint: track a finished video without --live.",
                name));
        throw Failure(fmt::format(
            "there is no camera or folder '{}'\nhint: create the folder before the recording",
            name));
    }
}

LiveVideo::~LiveVideo() = default;

bool LiveVideo::find_images() {
    if (is_numbered(source_.name)) {
        pattern_ = source_.name;
    } else {
        std::string least;
        std::error_code ignored;
        for (const auto& entry : fs::directory_iterator(source_.name, ignored)) {
            const std::string name = entry.path().filename().string();
            if (!pattern_of(name).empty() && (least.empty() || name < least)) least = name;
        }
        if (least.empty()) return false;
        pattern_ = (fs::path(source_.name) / pattern_of(least)).string();
    }
    try {
        next_number_ = first_number(pattern_);
    } catch (const Failure&) {
        return false;  // no image yet
    }
    return true;
}

/// Starts ffmpeg if the source is known. False if not.
bool LiveVideo::start() {
    std::vector<std::string> arguments{"-hide_banner", "-nostats", "-loglevel",
                                       "error",        "-threads", "1"};
    const auto add = [&](std::initializer_list<std::string> more) {
        arguments.insert(arguments.end(), more);
    };
    if (camera_) {
        add({"-f", "v4l2"});
        if (source_.fps) add({"-framerate", fmt::format("{}", *source_.fps)});
        add({"-i", source_.name});
    } else if (standard_input_) {
        add({"-i", "pipe:0", "-map", "0:v:0"});
    } else {
        if (!find_images()) return false;
        add({"-probesize", "32", "-analyzeduration", "0", "-xerror", "-f", "image2pipe", "-c:v",
             image_format(pattern_)->decoder, "-i", "pipe:0"});
    }
    add({"-an", "-fps_mode", "passthrough", "-vf", "settb=1/25,setpts=N", "-enc_time_base", "1:25",
         "-pix_fmt", "gray", "-c:v", "pgm", "-flush_packets", "1", "-f", "image2pipe", "pipe:1"});
    ffmpeg_ = std::make_unique<Ffmpeg>(
        arguments, camera_ ? Ffmpeg::Side::output : Ffmpeg::Side::both, missing_ffmpeg);
    ::fcntl(ffmpeg_->socket(), F_SETFL, O_NONBLOCK);
    return true;
}

/// Loads the next image if its file is complete.
void LiveVideo::load_next_image() {
    const std::string name = NumberedFrames(pattern_).name(next_number_);
    std::error_code absent;
    if (!fs::is_regular_file(name, absent)) return;
    std::string bytes = read_regular_file(name);
    if (!is_complete_image(name, bytes)) return;
    input_ = std::move(bytes);
    sent_ = 0;
    ++next_number_;
    ++images_;
    last_ = Clock::now();
}

/// Loads what standard input has now. False at its end.
bool LiveVideo::load_standard_input() {
    pollfd ready{STDIN_FILENO, POLLIN, 0};
    if (::poll(&ready, 1, 0) <= 0) return true;
    std::array<char, 65536> part{};
    const ssize_t got = ::read(STDIN_FILENO, part.data(), part.size());
    if (got < 0) return errno == EINTR || errno == EAGAIN;
    input_.assign(part.data(), static_cast<std::size_t>(got));
    sent_ = 0;
    if (got > 0) last_ = Clock::now();
    return got > 0;
}

/// Sends and receives what is possible now. False if ffmpeg closed its output.
bool LiveVideo::exchange(int wait_ms) {
    constexpr std::size_t max_part = 1 << 16;  // bytes
    pollfd ready{ffmpeg_->socket(), short(POLLIN | (has_input() ? POLLOUT : 0)), 0};
    if (::poll(&ready, 1, wait_ms) <= 0) return true;
    if (ready.revents & POLLOUT) {
        const ssize_t sent = system::send(ready.fd, input_.data() + sent_,
                                          std::min(max_part, input_.size() - sent_));
        if (sent > 0) sent_ += static_cast<std::size_t>(sent);
    }
    if (!(ready.revents & (POLLIN | POLLHUP | POLLERR))) return true;
    std::array<char, max_part> part{};
    const ssize_t got = ::recv(ready.fd, part.data(), part.size(), 0);
    if (got < 0) return errno == EINTR || errno == EAGAIN || errno == EWOULDBLOCK;
    output_.append(part.data(), static_cast<std::size_t>(got));
    return got > 0;
}

/// Takes a frame out of the received data.
bool LiveVideo::take_frame(cv::Mat& grey) {
    constexpr std::size_t max_head = 60;  // characters
    std::size_t head = 0;
    for (int lines = 0; lines < 3; ++lines) {
        head = output_.find('\n', head);
        if (head == output_.npos) {
            if (output_.size() > max_head) throw_no_frames();
            return false;
        }
        ++head;
    }
    const std::optional<cv::Size> size = pgm_size(output_.substr(0, head));
    if (!size) throw_no_frames();
    const auto bytes = static_cast<std::size_t>(size->area());
    if (output_.size() < head + bytes) return false;
    grey.create(*size, CV_8UC1);
    std::memcpy(grey.ptr(), output_.data() + head, bytes);
    output_.erase(0, head + bytes);
    last_frame_ = Clock::now();
    if (count_++ == 0) first_frame_ = last_frame_;
    if (camera_) last_ = last_frame_;
    return true;
}

std::string LiveVideo::unfinished_text() const {
    if (pattern_.empty()) return "";
    const NumberedFrames names(pattern_);
    if (names.has_file(next_number_))
        return fmt::format("the file of image {} stayed incomplete; later images were not used",
                           names.name(next_number_));
    constexpr std::int64_t ahead = 100;  // numbers
    for (std::int64_t k = 1; k <= ahead; ++k)
        if (names.has_file(next_number_ + k))
            return fmt::format("image {} did not arrive; later images were not used",
                               names.name(next_number_));
    return "";
}

/// True if the input has ended: by a stop request, or without a new frame for the timeout.
bool LiveVideo::is_over() {
    if (source_.stop && source_.stop->load()) return true;
    if (Clock::now() - last_ < std::chrono::duration<double>(source_.timeout)) return false;
    if (camera_)
        problem_ = fmt::format("no frame came from the camera for {:g} s", source_.timeout);
    else
        problem_ = unfinished_text();
    return true;
}

/// Tells ffmpeg that its input ends, so that it returns the frames that it holds.
void LiveVideo::flush() {
    flushing_ = true;
    if (ffmpeg_ && !camera_) ::shutdown(ffmpeg_->socket(), SHUT_WR);
}

void LiveVideo::throw_no_frames() const {
    const std::string cause = ffmpeg_ ? ffmpeg_->problem() : "";
    if (!cause.empty() || camera_ || standard_input_)
        throw Failure(fmt::format(
            "'{}' gives no readable frames{}\nhint: {}", source_.name,
            cause.empty() ? "" : ": " + cause,
            camera_ ? "check that no other program uses the camera, and that it has the rate --fps"
                    : "check that the images or the video can be shown by ffplay"));
    throw Failure(fmt::format(
        "no image arrived in '{}' within {:g} s\nhint: names of files must be ascending numbers, "
        "such as 00001.png, and the format must be {}; --timeout waits longer",
        source_.name, source_.timeout, format_list()));
}

bool LiveVideo::next(cv::Mat& grey) {
    constexpr int interval = 10;       // ms between two checks for input
    constexpr int flush_time = 60000;  // ms without output after which ffmpeg is ended: it hangs
    int idle = 0;                      // ms
    while (source_.max_frames <= 0 || count_ < source_.max_frames) {
        if (take_frame(grey)) return true;
        if (!ffmpeg_ && !start()) {
            if (is_over()) break;
            ::poll(nullptr, 0, interval);
            continue;
        }
        if (!flushing_ && !has_input()) {
            bool more = true;
            if (!pattern_.empty())
                load_next_image();
            else if (standard_input_)
                more = load_standard_input();
            if (!more || is_over()) flush();
        }
        if (camera_ && flushing_) break;
        const std::size_t before = output_.size();
        if (!exchange(has_input() || flushing_ ? interval : interval / 2)) {
            if (take_frame(grey)) return true;
            if (ffmpeg_->problem().empty() && !flushing_) problem_ = "ffmpeg ended";
            break;
        }
        idle = flushing_ && output_.size() == before ? idle + interval : 0;
        if (idle > flush_time) break;
    }
    if (ffmpeg_ && problem_.empty()) problem_ = ffmpeg_->problem();
    if (count_ == 0 && !(source_.stop && source_.stop->load())) throw_no_frames();
    if (!pattern_.empty() && problem_.empty() && source_.max_frames <= 0 && count_ != images_)
        throw Failure(fmt::format(
            "{} images were read, but ffmpeg returned {} frames\nhint: swirl track {} tracks them",
            images_, count_, shell_word(pattern_)));
    return false;
}

double LiveVideo::camera_fps() const {
    const double seconds = std::chrono::duration<double>(last_frame_ - first_frame_).count();
    return camera_ && count_ > 1 && seconds > 0.0 ? double(count_ - 1) / seconds : 0.0;
}

}  // namespace swirl
