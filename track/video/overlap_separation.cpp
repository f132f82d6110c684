#include <algorithm>
#include <cmath>
#include <optional>

#include "track/video/contact_distance.hpp"
#include "track/video/tracking_steps.hpp"

namespace swirl::tracking {

namespace {

/// Where discs stop each other, in sums of radii, and where the wall stops them, as minus their
/// distance from the container's centre.
struct Contacts {
    Contact discs;
    std::optional<Contact> wall;
};

std::vector<DetectedParticle*> linked_particles(const Links& links, Detections& all,
                                                std::size_t frame) {
    std::vector<DetectedParticle*> here;
    for (std::size_t d = 0; d < all[frame].particles.size(); ++d)
        if (links.track[frame][d] >= 0) here.push_back(&all[frame].particles[d]);
    return here;
}

Contacts find_contacts(const Links& links, Detections& all, TrackedVideo& tracked) {
    constexpr Contact assumed{0.985,
                              0.004};       // if distances do not determine it; error: of the radii
    constexpr double wall_range = 0.4;      // radii inwards from the outermost disc
    constexpr double max_wall_error = 1.3;  // times that of a distance: the wall is a circle
    const auto radius = [&](const DetectedParticle* p) {
        return tracked.species[p->species].radius;
    };
    std::vector<double> distances, reaches;
    for (std::size_t k = 0; k < all.size(); ++k) {
        const std::vector<DetectedParticle*> here = linked_particles(links, all, k);
        const Vec2 container = tracked.container(k);
        for (std::size_t a = 0; a < here.size(); ++a) {
            reaches.push_back(-(length(here[a]->centre - container) + radius(here[a])));
            for (std::size_t b = a + 1; b < here.size(); ++b) {
                const double ratio = length(here[a]->centre - here[b]->centre) /
                                     (tracked.spacing * (radius(here[a]) + radius(here[b])));
                if (std::abs(ratio - 1.0) < contact_range) distances.push_back(ratio);
            }
        }
    }
    Contacts contacts{assumed, {}};
    contacts.discs.at *= tracked.spacing;
    if (auto found = contact_of_discs(distances)) {
        found->at *= tracked.spacing;
        found->error *= tracked.spacing;
        contacts.discs = *found;
        tracked.contact_ratio = found->at;
        tracked.contact_fitted = true;
        // In pixels, a distance errs by 2 radii times this; a coordinate by that divided by √2.
        tracked.overlap_error = found->error * tracked.radius * std::sqrt(2.0);
    }
    // A tilted camera sees the rim, and with it the container's centre, shifted against the discs.
    if (reaches.empty() || tracked.lens.tilted()) return contacts;
    const double out = -*std::min_element(reaches.begin(), reaches.end());
    const auto wall = contact_of(reaches, -out - 1.0, -out + wall_range * tracked.radius);
    if (wall &&
        wall->error <= max_wall_error * contacts.discs.error * std::sqrt(2.0) * tracked.radius)
        contacts.wall = wall;
    return contacts;
}

}  // namespace

void separate_overlaps(const Links& links, Detections& all, TrackedVideo& tracked) {
    // Neighbours constrain each other, so that a part of the error's variance moves discs. Values
    // from 0.3 to 1 give about the same errors for videos with ground truth.
    constexpr double free_share = 0.4;
    constexpr double min_support = 0.05, min_error = 1e-3;  // of the edge; pixels
    constexpr double min_ratio = 0.1, max_ratio = 10.0;     // of a variance to the median
    constexpr double no_wall = 1e300;
    const auto [contact, wall] = find_contacts(links, all, tracked);
    const double error = contact.error * tracked.radius * std::sqrt(2.0 * free_share);
    for (std::size_t k = 0; k < all.size(); ++k) {
        const std::vector<DetectedParticle*> here = linked_particles(links, all, k);
        std::vector<HardDisc> discs;
        std::vector<double> variances;
        for (const DetectedParticle* p : here) {
            // The error of a fit is too small for a disc of which little is visible. The cube of
            // the support was found by trial.
            const double share = std::max(p->support, min_support),
                         doubt = std::max(p->error, min_error) / (share * share * share);
            const double radius = tracked.species[p->species].radius;
            variances.push_back(doubt * doubt);
            discs.push_back({p->centre, 1.0, radius, wall ? -wall->at - radius : no_wall});
        }
        if (discs.empty()) continue;
        const double typical = median(variances);
        for (std::size_t i = 0; i < discs.size(); ++i)
            discs[i].variance =
                error * error * std::clamp(variances[i] / typical, min_ratio, max_ratio);
        move_apart(discs, contact.at, tracked.container(k));
        for (std::size_t i = 0; i < here.size(); ++i) here[i]->centre = discs[i].centre;
    }
}

}  // namespace swirl::tracking
