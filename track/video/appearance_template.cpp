#include "track/video/appearance_template.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <opencv2/imgproc.hpp>

#include "swirl/math/unit_circle.hpp"
#include "swirl/run/parallel_for.hpp"

namespace swirl::tracking {

namespace {

constexpr float nowhere = -1e30f;    // excess is not defined there
constexpr double step = 0.5;         // step of the template's grid, pixels
constexpr double beyond = 3.5;       // width of the ring outside the edge that is used, pixels
constexpr double near_others = 1.0;  // width of the blur of a neighbour's edge, pixels
constexpr double gain_varies = 0.2;  // standard deviation of its prior
constexpr std::size_t min_particles = 150;  // particles of each species, in all examples
/// Texture and compression correlate the residuals of about this many neighbouring pixels.
constexpr double pixels_of_a_patch = 4.0;

int half_of(double radius) { return int((radius + beyond + 1.5) / step) + 1; }

/// T, ∂ₓT, ∂ᵧT and 0 at a grid point, in one vector register.
typedef float OnGrid __attribute__((vector_size(16)));
OnGrid four_at(const float* from) {
    OnGrid four;
    std::memcpy(&four, from, sizeof four);
    return four;
}

/// One row of the template at height y, interpolated linearly between grid points. Offsets are in
/// pixels from the centre.
class GridRow {
  public:
    GridRow(const cv::Mat& grid, double y)
        : half_(0.5f * float(grid.cols - 1)), last_(float(grid.cols) - 1.001f) {
        const double v = std::clamp(y / step + 0.5 * (grid.rows - 1), 0.0, grid.rows - 1.001);
        const int row = int(v);
        q_ = float(v - row);
        above_ = grid.ptr<float>(row);
        below_ = grid.ptr<float>(row + 1);
    }
    OnGrid at(float x) const {
        constexpr auto per_pixel = float(1.0 / step);
        const float u = std::min(std::max(x * per_pixel + half_, 0.0f), last_);
        const int column = int(u);
        const float p = u - float(column);
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

/// Approximates tanh within 1/40 and reaches ±1 smoothly; the compiler vectorises it.
inline float bounded(float x) {
    const float y = std::min(std::max(x, -3.0f), 3.0f), square = y * y;
    return y * (27.0f + square) / (27.0f + 9.0f * square);
}

std::vector<DetectedParticle> with_positions(std::vector<DetectedParticle> particles,
                                             const std::vector<Vec2>& positions) {
    for (std::size_t i = 0; i < particles.size(); ++i) particles[i].centre = positions[i];
    return particles;
}

/// Mean square overlap of pairs of discs near contact; 0 if there are too few pairs. `weight`: of
/// the template's positions.
double overlap(const std::vector<AppearanceTemplate::Example>& examples,
               const std::vector<std::vector<Vec2>>& edges,
               const std::vector<std::vector<Vec2>>& by_template, double weight,
               const ParticleAppearance& appearance) {
    constexpr double near_contact = 0.125;  // share of the sum of radii
    constexpr std::size_t min_pairs = 100;
    double square = 0.0;
    std::size_t pairs = 0;
    for (std::size_t k = 0; k < examples.size(); ++k) {
        const std::vector<DetectedParticle>& particles = examples[k].particles;
        std::vector<Vec2> positions;
        for (std::size_t i = 0; i < particles.size(); ++i)
            positions.push_back(
                appearance.lens
                    .ideal({(1.0 - weight) * edges[k][i] + weight * by_template[k][i],
                            appearance.species[particles[i].species].radius})
                    .centre);
        for (std::size_t a = 0; a < particles.size(); ++a)
            for (std::size_t b = a + 1; b < particles.size(); ++b) {
                if (!particles[a].sure || !particles[b].sure) continue;
                const double sum =
                    appearance.contact * (appearance.species[particles[a].species].radius +
                                          appearance.species[particles[b].species].radius);
                const double gap = length(positions[a] - positions[b]) - sum;
                if (std::abs(gap) > near_contact * sum) continue;
                ++pairs;
                square += gap < 0.0 ? gap * gap : 0.0;
            }
    }
    return pairs < min_pairs ? 0.0 : square / double(pairs);
}

}  // namespace

std::vector<NearCircle> sure_others(const std::vector<DetectedParticle>& all,
                                    const DetectedParticle& self,
                                    const ParticleAppearance& appearance) {
    constexpr double margin = 7.0;  // pixels: two rings of `beyond`
    std::vector<NearCircle> others;
    const double own =
        appearance.lens.seen_radius(self.centre, appearance.species[self.species].radius);
    for (const DetectedParticle& b : all) {
        if (&b == &self || !b.sure) continue;
        const double radius =
            appearance.lens.seen_radius(b.centre, appearance.species[b.species].radius);
        if (length(b.centre - self.centre) < own + radius + margin)
            others.push_back({b.centre, radius});
    }
    return others;
}

/// Mask: 255 where no particle covers the floor.
cv::Mat AppearanceTemplate::free_floor(const cv::Size& size, const CircleFit& rim,
                                       const std::vector<DetectedParticle>& particles) const {
    cv::Mat mask = cv::Mat::zeros(size, CV_8U);
    const auto fill = [&](const Vec2& centre, double radius, int level) {
        cv::circle(mask, {cvRound(centre.x), cvRound(centre.y)}, int(radius), level, cv::FILLED);
    };
    fill(rim.centre, reach_ - 3.0, 255);
    for (const DetectedParticle& b : particles)
        fill(b.centre, appearance_.species[b.species].radius + 4.0, 0);
    return mask;
}

double AppearanceTemplate::illumination(const cv::Mat& sharp, const CircleFit& rim,
                                        const std::vector<DetectedParticle>& particles) const {
    if (floor_.empty()) return 1.0;
    const cv::Mat open = free_floor(sharp.size(), rim, particles);
    std::vector<double> ratios;
    constexpr int stride = 3;
    constexpr std::size_t min_pixels = 30;
    for (int row = 0; row < sharp.rows; row += stride) {
        const std::uint8_t* free = open.ptr(row);
        const float *here = sharp.ptr<float>(row), *floor = floor_.ptr<float>(row);
        for (int column = 0; column < sharp.cols; column += stride)
            if (free[column] && floor[column] > 1.0f)
                ratios.push_back(double(here[column] / floor[column]));
    }
    return ratios.size() < min_pixels ? 1.0 : median(ratios);
}

/// Per pixel, the median over the examples in which no particle covers it; `known` is 1 there.
cv::Mat AppearanceTemplate::median_floor(const std::vector<Example>& examples, unsigned threads,
                                         cv::Mat& known) const {
    const cv::Size size = examples.front().sharp.size();
    std::vector<float> of_illumination;
    std::vector<cv::Mat> is_free;
    for (const Example& e : examples) {
        of_illumination.push_back(float(1.0 / illumination(e.sharp, e.rim, e.particles)));
        is_free.push_back(free_floor(size, e.rim, e.particles));
    }
    cv::Mat sum = cv::Mat::zeros(size, CV_32F);
    known = cv::Mat::zeros(size, CV_32F);
    constexpr int rows_per_task = 16;
    const auto median_of_rows = [&](std::size_t part) {
        std::vector<float> levels;
        const int begin = rows_per_task * int(part);
        for (int row = begin; row < std::min(begin + rows_per_task, size.height); ++row)
            for (int column = 0; column < size.width; ++column) {
                levels.clear();
                for (std::size_t k = 0; k < examples.size(); ++k)
                    if (is_free[k].at<std::uint8_t>(row, column))
                        levels.push_back(examples[k].sharp.at<float>(row, column) *
                                         of_illumination[k]);
                if (levels.empty()) continue;
                const auto middle = levels.begin() + std::ptrdiff_t(levels.size() / 2);
                std::nth_element(levels.begin(), middle, levels.end());
                sum.at<float>(row, column) = *middle;
                known.at<float>(row, column) = 1.0f;
            }
    };
    parallel_for(std::size_t((size.height + rows_per_task - 1) / rows_per_task), median_of_rows,
                 threads);
    return sum;
}

void AppearanceTemplate::learn_floor(const std::vector<Example>& examples, unsigned threads) {
    const cv::Size size = examples.front().sharp.size();
    const double narrow_width = 2.0, wide_width = 0.7 * appearance_.radius();  // pixels
    constexpr float min_narrow = 0.3f, min_wide = 1e-4f;  // fraction of known pixels
    // Two rounds: the illumination of a frame follows from the floor.
    for (int round = 0; round < 2; ++round) {
        cv::Mat known;
        const cv::Mat sum = median_floor(examples, threads, known);
        // Pixels that are always covered take the level of their surroundings.
        cv::Mat narrow_sum, narrow, wide_sum, wide;
        cv::GaussianBlur(sum, narrow_sum, {}, narrow_width);
        cv::GaussianBlur(known, narrow, {}, narrow_width);
        cv::GaussianBlur(sum, wide_sum, {}, wide_width);
        cv::GaussianBlur(known, wide, {}, wide_width);
        floor_ = cv::Mat::zeros(size, CV_32F);
        cv::Mat(wide_sum / wide).copyTo(floor_, wide > min_wide);
        cv::Mat(narrow_sum / narrow).copyTo(floor_, narrow > min_narrow);
    }
}

AppearanceTemplate::Excess AppearanceTemplate::excess(
    const cv::Mat& sharp, const CircleFit& rim,
    const std::vector<DetectedParticle>& particles) const {
    Excess result;
    result.container = rim.centre;
    result.level = cv::Mat(sharp.size(), CV_32F, cv::Scalar(double(nowhere)));
    const auto of_illumination = float(1.0 / illumination(sharp, rim, particles));
    const auto soft = float(soft_);
    const auto steep = float(appearance_.polarity / soft_);
    const double reach = reach_ - 0.5;
    for (int row = 0; row < sharp.rows; ++row) {
        const double y = double(row) - rim.centre.y;
        if (std::abs(y) > reach) continue;
        const double half = std::sqrt(reach * reach - y * y);
        const int from = std::max(0, int(std::ceil(rim.centre.x - half)));
        const int to = std::min(sharp.cols - 1, int(rim.centre.x + half));
        const float* in = sharp.ptr<float>(row);
        const float* floor = floor_.ptr<float>(row);
        float* out = result.level.ptr<float>(row);
        for (int column = from; column <= to; ++column) {
            const float level =
                soft * bounded(steep * (in[column] * of_illumination - floor[column]));
            out[column] = floor[column] > 0.0f ? level : nowhere;
        }
    }
    return result;
}

template <typename Use>
void AppearanceTemplate::each_row(const Excess& excess, const Vec2& centre, std::size_t species,
                                  const std::vector<NearCircle>& others, int stride,
                                  Use&& use) const {
    const double radius = templates_[species].radius;
    const double scale = appearance_.lens.seen_radius(centre, radius) / radius;
    const double reach = scale * radius + beyond;
    const int top = std::max(0, int(std::ceil(centre.y - reach))),
              bottom = std::min(excess.level.rows - 1, int(centre.y + reach));
    std::vector<char> hidden;  // pixels of a row that others cover
    for (int row = top; row <= bottom; row += stride) {
        const double y = double(row) - centre.y;
        const double half = std::sqrt(std::max(0.0, reach * reach - y * y));
        const int from = std::max(0, int(std::ceil(centre.x - half))),
                  to = std::min(excess.level.cols - 1, int(centre.x + half));
        if (to < from) continue;
        hidden.assign(std::size_t(to - from + 1), 0);
        for (const NearCircle& o : others) {
            const double reach_of = o.radius + near_others, up = double(row) - o.centre.y;
            if (std::abs(up) >= reach_of) continue;
            const double wide = std::sqrt(reach_of * reach_of - up * up);
            const int first = std::max(from, int(std::ceil(o.centre.x - wide))),
                      last = std::min(to, int(std::floor(o.centre.x + wide)));
            for (int c = first; c <= last; ++c) hidden[std::size_t(c - from)] = 1;
        }
        const float* level = excess.level.ptr<float>(row);
        for (int column = from; column <= to; column += stride) {
            char& is_hidden = hidden[std::size_t(column - from)];
            is_hidden = static_cast<char>(is_hidden | (level[column] == nowhere ? 1 : 0));
        }
        use(Row{row, from, to, level, hidden.data(), scale});
    }
}

template <typename Use>
void AppearanceTemplate::each_pixel(const Excess& excess, const Vec2& centre, std::size_t species,
                                    const std::vector<NearCircle>& others, int stride,
                                    Use&& use) const {
    each_row(excess, centre, species, others, stride, [&](const Row& r) {
        for (int column = r.from; column <= r.to; column += stride)
            if (!r.hidden[column - r.from])
                use(Vec2{double(column), double(r.row)}, r.level[column], r.scale);
    });
}

double AppearanceTemplate::score(const Excess& excess, const Vec2& centre, std::size_t species,
                                 const std::vector<NearCircle>& others, int stride) const {
    // Hidden pixels count neither for the disc nor against it.
    double residual = 0.0, all = 0.0, scaled = 1.0;
    each_row(excess, centre, species, others, stride, [&](const Row& r) {
        const GridRow grid(templates_[species].grid, (r.row - centre.y) / r.scale);
        const auto shrink = float(1.0 / r.scale), begin = float(r.from - centre.x);
        float row_residual = 0.0f, row_all = 0.0f;
        for (int column = 0; column <= r.to - r.from; column += stride) {
            if (r.hidden[column]) continue;
            const float t = grid.at(shrink * (begin + float(column)))[0];
            const float e = r.level[r.from + column];
            row_residual += (e - t) * (e - t);
            row_all += t * t;
        }
        residual += double(row_residual);
        all += double(row_all);
        scaled = r.scale;
    });
    return (all - residual) * stride * stride / (templates_[species].squares * scaled * scaled);
}

bool AppearanceTemplate::inside(const Excess& excess, const Vec2& centre,
                                std::size_t species) const {
    constexpr double loose = 0.2;  // radii
    const double radius = templates_[species].radius;
    return length(centre - excess.container) + (1.0 - loose) * radius < reach_;
}

double AppearanceTemplate::excess_at(const Excess& excess, const Vec2& position) const {
    const int column = cvRound(position.x), row = cvRound(position.y);
    if (column < 0 || row < 0 || column >= excess.level.cols || row >= excess.level.rows)
        return double(nowhere);
    return double(excess.level.at<float>(row, column));
}

/// Normal equations A x = b for the changes of the gain and of the position, and their weights.
struct AppearanceTemplate::Normal {
    cv::Matx33d a;
    cv::Vec3d b;
    int pixels = 0;
};

/// `gain` is the present one.
AppearanceTemplate::Normal AppearanceTemplate::normal(const Excess& excess, const Vec2& centre,
                                                      std::size_t species,
                                                      const std::vector<NearCircle>& others,
                                                      int stride, double gain) const {
    Normal sum;
    each_row(excess, centre, species, others, stride, [&](const Row& r) {
        const GridRow grid(templates_[species].grid, (r.row - centre.y) / r.scale);
        const auto shrink = float(1.0 / r.scale), begin = float(r.from - centre.x);
        OnGrid level{}, across{}, seen{};  // sums of T, ∂ₓT and e times T, ∂ₓT and ∂ᵧT
        float down = 0.0f;                 // sum of (∂ᵧT)²
        for (int column = 0; column <= r.to - r.from; column += stride) {
            if (r.hidden[column]) continue;
            const OnGrid t = grid.at(shrink * (begin + float(column)));
            level += t[0] * t;
            across += t[1] * t;
            down += t[2] * t[2];
            seen += r.level[r.from + column] * t;
            ++sum.pixels;
        }
        const double slope = -gain / r.scale;
        sum.a(0, 0) += double(level[0]), sum.b[0] += double(seen[0]);
        for (int n = 1; n < 3; ++n) {
            sum.a(0, n) += slope * double(level[n]);
            sum.a(1, n) += slope * slope * double(across[n]);
            sum.b[n] += slope * double(seen[n]);
        }
        sum.a(2, 2) += slope * slope * double(down);
    });
    for (int r = 0; r < 3; ++r)
        for (int k = 0; k < r; ++k) sum.a(r, k) = sum.a(k, r);
    for (int r = 0; r < 3; ++r) sum.b[r] -= gain * sum.a(r, 0);
    return sum;
}

AppearanceTemplate::Fit AppearanceTemplate::fit(const Excess& excess, const Vec2& centre,
                                                std::size_t species,
                                                const std::vector<NearCircle>& others,
                                                int stride) const {
    constexpr int rounds = 4;
    constexpr double small_move = 0.1;    // pixels; the remaining error is below a tenth of it
    constexpr double min_visible = 0.25;  // fraction of the disc's area
    constexpr double max_step = 0.1, max_distance = 0.4;  // radii
    const SpeciesTemplate& model = templates_[species];
    Fit fit;
    fit.centre = centre;
    double gain = 1.0;
    for (int round = 0; round < rounds; ++round) {
        Normal system = normal(excess, fit.centre, species, others, stride, gain);
        if (double(system.pixels) * stride * stride <
            min_visible * pi * model.radius * model.radius)
            return fit;
        const double patch = std::max(1.0, pixels_of_a_patch / (stride * stride)),
                     weight = variance_ * patch / (gain_varies * gain_varies);
        system.a(0, 0) += weight;
        system.b[0] += weight * (1.0 - gain);
        bool solved = false;
        const cv::Vec3d change = system.a.inv(cv::DECOMP_CHOLESKY, &solved) * system.b;
        if (!solved) return fit;
        gain += change[0];
        const double maximum = max_step * model.radius;
        const Vec2 move{std::clamp(change[1], -maximum, maximum),
                        std::clamp(change[2], -maximum, maximum)};
        fit.centre = fit.centre + move;
        if (length(move) < small_move) break;
    }
    fit.good = length(fit.centre - centre) < max_distance * model.radius;
    return fit;
}

void AppearanceTemplate::learn_template(const std::vector<Example>& examples,
                                        const std::vector<Excess>& excesses,
                                        const std::vector<std::vector<Vec2>>& positions,
                                        std::size_t species, unsigned threads) {
    SpeciesTemplate& model = templates_[species];
    const int half = half_of(model.radius), side = 2 * half + 1;
    struct Sums {
        cv::Mat level, weight;
    };
    std::vector<Sums> sums(examples.size());  // added in a fixed order, so results are reproducible
    const auto add_example = [&](std::size_t k) {
        sums[k] = {cv::Mat::zeros(side, side, CV_32F), cv::Mat::zeros(side, side, CV_32F)};
        const std::vector<DetectedParticle> moved =
            with_positions(examples[k].particles, positions[k]);
        for (const DetectedParticle& particle : moved) {
            if (particle.species != species || !particle.sure) continue;
            const Vec2 centre = particle.centre;
            each_pixel(excesses[k], centre, species, sure_others(moved, particle, appearance_), 1,
                       [&](const Vec2& x, float level, double scale) {
                           const double u = (x.x - centre.x) / (scale * step) + half,
                                        v = (x.y - centre.y) / (scale * step) + half;
                           const int column = int(u), row = int(v);
                           if (column < 0 || row < 0 || column + 1 >= side || row + 1 >= side)
                               return;
                           const auto p = float(u - column), q = float(v - row);
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
    constexpr double blur = 0.7;        // grid points; fills gaps
    constexpr float min_weight = 0.5f;  // weight of a grid point
    cv::GaussianBlur(sum, sum, {}, blur);
    cv::GaussianBlur(weight, weight, {}, blur);
    cv::Mat level = cv::Mat::zeros(side, side, CV_32F), along_x, along_y;
    cv::Mat(sum / weight).copyTo(level, weight > min_weight);
    model.squares = std::max(cv::norm(level, cv::NORM_L2SQR) * step * step, 1e-9);
    cv::Scharr(level, along_x, CV_32F, 1, 0, 1.0 / (32.0 * step));
    cv::Scharr(level, along_y, CV_32F, 0, 1, 1.0 / (32.0 * step));
    const cv::Mat padding = cv::Mat::zeros(level.size(), CV_32F);
    cv::merge(std::vector<cv::Mat>{level, along_x, along_y, padding}, model.grid);
}

/// Fits all particles of one example with the current template.
AppearanceTemplate::Moved AppearanceTemplate::moved(const Example& example, const Excess& seen,
                                                    const std::vector<Vec2>& edges,
                                                    const std::vector<Vec2>& positions) const {
    constexpr double max_from_edge = 0.3;  // radii
    Moved result{positions, {}, {}};
    const std::vector<DetectedParticle> particles = with_positions(example.particles, positions);
    for (std::size_t i = 0; i < particles.size(); ++i) {
        if (!particles[i].sure) continue;
        const auto others = sure_others(particles, particles[i], appearance_);
        const Fit fitted = fit(seen, positions[i], particles[i].species, others);
        if (!fitted.good || length(fitted.centre - edges[i]) > max_from_edge * appearance_.radius())
            continue;
        result.positions[i] = fitted.centre;
        result.from_edges.push_back(fitted.centre - edges[i]);
        double square = 0.0;
        std::size_t pixels = 0;
        each_pixel(seen, fitted.centre, particles[i].species, others, 2,
                   [&](const Vec2& x, float level, double scale) {
                       const Vec2 d = (1.0 / scale) * (x - fitted.centre);
                       const GridRow grid(templates_[particles[i].species].grid, d.y);
                       const auto residual = double(level - grid.at(float(d.x))[0]);
                       square += residual * residual;
                       ++pixels;
                   });
        if (pixels > 0) result.residuals.push_back(square / double(pixels));
    }
    return result;
}

/// Sets the radius that particles reach; false if a species has too few particles.
bool AppearanceTemplate::set_reach(const std::vector<Example>& examples) {
    std::vector<double> reaches;
    std::vector<std::size_t> number(appearance_.species.size(), 0);
    for (const Example& e : examples) {
        double reach = 0.0;
        for (const DetectedParticle& b : e.particles) {
            if (!b.sure) continue;
            ++number[b.species];
            reach = std::max(
                reach, length(b.centre - e.rim.centre) + appearance_.species[b.species].radius);
        }
        if (reach > 0.0) reaches.push_back(reach);
    }
    if (*std::min_element(number.begin(), number.end()) < min_particles) return false;
    reach_ = median(reaches);
    return true;
}

/// Sets `soft_` from the typical contrast with the floor; false if that is too low.
bool AppearanceTemplate::learn_contrast(const std::vector<Example>& examples) {
    constexpr double inner = 0.5;                  // radii: half side of the square that is sampled
    constexpr double min_contrast = 3.0;           // grey levels
    constexpr double soft_share = 0.38;            // share of the contrast
    constexpr double soft_share_of_shading = 1.0;  // its excess has both signs, and no saturation
    std::vector<double> contrasts;
    for (const Example& e : examples) {
        const double of_illumination = 1.0 / illumination(e.sharp, e.rim, e.particles);
        for (const DetectedParticle& b : e.particles) {
            if (!b.sure) continue;
            const int column = cvRound(b.centre.x), row = cvRound(b.centre.y);
            const int near = int(inner * appearance_.species[b.species].radius);
            for (int y = row - near; y <= row + near; y += 2)
                for (int x = column - near; x <= column + near; x += 2) {
                    if (x < 0 || y < 0 || x >= e.sharp.cols || y >= e.sharp.rows) continue;
                    const double excess = of_illumination * double(e.sharp.at<float>(y, x)) -
                                          double(floor_.at<float>(y, x));
                    contrasts.push_back(appearance_.shading ? std::abs(excess)
                                                            : appearance_.polarity * excess);
                }
        }
    }
    if (contrasts.empty()) return false;
    const double contrast = median(contrasts);
    soft_ = (appearance_.shading ? soft_share_of_shading : soft_share) * contrast;
    return contrast > min_contrast;
}

/// One round: learns the templates and fits all particles with them. The mean offset from the edges
/// is removed. None if too few fits succeed.
std::optional<AppearanceTemplate::Positions> AppearanceTemplate::refined(
    const std::vector<Example>& examples, const std::vector<Excess>& excesses,
    const Positions& edges, const Positions& positions, unsigned threads) {
    for (std::size_t species = 0; species < templates_.size(); ++species)
        learn_template(examples, excesses, positions, species, threads);
    std::vector<Moved> all(examples.size());
    parallel_for(
        examples.size(),
        [&](std::size_t k) { all[k] = moved(examples[k], excesses[k], edges[k], positions[k]); },
        threads);
    std::vector<double> xs, ys, residuals;
    for (const Moved& m : all) {
        for (const Vec2& d : m.from_edges) xs.push_back(d.x), ys.push_back(d.y);
        residuals.insert(residuals.end(), m.residuals.begin(), m.residuals.end());
    }
    if (xs.size() < min_particles) return std::nullopt;
    const Vec2 drift{median(xs), median(ys)};
    Positions result;
    for (Moved& m : all) {
        result.push_back(std::move(m.positions));
        for (Vec2& p : result.back()) p = p - drift;
    }
    variance_ = median(residuals);
    return result;
}

/// Sets the weight with the least mean square overlap; `square` is that of the edges, and then of
/// the best weight.
void AppearanceTemplate::choose_weight(const std::vector<Example>& examples, const Positions& edges,
                                       const Positions& positions, double& square) {
    for (double trial = 0.1; trial < 1.05; trial += 0.1) {
        const double weight = std::min(trial, 1.0);
        const double overlaps = overlap(examples, edges, positions, weight, appearance_);
        if (overlaps < square) square = overlaps, weight_ = weight;
    }
}

std::optional<AppearanceTemplate> AppearanceTemplate::learned(const std::vector<Example>& examples,
                                                              const ParticleAppearance& appearance,
                                                              unsigned threads) {
    constexpr int rounds = 4;
    constexpr double good_edges = 0.05;        // pixels: rms overlap of edges that need no help
    constexpr double initial_variance = 0.01;  // share of the squared softness
    constexpr double required_gain = 0.7;      // share of the mean square overlap; edges are faster
    AppearanceTemplate result;
    result.appearance_ = appearance;
    if (!result.set_reach(examples)) return std::nullopt;
    Positions edges;
    for (const Example& e : examples) {
        edges.emplace_back();
        for (const DetectedParticle& b : e.particles) edges.back().push_back(b.centre);
    }
    const double edges_alone = overlap(examples, edges, edges, 0.0, appearance);
    if (!appearance.shading && edges_alone < good_edges * good_edges) return std::nullopt;
    result.learn_floor(examples, threads);
    if (!result.learn_contrast(examples)) return std::nullopt;
    for (const ParticleSpecies& one : appearance.species)
        result.templates_.push_back({one.radius, 1.0, {}});
    std::vector<Excess> excesses(examples.size());
    parallel_for(
        examples.size(),
        [&](std::size_t k) {
            excesses[k] = result.excess(examples[k].sharp, examples[k].rim, examples[k].particles);
        },
        threads);
    Positions positions = edges;
    result.variance_ = initial_variance * result.soft_ * result.soft_;
    for (int round = 0; round < rounds; ++round) {
        auto next = result.refined(examples, excesses, edges, positions, threads);
        if (!next) return std::nullopt;
        positions = std::move(*next);
    }
    for (std::size_t species = 0; species < appearance.species.size(); ++species)
        result.learn_template(examples, excesses, positions, species, threads);
    double square = edges_alone;
    if (appearance.shading)  // there are no edges
        square = overlap(examples, edges, positions, result.weight_ = 1.0, appearance);
    else
        result.choose_weight(examples, edges, positions, square);
    if (!appearance.shading && square > required_gain * edges_alone) return std::nullopt;
    // Half of the pairs overlap, so a distance errs by √2 of the rms overlap, and a position by
    // 1/√2 of that.
    result.error_ = std::sqrt(square);
    return result;
}

}  // namespace swirl::tracking
