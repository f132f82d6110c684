#include "track/video/particle_detection.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "swirl/math/unit_circle.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/parallel_for.hpp"
#include "track/video/appearance_template.hpp"
#include "track/video/particle_size.hpp"
#include "track/video/robust_statistics.hpp"
#include "track/video/shading_detection.hpp"

namespace swirl::tracking {

namespace {

constexpr double sure_support = 0.45, any_support = 0.16;
/// Two circles nearer than this fraction of the sum of radii are one disc.
constexpr double same_distance = 0.25;
/// For particles found with the template: score of a disc, and least distance of two discs.
constexpr double disc_score = 0.5, free_distance = 0.86;

/// The edge pixels inside the container, without those of its wall.
std::vector<EdgePixel> edges_inside(const PreparedFrame& frame, const CircleFit& rim) {
    const Vec2 centre = frame.to_small(rim.centre);
    const double radius = rim.radius * frame.shrink - 1.0;
    std::vector<EdgePixel> inside;
    for (const EdgePixel& e : frame.edges) {
        const double x = double(e.x) - centre.x, y = double(e.y) - centre.y;
        if (x * x + y * y < radius * radius) inside.push_back(e);
    }
    return inside;
}

RaySettings rays_for(const PreparedFrame& frame, double radius) {
    RaySettings rays;
    rays.rays = std::clamp(int(pi * radius), 28, 96);
    rays.window = std::max(3.0, 0.17 * radius);
    rays.minimum = 2.5 * frame.noise;
    rays.tolerance = std::max(1.2, 0.06 * radius);
    return rays;
}

/// Below this radius in pixels, edge profiles are too short to fit all terms (edge_profile.hpp).
constexpr double small_discs = 18.0;

/// Window of 0.22 radii inside the edge and 0.16 outside; at most four pixels outside, because of
/// neighbours.
EdgeProfile edge_profile_for(double radius, double blur) {
    const int inside = std::clamp(int(0.22 * radius / EdgeProfile::step), 5, 14);
    const int outside = std::clamp(int(0.16 * radius / EdgeProfile::step), 5, 8);
    return EdgeProfile(blur, inside, outside, std::clamp(0.1 * radius, 1.5, 3.0),
                       radius > small_discs);
}

/// One or two species, separated by the gap that splits the radii best.
std::vector<ParticleSpecies> species_of(std::vector<double> radii) {
    std::sort(radii.begin(), radii.end());
    const auto species = [&](std::size_t from, std::size_t to) {
        const std::vector<double> part(radii.begin() + std::ptrdiff_t(from),
                                       radii.begin() + std::ptrdiff_t(to));
        ParticleSpecies result;
        result.radius = median(part);
        std::vector<double> off;
        for (const double r : part) off.push_back(std::abs(r - result.radius));
        result.scatter = mad_to_sigma * median(off);
        result.number = part.size();
        return result;
    };
    const std::size_t n = radii.size();
    const ParticleSpecies one = species(0, n);
    std::size_t best = 0;
    double best_square = 0.0, sum = 0.0, total = 0.0;
    for (const double r : radii) total += r;
    for (std::size_t k = 1; k < n; ++k) {  // Otsu: the largest variance between the two
        sum += radii[k - 1];
        const double low = sum / double(k), high = (total - sum) / double(n - k);
        const double square = double(k) * double(n - k) * (high - low) * (high - low);
        if (square > best_square) best_square = square, best = k;
    }
    if (best == 0) return {one};
    const ParticleSpecies small = species(0, best), large = species(best, n);
    const double gap = large.radius - small.radius;
    // A sphere with a dark patch at its edge looks smaller, by varying amounts: by up to 6.7 times
    // the scatter of the others in a video of the tests.
    constexpr double min_gap_in_scatters = 8.0, min_gap_in_radii = 0.08;
    constexpr std::size_t min_share = 40;  // one in 40 circles
    const bool two = gap > min_gap_in_radii * small.radius &&
                     gap > min_gap_in_scatters * std::max(small.scatter, large.scatter) &&
                     std::min(small.number, large.number) * min_share > n;
    if (!two) return {one};
    return {small, large};
}

/// A circle in one of the survey frames.
struct FoundCircle {
    std::size_t frame;
    Vec2 centre;
    double radius;
};

/// Distance of circles in contact relative to the sum of their radii: the onset of the distances.
/// 0 if there are too few.
double contact_distance(const std::vector<FoundCircle>& circles, const std::vector<CircleFit>& fits,
                        double spacing) {
    std::vector<double> apart;
    for (std::size_t a = 0; a < circles.size(); ++a)
        for (std::size_t b = a + 1; b < circles.size() && circles[b].frame == circles[a].frame;
             ++b) {
            if (!fits[a].good || !fits[b].good) continue;
            const double ratio = length(fits[a].centre - fits[b].centre) /
                                 (spacing * (fits[a].radius + fits[b].radius));
            if (ratio > 0.8 && ratio < 1.25) apart.push_back(ratio);
        }
    constexpr std::size_t min_pairs = 60;
    constexpr double window = 0.02;
    if (apart.size() < min_pairs) return 0.0;
    return onset(apart, window);
}

/// Centres and radii from edge profiles with the given blur.
std::vector<CircleFit> exact_fits(const std::vector<PreparedFrame>& frames,
                                  const std::vector<FoundCircle>& circles, double radius,
                                  Polarity polarity, double blur, unsigned threads) {
    const EdgeProfile edge_profile = edge_profile_for(radius / frames.front().shrink, blur);
    std::vector<CircleFit> fits(circles.size());
    const auto fit_one = [&](std::size_t k) {
        const FoundCircle& circle = circles[k];
        const PreparedFrame& p = frames[circle.frame];
        RaySettings rays = rays_for(p, circle.radius);
        rays.free_radius = true;
        rays.edge_profile = &edge_profile;
        fits[k] = fit_circle(p.sharp, circle.centre, circle.radius, polarity, rays);
    };
    parallel_for(circles.size(), fit_one, threads);
    return fits;
}

/// The blur of the video, for which edge profiles fit well and discs in contact are one sum of
/// radii apart. Neither criterion suffices. Shading changes an edge like more blur, so in poor
/// images the fits alone give too much blur and too small radii. The contact distance has an onset
/// that is known only to a few per cent.
double find_blur(const std::vector<PreparedFrame>& frames, const std::vector<FoundCircle>& circles,
                 const CommonCircle& common, unsigned threads) {
    constexpr std::array trials{0.6, 0.8, 1.0, 1.25, 1.6, 2.0};
    constexpr double onset_of_contacts = 1.01, onset_error = 0.04;
    constexpr std::size_t min_fits = 4;
    std::array<double, trials.size()> score{};
    for (std::size_t k = 0; k < trials.size(); ++k) {
        const auto fits =
            exact_fits(frames, circles, common.radius, common.polarity, trials[k], threads);
        std::vector<double> residuals;
        for (const CircleFit& fit : fits)
            if (fit.good) residuals.push_back(fit.profile_residual);
        const double contact = contact_distance(circles, fits, common.spacing);
        const double off = contact > 0.0 ? (contact - onset_of_contacts) / onset_error : 0.0;
        score[k] = residuals.size() < min_fits
                       ? 1e300
                       : std::log(std::max(median(residuals), 1e-6)) + off * off;
    }
    const auto best = std::size_t(std::min_element(score.begin(), score.end()) - score.begin());
    if (best == 0 || best + 1 == trials.size() || score[best] == 1e300) return trials[best];
    constexpr double trial_ratio = 1.26;  // ratio of neighbouring trials, on average
    const double bend = score[best - 1] - 2.0 * score[best] + score[best + 1];
    const double shift = 0.5 * (score[best - 1] - score[best + 1]) / bend;
    return trials[best] * std::pow(trial_ratio, std::clamp(shift, -0.5, 0.5));
}

/// Circles of frame k with radii around the common one, from fits with free radius.
std::vector<CircleFit> fit_free_circles(const ParticleSurvey& survey, std::size_t k,
                                        const CommonCircle& common) {
    // Range of the free radius, relative to the common radius. If the common circle is only a part
    // of each disc, there is no second size.
    const bool part = common.spacing > 1.0;
    const double smallest = part ? 0.85 : 0.6, largest = part ? 1.2 : 1.9;
    constexpr double growth = 1.07;
    constexpr double vote_support = 0.35, fit_support = 0.33;
    constexpr std::size_t max_candidates = 600;
    const PreparedFrame& frame = survey.frames[k];
    std::vector<CircleCandidate> all;
    for (double factor = smallest; factor < largest; factor *= growth) {
        const auto found = vote(survey.edges[k], frame.small.size(), common.radius * factor,
                                common.polarity, vote_support, max_candidates);
        all.insert(all.end(), found.begin(), found.end());
    }
    for (CircleCandidate& c : all) c.centre = frame.to_sharp(c.centre), c.radius /= frame.shrink;
    std::vector<CircleFit> fits;
    for (const CircleCandidate& c : best_candidates(all, common.spacing)) {
        RaySettings rays = rays_for(frame, c.radius);
        rays.free_radius = true;
        const CircleFit fit = fit_circle(frame.sharp, c.centre, c.radius, common.polarity, rays);
        if (fit.good && fit.support >= fit_support &&
            within(survey.rims[k], fit.centre, fit.radius))
            fits.push_back(fit);
    }
    std::sort(fits.begin(), fits.end(),
              [](const CircleFit& a, const CircleFit& b) { return a.support > b.support; });
    return without_overlaps(fits, common.spacing);
}

/// Sets the blur of frames, the edge profiles and the support of sure particles.
void set_edge_parameters(const ParticleSurvey& survey, const std::vector<FoundCircle>& circles,
                         const std::vector<CircleFit>& fits, double blur,
                         ParticleAppearance& appearance) {
    std::vector<double> ratios, supports, clarity;
    for (std::size_t k = 0; k < circles.size(); ++k) {
        if (!fits[k].good) continue;
        ratios.push_back(circles[k].radius / fits[k].radius);
        supports.push_back(fits[k].support);
        const double noise = survey.frames[circles[k].frame].noise;
        if (noise > 0.0) clarity.push_back(fits[k].contrast / noise);
    }
    appearance.steepest = std::clamp(median(ratios), 0.85, 1.05);
    // Sharp frames stay sharp; blur helps if edges hardly stand out from the noise.
    constexpr double clear_enough = 60.0;  // ratio of contrast to noise that needs no blur
    if (!clarity.empty())
        appearance.blur = std::clamp(0.6 * std::sqrt(clear_enough / std::max(median(clarity), 1.0)),
                                     0.6, std::clamp(0.1 * appearance.radius(), 0.6, 2.0));
    // Frames may be blurred more in the search than in the survey.
    const double search_blur = std::sqrt(
        std::max(0.2, blur * blur - survey_blur * survey_blur + appearance.blur * appearance.blur));
    for (const ParticleSpecies& one : appearance.species)
        appearance.edge_profiles.push_back(edge_profile_for(one.radius, search_blur));
    // Soft or faint edges have less support, so the threshold follows the typical support.
    appearance.sure = std::clamp(0.8 * median(supports), 0.3, sure_support);
}

/// Fits the lens to the apparent sizes of equal discs, and converts radii to those at the image
/// centre.
void set_lens(const cv::Size& image, const std::vector<CircleFit>& fits,
              ParticleAppearance& appearance) {
    constexpr double same_species = 0.2;  // radii
    std::vector<ApparentSize> sizes;
    for (const CircleFit& fit : fits) {
        if (!fit.good || fit.support < appearance.sure) continue;
        double nearest = 1e300, size = 0.0;
        for (const ParticleSpecies& one : appearance.species)
            if (std::abs(fit.radius - one.radius) < nearest) {
                nearest = std::abs(fit.radius - one.radius);
                size = fit.radius / one.radius;
            }
        if (nearest < same_species * appearance.radius()) sizes.push_back({fit.centre, size});
    }
    Lens& lens = appearance.lens;
    lens = fit_lens(sizes, {0.5 * (image.width - 1), 0.5 * (image.height - 1)}, 0.5 * image.height);
    lens.ball_radius = appearance.radius();
    lens.combine_distortions();
    if (lens.k == 0.0) return;
    std::vector<double> ratios;
    for (const ApparentSize& s : sizes) ratios.push_back(s.size / lens.seen_radius(s.centre, 1.0));
    const double factor = median(ratios);
    for (ParticleSpecies& one : appearance.species) one.radius *= factor;
}

/// Sets the number of discs of each species: the most common count per frame.
void set_numbers(const std::vector<std::vector<double>>& radii_by_frame,
                 ParticleAppearance& appearance) {
    const auto most_common = [&](auto&& count_in) {
        std::map<std::size_t, std::size_t> times;
        for (const auto& radii : radii_by_frame) ++times[count_in(radii)];
        std::size_t mode = 0, maximum = 0;
        for (const auto& [count, often] : times)
            if (often >= maximum) mode = count, maximum = often;
        return mode;
    };
    std::vector<ParticleSpecies>& species = appearance.species;
    appearance.number = most_common([](const std::vector<double>& radii) { return radii.size(); });
    species[0].number = appearance.number;
    if (species.size() < 2) return;
    const double border = 0.5 * (species[0].radius + species[1].radius);
    species[1].number = most_common([&](const std::vector<double>& radii) {
        return std::size_t(
            std::count_if(radii.begin(), radii.end(), [&](double r) { return r > border; }));
    });
    species[0].number -= std::min(appearance.number, species[1].number);
}

/// Refines the position of a disc that is known to a pixel or two.
void refine_position(DetectedParticle& particle, const std::vector<DetectedParticle>& all,
                     const PreparedFrame& frame, const ParticleAppearance& appearance) {
    const double radius = appearance.species[particle.species].radius;
    const double seen = appearance.lens.seen_radius(particle.centre, radius);
    RaySettings rays = rays_for(frame, radius);
    // The true radius is used: on the dark side of a sphere, the edge is not at the steepest slope,
    // so a free circle is too small and displaced to the bright side.
    const CircleFit whole =
        fit_circle(frame.sharp, particle.centre, seen, appearance.polarity, rays);
    if (whole.good && length(whole.centre - particle.centre) < 0.2 * radius)
        particle.centre = whole.centre;
    rays.edge_profile = &appearance.edge_profiles[particle.species];
    rays.edge_profile_alone = true;
    for (const DetectedParticle& other : all) {
        if (&other == &particle || !other.sure) continue;
        const double size =
            appearance.lens.seen_radius(other.centre, appearance.species[other.species].radius);
        if (length(other.centre - particle.centre) < radius + size + 8.0)
            rays.others.push_back({other.centre, size + 0.5});
    }
    const CircleFit fit = fit_circle(frame.sharp, particle.centre, seen, appearance.polarity, rays);
    // The steepest slopes err towards the lamp, edge profiles with the texture. The errors are
    // independent, so a weighted mean is better than both; those of profiles are smaller.
    const double profile_weight = radius > small_discs ? 0.7 : 0.5;
    if (!fit.good || length(fit.centre - particle.centre) > std::max(1.5, 0.06 * radius)) return;
    particle.centre = (1.0 - profile_weight) * particle.centre + profile_weight * fit.centre;
    particle.error = fit.error;
}

/// Sets the weighted mean of the positions by edge and by template.
void combine_positions(DetectedParticle& particle, const Vec2& by_edge,
                       const AppearanceTemplate::Excess& excess,
                       const std::vector<DetectedParticle>& all,
                       const ParticleAppearance& appearance) {
    const AppearanceTemplate& by_template = *appearance.appearance_template;
    const auto others = sure_others(all, particle, appearance);
    const auto fit = by_template.fit(excess, particle.centre, particle.species, others);
    const Vec2 position = fit.good ? fit.centre : particle.centre;
    particle.centre = (1.0 - by_template.weight()) * by_edge + by_template.weight() * position;
    particle.error = std::max(particle.error, by_template.error());
}

double contact_distance(const DetectedParticle& a, const DetectedParticle& b,
                        const ParticleAppearance& appearance) {
    return appearance.spacing *
           (appearance.species[a.species].radius + appearance.species[b.species].radius);
}

/// True if one of `others` is nearer than this fraction of the contact distance.
bool overlaps(const std::vector<DetectedParticle>& others, const DetectedParticle& particle,
              double distance, const ParticleAppearance& appearance) {
    return std::any_of(others.begin(), others.end(), [&](const DetectedParticle& other) {
        return length(other.centre - particle.centre) <
               distance * contact_distance(other, particle, appearance);
    });
}

/// Finds the particles of a frame that match the template, the best first, with or without edges.
class TemplateSearch {
  public:
    /// `particles` were found by their edges.
    TemplateSearch(const PreparedFrame& frame, const CircleFit& rim,
                   const ParticleAppearance& appearance,
                   const std::vector<DetectedParticle>& particles)
        : appearance_(appearance),
          template_(*appearance.appearance_template),
          rim_(rim),
          excess_(template_.excess(frame.sharp, rim, particles)) {
        for (const DetectedParticle& b : particles)
            if (template_.inside(excess_, b.centre, b.species))
                open_.push_back(
                    {b, b.centre, template_.score(excess_, b.centre, b.species, {}, 2)});
    }

