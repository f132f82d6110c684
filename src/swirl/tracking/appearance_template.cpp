#include "swirl/tracking/appearance_template.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <opencv2/imgproc.hpp>

#include "swirl/math/unit_circle.hpp"
#include "swirl/run/parallel_for.hpp"

namespace swirl {

namespace {

constexpr float nowhere = -1e30f;    // no excess there
constexpr double step = 0.5;         // of the mean ball's grid, pixels
constexpr double beyond = 3.5;       // pixels that are looked at outside of the edge
constexpr double near_others = 1.0;  // pixels next to another ball that its blur reaches
constexpr double gain_varies = 0.2, mode_varies = 0.15;
constexpr std::size_t modes = 4;
/// Neighbouring pixels leave the same rest: texture, and what compression makes of it.
constexpr double pixels_of_a_patch = 4.0;

int half_of(double radius) { return static_cast<int>((radius + beyond + 1.5) / step) + 1; }

/// T, its slopes, and nothing, of a point of the grid; side by side in a register.
typedef float OnGrid __attribute__((vector_size(16)));
OnGrid four_at(const float* from) {
    OnGrid four;
    std::memcpy(&four, from, sizeof four);
    return four;
}

/// A row of pixels on the grid: heights and offsets are in pixels from the ball's middle. Linear
/// between the grid's points.
class GridRow {
  public:
    GridRow(const cv::Mat& grid, double y)
        : half_(0.5f * static_cast<float>(grid.cols - 1)),
          last_(static_cast<float>(grid.cols) - 1.001f) {
        const double v = std::clamp(y / step + 0.5 * (grid.rows - 1), 0.0, grid.rows - 1.001);
        const int row = static_cast<int>(v);
        q_ = static_cast<float>(v - row);
        above_ = grid.ptr<float>(row);
        below_ = grid.ptr<float>(row + 1);
    }
    OnGrid at(float x) const {
        constexpr auto per_pixel = static_cast<float>(1.0 / step);
        const float u = std::min(std::max(x * per_pixel + half_, 0.0f), last_);
        const int column = static_cast<int>(u);
        const float p = u - static_cast<float>(column);
        const float a = (1.0f - q_) * (1.0f - p), b = (1.0f - q_) * p, c = q_ * (1.0f - p),
                    d = q_ * p;
        const float *above = above_ + 4 * column, *below = below_ + 4 * column;
        return (a * four_at(above) + b * four_at(above + 4)) +
               (c * four_at(below) + d * four_at(below + 4));
    }

