#include "track/video/circles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "swirl/math/unit_circle.hpp"
#include "track/video/edge_profile.hpp"
#include "track/video/robust_statistics.hpp"

namespace swirl::tracking {

namespace {

/// What interpolation needs beyond a position: the next row and column, and a margin for rounding.
constexpr double interpolation_border = 1.01;

/// `rays` directions, evenly spaced; they are computed once.
const std::vector<Vec2>& directions(int rays) {
    thread_local std::map<int, std::vector<Vec2>> computed;
    std::vector<Vec2>& all = computed[rays];
    if (all.empty())
        for (int k = 0; k < rays; ++k) all.push_back(unit_circle(double(k) / rays));
    return all;
}

bool can_sample(const cv::Mat& image, const Vec2& p) {
    return p.x >= 0.0 && p.y >= 0.0 && p.x < image.cols - interpolation_border &&
           p.y < image.rows - interpolation_border;
}

/// Samples the image at `first`, `first + step`, …, linear between pixels. The first of the two
/// inner loops reads no memory, so that the compiler can vectorise it.
void sample_ray(const cv::Mat& image, const Vec2& first, const Vec2& step, int samples,
                float* into) {
    constexpr int block = 32;
    std::array<int, block> at;
    std::array<float, block> u, v;
    const auto stride = int(image.step1());
    const float* const pixels = image.ptr<float>();
    const auto x0 = float(first.x), y0 = float(first.y), dx = float(step.x), dy = float(step.y);
    for (int done = 0; done < samples; done += block) {
        const int now = std::min(block, samples - done);
        for (int j = 0; j < now; ++j) {
            const auto k = float(done + j);
            const float x = x0 + k * dx, y = y0 + k * dy;
            const int column = int(x), row = int(y);
            const auto n = std::size_t(j);
            u[n] = x - float(column);
            v[n] = y - float(row);
            at[n] = row * stride + column;
        }
        for (int j = 0; j < now; ++j) {
            const auto n = std::size_t(j);
            const float* above = pixels + at[n];
            const float* below = above + stride;
            const float a = above[0] + u[n] * (above[1] - above[0]),
                        b = below[0] + u[n] * (below[1] - below[0]);
            into[done + j] = a + v[n] * (b - a);
        }
    }
}

/// The median; reorders `values`.
double median_in_place(std::vector<double>& values) {
    if (values.empty()) return 0.0;
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// The edge on the ray with direction (ux, uy).
struct RayEdge {
    double ux, uy, distance, slope;
    double profile_residual = 0.0, weight = 1.0;
};

/// Solves the symmetric 3×3 system; false if it is singular.
bool solve(const double (&m)[3][3], const double (&b)[3], double (&x)[3],
           double (&inverse_diagonal)[3]) {
    constexpr double singular = 1e-9;  // determinant / product of the diagonal
    const double c00 = m[1][1] * m[2][2] - m[1][2] * m[1][2];
    const double c01 = m[0][2] * m[1][2] - m[0][1] * m[2][2];
    const double c02 = m[0][1] * m[1][2] - m[0][2] * m[1][1];
    const double c11 = m[0][0] * m[2][2] - m[0][2] * m[0][2];
    const double c12 = m[0][1] * m[0][2] - m[0][0] * m[1][2];
    const double c22 = m[0][0] * m[1][1] - m[0][1] * m[0][1];
    const double det = m[0][0] * c00 + m[0][1] * c01 + m[0][2] * c02;
    if (!(det > singular * m[0][0] * m[1][1] * m[2][2])) return false;
    x[0] = (c00 * b[0] + c01 * b[1] + c02 * b[2]) / det;
    x[1] = (c01 * b[0] + c11 * b[1] + c12 * b[2]) / det;
    x[2] = (c02 * b[0] + c12 * b[1] + c22 * b[2]) / det;
    inverse_diagonal[0] = c00 / det;
    inverse_diagonal[1] = c11 / det;
    return true;
}

/// The fit to the edges on all rays. One object serves all rounds, which share its memory.
class RayCircleFit {
  public:
    RayCircleFit(const cv::Mat& image, Polarity polarity, const RaySettings& settings)
        : image_(image), polarity_(polarity), settings_(settings) {}

    /// Gathers the edges near `fit` and fits it to them. Returns how far its centre moved, or
    /// nothing if there are too few edges.
    std::optional<double> improve(CircleFit& fit, double window, bool by_profile) {
        edges_.clear();
        if (by_profile)
            find_profile_edges(fit);
        else
            find_steepest_edges(fit, window);
        if (edges_.size() < std::size_t(settings_.rays) / rays_per_edge + 3) return std::nullopt;
        if (by_profile) weigh_by_sharpness();
        const std::optional<Step> step = solve_reweighted(fit, window);
        if (!step) return std::nullopt;
        const auto& d = step->d;
        const double limit = max_shift * settings_.window;
        if (std::abs(d[0]) > limit || std::abs(d[1]) > limit || std::abs(d[2]) > limit)
            return std::nullopt;
        fit.centre = fit.centre + Vec2{d[0], d[1]};
        fit.radius += d[2];
        if (!rate(fit, *step)) return std::nullopt;
        return std::sqrt(d[0] * d[0] + d[1] * d[1]);
    }

  private:
    static constexpr double sample_step = 0.5;   // pixels
    static constexpr int max_passes = 8;         // of reweighting
    static constexpr int min_passes = 3;         // the scale of the residuals needs these to settle
    static constexpr double settled = 2e-3;      // pixels, the sum over the unknowns
    static constexpr double tukey_cutoff = 3.0;  // standard deviations
    static constexpr double min_scale = 0.15;    // pixels: keeps the edges of a sharp image
    static constexpr double max_shift = 1.5;  // windows: beyond, the edges say nothing of the fit
    static constexpr std::size_t rays_per_edge = 5;  // at most, and 3 edges for the unknowns
    static constexpr std::size_t min_on_circle = 6;  // edges: twice the number of unknowns

    struct Step {
        double d[3] = {0.0, 0.0, 0.0};        // of the centre's coordinates and the radius
        double inverse[3] = {0.0, 0.0, 0.0};  // diagonal of the inverse normal matrix
    };

    void find_steepest_edges(const CircleFit& fit, double window) {
        const int samples = 2 * int(std::ceil(window / sample_step)) + 5;
        profile_.resize(std::size_t(samples));
        const double begin = fit.radius - 0.5 * sample_step * (samples - 1);
        // Over two pixels; a circle that is bright inside descends outwards.
        const auto slope = [&](int j) {
            return float(-polarity_) * 0.5f *
                   (profile_[std::size_t(j + 2)] - profile_[std::size_t(j - 2)]);
        };
        for (const Vec2& u : directions(settings_.rays)) {
            const Vec2 first = fit.centre + begin * u,
                       last = fit.centre + (begin + sample_step * (samples - 1)) * u;
            if (!can_sample(image_, first) || !can_sample(image_, last)) continue;
            sample_ray(image_, first, sample_step * u, samples, profile_.data());
            int best = -1;
            float steepest = 0.0f;
            for (int j = 2; j + 2 < samples; ++j)
                if (const float s = slope(j); s > steepest) steepest = s, best = j;
            if (best < 3 || best + 3 >= samples || double(steepest) < settings_.minimum) continue;
            const double shift = vertex_offset(slope(best - 1), steepest, slope(best + 1));
            edges_.push_back({u.x, u.y, begin + sample_step * (best + std::clamp(shift, -1.0, 1.0)),
                              double(steepest)});
        }
    }

    /// By the edge profile, around a circle that is known to about a pixel.
    void find_profile_edges(const CircleFit& fit) {
        const EdgeProfile& edge_profile = *settings_.edge_profile;
        const int samples = edge_profile.inside() + edge_profile.outside() + 1;
        profile_.resize(std::size_t(samples));
        for (const Vec2& u : directions(settings_.rays)) {
            const Vec2 first = fit.centre +
                               (fit.radius - EdgeProfile::step * edge_profile.inside()) * u,
                       last = fit.centre +
                              (fit.radius + EdgeProfile::step * edge_profile.outside()) * u;
            if (!can_sample(image_, first) || !can_sample(image_, last)) continue;
            if (std::any_of(settings_.others.begin(), settings_.others.end(),
                            [&](const NearCircle& o) {
                                const Vec2 d = last - o.centre;
                                return dot(d, d) < o.radius * o.radius;
                            }))
                continue;
            sample_ray(image_, first, EdgeProfile::step * u, samples, profile_.data());
            const EdgeProfile::Edge edge = edge_profile.find(profile_.data());
            if (!edge.found || polarity_ * edge.contrast <= 0.0) continue;
            edges_.push_back({u.x, u.y, fit.radius + edge.position, std::abs(edge.contrast),
                              edge.residual, std::max(0.0, edge.sharpness)});
        }
    }

    /// A ray's weight grows with the sharpness of its edge. The power below 1 and the bound limit
    /// the weight of a dark patch of texture at the edge, which is sharp in the wrong position.
    void weigh_by_sharpness() {
        constexpr double power = 0.6, max_ratio = 4.0;
        values_.clear();
        for (const RayEdge& e : edges_) values_.push_back(e.weight);
        const double typical = median_in_place(values_);
        for (RayEdge& e : edges_)
            e.weight =
                typical > 0.0 ? std::pow(std::min(e.weight / typical, max_ratio), power) : 1.0;
    }

    static double residual_of(const RayEdge& e, double radius, const double (&d)[3]) {
        return e.distance - radius - e.ux * d[0] - e.uy * d[1] - d[2];
    }

    /// Reweights until the step is constant, with a scale that shrinks to that of the inliers.
    /// Nothing if the normal matrix is singular.
    std::optional<Step> solve_reweighted(const CircleFit& fit, double window) {
        Step step;
        auto& d = step.d;
        if (settings_.free_radius) {  // the median is a start that half of the rays cannot move
            values_.clear();
            for (const RayEdge& e : edges_) values_.push_back(e.distance - fit.radius);
            d[2] = median_in_place(values_);
        }
        double scale = window;
        for (int pass = 0; pass < max_passes; ++pass) {
            double m[3][3] = {}, b[3] = {}, x[3];
            values_.clear();
            for (const RayEdge& e : edges_) {
                const double residual = residual_of(e, fit.radius, d);
                values_.push_back(std::abs(residual));
                const double q = residual / (tukey_cutoff * scale);
                if (q * q >= 1.0) continue;
                // This order of the factors fixes the rounding.
                const double w = e.weight * (1.0 - q * q) * (1.0 - q * q);
                const double y = e.distance - fit.radius;
                const double j[3] = {e.ux, e.uy, 1.0};
                for (int r = 0; r < 3; ++r) {
                    for (int c = r; c < 3; ++c) m[r][c] += w * j[r] * j[c];
                    b[r] += w * j[r] * y;
                }
            }
            if (!settings_.free_radius) {  // the change of the radius is 0
                m[0][2] = m[1][2] = b[2] = 0.0;
                m[2][2] = 1.0;
            }
            if (!solve(m, b, x, step.inverse)) return std::nullopt;
            double moved = 0.0;
            for (int r = 0; r < 3; ++r) moved += std::abs(x[r] - d[r]), d[r] = x[r];
            scale = std::max(mad_to_sigma * median_in_place(values_), min_scale);
            scale = std::min(scale, window);
            if (pass >= min_passes && moved < settled) break;
        }
        return step;
    }

    /// Sets what the edges on the circle say of it; false if they are too few.
    bool rate(CircleFit& fit, const Step& step) {
        values_.clear();
        double square = 0.0, profile_residual = 0.0;
        std::size_t on = 0;
        for (const RayEdge& e : edges_) {
            const double residual = residual_of(e, fit.radius - step.d[2], step.d);
            if (std::abs(residual) > settings_.tolerance) continue;
            square += residual * residual;
            values_.push_back(e.slope);
            profile_residual += e.profile_residual;
            ++on;
        }
        if (on > 0) fit.profile_residual = profile_residual / double(on);
        fit.support = std::max(fit.support, double(on) / settings_.rays);
        if (on < min_on_circle) return false;
        fit.contrast = median_in_place(values_);
        fit.residual = std::sqrt(square / double(on - 2));
        fit.error = fit.residual * std::sqrt(0.5 * (step.inverse[0] + step.inverse[1]));
        fit.good = true;
        return true;
    }

    const cv::Mat& image_;
    Polarity polarity_;
    const RaySettings& settings_;
    std::vector<RayEdge> edges_;
    std::vector<float> profile_;
    std::vector<double> values_;
};

/// Votes, counted in square cells.
class Votes {
  public:
    Votes(cv::Size size, double radius, Polarity polarity)
        : radius_(radius), polarity_(polarity), scatter_(least_scatter + scatter_share * radius) {
        cell_ = std::max(1, int(scatter_ / cells_in_scatter));
        spread_ = scatter_ / cell_;
        // The centre of the first cell is (cell − 1)/2 pixels from that of the first pixel.
        origin_ = 0.5f * float(cell_ - 1);
        const cv::Size cells((size.width + cell_ - 1) / cell_, (size.height + cell_ - 1) / cell_);
        votes_ = cv::Mat::zeros(cells, CV_32F);
    }

    void count(const std::vector<EdgePixel>& edges) {
        const auto step = float(polarity_ * radius_);
        const auto scale = 1.0f / float(cell_);
        for (const EdgePixel& e : edges) {
            const float x = scale * (e.x + step * e.gx - origin_),
                        y = scale * (e.y + step * e.gy - origin_);
            if (!(x >= 0.0f && y >= 0.0f)) continue;
            const int column = int(x), row = int(y);
            if (column + 1 >= votes_.cols || row + 1 >= votes_.rows) continue;
            const float u = x - float(column), v = y - float(row);
            float* above = votes_.ptr<float>(row) + column;
            float* below = votes_.ptr<float>(row + 1) + column;
            above[0] += e.weight * (1.0f - u) * (1.0f - v);
            above[1] += e.weight * u * (1.0f - v);
            below[0] += e.weight * (1.0f - u) * v;
            below[1] += e.weight * u * v;
        }
        const int side = 2 * int(std::ceil(kernel_reach * spread_)) + 1;
        cv::GaussianBlur(votes_, votes_, cv::Size(side, side), spread_, spread_,
                         cv::BORDER_CONSTANT);
    }

    std::vector<CircleCandidate> maxima(double min_support) const {
        // Votes of a whole circumference, after the smoothing.
        const double own = own_spread + own_spread_share * radius_;
        const double whole = ridge_share * 2.0 * pi * radius_ /
                             (2.0 * pi * (spread_ * spread_ + own * own / (cell_ * cell_)));
        const auto threshold = float(min_support * whole);
        std::vector<CircleCandidate> found;
        for (int row = 1; row + 1 < votes_.rows; ++row) {
            const float* v = votes_.ptr<float>(row);
            for (int column = 1; column + 1 < votes_.cols; ++column) {
                const float here = v[column];
                if (here < threshold || here < v[column - 1] || here <= v[column + 1]) continue;
                const float* above = votes_.ptr<float>(row - 1) + column;
                const float* below = votes_.ptr<float>(row + 1) + column;
                if (here < above[0] || here <= below[0] || here < above[-1] || here < above[1] ||
                    here <= below[-1] || here <= below[1])
                    continue;
                const double x = column + vertex_offset(v[column - 1], here, v[column + 1]),
                             y = row + vertex_offset(above[0], here, below[0]);
                found.push_back({{cell_ * x + double(origin_), cell_ * y + double(origin_)},
                                 radius_,
                                 polarity_,
                                 double(here) / whole});
            }
        }
        return found;
    }

  private:
    // Votes scatter about the centre by the grid of pixels, and by a few degrees of the gradient's
    // direction, which is a share of the radius. If that is many pixels, cells have several pixels.
    static constexpr double least_scatter = 0.7, scatter_share = 0.07;  // pixels; of the radius
    static constexpr double cells_in_scatter = 1.6;  // standard deviations of votes, at least
    static constexpr double kernel_reach = 2.2;      // standard deviations of the smoothing
    static constexpr double own_spread = 0.5, own_spread_share = 0.05;  // before the smoothing
    static constexpr double ridge_share = 0.9;  // of the circumference that edge_pixels() returns

    double radius_;
    Polarity polarity_;
    double scatter_, spread_ = 0.0;
    int cell_ = 1;
    float origin_ = 0.0f;
    cv::Mat votes_;
};

/// The least slope of an edge: an edge may be faint if it is above the noise.
float min_edge_slope(const cv::Mat& steepness) {
    constexpr int row_stride = 5, column_stride = 3;  // a sample of 1/15 of the pixels is enough
    constexpr double length_median = 1.18;            // of a vector of two standard normal deviates
    constexpr std::size_t high_percent = 97;
    // Lower bounds of the slope: in standard deviations of the noise, relative to the slope at the
    // high percentile, and in grey levels/pixel.
    constexpr double above_noise = 3.5, of_high = 0.12, absolute = 0.25;
    std::vector<double> sample;
    for (int row = 1; row < steepness.rows; row += row_stride) {
        const float* s = steepness.ptr<float>(row);
        for (int column = 1; column < steepness.cols; column += column_stride)
            sample.push_back(double(s[column]));
    }
    if (sample.empty()) return float(absolute);
    const double noise = median(sample) / length_median;
    const auto high = sample.begin() + std::ptrdiff_t(sample.size() * high_percent / 100);
    std::nth_element(sample.begin(), high, sample.end());
    return float(std::max({above_noise * noise, of_high * *high, absolute}));
}

constexpr double kernel_reach = 2.5;  // standard deviations; OpenCV's default for floats is 4
constexpr double full_size = 0.999;   // from this reduction on, `small` has the size of the frame
constexpr int min_side = 8;           // side of `small`, pixels: less has no edges to vote
constexpr double reduced_blur = 1.0;  // blur of `small`, pixels: averaging has smoothed it already
constexpr double unreduced_blur = 1.4;  // the same at full size: nothing was averaged

void smooth(const cv::Mat& from, cv::Mat& to, double deviation) {
    const int side = 2 * int(std::ceil(kernel_reach * deviation)) + 1;
    cv::GaussianBlur(from, to, cv::Size(side, side), deviation, deviation, cv::BORDER_REPLICATE);
}

}  // namespace

float level_at(const cv::Mat& image, const Vec2& p) {
    const int column = std::clamp(int(p.x), 0, image.cols - 2),
              row = std::clamp(int(p.y), 0, image.rows - 2);
    const auto u = float(p.x - column), v = float(p.y - row);
    const float *above = image.ptr<float>(row) + column, *below = above + image.step1();
    return (1 - v) * ((1 - u) * above[0] + u * above[1]) + v * ((1 - u) * below[0] + u * below[1]);
}

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
    // Distances of discs in contact rise steeply and fall off slowly: the onset lies on the rise,
    // halfway between its half height and the maximum.
    constexpr double step = 0.2;  // windows: finer than the onset is known
    double half = at;
    while (2 * number(half) > maximum && half > sorted.front()) half -= step * width;
    return 0.5 * (half + at) + width;
}

double gradient_noise(const cv::Mat& image) {
    constexpr int row_stride = 7, column_stride = 3;  // a sample of 1/21 of the pixels is enough
    constexpr double normal_median = 0.6745;          // median |x| of a standard normal deviate
    std::vector<double> slopes;
    for (int row = 1; row + 1 < image.rows; row += row_stride) {
        const float* p = image.ptr<float>(row);
        for (int column = 1; column + 1 < image.cols; column += column_stride)
            slopes.push_back(std::abs(0.5 * double(p[column + 1] - p[column - 1])));
    }
    return median(slopes) / normal_median;
}

std::vector<EdgePixel> edge_pixels(const cv::Mat& image) {
    constexpr double scharr = 1.0 / 32.0;  // makes the Scharr kernel a derivative per pixel
    constexpr float diagonal = 2.414f;     // tan 67.5°: within it the gradient is along an axis
    cv::Mat dx, dy, steepness;
    cv::Scharr(image, dx, CV_32F, 1, 0, scharr);
    cv::Scharr(image, dy, CV_32F, 0, 1, scharr);
    cv::magnitude(dx, dy, steepness);
    const float minimum = min_edge_slope(steepness);
    std::vector<EdgePixel> edges;
    for (int row = 1; row + 1 < image.rows; ++row) {
        const float* s = steepness.ptr<float>(row);
        for (int column = 1; column + 1 < image.cols; ++column) {
            const float here = s[column];
            if (here < minimum) continue;
            const float gx = dx.ptr<float>(row)[column], gy = dy.ptr<float>(row)[column];
            // The ridge: steeper than both neighbours along the gradient.
            const float ax = std::abs(gx), ay = std::abs(gy);
            const bool along_x = ax > diagonal * ay, along_y = ay > diagonal * ax;
            const bool same_sign = (gx > 0.0f) == (gy > 0.0f);
            const int rows = along_x ? 0 : 1, columns = along_y ? 0 : along_x || same_sign ? 1 : -1;
            const float one = steepness.ptr<float>(row - rows)[column - columns],
                        other = steepness.ptr<float>(row + rows)[column + columns];
            if (here < one || here <= other) continue;
            edges.push_back({float(column), float(row), gx / here, gy / here,
                             std::min(1.0f, here / (2.0f * minimum))});
        }
    }
    return edges;
}

std::vector<CircleCandidate> vote(const std::vector<EdgePixel>& edges, cv::Size size, double radius,
                                  Polarity polarity, double min_support, std::size_t max_count) {
    Votes votes(size, radius, polarity);
    votes.count(edges);
    std::vector<CircleCandidate> found = votes.maxima(min_support);
    std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
        return a.support != b.support     ? a.support > b.support
               : a.centre.y != b.centre.y ? a.centre.y < b.centre.y
                                          : a.centre.x < b.centre.x;
    });
    const double near = std::max(1, int(0.5 * radius));
    std::vector<CircleCandidate> separate;
    for (const CircleCandidate& c : found) {
        if (separate.size() == max_count) break;
        const bool taken = std::any_of(separate.begin(), separate.end(), [&](const auto& other) {
            const Vec2 d = other.centre - c.centre;
            return dot(d, d) < near * near;
        });
        if (!taken) separate.push_back(c);
    }
    return separate;
}

