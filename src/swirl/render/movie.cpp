#include "swirl/render/movie.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <deque>
#include <memory>
#include <thread>

#include "swirl/io/atomic_file.hpp"
#include "swirl/measure/cluster_rotation.hpp"
#include "swirl/render/movie_file.hpp"
#include "swirl/render/painters.hpp"
#include "swirl/render/planar.hpp"
#include "swirl/run/failure.hpp"

namespace swirl {

namespace {

/// The state at one time, and the names of the discs where they come and go.
struct MomentState {
    Snapshot snapshot;
    std::vector<std::int64_t> ids;
};
using Moment = std::shared_ptr<const MomentState>;

/// Samples of the running plot, and points of a trail, per swirl.
constexpr int plot_samples = 64;
constexpr int trail_samples = 96;

/// The value that only one in fifty exceeds, rounded up to something readable.
double scale_end(std::vector<double> values) {
    std::erase_if(values, [](double v) { return !std::isfinite(v); });
    if (values.empty()) return 1.0;
    const auto place =
        values.begin() + static_cast<std::ptrdiff_t>(0.98 * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), place, values.end());
    if (!(*place > 0.0)) return 1.0;
    const double power = std::pow(10.0, std::floor(std::log10(*place)));
    for (const double step : {1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0})
        if (*place <= step * power * (1.0 + 1e-9)) return step * power;
    return 10.0 * power;
}

/// The rigid-body rate Σ r × v / Σ r². At one moment the mean over the discs says little: a disc
/// near the centre of mass has any angular velocity. A single disc has its spin, as in the minimal
/// model.
double rotation_of(const Snapshot& s) {
    return s.size() == 1 ? s.spin[0] : cluster_rotation(s).rigid;
}

/// What a first pass over the swirls finds: curves for the plot, ends of the colour scales.
struct Survey {
    std::vector<double> spins, speeds, slips;
    bool single_disc = true;  // in all that was looked at

    Curve look(const FrameSource& source, Frame frame, double start, double end) {
        const Reel reel = source.open();
        const double omega = 2.0 * pi / source.period;
        Curve curve;
        // One swirl earlier, where there is one, so that the running mean is there at once.
        const double begin = std::max(source.from.value_or(0.0), start - 1.0);
        double sum = 0.0;
        for (int k = 0;; ++k) {
            const double periods = begin + static_cast<double>(k) / plot_samples;
            if (periods > end + 1e-9) break;
            const Snapshot s = reel(std::min(periods, end));
            single_disc = single_disc && s.size() == 1;
            const double rotation = rotation_of(s) / omega;
            curve.time.push_back(periods);
            curve.raw.push_back(rotation);
            sum += rotation;
            const auto size = curve.raw.size();
            if (size > plot_samples) sum -= curve.raw[size - plot_samples - 1];
            curve.smooth.push_back(sum /
                                   static_cast<double>(std::min<std::size_t>(size, plot_samples)));
            if (k % 8 != 0) continue;
            const FrameAt at(s, frame);
            for (std::size_t i = 0; i < s.size(); ++i) {
                const Vec2 v = at.velocity(s.position(i), s.velocity(i));
                spins.push_back(std::abs(s.spin[i]));
                speeds.push_back(std::sqrt(dot(v, v)));
                if (!s.are_spheres()) continue;
                const Vec2 c = slip_on_floor(s.disc(i), s.container_velocity);
                slips.push_back(std::sqrt(dot(c, c)));
            }
        }
        return curve;
    }
};

/// One dish on its way through the movie: the moment now, and those just past.
class Camera {
  public:
    Camera(const FrameSource& source, const Appearance& appearance, double start)
        : reel_(source.open()),
          ids_(source.ids),
          from_(source.from.value_or(0.0)),
          length_(appearance.trails ? appearance.trail_length : 0.0) {
        if (appearance.coloring == Coloring::pinned) watch_.emplace(source, start);
        if (source.open_backdrop) backdrops_ = source.open_backdrop();
    }

