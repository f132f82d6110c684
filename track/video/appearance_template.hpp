// Detects and locates discs by their mean appearance, for videos whose edges are too poor.
//
// A sphere of low contrast has dark patches of texture, and compression smears the rest of its
// edge. Circles fitted to edges (circles.hpp) are then displaced towards the bright side, by up to
// a pixel. The common appearance of all spheres of a video is known much better than a single
// edge. With F the floor (for each pixel the median over frames in which no disc covers it) and λ
// the illumination of the frame,
//
//     e(x) = s tanh((I(x)/λ − F(x)) / s)         the excess; its sign is reversed for dark discs
//
// separates disc from floor and suppresses texture; s is about a third of the typical contrast. The
// template T is the mean excess about the disc centres. Each disc is fitted by e(x) ≈ g T(x − p),
// with a narrow prior of the gain g. Gauss–Newton gives the position p; pixels of neighbours and of
// the wall are omitted. T is learned from the survey frames in a few rounds, from the positions
// given by edges. Their mean offset is kept, because T itself does not define a centre.
//
// The errors of both positions are independent, so their weighted mean is better than either. The
// weight minimises the overlaps of hard discs. Videos whose edges suffice do not use the template.
//
// Videos that need it: bright textured discs of 12 to 14 pixels radius, strong lens distortion, or
// low contrast. Without it the position error of 10 of 23 test videos grows by 29 to 145 %
// (bench/results/appearance_template.md).
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "swirl/math/vec2.hpp"
#include "track/video/particle_detection.hpp"

namespace swirl::tracking {

/// The sure particles other than `self` that may cover pixels of it or of its surroundings.
std::vector<NearCircle> sure_others(const std::vector<DetectedParticle>& all,
                                    const DetectedParticle& self,
                                    const ParticleAppearance& appearance);

class AppearanceTemplate {
  public:
    /// A survey frame and the particles that edges gave.
    struct Example {
        cv::Mat sharp;
        CircleFit rim;
        std::vector<DetectedParticle> particles;
    };
    /// None if there are too few examples, or if edges alone are about as good.
    static std::optional<AppearanceTemplate> learned(const std::vector<Example>& examples,
                                                     const ParticleAppearance& appearance,
                                                     unsigned threads);

    /// Weight of the template's position in the mean with the edge's: 0 to 1.
    double weight() const { return weight_; }
    /// Standard error per coordinate, pixels; from the overlaps of hard discs.
    double error() const { return error_; }

    /// The excess of a frame; `nowhere` outside the container.
    struct Excess {
        cv::Mat level;  // CV_32F
        Vec2 container;
    };
    Excess excess(const cv::Mat& sharp, const CircleFit& rim,
                  const std::vector<DetectedParticle>& particles) const;

    struct Fit {
        Vec2 centre;
        bool good = false;
    };
    Fit fit(const Excess& excess, const Vec2& centre, std::size_t species,
            const std::vector<NearCircle>& others, int stride = 1) const;
    /// One minus the squared deviation from the template relative to its square: 1 for a disc, 0
    /// for floor. Uses every `stride`th pixel of every `stride`th row.
    double score(const Excess& excess, const Vec2& centre, std::size_t species,
                 const std::vector<NearCircle>& others, int stride) const;
    double soft() const { return soft_; }
    /// True if a disc with that centre lies within the container.
    bool inside(const Excess& excess, const Vec2& centre, std::size_t species) const;
    double excess_at(const Excess& excess, const Vec2& position) const;

  private:
    AppearanceTemplate() = default;
    using Positions = std::vector<std::vector<Vec2>>;  // Positions of each particle of each example

    bool set_reach(const std::vector<Example>& examples);
    bool learn_contrast(const std::vector<Example>& examples);
    void learn_floor(const std::vector<Example>& examples, unsigned threads);
    cv::Mat median_floor(const std::vector<Example>& examples, unsigned threads,
                         cv::Mat& known) const;
    void learn_template(const std::vector<Example>& examples, const std::vector<Excess>& excesses,
                        const Positions& positions, std::size_t species, unsigned threads);
    std::optional<Positions> refined(const std::vector<Example>& examples,
                                     const std::vector<Excess>& excesses, const Positions& edges,
                                     const Positions& positions, unsigned threads);
    void choose_weight(const std::vector<Example>& examples, const Positions& edges,
                       const Positions& positions, double& square);
    /// Positions after one round of fits.
    struct Moved {
        std::vector<Vec2> positions, from_edges;
        std::vector<double> residuals;  // mean squares
    };
    Moved moved(const Example& example, const Excess& seen, const std::vector<Vec2>& edges,
                const std::vector<Vec2>& positions) const;
    double illumination(const cv::Mat& sharp, const CircleFit& rim,
                        const std::vector<DetectedParticle>& particles) const;
    cv::Mat free_floor(const cv::Size& size, const CircleFit& rim,
                       const std::vector<DetectedParticle>& particles) const;

    /// The pixels of a disc in one row, from column `from` to `to`. `hidden` starts at `from`,
    /// `level` at the image's edge.
    struct Row {
        int row, from, to;
        const float* level;
        const char* hidden;
        double scale;
    };
    template <typename Use>
    void each_row(const Excess& excess, const Vec2& centre, std::size_t species,
                  const std::vector<NearCircle>& others, int stride, Use&& use) const;
    struct Normal;
    Normal normal(const Excess& excess, const Vec2& centre, std::size_t species,
                  const std::vector<NearCircle>& others, int stride, double gain) const;
    template <typename Use>
    void each_pixel(const Excess& excess, const Vec2& centre, std::size_t species,
                    const std::vector<NearCircle>& others, int stride, Use&& use) const;

    struct SpeciesTemplate {
        double radius = 0.0, squares = 1.0;
        cv::Mat grid;  // T, ∂ₓT, ∂ᵧT and 0, floats
    };
    ParticleAppearance appearance_;
    cv::Mat floor_;
    std::vector<SpeciesTemplate> templates_;
    double reach_ = 0.0, soft_ = 0.0, variance_ = 0.0, weight_ = 0.0, error_ = 0.0;
};

}  // namespace swirl::tracking
