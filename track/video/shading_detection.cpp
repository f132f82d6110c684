#include "track/video/shading_detection.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "swirl/math/unit_circle.hpp"
#include "swirl/run/parallel_for.hpp"
#include "track/video/robust_statistics.hpp"

namespace swirl::tracking {

namespace {

constexpr double wall_width = 2.0;    // pixels inside the rim that its blurred edge covers
constexpr double min_share = 0.45;    // share of the typical height of the highest maxima
constexpr double min_apart = 1.5;     // radii between two maxima
constexpr double full_radius = 16.0;  // radius of a ball, pixels: a larger frame is reduced

/// Derivatives of the blurred frame inside the dish, times the radius.
struct Slopes {
    cv::Mat x, y;
    Vec2 corner{0.0, 0.0};  // corner of the part, pixels of the frame
    double shrink = 1.0;

    Vec2 to_frame(double column, double row) const {
        return corner + Vec2{(column + 0.5) / shrink - 0.5, (row + 0.5) / shrink - 0.5};
    }
};

Slopes slopes_of(const cv::Mat& sharp, const CircleFit& rim, double radius) {
    constexpr double width = 0.45;         // width of the Gaussian, radii
    constexpr double scharr = 1.0 / 32.0;  // makes the kernel a derivative per pixel
    const int left = std::max(0, int(rim.centre.x - rim.radius)),
              top = std::max(0, int(rim.centre.y - rim.radius)),
              right = std::min(sharp.cols, int(rim.centre.x + rim.radius) + 2),
              bottom = std::min(sharp.rows, int(rim.centre.y + rim.radius) + 2);
    Slopes slopes;
    if (right <= left || bottom <= top) return slopes;
    slopes.corner = {double(left), double(top)};
    cv::Mat part = sharp(cv::Range(top, bottom), cv::Range(left, right));
    if (radius > full_radius)
        cv::resize(part, part, {}, full_radius / radius, full_radius / radius, cv::INTER_AREA);
    else
        part = part.clone();
    slopes.shrink = double(part.cols) / double(right - left);
    const double inside = rim.radius - wall_width;
    cv::Mat mask = cv::Mat::zeros(part.size(), CV_32F);
    std::vector<double> levels;
    for (int row = 0; row < part.rows; ++row)
        for (int column = 0; column < part.cols; ++column)
            if (length(slopes.to_frame(column, row) - rim.centre) < inside) {
                mask.at<float>(row, column) = 1.0f;
                levels.push_back(double(part.at<float>(row, column)));
            }
    if (levels.empty()) return slopes;
    part = (part - cv::Scalar(median(levels))).mul(mask);
    cv::GaussianBlur(part, part, {}, width * radius * slopes.shrink);
    const double scale = scharr * radius * slopes.shrink;
    cv::Scharr(part, slopes.x, CV_32F, 1, 0, scale);
    cv::Scharr(part, slopes.y, CV_32F, 0, 1, scale);
    slopes.x = slopes.x.mul(mask);
    slopes.y = slopes.y.mul(mask);
    return slopes;
}

struct Direction {
    Vec2 towards{1.0, 0.0};
    double skewness = 0.0;  // skewness of the response
};

/// The direction with the largest third moment of the response.
Direction direction_of(const std::vector<Slopes>& all) {
    constexpr int directions = 72;
    std::array<double, 4> moments{};
    double xx = 0.0, xy = 0.0, yy = 0.0, count = 0.0;
    for (const Slopes& slopes : all)
        for (int row = 0; row < slopes.x.rows; ++row) {
            const float *x = slopes.x.ptr<float>(row), *y = slopes.y.ptr<float>(row);
            for (int column = 0; column < slopes.x.cols; ++column) {
                const auto u = double(x[column]), v = double(y[column]);
                xx += u * u, xy += u * v, yy += v * v;
                if (u != 0.0 || v != 0.0) count += 1.0;  // if inside the dish
                moments[0] += u * u * u;
                moments[1] += 3.0 * u * u * v;
                moments[2] += 3.0 * u * v * v;
                moments[3] += v * v * v;
            }
        }
    Direction best;
    double highest = -1e300;
    for (int k = 0; k < directions; ++k) {
        const Vec2 t = unit_circle(double(k) / directions);
        const double moment = moments[0] * t.x * t.x * t.x + moments[1] * t.x * t.x * t.y +
                              moments[2] * t.x * t.y * t.y + moments[3] * t.y * t.y * t.y;
        if (moment > highest) highest = moment, best.towards = t;
    }
    const Vec2 t = best.towards;
    const double square = xx * t.x * t.x + 2.0 * xy * t.x * t.y + yy * t.y * t.y;
    if (square > 0.0) best.skewness = highest * std::sqrt(count) / std::pow(square, 1.5);
    return best;
}

struct Maximum {
    Vec2 centre;
    double height;
};

/// The maxima of the response, the highest first. Lower ones near a higher one are left out.
std::vector<Maximum> maxima_of(const Slopes& slopes, const Vec2& towards, double radius) {
    if (slopes.x.empty()) return {};
    const cv::Mat response = towards.x * slopes.x + towards.y * slopes.y;
    cv::Mat highest;
    const int side = 2 * std::max(1, int(0.5 * radius * slopes.shrink)) + 1;
    cv::dilate(response, highest, cv::Mat::ones(side, side, CV_8U));
    std::vector<Maximum> all;
    for (int row = 1; row + 1 < response.rows; ++row)
        for (int column = 1; column + 1 < response.cols; ++column) {
            const float here = response.at<float>(row, column);
            if (!(here > 0.0f) || here < highest.at<float>(row, column)) continue;
            const double x = vertex_offset(response.at<float>(row, column - 1), here,
                                           response.at<float>(row, column + 1)),
                         y = vertex_offset(response.at<float>(row - 1, column), here,
                                           response.at<float>(row + 1, column));
            all.push_back({slopes.to_frame(column + x, row + y), double(here)});
        }
    std::stable_sort(all.begin(), all.end(),
                     [](const Maximum& a, const Maximum& b) { return a.height > b.height; });
    std::vector<Maximum> apart;
    for (const Maximum& m : all)
        if (std::none_of(apart.begin(), apart.end(), [&](const Maximum& other) {
                return length(other.centre - m.centre) < min_apart * radius;
            }))
            apart.push_back(m);
    return apart;
}

/// Drops the maxima that are much lower than the highest third.
std::vector<Maximum> high_ones(std::vector<Maximum> maxima) {
    if (maxima.empty()) return maxima;
    const double typical = maxima[maxima.size() / 6].height;
    while (maxima.back().height < min_share * typical) maxima.pop_back();
    return maxima;
}

/// The result of the detection with one radius in all frames.
struct Trial {
    double radius = 0.0, score = 0.0, mean = 0.0, spread = 0.0;
    std::size_t number = 0;  // number of balls, at most: the template rejects other maxima
    double height = 0.0;     // height of a maximum, typical
    Direction direction;
};

Trial try_radius(const std::vector<PreparedFrame>& frames, const std::vector<CircleFit>& rims,
                 double radius, unsigned threads) {
    Trial trial;
    trial.radius = radius;
    std::vector<Slopes> slopes(frames.size());
    parallel_for(
        frames.size(),
        [&](std::size_t k) { slopes[k] = slopes_of(frames[k].sharp, rims[k], radius); }, threads);
    trial.direction = direction_of(slopes);
    std::vector<std::size_t> numbers;
    std::vector<double> heights;
    double square = 0.0;
    for (const Slopes& one : slopes) {
        const std::vector<Maximum> maxima =
            high_ones(maxima_of(one, trial.direction.towards, radius));
        numbers.push_back(maxima.size());
        trial.mean += double(maxima.size()) / double(frames.size());
        square += double(maxima.size() * maxima.size()) / double(frames.size());
        for (const Maximum& m : maxima) {
            trial.score += m.height * m.height * radius * radius;
            heights.push_back(m.height);
        }
    }
    trial.spread = std::sqrt(std::max(0.0, square - trial.mean * trial.mean));
    trial.number = *std::max_element(numbers.begin(), numbers.end());
    trial.height = quantile(heights, 0.5);
    return trial;
}

}  // namespace

std::optional<ParticleAppearance> survey_shading(const std::vector<PreparedFrame>& frames,
                                                 const std::vector<CircleFit>& rims,
                                                 const KnownDiscs& known, unsigned threads) {
    constexpr double growth = 1.1, smallest = 1.0 / 25.0, largest = 1.0 / 3.0;  // share of the rim
    constexpr double min_radius = 5.0;                                          // pixels
    constexpr double known_error = 0.2;  // of a given radius: the rim may be the outer edge
    constexpr double max_spread = 0.06;  // share of the number, plus half a ball
    constexpr double max_number_error = 0.15;
    constexpr double min_skewness = 0.3;  // skewness of noise: 0; of low contrast in the tests: 0.5
    constexpr double min_fill = 0.03, max_fill = 0.92;  // share of the dish
    double first = std::max(min_radius, smallest * rims.front().radius),
           last = largest * rims.front().radius;
    if (known.radius_share) {
        first = (1.0 - known_error) * *known.radius_share * rims.front().radius;
        last = (1.0 + known_error) * *known.radius_share * rims.front().radius;
    }
    std::vector<Trial> trials;
    for (double radius = first; radius < last; radius *= growth)
        trials.push_back(try_radius(frames, rims, radius, threads));
    if (trials.empty()) return std::nullopt;
    const auto best =
        std::max_element(trials.begin(), trials.end(),
                         [](const Trial& a, const Trial& b) { return a.score < b.score; });
    double radius = best->radius;
    if (best != trials.begin() && best + 1 != trials.end())
        radius *= std::pow(growth, vertex_offset(best[-1].score, best->score, best[1].score));
    const std::size_t number = known.number ? *known.number : best->number;
    const double share = radius / rims.front().radius, fill = double(number) * share * share;
    if (best->direction.skewness < min_skewness || best->spread > max_spread * best->mean + 0.5 ||
        fill < min_fill || fill > max_fill ||
        std::abs(best->mean - double(number)) > max_number_error * double(number))
        return std::nullopt;
    ParticleAppearance appearance;
    appearance.shading = ShadingFilter{best->direction.towards, radius, min_share * best->height};
    appearance.species = {{radius, 0.0, number}};
    appearance.number = number;
    appearance.lens.image_centre = {0.5 * (frames.front().sharp.cols - 1),
                                    0.5 * (frames.front().sharp.rows - 1)};
    appearance.lens.half_height = 0.5 * frames.front().sharp.rows;
    appearance.lens.ball_radius = radius;
    return appearance;
}

std::vector<DetectedParticle> find_by_shading(const cv::Mat& sharp, const CircleFit& rim,
                                              const ShadingFilter& filter, std::size_t max_count) {
    constexpr double error = 0.1;  // radii
    std::vector<DetectedParticle> found;
    for (const Maximum& m :
         maxima_of(slopes_of(sharp, rim, filter.radius), filter.towards, filter.radius)) {
        if (m.height < filter.min_height || found.size() == max_count) break;
        found.push_back({m.centre, 0, 1.0, error * filter.radius, true});
    }
    return found;
}

}  // namespace swirl::tracking