    void advance_to(double periods) {
        if (length_ > 0.0) remember_until(periods);
        now_ = moment(periods);
        if (watch_) pinned_ = watch_->at(periods);
        if (backdrops_) backdrop_ = backdrops_(periods);
    }
    const std::optional<Backdrop>& backdrop() const { return backdrop_; }
    const std::vector<std::uint8_t>& pinned() const { return pinned_; }
    const Moment& now() const { return now_; }
    std::vector<Moment> past() const { return {past_.begin(), past_.end()}; }

  private:
    Moment moment(double periods) const {
        return std::make_shared<const MomentState>(
            MomentState{reel_(periods), ids_ ? ids_(periods) : std::vector<std::int64_t>()});
    }
    void remember_until(double periods) {
        const auto last = static_cast<std::int64_t>(std::ceil(periods * trail_samples)) - 1;
        const double first = std::max(from_, periods - length_) * trail_samples;
        next_ = std::max(next_, static_cast<std::int64_t>(std::ceil(first)));
        for (; next_ <= last; ++next_)
            past_.push_back(moment(static_cast<double>(next_) / trail_samples));
        const auto longest = static_cast<std::size_t>(std::ceil(length_ * trail_samples));
        while (past_.size() > longest) past_.pop_front();
    }

    Reel reel_;
    std::function<std::vector<std::int64_t>(double)> ids_;
    double from_, length_;
    std::int64_t next_ = 0;
    BackdropReel backdrops_;
    std::optional<Backdrop> backdrop_;
    std::deque<Moment> past_;
    Moment now_;
    std::optional<PinnedWatch> watch_;
    std::vector<std::uint8_t> pinned_;
};

/// What one frame needs; shared with the painters, which only read it.
struct Instant {
    double periods = 0.0;
    std::vector<Moment> now;                // per source
    std::vector<std::vector<Moment>> past;  // per source
    std::vector<std::vector<std::uint8_t>> pinned;
    std::vector<std::optional<Backdrop>> backdrop;
};

/// Where a painter works: its canvas, and what is the same in every frame, drawn once.
class Easel {
  public:
    explicit Easel(const Sheet& sheet) : canvas_(sheet.spec().size) {
        sheet.draw_still(canvas_);
        const auto pixels = canvas_.pixels();
        still_.assign(pixels.begin(), pixels.end());
    }

    Canvas& paint(const Sheet& sheet, const MovieConfig& config, const std::vector<Curve>& curves,
                  const Instant& instant) {
        const auto pixels = canvas_.pixels();
        std::copy(still_.begin(), still_.end(), pixels.begin());
        cairo_surface_mark_dirty(cairo_get_target(canvas_.cairo()));

        std::vector<std::vector<const Snapshot*>> past(config.sources.size());
        std::vector<std::vector<std::span<const std::int64_t>>> past_ids(config.sources.size());
        std::vector<SceneContent> contents;
        for (std::size_t k = 0; k < config.sources.size(); ++k) {
            for (const Moment& moment : instant.past[k]) {
                past[k].push_back(&moment->snapshot);
                if (config.sources[k].ids) past_ids[k].push_back(moment->ids);
            }
            for (std::size_t f = 0; f < config.appearance.frames.size(); ++f) {
                contents.push_back(
                    {.now = instant.now[k]->snapshot,
                     .path = config.sources[k].path,
                     .pinned = instant.pinned[k],
                     .past = past[k],
                     .backdrop = instant.backdrop[k] ? &*instant.backdrop[k] : nullptr,
                     .ids = instant.now[k]->ids,
                     .past_ids = past_ids[k]});
                if (config.appearance.turned)
                    contents.back().turned = turns_until(curves[k], config.start, instant.periods);
            }
        }
        sheet.draw_moving(canvas_, contents, curves, instant.periods);
        return canvas_;
    }

