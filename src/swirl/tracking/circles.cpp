#include "swirl/tracking/circles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <opencv2/imgproc.hpp>

#include "swirl/math/unit_circle.hpp"

namespace swirl {

namespace {

constexpr double cells_in_scatter = 1.6;  // standard deviations of votes

/// As many directions all around. They are the same for every circle, and not free.
const std::vector<Vec2>& directions(int rays) {
    thread_local std::map<int, std::vector<Vec2>> known;
    std::vector<Vec2>& all = known[rays];
    if (all.empty())
        for (int k = 0; k < rays; ++k) all.push_back(unit_circle(double(k) / rays));
    return all;
}

/// The picture at `first`, `first + step`, …, linear between pixels. In two loops, for the first
/// of them needs no memory and is done for several places at once.
void sample_ray(const cv::Mat& picture, const Vec2& first, const Vec2& step, int samples,
                float* into) {
    constexpr int maximum = 32;
    std::array<int, maximum> at;
    std::array<float, maximum> u, v;
    const auto stride = static_cast<int>(picture.step1());
    const float* const pixels = picture.ptr<float>();
    const auto x0 = static_cast<float>(first.x), y0 = static_cast<float>(first.y),
               dx = static_cast<float>(step.x), dy = static_cast<float>(step.y);
    for (int done = 0; done < samples; done += maximum) {
        const int now = std::min(maximum, samples - done);
        for (int j = 0; j < now; ++j) {
            const auto k = static_cast<float>(done + j);
            const float x = x0 + k * dx, y = y0 + k * dy;
            const int column = static_cast<int>(x), row = static_cast<int>(y);
            const auto n = static_cast<std::size_t>(j);
            u[n] = x - static_cast<float>(column);
            v[n] = y - static_cast<float>(row);
            at[n] = row * stride + column;
        }
        for (int j = 0; j < now; ++j) {
            const auto n = static_cast<std::size_t>(j);
            const float* above = pixels + at[n];
            const float* below = above + stride;
            const float a = above[0] + u[n] * (above[1] - above[0]),
                        b = below[0] + u[n] * (below[1] - below[0]);
            into[done + j] = a + v[n] * (b - a);
        }
    }
}

/// The middle one of values that may be put in another order.
double middle_of(std::vector<double>& values) {
    if (values.empty()) return 0.0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// Steepest place on a ray.
struct RayEdge {
    double ux, uy, distance, slope;
    double rest = 0.0, weight = 1.0;
};

/// Solves the symmetric 3×3 (or, without the last row, 2×2) system; false if it is singular.
bool solve(const double (&m)[3][3], const double (&b)[3], int n, double (&x)[3],
           double (&inverse_diagonal)[3]) {
    if (n == 2) {
        const double det = m[0][0] * m[1][1] - m[0][1] * m[0][1];
        if (!(det > 1e-9 * m[0][0] * m[1][1])) return false;
        x[0] = (m[1][1] * b[0] - m[0][1] * b[1]) / det;
        x[1] = (m[0][0] * b[1] - m[0][1] * b[0]) / det;
        x[2] = 0.0;
        inverse_diagonal[0] = m[1][1] / det;
        inverse_diagonal[1] = m[0][0] / det;
        return true;
    }
    const double c00 = m[1][1] * m[2][2] - m[1][2] * m[1][2];
    const double c01 = m[0][2] * m[1][2] - m[0][1] * m[2][2];
    const double c02 = m[0][1] * m[1][2] - m[0][2] * m[1][1];
    const double c11 = m[0][0] * m[2][2] - m[0][2] * m[0][2];
    const double c12 = m[0][1] * m[0][2] - m[0][0] * m[1][2];
    const double c22 = m[0][0] * m[1][1] - m[0][1] * m[0][1];
    const double det = m[0][0] * c00 + m[0][1] * c01 + m[0][2] * c02;
    if (!(det > 1e-9 * m[0][0] * m[1][1] * m[2][2])) return false;
    x[0] = (c00 * b[0] + c01 * b[1] + c02 * b[2]) / det;
    x[1] = (c01 * b[0] + c11 * b[1] + c12 * b[2]) / det;
    x[2] = (c02 * b[0] + c12 * b[1] + c22 * b[2]) / det;
    inverse_diagonal[0] = c00 / det;
    inverse_diagonal[1] = c11 / det;
    return true;
}

/// A ray counts by how sharply it tells its edge, as far as that is more than chance: a dark patch
/// of the texture at the limb says little, and that wrongly.
void weigh(std::vector<RayEdge>& edges, std::vector<double>& sharpness) {
    constexpr double power = 0.6, maximum = 4.0;
    sharpness.clear();
    for (const RayEdge& e : edges) sharpness.push_back(e.weight);
    const double middle = middle_of(sharpness);
    for (RayEdge& e : edges)
        e.weight = middle > 0.0 ? std::pow(std::min(e.weight / middle, maximum), power) : 1.0;
}

/// By the limb's profile, around a circle that is known to about a pixel.
void edge_profile_edges(const cv::Mat& picture, const CircleFit& fit, Polarity polarity,
                        const RaySettings& settings, std::vector<RayEdge>& edges) {
    const EdgeProfile& edge_profile = *settings.edge_profile;
    const int samples = edge_profile.inside() + edge_profile.outside() + 1;
    std::vector<float> profile(static_cast<std::size_t>(samples));
    for (const Vec2& u : directions(settings.rays)) {
        const Vec2 first =
                       fit.centre + (fit.radius - EdgeProfile::step * edge_profile.inside()) * u,
                   last =
                       fit.centre + (fit.radius + EdgeProfile::step * edge_profile.outside()) * u;
        const auto within = [&](const Vec2& p) {
            return p.x >= 0.0 && p.y >= 0.0 && p.x < picture.cols - 1.01 &&
                   p.y < picture.rows - 1.01;
        };
        if (!within(first) || !within(last)) continue;
        if (std::any_of(settings.others.begin(), settings.others.end(), [&](const NearCircle& o) {
                const Vec2 d = last - o.centre;
                return dot(d, d) < o.radius * o.radius;
            }))
            continue;
        sample_ray(picture, first, EdgeProfile::step * u, samples, profile.data());
        const EdgeProfile::Edge edge = edge_profile.find(profile.data());
        if (!edge.found || polarity * edge.contrast <= 0.0) continue;
        edges.push_back({u.x, u.y, fit.radius + edge.at, std::abs(edge.contrast), edge.rest,
                         std::max(0.0, edge.sharpness)});
    }
}

}  // namespace

double onset(const std::vector<double>& values, double width) {
    std::vector<double> sorted = values;
    std::sort(sorted.begin(), sorted.end());
    const auto number = [&](double from) {
        return std::lower_bound(sorted.begin(), sorted.end(), from + 2.0 * width) -
               std::lower_bound(sorted.begin(), sorted.end(), from);
    };
    std::ptrdiff_t maximum = 0;
    double at = 0.0;
    for (const double v : sorted)
        if (number(v) > maximum) maximum = number(v), at = v;
    // Of discs in contact the distances rise steeply, and fall off slowly: half way back up.
    double half = at;
    while (2 * number(half) > maximum && half > sorted.front()) half -= 0.2 * width;
    return 0.5 * (half + at) + width;
}

double gradient_noise(const cv::Mat& picture) {
    std::vector<double> slopes;
    for (int row = 1; row + 1 < picture.rows; row += 7) {
        const float* p = picture.ptr<float>(row);
        for (int column = 1; column + 1 < picture.cols; column += 3)
            slopes.push_back(std::abs(0.5 * double(p[column + 1] - p[column - 1])));
    }
    return median(slopes) / 0.6745;
}

std::vector<EdgePixel> edge_pixels(const cv::Mat& picture) {
    cv::Mat dx, dy;
    cv::Scharr(picture, dx, CV_32F, 1, 0, 1.0 / 32.0);
    cv::Scharr(picture, dy, CV_32F, 0, 1, 1.0 / 32.0);
    cv::Mat steepness;
    cv::magnitude(dx, dy, steepness);
    // Faint edges count as well, if they stand out from the noise.
    std::vector<double> sample;
    for (int row = 1; row < picture.rows; row += 5) {
        const float* s = steepness.ptr<float>(row);
        for (int column = 1; column < picture.cols; column += 3)
            sample.push_back(double(s[column]));
    }
    if (sample.empty()) return {};
    std::vector<double> copy = sample;
    // For noise of standard deviation σ in both derivatives the median length is 1.18 σ.
    const double noise = median(copy) / 1.18;
    const auto high = sample.begin() + static_cast<std::ptrdiff_t>(sample.size() * 97 / 100);
    std::nth_element(sample.begin(), high, sample.end());
    const auto minimum = static_cast<float>(std::max({3.5 * noise, 0.12 * *high, 0.25}));
    std::vector<EdgePixel> edges;
    for (int row = 1; row + 1 < picture.rows; ++row) {
        const float* s = steepness.ptr<float>(row);
        const float* above = steepness.ptr<float>(row - 1);
        const float* below = steepness.ptr<float>(row + 1);
        for (int column = 1; column + 1 < picture.cols; ++column) {
            const float here = s[column];
            if (here < minimum) continue;
            const float gx = dx.ptr<float>(row)[column], gy = dy.ptr<float>(row)[column];
            // The ridge of steepness: larger than both neighbours along the gradient.
            float one, other;
            const float ax = std::abs(gx), ay = std::abs(gy);
            if (ax > 2.414f * ay) {
                one = s[column - 1], other = s[column + 1];
            } else if (ay > 2.414f * ax) {
                one = above[column], other = below[column];
            } else if ((gx > 0.0f) == (gy > 0.0f)) {
                one = above[column - 1], other = below[column + 1];
            } else {
                one = above[column + 1], other = below[column - 1];
            }
            if (here < one || here <= other) continue;
            edges.push_back({static_cast<float>(column), static_cast<float>(row), gx / here,
                             gy / here, std::min(1.0f, here / (2.0f * minimum))});
        }
    }
    return edges;
}

std::vector<CircleCandidate> vote(const std::vector<EdgePixel>& edges, cv::Size size, double radius,
                                  Polarity polarity, double minimum, std::size_t maximum) {
    // Votes scatter: by the pixels' grid, and by a few degrees of the gradient's direction. Where
    // that is by many pixels they are counted in cells of several.
    const double scatter = 0.7 + 0.07 * radius;
    const int cell = std::max(1, static_cast<int>(scatter / cells_in_scatter));
    const double spread = scatter / cell;
    const cv::Size cells((size.width + cell - 1) / cell, (size.height + cell - 1) / cell);
    cv::Mat votes = cv::Mat::zeros(cells, CV_32F);
    const auto step = static_cast<float>(polarity * radius);
    // The middle of the first cell is (cell − 1)/2 pixels from that of the first pixel.
    const auto origin = 0.5f * static_cast<float>(cell - 1);
    const auto scale = 1.0f / static_cast<float>(cell);
    for (const EdgePixel& e : edges) {
        const float x = scale * (e.x + step * e.gx - origin),
                    y = scale * (e.y + step * e.gy - origin);
        if (!(x >= 0.0f && y >= 0.0f)) continue;
        const int column = static_cast<int>(x), row = static_cast<int>(y);
        if (column + 1 >= cells.width || row + 1 >= cells.height) continue;
        const float u = x - static_cast<float>(column), v = y - static_cast<float>(row);
        float* above = votes.ptr<float>(row) + column;
        float* below = votes.ptr<float>(row + 1) + column;
        above[0] += e.weight * (1.0f - u) * (1.0f - v);
        above[1] += e.weight * u * (1.0f - v);
        below[0] += e.weight * (1.0f - u) * v;
        below[1] += e.weight * u * v;
    }
    const int side = 2 * static_cast<int>(std::ceil(2.2 * spread)) + 1;
    cv::GaussianBlur(votes, votes, cv::Size(side, side), spread, spread, cv::BORDER_CONSTANT);
    const double own = 0.5 + 0.05 * radius;
    // All of a circumference of 2π a pixels, of which the ridge keeps nine in ten.
    const double whole =
        0.9 * 2.0 * pi * radius / (2.0 * pi * (spread * spread + own * own / (cell * cell)));
    std::vector<CircleCandidate> found;
    const auto threshold = static_cast<float>(minimum * whole);
    const int near = std::max(1, static_cast<int>(0.5 * radius));
    for (int row = 1; row + 1 < cells.height; ++row) {
        const float* v = votes.ptr<float>(row);
        for (int column = 1; column + 1 < cells.width; ++column) {
            const float here = v[column];
            if (here < threshold || here < v[column - 1] || here <= v[column + 1]) continue;
            const float* above = votes.ptr<float>(row - 1) + column;
            const float* below = votes.ptr<float>(row + 1) + column;
            if (here < above[0] || here <= below[0] || here < above[-1] || here < above[1] ||
                here <= below[-1] || here <= below[1])
                continue;
            const auto vertex = [&](float before, float after) {
                const float bend = before - 2.0f * here + after;
                return bend < 0.0f ? 0.5 * double((before - after) / bend) : 0.0;
            };
            const double x = column + vertex(v[column - 1], v[column + 1]),
                         y = row + vertex(above[0], below[0]);
            found.push_back({{cell * x + double(origin), cell * y + double(origin)},
                             radius,
                             polarity,
                             double(here) / whole});
        }
    }
    std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
        return a.support != b.support     ? a.support > b.support
               : a.centre.y != b.centre.y ? a.centre.y < b.centre.y
                                          : a.centre.x < b.centre.x;
    });
    std::vector<CircleCandidate> kept;
    for (const CircleCandidate& c : found) {
        if (kept.size() == maximum) break;
        const bool taken = std::any_of(kept.begin(), kept.end(), [&](const auto& k) {
            const Vec2 d = k.centre - c.centre;
            return dot(d, d) < double(near) * double(near);
        });
        if (!taken) kept.push_back(c);
    }
    return kept;
}

