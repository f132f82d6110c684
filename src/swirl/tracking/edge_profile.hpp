// The edge of a ball, on a ray from its middle outwards.
//
// The steepest place of the brightness lies inside the edge of a shaded ball: what it shows varies
// with the surface's normal, whose component towards the camera is √(2d/a) at a distance d inside
// the limb, so brightness changes without bound there, and blur mixes that into the step. Instead
// the profile is compared with
//
//     I(x) = b + (x < e) (h + s √(e − x) + t (e − x)),   convolved with a Gaussian of width σ
//
// (x outwards, e the edge), which is linear in b, h, s, t: for each e on a fine grid its best fit
// is a projection onto four columns, made orthonormal once for all rays. The edge is the e that
// leaves least; a parabola gives the fraction of a step. A flat disc is the case s = 0.
#pragma once

#include <array>
#include <vector>

namespace swirl {

class EdgeProfile {
  public:
    static constexpr double step = 0.5;  // between samples, in pixels

    /// For profiles of `samples` values around a guess, and edges up to `reach` pixels from it.
    /// `bent`: with t, which takes a window that is long against the blur.
    EdgeProfile(double blur, int inside, int outside, double reach, bool bent = true);

    /// How many samples to either side of the guess; the guess itself is one more.
    int inside() const { return inside_; }
    int outside() const { return outside_; }
    double blur() const { return blur_; }

    struct Edge {
        double at = 0.0;         // pixels outwards from the guess
        double contrast = 0.0;   // grey levels by which it is brighter inside
        double rest = 0.0;       // mean square of what the fit leaves
        double sharpness = 0.0;  // how fast the rest grows away from the edge, per square pixel
        bool found = false;      // not at the end of the reach
    };
    Edge find(const float* profile) const;

  private:
    static constexpr std::size_t columns = 4;

    double blur_;
    int inside_, outside_;
    double first_, spacing_;
    std::size_t candidates_ = 0, stride_ = 0;
    /// Orthonormal columns: for each of them and each sample, all candidates side by side.
    std::array<std::vector<float>, columns> q_;
    /// What each column says of the contrast, for each candidate.
    std::array<std::vector<double>, columns> contrast_;
};

}  // namespace swirl
