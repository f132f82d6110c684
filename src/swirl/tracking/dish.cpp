#include "swirl/tracking/dish.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "swirl/math/unit_circle.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/tracking/outline.hpp"

namespace swirl {

namespace {

struct Circle {
    Vec2 centre{0.0, 0.0};
    double radius = 0.0;
    double scatter = 0.0;  // median distance of the points from it
};

/// x² + y² = 2 p·x + q, by least squares (Kåsa), reweighted so that strays do not count.
Circle circle_through(const std::vector<Vec2>& points) {
    std::vector<double> xs, ys;
    for (const Vec2& p : points) xs.push_back(p.x), ys.push_back(p.y);
    const Vec2 origin{median(xs), median(ys)};
    // Squares of squares: one far stray would decide about the first circle.
    std::vector<double> weights, distances;
    for (const Vec2& p : points) distances.push_back(length(p - origin));
    const double far = 4.0 * median(distances);
    for (const double d : distances) weights.push_back(d <= far ? 1.0 : 0.0);
    Circle circle;
    for (int pass = 0; pass < 8; ++pass) {
        cv::Matx33d m = cv::Matx33d::zeros();
        cv::Vec3d b(0.0, 0.0, 0.0);
        for (std::size_t k = 0; k < points.size(); ++k) {
            const Vec2 p = points[k] - origin;
            const cv::Vec3d row(2.0 * p.x, 2.0 * p.y, 1.0);
            m += weights[k] * (row * row.t());
            b += weights[k] * dot(p, p) * row;
        }
        cv::Vec3d x;
        if (!cv::solve(cv::Mat(m), cv::Mat(b), cv::Mat(x, false), cv::DECOMP_SVD)) break;
        circle.centre = origin + Vec2{x[0], x[1]};
        circle.radius = std::sqrt(std::max(0.0, x[2] + x[0] * x[0] + x[1] * x[1]));
        std::vector<double> off;
        for (const Vec2& p : points)
            off.push_back(std::abs(length(p - circle.centre) - circle.radius));
        circle.scatter = median(off);
        const double scale = std::max(4.5 * 1.4826 * circle.scatter, 0.2);
        for (std::size_t k = 0; k < points.size(); ++k) {
            const double q = off[k] / scale;
            weights[k] = q < 1.0 ? (1.0 - q * q) * (1.0 - q * q) : 0.0;
        }
    }
    return circle;
}

constexpr double min_rim = 0.2;        // of its circumference must be seen
constexpr double min_amplitude = 1.0;  // pixels: a dish that moves less stands still

}  // namespace

Picture::Picture(const cv::Mat& grey, double shrunk_to, double blur) : shrink(shrunk_to) {
    // Kernels of 2.5 standard deviations to either side; OpenCV's own choice for floats is 4.
    const auto smooth = [](const cv::Mat& from, cv::Mat& to, double deviation) {
        const int side = 2 * static_cast<int>(std::ceil(2.5 * deviation)) + 1;
        cv::GaussianBlur(from, to, cv::Size(side, side), deviation, deviation,
                         cv::BORDER_REPLICATE);
    };
    grey.convertTo(sharp, CV_32F);
    cv::Mat shrunk;
    if (shrink < 0.999) {
        const cv::Size size(std::max(8, cvRound(grey.cols * shrink)),
                            std::max(8, cvRound(grey.rows * shrink)));
        cv::resize(grey, shrunk, size, 0, 0, cv::INTER_AREA);
        shrink = double(size.width) / grey.cols;
        shrunk.convertTo(shrunk, CV_32F);
        smooth(shrunk, small, 1.0);
    } else {
        shrink = 1.0;
        smooth(sharp, small, 1.4);
    }
    smooth(sharp, sharp, blur);
    edges = edge_pixels(small);
    noise = gradient_noise(sharp);
}

/// The middle of pixel k of the small picture lies at (k + ½)/shrink − ½ in the sharp one.
Vec2 Picture::to_sharp(const Vec2& p) const {
    return {(p.x + 0.5) / shrink - 0.5, (p.y + 0.5) / shrink - 0.5};
}
Vec2 Picture::to_small(const Vec2& p) const {
    return {(p.x + 0.5) * shrink - 0.5, (p.y + 0.5) * shrink - 0.5};
}

Rim survey_rim(const std::vector<Picture>& pictures) {
    const cv::Size size = pictures.front().small.size();
    const double side = std::min(size.width, size.height);
    struct Found {
        double radius;
        Polarity polarity;
        double support;  // the sum over pictures
        std::vector<Vec2> centres;
        std::vector<double>
            radii;  // of fits with free radius: votes are as coarse as their picture
        Circle path;
    };
    std::vector<Found> all;
    const std::size_t stride = std::max<std::size_t>(1, pictures.size() / 16);
    for (const Polarity polarity : {1, -1}) {
        for (double radius = 0.1 * side; radius < 0.56 * side; radius += 1.0) {
            Found found{radius, polarity, 0.0, {}, {}, {}};
            for (std::size_t k = 0; k < pictures.size(); k += stride) {
                const auto best = vote(pictures[k].edges, size, radius, polarity, 0.1, 1);
                if (!best.empty()) found.support += best.front().support;
            }
            all.push_back(std::move(found));
        }
    }
    std::sort(all.begin(), all.end(),
              [](const Found& a, const Found& b) { return a.support > b.support; });
    const double looked_at = std::ceil(double(pictures.size()) / double(stride));
    if (all.front().support < min_rim * looked_at)
        throw Failure(
            "No dish was found: in hardly any picture is there a large circle. The whole rim must "
            "be in the picture, and stand out from the table or from the floor of the dish.");
    // The best ones, different from each other; of those the best that moves.
    std::vector<Found> distinct;
    for (const Found& f : all) {
        if (distinct.size() == 8 || f.support < 0.45 * all.front().support) break;
        const bool again = std::any_of(distinct.begin(), distinct.end(), [&](const Found& d) {
            return d.polarity == f.polarity && std::abs(d.radius - f.radius) < 3.5;
        });
        if (!again) distinct.push_back(f);
    }
    const Picture& first = pictures.front();
    const Found* moving = nullptr;
    double maximum = 0.0;
    for (Found& f : distinct) {
        for (const Picture& p : pictures) {
            const auto best = vote(p.edges, size, f.radius, f.polarity, 0.12, 1);
            if (best.empty()) continue;
            RaySettings rays;
            rays.rays = 180;
            rays.window = std::max(3.0, 1.8 / p.shrink);
            rays.minimum = 3.0 * p.noise;
            rays.free_radius = true;
            const CircleFit fit = fit_circle(p.sharp, p.to_sharp(best.front().centre),
                                             f.radius / p.shrink, f.polarity, rays);
            if (!fit.good || fit.support < min_rim) continue;
            f.centres.push_back(fit.centre);
            f.radii.push_back(fit.radius);
        }
        if (f.centres.size() < 4) continue;
        f.path = circle_through(f.centres);
        // A share of the way round must have been seen, or any three points lie on a circle.
        double reach = 0.0;
        for (const Vec2& c : f.centres) reach = std::max(reach, length(c - f.centres.front()));
        const bool moves = f.path.radius > min_amplitude && reach > 1.4 * f.path.radius * 0.5 &&
                           f.path.scatter < std::max(1.0, 0.1 * f.path.radius) &&
                           f.path.radius < 1.5 * f.radius / first.shrink;
        if (!moves) continue;
        const double worth = f.support * double(f.centres.size()) / double(pictures.size());
        if (worth > maximum) maximum = worth, moving = &f;
    }
    if (!moving) {
        const Found& best = distinct.front();
        double reach = 0.0;
        for (const Vec2& c : best.centres)
            reach = std::max(reach, length(c - best.centres.front()));
        if (best.centres.size() >= 4 && best.path.scatter < 1.0 && reach < 3.0)
            throw Failure(fmt::format(
                "The dish stands still: its centre stays within {:.1f} pixels in the whole film. "
                "The camera must stand on the floor and the dish be swirled; a camera that rides "
                "with the dish does not see the swirl.",
                std::max(reach, 0.1)));
        throw Failure(fmt::format(
            "The largest circle in the pictures, of about {:.0f} pixels radius, does not run round "
            "a circle, as a swirled dish does. Does the camera move, is the film shorter than half "
            "a swirl, is something in front of the dish, or has its path few corners?",
            best.radius / first.shrink));
    }
    Rim rim;
    rim.polarity = moving->polarity;
    rim.support = moving->support / looked_at;
    rim.swirl_centre = moving->path.centre;
    rim.amplitude = moving->path.radius;
    rim.radius = median(moving->radii);
    // Another one beside it?
    std::size_t pairs = 0;
    for (std::size_t k = 0; k < pictures.size(); k += stride) {
        const auto best =
            vote(pictures[k].edges, size, rim.radius * first.shrink, rim.polarity, 0.0, 6);
        for (std::size_t j = 1; j < best.size(); ++j)
            if (length(best[j].centre - best[0].centre) > 1.7 * rim.radius * first.shrink &&
                best[j].support > 0.6 * best[0].support) {
                ++pairs;
                break;
            }
    }
    rim.second_container = double(pairs) > 0.6 * looked_at;
    return rim;
}

namespace {

CircleFit fit_rim(const Picture& picture, const Rim& rim, const Vec2& centre, double radius) {
    const double window = std::max(3.0, 1.5 / picture.shrink), minimum = 3.0 * picture.noise;
    if (rim.lens) {
        const Lens::Circle circle{rim.lens->ideal(Lens::Circle{centre, radius}).centre, rim.radius};
        return fit_outline(picture.sharp, *rim.lens, circle, {rim.polarity, window, minimum});
    }
    RaySettings rays;
    rays.rays = 360;
    rays.window = window;
    rays.minimum = minimum;
    rays.tolerance = 1.5;
    return fit_circle(picture.sharp, centre, radius, rim.polarity, rays);
}

}  // namespace

CircleFit find_rim(const Picture& picture, const Rim& rim) {
    double radius = rim.radius;
    if (rim.lens) radius = rim.lens->image({rim.lens->ideal(rim.swirl_centre), rim.radius}).radius;
    const auto candidates =
        vote(picture.edges, picture.small.size(), radius * picture.shrink, rim.polarity, 0.08, 6);
    CircleFit best{rim.swirl_centre, radius};
    for (const CircleCandidate& c : candidates) {
        const Vec2 centre = picture.to_sharp(c.centre);
        const double off = length(centre - rim.swirl_centre) - rim.amplitude;
        if (rim.amplitude > 0.0 && std::abs(off) > 6.0 / picture.shrink + 0.35 * rim.amplitude)
            continue;
        const CircleFit fit = fit_rim(picture, rim, centre, radius);
        if (fit.good && fit.support > best.support) best = fit;
    }
    if (best.support < 0.5 * min_rim) best.good = false;
    return best;
}

Vec2 TrackedPath::at(double time) const {
    const double turn = angle(time);
    return {centre.x + amplitude * std::cos(turn), centre.y - amplitude * std::sin(turn)};
}

std::optional<TrackedPath> fit_path(const std::vector<Vec2>& centres,
                                    const std::vector<double>& times) {
    const std::size_t n = centres.size();
    if (n < 8) return std::nullopt;
    const Circle circle = circle_through(centres);
    if (!(circle.radius > min_amplitude) || circle.scatter > 0.2 * circle.radius)
        return std::nullopt;
    // Angles as seen (y up), picture to picture; a stray one is left out before it spoils the
    // count.
    std::vector<double> angle, when;
    double last = 0.0, turns = 0.0;
    for (std::size_t k = 0; k < n; ++k) {
        const Vec2 d = centres[k] - circle.centre;
        if (std::abs(length(d) - circle.radius) >
            std::max(6.0 * circle.scatter, 0.3 * circle.radius))
            continue;
        const double now = std::atan2(-d.y, d.x);
        if (!angle.empty()) turns += std::remainder(now - last, 2.0 * pi);
        last = now;
        angle.push_back(turns + (angle.empty() ? now : 0.0));
        if (angle.size() == 1) turns = now;
        when.push_back(times[k]);
    }
    if (angle.size() < 8) return std::nullopt;
    double st = 0, sa = 0, stt = 0, sta = 0;
    const double m = double(angle.size());
    for (std::size_t k = 0; k < angle.size(); ++k) {
        st += when[k], sa += angle[k];
        stt += when[k] * when[k], sta += when[k] * angle[k];
    }
    const double rate = (m * sta - st * sa) / (m * stt - st * st);
    if (!(std::abs(rate) > 0.0)) return std::nullopt;
    TrackedPath path;
    path.centre = circle.centre;
    path.amplitude = circle.radius;
    path.clockwise = rate < 0.0;
    const double sign = path.clockwise ? -1.0 : 1.0;
    path.omega = std::abs(rate);
    path.phase = (sa - rate * st) / m;

    const double span = std::max(times.back() - times.front(), 1e-12), origin = times.front();
    cv::Matx<double, 5, 5> inverse = cv::Matx<double, 5, 5>::zeros();
    double scale = std::max(circle.scatter, 0.5);
    for (int pass = 0; pass < 25; ++pass) {
        cv::Matx<double, 5, 5> normal = cv::Matx<double, 5, 5>::zeros();
        cv::Vec<double, 5> right = cv::Vec<double, 5>::all(0.0);
        std::vector<double> off;
        double weight_sum = 0.0;
        for (std::size_t k = 0; k < n; ++k) {
            const double turn = path.angle(times[k]);
            const Vec2 u{std::cos(turn), -std::sin(turn)};   // radial, y down
            const Vec2 v{-std::sin(turn), -std::cos(turn)};  // its derivative
            const Vec2 rest = centres[k] - path.at(times[k]);
            off.push_back(length(rest));
            const double q = off.back() / (4.7 * scale);
            if (q >= 1.0) continue;
            const double w = (1.0 - q * q) * (1.0 - q * q);
            weight_sum += w;
            const double t = sign * (times[k] - origin) / span;
            const cv::Vec<double, 5> jx(1.0, 0.0, u.x, path.amplitude * v.x,
                                        path.amplitude * v.x * t);
            const cv::Vec<double, 5> jy(0.0, 1.0, u.y, path.amplitude * v.y,
                                        path.amplitude * v.y * t);
            normal += w * (jx * jx.t() + jy * jy.t());
            right += w * (rest.x * jx + rest.y * jy);
        }
        if (weight_sum < 5.0) return std::nullopt;
        bool invertible = false;
        inverse = normal.inv(cv::DECOMP_SVD, &invertible);
        const cv::Vec<double, 5> d = inverse * right;
        path.centre = path.centre + Vec2{d[0], d[1]};
        path.amplitude += d[2];
        path.omega += d[4] / span;
        // The angle at `origin` moved by d[3], and the slope about it.
        path.phase += d[3] - sign * d[4] / span * origin;
        // The median length of a vector of two normal components is 1.18 standard deviations;
        // weighted squares would come out too small, for the weights favour what is close.
        path.residual = median(off) / 1.1774;
        scale = std::max(path.residual, 0.05);
        std::size_t close = 0;
        for (const double o : off)
            if (o < 4.7 * scale) ++close;
        path.used = double(close) / double(n);
        if (pass > 5 && std::abs(d[0]) + std::abs(d[1]) + std::abs(d[2]) < 1e-7) break;
    }
    const auto error = [&](int k) {
        return path.residual * std::sqrt(std::max(0.0, inverse(k, k)));
    };
    path.centre_error = std::max(error(0), error(1));
    path.amplitude_error = error(2);
    path.phase_error = error(3);
    path.omega_error = error(4) / span;
    path.phase = std::remainder(path.phase, 2.0 * pi);
    if (path.used < 0.5 || path.amplitude_error > 0.05 * path.amplitude) return std::nullopt;
    return path;
}

double shake_of(const std::vector<Vec2>& centres, const std::vector<std::size_t>& numbers,
                const TrackedPath& path) {
    std::vector<double> bends;
    for (std::size_t k = 1; k + 1 < centres.size(); ++k) {
        if (numbers[k + 1] != numbers[k - 1] + 2) continue;
        bends.push_back(std::abs(length(centres[k - 1] - path.centre) -
                                 2.0 * length(centres[k] - path.centre) +
                                 length(centres[k + 1] - path.centre)));
    }
    return bends.empty() ? 0.0 : 1.4826 * median(bends) / std::sqrt(6.0);
}

std::vector<Leap> leaps_of(const std::vector<Vec2>& centres,
                           const std::vector<std::size_t>& numbers, const TrackedPath& path) {
    constexpr std::size_t around = 5, min_steps = 12;
    constexpr double on_path = 0.2;     // of the amplitude
    constexpr double stands_out = 6.0;  // standard deviations of a step
    constexpr double minimum = 0.6;     // of a step: a picture lost or doubled is one
    std::vector<double> steps;
    std::vector<std::size_t> firsts;  // of the two centres
    for (std::size_t k = 0; k + 1 < centres.size(); ++k) {
        const Vec2 a = centres[k] - path.centre, b = centres[k + 1] - path.centre;
        if (numbers[k + 1] != numbers[k] + 1) continue;
        if (std::abs(length(a) - path.amplitude) > on_path * path.amplitude ||
            std::abs(length(b) - path.amplitude) > on_path * path.amplitude)
            continue;
        const double angle = std::atan2(-b.y, b.x) - std::atan2(-a.y, a.x);
        steps.push_back((path.clockwise ? -1.0 : 1.0) * std::remainder(angle, 2.0 * pi));
        firsts.push_back(k);
    }
    if (steps.size() < min_steps) return {};
    // Against those around it, for who swirls by hand does not keep to one speed.
    std::vector<double> usual, off;
    for (std::size_t k = 0; k < steps.size(); ++k) {
        const std::size_t from = k < around ? 0 : k - around,
                          to = std::min(steps.size(), k + around + 1);
        usual.push_back(median({steps.begin() + static_cast<std::ptrdiff_t>(from),
                                steps.begin() + static_cast<std::ptrdiff_t>(to)}));
        off.push_back(std::abs(steps[k] - usual.back()));
    }
    const double scatter = 1.4826 * median(off);
    std::vector<Leap> leaps;
    const auto leap = [&](std::size_t k, double by) {
        leaps.push_back({numbers[firsts[k]], numbers[firsts[k] + 1], steps[k] / by});
    };
    // Every other picture may be there twice: then nothing is usual.
    std::vector<double> sorted = steps;
    std::sort(sorted.begin(), sorted.end());
    const double large = sorted[sorted.size() * 9 / 10];
    // Steps of a shaking camera are near zero by chance.
    const bool steady =
        large * path.amplitude > stands_out * std::sqrt(2.0) * shake_of(centres, numbers, path);
    const auto moves = [&](std::size_t k) {
        return k >= steps.size() || (steps[k] > 0.5 * large && steps[k] < 1.5 * large);
    };
    for (std::size_t k = 0; k < steps.size(); ++k) {
        const bool residences = steady && std::abs(steps[k]) < 0.15 * large &&
                                large * path.amplitude > min_amplitude && moves(k - 1) &&
                                moves(k + 1);
        if (residences) {
            leap(k, large);
            continue;
        }
        if (!(usual[k] > stands_out * scatter) || off[k] < minimum * usual[k]) continue;
        // A centre that was found beside its place goes there and back.
        const auto unassigned = [&](std::size_t j) {
            return j < steps.size() &&
                   std::abs(steps[k] + steps[j] - 2.0 * usual[k]) < 0.5 * off[k];
        };
        if (unassigned(k + 1) || (k > 0 && unassigned(k - 1))) continue;
        leap(k, usual[k]);
    }
    return leaps;
}

namespace {

/// How much farther from the middle than the circle that fits the centres are, and in which
/// direction; without strays.
struct Departures {
    std::vector<double> outward, angles;
    double square = 0.0;  // the sum of all squares