  private:
    const float *above_, *below_;
    float half_, last_, q_;
};

/// tanh to a fortieth, smooth up to where it ends at ±1; several at once.
inline float bounded(float x) {
    const float y = std::min(std::max(x, -3.0f), 3.0f), square = y * y;
    return y * (27.0f + square) / (27.0f + 9.0f * square);
}

/// Solves A x = b, symmetric and positive, in place; false if it is not.
template <std::size_t n>
bool solve_system(std::array<std::array<double, n>, n>& a, std::array<double, n>& b) {
    for (std::size_t c = 0; c < n; ++c) {
        if (!(a[c][c] > 1e-12)) return false;
        for (std::size_t r = c + 1; r < n; ++r) {
            const double f = a[r][c] / a[c][c];
            for (std::size_t k = c; k < n; ++k) a[r][k] -= f * a[c][k];
            b[r] -= f * b[c];
        }
    }
    for (std::size_t c = n; c-- > 0;) {
        for (std::size_t k = c + 1; k < n; ++k) b[c] -= a[c][k] * b[k];
        b[c] /= a[c][c];
    }
    return true;
}

/// Those beads at other places.
std::vector<Particle> at_places(std::vector<Particle> particles, const std::vector<Vec2>& places) {
    for (std::size_t i = 0; i < particles.size(); ++i) particles[i].centre = places[i];
    return particles;
}

/// Mean square by which hard discs lie in each other, of those that are near.
double overlap(const std::vector<AppearanceTemplate::Example>& examples,
               const std::vector<std::vector<Vec2>>& edges,
               const std::vector<std::vector<Vec2>>& ball, double counts,
               const ParticleLook& look) {
    double square = 0.0;
    std::size_t pairs = 0;
    for (std::size_t k = 0; k < examples.size(); ++k) {
        const std::vector<Particle>& particles = examples[k].particles;
        std::vector<Vec2> places;
        for (std::size_t i = 0; i < particles.size(); ++i)
            places.push_back(look.lens
                                 .ideal({(1.0 - counts) * edges[k][i] + counts * ball[k][i],
                                         look.kinds[particles[i].kind].radius})
                                 .centre);
        for (std::size_t a = 0; a < particles.size(); ++a)
            for (std::size_t b = a + 1; b < particles.size(); ++b) {
                if (!particles[a].sure || !particles[b].sure) continue;
                const double sum =
                    look.kinds[particles[a].kind].radius + look.kinds[particles[b].kind].radius;
                const double gap = length(places[a] - places[b]) - sum;
                if (std::abs(gap) > 0.125 * sum) continue;
                ++pairs;
                square += gap < 0.0 ? gap * gap : 0.0;
            }
    }
    return pairs < 100 ? 0.0 : square / double(pairs);
}

}  // namespace

std::vector<NearCircle> sure_others(const std::vector<Particle>& all, const Particle& self,
                                    const ParticleLook& look) {
    constexpr double looked_at = 7.0;  // pixels beyond both
    std::vector<NearCircle> others;
    const double own = look.lens.seen_radius(self.centre, look.kinds[self.kind].radius);
    for (const Particle& b : all) {
        if (&b == &self || !b.sure) continue;
        const double radius = look.lens.seen_radius(b.centre, look.kinds[b.kind].radius);
        if (length(b.centre - self.centre) < own + radius + looked_at)
            others.push_back({b.centre, radius});
    }
    return others;
}

/// 255 where the floor can be seen.
cv::Mat AppearanceTemplate::free_floor(const cv::Size& size, const CircleFit& rim,
                                       const std::vector<Particle>& particles) const {
    cv::Mat mask = cv::Mat::zeros(size, CV_8U);
    const auto fill = [&](const Vec2& centre, double radius, int level) {
        cv::circle(mask, {cvRound(centre.x), cvRound(centre.y)}, static_cast<int>(radius), level,
                   cv::FILLED);
    };
    fill(rim.centre, reach_ - 3.0, 255);
    for (const Particle& b : particles) fill(b.centre, look_.kinds[b.kind].radius + 4.0, 0);
    return mask;
}

double AppearanceTemplate::illumination(const cv::Mat& sharp, const CircleFit& rim,
                                        const std::vector<Particle>& particles) const {
    if (floor_.empty()) return 1.0;
    const cv::Mat open = free_floor(sharp.size(), rim, particles);
    std::vector<double> ratios;
    constexpr int stride = 3;
    for (int row = 0; row < sharp.rows; row += stride) {
        const std::uint8_t* free = open.ptr(row);
        const float *here = sharp.ptr<float>(row), *floor = floor_.ptr<float>(row);
        for (int column = 0; column < sharp.cols; column += stride)
            if (free[column] && floor[column] > 1.0f)
                ratios.push_back(double(here[column] / floor[column]));
    }
    return ratios.size() < 30 ? 1.0 : median(ratios);
}

void AppearanceTemplate::learn_floor(const std::vector<Example>& examples, unsigned threads) {
    const cv::Size size = examples.front().sharp.size();
    // Twice: the lamp of a picture is known after its floor.
    for (int round = 0; round < 2; ++round) {
        std::vector<float> of_lamps;
        for (const Example& e : examples)
            of_lamps.push_back(static_cast<float>(1.0 / illumination(e.sharp, e.rim, e.particles)));
        cv::Mat sum = cv::Mat::zeros(size, CV_32F), known = cv::Mat::zeros(size, CV_32F);
        std::vector<cv::Mat> taken;
        for (const Example& e : examples) taken.push_back(free_floor(size, e.rim, e.particles));
        constexpr int rows_at_once = 16;
        const auto median_of_rows = [&](std::size_t part) {
            std::vector<float> levels;
            const int begin = rows_at_once * static_cast<int>(part);
            for (int row = begin; row < std::min(begin + rows_at_once, size.height); ++row)
                for (int column = 0; column < size.width; ++column) {
                    levels.clear();
                    for (std::size_t k = 0; k < examples.size(); ++k)
                        if (taken[k].at<std::uint8_t>(row, column))
                            levels.push_back(examples[k].sharp.at<float>(row, column) *
                                             of_lamps[k]);
                    if (levels.empty()) continue;
                    const auto middle =
                        levels.begin() + static_cast<std::ptrdiff_t>(levels.size() / 2);
                    std::nth_element(levels.begin(), middle, levels.end());
                    sum.at<float>(row, column) = *middle;
                    known.at<float>(row, column) = 1.0f;
                }
        };
        parallel_for(static_cast<std::size_t>((size.height + rows_at_once - 1) / rows_at_once),
                     median_of_rows, threads);
        // Where nobody ever made room it is as nearby.
        cv::Mat narrow_sum, narrow, wide_sum, wide;
        cv::GaussianBlur(sum, narrow_sum, {}, 2.0);
        cv::GaussianBlur(known, narrow, {}, 2.0);
        cv::GaussianBlur(sum, wide_sum, {}, 0.7 * look_.radius());
        cv::GaussianBlur(known, wide, {}, 0.7 * look_.radius());
        cv::Mat made = cv::Mat::zeros(size, CV_32F);
        for (int row = 0; row < size.height; ++row)
            for (int column = 0; column < size.width; ++column) {
                const float n = narrow.at<float>(row, column), w = wide.at<float>(row, column);
                if (n > 0.3f)
                    made.at<float>(row, column) = narrow_sum.at<float>(row, column) / n;
                else if (w > 1e-4f)
                    made.at<float>(row, column) = wide_sum.at<float>(row, column) / w;
            }
        floor_ = made;
    }
}

AppearanceTemplate::Excess AppearanceTemplate::excess(
    const cv::Mat& sharp, const CircleFit& rim, const std::vector<Particle>& particles) const {
    Excess made;
    made.container = rim.centre;
    made.level = cv::Mat(sharp.size(), CV_32F, cv::Scalar(double(nowhere)));
    const auto of_illumination = static_cast<float>(1.0 / illumination(sharp, rim, particles));
    const auto soft = static_cast<float>(soft_);
    const auto steep = static_cast<float>(look_.polarity / soft_);
    const double reach = reach_ - 0.5;
    for (int row = 0; row < sharp.rows; ++row) {
        const double y = double(row) - rim.centre.y;
        if (std::abs(y) > reach) continue;
        const double half = std::sqrt(reach * reach - y * y);
        const int from = std::max(0, static_cast<int>(std::ceil(rim.centre.x - half)));
        const int to = std::min(sharp.cols - 1, static_cast<int>(rim.centre.x + half));
        const float* in = sharp.ptr<float>(row);
        const float* floor = floor_.ptr<float>(row);
        float* out = made.level.ptr<float>(row);
        for (int column = from; column <= to; ++column) {
            const float level =
                soft * bounded(steep * (in[column] * of_illumination - floor[column]));
            out[column] = floor[column] > 0.0f ? level : nowhere;
        }
    }
    return made;
}

template <typename Use>
void AppearanceTemplate::each_row(const Excess& excess, const Vec2& centre, std::size_t kind,
                                  const std::vector<NearCircle>& others, int stride,
                                  Use&& use) const {
    const double radius = balls_[kind].radius;
    const double scale = look_.lens.seen_radius(centre, radius) / radius;
    const double reach = scale * radius + beyond;
    const int top = std::max(0, static_cast<int>(std::ceil(centre.y - reach))),
              bottom = std::min(excess.level.rows - 1, static_cast<int>(centre.y + reach));
    std::vector<char> hidden;  // by others, of a row
    for (int row = top; row <= bottom; row += stride) {
        const double y = double(row) - centre.y;
        const double half = std::sqrt(std::max(0.0, reach * reach - y * y));
        const int from = std::max(0, static_cast<int>(std::ceil(centre.x - half))),
                  to = std::min(excess.level.cols - 1, static_cast<int>(centre.x + half));
        if (to < from) continue;
        hidden.assign(static_cast<std::size_t>(to - from + 1), 0);
        for (const NearCircle& o : others) {
            const double reach_of = o.radius + near_others, up = double(row) - o.centre.y;
            if (std::abs(up) >= reach_of) continue;
            const double wide = std::sqrt(reach_of * reach_of - up * up);
            const int first = std::max(from, static_cast<int>(std::ceil(o.centre.x - wide))),
                      last = std::min(to, static_cast<int>(std::floor(o.centre.x + wide)));
            for (int c = first; c <= last; ++c) hidden[static_cast<std::size_t>(c - from)] = 1;
        }
        const float* level = excess.level.ptr<float>(row);
        for (int column = from; column <= to; column += stride) {
            char& none = hidden[static_cast<std::size_t>(column - from)];
            none = static_cast<char>(none | (level[column] == nowhere ? 1 : 0));
        }
        use(Row{row, from, to, level, hidden.data(), scale});
    }
}

template <typename Use>
void AppearanceTemplate::each_pixel(const Excess& excess, const Vec2& centre, std::size_t kind,
                                    const std::vector<NearCircle>& others, int stride,
                                    Use&& use) const {
    each_row(excess, centre, kind, others, stride, [&](const Row& r) {
        for (int column = r.from; column <= r.to; column += stride)
            if (!r.hidden[column - r.from])
                use(Vec2{double(column), double(r.row)}, r.level[column], r.scale);
    });
}

double AppearanceTemplate::score(const Excess& excess, const Vec2& centre, std::size_t kind,
                                 const std::vector<NearCircle>& others, int stride) const {
    // What is hidden says nothing, for it or against it.
    double rest = 0.0, all = 0.0, scaled = 1.0;
    each_row(excess, centre, kind, others, stride, [&](const Row& r) {
        const GridRow grid(balls_[kind].grid, (r.row - centre.y) / r.scale);
        const auto shrink = static_cast<float>(1.0 / r.scale),
                   begin = static_cast<float>(r.from - centre.x);
        float row_rest = 0.0f, row_all = 0.0f;
        for (int column = 0; column <= r.to - r.from; column += stride) {
            if (r.hidden[column]) continue;
            const float t = grid.at(shrink * (begin + static_cast<float>(column)))[0];
            const float e = r.level[r.from + column];
            row_rest += (e - t) * (e - t);
            row_all += t * t;
        }
        rest += double(row_rest);
        all += double(row_all);
        scaled = r.scale;
    });
    return (all - rest) * stride * stride / (balls_[kind].squares * scaled * scaled);
}

bool AppearanceTemplate::inside(const Excess& excess, const Vec2& centre, std::size_t kind) const {
    constexpr double loose = 0.2;  // radii
    const double radius = balls_[kind].radius;
    return length(centre - excess.container) + (1.0 - loose) * radius < reach_;
}

double AppearanceTemplate::excess_at(const Excess& excess, const Vec2& place) const {
    const int column = cvRound(place.x), row = cvRound(place.y);
    if (column < 0 || row < 0 || column >= excess.level.cols || row >= excess.level.rows)
        return double(nowhere);
    return double(excess.level.at<float>(row, column));
}

namespace {

/// What a row of pixels gives to the normal equations: with u the offset in radii, sums of T²uᵏ,
/// of T∂ₓT uᵏ, T∂ᵧT uᵏ and T e uᵏ for k = 0 … 3, of four other squares, and of e times T and its
/// slopes.
struct RowSums {
    OnGrid tt{}, tx{}, ty{}, te{}, squares{}, slopes{};
    int pixels = 0;

