#include "swirl/tracking/particle_detection.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "swirl/math/unit_circle.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/parallel_for.hpp"
#include "swirl/tracking/appearance_template.hpp"

namespace swirl {

namespace {

constexpr double sure_support = 0.45, any_support = 0.16;
/// Centres of hard discs are the sum of their radii apart; what is nearer than this share of it is
/// the same disc twice.
constexpr double min_distance = 0.8, same_distance = 0.25;
/// By the mean ball: the score of a ball, and how near two of them may seem.
constexpr double like_a_ball = 0.5, free_distance = 0.86;

/// The edges inside the dish; its wall's own are left out.
std::vector<EdgePixel> edges_inside(const Picture& picture, const CircleFit& rim) {
    const Vec2 centre = picture.to_small(rim.centre);
    const double radius = rim.radius * picture.shrink - 1.0;
    std::vector<EdgePixel> inside;
    for (const EdgePixel& e : picture.edges) {
        const double x = double(e.x) - centre.x, y = double(e.y) - centre.y;
        if (x * x + y * y < radius * radius) inside.push_back(e);
    }
    return inside;
}

/// The best ones that keep their distance.
std::vector<CircleCandidate> apart(std::vector<CircleCandidate> all) {
    std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
        return a.support * std::sqrt(a.radius) > b.support * std::sqrt(b.radius);
    });
    std::vector<CircleCandidate> kept;
    for (const CircleCandidate& c : all) {
        const bool free = std::none_of(kept.begin(), kept.end(), [&](const auto& k) {
            return length(k.centre - c.centre) < min_distance * (k.radius + c.radius);
        });
        if (free) kept.push_back(c);
    }
    return kept;
}

bool within(const CircleFit& rim, const Vec2& centre, double radius) {
    return length(centre - rim.centre) + radius < rim.radius + 0.3 * radius + 1.0;
}

RaySettings rays_for(const Picture& picture, double radius) {
    RaySettings rays;
    rays.rays = std::clamp(static_cast<int>(pi * radius), 28, 96);
    rays.window = std::max(3.0, 0.17 * radius);
    rays.minimum = 2.5 * picture.noise;
    rays.tolerance = std::max(1.2, 0.06 * radius);
    return rays;
}

/// Of fewer pixels a limb shows too little for all that is fitted to larger ones.
constexpr double small_discs = 18.0;

/// Windows of a fifth of the radius to either side, four pixels at most outside, where neighbours
/// are.
EdgeProfile edge_profile_for(double radius, double blur) {
    const int inside = std::clamp(static_cast<int>(0.22 * radius / EdgeProfile::step), 5, 14);
    const int outside = std::clamp(static_cast<int>(0.16 * radius / EdgeProfile::step), 5, 8);
    return EdgeProfile(blur, inside, outside, std::clamp(0.1 * radius, 1.5, 3.0),
                       radius > small_discs);
}

/// One size or two? The gap that splits the radii best.
std::vector<ParticleKind> kinds_of(std::vector<double> radii) {
    std::sort(radii.begin(), radii.end());
    const auto kind = [&](std::size_t from, std::size_t to) {
        const std::vector<double> part(radii.begin() + static_cast<std::ptrdiff_t>(from),
                                       radii.begin() + static_cast<std::ptrdiff_t>(to));
        ParticleKind k;
        k.radius = median(part);
        std::vector<double> off;
        for (const double r : part) off.push_back(std::abs(r - k.radius));
        k.scatter = 1.4826 * median(off);
        k.number = part.size();
        return k;
    };
    const std::size_t n = radii.size();
    const ParticleKind one = kind(0, n);
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
    const ParticleKind small = kind(0, best), large = kind(best, n);
    const double gap = large.radius - small.radius;
    // One ball that turns a dark patch of its texture to the rim seems smaller, by more in one
    // picture than in another: 6.7 times as much as these scatter in a film of the tests.
    constexpr double clear = 8.0;
    const bool two = gap > 0.08 * small.radius &&
                     gap > clear * std::max(small.scatter, large.scatter) &&
                     std::min(small.number, large.number) * 40 > n;
    if (!two) return {one};
    return {small, large};
}

}  // namespace