CircleFit fit_circle(const cv::Mat& image, Vec2 centre, double radius, Polarity polarity,
                     const RaySettings& settings) {
    constexpr int max_rounds = 4, first_profile_round = 2;    // slopes first lead to within a pixel
    constexpr double settled = 0.02, settled_profile = 0.05;  // pixels; a profile round costs more
    constexpr double later_window = 0.6, min_window = 2.0;    // of the first window; pixels
    RayCircleFit rays(image, polarity, settings);
    CircleFit fit{centre, radius};
    CircleFit by_slopes = fit;
    double window = settings.window;
    for (int round = settings.edge_profile_alone ? first_profile_round : 0; round < max_rounds;
         ++round) {
        const bool by_profile = settings.edge_profile && round >= first_profile_round;
        if (round == first_profile_round) by_slopes = fit;
        const std::optional<double> moved = rays.improve(fit, window, by_profile);
        if (!moved) return by_profile ? by_slopes : fit;
        window = std::max(std::min(settings.window, min_window), later_window * settings.window);
        if (settings.edge_profile ? round == first_profile_round && *moved < settled_profile
                                  : round > 0 && *moved < settled)
            break;
    }
    return fit;
}

EdgeProfile::Columns EdgeProfile::terms(double e, bool bent) const {
    constexpr double kernel_step = 0.05;  // pixels: resolves the cusp of the square root
    constexpr double kernel_reach = 3.5;  // standard deviations
    const int half = int(std::ceil(kernel_reach * blur_ / kernel_step));
    std::vector<double> kernel;
    double sum = 0.0;
    for (int k = -half; k <= half; ++k) {
        kernel.push_back(std::exp(-0.5 * k * k * kernel_step * kernel_step / (blur_ * blur_)));
        sum += kernel.back();
    }
    Columns q;
    for (int j = 0; j < inside_ + outside_ + 1; ++j) {
        const double x = step * (j - inside_);
        std::array<double, columns> value{1.0};
        for (int k = -half; k <= half; ++k) {
            const double depth = e - (x + k * kernel_step);
            if (depth <= 0.0) break;  // this and all further points lie outside the edge
            const double w = kernel[std::size_t(k + half)] / sum;
            value[1] += w;
            value[2] += w * std::sqrt(depth);
            if (bent) value[3] += w * depth;
        }
        for (std::size_t c = 0; c < columns; ++c) q[c].push_back(value[c]);
    }
    return q;
}