  private:
    Canvas canvas_;
    std::vector<std::uint8_t> still_;
};

void make_folder(const std::string& folder) {
    if (::mkdir(folder.c_str(), 0777) == 0 || errno == EEXIST) return;
    throw Failure(fmt::format("The folder {} for the frames could not be made: {}.", folder,
                              std::strerror(errno)));
}

double time_of_frame(const MovieConfig& config, int frame) {
    return config.start + frame * config.pace / config.frames_per_second;
}

}  // namespace

std::string frame_name(const std::string& folder, int number) {
    return fmt::format("{}/frame-{:06d}.png", folder, number);
}

PinnedWatch::PinnedWatch(const FrameSource& source, double first)
    : reel_(source.open_between ? source.open_between() : source.open()), to_(source.to) {
    // One swirl earlier, where there is one: a disc counts as pinned after eight frames at the
    // wall.
    const double begin = std::max(source.from.value_or(0.0), first - 1.0);
    next_ = static_cast<std::int64_t>(std::ceil(begin * frames_per_swirl));
}

std::optional<std::string> problem(const std::vector<FrameSource>& sources,
                                   const Appearance& appearance) {
    for (const FrameSource& container : sources) {
        if (appearance.coloring == Coloring::spin && !container.knows_spin)
            return fmt::format("{} tells no spins, so nothing can be coloured by them.",
                               container.caption);
        if (appearance.coloring == Coloring::slip && !container.knows_slip)
            return fmt::format(
                "There are no spheres on a floor in '{}', so nothing can be coloured by the slip "
                "on it; another --color would be right.",
                container.caption);
        if (appearance.coloring == Coloring::pinned && container.ids)
            return fmt::format(
                "The discs of {} are not the same in every frame, so which of them are pinned "
                "cannot be told; another --color would be right.",
                container.caption);
    }
    return std::nullopt;
}

const std::vector<std::uint8_t>& PinnedWatch::at(double periods) {
    const auto wanted = static_cast<std::int64_t>(std::floor(periods * frames_per_swirl + 1e-9)) +
                        PinnedLoose::half_width;
    for (; next_ <= wanted; ++next_) {
        const double moment = static_cast<double>(next_) / frames_per_swirl;
        if (to_ && moment > *to_) break;
        view_.update(reel_(moment));
        pinned_.sample(view_);
    }
    return pinned_.pinned();
}

std::optional<std::string> problem(const MovieConfig& config) {
    if (config.out.empty() && config.frames_folder.empty())
        return "There is nowhere for the movie to go: give --out FILE or --frames DIR.";
    const std::optional<MovieFormat> format = movie_format(config.out);
    if (!config.out.empty() && !format)
        return fmt::format(
            "The name '{}' does not tell what kind of movie is wanted: it must end in .mp4, .webm "
            "or .gif.",
            config.out);
    if (auto wrong = problem(config.sources, config.appearance)) return wrong;
    // Pictures alone take any size and rate; their sides may be odd.
    const Size size = config.appearance.size;
    if (format) {
        if (auto wrong = movie_problem(*format, size, config.frames_per_second)) return wrong;
    } else if (config.frames_per_second < 1) {
        return fmt::format("{} frames per second cannot be had: 1 or more can.",
                           config.frames_per_second);
    }
    if (!(config.pace > 0.0) || !std::isfinite(config.pace))
        return fmt::format("A pace of {} swirls per second cannot be shown: it must be above 0.",
                           config.pace);
    if (config.frames < 1 || config.frames > 1'000'000)
        return fmt::format("A movie of {} frames cannot be made: 1 to 1000000 can.", config.frames);
    if (!(config.start >= 0.0) || !std::isfinite(config.start))
        return fmt::format("A movie cannot start at swirl {}: it must be 0 or later.",
                           config.start);
    const double end = time_of_frame(config, config.frames - 1);
    for (const FrameSource& source : config.sources) {
        if (source.from && config.start < *source.from - 1e-9)
            return fmt::format("The recording starts at swirl {:.3f}, after the start at {:.3f}.",
                               *source.from, config.start);
        if (source.to && end > *source.to + 1e-6)
            return fmt::format(
                "The recording ends at swirl {:.3f}, before the movie does at {:.3f}: a shorter "
                "--seconds or a lower --pace would be right.",
                *source.to, end);
    }
    // The palette of a GIF belongs to the whole movie, so ffmpeg keeps every frame until the end.
    const double gif_bytes =
        4.0 * config.appearance.size.width * config.appearance.size.height * config.frames;
    if (format == MovieFormat::gif && gif_bytes > 2e9)
        return fmt::format(
            "This GIF would take {:.1f} GB of memory while it is made: fewer frames or a smaller "
            "--size would be right, or an .mp4.",
            gif_bytes * 1e-9);
    return std::nullopt;
}

