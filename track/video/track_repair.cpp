#include <algorithm>
#include <optional>

#include "swirl/math/unit_circle.hpp"
#include "track/video/tracking_steps.hpp"

namespace swirl::tracking {

namespace {

/// Of two particles that overlap by more than errors of positions explain, removes the one with
/// less of an edge.
void drop_overlapping(const Detections& all, const std::vector<double>& radii, double spacing,
                      Links& links) {
    const double min_distance = 0.84 * spacing;  // sums of radii
    for (std::size_t k = 0; k < all.size(); ++k) {
        const std::vector<DetectedParticle>& particles = all[k].particles;
        for (std::size_t a = 0; a < particles.size(); ++a)
            for (std::size_t b = a + 1; b < particles.size(); ++b) {
                int &first = links.track[k][a], &second = links.track[k][b];
                if (first < 0 || second < 0) continue;
                if (length(particles[a].centre - particles[b].centre) >
                    min_distance * (radii[particles[a].species] + radii[particles[b].species]))
                    continue;
                (particles[a].support < particles[b].support ? first : second) = -1;
            }
    }
}

/// Where a disc that was not detected should be.
struct MissingDisc {
    std::size_t track, species;
    Vec2 position;  // corrected for the lens
};

/// For each frame, the discs that were detected before and after it. Their positions are
/// interpolated in the frame of reference of the container.
std::vector<std::vector<MissingDisc>> missing_discs(const Detections& all, const Links& links,
                                                    const TrackedVideo& tracked) {
    constexpr double max_turn = 0.5 * pi;  // share of the path: gaps of up to a quarter period
    constexpr double short_gap = 2.0;      // frames more, for low frame rates
    struct Last {
        std::size_t frame;
        Vec2 relative;
    };
    std::vector<std::vector<MissingDisc>> missing(all.size());
    std::vector<std::optional<Last>> last(links.species.size());
    const auto max_gap =
        static_cast<std::size_t>(max_turn / (tracked.path.omega * tracked.step()) + short_gap);
    for_each_linked(links, [&](std::size_t k, std::size_t t, std::size_t d) {
        const Vec2 now = all[k].particles[d].centre - tracked.container(k);
        if (last[t] && k - last[t]->frame > 1 && k - last[t]->frame <= max_gap)
            for (std::size_t j = last[t]->frame + 1; j < k; ++j) {
                const double u = double(j - last[t]->frame) / double(k - last[t]->frame);
                missing[j].push_back(
                    {t, links.species[t],
                     tracked.container(j) + (1.0 - u) * last[t]->relative + u * now});
            }
        last[t] = Last{k, now};
    });
    return missing;
}

bool all_detected(const Links& links) {
    return std::all_of(links.track.begin(), links.track.end(), [&](const auto& here) {
        return std::size_t(std::count_if(here.begin(), here.end(), [](int t) { return t >= 0; })) ==
               links.species.size();
    });
}

/// Reads the video again, and searches every frame where discs are missing. A disc that is missing
/// to the end is searched at its last position relative to the container.
void find_missing_discs(const TrackingSettings& settings, const VideoSurvey& survey,
                        const TrackedVideo& tracked, Detections& all, Links& links) {
    constexpr std::size_t progress_interval = 16;  // frames
    if (all_detected(links)) return;
    const std::vector<std::vector<MissingDisc>> missing = missing_discs(all, links, tracked);
    std::vector<std::optional<Vec2>> last(links.species.size());  // relative to the container
    std::vector<std::size_t> last_frame(links.species.size(), all.size());
    for_each_linked(links, [&](std::size_t k, std::size_t t, std::size_t) { last_frame[t] = k; });
    Video video(settings.video, 1, settings.first_frame, settings.reading);
    cv::Mat grey;
    for (std::size_t k = 0; k < all.size() && video.next(grey); ++k) {
        settings.throw_if_stopped();
        if (k % progress_interval == 0)
            settings.report_progress("finding missing discs", double(k) / double(all.size()));
        const Vec2 container = tracked.container(k);
        std::vector<DetectedParticle>& particles = all[k].particles;
        std::vector<int>& tracks = links.track[k];
        std::vector<MissingDisc> here = missing[k];
        for (std::size_t t = 0; t < last.size(); ++t)
            if (k > last_frame[t] && last[t])
                here.push_back({t, links.species[t], container + *last[t]});
        std::vector<DetectedParticle> others;  // others as seen
        for (std::size_t d = 0; d < particles.size(); ++d) {
            if (tracks[d] < 0) continue;
            last[static_cast<std::size_t>(tracks[d])] = particles[d].centre - container;
            others.push_back(particles[d]);
            others.back().centre = tracked.lens.seen(put_back(tracked, k, particles[d].centre));
            others.back().sure = true;
        }
        if (here.empty() || !all[k].used) continue;
        tracked.stabilise(k, grey);
        if (survey.floor) survey.floor->remove(grey);
        const PreparedFrame frame(grey, survey.reduction(), survey.appearance.blur);
        CircleFit rim = all[k].rim;
        rim.centre = tracked.lens.seen(put_back(tracked, k, rim.good ? rim.centre : container));
        for (const MissingDisc& disc : here) {
            const double radius = survey.appearance.species[disc.species].radius;
            auto found = find_particle_near(frame, rim, survey.appearance,
                                            tracked.lens.seen(put_back(tracked, k, disc.position)),
                                            disc.species, others);
            if (!found) continue;
            found->sure = true;
            others.push_back(*found);
            found->centre = tracked.lens.ideal({found->centre, radius}).centre;
            found->delay = remove_delay(tracked, k, found->centre);
            last[disc.track] = found->centre - container;
            particles.push_back(*found);
            tracks.push_back(static_cast<int>(disc.track));
        }
    }
}

}  // namespace

Links link_detections(const TrackingSettings& settings, const VideoSurvey& survey, Detections& all,
                      TrackedVideo& tracked) {
    std::vector<std::vector<DetectedDisc>> discs;
    for (const FrameDetections& found : all) {
        discs.emplace_back();
        for (const DetectedParticle& p : found.particles)
            discs.back().push_back({p.centre, p.species, p.sure});
    }
    LinkSettings link;
    for (const TrackedSpecies& species : tracked.species) {
        link.radii.push_back(species.radius);
        link.numbers.push_back(species.number);
    }
    link.throw_if_stopped = [&settings] { settings.throw_if_stopped(); };
    Links links = link_discs(discs, tracked.times, tracked.path, link);
    drop_overlapping(all, link.radii, tracked.spacing, links);
    find_missing_discs(settings, survey, tracked, all, links);
    tracked.rejected = links.rejected;
    tracked.crowded = links.crowded;
    tracked.extra = links.extra;
    return links;
}

}  // namespace swirl::tracking
