#include "track/video/particle_size.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "swirl/run/failure.hpp"
#include "track/video/contact_distance.hpp"

namespace swirl::tracking {

std::vector<CircleCandidate> best_candidates(std::vector<CircleCandidate> all, double spacing) {
    std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
        return a.support * std::sqrt(a.radius) > b.support * std::sqrt(b.radius);
    });
    return without_overlaps(all, spacing);
}

bool within(const CircleFit& rim, const Vec2& centre, double radius) {
    return length(centre - rim.centre) + radius < rim.radius + 0.3 * radius + 1.0;
}

namespace {

constexpr std::size_t frames_used = 6;
constexpr double many_discs = 12.0;  // enough for statistics

double container_radius(const ParticleSurvey& survey) {
    return survey.rims.front().radius * survey.frames.front().shrink;
}

/// The best circles of frame k, which do not overlap.
std::vector<CircleCandidate> circles_in(const ParticleSurvey& survey, std::size_t k, double radius,
                                        Polarity polarity) {
    constexpr double min_support = 0.3;
    const PreparedFrame& frame = survey.frames[k];
    const double container = container_radius(survey);
    const double area = container * container / (radius * radius);
    std::vector<CircleCandidate> inside;
    for (const CircleCandidate& c :
         best_candidates(vote(survey.edges[k], frame.small.size(), radius, polarity, min_support,
                              static_cast<std::size_t>(1.2 * area))))
        if (within(survey.rims[k], frame.to_sharp(c.centre), radius / frame.shrink))
            inside.push_back(c);
    return inside;
}

/// Circles of one radius in the frames of the survey.
struct SizeCheck {
    double mean = 0.0, spread = 0.0;  // mean of the number per frame
    double fill = 0.0;                // share of the container's area
    std::vector<double> distances;    // distances of neighbours, in diameters
};

SizeCheck check_size(const ParticleSurvey& survey, const CommonCircle& size) {
    constexpr double neighbours = 2.4;  // diameters
    SizeCheck check;
    double sum = 0.0, square = 0.0, frames = 0.0;
    for (std::size_t k = 0; k < survey.frames.size(); ++k) {
        if (!survey.rims[k].good) continue;
        const auto circles = circles_in(survey, k, size.radius, size.polarity);
        const auto number = double(circles.size());
        sum += number, square += number * number, frames += 1.0;
        for (std::size_t a = 0; a < circles.size(); ++a)
            for (std::size_t b = 0; b < a; ++b) {
                const double d =
                    length(circles[a].centre - circles[b].centre) / (2.0 * size.radius);
                if (d < neighbours) check.distances.push_back(d);
            }
    }
    if (!(frames > 0.0)) return check;
    check.mean = sum / frames;
    check.spread = std::sqrt(std::max(0.0, square / frames - check.mean * check.mean));
    const double share = size.radius / container_radius(survey);
    check.fill = check.mean * share * share;
    return check;
}

/// The contact distance in diameters: more than 1 if distances pile up there, and hardly any
/// circles are in contact.
double spacing_of(const std::vector<double>& distances) {
    constexpr double contact = 1.15;  // diameters
    // Below, fits with free radius find the discs themselves, which is more accurate.
    constexpr double far_off = 1.3;
    constexpr double farthest = 2.2, max_error = 0.16;
    constexpr double max_share = 0.2;  // share of the number of distances just above the larger one
    const auto found = contact_of(distances, 1.0, farthest);
    if (!found || found->at < far_off || found->error > max_error) return 1.0;
    const auto between = [&](double from, double to) {
        return double(std::count_if(distances.begin(), distances.end(),
                                    [&](double d) { return d >= from && d < to; }));
    };
    const double touching = between(2.0 - contact, contact),
                 apart = between(found->at - (contact - 1.0), found->at + (contact - 1.0));
    return touching < max_share * apart ? found->at : 1.0;
}

/// Why the frames contradict this size; empty if they do not.
std::string contradiction(const SizeCheck& check) {
    constexpr double min_fill = 0.03;     // share of the area
    constexpr double max_flicker = 0.35;  // share of the mean number
    if (check.mean > many_discs && check.fill < min_fill)
        return fmt::format("they fill only {:.1f} % of the container", 100.0 * check.fill);
    if (check.mean > many_discs && check.spread > max_flicker * check.mean)
        return fmt::format(
            "their number changes from frame to frame by {:.0f}, and is {:.0f} on average",
            check.spread, check.mean);
    return "";
}

/// All radii and polarities, and whether the score of each is a maximum over the radius.
struct Scores {
    std::vector<CommonCircle> sizes;
    std::vector<double> numbers;  // numbers of circles per frame
    std::vector<char> maximum, end;
};

Scores score_sizes(const ParticleSurvey& survey, const KnownDiscs& known) {
    constexpr double growth = 0.04;      // growth from one radius to the next
    constexpr double known_error = 0.2;  // of a given radius: the rim may be the outer edge
    const std::size_t stride = std::max<std::size_t>(1, survey.frames.size() / frames_used);
    const double container = container_radius(survey);
    double first = std::max(3.0, container / 25.0), last = container / 2.5;
    if (known.radius_share) {
        first = std::max(2.0, (1.0 - known_error) * *known.radius_share * container);
        last = (1.0 + known_error) * *known.radius_share * container;
    }
    Scores scores;
    for (double radius = first; radius < last; radius += std::max(0.5, growth * radius))
        for (const Polarity polarity : {1, -1}) {
            double score = 0.0, number = 0.0;
            for (std::size_t k = 0; k < survey.frames.size(); k += stride) {
                if (!survey.rims[k].good) continue;
                for (const CircleCandidate& c : circles_in(survey, k, radius, polarity)) {
                    score += c.support * c.support * radius;
                    number += 1.0;
                }
            }
            scores.sizes.push_back({score, radius, polarity});
            scores.numbers.push_back(number / double((survey.frames.size() + stride - 1) / stride));
        }
    constexpr std::size_t next = 2;  // both polarities of a radius follow each other
    for (std::size_t k = 0; k < scores.sizes.size(); ++k) {
        const double here = scores.sizes[k].score;
        const bool first_one = k < next;
        scores.maximum.push_back(
            here > 0.0 && (first_one || here > scores.sizes[k - next].score) &&
            (k + next >= scores.sizes.size() || here >= scores.sizes[k + next].score));
        scores.end.push_back(first_one && !known.radius_share);
    }
    return scores;
}

}  // namespace

