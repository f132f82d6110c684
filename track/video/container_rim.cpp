#include "track/video/container_rim.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "swirl/math/unit_circle.hpp"
#include "swirl/run/failure.hpp"
#include "track/video/container_path_fit.hpp"
#include "track/video/robust_statistics.hpp"

namespace swirl::tracking {

namespace {

constexpr double min_rim_support = 0.2;   // share of the circumference
constexpr double rim_noise_factor = 3.0;  // least slope of the rim, in standard deviations of noise

double rim_window(const PreparedFrame& frame, double small_pixels) {
    constexpr double minimum = 3.0;  // pixels: covers the blur of the edge
    return std::max(minimum, small_pixels / frame.shrink);
}

struct RimCandidate {
    double radius;  // radius in the small frames
    Polarity polarity;
    double support;             // the sum over a sample of the frames
    std::vector<Vec2> centres;  // centres in all frames where it was fitted
    std::vector<double> radii;  // radii of these fits; votes are as coarse as the small frame
    PathCircle path;            // path through the centres

    /// Largest distance of a centre from the first one.
    double reach() const {
        double reach = 0.0;
        for (const Vec2& c : centres) reach = std::max(reach, length(c - centres.front()));
        return reach;
    }
};

class RimSurvey {
  public:
    explicit RimSurvey(const std::vector<PreparedFrame>& frames)
        : frames_(frames),
          size_(frames.front().small.size()),
          shrink_(frames.front().shrink),
          stride_(std::max<std::size_t>(1, frames.size() / sample_size)),
          sampled_(std::ceil(double(frames.size()) / double(stride_))) {}

    /// `shaken`: a rough path is better than none.
    std::optional<ContainerRim> run(bool shaken) {
        const std::vector<RimCandidate> candidates = fitted_candidates();
        const RimCandidate* moving = nullptr;
        double best_score = 0.0;
        for (const double max_scatter : {steady_scatter, shaken_scatter}) {
            if (moving || (!shaken && max_scatter == shaken_scatter)) break;
            for (const RimCandidate& c : candidates) {
                if (c.centres.size() < min_centres || !moves(c, max_scatter)) continue;
                if (score(c) > best_score) best_score = score(c), moving = &c;
            }
        }
        if (!moving) return std::nullopt;
        ContainerRim rim = rim_of(*moving);
        rim.rough = !moves(*moving, steady_scatter);
        rim.path_centre = moving->path.centre;
        rim.amplitude = moving->path.radius;
        return rim;
    }
    /// The best circle whose centre moves in most frames. Circles of noise move, too, but have less
    /// support.
    std::optional<ContainerRim> run_on_any_path() {
        constexpr double min_share = 0.5;  // share of the frames
        const std::vector<RimCandidate> candidates = fitted_candidates();
        const RimCandidate* moving = nullptr;
        for (const RimCandidate& c : candidates)
            if (double(c.centres.size()) >= min_share * double(frames_.size()) &&
                c.reach() > still_reach && (!moving || score(c) > score(*moving)))
                moving = &c;
        if (!moving) return std::nullopt;
        ContainerRim rim = rim_of(*moving);
        rim.path_centre = median_point(moving->centres);
        return rim;
    }
    /// After run() without a result: reports why.
    [[noreturn]] void throw_not_moving() const {
        constexpr double still_scatter = 1.0;  // pixels: errors of a still rim
        constexpr double shown_reach = 0.1;    // pixels: as it is printed
        constexpr std::size_t min_frames = 8;  // fewer show no path
        constexpr double min_seen = 0.7;       // share of the frames
        const RimCandidate& best = largest_;
        const double reach = best.reach();
        if (best.centres.size() >= min_centres && best.path.scatter < still_scatter &&
            reach < still_reach)
            throw Failure(fmt::format(
                "no dish was found: the clearest circle stands still, within {:.1f} pixels\n"
                "hint: if it is the dish, fix the camera to the floor, and swirl the dish",
                std::max(reach, shown_reach)));
        const std::string circle =
            fmt::format("the largest circle in the frames, with a radius of about {:.0f} pixels,",
                        best.radius / shrink_);
        if (frames_.size() < min_frames)
            throw Failure(
                fmt::format("the video has {} frames, too few to show that a container moves\n"
                            "hint: record at least half a period, and at least 16 frames in it",
                            frames_.size()));
        if (double(best.centres.size()) < min_seen * double(frames_.size()))
            throw Failure(fmt::format(
                "{} is seen in only {} of {} frames: something covers it, or it leaves the frame\n"
                "hint: keep the whole rim in the frame; --first-frame and --last-frame limit the "
                "video to frames that show it",
                circle, best.centres.size(), frames_.size()));
        throw Failure(
            fmt::format("{} does not move along a circle, as a swirled container does: "
                        "its centre is {:.1f} pixels off the circle that fits best, "
                        "whose radius is {:.1f} pixels\n{}",
                        circle, best.path.scatter, best.path.radius, no_circle_hint));
    }