    /// Accepts particles that were found by their edges.
    void accept_with_edges() {
        for (std::size_t k; (k = best_open()) < open_.size();) accept(k);
    }
    /// Searches for particles without edges until the number of discs is reached.
    void accept_without_edges() {
        while (accepted_.size() < appearance_.number) {
            Candidate best = best_without_edge();
            if (best.score < 0.5 * disc_score) return;
            fit_and_score(best);
            best.by_edge = best.particle.centre;
            if (best.score < disc_score || is_covered(best.particle, free_distance)) return;
            best.particle.error = template_.error();
            open_.push_back(best);
            accept(open_.size() - 1);
        }
    }
    /// The accepted particles at their final positions; the others remain as candidates.
    std::vector<DetectedParticle> found() {
        for (std::size_t k = 0; k < accepted_.size(); ++k)
            combine_positions(accepted_[k], edges_[k], excess_, accepted_, appearance_);
        for (Candidate& c : open_) {
            if (is_covered(c.particle, same_distance)) continue;
            c.particle.sure = false;
            c.particle.support = std::max(c.score, 0.01);
            accepted_.push_back(c.particle);
        }
        return std::move(accepted_);
    }

  private:
    struct Candidate {
        DetectedParticle particle;
        Vec2 by_edge;
        double score;
    };

