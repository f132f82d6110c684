// Discs by what they look like on the mean, for films whose edges are too poor.
//
// A ball of low contrast has patches as dark as the floor, and compression smears what is left of
// its edge; circles through edges (circles.hpp) then lean towards the bright side, by a pixel. What
// all balls of a film have in common is known much better than a single one: with F the floor (of
// each pixel the median over the pictures in which nobody is there), λ the lamp of the picture,
//
//     e(x) = s tanh((I(x)/λ − F(x)) / s)         the excess, ± for dark discs
//
// says ball or floor, and little about the texture, s being a third or so of the usual contrast.
// Its mean about the discs' places, T, is compared with each: e(x) ≈ T(x − p)(g + modes), four
// modes of second order for shading and texture with a narrow prior, p by Gauss–Newton; neighbours
// and the wall are left out. T is learned on the survey's pictures in a few rounds from the places
// of the edges, whose common offset is kept: of its own the mean has none.
//
// Both places err independently, so a mean of them is better than either. How much each counts is
// told by the film: hard discs do not lie in each other, and that share is taken with which they do
// least. Sharp films are left to the edges.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "swirl/math/vec2.hpp"
#include "swirl/tracking/particle_detection.hpp"

namespace swirl {

/// The sure ones that hide some of what is looked at of another, but for itself.
std::vector<NearCircle> sure_others(const std::vector<Particle>& all, const Particle& self,
                                    const ParticleLook& look);

class AppearanceTemplate {
  public:
    /// A picture of the survey and what was found in it by the edges.
    struct Example {
        cv::Mat sharp;
        CircleFit rim;
        std::vector<Particle> particles;
    };
    /// Nothing where the examples are too few, or the edges do as well alone.
    static std::optional<AppearanceTemplate> learned(const std::vector<Example>& examples,
                                                     const ParticleLook& look, unsigned threads);

    double counts() const { return counts_; }  // against the edges, 0 … 1
    double error() const { return error_; }    // of a coordinate, from overlaps that cannot be

    /// A picture as excess, of which there is none outside of the dish.
    struct Excess {
        cv::Mat level;  // floats; `nowhere` outside
        Vec2 container;
    };
    Excess excess(const cv::Mat& sharp, const CircleFit& rim,
                  const std::vector<Particle>& particles) const;

    struct Fit {
        Vec2 centre;
        bool good = false;
    };
    Fit fit(const Excess& excess, const Vec2& centre, std::size_t kind,
            const std::vector<NearCircle>& others, int stride = 1) const;
    /// 1 less the share of the mean ball's squares by which the picture differs from it: 1 is a
    /// ball, 0 the floor. With every `stride`th pixel of every `stride`th row.
    double score(const Excess& excess, const Vec2& centre, std::size_t kind,
                 const std::vector<NearCircle>& others, int stride) const;
    double soft() const { return soft_; }
    /// Whether a ball there would lie in the dish.
    bool inside(const Excess& excess, const Vec2& centre, std::size_t kind) const;
    double excess_at(const Excess& excess, const Vec2& place) const;

  private:
    AppearanceTemplate() = default;
    void learn_floor(const std::vector<Example>& examples, unsigned threads);
    void learn_ball(const std::vector<Example>& examples, const std::vector<Excess>& excesses,
                    const std::vector<std::vector<Vec2>>& places, std::size_t kind,
                    unsigned threads);
    struct Moved {
        std::vector<Vec2> places, from_edges;
        std::vector<double> rests;  // mean squares of what the ball leaves
    };
    Moved moved(const Example& example, const Excess& seen, const std::vector<Vec2>& edges,
                const std::vector<Vec2>& places) const;
    double illumination(const cv::Mat& sharp, const CircleFit& rim,
                        const std::vector<Particle>& particles) const;
    cv::Mat free_floor(const cv::Size& size, const CircleFit& rim,
                       const std::vector<Particle>& particles) const;

    /// A row of the pixels that a ball covers, from column `from` to `to`: `hidden` counts from
    /// `from`, `level` from the picture's edge.
    struct Row {
        int row, from, to;
        const float* level;
        const char* hidden;
        double scale;
    };
    template <typename Use>
    void each_row(const Excess& excess, const Vec2& centre, std::size_t kind,
                  const std::vector<NearCircle>& others, int stride, Use&& use) const;
    struct Normal;
    Normal normal(const Excess& excess, const Vec2& centre, std::size_t kind,
                  const std::vector<NearCircle>& others, int stride, double gain) const;
    template <typename Use>
    void each_pixel(const Excess& excess, const Vec2& centre, std::size_t kind,
                    const std::vector<NearCircle>& others, int stride, Use&& use) const;

    struct Look {  // of a kind
        double radius = 0.0, squares = 1.0;
        cv::Mat grid;  // T, its slopes, and nothing, floats
    };
    ParticleLook look_;
    cv::Mat floor_;
    std::vector<Look> balls_;
    double reach_ = 0.0, soft_ = 0.0, variance_ = 0.0, counts_ = 0.0, error_ = 0.0;
};

}  // namespace swirl
