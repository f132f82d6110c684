#include "swirl/cli/progress_line.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>

#include "swirl/cli/output.hpp"

namespace swirl {
namespace {

constexpr std::chrono::milliseconds redraw_interval(100);
constexpr std::chrono::seconds first_line_after(10), line_interval(30);

bool is_set(const char* variable) {
    const char* const value = std::getenv(variable);
    return value && *value;
}

bool is_capable_terminal() {
    const char* const kind = std::getenv("TERM");
    return isatty(STDERR_FILENO) && kind && std::string(kind) != "dumb";
}

}  // namespace

ProgressLine::ProgressLine(std::string label, bool quiet)
    : label_(std::move(label)),
      quiet_(quiet),
      terminal_(is_capable_terminal()),
      color_(terminal_ && !is_set("NO_COLOR")),
      next_(created_ + (terminal_ ? std::chrono::seconds(0) : first_line_after)) {}

ProgressLine::~ProgressLine() { clear(); }

void ProgressLine::clear() {
    const std::lock_guard lock(mutex_);
    if (drawn_) std::fputs("\r\x1b[K", stderr);
    drawn_ = false;
}

void ProgressLine::set_stages(std::vector<ProgressStage> stages) {
    const std::lock_guard lock(mutex_);
    estimate_ = RemainingTime(std::move(stages));
}

void ProgressLine::show(double fraction, const std::string& rate) { show(fraction, "", rate); }

void ProgressLine::show_stage(const std::string& name, double share) { show(share, name, name); }

void ProgressLine::show(double share, const std::string& stage, const std::string& rate) {
    if (quiet_) return;
    const std::lock_guard lock(mutex_);
    const auto now = Clock::now();
    estimate_.add(std::chrono::duration<double>(now - created_).count(), stage, share);
    if (now < next_) return;
    const std::optional<double> left = estimate_.seconds_left();
    if (terminal_) {
        next_ = now + redraw_interval;
        draw_bar(estimate_.fraction(), rate, left ? short_duration(*left) : "?");
        return;
    }
    next_ = now + line_interval;
    fmt::print(stderr, "{}: {:.0f} %, {}, {} left\n", label_, 100.0 * estimate_.fraction(), rate,
               left ? short_duration(*left) : "unknown time");
}

void ProgressLine::show_events(double fraction, std::uint64_t events) {
    const std::chrono::duration<double> elapsed = Clock::now() - created_;
    show(fraction, short_number(double(events) / elapsed.count()) + " events/s");
}

void ProgressLine::draw_bar(double fraction, const std::string& rate, const std::string& left) {
    const std::string tail = fmt::format(" {:3.0f} %  {}  {} left", 100.0 * fraction, rate, left);
    const std::size_t width = terminal_width(STDERR_FILENO, 80);
    const std::size_t taken = label_.size() + tail.size() + 2;
    constexpr std::size_t min_bar = 8, max_bar = 40;  // characters
    const std::size_t bar = width > taken + min_bar ? std::min(width - taken - 1, max_bar) : 0;
    const auto full = static_cast<std::size_t>(fraction * static_cast<double>(bar));
    std::string line = label_ + " ";
    if (bar > 0) {
        if (color_) line += "\x1b[36m";
        for (std::size_t k = 0; k < bar; ++k) line += k < full ? "█" : "·";
        if (color_) line += "\x1b[0m";
    }
    fmt::print(stderr, "\r{}{}\x1b[K", line, taken < width ? tail : "");
    std::fflush(stderr);
    drawn_ = true;
}

std::string short_number(double value) {
    if (value >= 1e6) return fmt::format("{:.1f} million", value / 1e6);
    if (value >= 1e3) return fmt::format("{:.0f} thousand", value / 1e3);
    return fmt::format("{:.0f}", value);
}

std::string short_duration(double seconds) {
    const auto s = static_cast<long long>(std::ceil(std::min(seconds, 1e15)));
    if (s < 60) return fmt::format("{} s", s);
    if (s < 3600) return fmt::format("{} min {} s", s / 60, s % 60);
    if (s < 48 * 3600) return fmt::format("{} h {} min", s / 3600, s % 3600 / 60);
    return fmt::format("{} days", s / 86400);
}

}  // namespace swirl
