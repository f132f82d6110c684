// Detects discs or spheres in a video: circles of one or two sizes within the container.
//
//   survey   On frames spread over the video, for every radius from a twenty-fifth to 40 % of the
//            container's and both polarities: votes, and the best circles that do not overlap. The
//            radius whose circles explain the greatest length of edges is that of the discs.
//            (Highlights are better circles, but short.) A size that most frames contradict is
//            replaced by the next best one (particle_size.hpp). Then all radii from 0.6 to 1.9
//            times that compete. Fits with free radius decide between one and two species: two if
//            the gap between the sizes is wide compared with the scatter within each.
//   find     In each frame: votes with the known radii, then fits with fixed radius, best first.
//            `sure` particles do not overlap and have enough of their edge. The others are
//            candidates for a search near the expected position of a missing disc.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "swirl/run/failure.hpp"
#include "track/video/circles.hpp"
#include "track/video/container_rim.hpp"
#include "track/video/lens.hpp"

namespace swirl::tracking {

class AppearanceTemplate;

struct ParticleSpecies {
    double radius = 0.0;     // pixels
    double scatter = 0.0;    // standard deviation of the radii of single fits
    std::size_t number = 0;  // number of discs of this species
};

/// Finds balls by their shading (shading_detection.hpp).
struct ShadingFilter {
    Vec2 towards{1.0, 0.0};   // direction in which the brightness of a ball grows
    double radius = 0.0;      // pixels
    double min_height = 0.0;  // height of the response to a ball
};

/// What discs of a video look like.
struct ParticleAppearance {
    Polarity polarity = 1;
    std::vector<ParticleSpecies> species;  // one or two, the smaller first
    std::size_t number = 0;                // number of all discs
    std::size_t opposite = 0;              // discs of the other brightness, which are not tracked
    double blur = 0.6;                     // applied to frames against noise, pixels
    double sure = 0.45;                    // support that makes a circle a sure particle
    /// Contact distance relative to the sum of radii: above 1 if circles are a part of each disc.
    double spacing = 1.0;
    double contact = 1.0;  // below 1 if circles are too large, so that discs in contact overlap
    Lens lens;
    double steepest = 1.0;  // radius of the steepest brightness slope relative to the disc's: below
                            // 1 for a shaded edge
    std::vector<EdgeProfile>
        edge_profiles;  // profiles of each species, with the blur of this video

    std::optional<ShadingFilter> shading;  // set if edges do not show the discs
    /// Set if edges alone are too poor (appearance_template.hpp).
    std::shared_ptr<const AppearanceTemplate> appearance_template;

    double radius() const { return species.front().radius; }
};

struct DetectedParticle {
    Vec2 centre{0.0, 0.0};
    std::size_t species = 0;
    double support = 0.0, error = 0.0;
    bool sure = false;
    double delay = 0.0;  // its time after that of the frame, by a rolling shutter
};

/// Circles are found, but the frames contradict that they are discs.
class UncertainDiscs : public Failure {
  public:
    using Failure::Failure;
};

/// Properties of the discs that the user gave.
struct KnownDiscs {
    std::optional<std::size_t> number;
    std::optional<double> radius_share;  // radius relative to the container's
};
/// Throws Failure if there are no discs, or if most frames contradict their size.
ParticleAppearance survey_particles(const std::vector<PreparedFrame>& frames,
                                    const std::vector<CircleFit>& rims, const KnownDiscs& known,
                                    unsigned threads);

/// The number of discs of the same size, but darker than the floor if the others are brighter, and
/// vice versa: the median over the frames.
std::size_t count_opposite_discs(const std::vector<PreparedFrame>& frames,
                                 const std::vector<CircleFit>& rims,
                                 const ParticleAppearance& appearance);

/// Blur of the survey frames, pixels.
inline constexpr double survey_blur = 0.6;

std::vector<DetectedParticle> find_particles(const PreparedFrame& frame, const CircleFit& rim,
                                             const ParticleAppearance& appearance);

/// Finds a disc that must be near `expected` but was not detected: the circle with most support
/// within half a radius that does not overlap `others`, or the best match of the template.
std::optional<DetectedParticle> find_particle_near(const PreparedFrame& frame, const CircleFit& rim,
                                                   const ParticleAppearance& appearance,
                                                   const Vec2& expected, std::size_t species,
                                                   const std::vector<DetectedParticle>& others);

}  // namespace swirl::tracking
