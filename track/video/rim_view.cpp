#include "track/video/rim_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "swirl/math/median.hpp"
#include "swirl/math/unit_circle.hpp"
#include "track/video/robust_statistics.hpp"

namespace swirl::tracking {

namespace {

constexpr std::size_t rays = 180;

/// An edge on a ray.
struct OutlineEdge {
    double distance = 0.0;  // from the circle's centre
    double slope = 0.0;     // grey levels per pixel
};

bool is_in_frame(const cv::Mat& image, const Vec2& p) {
    return p.x >= 0.0 && p.y >= 0.0 && p.x < image.cols - 1 && p.y < image.rows - 1;
}

/// The edges of the rim's polarity between two distances from the centre.
std::vector<OutlineEdge> edges_on_ray(const PreparedFrame& frame, const CircleFit& rim,
                                      Polarity polarity, const Vec2& u, double from, double to) {
    constexpr double step = 0.5, half = 1.0;  // pixels: of the ray, and of a slope
    constexpr double noise_factor = 3.0;
    std::vector<OutlineEdge> edges;
    OutlineEdge before, here;
    for (double r = from; r < to; r += step) {
        const Vec2 inner = rim.centre + (r - half) * u, outer = rim.centre + (r + half) * u;
        OutlineEdge next{r, 0.0};
        if (is_in_frame(frame.sharp, inner) && is_in_frame(frame.sharp, outer))
            next.slope =
                polarity *
                (double(level_at(frame.sharp, inner)) - double(level_at(frame.sharp, outer))) /
                (2.0 * half);
        if (here.slope > noise_factor * frame.noise && here.slope > before.slope &&
            here.slope >= next.slope)
            edges.push_back(here);
        before = here;
        here = next;
    }
    return edges;
}

/// The distance at which most frames have an edge: those of discs are at one distance in few.
std::optional<double> lasting_edge(std::vector<double> distances, std::size_t frames) {
    constexpr double width = 4.0;      // pixels: errors of the circle's centre
    constexpr double min_share = 0.6;  // of the frames
    std::sort(distances.begin(), distances.end());
    std::size_t most = 0;
    double at = 0.0;
    for (std::size_t k = 0, end = 0; k < distances.size(); ++k) {
        while (end < distances.size() && distances[end] < distances[k] + width) ++end;
        if (end - k <= most) continue;
        most = end - k;
        at = distances[(k + end - 1) / 2];
    }
    if (double(most) < min_share * double(frames)) return std::nullopt;
    return at;
}

using Harmonics = cv::Vec<double, 5>;  // of the distance: mean, shift, and ellipse

Harmonics harmonics_at(const Vec2& u) {
    return {1.0, u.x, u.y, u.x * u.x - u.y * u.y, 2.0 * u.x * u.y};
}

/// The outline of the rim. `whole`: enough of it is seen to know its shape.
struct Outline {
    Harmonics shape;
    bool whole = false;
};

/// The outline through the lasting edges on all rays, by reweighted least squares.
Outline outline_of(const std::vector<std::vector<double>>& distances, std::size_t frames,
                   double radius) {
    constexpr int passes = 10;
    constexpr double cutoff = 4.0, min_scale = 0.5;  // standard deviations; pixels
    constexpr double min_rays = 0.7;                 // share
    Outline outline{{radius, 0.0, 0.0, 0.0, 0.0}};
    std::vector<std::pair<Harmonics, double>> edges;
    for (std::size_t k = 0; k < rays; ++k)
        if (const auto at = lasting_edge(distances[k], frames))
            edges.emplace_back(harmonics_at(unit_circle(double(k) / rays)), *at);
    if (double(edges.size()) < min_rays * double(rays)) return outline;
    double scale = 0.2 * radius;
    std::size_t near = 0;
    for (int pass = 0; pass < passes; ++pass) {
        auto normal = 1e-9 * cv::Matx<double, 5, 5>::eye();
        Harmonics right = Harmonics::all(0.0);
        std::vector<double> off;
        near = 0;
        for (const auto& [row, at] : edges) {
            const double residual = at - row.dot(outline.shape);
            off.push_back(std::abs(residual));
            const double weight = tukey_weight(residual / (cutoff * scale));
            near += weight > 0.0;
            normal += weight * (row * row.t());
            right += weight * residual * row;
        }
        outline.shape += normal.inv() * right;
        scale = std::max(mad_to_sigma * median(off), min_scale);
    }
    outline.whole = double(near) >= min_rays * double(rays);
    return outline;
}

/// What one frame shows on the outline.
struct OutlineSeen {
    double outside = 0.0, hidden = 0.0;  // shares of the rays; of those in the frame
    std::vector<double> across, along;   // slopes of edges across the motion, and along it
};

OutlineSeen seen_on(const Harmonics& outline, const PreparedFrame& frame, const CircleFit& rim,
                    const ContainerRim& known) {
    constexpr double tolerance = 3.0, tolerance_share = 0.03;  // pixels; of the radius
    constexpr double is_across = 0.87, is_along = 0.5;         // cosines of the angle to the motion
    constexpr double min_amplitude = 2.0;                      // pixels
    const Vec2 arm = rim.centre - known.path_centre;
    const double reach = std::max(tolerance, tolerance_share * rim.radius);
    OutlineSeen seen;
    double in_frame = 0.0, on = 0.0;
    for (std::size_t k = 0; k < rays; ++k) {
        const Vec2 u = unit_circle(double(k) / rays);
        const double radius = harmonics_at(u).dot(outline);
        if (!is_in_frame(frame.sharp, rim.centre + radius * u)) continue;
        in_frame += 1.0;
        const auto edges =
            edges_on_ray(frame, rim, known.polarity, u, radius - reach, radius + reach);
        if (edges.empty()) continue;
        on += 1.0;
        if (length(arm) < min_amplitude) continue;
        const double cosine = std::abs(cross(arm, u)) / length(arm);
        double steepest = 0.0;
        for (const OutlineEdge& edge : edges) steepest = std::max(steepest, edge.slope);
        if (cosine > is_across) seen.across.push_back(steepest);
        if (cosine < is_along) seen.along.push_back(steepest);
    }
    seen.outside = 1.0 - in_frame / double(rays);
    seen.hidden = 1.0 - on / std::max(in_frame, 1.0);
    return seen;
}

}  // namespace

RimView view_of_rim(const std::vector<PreparedFrame>& frames, const ContainerRim& known) {
    constexpr double reach = 0.3;  // of the radius: an ellipse is that far from its circle
    std::vector<CircleFit> rims;
    std::size_t good = 0;
    std::vector<std::vector<double>> distances(rays);
    for (const PreparedFrame& frame : frames) {
        rims.push_back(find_container_rim(frame, known));
        const CircleFit& rim = rims.back();
        if (!rim.good) continue;
        ++good;
        for (std::size_t k = 0; k < rays; ++k)
            for (const OutlineEdge& edge :
                 edges_on_ray(frame, rim, known.polarity, unit_circle(double(k) / rays),
                              (1.0 - reach) * rim.radius, (1.0 + reach) * rim.radius))
                distances[k].push_back(edge.distance);
    }
    const Outline outline = outline_of(distances, good, known.radius);
    RimView view;
    if (outline.whole) {
        const double ellipse = std::hypot(outline.shape[3], outline.shape[4]) / outline.shape[0];
        view.axes = (1.0 - ellipse) / (1.0 + ellipse);
    }
    std::vector<double> outside, hidden, across, along;
    for (std::size_t n = 0; n < frames.size(); ++n) {
        if (!rims[n].good) continue;
        const OutlineSeen seen = seen_on(outline.shape, frames[n], rims[n], known);
        outside.push_back(seen.outside);
        hidden.push_back(seen.hidden);
        across.insert(across.end(), seen.across.begin(), seen.across.end());
        along.insert(along.end(), seen.along.begin(), seen.along.end());
    }
    if (outside.empty()) return view;
    for (const double share : outside) view.outside += share / double(outside.size());
    view.hidden = median(hidden);
    if (!across.empty() && !along.empty())
        view.smear = median(along) / std::max(median(across), 1e-9);
    return view;
}

std::optional<PoorView> poor_view(const RimView& view) {
    // Beyond these values videos were tracked wrongly or not at all; half of each does no harm.
    constexpr double max_inclination = 25.0;  // degrees
    constexpr double max_outside = 0.2, max_hidden = 0.3, max_smear = 1.5;
    const double inclination = std::acos(std::clamp(view.axes, 0.0, 1.0)) * 180.0 / pi;
    struct Excess {
        double factor;
        PoorView poor;
    };
    const std::array<Excess, 4> excesses{{
        {inclination / max_inclination,
         {fmt::format("the camera is inclined by about {:.0f} degrees, as the axes of the rim's "
                      "outline have a ratio of {:.2f}",
                      inclination, view.axes),
          "hold the camera above the container; 10 degrees do no harm"}},
        {view.outside / max_outside,
         {fmt::format("{:.0f} % of the container's rim lies outside the frame",
                      100.0 * view.outside),
          "record the whole container; a tenth of the rim outside does no harm"}},
        {view.hidden / max_hidden,
         {fmt::format("{:.0f} % of the container's rim shows no edge, because something covers it "
                      "or it is as bright as its surroundings",
                      100.0 * view.hidden),
          "take away what covers the container, or use a rim that is brighter or darker than "
          "the floor; a hand that comes and goes does no harm"}},
        {(view.smear - 1.0) / (max_smear - 1.0),
         {fmt::format("the motion blurs the frames: edges across it are {:.1f} times as wide as "
                      "edges along it",
                      view.smear),
          "use more light and a shorter exposure, or swirl more slowly"}},
    }};
    const auto worst =
        std::max_element(excesses.begin(), excesses.end(),
                         [](const Excess& a, const Excess& b) { return a.factor < b.factor; });
    if (worst->factor < 1.0) return std::nullopt;
    return worst->poor;
}

std::string with_cause(const std::string& message, const PoorView& poor) {
    return fmt::format("{}. Therefore: {}\nhint: {}", poor.cause,
                       message.substr(0, message.find('\n')), poor.hint);
}

}  // namespace swirl::tracking
