// How far the work is, on stderr: a bar with rate and time left that is drawn over itself on a
// terminal, a line now and then in a log file, nothing at all with --quiet. NO_COLOR is respected.
#pragma once

#include <chrono>
#include <mutex>
#include <string>

namespace swirl {

class ProgressLine {
  public:
    ProgressLine(std::string what, bool quiet);
    ~ProgressLine();
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    /// `fraction` of the work that is done, and something like "1.2 M events/s". Call as often as
    /// you like, from any thread.
    void show(double fraction, const std::string& rate);

    /// Removes the bar, so that something else can be printed.
    void clear();

  private:
    using Clock = std::chrono::steady_clock;
    void draw_bar(double fraction, const std::string& rate, double left);

    const std::string what_;
    const bool quiet_, terminal_, color_;
    Clock::time_point begin_;  // of what is done now
    double last_ = 0.0;        // fraction that was shown
    Clock::time_point next_;
    bool drawn_ = false;
    std::mutex mutex_;
};

/// "850 thousand/s", "1.6 million/s": for rates.
std::string short_number(double value);
/// "12 s", "3 min 20 s", "2 h 5 min".
std::string short_duration(double seconds);

}  // namespace swirl
