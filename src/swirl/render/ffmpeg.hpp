// The program ffmpeg as a process of its own, fed or read through a socket.
//
// It gets its own process group: Ctrl-C reaches us alone, and we end it properly. What it says on
// its standard error is kept, for the sentence in which we report its end.
#pragma once

#include <string>
#include <vector>

namespace swirl {

class Ffmpeg {
  public:
    enum class Side { input, output };  // which end of ffmpeg we hold
    static constexpr const char* output_name = "file:/dev/fd/3";

    /// Starts `ffmpeg` with these arguments (without the name). Throws DrawFailure if it does not
    /// start; `missing` is the sentence for when there is none. A file `output` is open for it, as
    /// output_name: it would open one by its own name only when its first pictures are done, and by
    /// then that may be somebody else's.
    Ffmpeg(std::vector<std::string> arguments, Side side, const std::string& missing,
           const std::string& output = "");
    /// Kills it if it still runs.
    ~Ffmpeg();
    Ffmpeg(const Ffmpeg&) = delete;
    Ffmpeg& operator=(const Ffmpeg&) = delete;

    /// Our end of the socket: its standard input or output.
    int socket() const { return socket_; }
    /// Closes our end, waits for its end, and gives its status as waitpid() does.
    int end();
    /// What it said, from the beginning.
    std::string said() const;
    /// The first line of that: the cause; consequences follow.
    std::string problem() const;
    /// "ended with code 1 and said: …", to complete a sentence.
    std::string how_it_ended(int status) const;

  private:
    static constexpr int output_number = 3;
    int socket_ = -1;
    int problems_ = -1;  // an unnamed file that takes its standard error
    int process_ = -1;
};

}  // namespace swirl