namespace {

/// A circle somewhere in the pictures.
struct Spot {
    std::size_t picture;
    Vec2 centre;
    double radius;
};

/// Circles in contact lie so far apart, in sums of their radii: where the distances become dense.
/// 0 where there are too few of them to tell.
double contact_distance(const std::vector<Spot>& spots, const std::vector<CircleFit>& fits) {
    std::vector<double> apart;
    for (std::size_t a = 0; a < spots.size(); ++a)
        for (std::size_t b = a + 1; b < spots.size() && spots[b].picture == spots[a].picture; ++b) {
            if (!fits[a].good || !fits[b].good) continue;
            const double ratio =
                length(fits[a].centre - fits[b].centre) / (fits[a].radius + fits[b].radius);
            if (ratio > 0.8 && ratio < 1.25) apart.push_back(ratio);
        }
    if (apart.size() < 60) return 0.0;
    return onset(apart, 0.02);
}

/// The limbs' own places and sizes with that blur.
std::vector<CircleFit> exact_fits(const std::vector<Picture>& pictures,
                                  const std::vector<Spot>& spots, double radius, Polarity polarity,
                                  double blur, unsigned threads) {
    const EdgeProfile edge_profile = edge_profile_for(radius / pictures.front().shrink, blur);
    std::vector<CircleFit> fits(spots.size());
    const auto fit_spot = [&](std::size_t k) {
        const Spot& spot = spots[k];
        const Picture& p = pictures[spot.picture];
        RaySettings rays = rays_for(p, spot.radius);
        rays.free_radius = true;
        rays.edge_profile = &edge_profile;
        fits[k] = fit_circle(p.sharp, spot.centre, spot.radius, polarity, rays);
    };
    parallel_for(spots.size(), fit_spot, threads);
    return fits;
}

/// The film's blur: limbs fit well with it, and discs in contact are as far apart as their radii
/// say. Neither is enough: the shading of a ball does to its edge what more blur would, so poor
/// pictures are fitted best by too much of it and radii that are too small; distances of discs in
/// contact have an onset that is known to some per cent only.
double blur_of(const std::vector<Picture>& pictures, const std::vector<Spot>& spots, double radius,
               Polarity polarity, unsigned threads) {
    constexpr std::array trials{0.6, 0.8, 1.0, 1.25, 1.6, 2.0};
    constexpr double onset_of_contacts = 1.01, onset_known_to = 0.04;
    std::array<double, trials.size()> worth{};
    for (std::size_t k = 0; k < trials.size(); ++k) {
        const auto fits = exact_fits(pictures, spots, radius, polarity, trials[k], threads);
        std::vector<double> rests;
        for (const CircleFit& fit : fits)
            if (fit.good) rests.push_back(fit.rest);
        const double contact = contact_distance(spots, fits);
        const double off = contact > 0.0 ? (contact - onset_of_contacts) / onset_known_to : 0.0;
        worth[k] = rests.size() < 4 ? 1e300 : std::log(std::max(median(rests), 1e-6)) + off * off;
    }
    const auto best =
        static_cast<std::size_t>(std::min_element(worth.begin(), worth.end()) - worth.begin());
    if (best == 0 || best + 1 == trials.size() || worth[best] == 1e300) return trials[best];
    // The steps are about equal in the logarithm.
    const double bend = worth[best - 1] - 2.0 * worth[best] + worth[best + 1];
    const double shift = 0.5 * (worth[best - 1] - worth[best + 1]) / bend;
    return trials[best] * std::pow(1.26, std::clamp(shift, -0.5, 0.5));
}

}  // namespace