    /// The standard error of a harmonic of them, when so much of the square is explained. With the
    /// ellipse of a tilted camera it is only too large.
    double error(double explained = 0.0) const {
        return std::sqrt(2.0 * std::max(0.0, square - explained)) / double(outward.size());
    }
};
Departures departures(const std::vector<Vec2>& centres, const TrackedPath& path) {
    Departures all;
    const double cut = std::max(5.0 * path.residual, 0.5);
    for (const Vec2& c : centres) {
        const Vec2 d = c - path.centre;
        const double outward = length(d) - path.amplitude;
        if (std::abs(outward) > cut) continue;
        all.outward.push_back(outward);
        all.angles.push_back(std::atan2(-d.y, d.x));
        all.square += outward * outward;
    }
    return all;
}

/// What fits them best, of one number of waves a turn.
struct Harmonic {
    double size = 0.0;
    double explained = 0.0;  // of the square
    bool told = false;       // at two pictures a wave its two parts are one, and nothing is told
};
Harmonic harmonic_of(const Departures& all, int n) {
    double cc = 0.0, cs = 0.0, ss = 0.0, c = 0.0, s = 0.0;
    for (std::size_t k = 0; k < all.outward.size(); ++k) {
        const double x = std::cos(n * all.angles[k]), y = std::sin(n * all.angles[k]);
        cc += x * x, cs += x * y, ss += y * y;
        c += all.outward[k] * x, s += all.outward[k] * y;
    }
    constexpr double apart = 0.1;  // of what two independent parts have
    const double determinant = cc * ss - cs * cs, half = 0.5 * double(all.outward.size());
    if (!(determinant > apart * half * half)) return {};
    const double a = (ss * c - cs * s) / determinant, b = (cc * s - cs * c) / determinant;
    return {std::hypot(a, b), a * c + b * s, true};
}

/// The distance of the corners from the middle, by the mean distance on the way.
double corners_of(double amplitude, int sides) {
    const double half = pi / sides;
    const double mean = std::cos(half) / half * std::log(1.0 / std::cos(half) + std::tan(half));
    return amplitude / mean;
}

}  // namespace

PathPolygon polygon_of(const std::vector<Vec2>& centres, const std::vector<double>& times,
                       const TrackedPath& path) {
    constexpr int min_sides = 3, min_per_side = 2;
    constexpr std::size_t min_pictures = 16;
    constexpr double size_known_to = 0.35, rivals = 0.5;  // of what the best explains
    constexpr double stands_out = 5.0, not_there = 3.0, told_apart = 2.0;  // standard errors
    PathPolygon polygon;
    if (centres.size() < min_pictures) return polygon;
    const Departures all = departures(centres, path);
    if (all.outward.size() < min_pictures) return polygon;
    const double spans = (times.back() - times.front()) / double(times.size() - 1);
    const double per_swirl = 2.0 * pi / (path.omega * spans), error = all.error();
    const auto expected = [&](double n) { return 2.0 * path.amplitude / (n * n); };
    const int limit = static_cast<int>(per_swirl / min_per_side);
    int in_doubt = limit + 1;  // the fewest sides that are neither seen nor sure not to be there
    std::vector<std::pair<int, Harmonic>> fitting;
    for (int n = min_sides; n <= limit && expected(n) >= stands_out * error; ++n) {
        const Harmonic found = harmonic_of(all, n);
        if (!found.told) break;
        polygon.max_sides = n;
        if (found.size > stands_out * error &&
            std::abs(found.size / expected(n) - 1.0) < size_known_to)
            fitting.emplace_back(n, found);
        else if (found.size > expected(n) - not_there * error)
            in_doubt = std::min(in_doubt, n);
    }
    const auto best = std::max_element(
        fitting.begin(), fitting.end(),
        [](const auto& a, const auto& b) { return a.second.explained < b.second.explained; });
    if (best == fitting.end()) {
        polygon.max_sides = std::min(polygon.max_sides, in_doubt - 1);
        return polygon;
    }
    // One of more sides than two pictures a side tell looks like one of fewer, but for its size.
    const auto& [sides, seen] = *best;
    const double alias = expected(per_swirl - sides), off = std::abs(seen.size - expected(sides));
    bool alone = off < std::abs(seen.size - alias) &&
                 std::abs(seen.size - alias) > told_apart * all.error(seen.explained);
    for (const auto& [n, other] : fitting) {
        if (n == sides || other.explained < rivals * seen.explained) continue;
        alone = false;
        in_doubt = std::min(in_doubt, n);
    }
    if (alone) {
        polygon.sides = sides;
        polygon.corners = corners_of(path.amplitude, sides);
    } else {
        polygon.max_sides = std::min(in_doubt, sides) - 1;
    }
    return polygon;
}

}  // namespace swirl