Sheet make_sheet(const std::vector<FrameSource>& sources, const Appearance& appearance,
                 double start, double end, std::vector<Curve>& curves) {
    SheetSpec spec;
    spec.size = appearance.size;
    spec.style.theme = appearance.theme;
    spec.style.coloring = appearance.coloring;
    spec.style.points = appearance.points;
    spec.style.path = appearance.path;
    spec.style.forces = appearance.forces;
    spec.style.angles = appearance.angles;
    spec.style.slice = appearance.slice;
    spec.clock = appearance.texts && appearance.clock;
    // In slow motion the clock must still be seen to move.
    if (end > start)
        spec.clock_decimals =
            std::clamp(2 + static_cast<int>(std::ceil(-std::log10(end - start))), 2, 12);
    if (appearance.texts) {
        spec.title = escaped(appearance.title);
        if (spec.title.empty() && sources.size() == 1) spec.title = sources[0].caption;
        if (sources.size() == 1) spec.parameters = sources[0].parameters;
    }
    for (const FrameSource& container : sources) {
        for (Frame frame : appearance.frames) {
            const std::string name = frame == Frame::lab ? "lab frame" : "M-frame";
            Panel panel{frame, "", container.container_radius, container.amplitude,
                        appearance.turned && frame == Frame::lab};
            if (appearance.texts && sources.size() > 1)
                panel.caption = appearance.frames.size() > 1 ? container.caption + ", " + name
                                                             : container.caption;
            else if (appearance.texts)
                panel.caption = name;
            spec.panels.push_back(panel);
        }
    }
    if (sources.size() > 1 && appearance.texts) {
        // What all dishes share; the rest stands in their captions.
        for (const std::string& label : sources[0].parameters)
            if (std::all_of(sources.begin(), sources.end(), [&](const FrameSource& other) {
                    return std::find(other.parameters.begin(), other.parameters.end(), label) !=
                           other.parameters.end();
                }))
                spec.parameters.push_back(label);
    }
    const bool scaled = appearance.coloring == Coloring::spin ||
                        appearance.coloring == Coloring::speed ||
                        appearance.coloring == Coloring::slip;
    Survey survey;
    if (appearance.plot || appearance.turned || scaled) {
        for (std::size_t k = 0; k < sources.size(); ++k) {
            Curve curve = survey.look(sources[k], appearance.frames.front(), start, end);
            curve.color = k == 0 ? appearance.theme.curve : appearance.theme.pinned;
            if (sources.size() > 1) curve.label = sources[k].caption;
            curves.push_back(std::move(curve));
        }
        spec.style.full_spin = scale_end(std::move(survey.spins));
        const bool slip = appearance.coloring == Coloring::slip;
        spec.style.full_speed = appearance.full_speed.value_or(
            scale_end(std::move(slip ? survey.slips : survey.speeds)));
    }
    if (appearance.plot) {
        PlotStyle plot{.from = start,
                       .to = std::max(end, start + 1e-6),
                       .lowest = 0.0,
                       .highest = 1.0,
                       .type = 10.0};
        fit_range(plot, curves);
        // A disc alone has no rotation about itself but its spin.
        plot.vertical_label = survey.single_disc ? "$ω$/$Ω$" : "$ϖ_{rigid}$/$Ω$";
        spec.plot = plot;
    }
    return Sheet(spec);
}

