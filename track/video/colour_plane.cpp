#include "track/video/colour_plane.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "swirl/math/median.hpp"
#include "swirl/math/unit_circle.hpp"
#include "track/video/robust_statistics.hpp"

namespace swirl::tracking {

namespace {

/// The brightness that video formats derive from red, green and blue (ITU-R BT.601).
double brightness(const cv::Vec3d& colour) { return colour.dot({0.299, 0.587, 0.114}); }

cv::Vec3d median_of(const std::vector<cv::Vec3d>& colours) {
    cv::Vec3d middle;
    for (int channel = 0; channel < 3; ++channel) {
        std::vector<double> values;
        for (const cv::Vec3d& colour : colours) values.push_back(colour[channel]);
        middle[channel] = median(std::move(values));
    }
    return middle;
}

/// The commonest colour: the fullest cell of a coarse histogram, then the median around it.
cv::Vec3d commonest(const std::vector<cv::Vec3b>& pixels) {
    constexpr int cell = 16;       // levels
    constexpr double near = 20.0;  // levels: shade and noise of one colour
    constexpr int rounds = 5, side = 256 / cell;
    const auto cell_of = [](const cv::Vec3b& p) {
        return std::size_t((p[0] / cell * side + p[1] / cell) * side + p[2] / cell);
    };
    std::array<std::size_t, std::size_t(side * side * side)> number{};
    for (const cv::Vec3b& p : pixels) ++number[cell_of(p)];
    const auto fullest =
        std::size_t(std::max_element(number.begin(), number.end()) - number.begin());
    std::vector<cv::Vec3d> members;
    for (const cv::Vec3b& p : pixels)
        if (cell_of(p) == fullest) members.emplace_back(p);
    cv::Vec3d middle = median_of(members);
    for (int round = 0; round < rounds; ++round) {
        members.clear();
        for (const cv::Vec3b& p : pixels)
            if (cv::norm(cv::Vec3d(p) - middle) < near) members.emplace_back(p);
        middle = median_of(members);
    }
    return middle;
}

/// The differences from the floor's colour that are no noise, shadow or texture.
std::vector<cv::Vec3d> clear_differences(const std::vector<cv::Vec3b>& pixels,
                                         const cv::Vec3d& floor) {
    constexpr double clear = 0.35;  // share of the largest differences
    constexpr double largest = 0.95;
    std::vector<double> sizes;
    for (const cv::Vec3b& p : pixels) sizes.push_back(cv::norm(cv::Vec3d(p) - floor));
    const double least = clear * quantile(sizes, largest);
    std::vector<cv::Vec3d> differences;
    for (std::size_t k = 0; k < pixels.size(); ++k)
        if (sizes[k] > least) differences.push_back(cv::Vec3d(pixels[k]) - floor);
    return differences;
}

double cosine(const cv::Vec3d& a, const cv::Vec3d& b) {
    return a.dot(b) / (cv::norm(a) * cv::norm(b));
}

/// Takes away the differences around the densest direction. Returns their median.
std::optional<cv::Vec3d> take_colour(std::vector<cv::Vec3d>& differences, std::size_t least) {
    constexpr std::size_t trials = 400;
    const double core = std::cos(pi / 15.0), wide = std::cos(pi / 7.0);
    std::size_t most = 0;
    cv::Vec3d densest;
    const std::size_t stride = differences.size() / trials + 1;
    for (std::size_t k = 0; k < differences.size(); k += stride) {
        const auto near = std::size_t(std::count_if(
            differences.begin(), differences.end(),
            [&](const cv::Vec3d& other) { return cosine(differences[k], other) > core; }));
        if (near <= most) continue;
        most = near;
        densest = differences[k];
    }
    const auto rest =
        std::partition(differences.begin(), differences.end(),
                       [&](const cv::Vec3d& other) { return cosine(densest, other) <= wide; });
    const std::vector<cv::Vec3d> taken(rest, differences.end());
    differences.erase(rest, differences.end());
    if (taken.size() < least) return std::nullopt;
    return median_of(taken);
}

/// Colours of discs as differences from that of the floor.
std::vector<cv::Vec3d> disc_colours(std::vector<cv::Vec3d> differences) {
    constexpr double min_share = 0.1;  // of the pixels: less is gloss or a mark
    constexpr double min_size = 0.5;   // of the largest: less is the dark side of a ball
    const auto least = std::size_t(min_share * double(differences.size())) + 1;
    std::vector<cv::Vec3d> colours;
    while (differences.size() >= least) {
        const std::optional<cv::Vec3d> colour = take_colour(differences, least);
        if (!colour) break;
        colours.push_back(*colour);
    }
    double largest = 0.0;
    for (const cv::Vec3d& colour : colours) largest = std::max(largest, cv::norm(colour));
    std::erase_if(colours,
                  [&](const cv::Vec3d& colour) { return cv::norm(colour) < min_size * largest; });
    return colours;
}

/// The contrast of the weakest colour in grey, as a share of that of the strongest in colours.
double weakest_in_grey(const std::vector<cv::Vec3d>& colours) {
    double largest = 0.0, weakest = 1e300, sum = 0.0;
    for (const cv::Vec3d& colour : colours) sum += brightness(colour);
    const double sign = sum < 0.0 ? -1.0 : 1.0;
    for (const cv::Vec3d& colour : colours) {
        largest = std::max(largest, cv::norm(colour) / std::sqrt(3.0));
        weakest = std::min(weakest, sign * brightness(colour));
    }
    return weakest / largest;
}

}  // namespace

bool is_grey(const std::vector<cv::Vec3b>& pixels) {
    constexpr int coloured = 16;        // difference of two channels, levels
    constexpr std::size_t one_in = 50;  // pixels
    const auto number = std::count_if(pixels.begin(), pixels.end(), [](const cv::Vec3b& p) {
        const auto [low, high] = std::minmax({p[0], p[1], p[2]});
        return high - low > coloured;
    });
    return std::size_t(number) * one_in < pixels.size();
}

std::optional<ColourPlane> ColourPlane::proposed(const std::vector<cv::Vec3b>& pixels) {
    constexpr double clear_in_grey = 0.6;
    if (is_grey(pixels)) return std::nullopt;
    ColourPlane plane;
    plane.floor_ = commonest(pixels);
    const std::vector<cv::Vec3d> colours = disc_colours(clear_differences(pixels, plane.floor_));
    if (colours.empty() || weakest_in_grey(colours) > clear_in_grey) return std::nullopt;
    for (const cv::Vec3d& colour : colours)
        plane.directions_.push_back((1.0 / colour.dot(colour)) * colour);
    return plane;
}

void ColourPlane::project(const cv::Mat& rgb, cv::Mat& grey) const {
    constexpr double floor_level = 50.0, disc_level = 170.0;  // room for shadow and gloss
    grey.create(rgb.size(), CV_8UC1);
    for (int row = 0; row < rgb.rows; ++row) {
        const auto* from = rgb.ptr<cv::Vec3b>(row);
        auto* to = grey.ptr<std::uint8_t>(row);
        for (int column = 0; column < rgb.cols; ++column) {
            const cv::Vec3d difference = cv::Vec3d(from[column]) - floor_;
            double share = difference.dot(directions_.front());
            for (const cv::Vec3d& direction : directions_)
                share = std::max(share, difference.dot(direction));
            to[column] =
                cv::saturate_cast<std::uint8_t>(floor_level + (disc_level - floor_level) * share);
        }
    }
}

}  // namespace swirl::tracking