    bool is_covered(const DetectedParticle& particle, double distance) const {
        return overlaps(accepted_, particle, distance, appearance_);
    }
    double score(const DetectedParticle& particle) const {
        return template_.score(excess_, particle.centre, particle.species,
                               sure_others(accepted_, particle, appearance_), 2);
    }
    /// Moves a candidate to its best position and scores it.
    void fit_and_score(Candidate& c) const {
        const auto fit = template_.fit(excess_, c.particle.centre, c.particle.species,
                                       sure_others(accepted_, c.particle, appearance_), 2);
        if (fit.good) c.particle.centre = fit.centre;
        c.score = score(c.particle);
    }
    void accept(std::size_t k) {
        Candidate c = open_[k];
        fit_and_score(c);
        open_.erase(open_.begin() + std::ptrdiff_t(k));
        c.particle.sure = true;
        c.particle.support = c.score;
        accepted_.push_back(c.particle);
        edges_.push_back(c.by_edge);
        for (Candidate& o : open_)
            if (length(o.particle.centre - c.particle.centre) <
                1.3 * contact_distance(o.particle, c.particle, appearance_))
                o.score = score(o.particle);
    }
    /// Index of the best open candidate; open_.size() if there is none.
    std::size_t best_open() const {
        std::size_t best = open_.size();
        for (std::size_t k = 0; k < open_.size(); ++k) {
            if (open_[k].score < disc_score ||
                (best < open_.size() && open_[k].score <= open_[best].score))
                continue;
            if (!is_covered(open_[k].particle, free_distance)) best = k;
        }
        return best;
    }
    /// The best match on a grid over the container; score 0 if there is none.
    Candidate best_without_edge() const {
        Candidate best{};
        for (std::size_t species = 0; species < appearance_.species.size(); ++species) {
            const double stride = 0.3 * appearance_.species[species].radius;
            for (double x = -rim_.radius; x < rim_.radius; x += stride)
                for (double y = -rim_.radius; y < rim_.radius; y += stride) {
                    Candidate c{{rim_.centre + Vec2{x, y}, species, 0.0, 0.0, false}, {}, 0.0};
                    if (!template_.inside(excess_, c.particle.centre, species)) continue;
                    if (!appearance_.shading &&
                        !(template_.excess_at(excess_, c.particle.centre) > 0.3 * template_.soft()))
                        continue;
                    if (is_covered(c.particle, min_distance)) continue;
                    c.score = score(c.particle);
                    if (c.score > best.score) best = c;
                }
        }
        return best;
    }

