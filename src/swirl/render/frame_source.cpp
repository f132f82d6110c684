#include "swirl/render/frame_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "swirl/engine/simulation.hpp"
#include "swirl/io/file_error.hpp"
#include "swirl/io/trajectory.hpp"
#include "swirl/math/unit_circle.hpp"
#include "swirl/render/label.hpp"
#include "swirl/run/collapse_guard.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/json.hpp"
#include "swirl/run/measured_series.hpp"
#include "swirl/run/particle_sizes.hpp"
#include "swirl/run/path_parameter.hpp"
#include "swirl/run/simd.hpp"

namespace swirl {

namespace {

/// The shortest form of a number, with a typographic minus sign.
std::string plain(double value) {
    const std::string text = fmt::format("{:g}", std::abs(value));
    return value < 0.0 ? "−" + text : text;
}

/// Rounds to four digits, which are enough for a caption.
double rounded(double value) {
    const double scale = std::pow(10.0, 3.0 - std::floor(std::log10(std::abs(value) + 1e-300)));
    return value == 0.0 ? 0.0 : std::round(value * scale) / scale;
}

/// Points along the path of C. An arc has enough points to look round.
std::vector<Vec2> outline(const ContainerPath& path) {
    std::vector<Vec2> points;
    for (const Segment& segment : path.segments) {
        constexpr int points_per_arc = 180;
        const int parts = segment.turn_rate == 0.0 ? 1 : points_per_arc;
        for (int k = 0; k < parts; ++k)
            points.push_back(
                segment.position_at(segment.begin + (segment.end - segment.begin) * k / parts));
    }
    return points;
}

/// "$μ_{d}$": a parameter's symbol in the notation of render/label.hpp.
std::string symbol_of(const char* name) {
    const std::string symbol = find_parameter(name)->symbol;
    const std::size_t subscript = symbol.find('_');
    if (subscript == symbol.npos) return "$" + symbol + "$";
    return fmt::format("${}_{{{}}}$", symbol.substr(0, subscript), symbol.substr(subscript + 1));
}

std::string caption_of(const RunConfig& config) {
    return fmt::format("{} {}{}", config.discs, body_word(config), config.discs == 1 ? "" : "s");
}

/// Nothing if the text is empty or comes from another version.
std::optional<RunConfig> config_in(const std::string& parameters) try {
    if (parameters.empty()) return std::nullopt;
    return resolve(parameters_in(parameters));
} catch (const UsageError&) {
    return std::nullopt;
}

/// A clock within a period and the number of whole periods.
struct Time {
    std::int64_t periods;
    double clock;

    Time(double in_periods, double period)
        : periods(static_cast<std::int64_t>(std::floor(in_periods))),
          clock((in_periods - std::floor(in_periods)) * period) {}
};

/// A pass over a simulation.
class SimulatedPlayback {
  public:
    SimulatedPlayback(const RunConfig& config, const std::atomic<bool>* stop)
        : stop_(stop),
          path_(make_path(config)),
          simulation_(make_initial_state(config, stop), Progress{}, selected_tuning(stop)),
          config_(config),
          guard_(simulation_, path_.period) {
        throw_if_stopped();
        if (config.shape() == Shape::disc) return;
        spheres_ = simulation_.snapshot();
        spheres_->turned.assign(spheres_->size(), {});
        next_ = simulation_.step();
    }

    Snapshot at(double periods) { return spheres_ ? spheres_at(periods) : discs_at(periods); }

  private:
    static constexpr int events_between_checks = 4096;

    void throw_if_stopped() {
        if (stop_ && stop_->load(std::memory_order_relaxed))
            throw Interrupted("stopped before the time that was to be shown.");
        if (auto sentence = guard_.problem(simulation_, path_.period, config_))
            throw Failure(*sentence);
    }

    Snapshot discs_at(double periods) {
        const Time time(periods, path_.period);
        while (!simulation_.advance_to(time.periods, time.clock, events_between_checks))
            throw_if_stopped();
        throw_if_stopped();
        return simulation_.snapshot();
    }

    /// Follows spheres from event to event, because their orientations must be integrated.
    Snapshot spheres_at(double periods) {
        const Time time(periods, path_.period);
        for (int k = 0; next_.periods < time.periods ||
                        (next_.periods == time.periods && next_.clock <= time.clock);
             ++k) {
            if (k % events_between_checks == 0) throw_if_stopped();
            simulation_.refresh(*spheres_, next_);
            next_ = simulation_.step();
        }
        Snapshot then = *spheres_;
        then.clock = time.clock;
        const Segment& segment = path_.segment_at(time.clock);
        then.container_centre = segment.position_at(time.clock);
        then.container_velocity = segment.velocity_at(time.clock);
        return then.up_to_date();
    }