EdgeProfile::EdgeProfile(double blur, int inside, int outside, double reach, bool bent)
    : blur_(blur), inside_(inside), outside_(outside), first_(-reach) {
    constexpr std::size_t lanes = 8;        // candidates are padded to whole vector registers
    constexpr double vanishing = 1e-6;      // norm of a term that is zero within the window
    constexpr double contrast_depth = 3.0;  // pixels inside the edge, for the contrast
    candidates_ = std::size_t(2.0 * reach / spacing + 1.5);
    stride_ = (candidates_ + lanes - 1) / lanes * lanes;
    for (std::size_t c = 0; c < columns; ++c) {
        q_[c].assign(stride_ * std::size_t(inside + outside + 1), 0.0f);
        contrast_[c].assign(candidates_, 0.0);
    }
    for (std::size_t candidate = 0; candidate < candidates_; ++candidate) {
        Columns q = terms(first_ + spacing * double(candidate), bent);
        // Gram–Schmidt, twice because of its rounding errors. `made` stores how the columns follow
        // from the terms f: q_c = Σ made[c][d] f_d.
        std::array<std::array<double, columns>, columns> made{};
        for (std::size_t c = 0; c < columns; ++c) {
            made[c][c] = 1.0;
            for (int twice = 0; twice < 2; ++twice)
                for (std::size_t d = 0; d < c; ++d) {
                    double product = 0.0;
                    for (std::size_t j = 0; j < q[c].size(); ++j) product += q[c][j] * q[d][j];
                    for (std::size_t j = 0; j < q[c].size(); ++j) q[c][j] -= product * q[d][j];
                    for (std::size_t m = 0; m < columns; ++m) made[c][m] -= product * made[d][m];
                }
            double norm = 0.0;
            for (const double v : q[c]) norm += v * v;
            norm = std::sqrt(norm);
            const double scale = norm > vanishing ? 1.0 / norm : 0.0;
            for (double& m : made[c]) m *= scale;
            for (std::size_t j = 0; j < q[c].size(); ++j) {
                q[c][j] *= scale;
                q_[c][j * stride_ + candidate] = float(q[c][j]);
            }
        }
        // The mean of h + s √d + t d over the depth: its integrals are 1, 2/3 √depth and depth/2.
        for (std::size_t c = 0; c < columns; ++c)
            contrast_[c][candidate] = made[c][1] +
                                      2.0 / 3.0 * std::sqrt(contrast_depth) * made[c][2] +
                                      0.5 * contrast_depth * made[c][3];
    }
}

