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
#include "swirl/render/numbered_frames.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/json.hpp"
#include "swirl/run/simd.hpp"

namespace swirl {

namespace {

/// A number as people write it, with the true minus sign.
std::string plain(double value) {
    const std::string text = fmt::format("{:g}", std::abs(value));
    return value < 0.0 ? "−" + text : text;
}

/// To four digits: a caption, not a result.
double rounded(double value) {
    const double scale = std::pow(10.0, 3.0 - std::floor(std::log10(std::abs(value) + 1e-300)));
    return value == 0.0 ? 0.0 : std::round(value * scale) / scale;
}

/// Points along the path of C; the circle gets enough of them to look round.
std::vector<Vec2> outline(const ContainerPath& path) {
    std::vector<Vec2> points;
    for (const Segment& segment : path.segments) {
        const int parts = segment.turning == 0.0 ? 1 : 180;
        for (int k = 0; k < parts; ++k)
            points.push_back(
                segment.position_at(segment.begin + (segment.end - segment.begin) * k / parts));
    }
    return points;
}

/// "$μ_{d}$": a parameter's symbol, as labels are written (render/label.hpp).
std::string symbol_of(const char* name) {
    const std::string symbol = find_parameter(name)->symbol;
    const std::size_t subscript = symbol.find('_');
    if (subscript == symbol.npos) return "$" + symbol + "$";
    return fmt::format("${}_{{{}}}$", symbol.substr(0, subscript), symbol.substr(subscript + 1));
}

std::string caption_of(const RunConfig& config) {
    return fmt::format("{} {}{}", config.discs, body_word(config), config.discs == 1 ? "" : "s");
}

/// Nothing where it is of another version, or there is nothing.
std::optional<RunConfig> config_in(const std::string& parameters) try {
    if (parameters.empty()) return std::nullopt;
    return resolve(parameters_in(parameters));
} catch (const UsageError&) {
    return std::nullopt;
}

/// Spheres, followed from event to event, so that it is known how each is turned.
class FollowedSpheres {
  public:
    FollowedSpheres(const RunConfig& config, const std::atomic<bool>* stop)
        : path_(make_path(config)),
          simulation_(make_initial_state(config, stop), Progress{}, selected_tuning(stop)),
          seen_(simulation_.snapshot()),
          stop_(stop) {
        seen_.turned.assign(seen_.size(), {});
        if (!stopped()) next_ = simulation_.step();
    }

    Snapshot at(double periods) {
        const double whole = std::floor(periods);
        const auto period = static_cast<std::int64_t>(whole);
        const double clock = (periods - whole) * path_.period;
        for (int k = 0; next_.periods < period || (next_.periods == period && next_.clock <= clock);
             ++k) {
            if (k % 4096 == 0 && stopped())
                throw Interrupted("Stopped before the moment that was to be shown.");
            simulation_.refresh(seen_, next_);
            next_ = simulation_.step();
        }
        Snapshot then = seen_;
        then.clock = clock;
        const Segment& segment = path_.segment_at(clock);
        then.container_centre = segment.position_at(clock);
        then.container_velocity = segment.velocity_at(clock);
        return then.up_to_date();
    }

  private:
    bool stopped() const { return stop_ && stop_->load(std::memory_order_relaxed); }

