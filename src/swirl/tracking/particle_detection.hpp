// The discs in a film, or beads, or balls: circles of one or two sizes within the dish.
//
//   survey   on pictures spread over the film, for every radius from a twenty-fifth to a third of
//            the dish's and for both polarities: votes, and the circles that do not overlap, best
//            first; the radius whose circles explain the longest stretch of edges is that of the
//            discs (highlights are better circles, but short ones). Then all radii between half of
//            that and twice that compete; circles fitted with free radius tell one size from two:
//            two where the gap between the sizes is wide against the scatter within
//   find     in each picture: votes with the known radii, fits with the radius fixed, best first;
//            `sure` ones do not overlap and have enough of their edge, the rest are candidates for
//            whoever knows where a disc should be
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "swirl/tracking/circles.hpp"
#include "swirl/tracking/dish.hpp"
#include "swirl/tracking/lens.hpp"

namespace swirl {

class AppearanceTemplate;

struct ParticleKind {
    double radius = 0.0;     // pixels
    double scatter = 0.0;    // of the radii of single fits, standard deviation
    std::size_t number = 0;  // how many of this kind there are
};

struct ParticleLook {
    Polarity polarity = 1;
    std::vector<ParticleKind> kinds;  // one or two, the smaller first
    std::size_t number = 0;           // of all
    double blur = 0.6;   // by which pictures are to be smoothed for their noise, pixels
    double sure = 0.45;  // support from which on a circle is a disc
    Lens lens;
    double steepest = 1.0;  // where the brightness changes most, in radii: inside of a shaded limb
    std::vector<EdgeProfile> limbs;  // of each kind, with the blur of this film

    /// Where edges alone are too poor (appearance_template.hpp).
    std::shared_ptr<const AppearanceTemplate> appearance_template;

    double radius() const { return kinds.front().radius; }
};

struct Particle {
    Vec2 centre{0.0, 0.0};
    std::size_t kind = 0;
    double support = 0.0, error = 0.0;
    bool sure = false;
};

/// Throws Failure where there are none.
ParticleLook survey_particles(const std::vector<Picture>& pictures,
                              const std::vector<CircleFit>& rims, unsigned threads);

/// By how much the pictures of the survey are to be smoothed.
inline constexpr double survey_blur = 0.6;

std::vector<Particle> find_particles(const Picture& picture, const CircleFit& rim,
                                     const ParticleLook& look);

/// The disc that is known to be near there and was not found: the circle with most of an edge
/// within half a radius of it that is in nobody's way, however little that is. By the mean ball
/// where there is one.
std::optional<Particle> find_particle_near(const Picture& picture, const CircleFit& rim,
                                           const ParticleLook& look, const Vec2& where,
                                           std::size_t kind, const std::vector<Particle>& others);

}  // namespace swirl