    void add(const OnGrid& t, float u, float e) {
        const float uu = u * u;
        const OnGrid power{1.0f, u, uu, u * uu};
        const OnGrid left{t[0] * uu, t[1], t[1], t[2]}, right{t[0] * uu, t[1], t[2], t[2]};
        const OnGrid p = t[0] * power;
        tt += t[0] * p;
        tx += t[1] * p;
        ty += t[2] * p;
        te += e * p;
        squares += left * right;
        slopes += e * t;
        ++pixels;
    }
};

}  // namespace

/// A and b of A x = b for the changes of what is fitted: the gain and the modes, of which `made` is
/// there, and the place.
struct AppearanceTemplate::Normal {
    static constexpr std::size_t n = 1 + modes + 2;
    std::array<std::array<double, n>, n> a{};
    std::array<double, n> b{};
    int pixels = 0;

    /// Of a row at v radii; `gain` is what the slopes count.
    void add(const RowSums& s, double v, double gain) {
        // The modes, T (1, u, v, u² − v², 2uv), are T (c₀ + c₁u + c₂u²), row by row.
        const double c[1 + modes][3] = {{1.0, 0.0, 0.0},
                                        {0.0, 1.0, 0.0},
                                        {v, 0.0, 0.0},
                                        {-v * v, 0.0, 1.0},
                                        {0.0, 2.0 * v, 0.0}};
        const double tt[5] = {double(s.tt[0]), double(s.tt[1]), double(s.tt[2]), double(s.tt[3]),
                              double(s.squares[0])};
        const auto with = [](const double(&f)[3], const OnGrid& sums) {
            return f[0] * double(sums[0]) + f[1] * double(sums[1]) + f[2] * double(sums[2]);
        };
        for (std::size_t r = 0; r <= modes; ++r) {
            for (std::size_t k = r; k <= modes; ++k)
                for (std::size_t p = 0; p < 3; ++p)
                    for (std::size_t q = 0; q < 3; ++q) a[r][k] += c[r][p] * c[k][q] * tt[p + q];
            a[r][modes + 1] += gain * with(c[r], s.tx);
            a[r][modes + 2] += gain * with(c[r], s.ty);
            b[r] += with(c[r], s.te);
        }
        a[modes + 1][modes + 1] += gain * gain * double(s.squares[1]);
        a[modes + 1][modes + 2] += gain * gain * double(s.squares[2]);
        a[modes + 2][modes + 2] += gain * gain * double(s.squares[3]);
        b[modes + 1] += gain * double(s.slopes[1]);
        b[modes + 2] += gain * double(s.slopes[2]);
        pixels += s.pixels;
    }
    /// b is that of the picture; what the ball as it is made explains of it is taken off.
    void complete(const std::array<double, 1 + modes>& made) {
        for (std::size_t r = 0; r < n; ++r)
            for (std::size_t k = 0; k < r; ++k) a[r][k] = a[k][r];
        for (std::size_t r = 0; r < n; ++r)
            for (std::size_t k = 0; k <= modes; ++k) b[r] -= a[r][k] * made[k];
    }
};

AppearanceTemplate::Normal AppearanceTemplate::normal(const Excess& excess, const Vec2& centre,
                                                      std::size_t kind,
                                                      const std::vector<NearCircle>& others,
                                                      int stride, double gain) const {
    const Look& ball = balls_[kind];
    Normal sum;
    each_row(excess, centre, kind, others, stride, [&](const Row& r) {
        const double y = (r.row - centre.y) / r.scale;
        const GridRow grid(ball.grid, y);
        const auto shrink = static_cast<float>(1.0 / r.scale),
                   begin = static_cast<float>(r.from - centre.x),
                   radii = static_cast<float>(1.0 / ball.radius);
        RowSums row;
        for (int column = 0; column <= r.to - r.from; column += stride) {
            if (r.hidden[column]) continue;
            const float x = shrink * (begin + static_cast<float>(column));
            row.add(grid.at(x), radii * x, r.level[r.from + column]);
        }
        sum.add(row, y / ball.radius, -gain / r.scale);
    });
    return sum;
}

AppearanceTemplate::Fit AppearanceTemplate::fit(const Excess& excess, const Vec2& centre,
                                                std::size_t kind,
                                                const std::vector<NearCircle>& others,
                                                int stride) const {
    constexpr int rounds = 4;
    constexpr double small_move = 0.1;  // pixels; what is left then is less than a tenth of it
    const Look& ball = balls_[kind];
    Fit fit;
    fit.centre = centre;
    std::array<double, 1 + modes> made{1.0};
    for (int round = 0; round < rounds; ++round) {
        Normal system = normal(excess, fit.centre, kind, others, stride, made[0]);
        if (double(system.pixels) * stride * stride < 0.25 * pi * ball.radius * ball.radius)
            return fit;
        system.complete(made);
        for (std::size_t k = 0; k <= modes; ++k) {
            const double varies = k == 0 ? gain_varies : mode_varies;
            const double patch = std::max(1.0, pixels_of_a_patch / (stride * stride));
            const double weight = variance_ * patch / (varies * varies);
            system.a[k][k] += weight;
            system.b[k] += weight * ((k == 0 ? 1.0 : 0.0) - made[k]);
        }
        if (!solve_system(system.a, system.b)) return fit;
        for (std::size_t k = 0; k <= modes; ++k) made[k] += system.b[k];
        const double maximum = 0.1 * ball.radius;
        const Vec2 move{std::clamp(system.b[modes + 1], -maximum, maximum),
                        std::clamp(system.b[modes + 2], -maximum, maximum)};
        fit.centre = fit.centre + move;
        if (length(move) < small_move) break;
    }
    fit.good = length(fit.centre - centre) < 0.4 * ball.radius;
    return fit;
}

void AppearanceTemplate::learn_ball(const std::vector<Example>& examples,
                                    const std::vector<Excess>& excesses,
                                    const std::vector<std::vector<Vec2>>& places, std::size_t kind,
                                    unsigned threads) {
    Look& ball = balls_[kind];
    const int half = half_of(ball.radius), side = 2 * half + 1;
    struct Sums {
        cv::Mat level, weight;
    };
    std::vector<Sums> sums(examples.size());  // added up in their order
    const auto add_example = [&](std::size_t k) {
        sums[k] = {cv::Mat::zeros(side, side, CV_32F), cv::Mat::zeros(side, side, CV_32F)};
        const std::vector<Particle> moved = at_places(examples[k].particles, places[k]);
        for (const Particle& particle : moved) {
            if (particle.kind != kind || !particle.sure) continue;
            const Vec2 centre = particle.centre;
            each_pixel(excesses[k], centre, kind, sure_others(moved, particle, look_), 1,
                       [&](const Vec2& x, float level, double scale) {
                           const double u = (x.x - centre.x) / (scale * step) + half,
                                        v = (x.y - centre.y) / (scale * step) + half;
                           const int column = static_cast<int>(u), row = static_cast<int>(v);
                           if (column < 0 || row < 0 || column + 1 >= side || row + 1 >= side)
                               return;
                           const auto p = static_cast<float>(u - column),
                                      q = static_cast<float>(v - row);
                           for (int r = 0; r < 2; ++r)
                               for (int c = 0; c < 2; ++c) {
                                   const float w = (r ? q : 1.0f - q) * (c ? p : 1.0f - p);
                                   sums[k].level.at<float>(row + r, column + c) += w * level;
                                   sums[k].weight.at<float>(row + r, column + c) += w;
                               }
                       });
        }
    };
    parallel_for(examples.size(), add_example, threads);
    cv::Mat sum = cv::Mat::zeros(side, side, CV_32F), weight = cv::Mat::zeros(side, side, CV_32F);
    for (const Sums& s : sums) sum += s.level, weight += s.weight;
    cv::GaussianBlur(sum, sum, {}, 0.7);
    cv::GaussianBlur(weight, weight, {}, 0.7);
    cv::Mat level = cv::Mat::zeros(side, side, CV_32F), along_x, along_y;
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column)
            if (weight.at<float>(row, column) > 0.5f)
                level.at<float>(row, column) =
                    sum.at<float>(row, column) / weight.at<float>(row, column);
    ball.squares = std::max(cv::norm(level, cv::NORM_L2SQR) * step * step, 1e-9);
    cv::Scharr(level, along_x, CV_32F, 1, 0, 1.0 / (32.0 * step));
    cv::Scharr(level, along_y, CV_32F, 0, 1, 1.0 / (32.0 * step));
    const cv::Mat nothing = cv::Mat::zeros(level.size(), CV_32F);
    cv::merge(std::vector<cv::Mat>{level, along_x, along_y, nothing}, ball.grid);
}

