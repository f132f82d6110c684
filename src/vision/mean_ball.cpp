#include "swirl/vision/mean_ball.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "swirl/math/unit_circle.hpp"

namespace swirl {

namespace {

constexpr float nowhere = -1e30f;    // no excess there
constexpr double step = 0.5;         // of the mean ball's grid, pixels
constexpr double beyond = 3.5;       // pixels that are looked at outside of the edge
constexpr double near_others = 2.5;  // pixels next to another ball that its blur reaches
constexpr double gain_varies = 0.2, mode_varies = 0.15;
constexpr std::size_t modes = 4;
/// Neighbouring pixels leave the same rest: texture, and what compression makes of it.
constexpr double pixels_of_a_patch = 4.0;

int half_of(double radius) { return static_cast<int>((radius + beyond + 1.5) / step) + 1; }

/// Linear between the grid's points; x, y in pixels from the ball's middle.
cv::Vec3f on_grid(const cv::Mat& grid, double x, double y) {
    const double half = 0.5 * (grid.cols - 1);
    const double u = std::clamp(x / step + half, 0.0, grid.cols - 1.001),
                 v = std::clamp(y / step + half, 0.0, grid.rows - 1.001);
    const int column = static_cast<int>(u), row = static_cast<int>(v);
    const auto p = static_cast<float>(u - column), q = static_cast<float>(v - row);
    const cv::Vec3f* above = grid.ptr<cv::Vec3f>(row) + column;
    const cv::Vec3f* below = grid.ptr<cv::Vec3f>(row + 1) + column;
    const float a = (1.0f - q) * (1.0f - p), b = (1.0f - q) * p, c = q * (1.0f - p), d = q * p;
    cv::Vec3f value;
    for (int k = 0; k < 3; ++k)
        value[k] = a * above[0][k] + b * above[1][k] + c * below[0][k] + d * below[1][k];
    return value;
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
std::vector<Bead> at_places(std::vector<Bead> beads, const std::vector<Vec2>& places) {
    for (std::size_t i = 0; i < beads.size(); ++i) beads[i].centre = places[i];
    return beads;
}

/// Mean square by which hard discs lie in each other, of those that are near.
double overlap(const std::vector<MeanBall::Example>& examples,
               const std::vector<std::vector<Vec2>>& edges,
               const std::vector<std::vector<Vec2>>& ball, double counts, const BeadLook& look) {
    double square = 0.0;
    std::size_t pairs = 0;
    for (std::size_t k = 0; k < examples.size(); ++k) {
        const std::vector<Bead>& beads = examples[k].beads;
        std::vector<Vec2> places;
        for (std::size_t i = 0; i < beads.size(); ++i)
            places.push_back(look.lens
                                 .ideal({(1.0 - counts) * edges[k][i] + counts * ball[k][i],
                                         look.kinds[beads[i].kind].radius})
                                 .centre);
        for (std::size_t a = 0; a < beads.size(); ++a)
            for (std::size_t b = a + 1; b < beads.size(); ++b) {
                if (!beads[a].sure || !beads[b].sure) continue;
                const double sum =
                    look.kinds[beads[a].kind].radius + look.kinds[beads[b].kind].radius;
                const double gap = length(places[a] - places[b]) - sum;
                if (std::abs(gap) > 0.125 * sum) continue;
                ++pairs;
                square += gap < 0.0 ? gap * gap : 0.0;
            }
    }
    return pairs < 100 ? 0.0 : square / double(pairs);
}

}  // namespace

std::vector<NearCircle> sure_others(const std::vector<Bead>& all, const Bead& self,
                                    const BeadLook& look) {
    constexpr double looked_at = 7.0;  // pixels beyond both
    std::vector<NearCircle> others;
    const double own = look.lens.seen_radius(self.centre, look.kinds[self.kind].radius);
    for (const Bead& b : all) {
        if (&b == &self || !b.sure) continue;
        const double radius = look.lens.seen_radius(b.centre, look.kinds[b.kind].radius);
        if (length(b.centre - self.centre) < own + radius + looked_at)
            others.push_back({b.centre, radius});
    }
    return others;
}

double MeanBall::lamp(const cv::Mat& sharp, const CircleFit& rim,
                      const std::vector<Bead>& beads) const {
    if (floor_.empty()) return 1.0;
    std::vector<double> ratios;
    constexpr int stride = 3;
    for (int row = 0; row < sharp.rows; row += stride)
        for (int column = 0; column < sharp.cols; column += stride) {
            const Vec2 x{double(column), double(row)};
            if (length(x - rim.centre) > reach_ - 3.0 || !(floor_.at<float>(row, column) > 1.0f))
                continue;
            if (std::any_of(beads.begin(), beads.end(), [&](const Bead& b) {
                    return length(b.centre - x) < look_.kinds[b.kind].radius + 4.0;
                }))
                continue;
            ratios.push_back(double(sharp.at<float>(row, column) / floor_.at<float>(row, column)));
        }
    return ratios.size() < 30 ? 1.0 : median(ratios);
}

void MeanBall::learn_floor(const std::vector<Example>& examples) {
    const cv::Size size = examples.front().sharp.size();
    // Twice: the lamp of a picture is known after its floor.
    for (int round = 0; round < 2; ++round) {
        std::vector<double> lamps;
        for (const Example& e : examples) lamps.push_back(lamp(e.sharp, e.rim, e.beads));
        cv::Mat sum = cv::Mat::zeros(size, CV_32F), known = cv::Mat::zeros(size, CV_32F);
        // Every second pixel will do for what is smooth.
        std::vector<cv::Mat> taken;
        for (const Example& e : examples) {
            cv::Mat mask = cv::Mat::zeros(size, CV_8U);
            cv::circle(mask, {cvRound(e.rim.centre.x), cvRound(e.rim.centre.y)},
                       static_cast<int>(reach_ - 3.0), 255, cv::FILLED);
            for (const Bead& b : e.beads)
                cv::circle(mask, {cvRound(b.centre.x), cvRound(b.centre.y)},
                           static_cast<int>(look_.kinds[b.kind].radius + 4.0), 0, cv::FILLED);
            taken.push_back(mask);
        }
        std::vector<double> levels;
        for (int row = 0; row < size.height; ++row)
            for (int column = 0; column < size.width; ++column) {
                levels.clear();
                for (std::size_t k = 0; k < examples.size(); ++k)
                    if (taken[k].at<std::uint8_t>(row, column))
                        levels.push_back(double(examples[k].sharp.at<float>(row, column)) /
                                         lamps[k]);
                if (levels.empty()) continue;
                sum.at<float>(row, column) = static_cast<float>(median(levels));
                known.at<float>(row, column) = 1.0f;
            }
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

MeanBall::Excess MeanBall::excess(const cv::Mat& sharp, const CircleFit& rim,
                                  const std::vector<Bead>& beads) const {
    Excess made;
    made.dish = rim.centre;
    made.level = cv::Mat(sharp.size(), CV_32F, cv::Scalar(double(nowhere)));
    const auto of_lamp = static_cast<float>(1.0 / lamp(sharp, rim, beads));
    const auto soft = static_cast<float>(soft_);
    const auto sign = static_cast<float>(look_.polarity);
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
        for (int column = from; column <= to; ++column)
            if (floor[column] > 0.0f)
                out[column] =
                    soft * std::tanh(sign * (in[column] * of_lamp - floor[column]) / soft);
    }
    return made;
}

template <typename Use>
void MeanBall::each_pixel(const Excess& excess, const Vec2& centre, std::size_t kind,
                          const std::vector<NearCircle>& others, int stride, Use&& use) const {
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
        for (int column = from; column <= to; column += stride)
            if (level[column] != nowhere && !hidden[static_cast<std::size_t>(column - from)])
                use(Vec2{double(column), double(row)}, level[column], scale);
    }
}

double MeanBall::score(const Excess& excess, const Vec2& centre, std::size_t kind,
                       const std::vector<NearCircle>& others, int stride) const {
    // What is hidden says nothing, for it or against it.
    double rest = 0.0, all = 0.0, scaled = 1.0;
    each_pixel(excess, centre, kind, others, stride, [&](const Vec2& x, float e, double scale) {
        const auto t = double(
            on_grid(balls_[kind].grid, (x.x - centre.x) / scale, (x.y - centre.y) / scale)[0]);
        rest += (double(e) - t) * (double(e) - t);
        all += t * t;
        scaled = scale;
    });
    return (all - rest) * stride * stride / (balls_[kind].squares * scaled * scaled);
}

bool MeanBall::inside(const Excess& excess, const Vec2& centre, std::size_t kind) const {
    constexpr double loose = 0.2;  // radii
    const double radius = balls_[kind].radius;
    return length(centre - excess.dish) + (1.0 - loose) * radius < reach_;
}

double MeanBall::excess_at(const Excess& excess, const Vec2& place) const {
    const int column = cvRound(place.x), row = cvRound(place.y);
    if (column < 0 || row < 0 || column >= excess.level.cols || row >= excess.level.rows)
        return double(nowhere);
    return double(excess.level.at<float>(row, column));
}

MeanBall::Fit MeanBall::fit(const Excess& excess, const Vec2& centre, std::size_t kind,
                            const std::vector<NearCircle>& others, int stride) const {
    constexpr std::size_t n = 1 + modes + 2;
    const Look& ball = balls_[kind];
    Fit fit;
    fit.centre = centre;
    std::array<double, 1 + modes> made{1.0};
    for (int round = 0; round < 4; ++round) {
        std::array<std::array<double, n>, n> a{};
        std::array<double, n> b{};
        std::size_t pixels = 0;
        const Vec2 at = fit.centre;
        each_pixel(excess, at, kind, others, stride, [&](const Vec2& x, float e, double scale) {
            const double px = (x.x - at.x) / scale, py = (x.y - at.y) / scale;
            const cv::Vec3f level = on_grid(ball.grid, px, py);
            const auto t = double(level[0]), tx = double(level[1]), ty = double(level[2]);
            const double u = px / ball.radius, v = py / ball.radius;
            const std::array<double, n> j{t,
                                          t * u,
                                          t * v,
                                          t * (u * u - v * v),
                                          2.0 * t * u * v,
                                          -made[0] * tx / scale,
                                          -made[0] * ty / scale};
            double rest = double(e);
            for (std::size_t k = 0; k <= modes; ++k) rest -= made[k] * j[k];
            for (std::size_t r = 0; r < n; ++r) {
                for (std::size_t c = r; c < n; ++c) a[r][c] += j[r] * j[c];
                b[r] += j[r] * rest;
            }
            ++pixels;
        });
        if (double(pixels) * stride * stride < 0.25 * pi * ball.radius * ball.radius) return fit;
        for (std::size_t r = 0; r < n; ++r)
            for (std::size_t c = 0; c < r; ++c) a[r][c] = a[c][r];
        for (std::size_t k = 0; k <= modes; ++k) {
            const double varies = k == 0 ? gain_varies : mode_varies;
            const double patch = std::max(1.0, pixels_of_a_patch / (stride * stride));
            const double weight = variance_ * patch / (varies * varies);
            a[k][k] += weight;
            b[k] += weight * ((k == 0 ? 1.0 : 0.0) - made[k]);
        }
        if (!solve_system(a, b)) return fit;
        for (std::size_t k = 0; k <= modes; ++k) made[k] += b[k];
        const double most = 0.1 * ball.radius;
        const Vec2 move{std::clamp(b[modes + 1], -most, most),
                        std::clamp(b[modes + 2], -most, most)};
        fit.centre = fit.centre + move;
        if (length(move) < (stride > 1 ? 0.1 : 0.03)) break;
    }
    fit.good = length(fit.centre - centre) < 0.4 * ball.radius;
    return fit;
}

void MeanBall::learn_ball(const std::vector<Example>& examples,
                          const std::vector<std::vector<Vec2>>& places, std::size_t kind) {
    Look& ball = balls_[kind];
    const int half = half_of(ball.radius), side = 2 * half + 1;
    cv::Mat sum = cv::Mat::zeros(side, side, CV_32F), weight = cv::Mat::zeros(side, side, CV_32F);
    for (std::size_t k = 0; k < examples.size(); ++k) {
        const Example& e = examples[k];
        const Excess seen = excess(e.sharp, e.rim, e.beads);
        const std::vector<Bead> moved = at_places(e.beads, places[k]);
        for (const Bead& bead : moved) {
            if (bead.kind != kind || !bead.sure) continue;
            const Vec2 centre = bead.centre;
            each_pixel(seen, centre, kind, sure_others(moved, bead, look_), 1,
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
                                   sum.at<float>(row + r, column + c) += w * level;
                                   weight.at<float>(row + r, column + c) += w;
                               }
                       });
        }
    }
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
    cv::merge(std::vector<cv::Mat>{level, along_x, along_y}, ball.grid);
}