  private:
    static constexpr std::size_t sample_size = 16;  // frames that vote; twice as many at most
    static constexpr std::size_t min_centres = 4;   // three always lie on a circle
    // Scatter of the centres about their path, of its radius: for a camera at rest, and at most.
    static constexpr double steady_scatter = 0.1, shaken_scatter = 0.25;
    static constexpr std::size_t max_candidates = 8;  // the container is among the best ones
    static constexpr double still_reach = 3.0;        // pixels: errors of a still rim

    std::vector<RimCandidate> fitted_candidates() {
        std::vector<RimCandidate> candidates = distinct(candidates_by_votes());
        for (RimCandidate& c : candidates) {
            fit_in_all_frames(c);
            if (c.centres.size() >= min_centres) c.path = circle_through(c.centres);
        }
        largest_ = candidates.front();
        return candidates;
    }

    double score(const RimCandidate& c) const {
        return c.support * double(c.centres.size()) / double(frames_.size());
    }

    ContainerRim rim_of(const RimCandidate& c) const {
        ContainerRim rim;
        rim.polarity = c.polarity;
        rim.support = c.support / sampled_;
        rim.radius = median(c.radii);
        rim.second_container = second_container(rim);
        return rim;
    }

    /// All radii and polarities, best first.
    std::vector<RimCandidate> candidates_by_votes() const {
        constexpr double min_radius = 0.1,
                         max_radius = 0.56;  // share of the shorter side of the frame
        constexpr double step = 1.0;         // pixels of the small frame, the resolution of votes
        constexpr double min_support = 0.1;  // less is noise
        const double side = std::min(size_.width, size_.height);
        std::vector<RimCandidate> all;
        for (const Polarity polarity : {1, -1})
            for (double radius = min_radius * side; radius < max_radius * side; radius += step) {
                RimCandidate candidate{radius, polarity, 0.0, {}, {}, {}};
                for (std::size_t k = 0; k < frames_.size(); k += stride_) {
                    const auto best =
                        vote(frames_[k].edges, size_, radius, polarity, min_support, 1);
                    if (!best.empty()) candidate.support += best.front().support;
                }
                all.push_back(std::move(candidate));
            }
        std::sort(all.begin(), all.end(), [](const RimCandidate& a, const RimCandidate& b) {
            return a.support > b.support;
        });
        if (all.front().support < min_rim_support * sampled_)
            throw Failure(
                "no dish was found: hardly any frame shows a large circle\n"
                "hint: keep the whole rim in the frame, and let it stand out from the table or "
                "from the floor of the container");
        return all;
    }

    /// The best candidates that differ from each other.
    static std::vector<RimCandidate> distinct(const std::vector<RimCandidate>& all) {
        constexpr double min_share = 0.45;   // share of the best candidate's support
        constexpr double same_radius = 3.5;  // pixels: the width of a maximum of the votes
        std::vector<RimCandidate> result;
        for (const RimCandidate& c : all) {
            if (result.size() == max_candidates || c.support < min_share * all.front().support)
                break;
            const bool again = std::any_of(result.begin(), result.end(), [&](const auto& d) {
                return d.polarity == c.polarity && std::abs(d.radius - c.radius) < same_radius;
            });
            if (!again) result.push_back(c);
        }
        return result;
    }

    void fit_in_all_frames(RimCandidate& candidate) const {
        constexpr double min_support = 0.12;  // share of votes: a rim may be partly hidden
        constexpr int rays = 180;             // one each two degrees is enough for a survey
        constexpr double window = 1.8;        // pixels of the small frame: the error of a vote
        for (const PreparedFrame& frame : frames_) {
            const auto best =
                vote(frame.edges, size_, candidate.radius, candidate.polarity, min_support, 1);
            if (best.empty()) continue;
            RaySettings settings;
            settings.rays = rays;
            settings.window = rim_window(frame, window);
            settings.minimum = rim_noise_factor * frame.noise;
            settings.free_radius = true;
            const CircleFit fit =
                fit_circle(frame.sharp, frame.to_sharp(best.front().centre),
                           candidate.radius / frame.shrink, candidate.polarity, settings);
            if (!fit.good || fit.support < min_rim_support) continue;
            candidate.centres.push_back(fit.centre);
            candidate.radii.push_back(fit.radius);
        }
    }