CommonCircle find_common_circle(const ParticleSurvey& survey, const KnownDiscs& known) {
    constexpr double min_share = 0.35;        // share of the highest score
    constexpr double max_number_error = 0.4;  // share of a given number
    const Scores scores = score_sizes(survey, known);
    std::vector<std::size_t> order;
    for (std::size_t k = 0; k < scores.sizes.size(); ++k)
        if (scores.maximum[k]) order.push_back(k);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return scores.sizes[a].score > scores.sizes[b].score;
    });
    if (order.empty()) return {};
    const CommonCircle best = scores.sizes[order.front()];
    std::string reason;
    double radius_of_reason = 0.0;
    std::optional<CommonCircle> at_end;
    for (const std::size_t k : order) {
        const CommonCircle& size = scores.sizes[k];
        if (size.score < min_share * best.score) break;
        if (known.number && std::abs(scores.numbers[k] - double(*known.number)) >
                                max_number_error * double(*known.number))
            continue;
        const SizeCheck check = check_size(survey, size);
        const std::string wrong = contradiction(check);
        if (wrong.empty()) {
            CommonCircle found = size;
            if (check.mean > many_discs) found.spacing = spacing_of(check.distances);
            if (!scores.end[k]) return found;
            if (!at_end) at_end = found;
        } else if (reason.empty()) {
            reason = wrong;
            radius_of_reason = size.radius / survey.frames.front().shrink;
        }
    }
    if (at_end) return *at_end;
    if (reason.empty()) return best;
    throw UncertainDiscs(fmt::format(
        "the container was found, but no discs: circles with a radius of {:.1f} pixels fit the "
        "edges best, but {}.\nhint: give --discs, or --disc-diameter and --container-diameter. A "
        "higher contrast and less compression also help.",
        radius_of_reason, reason));
}

}  // namespace swirl::tracking
