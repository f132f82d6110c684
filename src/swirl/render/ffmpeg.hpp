// Runs the program ffmpeg as a child process, connected through a socket.
//
// After Ctrl-C this program ends ffmpeg properly (io/child_process.hpp). The standard error of
// ffmpeg is stored, to be quoted in error messages.
#pragma once

#include <string>
#include <vector>

namespace swirl {

/// Filter that makes the pixels of a video square, as its sample aspect ratio says.
inline constexpr const char* square_pixels = "scale=round(iw*sar):ih";

class Ffmpeg {
  public:
    /// The end of ffmpeg that the socket is connected to. With `both`, it is a filter: what is sent
    /// is its input, and what is received its output.
    enum class Side { input, output, both };
    static constexpr const char* output_name = "file:/dev/fd/3";

    /// Starts `ffmpeg` with these arguments. Throws DrawFailure if it does not start; `missing` is
    /// the message if it is not installed. A file `output` is opened here and passed on as
    /// output_name. ffmpeg itself would open it only after the first frames, and by then the name
    /// may belong to another process.
    Ffmpeg(std::vector<std::string> arguments, Side side, const std::string& missing,
           const std::string& output = "");
    /// Kills ffmpeg if it still runs.
    ~Ffmpeg();
    Ffmpeg(const Ffmpeg&) = delete;
    Ffmpeg& operator=(const Ffmpeg&) = delete;

    /// Our end of the socket.
    int socket() const { return socket_; }
    /// Closes the socket, waits for ffmpeg to end and returns its status as waitpid() does.
    int end();
    /// The first 4096 bytes of its standard error.
    std::string error_output() const;
    /// The first line of its standard error: the cause. Later lines report consequences.
    std::string problem() const;
    /// "ended with code 1 and printed: …", to complete a sentence.
    std::string describe_end(int status) const;

  private:
    int socket_ = -1;
    int errors_ = -1;  // an unnamed file that receives its standard error
    int process_ = -1;
};

}  // namespace swirl
