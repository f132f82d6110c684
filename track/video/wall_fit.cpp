// The wall, from the positions at which it stops discs.
//
// Seen from the rim's centre, discs at the wall lie on a circle. Two causes displace it. Light from
// one side shifts all positions towards the side that stands out, in proportion to the radius. And
// the rim is seen at an angle, or a part of it is mistaken for the wall's outer edge.
//
// With u the distance of a disc's centre from the rim's, n its direction, and C the direction of
// the path's centre to the rim's, the gap between the disc and the wall is
//
//     gap = reach + shift·n − excess C·n − u
//
// where `excess` is by how much the amplitude of a rim nearer to the camera is too large. Gaps are
// distributed as those between discs in contact (contact_distance.hpp), with a steep onset.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "track/video/contact_distance.hpp"
#include "track/video/robust_statistics.hpp"
#include "track/video/tracking_steps.hpp"

namespace swirl::tracking {

namespace {

constexpr double stands_out = 4.0;  // standard errors

/// A disc that may be at the wall.
struct WallRow {
    cv::Vec4d factors;  // of reach, shift and excess
    double distance;    // from the rim's centre
    std::size_t frame;
    std::int64_t disc;
    double widest = 0.0;  // gap that is just used
};

struct WallFit {
    cv::Vec4d value{};  // reach, shift and excess
    cv::Matx44d covariance;
    bool displaced = false;  // from the rim, and not only by a shift that light explains
};

/// Where the wall is, and how the gaps to it are distributed; in radii.
struct WallModel {
    cv::Vec4d value{};
    double error = 0.1, decay = 0.5, share = 0.9;
    static constexpr double inner = 1.5, outer = 0.5;  // range of gaps; a second layer is beyond
    static constexpr double wrong = 0.02;  // share of the positions: no disc is in the wall
    double gap(const WallRow& row) const { return row.factors.dot(value) - row.distance; }
    /// `moved`: of the wall outwards.
    double log_density(const WallRow& row, double moved = 0.0) const {
        const double here = gap(row) + moved, widest = row.widest + here;
        const double near = normal_and_exponential(here, error, decay) /
                            (1.0 - std::exp(-std::max(widest, 0.1) / decay));
        const double far = 0.5 * std::erfc(-here / (std::sqrt(2.0) * error)) / inner;
        return std::log((1.0 - wrong) * (share * near + (1.0 - share) * far) +
                        wrong / (inner + outer));
    }
    bool allowed(double least_error) const {
        return error >= least_error && error <= 0.2 && decay >= 0.1 && decay <= 3.0 &&
               share >= 0.05 && share <= 1.0;
    }
};

/// The covariance from the slopes of the likelihood. A disc stays at the wall for several frames,
/// whose errors are correlated: they count as one visit. None if there are too few.
std::optional<cv::Matx44d> covariance_of(const std::vector<WallRow>& rows, const WallModel& model,
                                         std::size_t every) {
    constexpr double step = 1e-3, at_wall = 0.15;  // radii
    constexpr std::size_t min_visits = 12;         // for three or four unknowns
    struct Visit {
        std::size_t last;
        bool touches = false;
        cv::Vec4d slope{};
    };
    cv::Matx44d information = cv::Matx44d::zeros(), scatter = information;
    std::size_t touching = 0;
    const auto finish = [&](const Visit& visit) {
        scatter += visit.slope * visit.slope.t();
        touching += visit.touches;
    };
    std::map<std::int64_t, Visit> visits;
    for (const WallRow& row : rows) {
        const double change = model.log_density(row, step) - model.log_density(row, -step);
        const double slope = change / (2.0 * step);
        information += slope * slope * (row.factors * row.factors.t());
        Visit& visit = visits.try_emplace(row.disc, Visit{row.frame}).first->second;
        if (row.frame > visit.last + every) finish(std::exchange(visit, {}));
        visit.last = row.frame;
        visit.slope += slope * row.factors;
        visit.touches = visit.touches || std::abs(model.gap(row)) < at_wall;
    }
    for (const auto& [disc, visit] : visits) finish(visit);
    if (touching < min_visits) return std::nullopt;
    if (information(3, 3) == 0.0) information(3, 3) = 1.0;  // an unused term is zero
    const cv::Matx44d inverse = information.inv(cv::DECOMP_SVD);
    const cv::Matx44d spread =
        double(touching) / double(touching - 4) * inverse * scatter * inverse;
    // Few visits may agree by chance: never less than the error of independent positions. As the
    // onset is not smooth, squared errors are twice these values in 20 simulated videos.
    const double ratio = (spread(1, 1) + spread(2, 2)) / (inverse(1, 1) + inverse(2, 2));
    return 2.0 * std::max(1.0, ratio) * inverse;
}

/// The logarithm.
double likelihood_of_wall(const std::vector<WallRow>& rows, const WallModel& model) {
    double sum = 0.0;
    for (const WallRow& row : rows) sum += model.log_density(row);
    return sum;
}

/// Makes `model` the most likely one. `displaced`: it may be displaced from the rim.
void make_likely(const std::vector<WallRow>& rows, double least_error, bool displaced,
                 WallModel& model) {
    const double step = displaced ? 0.05 : 0.0;
    const double step_of_excess = rows.front().factors[3] == 0.0 ? 0.0 : step;
    auto& v = model.value;
    maximise<7>({&v[0], &v[1], &v[2], &model.error, &model.decay, &model.share, &v[3]},
                {0.05, step, step, 0.02, 0.1, 0.1, step_of_excess}, 0.0005, [&] {
                    return model.allowed(least_error) ? likelihood_of_wall(rows, model) : -1e300;
                });
}

/// The most likely wall that is concentric with the rim.
WallModel concentric_wall(const std::vector<WallRow>& rows, double least_error,
                          const WallModel& displaced) {
    constexpr double farthest = 1.0;    // radii
    constexpr double step = 0.25;       // there are local maxima,
    constexpr double wide_error = 0.1;  // fewer with a soft onset
    WallModel best;
    double highest = -1e300;
    for (double farther = -farthest; farther < farthest + 0.5 * step; farther += step) {
        WallModel model = displaced;
        model.value = {displaced.value[0] + farther, 0.0, 0.0, 0.0};
        model.error = wide_error;
        make_likely(rows, least_error, false, model);
        const double here = likelihood_of_wall(rows, model);
        if (here <= highest) continue;
        highest = here;
        best = model;
    }
    return best;
}

/// How often a disc comes to the wall. Positions of one visit are not independent.
std::size_t count_visits(const std::vector<WallRow>& rows, std::size_t every) {
    std::map<std::int64_t, std::size_t> last;
    std::size_t visits = 0;
    for (const WallRow& row : rows) {
        const auto [seen, is_first] = last.try_emplace(row.disc, row.frame);
        if (is_first || row.frame > seen->second + every) ++visits;
        seen->second = row.frame;
    }
    return visits;
}

/// Twice by how much a displaced wall is more likely, from independent visits.
double gain_of_displacement(const std::vector<WallRow>& rows, std::size_t every,
                            const WallModel& displaced, const WallModel& concentric) {
    const double gain = likelihood_of_wall(rows, displaced) - likelihood_of_wall(rows, concentric);
    return 2.0 * gain * double(count_visits(rows, every)) / double(rows.size());
}

/// Few discs may visit one side more often by chance, and then agree with a wall that is far from
/// the rim. The rim is seen in thousands of pixels: a displacement needs more evidence the larger
/// it is.
bool is_displaced(double gain, const WallModel& displaced) {
    constexpr double usual = 0.15;    // radii, of a coordinate: largest shift by light, tilted rim
    constexpr double evidence = 4.0;  // of the gain, beyond the two unknowns
    const double x = displaced.value[1] / usual;
    const double y = displaced.value[2] / usual;
    return gain - x * x - y * y > evidence;
}

/// `rows` in pixels, in the order of the frames.
std::optional<WallFit> fit_wall(std::vector<WallRow> rows, double radius, std::size_t discs) {
    // A sharp onset has many local maxima: the passes sharpen it.
    constexpr std::array least_errors{0.08, 0.04, 0.02, 0.01, 0.01};  // radii
    constexpr std::size_t enough = 4000;                              // positions near the wall
    if (rows.empty()) return std::nullopt;
    std::vector<double> distances;
    for (WallRow& row : rows) distances.push_back(row.distance /= radius);
    // Initial estimate: the outermost disc of every frame is at the wall.
    WallModel model;
    model.value[0] = quantile(distances, 1.0 - 0.5 / double(std::max<std::size_t>(discs, 1)));
    std::vector<WallRow> used;
    std::size_t every = 1;
    for (const double least_error : least_errors) {
        model.error = std::max(model.error, least_error);
        const auto near = [&](const WallRow& row) { return model.gap(row) < WallModel::inner; };
        every = 1 + std::size_t(std::count_if(rows.begin(), rows.end(), near)) / enough;
        used.clear();
        for (WallRow row : rows) {
            if (row.frame % every != 0 || !near(row)) continue;
            row.widest = WallModel::inner - model.gap(row);
            used.push_back(row);
        }
        if (used.empty()) return std::nullopt;
        make_likely(used, least_error, true, model);
    }
    const WallModel concentric = concentric_wall(used, least_errors.back(), model);
    // One unknown gains 1 on average by chance. What gains more may be a shift by light, which the
    // discs' appearance bounds.
    constexpr double by_chance = 1.0;
    const double gain = gain_of_displacement(used, every, model, concentric);
    const bool displaced = is_displaced(gain, model);
    const WallModel& chosen = gain > by_chance ? model : concentric;
    const auto variance = covariance_of(used, chosen, every);
    if (!variance) return {};
    return WallFit{.value = radius * chosen.value,
                   .covariance = radius * radius * *variance,
                   .displaced = displaced};
}

/// The covariance of the shift by what discs look like: along the gradient of the brightness, it
/// grows steeply until the shaded edge is as dark as the floor (0.16 and 0.006 radii at gradients
/// of 0.92 and 0.45; no larger one is known). The direction is unknown for a template, which
/// defines no centre, and for discs of both brightnesses, whose shifts are opposite.
cv::Matx22d expected_shift(const VideoSurvey& survey, bool opposed) {
    constexpr double steepness = 0.2, largest = 0.16;  // radii
    const double any = opposed ? 0.03 : 0.1;           // radii: rms of a coordinate
    if (opposed || survey.appearance.shading) return any * any * cv::Matx22d::eye();
    Vec2 along = steepness * std::pow(length(survey.shading), 3.0) * survey.shading;
    if (length(along) > largest) along = (largest / length(along)) * along;
    return cv::Vec2d(along.x, along.y) * cv::Vec2d(along.x, along.y).t();
}

/// Removes the shift by light from all positions. Returns what is left of the wall's displacement.
Vec2 remove_shading_shift(const VideoSurvey& survey, const std::optional<WallFit>& found,
                          TrackedVideo& tracked) {
    cv::Matx22d left = tracked.radius * tracked.radius * expected_shift(survey, tracked.opposed);
    cv::Vec2d shift, displaced = found ? cv::Vec2d(found->value[1], found->value[2]) : shift;
    // A tilted rim is displaced, too. Dark and bright discs are shifted in opposite directions.
    if (found && !tracked.lens.tilted() && !tracked.opposed) {
        const cv::Matx22d sum = left + found->covariance.get_minor<2, 2>(1, 1);
        // If it is much larger than both allow, the rim is displaced, and not the discs: then it
        // shows nothing about the light. A wall that is not displaced shows that light hardly
        // shifts the discs.
        const double errors = displaced.dot(sum.inv() * displaced);
        if (errors < stands_out * stands_out) {
            const cv::Matx22d gain = left * sum.inv();
            shift = gain * displaced;
            left -= gain * left;
        }
    }
    tracked.shading_shift = {shift[0], shift[1]};
    tracked.shading_shift_error = std::sqrt(std::max(0.0, 0.5 * cv::trace(left)));
    for (TrackFrame& f : tracked.tracks.frames)
        for (std::size_t i = 0; i < f.id.size(); ++i)
            f.position[i] = f.position[i] - (f.radius[i] / tracked.radius) * tracked.shading_shift;
    return {displaced[0] - shift[0], displaced[1] - shift[1]};
}

/// All positions, and those at which discs bounce between two frames.
std::vector<WallRow> wall_rows(const TrackedVideo& tracked) {
    std::vector<WallRow> rows;
    const auto add = [&](std::size_t k, std::int64_t disc, double radius, const Vec2& d) {
        const double distance = length(d), size = radius / tracked.radius;
        if (!(distance > 0.0)) return;
        const Vec2 n = (1.0 / distance) * d;
        const Vec2 out = tracked.container(k) - tracked.path.centre;
        const double nearer = tracked.lens.tilted() ? -dot(out, n) / tracked.path.amplitude : 0.0;
        rows.push_back({{1.0, size * n.x, size * n.y, nearer}, distance + radius, k, disc});
    };
    for (std::size_t k = 0; k < tracked.tracks.frames.size(); ++k) {
        const TrackFrame& f = tracked.tracks.frames[k];
        for (std::size_t i = 0; i < f.id.size(); ++i)
            if (tracked.seen[k][i])
                add(k, f.id[i], f.radius[i], f.position[i] - tracked.container(k));
    }
    for (const Bounce& bounce : find_bounces(tracked))
        add(bounce.frame, bounce.disc, bounce.radius, bounce.from_centre);
    std::stable_sort(rows.begin(), rows.end(),
                     [](const WallRow& a, const WallRow& b) { return a.frame < b.frame; });
    return rows;
}

}  // namespace

void find_wall(const VideoSurvey& survey, TrackedVideo& tracked) {
    constexpr double least_shift = 0.05;  // radii: positions err by about as much
    const auto found =
        fit_wall(wall_rows(tracked), tracked.spacing * tracked.radius, tracked.number);
    const Vec2 residual = remove_shading_shift(survey, found, tracked);
    if (!found) return;
    tracked.contact_at_wall = 1.0 + (tracked.rim_radius - found->value[0]) / tracked.radius;
    const double error = std::sqrt(std::max(found->covariance(1, 1), found->covariance(2, 2))),
                 least = tracked.lens.tilted() ? 0.0 : least_shift * tracked.radius;
    if (!found->displaced || tracked.mixed ||
        length(residual) < std::max(stands_out * error, least))
        return;
    tracked.rim_shift = residual;
    tracked.path.centre = tracked.path.centre + residual;
    tracked.path.centre_error = std::hypot(tracked.path.centre_error, error);
    const double excess = found->value[3], excess_error = std::sqrt(found->covariance(3, 3));
    if (std::abs(excess) < stands_out * excess_error) return;
    tracked.path.amplitude -= excess;
    tracked.path.amplitude_error = std::hypot(tracked.path.amplitude_error, excess_error);
}

}  // namespace swirl::tracking