ParticleLook survey_particles(const std::vector<Picture>& pictures,
                              const std::vector<CircleFit>& rims, unsigned threads) {
    // Which radius explains most edges?
    const std::size_t stride = std::max<std::size_t>(1, pictures.size() / 6);
    struct Best {
        double worth = 0.0, radius = 0.0;
        Polarity polarity = 1;
    } best;
    std::vector<std::vector<EdgePixel>> edges;
    for (std::size_t k = 0; k < pictures.size(); ++k)
        edges.push_back(edges_inside(pictures[k], rims[k]));
    std::vector<std::pair<double, Polarity>> radii;
    const double container = rims.front().radius * pictures.front().shrink;
    for (double radius = std::max(3.0, container / 25.0); radius < container / 2.5;
         radius += std::max(0.5, 0.04 * radius))
        for (const Polarity polarity : {1, -1}) {
            double worth = 0.0;
            for (std::size_t k = 0; k < pictures.size(); k += stride) {
                if (!rims[k].good) continue;
                const double area = container * container / (radius * radius);
                auto found = apart(vote(edges[k], pictures[k].small.size(), radius, polarity, 0.3,
                                        static_cast<std::size_t>(1.2 * area)));
                for (const CircleCandidate& c : found)
                    if (within(rims[k], pictures[k].to_sharp(c.centre),
                               radius / pictures[k].shrink))
                        worth += c.support * c.support * radius;
            }
            if (worth > best.worth) best = {worth, radius, polarity};
        }
    if (!(best.worth > 0.0))
        throw Failure(
            "The dish was found, but no discs in it: there are no circles that stand out from its "
            "floor.");
    // One or two sizes about that one, by fits with free radius.
    std::vector<Spot> spots;
    std::vector<double> fitted;
    std::vector<std::vector<double>> by_picture;
    for (std::size_t k = 0; k < pictures.size(); ++k) {
        if (!rims[k].good) continue;
        const Picture& p = pictures[k];
        std::vector<CircleCandidate> all;
        for (double factor = 0.6; factor < 1.9; factor *= 1.07) {
            const double radius = best.radius * factor;
            const auto found = vote(edges[k], p.small.size(), radius, best.polarity, 0.35, 600);
            all.insert(all.end(), found.begin(), found.end());
        }
        std::vector<CircleFit> kept;
        for (CircleCandidate& c : all) c.centre = p.to_sharp(c.centre), c.radius /= p.shrink;
        for (const CircleCandidate& c : apart(all)) {
            RaySettings rays = rays_for(p, c.radius);
            rays.free_radius = true;
            const CircleFit fit = fit_circle(p.sharp, c.centre, c.radius, best.polarity, rays);
            if (!fit.good || fit.support < 0.33 || !within(rims[k], fit.centre, fit.radius))
                continue;
            kept.push_back(fit);
        }
        std::sort(kept.begin(), kept.end(),
                  [](const CircleFit& a, const CircleFit& b) { return a.support > b.support; });
        std::vector<CircleFit> separate;
        for (const CircleFit& f : kept)
            if (std::none_of(separate.begin(), separate.end(), [&](const CircleFit& s) {
                    return length(s.centre - f.centre) < min_distance * (s.radius + f.radius);
                }))
                separate.push_back(f);
        for (const CircleFit& f : separate) spots.push_back({k, f.centre, f.radius});
    }
    const double blur = blur_of(pictures, spots, best.radius, best.polarity, threads);
    const std::vector<CircleFit> exact =
        exact_fits(pictures, spots, best.radius, best.polarity, blur, threads);
    by_picture.resize(pictures.size());
    for (std::size_t k = 0; k < spots.size(); ++k) {
        if (!exact[k].good) continue;
        fitted.push_back(exact[k].radius);
        by_picture[spots[k].picture].push_back(exact[k].radius);
    }
    if (fitted.empty())
        throw Failure(
            "The dish was found, but no discs in it: what circles there are have no sharp edges. "
            "Is the film out of focus, or the contrast between discs and floor too low?");
    ParticleLook look;
    look.polarity = best.polarity;
    std::vector<double> shares;
    for (std::size_t k = 0; k < spots.size(); ++k)
        if (exact[k].good) shares.push_back(spots[k].radius / exact[k].radius);
    look.steepest = std::clamp(median(shares), 0.85, 1.05);
    look.kinds = kinds_of(fitted);
    // Soft or faint edges have less support; what is sure is judged by what is common here.
    std::vector<double> supports;
    for (const CircleFit& fit : exact)
        if (fit.good) supports.push_back(fit.support);
    // Sharp pictures are left sharp; where edges hardly stand out from the noise, blur helps.
    std::vector<double> clarity;
    for (std::size_t k = 0; k < spots.size(); ++k)
        if (exact[k].good && pictures[spots[k].picture].noise > 0.0)
            clarity.push_back(exact[k].contrast / pictures[spots[k].picture].noise);
    if (!clarity.empty())
        look.blur = std::clamp(0.6 * std::sqrt(60.0 / std::max(median(clarity), 1.0)), 0.6,
                               std::clamp(0.1 * look.radius(), 0.6, 2.0));
    // The pictures that are searched may be smoothed more than these were.
    for (std::size_t k = 0; k < look.kinds.size(); ++k)
        look.limbs.push_back(edge_profile_for(
            look.kinds[k].radius, std::sqrt(std::max(0.2, blur * blur - survey_blur * survey_blur +
                                                              look.blur * look.blur))));
    look.sure = std::clamp(0.8 * median(supports), 0.3, sure_support);
    // Equal balls show what the lens does; their size is that in the middle of the picture.
    std::vector<SeenSize> sizes;
    for (std::size_t k = 0; k < spots.size(); ++k) {
        if (!exact[k].good || exact[k].support < look.sure) continue;
        double nearest = 1e300, size = 0.0;
        for (const ParticleKind& kind : look.kinds)
            if (std::abs(exact[k].radius - kind.radius) < nearest) {
                nearest = std::abs(exact[k].radius - kind.radius);
                size = exact[k].radius / kind.radius;
            }
        if (nearest < 0.2 * look.radius()) sizes.push_back({exact[k].centre, size});
    }
    const cv::Size whole = pictures.front().sharp.size();
    look.lens =
        lens_of(sizes, {0.5 * (whole.width - 1), 0.5 * (whole.height - 1)}, 0.5 * whole.height);
    look.lens.ball = look.radius();
    look.lens.settle_distortion();
    if (look.lens.k != 0.0) {
        std::vector<double> ratios;
        for (const SeenSize& s : sizes)
            ratios.push_back(s.size / look.lens.seen_radius(s.centre, 1.0));
        const double factor = median(ratios);
        for (ParticleKind& kind : look.kinds) kind.radius *= factor;
    }
    // How many of each: what most pictures say.
    const auto commonest = [&](auto&& counts) {
        std::map<std::size_t, std::size_t> times;
        for (const auto& here : by_picture) ++times[counts(here)];
        std::size_t mode = 0, maximum = 0;
        for (const auto& [count, often] : times)
            if (often >= maximum) mode = count, maximum = often;
        return mode;
    };
    look.number = commonest([](const std::vector<double>& here) { return here.size(); });
    if (look.kinds.size() == 2) {
        const double border = 0.5 * (look.kinds[0].radius + look.kinds[1].radius);
        look.kinds[1].number = commonest([&](const std::vector<double>& here) {
            return static_cast<std::size_t>(
                std::count_if(here.begin(), here.end(), [&](double r) { return r > border; }));
        });
        look.kinds[0].number = look.number - std::min(look.number, look.kinds[1].number);
    } else {
        look.kinds[0].number = look.number;
    }
    return look;
}