    /// True if the centres go round a circle. They must cover a part of it, since a short arc fits
    /// many circles.
    bool moves(const RimCandidate& c, double max_scatter) const {
        constexpr double min_reach = 0.7;        // share of the path's radius: an arc of 40 degrees
        constexpr double scatter_allowed = 1.0;  // pixels
        constexpr double max_amplitude = 1.5;    // multiple of the container's radius
        return c.path.radius > min_path_amplitude && c.reach() > min_reach * c.path.radius &&
               c.path.scatter < std::max(scatter_allowed, max_scatter * c.path.radius) &&
               c.path.radius < max_amplitude * c.radius / shrink_;
    }

    /// True if most frames show another circle of the rim's size next to it.
    bool second_container(const ContainerRim& rim) const {
        constexpr std::size_t max_circles = 6;
        constexpr double min_distance = 1.7;  // radii: two containers do not overlap
        constexpr double min_share = 0.6;     // share of the first one's support; of the frames
        const double radius = rim.radius * shrink_;
        std::size_t pairs = 0;
        for (std::size_t k = 0; k < frames_.size(); k += stride_) {
            const auto best = vote(frames_[k].edges, size_, radius, rim.polarity, 0.0, max_circles);
            if (best.empty()) continue;
            if (std::any_of(best.begin() + 1, best.end(), [&](const CircleCandidate& c) {
                    return length(c.centre - best[0].centre) >
                               min_distance * rim.radius * shrink_ &&
                           c.support > min_share * best[0].support;
                }))
                ++pairs;
        }
        return double(pairs) > min_share * sampled_;
    }