    const std::atomic<bool>* stop_;
    ContainerPath path_;
    Simulation simulation_;
    RunConfig config_;
    CollapseGuard guard_;
    std::optional<Snapshot> spheres_;  // the state before next_; empty for discs
    Event next_{};
};

}  // namespace

std::vector<std::string> parameter_labels(const RunConfig& config) {
    std::vector<std::string> labels;
    const auto label = [&](const char* name, const std::string& value) {
        labels.push_back(symbol_of(name) + " = " + value);
    };
    label("discs", fmt::format("{}", config.discs));
    label("mu_disc", plain(config.mu_disc));
    label("mu_wall", plain(config.mu_wall));
    if (config.restitution != 1.0) label("restitution", plain(config.restitution));
    if (config.tangential_restitution != 0.0)
        label("tangential_restitution", plain(config.tangential_restitution));
    label("inertia",
          plain(config.inertia / (config.mass * config.radius * config.radius)) + " $m$$r^{2}$");
    if (config.floor) label("floor_friction", plain(config.floor_friction));
    label("container_radius", plain(config.container_radius / config.radius) + " $r$");
    label("amplitude", plain(config.amplitude / config.radius) + " $r$");
    if (config.mixture)
        labels.push_back(fmt::format("{} {}s of {} $r$", config.mixture->count, body_word(config),
                                     plain(config.mixture->radius / config.radius)));
    if (config.sizes) labels.push_back(radii_text(config));
    labels.push_back(fmt::format("seed {}", config.seed));
    return labels;
}

FrameSource simulated(const RunConfig& config, const std::atomic<bool>* stop) {
    FrameSource source;
    source.open = [config, stop]() -> Playback {
        const auto playback = std::make_shared<SimulatedPlayback>(config, stop);
        return [playback](double periods) { return playback->at(periods); };
    };
    source.path = outline(make_path(config));
    source.container_radius = config.container_radius;
    source.amplitude = path_reach(config);
    source.period = config.period;
    source.clockwise = config.turns_clockwise();
    source.caption = caption_of(config);
    source.parameters = parameter_labels(config);
    source.has_slip = config.floor;
    return source;
}

FrameSource rolling(const RollingBall& ball, double amplitude, double period) {
    FrameSource source;
    source.open = [=]() -> Playback {
        return
            [=](double periods) { return snapshot_at(ball, amplitude, period, periods * period); };
    };
    source.path = outline(circular_path(amplitude, period));
    source.container_radius = ball.container_radius;
    source.amplitude = amplitude;
    source.period = period;
    source.caption = ball.slip == 0.0   ? "one ball that slips"
                     : ball.slip == 1.0 ? "one ball that rolls"
                                        : "one ball that rolls and slips";
    source.parameters = {"$s$ = " + plain(ball.slip),
                         "$γ$ = $s$ $R$/$R_{ball}$ = " + plain(rounded(ball.gamma())),
                         "$ϖ$/$Ω$ = 1 − $γ$ = " + plain(rounded(ball.rotation()))};
    return source;
}

namespace {

double periods_of(const Snapshot& s) {
    return static_cast<double>(s.periods) + (s.period > 0.0 ? s.clock / s.period : 0.0);
}

/// The rotation at a share u of the shorter arc from p to q. Linear interpolation is good enough
/// for short arcs.
Quaternion interpolated(const Quaternion& p, const Quaternion& q, double u) {
    const double sign = p.w * q.w + p.x * q.x + p.y * q.y + p.z * q.z < 0.0 ? -1.0 : 1.0;
    const auto mixed = [&](double a, double b) { return a + u * (sign * b - a); };
    return unit({mixed(p.w, q.w), mixed(p.x, q.x), mixed(p.y, q.y), mixed(p.z, q.z)});
}

/// The state at a share u of the straight lines from `a` to `b`.
Snapshot interpolated(const Snapshot& a, const Snapshot& b, double u, double periods) {
    Snapshot s = a;
    const Time time(periods, s.period);
    s.periods = time.periods;
    s.clock = time.clock;
    s.container_centre = a.container_centre + u * (b.container_centre - a.container_centre);
    const bool same = a.size() == b.size();
    for (std::size_t i = 0; i < a.size(); ++i) {
        const Vec2 p = a.position(i), q = same ? b.position(i) : p;
        s.x[i] = p.x + u * (q.x - p.x);
        s.y[i] = p.y + u * (q.y - p.y);
        const double from = a.orientation(i);
        s.angle[i] = same ? from + u * (b.orientation(i) - from) : from;
        if (same && !a.turned.empty() && !b.turned.empty())
            s.turned[i] = interpolated(a.quaternion(i), b.quaternion(i), u);
        s.held_at[i] = s.clock;
    }
    return s;
}

/// True if two discs overlap by more than a hundredth of a diameter. Between two stored states that
/// are far apart, straight lines lead through other discs. Of more discs than this an image shows
/// no such overlap, and the comparison of all pairs would take longer than the drawing.
bool has_overlap(const Snapshot& s) {
    constexpr std::size_t most = 2000;
    constexpr double allowed = 0.99;
    if (s.size() > most) return false;
    for (std::size_t i = 0; i < s.size(); ++i)
        for (std::size_t j = i + 1; j < s.size(); ++j) {
            const double reach = allowed * (s.radius[i] + s.radius[j]);
            const double dx = s.x[i] - s.x[j], dy = s.y[i] - s.y[j];
            if (dx * dx + dy * dy < reach * reach) return true;
        }
    return false;
}

/// A pass over a recording: two consecutive frames, moved forwards. The states in between are on
/// straight lines, or the nearer frame if discs would overlap there.
class RecordedPlayback {
  public:
    explicit RecordedPlayback(const SnapshotSeries& series)
        : series_(series), left_(series.frame(0)) {
        right_ = series_.frames > 1 ? series_.frame(1) : left_;
    }