namespace {

/// The exact place of a disc that is known to a pixel or two.
void place(Particle& particle, const std::vector<Particle>& all, const Picture& picture,
           const ParticleLook& look) {
    const double radius = look.kinds[particle.kind].radius;
    const double seen = look.lens.seen_radius(particle.centre, radius);
    RaySettings rays = rays_for(picture, radius);
    // With its true radius: on the side where a ball is dark its edge is not where the brightness
    // changes most, and that circle is too small and too far on the bright side.
    const CircleFit whole = fit_circle(picture.sharp, particle.centre, seen, look.polarity, rays);
    if (whole.good && length(whole.centre - particle.centre) < 0.2 * radius)
        particle.centre = whole.centre;
    rays.edge_profile = &look.limbs[particle.kind];
    rays.edge_profile_alone = true;
    for (const Particle& other : all) {
        if (&other == &particle || !other.sure) continue;
        const double size = look.lens.seen_radius(other.centre, look.kinds[other.kind].radius);
        if (length(other.centre - particle.centre) < radius + size + 8.0)
            rays.others.push_back({other.centre, size + 0.5});
    }
    const CircleFit fit = fit_circle(picture.sharp, particle.centre, seen, look.polarity, rays);
    // The steepest places err towards the lamp, the limb's with the texture: independent errors, of
    // which the mean is better than both; the limb's are smaller.
    const double edge_profile_counts = radius > small_discs ? 0.7 : 0.5;
    if (!fit.good || length(fit.centre - particle.centre) > std::max(1.5, 0.06 * radius)) return;
    particle.centre =
        (1.0 - edge_profile_counts) * particle.centre + edge_profile_counts * fit.centre;
    particle.error = fit.error;
}

}  // namespace

