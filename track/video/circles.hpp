// Circles in an image: candidate centres by votes, then exact centres by rays.
//
// Votes (Kimme, Ballard & Sklansky 1975, doi:10.1145/360666.360677): every edge pixel votes for the
// point one radius away from it along its gradient. The centre of a circle gets a vote from each
// visible point of its circumference. A candidate's score is the share of the circumference that
// voted. The direction of the gradient distinguishes bright circles from dark ones.
//
// Rays: on each ray from an initial estimate of the centre, the steepest ascent or descent near the
// radius is found to a fraction of a pixel. A circle through these points is fitted by iteratively
// reweighted least squares with Tukey's biweight. Rays that end at a neighbour or in a highlight
// thus have no weight. With ρ_k the distance of the edge on ray k (direction u_k), the fit solves
// ρ_k − a = u_k·d + δa for the shift d (and the change of radius δa) until the shift is small.
//
// Positions in pixels; the centre of the first pixel is (0, 0); y is down.
#pragma once

#include <cmath>
#include <opencv2/core.hpp>
#include <vector>

#include "swirl/math/median.hpp"
#include "swirl/math/vec2.hpp"
#include "track/video/edge_profile.hpp"

namespace swirl::tracking {

inline double length(const Vec2& v) { return std::sqrt(dot(v, v)); }
/// The brightness at p, interpolated linearly between pixels.
float level_at(const cv::Mat& image, const Vec2& p);
/// The value at which `values` become dense, counted in windows of twice `width`.
double onset(const std::vector<double>& values, double width);

/// 1: bright inside, dark outside; −1: the reverse.
using Polarity = int;

struct EdgePixel {
    float x, y, gx, gy;  // position, and the unit vector towards the bright side
    float weight;        // 0 … 1, less for faint edges
};
/// `image` has 32-bit floats and is smoothed enough that its gradient is not noise alone.
std::vector<EdgePixel> edge_pixels(const cv::Mat& image);
/// Standard deviation of a derivative (grey levels per pixel), from the flat half of the image.
double gradient_noise(const cv::Mat& image);

struct CircleCandidate {
    Vec2 centre;
    double radius;
    Polarity polarity;
    double support;  // estimated share of the circumference that voted
};
/// Local maxima of the votes for one radius, best first: at most `max_count`, each with at least
/// `min_support`, and none closer than half a radius to a better one.
std::vector<CircleCandidate> vote(const std::vector<EdgePixel>& edges, cv::Size size, double radius,
                                  Polarity polarity, double min_support, std::size_t max_count);

struct NearCircle {
    Vec2 centre;
    double radius;
};

struct RaySettings {
    int rays = 64;
    double window = 4.0;   // pixels to either side of the radius
    double minimum = 0.0;  // least slope of an edge, grey levels per pixel
    bool free_radius = false;
    double tolerance = 1.0;  // an edge within this distance of the circle supports it, pixels
    /// If set, the last rounds fit this profile (edge_profile.hpp) instead of the steepest slope.
    const EdgeProfile* edge_profile = nullptr;
    bool edge_profile_alone = false;  // the circle is known to a pixel: skip the first rounds
    /// Neighbours: the edge profile ignores rays whose outer end lies in one of them.
    std::vector<NearCircle> others = {};
};

struct CircleFit {
    Vec2 centre;
    double radius;
    double support = 0.0;           // share of rays whose edge lies on the circle
    double contrast = 0.0;          // median slope of those edges
    double residual = 0.0;          // standard deviation of those edges from the circle, pixels
    double profile_residual = 0.0;  // mean square of the edge profiles, squared grey levels
    double error = 0.0;             // standard error of each coordinate of the centre
    bool good = false;              // there were enough rays for a fit
};
/// If the edge profiles cannot be fitted, the result is the fit to the steepest slopes.
CircleFit fit_circle(const cv::Mat& image, Vec2 centre, double radius, Polarity polarity,
                     const RaySettings& settings);

// A video frame, prepared for the search of circles: smoothed, and reduced for counting votes.

struct PreparedFrame {
    /// `grey` has 8 bits a pixel. `reduction` (at most 1) is the target for `shrink`; `blur` is the
    /// standard deviation of the smoothing of `sharp`, pixels.
    PreparedFrame(const cv::Mat& grey, double reduction, double blur);

    cv::Mat sharp, small;          // 32-bit floats
    double shrink;                 // length in `small` / length in `sharp`
    std::vector<EdgePixel> edges;  // edges of `small`
    double noise;                  // standard deviation of a derivative of `sharp`

    Vec2 to_sharp(const Vec2& p) const;
    Vec2 to_small(const Vec2& p) const;
};

}  // namespace swirl::tracking