    Snapshot at(double periods) {
        while (periods_of(right_) < periods && next_ + 1 < series_.frames) {
            left_ = std::move(right_);
            right_ = series_.frame(++next_);
        }
        const double from = periods_of(left_), step = periods_of(right_) - from;
        const double share = step > 0.0 ? (periods - from) / step : 0.0;
        // At the time of a frame up to rounding, return exactly that frame.
        constexpr double rounding = 1e-9;
        if (share < rounding) return left_;
        if (share > 1.0 - rounding) return right_;
        Snapshot between = interpolated(left_, right_, share, periods);
        // Positions of a camera have errors, so discs may overlap in its frames, too.
        if (!has_overlap(between) || has_overlap(left_) || has_overlap(right_)) return between;
        return share < 0.5 ? left_ : right_;
    }

  private:
    SnapshotSeries series_;
    Snapshot left_, right_;
    std::uint64_t next_ = 1;  // number of right_
};

}  // namespace

FrameSource recorded(const SnapshotSeries& series, const std::string& caption) {
    if (series.frames == 0) throw Failure(fmt::format("'{}' has no frames.", caption));
    FrameSource source;
    const Snapshot first = series.frame(0), last = series.frame(series.frames - 1);
    source.open = [series]() -> Playback {
        const auto playback = std::make_shared<RecordedPlayback>(series);
        return [playback](double periods) { return playback->at(periods); };
    };
    source.container_radius = first.container_radius;
    source.amplitude = std::max(series.reach - first.container_radius, 0.0);
    source.period = first.period;
    source.clockwise = series.clockwise;
    if (source.amplitude > 0.0) source.path = outline(circular_path(source.amplitude, 1.0));
    source.caption = caption;
    source.parameters = {
        fmt::format("$N$ = {}", first.size()),
        "$R$ = " + plain(rounded(first.container_radius / series.units.r)) + " $r$",
        "$A$ = " + plain(rounded(source.amplitude / series.units.r)) + " $r$",
        fmt::format("{} recorded frames", series.frames)};
    source.from = periods_of(first);
    source.to = periods_of(last);
    const auto has_values = [](const std::vector<double>& values) {
        return std::none_of(values.begin(), values.end(), [](double v) { return std::isnan(v); });
    };
    if (*source.to > *source.from)
        source.frames_per_period =
            static_cast<double>(series.frames - 1) / (*source.to - *source.from);
    source.has_spin = has_values(first.spin);
    source.has_orientation = has_values(first.angle);
    source.has_slip = first.are_spheres() && first.on_floor;
    return source;
}

FrameSource recorded(const std::string& file) try {
    auto reader = std::make_shared<TrajectoryReader>(file);
    if (reader->frames() == 0) throw Failure(fmt::format("'{}' has no frames.", file));
    const std::string name = std::filesystem::path(file).filename().string();
    FrameSource source = recorded(series_of_run(reader), escaped(name));
    // With the parameters of its run, the recording is titled like the run itself.
    if (const auto config = config_in(reader->provenance("parameters"))) {
        source.caption = caption_of(*config);
        const std::string frames = source.parameters.back();
        source.parameters = parameter_labels(*config);
        source.parameters.push_back(frames);
    }
    return source;
} catch (const FileError& error) {
    throw Failure(error.what());
}

}  // namespace swirl