/// One round of an example: who went where by the ball as it is known.
AppearanceTemplate::Moved AppearanceTemplate::moved(const Example& example, const Excess& seen,
                                                    const std::vector<Vec2>& edges,
                                                    const std::vector<Vec2>& places) const {
    Moved made{places, {}, {}};
    const std::vector<Particle> particles = at_places(example.particles, places);
    for (std::size_t i = 0; i < particles.size(); ++i) {
        if (!particles[i].sure) continue;
        const auto others = sure_others(particles, particles[i], look_);
        const Fit fitted = fit(seen, places[i], particles[i].kind, others);
        if (!fitted.good || length(fitted.centre - edges[i]) > 0.3 * look_.radius()) continue;
        made.places[i] = fitted.centre;
        made.from_edges.push_back(fitted.centre - edges[i]);
        double square = 0.0;
        std::size_t pixels = 0;
        each_pixel(seen, fitted.centre, particles[i].kind, others, 2,
                   [&](const Vec2& x, float level, double scale) {
                       const Vec2 d = (1.0 / scale) * (x - fitted.centre);
                       const GridRow grid(balls_[particles[i].kind].grid, d.y);
                       const auto rest = double(level - grid.at(static_cast<float>(d.x))[0]);
                       square += rest * rest;
                       ++pixels;
                   });
        if (pixels > 0) made.rests.push_back(square / double(pixels));
    }
    return made;
}

