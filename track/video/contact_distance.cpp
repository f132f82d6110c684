#include "track/video/contact_distance.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "track/video/robust_statistics.hpp"

namespace swirl::tracking {

double normal_and_exponential(double x, double error, double decay) {
    const double rate = 1.0 / decay;
    const double inner = std::clamp(0.5 * rate * (rate * error * error - 2.0 * x), -300.0, 300.0);
    return 0.5 * rate * std::exp(inner) *
           std::erfc((rate * error * error - x) / (std::sqrt(2.0) * error));
}

namespace {

constexpr std::size_t bins = 80;

struct Histogram {
    double from = 0.0, width = 1.0;
    std::array<double, bins> number{};
    double outliers = 0.0;  // share of wrong positions in each bin
    double middle(std::size_t k) const { return from + width * (double(k) + 0.5); }
};

/// Parameters of the distribution, in bins, so that all are of order one.
struct Spread {
    double contact = 0.0, error = 1.0, decay = 1.0, share = 0.7;
};

/// Log likelihood of a histogram, up to a constant.
double log_likelihood(const Histogram& seen, const Spread& spread) {
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
        log_of_all += seen.number[k] * std::log(share + (1.0 - spread.share) * far + seen.outliers);
    }
    return log_of_all;
}

Spread most_likely(const Histogram& seen, Spread spread) {
    const auto allowed = [&] {
        return spread.error >= 0.2 && spread.decay >= 0.5 && spread.decay <= 2.0 * bins &&
               spread.share >= 0.05 && spread.share <= 1.0;
    };
    maximise<4>({&spread.contact, &spread.error, &spread.decay, &spread.share},
                {2.0, 1.0, 3.0, 0.15}, 0.01,
                [&] { return allowed() ? log_likelihood(seen, spread) : -1e300; });
    return spread;
}

}  // namespace

std::optional<Contact> contact_of(const std::vector<double>& distances, double nearest,
                                  double farthest, double outliers) {
    constexpr std::size_t minimum = 400;
    Histogram seen{nearest, (farthest - nearest) / double(bins), {}, outliers};
    std::size_t used = 0;
    for (const double d : distances) {
        if (!(d >= nearest && d < farthest)) continue;
        ++seen.number[std::min(static_cast<std::size_t>((d - nearest) / seen.width), bins - 1)];
        ++used;
    }
    if (used < minimum) return std::nullopt;
    // The search starts on the rise: in a dilute crowd the most frequent distance is beyond.
    const double half = 0.5 * *std::max_element(seen.number.begin(), seen.number.end());
    const auto rise = std::find_if(seen.number.begin(), seen.number.end(),
                                   [&](double number) { return number >= half; });
    const double at = double(rise - seen.number.begin());
    const Spread spread = most_likely(seen, {at, 2.0, 0.15 * bins, 0.7});
    // A maximum at an end of the histogram, or nearly as wide as the histogram, is no contact.
    if (spread.contact < 0.1 * bins || spread.contact > 0.8 * bins || spread.error > 0.25 * bins)
        return std::nullopt;
    return Contact{nearest + seen.width * spread.contact, seen.width * spread.error,
                   log_likelihood(seen, spread) / double(used)};
}

std::optional<FewContacts> contact_of_few(const std::vector<std::vector<double>>& encounters,
                                          double error) {
    constexpr double nearest = 1.0 - few_range, farthest = 1.0 + few_range;
    constexpr std::size_t least = 10;   // encounters
    constexpr double outliers = 1e-5;   // share of wrong positions in each bin: of few, none
    constexpr double max_error = 0.01;  // of the contact: an outline is as good
    if (encounters.size() < least) return std::nullopt;
    Histogram seen{nearest, (farthest - nearest) / double(bins), {}, outliers};
    for (const std::vector<double>& distances : encounters)
        for (const double d : distances) {
            const auto bin = static_cast<std::size_t>((d - nearest) / seen.width);
            seen.number[std::min(bin, bins - 1)] += 1.0 / double(distances.size());
        }
    // The likelihood of each contact distance, with the best of all other unknowns.
    std::array<double, bins> logs{};
    for (std::size_t k = 0; k < bins; ++k) {
        Spread spread{double(k), std::max(error / seen.width, 0.5), 0.15 * bins, 0.7};
        maximise<2>({&spread.decay, &spread.share}, {3.0, 0.15}, 0.05, [&] {
            const bool allowed = spread.decay >= 0.5 && spread.decay <= 2.0 * bins &&
                                 spread.share >= 0.05 && spread.share <= 1.0;
            return allowed ? log_likelihood(seen, spread) : -1e300;
        });
        logs[k] = log_likelihood(seen, spread);
    }
    const double highest = *std::max_element(logs.begin(), logs.end());
    double sum = 0.0, first = 0.0, second = 0.0;
    for (std::size_t k = 0; k < bins; ++k) {
        const double weight = std::exp(logs[k] - highest);
        sum += weight;
        first += weight * double(k);
        second += weight * double(k) * double(k);
    }
    const double mean = first / sum, variance = second / sum - mean * mean;
    const FewContacts found{nearest + seen.width * mean,
                            seen.width * std::sqrt(std::max(variance, 1.0 / 12.0))};
    if (found.error > max_error) return std::nullopt;
    return found;
}

