// Progress on stderr: on a terminal a bar with rate and remaining time, in a log file an occasional
// line, and nothing with --quiet. Respects NO_COLOR.
#pragma once

#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "swirl/statistics/remaining_time.hpp"

namespace swirl {

class ProgressLine {
  public:
    ProgressLine(std::string label, bool quiet);
    ~ProgressLine();
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    /// `fraction`: of the work done; `rate`: "1.2 million events/s". May be called at any rate and
    /// from any thread.
    void show(double fraction, const std::string& rate);

    /// Progress of one of several stages; `name` is shown instead of a rate.
    void show_stage(const std::string& name, double share);
    /// The stages of show_stage(), with their expected durations relative to each other.
    void set_stages(std::vector<ProgressStage> stages);

    /// The same as show(), with the rate of `events` since the line was created.
    void show_events(double fraction, std::uint64_t events);

    /// Removes the bar before other output.
    void clear();

  private:
    using Clock = std::chrono::steady_clock;
    void show(double share, const std::string& stage, const std::string& rate);
    void draw_bar(double fraction, const std::string& rate, const std::string& left);

    const std::string label_;
    const bool quiet_, terminal_, color_;
    const Clock::time_point created_ = Clock::now();
    RemainingTime estimate_;
    Clock::time_point next_;
    bool drawn_ = false;
    std::mutex mutex_;
};

/// "850 thousand", "1.6 million".
std::string short_number(double value);
/// "12 s", "3 min 20 s", "2 h 5 min".
std::string short_duration(double seconds);

}  // namespace swirl