CircleFit fit_circle(const cv::Mat& picture, Vec2 centre, double radius, Polarity polarity,
                     const RaySettings& settings) {
    CircleFit fit{centre, radius};
    constexpr double step = 0.5, stands_still = 2e-3;
    std::vector<RayEdge> edges;
    std::vector<float> profile;
    std::vector<double> sizes, weights;
    double window = settings.window;
    CircleFit steep = fit;  // by the steepest places alone
    for (int round = settings.edge_profile_alone ? 2 : 0; round < 4; ++round) {
        edges.clear();
        const bool by_edge_profile = settings.edge_profile && round >= 2;
        if (round == 2) steep = fit;
        if (by_edge_profile) edge_profile_edges(picture, fit, polarity, settings, edges);
        const int samples = 2 * static_cast<int>(std::ceil(window / step)) + 5;
        profile.resize(static_cast<std::size_t>(samples));
        for (const Vec2& u : directions(settings.rays)) {
            if (by_edge_profile) break;
            const double begin = fit.radius - 0.5 * step * (samples - 1);
            const Vec2 first = fit.centre + begin * u,
                       last = fit.centre + (begin + step * (samples - 1)) * u;
            const auto inside = [&](const Vec2& p) {
                return p.x >= 0.0 && p.y >= 0.0 && p.x < picture.cols - 1.01 &&
                       p.y < picture.rows - 1.01;
            };
            if (!inside(first) || !inside(last)) continue;
            sample_ray(picture, first, step * u, samples, profile.data());
            // Slopes over two pixels; bright inside descends outwards.
            int best = -1;
            float steepest = 0.0f;
            const auto slope = [&](int j) {
                return static_cast<float>(-polarity) * 0.5f *
                       (profile[static_cast<std::size_t>(j + 2)] -
                        profile[static_cast<std::size_t>(j - 2)]);
            };
            for (int j = 2; j + 2 < samples; ++j)
                if (const float s = slope(j); s > steepest) steepest = s, best = j;
            if (best < 3 || best + 3 >= samples || double(steepest) < settings.minimum) continue;
            const float before = slope(best - 1), after = slope(best + 1);
            const float bend = before - 2.0f * steepest + after;
            const double shift = bend < 0.0f ? 0.5 * double((before - after) / bend) : 0.0;
            edges.push_back(
                {u.x, u.y, begin + step * (best + std::clamp(shift, -1.0, 1.0)), double(steepest)});
        }
        // Where limbs cannot be made out, the steepest places must do.
        if (edges.size() < static_cast<std::size_t>(settings.rays) / 5 + 3)
            return by_edge_profile ? steep : fit;
        // Reweighted until it stands still, with a scale that shrinks to that of the inliers.
        double d[3] = {0.0, 0.0, 0.0}, inverse[3] = {0.0, 0.0, 0.0};
        {  // a start that half of the rays cannot move: the median of the distances
            sizes.clear();
            for (const RayEdge& e : edges) sizes.push_back(e.distance - fit.radius);
            if (settings.free_radius) d[2] = middle_of(sizes);
        }
        if (by_edge_profile) weigh(edges, sizes);
        double scale = window;
        for (int pass = 0; pass < 8; ++pass) {
            double m[3][3] = {}, b[3] = {}, x[3];
            sizes.clear();
            for (const RayEdge& e : edges) {
                const double rest = e.distance - fit.radius - e.ux * d[0] - e.uy * d[1] - d[2];
                sizes.push_back(std::abs(rest));
                const double q = rest / (3.0 * scale);
                if (q * q >= 1.0) continue;
                const double w = e.weight * (1.0 - q * q) * (1.0 - q * q);
                const double y = e.distance - fit.radius;
                const double j[3] = {e.ux, e.uy, 1.0};
                for (int r = 0; r < 3; ++r) {
                    for (int c = r; c < 3; ++c) m[r][c] += w * j[r] * j[c];
                    b[r] += w * j[r] * y;
                }
            }
            m[1][0] = m[0][1];
            if (!solve(m, b, settings.free_radius ? 3 : 2, x, inverse))
                return by_edge_profile ? steep : fit;
            double moved = 0.0;
            for (int r = 0; r < 3; ++r) moved += std::abs(x[r] - d[r]), d[r] = x[r];
            scale = std::max(1.4826 * middle_of(sizes), 0.15);
            scale = std::min(scale, window);
            if (pass > 2 && moved < stands_still) break;
        }
        const double limit = 1.5 * settings.window;
        if (std::abs(d[0]) > limit || std::abs(d[1]) > limit || std::abs(d[2]) > limit)
            return by_edge_profile ? steep : fit;
        fit.centre = fit.centre + Vec2{d[0], d[1]};
        fit.radius += d[2];
        // What lies on the circle, and how well.
        weights.clear();
        double square = 0.0, fit_rest = 0.0;
        std::size_t on = 0;
        for (const RayEdge& e : edges) {
            const double rest = e.distance - (fit.radius - d[2]) - e.ux * d[0] - e.uy * d[1] - d[2];
            if (std::abs(rest) > settings.tolerance) continue;
            square += rest * rest;
            weights.push_back(e.slope);
            fit_rest += e.rest;
            ++on;
        }
        if (on > 0) fit.rest = fit_rest / double(on);
        fit.support = std::max(fit.support, double(on) / settings.rays);
        if (on < 6) return by_edge_profile ? steep : fit;
        fit.contrast = middle_of(weights);
        fit.residual = std::sqrt(square / double(on - 2));
        fit.error = fit.residual * std::sqrt(0.5 * (inverse[0] + inverse[1]));
        fit.good = true;
        const double moved = std::sqrt(d[0] * d[0] + d[1] * d[1]);
        window = std::max(std::min(settings.window, 2.0), 0.6 * settings.window);
        if (settings.edge_profile) {
            if (round == 1 && moved > 0.5) continue;
            if (round == 2 && moved < 0.05) break;
        } else if (round > 0 && moved < 0.02) {
            break;
        }
    }
    return fit;
}

}  // namespace swirl