namespace {

/// Between the place of its edge and that of the mean ball.
void move_to_mean(Particle& particle, const Vec2& by_edge, const AppearanceTemplate::Excess& excess,
                  const std::vector<Particle>& all, const ParticleLook& look) {
    const AppearanceTemplate& mean = *look.appearance_template;
    const auto others = sure_others(all, particle, look);
    const auto fit = mean.fit(excess, particle.centre, particle.kind, others);
    const Vec2 place = fit.good ? fit.centre : particle.centre;
    particle.centre = (1.0 - mean.counts()) * by_edge + mean.counts() * place;
    particle.error = std::max(particle.error, mean.error());
}

/// Who looks like the mean ball in a picture, the best first, whether or not there is an edge.
class MeanSearch {
  public:
    /// `beads`: those that were found by their edges.
    MeanSearch(const Picture& picture, const CircleFit& rim, const ParticleLook& look,
               const std::vector<Particle>& particles)
        : look_(look),
          mean_(*look.appearance_template),
          rim_(rim),
          excess_(mean_.excess(picture.sharp, rim, particles)) {
        for (const Particle& b : particles)
            if (mean_.inside(excess_, b.centre, b.kind))
                open_.push_back({b, b.centre, mean_.score(excess_, b.centre, b.kind, {}, 2)});
    }

    /// Those that have an edge.
    void take_by_edges() {
        for (std::size_t k; (k = best_open()) < open_.size();) take(k);
    }
    /// And where something lies that is no edge's, until there are as many as there should be.
    void take_without_edges() {
        while (taken_.size() < look_.number) {
            Candidate best = best_without_edge();
            if (best.score < 0.5 * like_a_ball) return;
            judge(best);
            best.by_edge = best.particle.centre;
            if (best.score < like_a_ball || meets(best.particle, free_distance)) return;
            best.particle.error = mean_.error();
            open_.push_back(best);
            take(open_.size() - 1);
        }
    }
    /// Those taken, at their places; the others that were found by their edges remain as
    /// candidates.
    std::vector<Particle> found() {
        for (std::size_t k = 0; k < taken_.size(); ++k)
            move_to_mean(taken_[k], edges_[k], excess_, taken_, look_);
        for (Candidate& c : open_) {
            if (meets(c.particle, same_distance)) continue;
            c.particle.sure = false;
            c.particle.support = std::max(c.score, 0.01);
            taken_.push_back(c.particle);
        }
        return std::move(taken_);
    }

  private:
    struct Candidate {
        Particle particle;
        Vec2 by_edge;
        double score;
    };

