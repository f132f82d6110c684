#include "swirl/tracking/contact_distance.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "swirl/math/unit_circle.hpp"

namespace swirl {

namespace {

constexpr std::size_t bins = 80;

struct Histogram {
    double from = 0.0, width = 1.0;
    std::array<double, bins> number{};
    double middle(std::size_t k) const { return from + width * (double(k) + 0.5); }
};

/// In bins, so that all numbers are of order one.
struct Spread {
    double contact = 0.0, error = 1.0, decay = 1.0, share = 0.7;
};

/// A normal deviate plus an exponential one, at x beyond the former's mean; `decay` is the length
/// of the latter.
double normal_and_exponential(double x, double error, double decay) {
    const double rate = 1.0 / decay;
    const double inner = std::clamp(0.5 * rate * (rate * error * error - 2.0 * x), -300.0, 300.0);
    return 0.5 * rate * std::exp(inner) *
           std::erfc((rate * error * error - x) / (std::sqrt(2.0) * error));
}

/// The logarithm of the likelihood of a histogram, but for what is the same for all spreads.
double likelihood(const Histogram& seen, const Spread& spread) {
    std::array<double, bins> near{};
    double sum = 0.0, beyond = 0.0;
    for (std::size_t k = 0; k < bins; ++k) {
        const double x = double(k) + 0.5 - spread.contact;
        sum += near[k] = normal_and_exponential(x, spread.error, spread.decay);
        beyond += x > 0.0 ? 1.0 : 0.0;
    }
    double log_of_all = 0.0;
    for (std::size_t k = 0; k < bins; ++k) {
        const double far = double(k) + 0.5 > spread.contact ? 1.0 / std::max(beyond, 1.0) : 0.0;
        const double share = spread.share * near[k] / std::max(sum, 1e-300);
        log_of_all += seen.number[k] * std::log(share + (1.0 - spread.share) * far + 1e-9);
    }
    return log_of_all;
}

/// One number after the other, with steps that shrink when none helps.
Spread likeliest(const Histogram& seen, Spread spread) {
    std::array<double*, 4> numbers{&spread.contact, &spread.error, &spread.decay, &spread.share};
    std::array<double, 4> steps{2.0, 1.0, 3.0, 0.15};
    const auto allowed = [&] {
        return spread.error >= 0.2 && spread.decay >= 0.5 && spread.decay <= 2.0 * bins &&
               spread.share >= 0.05 && spread.share <= 1.0;
    };
    double best = likelihood(seen, spread);
    for (int round = 0; round < 300 && steps[0] > 0.01; ++round) {
        bool better = false;
        for (std::size_t n = 0; n < numbers.size(); ++n)
            for (const double step : {steps[n], -steps[n]}) {
                const double before = *numbers[n];
                *numbers[n] += step;
                const double now = allowed() ? likelihood(seen, spread) : -1e300;
                if (now > best) {
                    best = now;
                    better = true;
                    break;
                }
                *numbers[n] = before;
            }
        if (!better)
            for (double& step : steps) step *= 0.6;
    }
    return spread;
}

/// By how much a normal number of mean x and variance 1 is above x if it is known to be positive:
/// φ(x)/Φ(x).
double excess_if_positive(double x) {
    constexpr double far = -6.0;  // where both vanish, and it is −x − 1/x
    if (x < far) return -x - 1.0 / x;
    return std::exp(-0.5 * x * x) / std::sqrt(2.0 * pi) / (0.5 * std::erfc(-x / std::sqrt(2.0)));
}

/// Two that may not come nearer, or one and the wall: `other` is then its own.
struct Constraint {
    std::size_t one, other;
    Vec2 apart;  // unit vector along which they are moved, `one` with it
    double minimum, force = 0.0;
};

std::vector<Constraint> constraints_of(const std::vector<HardDisc>& discs, double closest,
                                       const Vec2& container) {
    constexpr double looked_at = 1.08;  // of the closest distance: five errors and more
    std::vector<Constraint> all;
    for (std::size_t a = 0; a < discs.size(); ++a) {
        for (std::size_t b = a + 1; b < discs.size(); ++b) {
            const Vec2 d = discs[a].centre - discs[b].centre;
            const double far = std::sqrt(dot(d, d));
            const double minimum = closest * (discs[a].radius + discs[b].radius);
            if (far > 0.0 && far < looked_at * minimum)
                all.push_back({a, b, (1.0 / far) * d, minimum});
        }
        const Vec2 d = discs[a].centre - container;
        const double far = std::sqrt(dot(d, d));
        if (far > 0.0 && far > discs[a].reach - 0.1 * discs[a].radius)
            all.push_back({a, a, (-1.0 / far) * d, -discs[a].reach});
    }
    return all;
}

}  // namespace

std::optional<Contact> contact_of(const std::vector<double>& distances, double nearest,
                                  double farthest) {
    constexpr std::size_t minimum = 400;
    Histogram seen;
    seen.from = nearest;
    seen.width = (farthest - nearest) / double(bins);
    std::size_t used = 0;
    for (const double d : distances) {
        if (!(d >= nearest && d < farthest)) continue;
        ++seen.number[std::min(static_cast<std::size_t>((d - nearest) / seen.width), bins - 1)];
        ++used;
    }
    if (used < minimum) return std::nullopt;
    // From where they are commonest.
    const auto top = std::max_element(seen.number.begin(), seen.number.end());
    const double at = double(top - seen.number.begin());
    const Spread spread = likeliest(seen, {at - 1.0, 2.0, 0.15 * bins, 0.7});
    // At an end of what was looked at, or as wide as all of it, it is none.
    if (spread.contact < 0.1 * bins || spread.contact > 0.8 * bins || spread.error > 0.25 * bins)
        return std::nullopt;
    return Contact{nearest + seen.width * spread.contact, seen.width * spread.error,
                   likelihood(seen, spread) / double(used)};
}

std::optional<Distortion> distortion_of(const std::vector<SeenPair>& pairs, const Vec2& middle,
                                        double half) {
    constexpr double maximum = 0.12, coarse = 0.02, fine = 0.005;
    // Who is in contact is so in several pictures of a survey, and in each with several.
    constexpr double pairs_alike = 4.0;
    const auto worth = [&](double k) {
        Lens lens{middle, half};
        lens.k = k;
        std::vector<double> distances;
        double stretch = 0.0;
        for (const SeenPair& pair : pairs) {
            const Vec2 q = (0.5 / half) * (pair.one + pair.other - 2.0 * middle);
            const Vec2 d = lens.ideal(pair.one) - lens.ideal(pair.other);
            distances.push_back(std::sqrt(dot(d, d)) / pair.radii);
            stretch += (1.0 + 2.0 * k * dot(q, q)) / double(pairs.size());
        }
        for (double& d : distances) d /= stretch;
        const auto contact = contact_of(distances, 0.88, 1.14);
        return contact ? contact->worth : -1e300;
    };
    double best = 0.0, highest = -1e300;
    for (double k = -maximum; k < maximum + 0.5 * coarse; k += coarse)
        if (const double w = worth(k); w > highest) highest = w, best = k;
    if (highest == -1e300) return std::nullopt;
    for (double step = 0.5 * coarse; step > 0.5 * fine; step *= 0.5) {
        const double about = best;
        for (const double k : {about - step, about + step})
            if (const double w = worth(k); w > highest) highest = w, best = k;
    }
    const double before = worth(best - fine), after = worth(best + fine);
    const double bend = before - 2.0 * highest + after;
    if (before == -1e300 || after == -1e300 || !(bend < 0.0)) return std::nullopt;
    const double shift = std::clamp(0.5 * (before - after) / bend, -1.0, 1.0);
    // A crowd is denser in one part of the dish than in another, which moves its contacts by so
    // much; against how much farther out the outer half of the pairs is.
    constexpr double contact_known_to = 0.0018;
    std::vector<double> squares;
    for (const SeenPair& pair : pairs) {
        const Vec2 q = (0.5 / half) * (pair.one + pair.other - 2.0 * middle);
        squares.push_back(dot(q, q));
    }
    std::sort(squares.begin(), squares.end());
    double farther = 0.0;
    for (std::size_t n = 0; n < squares.size(); ++n)
        farther += (2 * n < squares.size() ? -2.0 : 2.0) * squares[n] / double(squares.size());
    const double by_chance = fine / std::sqrt(-bend * double(pairs.size()) / pairs_alike);
    return Distortion{best + fine * shift,
                      std::hypot(by_chance, 0.5 * contact_known_to / std::max(farther, 1e-6))};
}

void move_apart(std::vector<HardDisc>& discs, double closest, const Vec2& container) {
    constexpr int linearized = 3, rounds = 60;
    constexpr double stands_still = 2e-3;  // pixels
    constexpr double follow = 0.7;         // all at once would swing
    const std::vector<HardDisc> seen = discs;
    for (int pass = 0; pass < linearized; ++pass) {
        std::vector<Constraint> all = constraints_of(discs, closest, container);
        std::vector<Vec2> places;
        for (const HardDisc& disc : seen) places.push_back(disc.centre);
        for (int round = 0; round < rounds; ++round) {
            double maximum = 0.0;
            for (Constraint& c : all) {
                const bool wall = c.one == c.other;
                const Vec2 from = places[c.one] - (wall ? container : places[c.other]);
                const double share = seen[c.one].variance + (wall ? 0.0 : seen[c.other].variance);
                const double deviation = std::sqrt(share);
                const double free = dot(from, c.apart) - c.minimum - c.force * share;
                const double more =
                    follow * (excess_if_positive(free / deviation) / deviation - c.force);
                c.force += more;
                places[c.one] = places[c.one] + more * seen[c.one].variance * c.apart;
                if (!wall)
                    places[c.other] = places[c.other] - more * seen[c.other].variance * c.apart;
                maximum = std::max(maximum, std::abs(more) * share);
            }
            if (maximum < stands_still) break;
        }
        for (std::size_t i = 0; i < discs.size(); ++i) discs[i].centre = places[i];
    }
}

}  // namespace swirl