std::optional<Contact> contact_of_discs(const std::vector<double>& ratios, double at_wall,
                                        double outliers) {
    constexpr double range = 0.1, soft_range = 0.2;  // range from 1
    constexpr double max_soft_off = 0.15;            // more is no contact of soft edges
    if (const auto found = contact_of(ratios, 1.0 - range, 1.0 + range, outliers);
        found && std::abs(found->at - 1.0) < max_contact_off)
        return found;
    const auto soft = contact_of(ratios, 1.0 - soft_range, 1.0 + soft_range, outliers);
    if (soft && std::abs(soft->at - 1.0) < max_soft_off) return soft;
    // The edge of a transparent ball is within the ball. Discs that never touch have no sharp
    // onset.
    constexpr double max_error = 0.04;
    const auto inside = contact_of(ratios, 1.0 - soft_range, 1.0 + contact_range, outliers);
    if (!inside || inside->at < 1.0 + max_contact_off ||
        (inside->error > max_error && std::abs(inside->at - at_wall) > max_error))
        return std::nullopt;
    return inside;
}

std::optional<Distortion> distortion_of(const std::vector<DiscPair>& pairs, const Vec2& middle,
                                        double half) {
    constexpr double maximum = 0.12, coarse = 0.02, fine = 0.005;
    // A contact lasts for several frames, and a disc has several: this many pairs are correlated.
    constexpr double correlated_pairs = 4.0;
    const auto score = [&](double k) {
        Lens lens{middle, half};
        lens.k = k;
        std::vector<double> distances;
        double stretch = 0.0;
        for (const DiscPair& pair : pairs) {
            const Vec2 q = (0.5 / half) * (pair.one + pair.other - 2.0 * middle);
            const Vec2 d = lens.ideal(pair.one) - lens.ideal(pair.other);
            distances.push_back(std::sqrt(dot(d, d)) / pair.radii);
            stretch += (1.0 + 2.0 * k * dot(q, q)) / double(pairs.size());
        }
        for (double& d : distances) d /= stretch;
        const auto contact = contact_of(distances, 0.88, 1.14);
        return contact ? contact->log_likelihood : -1e300;
    };
    double best = 0.0, highest = -1e300;
    for (double k = -maximum; k < maximum + 0.5 * coarse; k += coarse)
        if (const double w = score(k); w > highest) highest = w, best = k;
    if (highest == -1e300) return std::nullopt;
    for (double step = 0.5 * coarse; step > 0.5 * fine; step *= 0.5) {
        const double about = best;
        for (const double k : {about - step, about + step})
            if (const double w = score(k); w > highest) highest = w, best = k;
    }
    const double before = score(best - fine), after = score(best + fine);
    const double bend = before - 2.0 * highest + after;
    if (before == -1e300 || after == -1e300 || !(bend < 0.0)) return std::nullopt;
    const double shift = std::clamp(0.5 * (before - after) / bend, -1.0, 1.0);
    // The density of a crowd varies over the container, which shifts contact distances by about
    // this much. Its effect on k depends on how much farther out the outer half of the pairs is.
    constexpr double contact_bias = 0.0018;
    std::vector<double> squares;
    for (const DiscPair& pair : pairs) {
        const Vec2 q = (0.5 / half) * (pair.one + pair.other - 2.0 * middle);
        squares.push_back(dot(q, q));
    }
    std::sort(squares.begin(), squares.end());
    double farther = 0.0;
    for (std::size_t n = 0; n < squares.size(); ++n)
        farther += (2 * n < squares.size() ? -2.0 : 2.0) * squares[n] / double(squares.size());
    const double by_chance = fine / std::sqrt(-bend * double(pairs.size()) / correlated_pairs);
    return Distortion{best + fine * shift,
                      std::hypot(by_chance, 0.5 * contact_bias / std::max(farther, 1e-6))};
}

}  // namespace swirl::tracking
