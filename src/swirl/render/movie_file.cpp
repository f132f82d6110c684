#include "swirl/render/movie_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iterator>
#include <vector>

#include "swirl/io/system_calls.hpp"

namespace swirl {

namespace {

/// Messages of the system that report an incomplete movie.
constexpr const char* disk_problems[] = {"No space left", "Disk quota exceeded", "File too large",
                                         "Input/output error"};

bool has_extension(const std::string& path, const char* extension) {
    return path.size() > std::strlen(extension) && path.ends_with(extension);
}

const char* name_of(MovieFormat format) {
    switch (format) {
        case MovieFormat::mp4:
            return "mp4";
        case MovieFormat::webm:
            return "webm";
        case MovieFormat::gif:
            break;
    }
    return "gif";
}

std::vector<std::string> arguments(MovieFormat format, Size size, int frames_per_second,
                                   const Compression& compression) {
    const std::string dimensions = fmt::format("{}x{}", size.width, size.height);
    std::vector<std::string> args{"-hide_banner", "-nostats",
                                  "-loglevel",    "error",
                                  "-xerror",      "-y",
                                  "-f",           "rawvideo",
                                  "-pix_fmt",     format == MovieFormat::gif ? "bgr0" : "yuv420p",
                                  "-s",           dimensions,
                                  "-framerate",   std::to_string(frames_per_second)};
    const auto add = [&](std::initializer_list<const char*> more) {
        args.insert(args.end(), more.begin(), more.end());
    };
    if (format != MovieFormat::gif)
        add({"-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "bt709",
             "-color_range", "tv"});
    add({"-i", "pipe:0", "-map_metadata", "-1", "-fflags", "+bitexact", "-flags:v", "+bitexact"});
    switch (format) {
        case MovieFormat::mp4:
            // Flat drawings gain little from the slower presets; "veryfast" makes the file a
            // tenth larger and less similar to the drawing.
            add({"-c:v", "libx264", "-preset", compression.by_camera ? "veryfast" : "fast",
                 "-threads", "2"});
            if (compression.by_camera) add({"-x264-params", "subme=1:me=dia:weightp=0:8x8dct=0"});
            add({"-pix_fmt", "yuv420p", "-movflags", "+faststart"});
            args.insert(args.end(), {"-crf", std::to_string(compression.loss)});
            break;
        case MovieFormat::webm:
            // "realtime" takes a third of the time of "good" with 5, and the file is two fifths
            // larger. With 49, ten seconds of 48 discs at 1280x720 take less than 3 MB.
            add({"-c:v", "libvpx-vp9", "-crf", "49", "-b:v", "0", "-deadline", "realtime",
                 "-cpu-used", "6", "-row-mt", "1", "-tile-columns", "2", "-threads", "2",
                 "-pix_fmt", "yuv420p"});
            break;
        case MovieFormat::gif:
            add({"-filter_threads", "1", "-filter_complex",
                 "split[a][b];[a]palettegen=max_colors=48:stats_mode=full[p];"
                 "[b][p]paletteuse=dither=none:diff_mode=rectangle",
                 "-loop", "0"});
            break;
    }
    add({"-f", name_of(format), Ffmpeg::output_name});
    return args;
}

}  // namespace

std::optional<MovieFormat> movie_format(const std::string& path) {
    if (has_extension(path, ".mp4")) return MovieFormat::mp4;
    if (has_extension(path, ".webm")) return MovieFormat::webm;
    if (has_extension(path, ".gif")) return MovieFormat::gif;
    return std::nullopt;
}

std::optional<std::string> movie_problem(MovieFormat format, Size size, int frames_per_second) {
    constexpr int min_side = 16, max_side = 8192, max_rate = 240;
    if (std::min(size.width, size.height) < min_side ||
        std::max(size.width, size.height) > max_side)
        return fmt::format("--size is {}x{}, but each side must be from {} to {} pixels.",
                           size.width, size.height, min_side, max_side);
    if (format != MovieFormat::gif && (size.width % 2 != 0 || size.height % 2 != 0))
        return fmt::format("--size is {}x{}, but the sides of an .{} movie must be even.",
                           size.width, size.height, name_of(format));
    // A GIF counts in hundredths of a second, and players slow down above 50 frames per second.
    if (format == MovieFormat::gif) {
        if (frames_per_second >= 1 && frames_per_second <= 50 && 100 % frames_per_second == 0)
            return std::nullopt;
        return fmt::format(
            "--fps is {}, but it must be 1, 2, 4, 5, 10, 20, 25 or 50 for a .gif, which counts in "
            "hundredths of a second.",
            frames_per_second);
    }
    if (frames_per_second < 1 || frames_per_second > max_rate)
        return fmt::format("--fps is {}, but it must be from 1 to {} for an .{} movie.",
                           frames_per_second, max_rate, name_of(format));
    return std::nullopt;
}

MovieWriter::MovieWriter(const std::string& path, MovieFormat format, Size size,
                         int frames_per_second, const Compression& compression)
    : path_(path), temporary_(path + ".partial") {
    open_temporary();
    try {
        ffmpeg_ = std::make_unique<Ffmpeg>(
            arguments(format, size, frames_per_second, compression), Ffmpeg::Side::input,
            "movies need the program ffmpeg, which was not found.\n"
            "hint: install it (apt-get install ffmpeg), or write frames with --frame-files DIR.",
            temporary_);
    } catch (const DrawFailure&) {
        ::unlink(temporary_.c_str());
        ::close(lock_);
        throw;
    }
}

MovieWriter::~MovieWriter() {
    ffmpeg_.reset();
    if (!finished_) ::unlink(temporary_.c_str());
    ::close(lock_);
}

/// Always creates a new file: the ffmpeg of a movie that was killed still writes into the old one.
/// The lock detects a second process that makes the same movie. (ffmpeg would also report a file
/// that cannot be written, but only after the first frames.)
void MovieWriter::open_temporary() {
    constexpr int max_attempts = 100;
    for (int attempt = 0; attempt < max_attempts; ++attempt) {
        lock_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        const bool is_new = lock_ >= 0;
        if (!is_new && errno == EEXIST)
            lock_ = ::open(temporary_.c_str(), O_WRONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
        if (lock_ < 0 && errno == ENOENT) continue;
        if (lock_ < 0)
            throw DrawFailure(
                fmt::format("cannot write the movie '{}': {}.", path_, std::strerror(errno)));
        const bool locked = ::flock(lock_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
        struct stat about {};
        if (locked && is_new && ::fstat(lock_, &about) == 0 && about.st_nlink > 0) return;
        if (locked && !is_new) ::unlink(temporary_.c_str());  // left behind by a killed process
        ::close(lock_);
        if (!locked) break;
    }
    throw DrawFailure(
        fmt::format("the movie '{}' is being made by another process.\n"
                    "hint: wait for it, or choose another name.",
                    path_));
}

void MovieWriter::fail(int status) {
    ::unlink(temporary_.c_str());
    finished_ = true;
    throw DrawFailure(
        fmt::format("cannot make the movie '{}': ffmpeg {}", path_, ffmpeg_->describe_end(status)));
}

void MovieWriter::write(std::span<const std::uint8_t> frame) {
    while (!frame.empty()) {
        const ssize_t sent = system::send(ffmpeg_->socket(), frame.data(), frame.size());
        if (sent > 0) {
            frame = frame.subspan(static_cast<std::size_t>(sent));
        } else if (sent < 0 && errno != EINTR) {
            fail(ffmpeg_->end());
        }
    }
}

void MovieWriter::finish() {
    // After shutdown() ffmpeg still receives what was sent; close() might discard it.
    ::shutdown(ffmpeg_->socket(), SHUT_WR);
    const int status = ffmpeg_->end();
    const bool success = WIFEXITED(status) && WEXITSTATUS(status) == 0;
    // ffmpeg may end with code 0 although it could not write everything.
    const std::string errors = ffmpeg_->error_output();
    const bool disk_problem =
        std::any_of(std::begin(disk_problems), std::end(disk_problems),
                    [&](const char* problem) { return errors.find(problem) != errors.npos; });
    struct stat about {};
    const bool empty = ::fstat(lock_, &about) != 0 || about.st_size == 0;
    if (!success || disk_problem || empty) fail(status);
    finished_ = true;
    // Only after sync_file() is it certain that all bytes reached the disk.
    if (system::sync_file(lock_) && std::rename(temporary_.c_str(), path_.c_str()) == 0) return;
    const std::string reason = std::strerror(errno);
    ::unlink(temporary_.c_str());
    throw DrawFailure(fmt::format("cannot write the movie '{}': {}.", path_, reason));
}

}  // namespace swirl