EdgeProfile::Edge EdgeProfile::find(const float* profile) const {
    constexpr std::size_t max_candidates = 64;  // enough for a reach of 7 pixels
    const auto samples = std::size_t(inside_ + outside_ + 1);
    std::array<std::array<float, max_candidates>, columns> products;
    const std::size_t stride = std::min(stride_, max_candidates);
    for (std::size_t c = 0; c < columns; ++c) {
        float* const sum = products[c].data();
        for (std::size_t k = 0; k < stride; ++k) sum[k] = 0.0f;
        const float* q = q_[c].data();
        for (std::size_t j = 0; j < samples; ++j, q += stride_) {
            const float value = profile[j];
            for (std::size_t k = 0; k < stride; ++k) sum[k] += q[k] * value;
        }
    }
    Edge edge;
    std::array<float, max_candidates> explained{};
    std::size_t best = 0;
    for (std::size_t k = 0; k < candidates_; ++k) {
        for (std::size_t c = 0; c < columns; ++c) explained[k] += products[c][k] * products[c][k];
        if (explained[k] > explained[best]) best = k;
    }
    if (best == 0 || best + 1 == candidates_) return edge;
    const double before = double(explained[best - 1]), here = double(explained[best]),
                 after = double(explained[best + 1]);
    edge.position = first_ + spacing * (double(best) + vertex_offset(before, here, after));
    double square = 0.0;
    for (std::size_t j = 0; j < samples; ++j) square += double(profile[j]) * double(profile[j]);
    edge.residual = std::max(0.0, square - here) / double(samples);
    for (std::size_t c = 0; c < columns; ++c)
        edge.contrast += double(products[c][best]) * contrast_[c][best];
    edge.sharpness = -(before - 2.0 * here + after) / (spacing * spacing);
    edge.found = true;
    return edge;
}

