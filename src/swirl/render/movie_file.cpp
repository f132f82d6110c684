#include "swirl/render/movie_file.hpp"

#include <fcntl.h>
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

namespace swirl {

namespace {

/// Why a movie lacks its end, in the words of the system.
constexpr const char* problem_with_disks[] = {"No space left", "Disk quota exceeded",
                                              "File too large", "Input/output error"};

bool ends_with(const std::string& text, const char* ending) {
    const std::size_t length = std::strlen(ending);
    return text.size() > length && text.compare(text.size() - length, length, ending) == 0;
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

std::vector<std::string> arguments(MovieFormat format, Size size, int frames_per_second, int loss) {
    const std::string dimensions = std::to_string(size.width) + "x" + std::to_string(size.height);
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
            // Flat drawings gain little from the slower presets. What is switched off besides takes
            // a fifth of this one's time and would make the file a tenth smaller.
            add({"-c:v", "libx264", "-preset", "veryfast", "-threads", "2", "-x264-params",
                 "subme=1:me=dia:weightp=0:8x8dct=0", "-pix_fmt", "yuv420p", "-movflags",
                 "+faststart"});
            args.insert(args.end(), {"-crf", std::to_string(loss)});
            break;
        case MovieFormat::webm:
            // The quicker way of this encoder: as like the drawing as "good" with 5 (SSIM 0.963
            // both), in a fifth of the time, and half as large again.
            add({"-c:v", "libvpx-vp9", "-crf", "28", "-b:v", "0", "-deadline", "realtime",
                 "-cpu-used", "6", "-row-mt", "1", "-tile-columns", "2", "-threads", "2",
                 "-pix_fmt", "yuv420p"});
            break;
        case MovieFormat::gif:
            add({"-filter_threads", "1", "-filter_complex",
                 "split[a][b];[a]palettegen=max_colors=128:stats_mode=full[p];"
                 "[b][p]paletteuse=dither=none:diff_mode=rectangle",
                 "-loop", "0"});
            break;
    }
    add({"-f", name_of(format), Ffmpeg::output_name});
    return args;
}

}  // namespace

std::optional<MovieFormat> movie_format(const std::string& path) {
    if (ends_with(path, ".mp4")) return MovieFormat::mp4;
    if (ends_with(path, ".webm")) return MovieFormat::webm;
    if (ends_with(path, ".gif")) return MovieFormat::gif;
    return std::nullopt;
}

std::optional<std::string> movie_problem(MovieFormat format, Size size, int frames_per_second) {
    const std::string given = std::to_string(size.width) + "x" + std::to_string(size.height);
    if (size.width < 16 || size.height < 16 || size.width > 8192 || size.height > 8192)
        return "A movie of " + given +
               " pixels cannot be made: each side must be from 16 to 8192 pixels.";
    if (format != MovieFormat::gif && (size.width % 2 != 0 || size.height % 2 != 0))
        return "A movie of " + given + " pixels cannot be made: the sides of an ." +
               name_of(format) + " movie must be even.";
    // A GIF counts in hundredths of a second, and players slow down what is faster than fifty.
    if (format == MovieFormat::gif) {
        if (frames_per_second >= 1 && frames_per_second <= 50 && 100 % frames_per_second == 0)
            return std::nullopt;
        return std::to_string(frames_per_second) +
               " frames per second cannot be had: a .gif counts in hundredths of a second and "
               "takes 1, 2, 4, 5, 10, 20, 25 or 50.";
    }
    if (frames_per_second < 1 || frames_per_second > 240)
        return std::to_string(frames_per_second) + " frames per second cannot be had: ." +
               name_of(format) + " movies take 1 to 240.";
    return std::nullopt;
}

MovieWriter::MovieWriter(const std::string& path, MovieFormat format, Size size,
                         int frames_per_second, int loss)
    : path_(path), aside_(path + ".partial") {
    open_aside();
    try {
        ffmpeg_ = std::make_unique<Ffmpeg>(
            arguments(format, size, frames_per_second, loss), Ffmpeg::Side::input,
            "Movies are made by the program ffmpeg, which was not found: install it "
            "(apt-get install ffmpeg), or write the frames as pictures with --frames DIR.",
            aside_);
    } catch (const DrawFailure&) {
        ::unlink(aside_.c_str());
        ::close(lock_);
        throw;
    }
}

MovieWriter::~MovieWriter() {
    ffmpeg_.reset();
    if (!finished_) ::unlink(aside_.c_str());
    ::close(lock_);
}

/// Always a file of our own: the ffmpeg of a movie that was killed still writes into the one that
/// it was given. (ffmpeg would complain too, but only once the first frames have been drawn.)
void MovieWriter::open_aside() {
    for (int attempt = 0; attempt < 100; ++attempt) {
        lock_ = ::open(aside_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        const bool fresh = lock_ >= 0;
        if (!fresh && errno == EEXIST)
            lock_ = ::open(aside_.c_str(), O_WRONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
        if (lock_ < 0 && errno == ENOENT) continue;
        if (lock_ < 0)
            throw DrawFailure("The movie " + path_ +
                              " could not be written: " + std::strerror(errno) + ".");
        const bool locked = ::flock(lock_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
        struct stat about {};
        if (locked && fresh && ::fstat(lock_, &about) == 0 && about.st_nlink > 0) return;
        if (locked && !fresh) ::unlink(aside_.c_str());  // what a kill left behind
        ::close(lock_);
        if (!locked) break;
    }
    throw DrawFailure("The movie " + path_ +
                      " is being made by another process; wait for it or choose another name.");
}

void MovieWriter::fail(int status) {
    ::unlink(aside_.c_str());
    finished_ = true;
    throw DrawFailure("The movie " + path_ + " could not be made: ffmpeg " +
                      ffmpeg_->how_it_ended(status));
}

void MovieWriter::write(std::span<const std::uint8_t> frame) {
    while (!frame.empty()) {
        const ssize_t sent = ::send(ffmpeg_->socket(), frame.data(), frame.size(), MSG_NOSIGNAL);
        if (sent > 0) {
            frame = frame.subspan(static_cast<std::size_t>(sent));
        } else if (sent < 0 && errno != EINTR) {
            fail(ffmpeg_->end());
        }
    }
}

void MovieWriter::finish() {
    // Shutting down, not closing: what is still under way arrives, then comes the end.
    ::shutdown(ffmpeg_->socket(), SHUT_WR);
    const int status = ffmpeg_->end();
    const bool well = WIFEXITED(status) && WEXITSTATUS(status) == 0;
    // ffmpeg has been seen to end with code 0 after it could not write everything.
    const std::string said = ffmpeg_->said();
    const bool complained =
        std::any_of(std::begin(problem_with_disks), std::end(problem_with_disks),
                    [&](const char* problem) { return said.find(problem) != std::string::npos; });
    struct stat about {};
    const bool empty = ::fstat(lock_, &about) != 0 || about.st_size == 0;
    if (!well || complained || empty) fail(status);
    finished_ = true;
    // Only now is it known that all of it arrived.
    if (::fsync(lock_) == 0 && std::rename(aside_.c_str(), path_.c_str()) == 0) return;
    const std::string reason = std::strerror(errno);
    ::unlink(aside_.c_str());
    throw DrawFailure("The movie " + path_ + " could not be written: " + reason + ".");
}

}  // namespace swirl