    const ParticleAppearance& appearance_;
    const AppearanceTemplate& template_;
    const CircleFit& rim_;
    AppearanceTemplate::Excess excess_;
    std::vector<Candidate> open_;
    std::vector<DetectedParticle> accepted_;
    std::vector<Vec2> edges_;  // positions by edge of the accepted particles
};

std::vector<DetectedParticle> search_with_template(const std::vector<DetectedParticle>& particles,
                                                   const PreparedFrame& frame, const CircleFit& rim,
                                                   const ParticleAppearance& appearance) {
    TemplateSearch search(frame, rim, appearance, particles);
    search.accept_with_edges();
    search.accept_without_edges();
    return search.found();
}

constexpr double search_step = 0.15, search_reach = 0.45;  // radii

std::optional<DetectedParticle> find_near_with_template(
    const PreparedFrame& frame, const CircleFit& rim, const ParticleAppearance& appearance,
    const Vec2& expected, std::size_t species, const std::vector<DetectedParticle>& others) {
    constexpr double reach = 2.0 * search_reach + 1e-9;
    const double radius = appearance.species[species].radius;
    const AppearanceTemplate& by_template = *appearance.appearance_template;
    const AppearanceTemplate::Excess excess = by_template.excess(frame.sharp, rim, others);
    DetectedParticle best;
    best.species = species;
    for (double x = -2.0 * search_reach; x <= reach; x += search_step)
        for (double y = -2.0 * search_reach; y <= reach; y += search_step) {
            DetectedParticle trial = best;
            trial.centre = expected + radius * Vec2{x, y};
            trial.support = by_template.score(excess, trial.centre, species,
                                              sure_others(others, trial, appearance), 2);
            if (trial.support > best.support) best = trial;
        }
    if (best.support < 0.7 * disc_score) return std::nullopt;
    const auto fit =
        by_template.fit(excess, best.centre, species, sure_others(others, best, appearance));
    if (fit.good) best.centre = fit.centre;
    if (overlaps(others, best, free_distance, appearance)) return std::nullopt;
    best.error = 2.0 * by_template.error();
    return best;
}

/// Repeats a fit of low support from several starting points around it. Patches of the texture
/// mislead votes, and a fit that starts there may end on the patch.
DetectedParticle refit_from_around(const DetectedParticle& particle, const PreparedFrame& frame,
                                   const ParticleAppearance& appearance) {
    constexpr double distance = 0.2;  // radii
    constexpr int starts = 8;
    const double radius = appearance.steepest * appearance.species[particle.species].radius;
    RaySettings rays = rays_for(frame, radius);
    DetectedParticle best = particle;
    for (int k = 0; k < starts; ++k) {
        const Vec2 seed = particle.centre + distance * radius * unit_circle(double(k) / starts);
        const CircleFit fit =
            fit_circle(frame.sharp, seed, appearance.lens.seen_radius(seed, radius),
                       appearance.polarity, rays);
        if (!fit.good || fit.support <= best.support ||
            length(fit.centre - particle.centre) > 2.0 * distance * radius)
            continue;
        best.centre = fit.centre;
        best.support = fit.support;
        best.error = fit.error;
    }
    return best;
}

}  // namespace

ParticleAppearance survey_particles(const std::vector<PreparedFrame>& frames,
                                    const std::vector<CircleFit>& rims, const KnownDiscs& known,
                                    unsigned threads) {
    ParticleSurvey survey{frames, rims};
    for (std::size_t k = 0; k < frames.size(); ++k)
        survey.edges.push_back(edges_inside(frames[k], rims[k]));
    const CommonCircle common = find_common_circle(survey, known);
    if (!(common.score > 0.0))
        throw Failure(
            "the container was found, but no discs: no circles stand out from its floor.");
    std::vector<FoundCircle> circles;
    for (std::size_t k = 0; k < frames.size(); ++k) {
        if (!rims[k].good) continue;
        for (const CircleFit& fit : fit_free_circles(survey, k, common))
            circles.push_back({k, fit.centre, fit.radius});
    }
    const double blur = find_blur(frames, circles, common, threads);
    const std::vector<CircleFit> fits =
        exact_fits(frames, circles, common.radius, common.polarity, blur, threads);
    std::vector<double> radii;
    std::vector<std::vector<double>> radii_by_frame(frames.size());
    for (std::size_t k = 0; k < circles.size(); ++k) {
        if (!fits[k].good) continue;
        radii.push_back(fits[k].radius);
        radii_by_frame[circles[k].frame].push_back(fits[k].radius);
    }
    if (radii.empty())
        throw Failure(
            "the container was found, but no discs: its circles have no sharp edges.\n"
            "hint: the video may be out of focus, or discs and floor too similar in brightness.");
    ParticleAppearance appearance;
    appearance.polarity = common.polarity;
    appearance.spacing = common.spacing;
    appearance.species = species_of(radii);
    set_edge_parameters(survey, circles, fits, blur, appearance);
    set_lens(frames.front().sharp.size(), fits, appearance);
    set_numbers(radii_by_frame, appearance);
    return appearance;
}

std::size_t count_opposite_discs(const std::vector<PreparedFrame>& frames,
                                 const std::vector<CircleFit>& rims,
                                 const ParticleAppearance& appearance) {
    constexpr double clear_support = 0.6;  // a gap between six discs has less
    constexpr double max_off = 0.25;       // share of the radius
    ParticleSurvey survey{frames, rims};
    const double radius = appearance.radius();
    CommonCircle same{1.0, radius * frames.front().shrink, appearance.polarity, appearance.spacing};
    CommonCircle opposite = same;
    opposite.polarity = -same.polarity;
    std::vector<double> numbers;
    for (std::size_t k = 0; k < frames.size(); ++k) {
        survey.edges.push_back(edges_inside(frames[k], rims[k]));
        if (!rims[k].good) continue;
        const std::vector<CircleFit> discs = fit_free_circles(survey, k, same);
        const std::vector<CircleFit> others = fit_free_circles(survey, k, opposite);
        numbers.push_back(
            double(std::count_if(others.begin(), others.end(), [&](const CircleFit& other) {
                return other.support > clear_support &&
                       std::abs(other.radius - radius) < max_off * radius &&
                       std::none_of(discs.begin(), discs.end(), [&](const CircleFit& disc) {
                           return length(disc.centre - other.centre) <
                                  min_distance * (disc.radius + other.radius);
                       });
            })));
    }
    return numbers.empty() ? 0 : std::size_t(median(numbers));
}

std::optional<DetectedParticle> find_particle_near(const PreparedFrame& frame, const CircleFit& rim,
                                                   const ParticleAppearance& appearance,
                                                   const Vec2& expected, std::size_t species,
                                                   const std::vector<DetectedParticle>& others) {
    if (appearance.appearance_template)
        return find_near_with_template(frame, rim, appearance, expected, species, others);
    constexpr double min_gap = 0.88;  // share of the sum of radii
    const double radius = appearance.species[species].radius;
    const RaySettings rays = rays_for(frame, appearance.steepest * radius);
    DetectedParticle best;
    best.species = species;
    for (double x = -search_reach; x <= search_reach + 1e-9; x += search_step)
        for (double y = -search_reach; y <= search_reach + 1e-9; y += search_step) {
            const Vec2 seed = expected + radius * Vec2{x, y};
            const CircleFit fit = fit_circle(
                frame.sharp, seed, appearance.steepest * appearance.lens.seen_radius(seed, radius),
                appearance.polarity, rays);
            if (!fit.good || length(fit.centre - expected) > search_reach * radius) continue;
            const DetectedParticle found{fit.centre, species, fit.support, fit.error, false};
            if (fit.support > best.support && !overlaps(others, found, min_gap, appearance))
                best = found;
        }
    if (best.support < any_support) return std::nullopt;
    refine_position(best, others, frame, appearance);
    return best;
}

std::vector<DetectedParticle> find_particles(const PreparedFrame& frame, const CircleFit& rim,
                                             const ParticleAppearance& appearance) {
    if (appearance.shading) {
        const std::vector<DetectedParticle> found =
            find_by_shading(frame.sharp, rim, *appearance.shading, appearance.number);
        return appearance.appearance_template ? search_with_template(found, frame, rim, appearance)
                                              : found;
    }
    const std::vector<EdgePixel> edges = edges_inside(frame, rim);
    std::vector<DetectedParticle> all;
    for (std::size_t species = 0; species < appearance.species.size(); ++species) {
        const double radius = appearance.steepest * appearance.species[species].radius;
        const double area = rim.radius * rim.radius / (radius * radius);
        const auto candidates =
            vote(edges, frame.small.size(), radius * frame.shrink, appearance.polarity, 0.18,
                 std::min(std::size_t(1.3 * area) + 4, 3 * appearance.number + 8));
        RaySettings rays = rays_for(frame, radius);
        rays.rays = std::max(28, rays.rays / 2);  // positions are refined later
        for (const CircleCandidate& c : candidates) {
            const Vec2 seed = frame.to_sharp(c.centre);
            if (!within(rim, seed, radius)) continue;
            const CircleFit fit =
                fit_circle(frame.sharp, seed, appearance.lens.seen_radius(seed, radius),
                           appearance.polarity, rays);
            if (!fit.good || fit.support < any_support || !within(rim, fit.centre, radius))
                continue;
            all.push_back({fit.centre, species, fit.support, fit.error, false});
        }
    }
    std::stable_sort(
        all.begin(), all.end(),
        [](const DetectedParticle& a, const DetectedParticle& b) { return a.support > b.support; });
    std::vector<DetectedParticle> accepted;
    std::vector<DetectedParticle> sure;
    for (DetectedParticle particle : all) {
        if (overlaps(accepted, particle, same_distance, appearance)) continue;
        bool is_covered = overlaps(sure, particle, min_distance, appearance);
        if (!is_covered && particle.support < appearance.sure) {
            particle = refit_from_around(particle, frame, appearance);
            is_covered = overlaps(sure, particle, min_distance, appearance);
        }
        particle.sure = !is_covered && particle.support >= appearance.sure;
        accepted.push_back(particle);
        if (particle.sure) sure.push_back(particle);
    }
    for (DetectedParticle& particle : accepted)
        refine_position(particle, accepted, frame, appearance);
    return appearance.appearance_template ? search_with_template(accepted, frame, rim, appearance)
                                          : accepted;
}

}  // namespace swirl::tracking