std::optional<MeanBall> MeanBall::learned(const std::vector<Example>& examples,
                                          const BeadLook& look) {
    constexpr int rounds = 4;
    constexpr double good_places = 0.05;  // pixels: edges that need no help
    constexpr std::size_t fewest = 150;   // balls, of each kind
    MeanBall mean;
    mean.look_ = look;
    std::vector<double> reaches;
    std::vector<std::size_t> number(look.kinds.size(), 0);
    for (const Example& e : examples) {
        double reach = 0.0;
        for (const Bead& b : e.beads)
            if (b.sure) {
                ++number[b.kind];
                reach =
                    std::max(reach, length(b.centre - e.rim.centre) + look.kinds[b.kind].radius);
            }
        if (reach > 0.0) reaches.push_back(reach);
    }
    if (*std::min_element(number.begin(), number.end()) < fewest) return std::nullopt;
    std::vector<std::vector<Vec2>> edges;
    for (const Example& e : examples) {
        edges.emplace_back();
        for (const Bead& b : e.beads) edges.back().push_back(b.centre);
    }
    const double alone = overlap(examples, edges, edges, 0.0, look);
    if (alone < good_places * good_places) return std::nullopt;
    mean.reach_ = median(reaches);
    // The usual contrast, against what the floor seems to be.
    mean.learn_floor(examples);
    std::vector<double> contrasts;
    for (const Example& e : examples) {
        const double of_lamp = 1.0 / mean.lamp(e.sharp, e.rim, e.beads);
        for (const Bead& b : e.beads) {
            if (!b.sure) continue;
            const int column = cvRound(b.centre.x), row = cvRound(b.centre.y);
            const int near = static_cast<int>(0.5 * look.kinds[b.kind].radius);
            for (int y = -near; y <= near; y += 2)
                for (int x = -near; x <= near; x += 2) {
                    if (column + x < 0 || row + y < 0 || column + x >= e.sharp.cols ||
                        row + y >= e.sharp.rows)
                        continue;
                    contrasts.push_back(look.polarity *
                                        (of_lamp * double(e.sharp.at<float>(row + y, column + x)) -
                                         double(mean.floor_.at<float>(row + y, column + x))));
                }
        }
    }
    if (contrasts.empty()) return std::nullopt;
    const double contrast = median(contrasts);
    if (!(contrast > 3.0)) return std::nullopt;
    mean.soft_ = 0.38 * contrast;
    for (const BeadKind& kind : look.kinds) mean.balls_.push_back({kind.radius, 1.0, {}});

    std::vector<std::vector<Vec2>> places = edges;
    mean.variance_ = 0.01 * mean.soft_ * mean.soft_;
    for (int round = 0; round < rounds; ++round) {
        for (std::size_t kind = 0; kind < look.kinds.size(); ++kind)
            mean.learn_ball(examples, places, kind);
        std::vector<std::vector<Vec2>> next = places;
        std::vector<double> xs, ys, rests;
        for (std::size_t k = 0; k < examples.size(); ++k) {
            const Example& e = examples[k];
            const Excess seen = mean.excess(e.sharp, e.rim, e.beads);
            const std::vector<Bead> moved = at_places(e.beads, places[k]);
            for (std::size_t i = 0; i < e.beads.size(); ++i) {
                if (!e.beads[i].sure) continue;
                const auto others = sure_others(moved, moved[i], look);
                const Fit fit = mean.fit(seen, places[k][i], e.beads[i].kind, others);
                if (!fit.good || length(fit.centre - edges[k][i]) > 0.3 * look.radius()) continue;
                next[k][i] = fit.centre;
                xs.push_back(fit.centre.x - edges[k][i].x);
                ys.push_back(fit.centre.y - edges[k][i].y);
                double square = 0.0;
                std::size_t pixels = 0;
                mean.each_pixel(
                    seen, fit.centre, e.beads[i].kind, others, 2,
                    [&](const Vec2& x, float level, double scale) {
                        const Vec2 d = (1.0 / scale) * (x - fit.centre);
                        const auto rest =
                            double(level - on_grid(mean.balls_[e.beads[i].kind].grid, d.x, d.y)[0]);
                        square += rest * rest;
                        ++pixels;
                    });
                if (pixels > 0) rests.push_back(square / double(pixels));
            }
        }
        if (xs.size() < fewest) return std::nullopt;
        const Vec2 drift{median(xs), median(ys)};
        for (auto& here : next)
            for (Vec2& p : here) p = p - drift;
        places = std::move(next);
        mean.variance_ = median(rests);
    }
    for (std::size_t kind = 0; kind < look.kinds.size(); ++kind)
        mean.learn_ball(examples, places, kind);
    double least = alone;
    for (double counts = 0.1; counts < 1.05; counts += 0.1) {
        const double square = overlap(examples, edges, places, std::min(counts, 1.0), look);
        if (square < least) least = square, mean.counts_ = std::min(counts, 1.0);
    }
    // Who gains little is left with the edges, which are quicker.
    if (least > 0.7 * alone) return std::nullopt;
    // Half of the pairs seem too near, so a distance errs by √2 of that, and a place by 1/√2 of
    // this.
    mean.error_ = std::sqrt(least);
    return mean;
}

}  // namespace swirl