std::optional<AppearanceTemplate> AppearanceTemplate::learned(const std::vector<Example>& examples,
                                                              const ParticleLook& look,
                                                              unsigned threads) {
    constexpr int rounds = 4;
    constexpr double good_places = 0.05;        // pixels: edges that need no help
    constexpr std::size_t min_particles = 150;  // of each size
    AppearanceTemplate mean;
    mean.look_ = look;
    std::vector<double> reaches;
    std::vector<std::size_t> number(look.kinds.size(), 0);
    for (const Example& e : examples) {
        double reach = 0.0;
        for (const Particle& b : e.particles)
            if (b.sure) {
                ++number[b.kind];
                reach =
                    std::max(reach, length(b.centre - e.rim.centre) + look.kinds[b.kind].radius);
            }
        if (reach > 0.0) reaches.push_back(reach);
    }
    if (*std::min_element(number.begin(), number.end()) < min_particles) return std::nullopt;
    std::vector<std::vector<Vec2>> edges;
    for (const Example& e : examples) {
        edges.emplace_back();
        for (const Particle& b : e.particles) edges.back().push_back(b.centre);
    }
    const double alone = overlap(examples, edges, edges, 0.0, look);
    if (alone < good_places * good_places) return std::nullopt;
    mean.reach_ = median(reaches);
    // The usual contrast, against what the floor seems to be.
    mean.learn_floor(examples, threads);
    std::vector<double> contrasts;
    for (const Example& e : examples) {
        const double of_illumination = 1.0 / mean.illumination(e.sharp, e.rim, e.particles);
        for (const Particle& b : e.particles) {
            if (!b.sure) continue;
            const int column = cvRound(b.centre.x), row = cvRound(b.centre.y);
            const int near = static_cast<int>(0.5 * look.kinds[b.kind].radius);
            for (int y = -near; y <= near; y += 2)
                for (int x = -near; x <= near; x += 2) {
                    if (column + x < 0 || row + y < 0 || column + x >= e.sharp.cols ||
                        row + y >= e.sharp.rows)
                        continue;
                    contrasts.push_back(
                        look.polarity *
                        (of_illumination * double(e.sharp.at<float>(row + y, column + x)) -
                         double(mean.floor_.at<float>(row + y, column + x))));
                }
        }
    }
    if (contrasts.empty()) return std::nullopt;
    const double contrast = median(contrasts);
    if (!(contrast > 3.0)) return std::nullopt;
    mean.soft_ = 0.38 * contrast;
    for (const ParticleKind& kind : look.kinds) mean.balls_.push_back({kind.radius, 1.0, {}});

    std::vector<Excess> excesses(examples.size());
    parallel_for(
        examples.size(),
        [&](std::size_t k) {
            excesses[k] = mean.excess(examples[k].sharp, examples[k].rim, examples[k].particles);
        },
        threads);
    std::vector<std::vector<Vec2>> places = edges;
    mean.variance_ = 0.01 * mean.soft_ * mean.soft_;
    for (int round = 0; round < rounds; ++round) {
        for (std::size_t kind = 0; kind < look.kinds.size(); ++kind)
            mean.learn_ball(examples, excesses, places, kind, threads);
        std::vector<Moved> moved(examples.size());
        parallel_for(
            examples.size(),
            [&](std::size_t k) {
                moved[k] = mean.moved(examples[k], excesses[k], edges[k], places[k]);
            },
            threads);
        std::vector<double> xs, ys, rests;
        for (const Moved& m : moved) {
            for (const Vec2& d : m.from_edges) xs.push_back(d.x), ys.push_back(d.y);
            rests.insert(rests.end(), m.rests.begin(), m.rests.end());
        }
        if (xs.size() < min_particles) return std::nullopt;
        const Vec2 drift{median(xs), median(ys)};
        for (std::size_t k = 0; k < places.size(); ++k) {
            places[k] = std::move(moved[k].places);
            for (Vec2& p : places[k]) p = p - drift;
        }
        mean.variance_ = median(rests);
    }
    for (std::size_t kind = 0; kind < look.kinds.size(); ++kind)
        mean.learn_ball(examples, excesses, places, kind, threads);
    double best = alone;
    for (double counts = 0.1; counts < 1.05; counts += 0.1) {
        const double square = overlap(examples, edges, places, std::min(counts, 1.0), look);
        if (square < best) best = square, mean.counts_ = std::min(counts, 1.0);
    }
    // Who gains little is left with the edges, which are quicker.
    if (best > 0.7 * alone) return std::nullopt;
    // Half of the pairs seem too near, so a distance errs by √2 of that, and a place by 1/√2 of
    // this.
    mean.error_ = std::sqrt(best);
    return mean;
}

}  // namespace swirl