    const std::vector<PreparedFrame>& frames_;
    cv::Size size_;
    double shrink_;
    std::size_t stride_;
    double sampled_;  // number of frames that vote
    RimCandidate largest_{};
};

CircleFit fit_rim(const PreparedFrame& frame, const ContainerRim& rim, const Vec2& centre,
                  double radius) {
    constexpr int rays = 360;
    constexpr double tolerance = 1.5;     // pixels: an edge this close supports the rim
    constexpr double small_window = 1.5;  // pixels of the small frame: the error of a vote
    const double window = rim_window(frame, small_window), minimum = rim_noise_factor * frame.noise;
    if (rim.lens) {
        const Lens::Circle circle{rim.lens->ideal(Lens::Circle{centre, radius}).centre, rim.radius};
        const Vec2 middle = rim.lens->ideal(Lens::Circle{rim.path_centre, radius}).centre;
        return fit_outline(frame.sharp, rim.lens->in_frame(centre, circle.centre - middle), circle,
                           {rim.polarity, window, minimum});
    }
    RaySettings settings;
    settings.rays = rays;
    settings.window = window;
    settings.minimum = minimum;
    settings.tolerance = tolerance;
    return fit_circle(frame.sharp, centre, radius, rim.polarity, settings);
}

constexpr int outline_rays = 360;

/// The steepest point on the line through `at` along `u`; `profile` is memory for the samples.
std::optional<Vec2> steepest_point(const cv::Mat& image, const Vec2& at, const Vec2& u,
                                   const OutlineSettings& settings, std::vector<float>& profile) {
    constexpr double spacing = 0.5;  // spacing between samples, pixels
    const int reach = static_cast<int>(std::ceil(settings.window / spacing)) + 2;
    const auto inside = [&](const Vec2& p) {
        return p.x >= 0.0 && p.y >= 0.0 && p.x < image.cols - 1 && p.y < image.rows - 1;
    };
    if (!inside(at - reach * spacing * u) || !inside(at + reach * spacing * u)) return {};
    profile.clear();
    for (int j = -reach; j <= reach; ++j)
        profile.push_back(level_at(image, at + (spacing * j) * u));
    const auto slope = [&](std::size_t j) {
        return -0.5 * settings.polarity * double(profile[j + 2] - profile[j - 2]);
    };
    std::size_t best = 0;
    double maximum = settings.minimum;
    for (std::size_t j = 2; j + 2 < profile.size(); ++j)
        if (slope(j) > maximum) maximum = slope(j), best = j;
    if (best < 3 || best + 3 >= profile.size()) return {};
    const double shift = vertex_offset(slope(best - 1), maximum, slope(best + 1));
    return at + (spacing * (double(best) - reach + std::clamp(shift, -1.0, 1.0))) * u;
}

}  // namespace

ContainerRim survey_container_rim(const std::vector<PreparedFrame>& frames) {
    RimSurvey survey(frames);
    const std::optional<ContainerRim> rim = survey.run(false);
    if (!rim) survey.throw_not_moving();
    return *rim;
}

std::optional<ContainerRim> find_moving_rim(const std::vector<PreparedFrame>& frames, bool shaken) {
    return RimSurvey(frames).run(shaken);
}

ContainerRim find_rim_on_any_path(const std::vector<PreparedFrame>& frames) {
    RimSurvey survey(frames);
    const std::optional<ContainerRim> rim = survey.run_on_any_path();
    if (!rim) survey.throw_not_moving();
    return *rim;
}

CircleFit find_container_rim(const PreparedFrame& frame, const ContainerRim& rim) {
    constexpr double min_votes = 0.08;  // share of the circumference: most of a rim may be hidden
    constexpr std::size_t max_circles = 6;
    // How far from the path a rim may be: pixels of the small frame, and a share of the amplitude.
    constexpr double off_path = 6.0, off_path_share = 0.35;
    constexpr double min_found = 0.5;  // share of the support that the survey requires
    double radius = rim.radius;
    if (rim.lens) radius = rim.lens->image({rim.lens->ideal(rim.path_centre), rim.radius}).radius;
    CircleFit best{rim.path_centre, radius};
    for (const CircleCandidate& c : vote(frame.edges, frame.small.size(), radius * frame.shrink,
                                         rim.polarity, min_votes, max_circles)) {
        const Vec2 centre = frame.to_sharp(c.centre);
        const double off = length(centre - rim.path_centre) - rim.amplitude;
        if (rim.amplitude > 0.0 &&
            std::abs(off) > off_path / frame.shrink + off_path_share * rim.amplitude)
            continue;
        const CircleFit fit = fit_rim(frame, rim, centre, radius);
        if (fit.good && fit.support > best.support) best = fit;
    }
    if (best.support < min_found * min_rim_support) best.good = false;
    return best;
}

std::vector<Vec2> outline_edge(const cv::Mat& image, const Lens& lens, const Lens::Circle& circle,
                               const OutlineSettings& settings) {
    std::vector<Vec2> edge;
    std::vector<float> profile;
    for (int k = 0; k < outline_rays; ++k) {
        const Vec2 u = unit_circle(double(k) / outline_rays);
        if (const auto p = steepest_point(image, lens.seen(circle.centre + circle.radius * u), u,
                                          settings, profile))
            edge.push_back(*p);
    }
    return edge;
}

CircleFit fit_outline(const cv::Mat& image, const Lens& lens, Lens::Circle circle,
                      const OutlineSettings& settings) {
    constexpr int rounds = 3, passes = 6;  // rounds of edge search; passes of reweighting in each
    constexpr std::size_t min_edge = outline_rays / 10;
    constexpr double tolerance = 1.5;  // an edge this close supports the circle, pixels
    constexpr double cutoff = 3.0, min_scale = 0.15;  // standard deviations; pixels
    constexpr double regularisation = 1e-9;           // keeps the matrix invertible without edges
    CircleFit fit{circle.centre, circle.radius};
    std::vector<double> off;
    double scale = settings.window;
    for (int round = 0; round < rounds; ++round) {
        const std::vector<Vec2> edge = outline_edge(image, lens, circle, settings);
        if (edge.size() < min_edge) return fit;
        for (int pass = 0; pass < passes; ++pass) {
            cv::Matx22d normal = regularisation * cv::Matx22d::eye();
            cv::Vec2d right(0.0, 0.0);
            off.clear();
            double square = 0.0;
            std::size_t on = 0;
            for (const Vec2& seen : edge) {
                const Vec2 d = lens.ideal(seen) - circle.centre;
                const double distance = length(d), residual = distance - circle.radius;
                off.push_back(std::abs(residual));
                if (std::abs(residual) < tolerance) square += residual * residual, ++on;
                const double w = tukey_weight(residual / (cutoff * scale));
                if (w == 0.0) continue;
                const cv::Vec2d row(d.x / distance, d.y / distance);
                normal += w * (row * row.t());
                right += w * residual * row;
            }
            const cv::Matx22d inverse = normal.inv();
            const cv::Vec2d moved = inverse * right;
            circle.centre = circle.centre + Vec2{moved[0], moved[1]};
            scale = std::clamp(mad_to_sigma * median(off), min_scale, settings.window);
            fit.support = double(on) / outline_rays;
            fit.residual = on > 2 ? std::sqrt(square / double(on - 2)) : 0.0;
            fit.error = fit.residual * std::sqrt(0.5 * (inverse(0, 0) + inverse(1, 1)));
        }
    }
    const Lens::Circle image_circle = lens.in_frame({}, {}).image(circle);
    fit.centre = image_circle.centre;
    fit.radius = image_circle.radius;
    fit.good = true;
    return fit;
}

}  // namespace swirl::tracking