    double sum_of_radii(const Particle& a, const Particle& b) const {
        return look_.kinds[a.kind].radius + look_.kinds[b.kind].radius;
    }
    /// One that was taken is nearer than this share of the sum of their radii.
    bool meets(const Particle& particle, double distance) const {
        return std::any_of(taken_.begin(), taken_.end(), [&](const Particle& t) {
            return length(t.centre - particle.centre) < distance * sum_of_radii(t, particle);
        });
    }
    double score(const Particle& particle) const {
        return mean_.score(excess_, particle.centre, particle.kind,
                           sure_others(taken_, particle, look_), 2);
    }
    /// At its best place.
    void judge(Candidate& c) const {
        const auto fit = mean_.fit(excess_, c.particle.centre, c.particle.kind,
                                   sure_others(taken_, c.particle, look_), 2);
        if (fit.good) c.particle.centre = fit.centre;
        c.score = score(c.particle);
    }
    void take(std::size_t k) {
        Candidate c = open_[k];
        judge(c);
        open_.erase(open_.begin() + static_cast<std::ptrdiff_t>(k));
        c.particle.sure = true;
        c.particle.support = c.score;
        taken_.push_back(c.particle);
        edges_.push_back(c.by_edge);
        for (Candidate& o : open_)
            if (length(o.particle.centre - c.particle.centre) <
                1.3 * sum_of_radii(o.particle, c.particle))
                o.score = score(o.particle);
    }
    /// As many as there are open ones: none.
    std::size_t best_open() const {
        std::size_t best = open_.size();
        for (std::size_t k = 0; k < open_.size(); ++k) {
            if (open_[k].score < like_a_ball ||
                (best < open_.size() && open_[k].score <= open_[best].score))
                continue;
            if (!meets(open_[k].particle, free_distance)) best = k;
        }
        return best;
    }
    /// Of a grid over the dish; with score 0 where there is none.
    Candidate best_without_edge() const {
        Candidate best{};
        for (std::size_t kind = 0; kind < look_.kinds.size(); ++kind) {
            const double stride = 0.3 * look_.kinds[kind].radius;
            for (double x = -rim_.radius; x < rim_.radius; x += stride)
                for (double y = -rim_.radius; y < rim_.radius; y += stride) {
                    Candidate c{{rim_.centre + Vec2{x, y}, kind, 0.0, 0.0, false}, {}, 0.0};
                    if (!mean_.inside(excess_, c.particle.centre, kind)) continue;
                    if (!(mean_.excess_at(excess_, c.particle.centre) > 0.3 * mean_.soft()))
                        continue;
                    if (meets(c.particle, min_distance)) continue;
                    c.score = score(c.particle);
                    if (c.score > best.score) best = c;
                }
        }
        return best;
    }

    const ParticleLook& look_;
    const AppearanceTemplate& mean_;
    const CircleFit& rim_;
    AppearanceTemplate::Excess excess_;
    std::vector<Candidate> open_;
    std::vector<Particle> taken_;
    std::vector<Vec2> edges_;  // of those taken
};

std::vector<Particle> by_the_mean(const std::vector<Particle>& particles, const Picture& picture,
                                  const CircleFit& rim, const ParticleLook& look) {
    MeanSearch search(picture, rim, look, particles);
    search.take_by_edges();
    search.take_without_edges();
    return search.found();
}

}  // namespace

std::optional<Particle> find_particle_near(const Picture& picture, const CircleFit& rim,
                                           const ParticleLook& look, const Vec2& where,
                                           std::size_t kind, const std::vector<Particle>& others) {
    constexpr double farthest = 0.45, step = 0.15;  // radii
    const double radius = look.kinds[kind].radius;
    if (look.appearance_template) {
        const AppearanceTemplate& mean = *look.appearance_template;
        const AppearanceTemplate::Excess excess = mean.excess(picture.sharp, rim, others);
        Particle best;
        best.kind = kind;
        for (double x = -2.0 * farthest; x <= 2.0 * farthest + 1e-9; x += step)
            for (double y = -2.0 * farthest; y <= 2.0 * farthest + 1e-9; y += step) {
                Particle trial = best;
                trial.centre = where + radius * Vec2{x, y};
                trial.support =
                    mean.score(excess, trial.centre, kind, sure_others(others, trial, look), 2);
                if (trial.support > best.support) best = trial;
            }
        if (best.support < 0.7 * like_a_ball) return std::nullopt;
        const auto fit = mean.fit(excess, best.centre, kind, sure_others(others, best, look));
        if (fit.good) best.centre = fit.centre;
        for (const Particle& other : others)
            if (length(other.centre - best.centre) <
                free_distance * (radius + look.kinds[other.kind].radius))
                return std::nullopt;
        best.error = 2.0 * mean.error();
        return best;
    }
    const RaySettings rays = rays_for(picture, look.steepest * radius);
    Particle best;
    best.kind = kind;
    for (double x = -farthest; x <= farthest + 1e-9; x += step)
        for (double y = -farthest; y <= farthest + 1e-9; y += step) {
            const Vec2 seed = where + radius * Vec2{x, y};
            const CircleFit fit =
                fit_circle(picture.sharp, seed, look.steepest * look.lens.seen_radius(seed, radius),
                           look.polarity, rays);
            if (!fit.good || length(fit.centre - where) > farthest * radius) continue;
            const bool taken =
                std::any_of(others.begin(), others.end(), [&](const Particle& other) {
                    return length(other.centre - fit.centre) <
                           0.88 * (radius + look.kinds[other.kind].radius);
                });
            if (taken || fit.support <= best.support) continue;
            best.centre = fit.centre;
            best.support = fit.support;
            best.error = fit.error;
        }
    if (best.support < any_support) return std::nullopt;
    place(best, others, picture, look);
    return best;
}