    ContainerPath path_;
    Simulation simulation_;
    Snapshot seen_;  // before next_
    Event next_{};
    const std::atomic<bool>* stop_;
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
    labels.push_back(fmt::format("seed {}", config.seed));
    return labels;
}

FrameSource simulated(const RunConfig& config, const std::atomic<bool>* stop) {
    FrameSource source;
    const ContainerPath path = make_path(config);
    source.open = [config, stop]() -> Reel {
        const auto reject_stopped = [stop] {
            if (stop && stop->load(std::memory_order_relaxed))
                throw Interrupted("Stopped before the moment that was to be shown.");
        };
        if (config.shape() != Shape::disc) {
            const auto spheres = std::make_shared<FollowedSpheres>(config, stop);
            reject_stopped();
            return [spheres](double periods) { return spheres->at(periods); };
        }
        auto simulation = std::make_shared<Simulation>(make_initial_state(config, stop), Progress{},
                                                       selected_tuning(stop));
        reject_stopped();
        // A few hundred thousand events at once.
        const double step = 3000.0 / static_cast<double>(config.discs);
        return [=, period = config.period](double periods) {
            const auto advance_to = [&](double moment) {
                const double whole = std::floor(moment);
                simulation->advance_to(static_cast<std::int64_t>(whole), (moment - whole) * period);
                reject_stopped();
            };
            const double now =
                static_cast<double>(simulation->periods()) + simulation->clock() / period;
            for (double k = 1.0; now + k * step < periods; ++k) advance_to(now + k * step);
            advance_to(periods);
            return simulation->snapshot();
        };
    };
    source.path = outline(path);
    source.container_radius = config.container_radius;
    source.amplitude = config.amplitude;
    source.period = config.period;
    source.caption = caption_of(config);
    source.parameters = parameter_labels(config);
    source.knows_slip = config.floor;
    return source;
}

FrameSource rolling(const RollingBall& ball, double amplitude, double period) {
    FrameSource source;
    source.open = [=]() -> Reel {
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

/// A share u of the way on the shorter arc from p to q, as good as evenly where it is short.
Quaternion between(const Quaternion& p, const Quaternion& q, double u) {
    const double same = p.w * q.w + p.x * q.x + p.y * q.y + p.z * q.z < 0.0 ? -1.0 : 1.0;
    const auto mixed = [&](double a, double b) { return a + u * (same * b - a); };
    return unit({mixed(p.w, q.w), mixed(p.x, q.x), mixed(p.y, q.y), mixed(p.z, q.z)});
}

/// Between `a` and `b`, a share u of the way: straight lines.
Snapshot between(const Snapshot& a, const Snapshot& b, double u, double periods) {
    Snapshot s = a;
    const double whole = std::floor(periods);
    s.periods = static_cast<std::int64_t>(whole);
    s.clock = (periods - whole) * s.period;
    s.container_centre = a.container_centre + u * (b.container_centre - a.container_centre);
    const bool same = a.size() == b.size();
    for (std::size_t i = 0; i < a.size(); ++i) {
        const Vec2 p = a.position(i), q = same ? b.position(i) : p;
        s.x[i] = p.x + u * (q.x - p.x);
        s.y[i] = p.y + u * (q.y - p.y);
        const double from = a.orientation(i);
        s.angle[i] = same ? from + u * (b.orientation(i) - from) : from;
        if (same && !a.turned.empty() && !b.turned.empty())
            s.turned[i] = between(a.quaternion(i), b.quaternion(i), u);
        s.held_at[i] = s.clock;
    }
    return s;
}

/// Two neighbouring frames of a recording, moved forwards.
class Projector {
  public:
    explicit Projector(const SnapshotSeries& series) : series_(series), left_(series.frame(0)) {
        right_ = series_.frames > 1 ? series_.frame(1) : left_;
    }

    Snapshot at(double periods) {
        while (periods_of(right_) < periods && next_ + 1 < series_.frames) {
            left_ = std::move(right_);
            right_ = series_.frame(++next_);
        }
        const double from = periods_of(left_), step = periods_of(right_) - from;
        const double share = step > 0.0 ? (periods - from) / step : 0.0;
        // On a frame, to the last bits: exactly that frame.
        if (share < 1e-9) return left_;
        if (share > 1.0 - 1e-9) return right_;
        return between(left_, right_, share, periods);
    }

  private:
    SnapshotSeries series_;
    Snapshot left_, right_;
    std::uint64_t next_ = 1;  // number of right_
};

}  // namespace

FrameSource recorded(const SnapshotSeries& series, const std::string& caption) {
    if (series.frames == 0) throw Failure("There is not one frame in " + caption + ".");
    FrameSource source;
    const Snapshot first = series.frame(0), last = series.frame(series.frames - 1);
    source.open = [series]() -> Reel {
        auto projector = std::make_shared<Projector>(series);
        return [projector](double periods) { return projector->at(periods); };
    };
    source.container_radius = first.container_radius;
    source.amplitude = std::max(series.reach - first.container_radius, 0.0);
    source.period = first.period;
    if (source.amplitude > 0.0) source.path = outline(circular_path(source.amplitude, 1.0));
    source.caption = caption;
    source.parameters = {fmt::format("$N$ = {}", first.size()),
                         "$R$ = " + plain(rounded(first.container_radius)) + " $r$",
                         "$A$ = " + plain(rounded(source.amplitude)) + " $r$",
                         fmt::format("{} recorded frames", series.frames)};
    source.from = periods_of(first);
    source.to = periods_of(last);
    const auto known = [](const std::vector<double>& values) {
        return std::none_of(values.begin(), values.end(), [](double v) { return std::isnan(v); });
    };
    if (*source.to > *source.from)
        source.frames_per_swirl =
            static_cast<double>(series.frames - 1) / (*source.to - *source.from);
    source.knows_spin = known(first.spin);
    source.knows_orientation = known(first.angle);
    source.knows_slip = first.are_spheres() && first.on_floor;
    return source;
}

namespace {

/// When the frames of a camera were taken, in swirls.
class FrameTable {
  public:
    FrameTable(const Tracks& tracks, const TrackScale& scale) {
        for (const TrackFrame& frame : tracks.frames) {
            numbers.push_back(frame.number);
            times_.push_back(static_cast<double>(frame.number) /
                             (scale.frames_per_time * scale.period));
            ids.push_back(frame.id);
        }
    }

    std::size_t nearest(double periods) const {
        const auto after = std::lower_bound(times_.begin(), times_.end(), periods);
        if (after == times_.begin()) return 0;
        const auto k = static_cast<std::size_t>(after - times_.begin());
        if (after == times_.end()) return k - 1;
        return periods - times_[k - 1] < times_[k] - periods ? k - 1 : k;
    }

    std::vector<std::int64_t> numbers;
    std::vector<std::vector<std::int64_t>> ids;

  private:
    std::vector<double> times_;
};

/// Where the camera's pixels lie in the plane of the discs.
Backdrop placed(const TrackScale& scale, bool y_down) {
    const double unit = 1.0 / scale.pixels_per_radius;
    Backdrop backdrop;
    backdrop.along_x = {scale.clockwise ? -unit : unit, 0.0};
    backdrop.along_y = {0.0, y_down ? -unit : unit};
    backdrop.origin =
        -scale.swirl_centre.x * backdrop.along_x - scale.swirl_centre.y * backdrop.along_y;
    return backdrop;
}

}  // namespace

FrameSource tracked(Tracks tracks, const TrackScale& scale, const std::string& caption,
                    const std::string& pictures, std::int64_t first_picture) {
    const auto table = std::make_shared<const FrameTable>(tracks, scale);
    const Backdrop place = placed(scale, tracks.y_down);
    const SnapshotSeries series = series_of(std::move(tracks), scale);
    FrameSource source = recorded(series, caption);
    source.frames_per_swirl = scale.frames_per_time * scale.period;
    if (series.same_discs()) source.open_between = source.open;
    if (!series.same_discs() || !pictures.empty())
        source.open = [series, table]() -> Reel {
            return
                [series, table](double periods) { return series.frame(table->nearest(periods)); };
        };
    if (!series.same_discs())
        source.ids = [table](double periods) { return table->ids[table->nearest(periods)]; };
    if (pictures.empty()) return source;

    const NumberedFrames video(pictures);
    for (const std::int64_t number : {table->numbers.front(), table->numbers.back()})
        if (!video.may_have(number + first_picture))
            throw Failure(fmt::format(
                "There is no picture '{}', which frame {} of the tracks would be drawn over.",
                video.name(number + first_picture), number));
    source.open_backdrop = [=]() -> BackdropReel {
        const auto reel = std::make_shared<NumberedFrames>(pictures);
        return [=](double periods) {
            Backdrop backdrop = place;
            const std::int64_t number = table->numbers[table->nearest(periods)];
            backdrop.image = reel->picture(number + first_picture);
            return backdrop;
        };
    };
    return source;
}

FrameSource recorded(const std::string& file) try {
    auto reader = std::make_shared<TrajectoryReader>(file);
    if (reader->frames() == 0) throw Failure("There is not one frame in " + file + ".");
    const std::string name = std::filesystem::path(file).filename().string();
    FrameSource source = recorded(series_of(reader), escaped(name));
    // What the file says of its run is what a film of the run itself would say.
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