double turns_until(const Curve& curve, double start, double now) {
    double turns = 0.0, last = start;
    for (std::size_t k = 0; k < curve.time.size() && last < now; ++k) {
        // Each sample stands for the time since the one before it.
        if (curve.time[k] <= start) continue;
        const double next = std::min(curve.time[k], now);
        if (std::isfinite(curve.raw[k])) turns += (next - last) * curve.raw[k];
        last = next;
    }
    return turns;
}

MovieResult make_movie(const MovieConfig& config, const MovieControl& control) try {
    const auto stopped = [&] { return control.stop && control.stop->load(); };
    std::vector<Curve> curves;
    const Sheet sheet = make_sheet(config.sources, config.appearance, config.start,
                                   time_of_frame(config, config.frames - 1), curves);
    const std::optional<MovieFormat> format = movie_format(config.out);
    std::unique_ptr<MovieWriter> movie;
    if (format)
        movie = std::make_unique<MovieWriter>(config.out, *format, config.appearance.size,
                                              config.frames_per_second);
    if (!config.frames_folder.empty()) {
        make_folder(config.frames_folder);
        remove_leftovers(config.frames_folder);
    }

    const unsigned count = std::max(1u, std::thread::hardware_concurrency());
    std::vector<std::unique_ptr<Easel>> easels(count);
    std::atomic<int> delivered = 0;
    MovieResult result;
    {
        Painters painters(count, [&](const Painters::Bytes& bytes) {
            if (movie) movie->write(bytes);
            ++delivered;
        });
        std::vector<Camera> cameras;
        for (const FrameSource& source : config.sources)
            cameras.emplace_back(source, config.appearance, config.start);
        int frame = 0;
        for (; frame < config.frames && !stopped(); ++frame) {
            auto instant = std::make_shared<Instant>();
            instant->periods = time_of_frame(config, frame);
            try {
                for (Camera& camera : cameras) camera.advance_to(instant->periods);
            } catch (const Interrupted&) {
                break;
            }
            for (Camera& camera : cameras) {
                instant->now.push_back(camera.now());
                instant->past.push_back(camera.past());
                instant->pinned.push_back(camera.pinned());
                instant->backdrop.push_back(camera.backdrop());
            }
            painters.submit([&, instant, frame](unsigned painter, Painters::Bytes& bytes) {
                auto& easel = easels[painter];
                if (!easel) easel = std::make_unique<Easel>(sheet);
                Canvas& canvas = easel->paint(sheet, config, curves, *instant);
                if (!config.frames_folder.empty()) {
                    // A disk that is waited for at each would take most of the time.
                    AtomicFile picture(frame_name(config.frames_folder, frame + 1));
                    picture.append(canvas.png());
                    picture.empty_buffer();
                    picture.give_name();
                }
                if (!format) return;
                if (*format == MovieFormat::gif) {
                    const auto pixels = canvas.pixels();
                    bytes.assign(pixels.begin(), pixels.end());
                } else {
                    to_planar(canvas.pixels(), config.appearance.size, bytes);
                }
            });
            if (control.progress) control.progress(delivered.load(), config.frames);
        }
        painters.finish();
        result.frames = frame;
        result.complete = frame == config.frames;
    }
    if (result.frames == 0) return result;
    if (movie) movie->finish();
    if (control.progress) control.progress(result.frames, config.frames);
    return result;
} catch (const DrawFailure& failure) {
    throw Failure(failure.what());
}

}  // namespace swirl