namespace {

/// Patches of the texture lead votes astray, and a fit that begins there ends on the patch: where a
/// circle has little of an edge it is tried from all around.
Particle started_elsewhere(const Particle& particle, const Picture& picture,
                           const ParticleLook& look) {
    constexpr double far = 0.2;  // radii
    constexpr int starts = 8;
    const double radius = look.steepest * look.kinds[particle.kind].radius;
    RaySettings rays = rays_for(picture, radius);
    Particle best = particle;
    for (int k = 0; k < starts; ++k) {
        const Vec2 seed = particle.centre + far * radius * unit_circle(double(k) / starts);
        const CircleFit fit = fit_circle(picture.sharp, seed, look.lens.seen_radius(seed, radius),
                                         look.polarity, rays);
        if (!fit.good || fit.support <= best.support ||
            length(fit.centre - particle.centre) > 2.0 * far * radius)
            continue;
        best.centre = fit.centre;
        best.support = fit.support;
        best.error = fit.error;
    }
    return best;
}

}  // namespace

std::vector<Particle> find_particles(const Picture& picture, const CircleFit& rim,
                                     const ParticleLook& look) {
    const std::vector<EdgePixel> edges = edges_inside(picture, rim);
    std::vector<Particle> all;
    for (std::size_t kind = 0; kind < look.kinds.size(); ++kind) {
        const double radius = look.steepest * look.kinds[kind].radius;
        const double area = rim.radius * rim.radius / (radius * radius);
        const auto candidates =
            vote(edges, picture.small.size(), radius * picture.shrink, look.polarity, 0.18,
                 std::min(static_cast<std::size_t>(1.3 * area) + 4, 3 * look.number + 8));
        RaySettings rays = rays_for(picture, radius);
        rays.rays = std::max(28, rays.rays / 2);  // their exact places come later
        for (const CircleCandidate& c : candidates) {
            const Vec2 seed = picture.to_sharp(c.centre);
            if (!within(rim, seed, radius)) continue;
            const CircleFit fit = fit_circle(
                picture.sharp, seed, look.lens.seen_radius(seed, radius), look.polarity, rays);
            if (!fit.good || fit.support < any_support || !within(rim, fit.centre, radius))
                continue;
            all.push_back({fit.centre, kind, fit.support, fit.error, false});
        }
    }
    std::stable_sort(all.begin(), all.end(),
                     [](const Particle& a, const Particle& b) { return a.support > b.support; });
    std::vector<Particle> kept;
    const auto meets = [&](const Particle& particle, bool sure_ones, double distance) {
        return std::any_of(kept.begin(), kept.end(), [&](const Particle& k) {
            return (k.sure || !sure_ones) &&
                   length(k.centre - particle.centre) <
                       distance * (look.kinds[k.kind].radius + look.kinds[particle.kind].radius);
        });
    };
    for (Particle particle : all) {
        if (meets(particle, false, same_distance)) continue;
        bool overlaps = meets(particle, true, min_distance);
        if (!overlaps && particle.support < look.sure) {
            particle = started_elsewhere(particle, picture, look);
            overlaps = meets(particle, true, min_distance);
        }
        particle.sure = !overlaps && particle.support >= look.sure;
        kept.push_back(particle);
    }
    // Their exact places.
    for (Particle& particle : kept) place(particle, kept, picture, look);
    return look.appearance_template ? by_the_mean(kept, picture, rim, look) : kept;
}

}  // namespace swirl