PreparedFrame::PreparedFrame(const cv::Mat& grey, double reduction, double blur)
    : shrink(reduction) {
    grey.convertTo(sharp, CV_32F);
    if (shrink < full_size) {
        const cv::Size size(std::max(min_side, cvRound(grey.cols * shrink)),
                            std::max(min_side, cvRound(grey.rows * shrink)));
        cv::Mat reduced;
        cv::resize(grey, reduced, size, 0, 0, cv::INTER_AREA);
        shrink = double(size.width) / grey.cols;
        reduced.convertTo(reduced, CV_32F);
        smooth(reduced, small, reduced_blur);
    } else {
        shrink = 1.0;
        smooth(sharp, small, unreduced_blur);
    }
    smooth(sharp, sharp, blur);
    edges = edge_pixels(small);
    noise = gradient_noise(sharp);
}

// The centre of pixel k of `small` lies at (k + ½)/shrink − ½ in `sharp`.
Vec2 PreparedFrame::to_sharp(const Vec2& p) const {
    return {(p.x + 0.5) / shrink - 0.5, (p.y + 0.5) / shrink - 0.5};
}
Vec2 PreparedFrame::to_small(const Vec2& p) const {
    return {(p.x + 0.5) * shrink - 0.5, (p.y + 0.5) * shrink - 0.5};
}

}  // namespace swirl::tracking
