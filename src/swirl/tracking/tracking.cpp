#include "swirl/tracking/tracking.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <future>
#include <map>
#include <opencv2/core.hpp>

#include "swirl/math/unit_circle.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/parallel_for.hpp"
#include "swirl/tracking/appearance_template.hpp"
#include "swirl/tracking/contact_distance.hpp"
#include "swirl/tracking/dish.hpp"
#include "swirl/tracking/link.hpp"
#include "swirl/tracking/particle_detection.hpp"
#include "swirl/tracking/video.hpp"

namespace swirl {

namespace {

constexpr std::int64_t survey_pictures = 48;
constexpr double votes_side = 300.0;   // of the picture in which the dish is sought, pixels
constexpr double votes_radius = 12.0;  // of the discs in the picture in which they are

constexpr std::string_view second_container =
    "There is a second circle of the dish's size beside it: of two dishes in the picture the one "
    "with the clearer rim was followed. Crop the film to one.";

double quantile(std::vector<double> values, double share) {
    if (values.empty()) return 0.0;
    const auto at = values.begin() +
                    static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

/// What one picture says.
struct Seen {
    CircleFit rim;
    std::vector<Particle> particles;
    bool timed = true;  // false: nothing is used of a frame without a time of its own
};

struct Survey {
    Rim rim;
    ParticleLook look;
    Tilt tilt;
    cv::Size size;
};

unsigned threads_of(const TrackingSettings& settings) {
    return settings.threads ? settings.threads : available_cores();
}

Survey survey(const TrackingSettings& settings, std::int64_t pictures) {
    const std::int64_t every = std::max<std::int64_t>(1, pictures / survey_pictures);
    Video video(settings.video, every);
    cv::Mat grey;
    std::vector<cv::Mat> kept;
    while (static_cast<std::int64_t>(kept.size()) < survey_pictures + 2 && video.next(grey)) {
        settings.listen();
        kept.push_back(grey.clone());
        if (settings.progress)
            settings.progress("looking for the dish", double(kept.size()) / (survey_pictures + 2));
    }
    Survey found;
    found.size = kept.front().size();
    const double side = std::min(found.size.width, found.size.height);
    if (side < 64)
        throw Failure(fmt::format("The pictures of '{}' are {}x{} pixels, which shows no discs.",
                                  settings.video, found.size.width, found.size.height));
    const double rough = std::min(1.0, votes_side / side);
    const unsigned threads = threads_of(settings);
    std::vector<std::optional<Picture>> made(kept.size());
    parallel_for(
        kept.size(),
        [&](std::size_t k) {
            settings.listen();
            made[k].emplace(kept[k], rough, 1.0);
        },
        threads);
    std::vector<Picture> small;
    for (auto& picture : made) small.push_back(std::move(*picture));
    found.rim = survey_rim(small);
    // The discs are looked for on fewer.
    std::vector<Picture> fewer;
    std::vector<CircleFit> rims;
    const std::size_t stride = std::max<std::size_t>(1, small.size() / 24);
    const double sharp_side = std::min(1.0, 1.3 * votes_side / side);
    for (std::size_t k = 0; k < small.size(); k += stride) {
        settings.listen();
        const CircleFit rim = find_rim(small[k], found.rim);
        if (!rim.good) continue;
        rims.push_back(rim);
        fewer.emplace_back(kept[k], sharp_side, survey_blur);
    }
    if (fewer.empty()) throw Failure("No dish was found in the pictures.");
    settings.listen();
    found.look = survey_particles(fewer, rims, threads);
    settings.listen();
    found.tilt = find_tilt(small, settings.camera, found.rim, found.look.lens);
    // What discs look like on the mean, for films with poor edges.
    const double shrink = std::min(1.0, votes_radius / found.look.radius());
    std::vector<std::optional<AppearanceTemplate::Example>> seen(kept.size());
    parallel_for(
        kept.size(),
        [&](std::size_t k) {
            settings.listen();
            const Picture sharp(kept[k], shrink, found.look.blur);
            const CircleFit rim = find_rim(sharp, found.rim);
            if (rim.good) seen[k] = {sharp.sharp, rim, find_particles(sharp, rim, found.look)};
        },
        threads);
    std::vector<AppearanceTemplate::Example> examples;
    for (auto& example : seen)
        if (example) examples.push_back(std::move(*example));
    settings.listen();
    if (auto mean = AppearanceTemplate::learned(examples, found.look, threads))
        found.look.appearance_template =
            std::make_shared<const AppearanceTemplate>(std::move(*mean));
    return found;
}

/// Every picture, a batch at a time, shared between the threads, while the next one is read.
std::vector<Seen> look_at_all(const TrackingSettings& settings, const Survey& found,
                              std::int64_t expected, TrackedVideo& tracked) {
    const unsigned threads = threads_of(settings);
    Video video(settings.video);
    const double radius = found.look.radius();
    const double shrink = std::min(1.0, votes_radius / radius);
    const double blur = found.look.blur;
    std::vector<Seen> all;
    struct Batch {
        std::vector<cv::Mat> pictures;
        std::size_t number = 0;
    } now, next;
    now.pictures.resize(4 * threads);
    next.pictures.resize(4 * threads);
    const auto read = [&](Batch& batch) {
        for (batch.number = 0; batch.number < batch.pictures.size(); ++batch.number) {
            if (settings.max_pictures > 0 && video.count() >= settings.max_pictures) return;
            cv::Mat& picture = batch.pictures[batch.number];
            if (!video.next(picture)) return;
            if (picture.size() != found.size)
                throw Failure(fmt::format("Picture {} of '{}' has another size than the first.",
                                          video.count(), settings.video));
        }
    };
    for (read(now); now.number > 0; std::swap(now, next)) {
        settings.listen();
        std::future<void> reading = std::async(std::launch::async, [&] { read(next); });
        const std::size_t begin = all.size();
        all.resize(begin + now.number);
        parallel_for(
            now.number,
            [&](std::size_t k) {
                settings.listen();
                const Picture picture(now.pictures[k], shrink, blur);
                Seen& seen = all[begin + k];
                seen.rim = find_rim(picture, found.rim);
                if (seen.rim.good) seen.particles = find_particles(picture, seen.rim, found.look);
            },
            threads);
        reading.get();
        if (settings.progress)
            settings.progress("finding discs",
                              double(all.size()) / double(std::max<std::int64_t>(
                                                       expected, std::int64_t(all.size()) + 1)));
    }
    if (!video.problem().empty())
        tracked.warnings.push_back(
            fmt::format("The film ends early or is damaged after {} pictures; ffmpeg says: {}",
                        all.size(), video.problem()));
    return all;
}

/// Of two discs that lie in each other the one with less of an edge was none.
void drop_overlaps(const std::vector<Seen>& all, const std::vector<double>& radii, Links& links) {
    constexpr double nearest = 0.84;  // of the sum of radii: more than errors of places explain
    for (std::size_t k = 0; k < all.size(); ++k) {
        const std::vector<Particle>& particles = all[k].particles;
        for (std::size_t a = 0; a < particles.size(); ++a)
            for (std::size_t b = a + 1; b < particles.size(); ++b) {
                int &first = links.track[k][a], &second = links.track[k][b];
                if (first < 0 || second < 0) continue;
                if (length(particles[a].centre - particles[b].centre) >
                    nearest * (radii[particles[a].kind] + radii[particles[b].kind]))
                    continue;
                (particles[a].support < particles[b].support ? first : second) = -1;
            }
    }
}

/// Out for a single picture and back again: a disc that is hit from both sides in between, at up to
/// about twice the dish's speed, does so, and the less of it is seen the less it is believed.
void drop_leaps(const std::vector<Seen>& all, const TrackedVideo& tracked, Links& links) {
    struct Place {
        std::size_t picture, particle;
        Vec2 at_container;
    };
    std::vector<std::vector<Place>> places(links.kind.size());
    for (std::size_t k = 0; k < all.size(); ++k)
        for (std::size_t d = 0; d < all[k].particles.size(); ++d)
            if (const int t = links.track[k][d]; t >= 0)
                places[static_cast<std::size_t>(t)].push_back(
                    {k, d, all[k].particles[d].centre - tracked.path.at(tracked.times[k])});
    const double way = tracked.path.amplitude * tracked.path.omega * tracked.step();
    for (std::size_t t = 0; t < places.size(); ++t)
        for (std::size_t j = 1; j + 1 < places[t].size(); ++j) {
            const Place &before = places[t][j - 1], &now = places[t][j], &after = places[t][j + 1];
            if (after.picture - before.picture != 2) continue;
            const bool sure = all[now.picture].particles[now.particle].sure;
            const double maximum =
                std::max(0.2 * tracked.kinds[links.kind[t]].radius, (sure ? 2.4 : 1.2) * way);
            if (length(now.at_container - 0.5 * (before.at_container + after.at_container)) >
                maximum)
                links.track[now.picture][now.particle] = -1;
        }
}

/// Discs that were lost for a while, where they should have been.
struct Wanted {
    std::size_t track, kind;
    Vec2 where;  // of an ideal lens
};

/// Of every picture those who are missing there between two that were seen: straight on relative
/// to the dish.
std::vector<std::vector<Wanted>> lost_discs(const std::vector<Seen>& all, const Links& links,
                                            const TrackedVideo& tracked) {
    std::vector<std::vector<Wanted>> wanted(all.size());
    struct Last {
        std::size_t picture;
        Vec2 at_container;
    };
    std::vector<std::optional<Last>> last(links.kind.size());
    const double step = tracked.step();
    const auto longest = static_cast<std::size_t>(0.5 * pi / (tracked.path.omega * step) + 2.0);
    for (std::size_t k = 0; k < all.size(); ++k)
        for (std::size_t d = 0; d < all[k].particles.size(); ++d) {
            if (links.track[k][d] < 0) continue;
            const auto t = static_cast<std::size_t>(links.track[k][d]);
            const Vec2 now = all[k].particles[d].centre - tracked.path.at(tracked.times[k]);
            if (last[t] && k - last[t]->picture > 1 && k - last[t]->picture <= longest)
                for (std::size_t j = last[t]->picture + 1; j < k; ++j) {
                    const double u = double(j - last[t]->picture) / double(k - last[t]->picture);
                    wanted[j].push_back({t, links.kind[t],
                                         tracked.path.at(tracked.times[j]) +
                                             (1.0 - u) * last[t]->at_container + u * now});
                }
            last[t] = Last{k, now};
        }
    return wanted;
}

/// A second look at the pictures in which somebody is missing.
void search_again(const TrackingSettings& settings, const Survey& found,
                  const TrackedVideo& tracked, std::vector<Seen>& all, Links& links) {
    const std::vector<std::vector<Wanted>> wanted = lost_discs(all, links, tracked);
    const bool all_there =
        std::all_of(links.track.begin(), links.track.end(), [&](const auto& here) {
            return std::size_t(std::count_if(here.begin(), here.end(),
                                             [](int t) { return t >= 0; })) == links.kind.size();
        });
    if (all_there) return;
    // Who is lost until the end is looked for where it was last, at rest relative to the dish.
    std::vector<std::optional<Vec2>> last(links.kind.size());
    std::vector<std::size_t> last_picture(links.kind.size(), all.size());
    for (std::size_t k = 0; k < all.size(); ++k)
        for (const int t : links.track[k])
            if (t >= 0) last_picture[static_cast<std::size_t>(t)] = k;
    Video video(settings.video);
    const double shrink = std::min(1.0, votes_radius / found.look.radius());
    cv::Mat grey;
    for (std::size_t k = 0; k < all.size() && video.next(grey); ++k) {
        settings.listen();
        if (settings.progress && k % 16 == 0)
            settings.progress("looking for lost discs", double(k) / double(all.size()));
        std::vector<Wanted> here = wanted[k];
        for (std::size_t t = 0; t < last.size(); ++t)
            if (k > last_picture[t] && last[t])
                here.push_back({t, links.kind[t], tracked.path.at(tracked.times[k]) + *last[t]});
        for (std::size_t d = 0; d < all[k].particles.size(); ++d)
            if (const int t = links.track[k][d]; t >= 0)
                last[static_cast<std::size_t>(t)] =
                    all[k].particles[d].centre - tracked.path.at(tracked.times[k]);
        if (here.empty() || !all[k].timed) continue;
        const Picture picture(grey, shrink, found.look.blur);
        CircleFit rim = all[k].rim;
        rim.centre = tracked.lens.seen(rim.good ? rim.centre : tracked.path.at(tracked.times[k]));
        std::vector<Particle> others;
        for (std::size_t d = 0; d < all[k].particles.size(); ++d)
            if (links.track[k][d] >= 0) {
                others.push_back(all[k].particles[d]);
                others.back().centre = tracked.lens.seen(others.back().centre);
                others.back().sure = true;
            }
        for (const Wanted& w : here) {
            auto particle = find_particle_near(picture, rim, found.look, tracked.lens.seen(w.where),
                                               w.kind, others);
            if (!particle) continue;
            particle->sure = true;
            others.push_back(*particle);
            particle->centre =
                tracked.lens.ideal({particle->centre, found.look.kinds[w.kind].radius}).centre;
            last[w.track] = particle->centre - tracked.path.at(tracked.times[k]);
            all[k].particles.push_back(*particle);
            links.track[k].push_back(static_cast<int>(w.track));
        }
    }
}

/// The discs of a picture that are somebody.
std::vector<Particle*> known_particles(const Links& links, std::vector<Seen>& all,
                                       std::size_t picture) {
    std::vector<Particle*> here;
    for (std::size_t d = 0; d < all[picture].particles.size(); ++d)
        if (links.track[picture][d] >= 0) here.push_back(&all[picture].particles[d]);
    return here;
}

/// Where discs stop each other, as shares of the sum of radii, and where the wall stops them, as
/// minus their distance from the dish's middle.
struct Contacts {
    Contact discs;
    std::optional<Contact> wall;
};

Contacts contacts_of(const Links& links, const std::vector<double>& radii, std::vector<Seen>& all,
                     TrackedVideo& tracked) {
    constexpr double nearest = 0.9, farthest = 1.1;  // of the sum of radii
    std::vector<double> apart, reaches;
    for (std::size_t k = 0; k < all.size(); ++k) {
        const std::vector<Particle*> here = known_particles(links, all, k);
        const Vec2 container = tracked.path.at(tracked.times[k]);
        for (std::size_t a = 0; a < here.size(); ++a) {
            reaches.push_back(-(length(here[a]->centre - container) + radii[here[a]->kind]));
            for (std::size_t b = a + 1; b < here.size(); ++b) {
                const double ratio = length(here[a]->centre - here[b]->centre) /
                                     (radii[here[a]->kind] + radii[here[b]->kind]);
                if (ratio > nearest && ratio < farthest) apart.push_back(ratio);
            }
        }
    }
    // Where they do not tell, what errors of radii explain is left.
    Contacts contacts{{0.985, 0.004}, {}};
    if (const auto told = contact_of(apart, nearest, farthest);
        told && std::abs(told->at - 1.0) < 0.05) {
        contacts.discs = *told;
        tracked.overlap_error =
            told->error * tracked.radius * std::sqrt(2.0);  // a distance's has two
    }
    // A tilted camera sees the rim, by which the dish's middle goes, shifted against the discs.
    if (reaches.empty() || tracked.lens.tilted()) return contacts;
    const double out = -*std::min_element(reaches.begin(), reaches.end());
    const auto wall = contact_of(reaches, -out - 1.0, -out + 0.4 * tracked.radius);
    // Where the wall is a circle about the dish's middle that was found, it is as sharp.
    if (wall && wall->error <= 1.3 * contacts.discs.error * std::sqrt(2.0) * tracked.radius)
        contacts.wall = wall;
    return contacts;
}

/// Hard discs do not lie in each other or in the wall: who seems to is moved, each by its share of
/// the variance, which is the larger the less of its edge is seen.
void part_overlaps(const Links& links, const std::vector<double>& radii, std::vector<Seen>& all,
                   TrackedVideo& tracked) {
    const auto [contact, wall] = contacts_of(links, radii, all, tracked);
    // Of a coordinate. Neighbours hold each other in their places, so that less than all of an
    // error is free to be moved; 0.3 to 1 times it serve about as well in films whose truth is
    // known.
    constexpr double free_to_move = 0.4;
    const double error = contact.error * tracked.radius * std::sqrt(2.0 * free_to_move);
    for (std::size_t k = 0; k < all.size(); ++k) {
        const std::vector<Particle*> here = known_particles(links, all, k);
        std::vector<HardDisc> discs;
        std::vector<double> doubts;
        for (const Particle* particle : here) {
            // By trial: the error that its fit tells itself says too little of a disc that is
            // hardly seen.
            const double share = std::max(particle->support, 0.05),
                         doubt = std::max(particle->error, 1e-3) / (share * share * share);
            const double radius = radii[particle->kind];
            doubts.push_back(doubt * doubt);
            discs.push_back({particle->centre, 1.0, radius, wall ? -wall->at - radius : 1e300});
        }
        if (discs.empty()) continue;
        const double usual = median(doubts);
        for (std::size_t i = 0; i < discs.size(); ++i)
            discs[i].variance = error * error * std::clamp(doubts[i] / usual, 0.1, 10.0);
        move_apart(discs, contact.at, tracked.path.at(tracked.times[k]));
        for (std::size_t i = 0; i < here.size(); ++i) here[i]->centre = discs[i].centre;
    }
}

/// From discs in pictures to discs that are the same ones from picture to picture.
void track(const TrackingSettings& given, const Survey& found, std::vector<Seen>& all,
           TrackedVideo& tracked) {
    std::vector<std::vector<SeenDisc>> discs;
    for (const Seen& seen : all) {
        std::vector<SeenDisc> here;
        for (const Particle& b : seen.particles) here.push_back({b.centre, b.kind, b.sure});
        discs.push_back(std::move(here));
    }
    LinkSettings settings;
    for (const TrackedKind& kind : tracked.kinds) {
        settings.radii.push_back(kind.radius);
        settings.numbers.push_back(kind.number);
    }
    settings.listen = [&given] { given.listen(); };
    Links links = link_discs(discs, tracked.times, tracked.path, settings);
    drop_overlaps(all, settings.radii, links);
    drop_leaps(all, tracked, links);
    search_again(given, found, tracked, all, links);
    part_overlaps(links, settings.radii, all, tracked);
    tracked.rejected = links.rejected;
    tracked.crowded = links.crowded;
    // By track: where it was when.
    struct Place {
        std::size_t picture;
        Vec2 centre;
        double error;
    };
    std::vector<std::vector<Place>> places(links.kind.size());
    for (std::size_t k = 0; k < all.size(); ++k)
        for (std::size_t d = 0; d < all[k].particles.size(); ++d)
            if (const int t = links.track[k][d]; t >= 0)
                places[static_cast<std::size_t>(t)].push_back(
                    {k, all[k].particles[d].centre, all[k].particles[d].error});
    // A track of a few pictures is no disc.
    const std::size_t minimum = std::min<std::size_t>(4, all.size());
    tracked.tracks.y_down = true;
    tracked.tracks.frames.resize(all.size());
    tracked.errors.resize(all.size());
    tracked.seen.resize(all.size());
    for (std::size_t k = 0; k < all.size(); ++k)
        tracked.tracks.frames[k].number = static_cast<std::int64_t>(k);
    const double per_period = 2.0 * pi / tracked.path.omega / tracked.step();
    const auto longest = static_cast<std::size_t>(std::max(2.0, per_period / 12.0));
    std::int64_t id = 0;
    std::map<std::size_t, std::size_t> kinds;
    for (std::size_t t = 0; t < places.size(); ++t) {
        if (places[t].size() < minimum) continue;
        const double radius = tracked.kinds[links.kind[t]].radius;
        const auto put = [&](std::size_t k, const Vec2& p, double error, bool seen) {
            TrackFrame& f = tracked.tracks.frames[k];
            f.id.push_back(id);
            f.position.push_back(p);
            f.radius.push_back(radius);
            tracked.errors[k].push_back(error);
            tracked.seen[k].push_back(seen ? 1 : 0);
        };
        for (std::size_t j = 0; j < places[t].size(); ++j) {
            const Place& now = places[t][j];
            if (j > 0) {
                // Between two places, straight on relative to the dish.
                const Place& before = places[t][j - 1];
                const std::size_t gap = now.picture - before.picture;
                const Vec2 from = before.centre - tracked.path.at(tracked.times[before.picture]),
                           to = now.centre - tracked.path.at(tracked.times[now.picture]);
                for (std::size_t k = before.picture + 1; gap <= longest && k < now.picture; ++k) {
                    const double u = double(k - before.picture) / double(gap);
                    put(k, tracked.path.at(tracked.times[k]) + (1.0 - u) * from + u * to,
                        0.1 * radius, false);
                    ++tracked.filled;
                }
            }
            put(now.picture, now.centre, now.error, true);
        }
        ++kinds[links.kind[t]];
        ++id;
    }
    tracked.number = static_cast<std::size_t>(id);
    for (std::size_t k = 0; k < tracked.kinds.size(); ++k) tracked.kinds[k].number = kinds[k];
}

/// All rims are seen through the same lens, so what is not known of its distortion is no scatter of
/// theirs, and the fit of the path knows nothing of it: the same rims through a lens that differs
/// by the standard error have another path.
void add_error_of_lens(const std::vector<Vec2>& centres, const std::vector<double>& times,
                       TrackedVideo& tracked) {
    Lens other = tracked.lens;
    other.k += tracked.lens.k_error;
    std::vector<Vec2> moved;
    moved.reserve(centres.size());
    for (const Vec2& centre : centres)
        moved.push_back(other.ideal(tracked.lens.image({centre, tracked.rim_radius})).centre);
    const auto path = fit_path(moved, times);
    if (!path) return;
    TrackedPath& found = tracked.path;
    const double turned = std::remainder(path->phase - found.phase, 2.0 * pi);
    found.centre_error = std::hypot(found.centre_error, length(path->centre - found.centre));
    found.amplitude_error = std::hypot(found.amplitude_error, path->amplitude - found.amplitude);
    found.omega_error = std::hypot(found.omega_error, path->omega - found.omega);
    found.phase_error = std::hypot(found.phase_error, turned);
}

/// Seen at an angle the rim is shifted against the discs, which lie lower than its edge, and being
/// nearer it is larger, with its way: the wall is where discs are stopped, r = reach + shift·n −
/// more C·n for those at it, with C the direction of the path's way out.
void move_to_wall(TrackedVideo& tracked) {
    constexpr double stands_out = 4.0;  // standard errors
    constexpr double at_wall = 0.15;    // radii
    constexpr std::size_t minimum = 400;
    std::vector<cv::Vec4d> rows;
    std::vector<double> outer;
    for (std::size_t k = 0; k < tracked.tracks.frames.size(); ++k) {
        const TrackFrame& f = tracked.tracks.frames[k];
        const Vec2 c = tracked.path.at(tracked.times[k]);
        const Vec2 out = (1.0 / tracked.path.amplitude) * (c - tracked.path.centre);
        for (std::size_t i = 0; i < f.id.size(); ++i) {
            const Vec2 d = f.position[i] - c;
            const double far = length(d);
            if (!tracked.seen[k][i] || !(far > 0.0)) continue;
            const Vec2 n = (1.0 / far) * d;
            rows.emplace_back(1.0, n.x, n.y, -dot(out, n));
            outer.push_back(far + f.radius[i]);
        }
    }
    // The outermost disc of every picture is at the wall, and with a better wall more are.
    cv::Vec4d fit(quantile(outer, 1.0 - 0.5 / double(std::max<std::size_t>(tracked.number, 1))),
                  0.0, 0.0, 0.0);
    cv::Vec4d error = cv::Vec4d::all(0.0);
    double near = 0.5 * tracked.radius;
    for (int pass = 0; pass < 20; ++pass, near = std::max(0.8 * near, at_wall * tracked.radius)) {
        cv::Matx44d normal = cv::Matx44d::zeros();
        cv::Vec4d right = cv::Vec4d::all(0.0);
        double square = 0.0;
        std::size_t used = 0;
        for (std::size_t k = 0; k < rows.size(); ++k) {
            const double rest = outer[k] - rows[k].dot(fit);
            if (std::abs(rest) > near) continue;
            normal += rows[k] * rows[k].t();
            right += rest * rows[k];
            square += rest * rest;
            ++used;
        }
        if (used < minimum) return;
        const cv::Matx44d inverse = normal.inv(cv::DECOMP_SVD);
        fit += inverse * right;
        // A disc stays at the wall for many pictures, which is one place of it.
        const double scatter = std::sqrt(square / double(used) * double(tracked.number));
        for (int a = 0; a < 4; ++a) error[a] = scatter * std::sqrt(std::max(0.0, inverse(a, a)));
    }
    if (std::hypot(fit[1], fit[2]) < stands_out * std::max(error[1], error[2])) return;
    tracked.rim_shift = {fit[1], fit[2]};
    tracked.path.centre = tracked.path.centre + tracked.rim_shift;
    tracked.path.centre_error = std::hypot(tracked.path.centre_error, std::max(error[1], error[2]));
    if (std::abs(fit[3]) < stands_out * error[3]) return;
    tracked.polygon.corners *= 1.0 - fit[3] / tracked.path.amplitude;
    tracked.path.amplitude -= fit[3];
    tracked.path.amplitude_error = std::hypot(tracked.path.amplitude_error, error[3]);
}

void judge(const std::vector<Seen>& all, TrackedVideo& tracked) {
    std::size_t complete = 0, count = 0;
    double square = 0.0;
    std::vector<double> reaches, gaps;  // gaps: to the nearest disc
    for (std::size_t k = 0; k < all.size(); ++k) {
        const TrackFrame& f = tracked.tracks.frames[k];
        const auto seen = static_cast<std::size_t>(
            std::count(tracked.seen[k].begin(), tracked.seen[k].end(), std::uint8_t(1)));
        if (seen == tracked.number) ++complete;
        double reach = 0.0;
        const Vec2 c = tracked.path.at(tracked.times[k]);
        for (std::size_t i = 0; i < f.id.size(); ++i) {
            if (!tracked.seen[k][i]) continue;
            square += tracked.errors[k][i] * tracked.errors[k][i];
            ++count;
            reach = std::max(reach, length(f.position[i] - c) + f.radius[i]);
            double nearest = 1e300;
            for (std::size_t j = 0; j < f.id.size(); ++j)
                if (j != i && tracked.seen[k][j])
                    nearest = std::min(
                        nearest, length(f.position[i] - f.position[j]) - f.radius[i] - f.radius[j]);
            if (std::abs(nearest) < 0.25 * f.radius[i]) gaps.push_back(nearest);
        }
        if (reach > 0.0) reaches.push_back(reach);
    }
    tracked.complete = double(complete) / double(all.size());
    tracked.position_error = count ? std::sqrt(square / double(count)) : 0.0;
    tracked.reach = quantile(reaches, 0.8);
    tracked.stopped = quantile(reaches, 0.95) - tracked.reach < 0.15 * tracked.radius;
    tracked.touching =
        gaps.size() > 100 ? 1.0 + onset(gaps, 0.02 * tracked.radius) / (2.0 * tracked.radius) : 0.0;
    // Where contacts did not tell the error: hard discs touch and do not overlap. Of discs in
    // contact half seem to overlap, by the error of a distance, √2 that of a place.
    std::vector<double> overlaps;
    for (const double g : gaps)
        if (g < 0.0) overlaps.push_back(-g);
    if (!(tracked.overlap_error > 0.0) && overlaps.size() > 50)
        tracked.overlap_error = 1.4826 * quantile(overlaps, 0.5) / std::sqrt(2.0);
}

/// An edge tells how far its rays scatter, and not what shade, texture and compression do to all of
/// them at once. Where overlaps ask for larger errors, they are believed.
void believe_overlaps(TrackedVideo& tracked) {
    if (!(tracked.position_error > 0.0) || tracked.overlap_error <= tracked.position_error) return;
    for (auto& errors : tracked.errors)
        for (double& error : errors) error *= tracked.overlap_error / tracked.position_error;
    tracked.position_error = tracked.overlap_error;
}

/// The longest stretch of pictures in each of which many discs are missing at once.
struct Covered {
    std::size_t begin = 0, end = 0;
    double share = 0.0;  // of the discs, on the mean
};
Covered covered(const TrackedVideo& tracked) {
    constexpr double many = 0.2;  // of the discs
    constexpr std::size_t minimum = 3;
    Covered longest, here;
    for (std::size_t k = 0; k <= tracked.seen.size(); ++k) {
        std::size_t missing = 0;
        if (k < tracked.seen.size())
            missing = tracked.number -
                      static_cast<std::size_t>(std::count(tracked.seen[k].begin(),
                                                          tracked.seen[k].end(), std::uint8_t(1)));
        if (missing >= minimum && double(missing) >= many * double(tracked.number)) {
            if (here.end != k) here = {k, k, 0.0};
            ++here.end;
            here.share += double(missing) / double(tracked.number);
        } else if (here.end - here.begin > longest.end - longest.begin) {
            longest = here;
        }
    }
    if (longest.end > longest.begin) longest.share /= double(longest.end - longest.begin);
    return longest;
}

/// Share of the rim's way, over all of a swirl, that lies outside of the picture.
double cut_off(const TrackedVideo& tracked) {
    constexpr int steps = 36;
    int out = 0;
    for (int a = 0; a < steps; ++a)
        for (int b = 0; b < steps; ++b) {
            const Vec2 p =
                tracked.lens.seen(tracked.path.centre - tracked.rim_shift +
                                  tracked.path.amplitude * unit_circle(double(a) / steps) +
                                  tracked.rim_radius * unit_circle(double(b) / steps));
            if (p.x < 0.0 || p.y < 0.0 || p.x > tracked.width - 1.0 || p.y > tracked.height - 1.0)
                ++out;
        }
    return double(out) / (steps * steps);
}

/// What looks wrong, with its likely cause.
void warn(TrackedVideo& tracked) {
    const auto say = [&](std::string sentence) { tracked.warnings.push_back(std::move(sentence)); };
    const double step = tracked.step();
    const double per_period = 2.0 * pi / (tracked.path.omega * step);
    const double periods = double(tracked.pictures) / per_period;
    if (periods < 1.0)
        say(fmt::format("The film shows {:.2f} of a swirl; Ω and the centre want at least one.",
                        periods));
    if (per_period < 24.0)
        say(fmt::format(
            "There are only {:.1f} pictures for a swirl: discs may be taken for each other, and "
            "their spins cannot be followed. 60 or more are right, 511 are the paper's.",
            per_period));
    if (tracked.path.used < 0.9)
        say(fmt::format(
            "In {:.0f} % of the pictures the rim is not where a dish on a circle would be: is "
            "something in front of it (a hand), was the camera moved, or did the swirl change "
            "during the film?",
            100.0 * (1.0 - tracked.path.used)));
    if (tracked.rims_missed * 20 > static_cast<std::size_t>(tracked.pictures))
        say(fmt::format("The rim was not found in {:.0f} % of the pictures.",
                        100.0 * double(tracked.rims_missed) / double(tracked.pictures)));
    if (tracked.rim_radius - tracked.reach > 0.06 * tracked.radius && !tracked.stopped)
        say(fmt::format(
            "Discs are at the wall too seldom to tell where they are stopped: the rim that is "
            "seen, of {:.2f} pixels radius, is taken for the dish. If it is the outer edge of the "
            "wall, the dish is smaller.",
            tracked.rim_radius));
    else if (tracked.rim_radius - tracked.reach > 0.06 * tracked.radius)
        say(fmt::format(
            "The rim that is seen has a radius of {:.2f} pixels, but discs never come farther out "
            "than {:.2f}: it is the outer edge of the wall. The latter is taken for the dish.",
            tracked.rim_radius, tracked.reach));
    if (tracked.reach - tracked.rim_radius > 0.06 * tracked.radius)
        say(fmt::format(
            "Discs come {:.2f} pixels farther out than the rim that is seen, of {:.2f} pixels "
            "radius; where they are stopped is taken for the dish.",
            tracked.reach - tracked.rim_radius, tracked.rim_radius));
    if (length(tracked.rim_shift) > 0.0)
        say(fmt::format(
            "Discs are stopped about a circle that lies {:.2f} pixels beside the rim's: seen at an "
            "angle, an edge that is higher or lower than they are is shifted. The former is taken, "
            "and "
            "their way for the dish's.",
            length(tracked.rim_shift)));
    if (tracked.tilt.oval)
        say("The dish looks longest in another direction than a tilted camera would make it: it is "
            "not round, or its rim not flat. Distances in the two directions cannot be compared to "
            "better than that.");
    const double beyond = tracked.polygon.corners - tracked.path.amplitude;
    if (tracked.polygon.sides > 0 && beyond > 0.05 * tracked.radius)
        say(fmt::format(
            "The dish went along a polygon of {} sides, and is taken to have gone round the circle "
            "that fits it: at the corners it was {:.2f} pixels farther out. What is measured from "
            "its middle, its radius and the places of discs in it, is off by up to that.",
            tracked.polygon.sides, beyond));
    const double cut = cut_off(tracked);
    if (cut > 0.005)
        say(fmt::format(
            "The dish is not wholly in the picture: {:.0f} % of its rim's way lies outside. Discs "
            "there are not seen, and the rest is judged by a part; film all of it.",
            std::max(100.0 * cut, 1.0)));
    const Covered hand = covered(tracked);
    const bool hidden = hand.end - hand.begin >= 4 && cut <= 0.005;
    if (hidden)
        say(fmt::format(
            "In pictures {} to {} about {:.0f} % of the discs are missing at once: something was "
            "in "
            "front of the dish, a hand perhaps. Their names before and after may not agree.",
            hand.begin, hand.end - 1, 100.0 * hand.share));
    if (tracked.complete < 0.9 && !hidden)
        say(fmt::format(
            "All {} discs are seen in only {:.1f} % of the pictures: more even light, less glare, "
            "a sharper picture or a shorter exposure would help{}.",
            tracked.number, 100.0 * tracked.complete,
            tracked.kinds.size() == 1 ? "; --discs says how many there are" : ""));
    if (double(tracked.crowded) > 0.05 * double(tracked.pictures))
        say(fmt::format(
            "In {:.0f} % of the frames there are more discs than the {} that were counted, {:.1f} "
            "more in the mean of these frames; --discs says how many there are.",
            100.0 * double(tracked.crowded) / double(tracked.pictures), tracked.number,
            double(tracked.rejected) / double(tracked.crowded)));
    if (tracked.shake > std::max(0.5, 3.0 * tracked.position_error))
        say(fmt::format(
            "The container shakes by {:.1f} pixels from frame to frame: the camera was not steady, "
            "or the rim is hard to see. Positions relative to the container err by as much.",
            tracked.shake));
    if (tracked.touching > 0.0 && std::abs(tracked.touching - 1.0) > 0.03)
        say(
            fmt::format("Discs that touch are {:.3f} of the diameters apart that their outlines "
                        "have, which are "
                        "not sharp; the distance is taken for the diameter.",
                        tracked.touching));
}

/// Of the counts of discs that are sure, the largest that is no accident.
std::size_t common_number(const std::vector<Seen>& all, std::size_t kind) {
    std::map<std::size_t, std::size_t, std::greater<>> times;
    std::size_t pictures = 0;
    for (const Seen& seen : all) {
        if (!seen.rim.good) continue;
        ++pictures;
        ++times[static_cast<std::size_t>(
            std::count_if(seen.particles.begin(), seen.particles.end(),
                          [&](const Particle& b) { return b.sure && b.kind == kind; }))];
    }
    std::size_t so_far = 0;
    for (const auto& [number, often] : times) {
        so_far += often;
        if (so_far * 7 > pictures) return number;
    }
    return 0;
}

}  // namespace

void TrackingSettings::listen() const {
    if (stop && stop->load())
        throw Interrupted("Stopped while a film was tracked; of it nothing was written.");
}

TrackScale TrackedVideo::scale() const {
    TrackScale s;
    s.frames_per_time = fps > 0.0 ? fps : 1.0;
    s.pixels_per_radius = radius;
    s.swirl_centre = path.centre;
    s.period = 2.0 * pi / path.omega;
    s.amplitude = path.amplitude / radius;
    s.phase = path.angle(times.empty() ? 0.0 : times.front());
    s.container_radius = container_radius / radius;
    s.clockwise = path.clockwise;
    return s;
}

namespace {

/// Discs in contact tell the lens beside sizes. Of a tilted camera, whose tilt was found with the
/// lens as sizes have it, that is left.
void believe_contacts(const std::vector<Seen>& all, const ParticleLook& look, Lens& lens) {
    constexpr double near = 1.4;  // of the sum of radii: with any lens
    constexpr std::size_t pictures = 400;
    if (lens.tilted()) return;
    std::vector<SeenPair> pairs;
    const std::size_t stride = all.size() / pictures + 1;
    for (std::size_t k = 0; k < all.size(); k += stride) {
        const std::vector<Particle>& particles = all[k].particles;
        for (std::size_t a = 0; a < particles.size(); ++a)
            for (std::size_t b = a + 1; b < particles.size(); ++b) {
                if (!particles[a].sure || !particles[b].sure) continue;
                const double radii =
                    look.kinds[particles[a].kind].radius + look.kinds[particles[b].kind].radius;
                if (length(particles[a].centre - particles[b].centre) < near * radii)
                    pairs.push_back({particles[a].centre, particles[b].centre, radii});
            }
    }
    const auto told = distortion_of(pairs, lens.middle, lens.half);
    if (!told) return;
    lens.contact_k = told->k;
    lens.contact_error = told->error;
    lens.settle_distortion();
}

/// Pictures that are lost or doubled make times, Ω and velocities wrong. By little that is said,
/// and otherwise there is no way on.
void judge_leaps(const std::vector<Leap>& leaps, TrackedVideo& tracked) {
    constexpr double little = 0.003;  // of the film
    if (leaps.empty()) return;
    double wrong = 0.0;
    std::size_t begin = 0, longest = 0, from = 0, doubled = 0;
    for (std::size_t n = 0; n <= leaps.size(); ++n) {
        const std::size_t end = n < leaps.size() ? leaps[n].before + 1 : tracked.times.size();
        if (end - begin > longest) longest = end - begin, from = begin;
        if (n == leaps.size()) break;
        begin = leaps[n].after;
        wrong += std::abs(leaps[n].steps - 1.0);
        doubled += leaps[n].steps < 0.5 ? 1 : 0;
    }
    const std::string what = fmt::format(
        "The dish does not go equally far from each picture to the next: in {} place{} (first "
        "between pictures {} and {}, {:.1f} times the usual way) {}.",
        leaps.size(), leaps.size() == 1 ? "" : "s", leaps.front().before, leaps.front().after,
        leaps.front().steps,
        doubled == leaps.size() ? "a picture is there twice"
        : doubled == 0          ? "pictures are missing"
                                : "pictures are missing or there twice");
    const double share = wrong / double(tracked.times.size());
    if (share < little)
        tracked.warnings.push_back(
            what + fmt::format(" Times and Ω are off by up to {:.2f} % from it.", 100.0 * share));
    else
        throw Failure(what + fmt::format(" Times and Ω would be off by up to {:.1f} %. Pictures {} "
                                         "to {} have no such place: cut the film to them, or film "
                                         "with a constant frame rate.",
                                         100.0 * share, from, from + longest - 1));
}

/// Sets the time of every frame; returns whether these are the video's own because they are uneven.
/// Steps that differ by no more than the rounding of the video's clock count as equal.
bool set_times(const TrackingSettings& settings, const VideoTimes& times, std::vector<Seen>& all,
               TrackedVideo& tracked) {
    constexpr double max_untimed = 0.1;  // of the frames
    tracked.fps = settings.fps.value_or(times.fps);
    tracked.jitter = times.jitter;
    const std::size_t frames = all.size();
    const bool known = times.seconds.size() == frames ||
                       (settings.max_pictures > 0 && times.seconds.size() > frames);
    if (settings.fps || times.jitter <= 0.2 || !known) {
        for (std::size_t k = 0; k < frames; ++k)
            tracked.times.push_back(double(k) / (tracked.fps > 0.0 ? tracked.fps : 1.0));
        return false;
    }
    const AscendingTimes own =
        ascending_times({times.seconds.begin(), times.seconds.begin() + std::ptrdiff_t(frames)});
    for (const double second : own.seconds) tracked.times.push_back(second - own.seconds.front());
    tracked.warnings.push_back(fmt::format(
        "The film's frame rate varies: the steps between its pictures differ by up to {:.0f} % "
        "from their mean, as telephones do in poor light. Its own times are used; a fixed rate "
        "(a setting of the camera) is better.",
        100.0 * times.jitter));
    if (own.untimed.empty()) return true;
    for (const std::size_t k : own.untimed) all[k] = {{}, {}, false};
    const std::string what = fmt::format(
        "{} of the {} frames of '{}' have no time of their own, the first at frame {}: their times "
        "do not advance.",
        own.untimed.size(), frames, settings.video, own.untimed.front());
    if (double(own.untimed.size()) > max_untimed * double(frames))
        throw Failure(what + " If the frames are equally spaced in time, give --fps.");
    tracked.warnings.push_back(what +
                               " These frames are not used, and their positions are filled in "
                               "from the frames around them. If the frames are equally spaced "
                               "in time, --fps uses all of them.");
    return true;
}

/// Throws Failure if the video's clock advances by half a period or more between two frames: then
/// neither the turns of the container nor the discs can be followed. The period is that of the
/// frames taken as equally spaced, which no gap can spoil.
void reject_gaps(const std::string& name, const std::vector<Vec2>& centres,
                 const std::vector<std::size_t>& numbers, const TrackedVideo& tracked) {
    const auto by_frame = fit_path(centres, {numbers.begin(), numbers.end()});
    if (!by_frame) return;
    const double half_period = pi / by_frame->omega * tracked.step();
    for (std::size_t k = 1; k < tracked.times.size(); ++k)
        if (const double step = tracked.times[k] - tracked.times[k - 1]; step >= half_period)
            throw Failure(fmt::format(
                "Between frames {} and {} of '{}' {:.3g} s pass, {:.3g} periods; discs cannot be "
                "followed across half a period or more. Cut the video there, or give --fps if its "
                "frames are equally spaced in time.",
                k - 1, k, name, step, 0.5 * step / half_period));
}

}  // namespace

double TrackedVideo::step() const {
    std::vector<double> steps;
    for (std::size_t k = 1; k < times.size(); ++k) steps.push_back(times[k] - times[k - 1]);
    return quantile(steps, 0.5);
}

TrackedVideo track_video(const TrackingSettings& settings) {
    TrackedVideo tracked;
    cv::setNumThreads(1);  // the pictures are shared out among ours
    VideoTimes times = video_times(settings.video);
    std::int64_t expected = times.pictures;
    if (settings.max_pictures > 0)
        expected = expected > 0 ? std::min(expected, settings.max_pictures) : settings.max_pictures;
    const Survey found = survey(settings, expected > 0 ? expected : 4 * survey_pictures);
    tracked.width = found.size.width;
    tracked.height = found.size.height;
    tracked.bright = found.look.polarity > 0;
    std::vector<Seen> all = look_at_all(settings, found, expected, tracked);
    tracked.lens = found.look.lens;
    tracked.tilt = found.tilt;
    believe_contacts(all, found.look, tracked.lens);
    if (found.rim.second_container) tracked.warnings.emplace_back(second_container);
    std::vector<double> rims;
    for (Seen& seen : all) {
        if (!seen.rim.good) continue;
        const Lens::Circle rim = tracked.lens.ideal({seen.rim.centre, seen.rim.radius});
        seen.rim.centre = rim.centre;
        rims.push_back(rim.radius);
        for (Particle& particle : seen.particles)
            particle.centre =
                tracked.lens.ideal({particle.centre, found.look.kinds[particle.kind].radius})
                    .centre;
    }
    tracked.pictures = static_cast<std::int64_t>(all.size());
    if (all.size() < 8)
        throw Failure(fmt::format("'{}' holds {} pictures, too few to see a dish swirl.",
                                  settings.video, all.size()));
    const bool uneven = set_times(settings, times, all, tracked);

    std::vector<Vec2> centres;
    std::vector<double> when, supports;
    std::vector<std::size_t> numbers;
    for (std::size_t k = 0; k < all.size(); ++k) {
        if (!all[k].rim.good) {
            ++tracked.rims_missed;
            continue;
        }
        centres.push_back(all[k].rim.centre);
        when.push_back(tracked.times[k]);
        numbers.push_back(k);
        supports.push_back(all[k].rim.support);
    }
    if (uneven) reject_gaps(settings.video, centres, numbers, tracked);
    const auto path = fit_path(centres, when);
    if (!path)
        throw Failure(
            "The dish was found, but its centre does not run round a circle: was the camera moved, "
            "is the film shorter than half a swirl, or has its path few corners?");
    tracked.path = *path;
    tracked.rim_radius = quantile(rims, 0.5);
    add_error_of_lens(centres, when, tracked);
    if (!uneven) judge_leaps(leaps_of(centres, numbers, tracked.path), tracked);
    tracked.shake = shake_of(centres, numbers, tracked.path);
    tracked.polygon = polygon_of(centres, when, tracked.path);
    for (std::size_t k = 0; k < all.size(); ++k)
        tracked.rim_off.push_back(
            all[k].rim.good ? length(all[k].rim.centre - tracked.path.at(tracked.times[k])) : -1.0);
    tracked.rim_support = quantile(supports, 0.5);

    for (std::size_t k = 0; k < found.look.kinds.size(); ++k) {
        const ParticleKind& kind = found.look.kinds[k];
        tracked.kinds.push_back({kind.radius, kind.scatter, common_number(all, k)});
    }
    if (settings.discs && tracked.kinds.size() == 1)
        tracked.kinds[0].number = static_cast<std::size_t>(*settings.discs);
    std::size_t commonest = 0;
    for (std::size_t k = 1; k < tracked.kinds.size(); ++k)
        if (tracked.kinds[k].number > tracked.kinds[commonest].number) commonest = k;
    tracked.radius = tracked.kinds[commonest].radius;
    track(settings, found, all, tracked);
    if (tracked.number == 0) throw Failure("No disc could be followed through the film.");
    if (tracked.lens.tilted()) move_to_wall(tracked);
    judge(all, tracked);
    believe_overlaps(tracked);
    // The wall is where discs are stopped; a rim that is seen may be the outer one of the wall, or
    // its top. Swirled discs are at the wall at all times, unless they are few: how far out those
    // come in most pictures tells nothing of the wall.
    // Where edges are soft, the shaded side of a ball is lost in the floor, and it looks too small.
    if (std::abs(tracked.touching - 1.0) > 0.02 && tracked.touching > 0.5) {
        tracked.reach += (tracked.touching - 1.0) * tracked.radius;
        tracked.radius *= tracked.touching;
        for (TrackedKind& kind : tracked.kinds) kind.radius *= tracked.touching;
        for (TrackFrame& f : tracked.tracks.frames)
            for (double& radius : f.radius) radius *= tracked.touching;
    }
    const bool agree = std::abs(tracked.rim_radius - tracked.reach) < 0.06 * tracked.radius;
    const bool too_few = !tracked.stopped && tracked.rim_radius > tracked.reach;
    tracked.container_radius = agree || too_few ? tracked.rim_radius : tracked.reach;
    warn(tracked);
    return tracked;
}

}  // namespace swirl
