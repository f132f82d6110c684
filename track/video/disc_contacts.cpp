#include <cmath>

#include "track/video/contact_distance.hpp"
#include "track/video/tracking_steps.hpp"

namespace swirl::tracking {

void find_contacts(const Links& links, const Detections& all, TrackedVideo& tracked) {
    std::vector<double> distances;
    for (std::size_t k = 0; k < all.size(); ++k) {
        std::vector<const DetectedParticle*> here;
        for (std::size_t d = 0; d < all[k].particles.size(); ++d)
            if (links.track[k][d] >= 0) here.push_back(&all[k].particles[d]);
        for (std::size_t a = 0; a < here.size(); ++a)
            for (std::size_t b = a + 1; b < here.size(); ++b) {
                const double radii = tracked.species[here[a]->species].radius +
                                     tracked.species[here[b]->species].radius;
                const double ratio =
                    length(here[a]->centre - here[b]->centre) / (tracked.spacing * radii);
                if (std::abs(ratio - 1.0) < contact_range) distances.push_back(ratio);
            }
    }
    const auto found = contact_of_discs(distances);
    if (!found) return;
    tracked.contact_ratio = found->at * tracked.spacing;
    tracked.contact_fitted = true;
    // In pixels, a distance errs by 2 radii times this; a coordinate by that divided by √2.
    tracked.overlap_error = found->error * tracked.spacing * tracked.radius * std::sqrt(2.0);
}

}  // namespace swirl::tracking
