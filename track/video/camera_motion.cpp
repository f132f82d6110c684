#include "track/video/camera_motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "track/video/circles.hpp"
#include "track/video/robust_statistics.hpp"

namespace swirl::tracking {

Vec2 CameraPose::seen(const Vec2& fixed) const {
    const Vec2 d = fixed - about;
    return about + shift + Vec2{a * d.x - b * d.y, b * d.x + a * d.y};
}

Vec2 CameraPose::fixed(const Vec2& seen) const {
    const Vec2 d = seen - about - shift;
    const double square = a * a + b * b;
    return about + (1.0 / square) * Vec2{a * d.x + b * d.y, a * d.y - b * d.x};
}

double CameraPose::zoom() const { return std::hypot(a, b); }

void stabilise(cv::Mat& grey, const CameraPose& pose) {
    const Vec2 origin = pose.seen({0.0, 0.0});
    const cv::Matx23d to_seen(pose.a, -pose.b, origin.x, pose.b, pose.a, origin.y);
    cv::Mat fixed;
    cv::warpAffine(grey, fixed, to_seen, grey.size(), cv::INTER_LANCZOS4 | cv::WARP_INVERSE_MAP,
                   cv::BORDER_REPLICATE);
    grey = fixed;
}

namespace {

constexpr int patch_side = 25;      // pixels
constexpr double patch_blur = 1.0;  // pixels, makes the peak of a correlation a parabola
constexpr int coarse_search = 20;   // pixels of the reduced image, to each side

cv::Mat patch_image(const cv::Mat& grey) {
    cv::Mat smooth;
    cv::GaussianBlur(grey, smooth, cv::Size(7, 7), patch_blur, patch_blur, cv::BORDER_REPLICATE);
    return smooth;
}

cv::Mat reduced(const cv::Mat& grey, int reduction) {
    cv::Mat small;
    cv::resize(grey, small, cv::Size(grey.cols / reduction, grey.rows / reduction), 0, 0,
               cv::INTER_AREA);
    return small;
}

/// The best correlation of `patch` within `window` of an image, with its position in the image.
struct Peak {
    double score = -1.0;
    Vec2 position{0.0, 0.0};
    bool inside = false;  // not at an end of the window
};

Peak best_correlation(const cv::Mat& image, const cv::Mat& patch, cv::Rect window) {
    window &= cv::Rect(0, 0, image.cols, image.rows);
    if (window.width < patch.cols + 2 || window.height < patch.rows + 2) return {};
    cv::Mat scores;
    cv::matchTemplate(image(window), patch, scores, cv::TM_CCOEFF_NORMED);
    double score = 0.0;
    cv::Point at;
    cv::minMaxLoc(scores, nullptr, &score, nullptr, &at);
    Peak peak{score, {double(window.x + at.x), double(window.y + at.y)}, false};
    if (at.x < 1 || at.y < 1 || at.x + 1 >= scores.cols || at.y + 1 >= scores.rows) return peak;
    const float here = scores.at<float>(at);
    peak.position.x +=
        vertex_offset(scores.at<float>(at.y, at.x - 1), here, scores.at<float>(at.y, at.x + 1));
    peak.position.y +=
        vertex_offset(scores.at<float>(at.y - 1, at.x), here, scores.at<float>(at.y + 1, at.x));
    peak.inside = true;
    return peak;
}

/// (x, y) → shift + (a x − b y, b x + a y).
struct Similarity {
    Vec2 shift{0.0, 0.0};
    double a = 1.0, b = 0.0;
    Vec2 at(const Vec2& p) const { return shift + Vec2{a * p.x - b * p.y, b * p.x + a * p.y}; }
    bool plausible() const {
        constexpr double max_zoom = 0.15, max_turn = 0.1;  // relative; radians
        return std::abs(std::hypot(a, b) - 1.0) < max_zoom && std::abs(b) < max_turn;
    }
};

/// Least squares; a pure shift if the positions hardly differ.
template <typename Match>
Similarity similarity_of(const std::vector<Match>& matches) {
    constexpr double min_spread = 20.0;  // pixels
    Vec2 from{0.0, 0.0}, to{0.0, 0.0};
    const double share = 1.0 / double(matches.size());
    for (const Match& m : matches) from = from + share * m.from, to = to + share * m.to;
    double square = 0.0, along = 0.0, across = 0.0;
    for (const Match& m : matches) {
        const Vec2 p = m.from - from, q = m.to - to;
        square += dot(p, p);
        along += dot(p, q);
        across += p.x * q.y - p.y * q.x;
    }
    Similarity fit;
    if (square > min_spread * min_spread * double(matches.size()))
        fit.a = along / square, fit.b = across / square;
    fit.shift = to - (fit.at(from) - fit.shift);
    return fit;
}

}  // namespace

StaticBackground::StaticBackground(const cv::Mat& reference, const Vec2& centre, double swept)
    : size_(reference.size()) {
    constexpr int coarse_width = 320;  // pixels of the reduced image, at least
    // 0.05 squared grey levels per pixel², in OpenCV's unit: below is a uniform area.
    constexpr float min_texture = 16.0f * 0.05f / (255.0f * 255.0f);
    reduction_ = std::max(2, size_.width / coarse_width);
    const cv::Mat smooth = patch_image(reference), small = reduced(reference, reduction_);
    // How well a patch determines both coordinates: the smaller eigenvalue of its gradient matrix.
    cv::Mat texture;
    cv::cornerMinEigenVal(smooth, texture, patch_side, cv::FILTER_SCHARR);
    const int margin = patch_side / 2 + reduction_ + 1;
    for (int row = 0; row < texture.rows; ++row)
        for (int column = 0; column < texture.cols; ++column) {
            const bool at_border = row < margin || column < margin ||
                                   row >= texture.rows - margin || column >= texture.cols - margin;
            const double far = length(Vec2{double(column), double(row)} - centre);
            if (at_border || far < swept + 0.5 * std::sqrt(2.0) * patch_side)
                texture.at<float>(row, column) = 0.0f;
        }
    while (patches_.size() < max_patches) {
        double best = 0.0;
        cv::Point at;
        cv::minMaxLoc(texture, nullptr, &best, nullptr, &at);
        if (best < double(min_texture)) break;
        const cv::Rect taken(at.x - patch_side, at.y - patch_side, 2 * patch_side, 2 * patch_side);
        texture(taken & cv::Rect(0, 0, texture.cols, texture.rows)) = 0.0f;
        Patch patch;
        const int small_side = std::max(6, patch_side / reduction_);
        patch.corner = {at.x - patch_side / 2, at.y - patch_side / 2};
        patch.coarse_corner = {std::clamp(patch.corner.x / reduction_, 0, small.cols - small_side),
                               std::clamp(patch.corner.y / reduction_, 0, small.rows - small_side)};
        patch.fine =
            smooth(cv::Rect(patch.corner.x, patch.corner.y, patch_side, patch_side)).clone();
        patch.coarse =
            small(cv::Rect(patch.coarse_corner, cv::Size(small_side, small_side))).clone();
        patches_.push_back(std::move(patch));
    }
}

std::optional<Vec2> StaticBackground::find(const Patch& patch, const cv::Mat& coarse,
                                           const cv::Mat& fine) const {
    constexpr double min_score = 0.6;
    const Peak rough = best_correlation(
        coarse, patch.coarse,
        {patch.coarse_corner.x - coarse_search, patch.coarse_corner.y - coarse_search,
         patch.coarse.cols + 2 * coarse_search, patch.coarse.rows + 2 * coarse_search});
    if (rough.score < min_score) return std::nullopt;
    const Vec2 moved = double(reduction_) * (rough.position - Vec2{double(patch.coarse_corner.x),
                                                                   double(patch.coarse_corner.y)});
    const int reach = reduction_ + 1;
    const int x = patch.corner.x + cvRound(moved.x), y = patch.corner.y + cvRound(moved.y);
    const Peak peak = best_correlation(
        fine, patch.fine,
        {x - reach, y - reach, patch.fine.cols + 2 * reach, patch.fine.rows + 2 * reach});
    if (!peak.inside || peak.score < min_score) return std::nullopt;
    return peak.position - Vec2{double(patch.corner.x), double(patch.corner.y)};
}

std::optional<CameraPose> StaticBackground::pose(const cv::Mat& grey) const {
    constexpr double tolerance = 1.0;  // pixels
    constexpr double min_share = 0.4;  // share of the patches
    const Vec2 about{0.5 * (size_.width - 1), 0.5 * (size_.height - 1)};
    const Vec2 half{0.5 * (patch_side - 1), 0.5 * (patch_side - 1)};
    const cv::Mat fine = patch_image(grey), coarse = reduced(grey, reduction_);
    std::vector<Match> all;
    for (const Patch& patch : patches_)
        if (const auto moved = find(patch, coarse, fine)) {
            const Vec2 from = Vec2{double(patch.corner.x), double(patch.corner.y)} + half - about;
            all.push_back({from, from + *moved});
        }
    const auto agreeing = [&](const Similarity& s) {
        std::vector<Match> part;
        for (const Match& m : all)
            if (length(s.at(m.from) - m.to) < tolerance) part.push_back(m);
        return part;
    };
    // The pair of patches with which most others agree.
    std::vector<Match> best;
    for (std::size_t i = 0; i < all.size(); ++i)
        for (std::size_t j = i + 1; j < all.size(); ++j) {
            const Similarity s = similarity_of(std::vector<Match>{all[i], all[j]});
            if (!s.plausible()) continue;
            std::vector<Match> part = agreeing(s);
            if (part.size() > best.size()) best = std::move(part);
        }
    const auto enough = std::max(min_patches - 1, std::size_t(min_share * double(patches_.size())));
    if (best.size() < enough) return std::nullopt;
    const std::vector<Match> refined = agreeing(similarity_of(best));
    if (refined.size() < enough) return std::nullopt;
    const Similarity fit = similarity_of(refined);
    return CameraPose{about, fit.shift, fit.a, fit.b};
}

void measure_camera_motion(CameraMotion& motion) {
    constexpr std::size_t around = 5;  // frames to each side, for the drift
    const std::vector<CameraPose>& poses = motion.poses;
    std::vector<double> bends;
    for (std::size_t k = 1; k + 1 < poses.size(); ++k) {
        const Vec2 bend = poses[k - 1].shift - 2.0 * poses[k].shift + poses[k + 1].shift;
        bends.push_back(std::abs(bend.x));
        bends.push_back(std::abs(bend.y));
    }
    // The variance of a second difference is 1 + 4 + 1 times that of a value.
    motion.shake = bends.empty() ? 0.0 : mad_to_sigma * median(bends) / std::sqrt(6.0);
    for (std::size_t k = 0; k < poses.size(); ++k) {
        std::vector<double> x, y;
        for (std::size_t j = k < around ? 0 : k - around;
             j < std::min(poses.size(), k + around + 1); ++j) {
            x.push_back(poses[j].shift.x);
            y.push_back(poses[j].shift.y);
        }
        motion.drift = std::max(motion.drift, std::hypot(median(x), median(y)));
        motion.zoom = std::max(motion.zoom, std::abs(poses[k].zoom() - 1.0));
    }
}

}  // namespace swirl::tracking
