// Circles in a picture: where their centres may be, and where they are exactly.
//
// Votes (Kimme, Ballard & Sklansky 1975): every pixel on an edge votes for the point that lies one
// radius away from it along its gradient. The centre of a circle gets a vote from each point of its
// circumference, whatever else is hidden; the share of the circumference that voted is what a
// candidate is judged by. The gradient's sense tells bright circles from dark ones.
//
// Fit: rays from a first guess, on each the place of the steepest ascent or descent near the radius
// to a fraction of a pixel, and a circle through these places by iteratively reweighted least
// squares with Tukey's biweight, so that rays that end at a neighbour or in a highlight do not
// count. With ρ_k the distance of the edge on ray k (direction u_k), ρ_k − a = u_k·d + δa, solved
// for the shift d (and the change of radius δa) until it is small.
//
// Places in pixels, the middle of the first one is 0,0; y is down.
#pragma once

#include <cmath>
#include <opencv2/core.hpp>
#include <vector>

#include "swirl/math/median.hpp"
#include "swirl/math/vec2.hpp"
#include "swirl/tracking/edge_profile.hpp"

namespace swirl {

inline double length(const Vec2& v) { return std::sqrt(dot(v, v)); }
/// Where the values become dense, looked at with windows of twice this width.
double onset(const std::vector<double>& values, double width);

/// 1: bright inside, dark outside; −1: the reverse.
using Polarity = int;

/// The pixels on edges.
struct EdgePixel {
    float x, y, gx, gy;  // place, and the unit vector towards the bright side
    float weight;        // 0 … 1, less for faint edges
};
/// `picture` has floats, blurred enough for its gradient to mean something.
std::vector<EdgePixel> edge_pixels(const cv::Mat& picture);
/// The noise of a derivative (grey levels per pixel), from the flat half of the picture.
double gradient_noise(const cv::Mat& picture);

struct CircleCandidate {
    Vec2 centre;
    double radius;
    Polarity polarity;
    double support;  // about the share of the circumference that voted for it
};
/// The local maxima of the votes for one radius, best first; those above `least`.
std::vector<CircleCandidate> vote(const std::vector<EdgePixel>& edges, cv::Size size, double radius,
                                  Polarity polarity, double minimum, std::size_t maximum);

struct NearCircle {
    Vec2 centre;
    double radius;
};

struct RaySettings {
    int rays = 64;
    double window = 4.0;   // pixels to either side of the radius
    double minimum = 0.0;  // slope that is an edge
    bool free_radius = false;
    double tolerance = 1.0;  // an edge within this of the circle supports it, pixels
    /// The last rounds look for the limb (edge_profile.hpp) instead of the steepest place.
    const EdgeProfile* edge_profile = nullptr;
    bool edge_profile_alone = false;  // the circle is known to a pixel: no rounds before
    /// Others next to it: rays whose outer end lies in one of them say nothing of the edge.
    std::vector<NearCircle> others = {};
};

struct CircleFit {
    Vec2 centre;
    double radius;
    double support = 0.0;   // share of rays whose edge lies on the circle
    double contrast = 0.0;  // median slope of those edges
    double residual = 0.0;  // their scatter about the circle, standard deviation
    double rest = 0.0;      // mean square of what the limb's fits leave
    double error = 0.0;     // standard error of each coordinate of the centre
    bool good = false;      // enough rays to fit at all
};
CircleFit fit_circle(const cv::Mat& picture, Vec2 centre, double radius, Polarity polarity,
                     const RaySettings& settings);

}  // namespace swirl
