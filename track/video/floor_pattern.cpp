#include "track/video/floor_pattern.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "swirl/math/unit_circle.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/parallel_for.hpp"
#include "track/video/circles.hpp"
#include "track/video/robust_statistics.hpp"

namespace swirl::tracking {

namespace {

constexpr double inside = 0.9;      // share of the rim's radius: certainly the floor
constexpr double tolerance = 10.0;  // grey levels: noise and compression
constexpr double edge_error = 0.7;  // pixels: an edge of the pattern may be displaced by as much
constexpr int registration_rounds = 4;

/// The part of a frame around the container's centre.
cv::Mat container_patch(const cv::Mat& image, const Vec2& centre, cv::Size size) {
    cv::Mat patch;
    cv::getRectSubPix(image, size, cv::Point2f(float(centre.x), float(centre.y)), patch);
    return patch;
}

/// The middle and the width of the shortest interval with a third of the sorted values.
struct Interval {
    double middle = 0.0, width = 0.0;
};

Interval densest_third(const std::vector<std::uint8_t>& sorted) {
    const std::size_t more = std::max<std::size_t>(2, sorted.size() / 3) - 1;
    std::size_t best = 0;
    for (std::size_t k = 0; k + more < sorted.size(); ++k)
        if (sorted[k + more] - sorted[k] < sorted[best + more] - sorted[best]) best = k;
    double sum = 0.0;
    for (std::size_t k = best; k <= best + more; ++k) sum += sorted[k];
    return {sum / double(more + 1), double(sorted[best + more] - sorted[best])};
}

}  // namespace

std::optional<FloorPattern> FloorPattern::learned(const std::vector<cv::Mat>& images,
                                                  const ContainerRim& rim, double reduction,
                                                  unsigned threads) {
    constexpr std::size_t min_images = 12;
    constexpr int rounds = 3;
    FloorPattern floor;
    floor.rim_ = rim;
    floor.reduction_ = reduction;
    std::vector<std::optional<Vec2>> found(images.size());
    parallel_for(
        images.size(), [&](std::size_t k) { found[k] = floor.rim_centre(images[k]); }, threads);
    std::vector<const cv::Mat*> used;
    std::vector<Vec2> centres;
    for (std::size_t k = 0; k < images.size(); ++k)
        if (found[k]) used.push_back(&images[k]), centres.push_back(*found[k]);
    if (used.size() < min_images) return std::nullopt;
    const int side = 2 * int(std::ceil(rim.radius)) + 1;
    std::vector<cv::Mat> patches(used.size());
    for (int round = 0; round < rounds; ++round) {
        parallel_for(
            used.size(),
            [&](std::size_t k) {
                if (round > 0) centres[k] = floor.registered(*used[k], centres[k]);
                patches[k] = container_patch(*used[k], centres[k], {side, side});
            },
            threads);
        floor.learn(patches, threads);
    }
    if (!floor.patterned()) return std::nullopt;
    floor.plain_level_ = floor.plain_level_for(patches);
    return floor;
}

FloorPattern FloorPattern::folded(const std::vector<cv::Mat>& images, const ContainerRim& rim) {
    constexpr int every = 3;          // frames, rows and columns are enough
    constexpr double extreme = 0.02;  // share of the pixels
    constexpr double margin = 0.15;   // share of the range of levels
    const double reach = inside * rim.radius - rim.amplitude;  // the floor in all frames
    std::vector<std::uint8_t> levels;
    for (std::size_t k = 0; k < images.size(); k += every)
        for (int row = 0; row < images[k].rows; row += every)
            for (int column = 0; column < images[k].cols; column += every)
                if (length(Vec2{double(column), double(row)} - rim.path_centre) < reach)
                    levels.push_back(images[k].at<std::uint8_t>(row, column));
    if (levels.empty()) throw Failure("the container's path is larger than the container");
    std::sort(levels.begin(), levels.end());
    const auto end = double(levels.size() - 1);
    const double darkest = levels[std::size_t(extreme * end)],
                 brightest = levels[std::size_t((1.0 - extreme) * end)],
                 far = margin * (brightest - darkest);
    const std::vector<std::uint8_t> between(
        std::lower_bound(levels.begin(), levels.end(), darkest + far),
        std::upper_bound(levels.begin(), levels.end(), brightest - far));
    FloorPattern floor;
    floor.fold_ = between.size() < 2 ? 0.5 * (darkest + brightest) : densest_third(between).middle;
    return floor;
}

std::optional<Vec2> FloorPattern::rim_centre(const cv::Mat& image) const {
    const CircleFit rim = find_container_rim(PreparedFrame(image, reduction_, rim_blur), rim_);
    if (!rim.good) return std::nullopt;
    return rim.centre;
}

void FloorPattern::learn(const std::vector<cv::Mat>& patches, unsigned threads) {
    constexpr double max_width = 12.0;  // grey levels: wider, and it is no floor
    const cv::Size size = patches.front().size();
    level_ = cv::Mat::zeros(size, CV_32F);
    known_ = cv::Mat::zeros(size, CV_8U);
    parallel_for(
        std::size_t(size.height),
        [&](std::size_t r) {
            const int row = int(r);
            std::vector<std::uint8_t> values(patches.size());
            for (int column = 0; column < size.width; ++column) {
                if (distance(row, column) > rim_.radius) continue;
                for (std::size_t k = 0; k < patches.size(); ++k)
                    values[k] = patches[k].at<std::uint8_t>(row, column);
                std::sort(values.begin(), values.end());
                const Interval floor = densest_third(values);
                level_.at<float>(row, column) = float(floor.middle);
                if (floor.width <= max_width) known_.at<std::uint8_t>(row, column) = 255;
            }
        },
        threads);
    constexpr double scharr = 1.0 / 32.0;  // makes the kernel a derivative per pixel
    cv::Scharr(level_, slope_x_, CV_32F, 1, 0, scharr);
    cv::Scharr(level_, slope_y_, CV_32F, 0, 1, scharr);
    cv::magnitude(slope_x_, slope_y_, slope_);
    leave_out_wall();
}

double FloorPattern::distance(int row, int column) const {
    const double half = 0.5 * (level_.cols - 1);
    return std::hypot(column - half, row - half);
}

std::vector<double> FloorPattern::inner_levels() const {
    std::vector<double> levels;
    for_each_known([&](int row, int column) {
        if (distance(row, column) < inside * rim_.radius)
            levels.push_back(double(level_.at<float>(row, column)));
    });
    return levels;
}

/// The rim that was found may be the outer edge of the wall, and not quite concentric with it. On
/// arcs about the centre, the brightness of the floor varies, and that of the wall hardly does. The
/// wall begins where it appears on two of eight arcs.
void FloorPattern::leave_out_wall() {
    constexpr std::size_t arcs = 8;
    constexpr double less = 0.5;  // share of the variation on the floor
    const double half = 0.5 * (level_.cols - 1);
    struct Arc {
        double number = 0.0, sum = 0.0, square = 0.0;
        double deviation() const {
            if (!(number > 0.0)) return 0.0;
            const double mean = sum / number;
            return std::sqrt(std::max(0.0, square / number - mean * mean));
        }
    };
    std::vector<std::array<Arc, arcs>> rings(std::size_t(half) + 2);
    for_each_known([&](int row, int column) {
        const double turns = turns_of({column - half, row - half}),
                     level = level_.at<float>(row, column);
        Arc& arc = rings[std::size_t(distance(row, column))][std::size_t(arcs * turns)];
        arc.number += 1.0, arc.sum += level, arc.square += level * level;
    });
    std::vector<double> variation;  // variation of each ring: the second smallest of its arcs
    for (const auto& ring : rings) {
        std::array<double, arcs> deviations{};
        std::transform(ring.begin(), ring.end(), deviations.begin(),
                       [](const Arc& arc) { return arc.deviation(); });
        std::nth_element(deviations.begin(), deviations.begin() + 1, deviations.end());
        variation.push_back(deviations[1]);
    }
    const auto certain = std::ptrdiff_t(inside * rim_.radius);
    const double typical =
        median(std::vector<double>(variation.begin() + certain / 2, variation.begin() + certain));
    auto wall = std::size_t(certain);
    while (wall < variation.size() && variation[wall] > less * typical) ++wall;
    for_each_known([&](int row, int column) {
        if (std::size_t(distance(row, column)) >= wall) known_.at<std::uint8_t>(row, column) = 0;
    });
}

bool FloorPattern::patterned() const {
    constexpr double min_known = 0.3;      // share of the area
    constexpr double min_contrast = 20.0;  // grey levels
    const std::vector<double> levels = inner_levels();
    const double area = pi * std::pow(inside * rim_.radius, 2);
    return double(levels.size()) >= min_known * area &&
           quantile(levels, 0.9) - quantile(levels, 0.1) >= min_contrast;
}

/// The darkest or the brightest level of the pattern: the one from which discs differ more.
double FloorPattern::plain_level_for(const std::vector<cv::Mat>& patches) const {
    constexpr int every = 5;  // frames and pixels are enough
    std::vector<double> floor, discs;
    for (std::size_t k = 0; k < patches.size(); k += every)
        for (int row = 0; row < level_.rows; row += every)
            for (int column = 0; column < level_.cols; column += every) {
                if (!known_.at<std::uint8_t>(row, column)) continue;
                const double here = patches[k].at<std::uint8_t>(row, column),
                             level = level_.at<float>(row, column);
                (std::abs(here - level) < tolerance ? floor : discs).push_back(here);
            }
    const bool bright = median(discs) > median(floor);
    return quantile(floor, bright ? 0.1 : 0.9);
}

// With I the frame, L the level and d the shift of the centre: I(c + x) = L(x − d), so
// I(c + x) − L(x) = −∇L·d, solved by least squares over the pixels that show the floor.
Vec2 FloorPattern::registered(const cv::Mat& image, const Vec2& centre) const {
    constexpr double gross = 60.0;    // grey levels: a disc
    constexpr double max_step = 2.0;  // pixels
    constexpr double enough = 0.01;   // pixels
    Vec2 at = centre;
    for (int round = 0; round < registration_rounds; ++round) {
        const cv::Mat patch = container_patch(image, at, level_.size());
        double xx = 0.0, xy = 0.0, yy = 0.0, bx = 0.0, by = 0.0;
        for_each_known([&](int row, int column) {
            const double off =
                double(patch.at<std::uint8_t>(row, column)) - level_.at<float>(row, column);
            const double weight = tukey_weight(off / gross);
            const double x = slope_x_.at<float>(row, column), y = slope_y_.at<float>(row, column);
            xx += weight * x * x, xy += weight * x * y, yy += weight * y * y;
            bx -= weight * x * off, by -= weight * y * off;
        });
        const double det = xx * yy - xy * xy;
        if (!(det > 0.0)) return centre;
        Vec2 step{(yy * bx - xy * by) / det, (xx * by - xy * bx) / det};
        if (const double far = length(step); far > max_step) step = (max_step / far) * step;
        at = at + step;
        if (length(step) < enough) break;
    }
    return at;
}

void FloorPattern::remove(cv::Mat& image) const {
    if (fold_) {
        cv::absdiff(image, cv::Scalar(*fold_), image);
        image += cv::Scalar(32.0);  // grey levels: the illumination needs some
        return;
    }
    // Of the rim's radius: a narrower match may be a part of a disc that is as bright as the floor.
    constexpr double smallest = 1.0 / 25.0;
    const std::optional<Vec2> rim = rim_centre(image);
    if (!rim) return;
    const Vec2 centre = registered(image, *rim);
    const double half = 0.5 * (level_.cols - 1);
    const cv::Matx23d to_image(1.0, 0.0, centre.x - half, 0.0, 1.0, centre.y - half);
    cv::Mat level, known, steep;
    cv::warpAffine(level_, level, to_image, image.size(), cv::INTER_LINEAR);
    cv::warpAffine(slope_, steep, to_image, image.size(), cv::INTER_LINEAR);
    cv::warpAffine(known_, known, to_image, image.size(), cv::INTER_NEAREST);
    cv::Mat floor = cv::Mat::zeros(image.size(), CV_8U);
    for (int row = 0; row < image.rows; ++row)
        for (int column = 0; column < image.cols; ++column)
            if (known.at<std::uint8_t>(row, column) &&
                std::abs(double(image.at<std::uint8_t>(row, column)) -
                         level.at<float>(row, column)) <
                    tolerance + edge_error * steep.at<float>(row, column))
                floor.at<std::uint8_t>(row, column) = 255;
    const int width = 2 * std::max(1, cvRound(smallest * rim_.radius)) + 1;
    cv::morphologyEx(floor, floor, cv::MORPH_OPEN,
                     cv::getStructuringElement(cv::MORPH_ELLIPSE, {width, width}));
    image.setTo(cv::Scalar(plain_level_), floor);
}

}  // namespace swirl::tracking
