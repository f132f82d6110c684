// The edge of a ball, on a ray from its centre outwards.
//
// The steepest slope of the brightness lies inside the edge of a shaded ball: the shade varies with
// the surface's normal, whose component towards the camera is √(2d/a) at a distance d inside the
// edge of a ball of radius a. The slope thus grows without bound there, and blur mixes it into the
// step. Instead, the profile is compared with
//
//     I(x) = b + (x < e) (h + s √(e − x) + t (e − x)),   convolved with a Gaussian of width σ
//
// (x outwards, e the edge). This is linear in b, h, s and t: for each e on a fine grid, the best
// fit is a projection onto four columns, made orthonormal once for all rays. The edge is the e with
// the least residual; a parabola gives the fraction of a grid step. A flat disc is the case s = 0.
#pragma once

#include <array>
#include <vector>

namespace swirl::tracking {

class EdgeProfile {
  public:
    static constexpr double step = 0.5;  // step between samples, pixels

    /// For profiles of `inside` + 1 + `outside` samples around an initial estimate, and edges up to
    /// `reach` pixels from it. `blur` is σ in pixels. `bent` includes the term t, which needs a
    /// window that is long compared with the blur.
    EdgeProfile(double blur, int inside, int outside, double reach, bool bent = true);

    /// Number of samples to either side of the initial estimate, which is one more sample.
    int inside() const { return inside_; }
    int outside() const { return outside_; }
    double blur() const { return blur_; }

    struct Edge {
        double position = 0.0;   // pixels outwards from the initial estimate
        double contrast = 0.0;   // grey levels inside minus outside
        double residual = 0.0;   // mean square, squared grey levels
        double sharpness = 0.0;  // curvature of the sum of squares at the edge, per square pixel
        bool found = false;      // false: the best candidate is at an end of the reach
    };
    Edge find(const float* profile) const;

  private:
    static constexpr std::size_t columns = 4;
    static constexpr double spacing = 0.25;  // spacing between candidate edges, pixels
    using Columns = std::array<std::vector<double>, columns>;

    /// Values of the four terms at every sample for the edge `e`, before orthonormalisation.
    Columns terms(double e, bool bent) const;

    double blur_;
    int inside_, outside_;
    double first_;
    std::size_t candidates_ = 0, stride_ = 0;
    /// Orthonormal columns: for each column and each sample, the values of all candidates.
    std::array<std::vector<float>, columns> q_;
    /// Contribution of each column to the contrast, for each candidate.
    Columns contrast_;
};

}  // namespace swirl::tracking
