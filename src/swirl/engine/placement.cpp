#include "swirl/engine/placement.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <map>
#include <utility>

#include "swirl/engine/validate.hpp"
#include "swirl/math/random.hpp"
#include "swirl/math/real.hpp"
#include "swirl/math/unit_circle.hpp"

namespace swirl {
namespace {

/// The caller's request to stop, polled every few thousandths of a second in every loop over discs
/// or sites, of which there may be hundreds of millions. After it has ended, results are unusable.
class Deadline {
  public:
    explicit Deadline(const std::function<bool()>& is_stopped) : is_stopped_(is_stopped) {}
    bool ended() {
        if (!ended_ && is_stopped_) ended_ = is_stopped_();
        return ended_;
    }

  private:
    const std::function<bool()>& is_stopped_;
    bool ended_ = false;
};

constexpr double row_height = 0.86602540378443864676;  // √3/2

/// The narrowest lattice from which sites are drawn, relative to the widest that has enough sites.
constexpr double min_relative_spacing = 1.0 / 16.0;

/// Visits all sites of a triangular lattice within `reach` of its central site.
template <class Visit>
void for_each_site(double spacing, double reach, Deadline& deadline, Visit visit) {
    const auto rows = static_cast<long>(reach / (spacing * row_height)) + 1;
    for (long row = -rows; row <= rows && !deadline.ended(); ++row) {
        const double y = spacing * row_height * static_cast<double>(row);
        const double left = reach * reach - y * y;
        if (left < 0.0) continue;
        const double shift = (row & 1) ? 0.5 : 0.0;
        const auto half = static_cast<long>(square_root(left) / spacing) + 2;
        for (long column = -half; column <= half; ++column) {
            const double x = spacing * (static_cast<double>(column) + shift);
            if (x * x <= left) visit(Vec2{x, y});
        }
    }
}

std::size_t count_sites(double spacing, double reach, Deadline& deadline) {
    std::size_t count = 0;
    for_each_site(spacing, reach, deadline, [&](const Vec2&) { ++count; });
    return count;
}

/// The widest spacing that has at least n sites, to one part in 10⁶; less precise after the
/// deadline. Returns nothing if this spacing would be below `minimum`.
template <class CountSites>
std::optional<double> widest_spacing(std::size_t n, double widest, double minimum,
                                     CountSites count_sites_of, Deadline& deadline) {
    double enough = 0.0, too_wide = widest;
    // Halve until it is narrow enough, then bisect.
    for (double spacing = too_wide; enough == 0.0; spacing = larger(0.5 * spacing, minimum)) {
        if (count_sites_of(spacing) >= n)
            enough = spacing;
        else if (spacing <= minimum || deadline.ended())
            return std::nullopt;
        else
            too_wide = spacing;
    }
    constexpr double precision = 1e-6;
    while (too_wide - enough > precision * enough && !deadline.ended()) {
        const double middle = 0.5 * (enough + too_wide);
        (count_sites_of(middle) >= n ? enough : too_wide) = middle;
    }
    return enough;
}

Vec2 turned(const Vec2& site, const Vec2& turn) {
    return {turn.x * site.x - turn.y * site.y, turn.y * site.x + turn.x * site.y};
}

/// Keeps n of the sites, chosen at random.
void choose(std::size_t n, std::vector<Vec2>& sites, Random& random, Deadline& deadline) {
    for (std::size_t k = 0; k < n && !deadline.ended(); ++k)
        std::swap(sites[k], sites[k + random.below(sites.size() - k)]);
    sites.resize(n);
}

std::vector<Vec2> choose_sites(std::size_t n, double spacing, double reach, Random& random,
                               Deadline& deadline) {
    std::vector<Vec2> sites;
    for_each_site(spacing, reach, deadline, [&](const Vec2& site) { sites.push_back(site); });
    if (deadline.ended()) return {};
    choose(n, sites, random, deadline);
    const Vec2 turn = unit_circle(random.uniform());
    for (Vec2& site : sites) site = turned(site, turn);
    return sites;
}

/// Displaces each disc at random by at most `freedom`, if the new position is allowed.
template <class IsAllowed>
void displace(std::vector<Vec2>& centres, double freedom, Random& random, Deadline& deadline,
              IsAllowed is_allowed) {
    for (Vec2& centre : centres) {
        if (deadline.ended()) return;
        const Vec2 moved = centre + random.in_disc(freedom);
        if (is_allowed(moved)) centre = moved;
    }
}

/// Square cells at least as wide as the largest disc, so overlapping discs are in adjacent cells.
class Cells {
  public:
    Cells(const std::vector<Vec2>& centres, double container_radius, double width,
          Deadline& deadline)
        : side_(static_cast<std::size_t>(2.0 * container_radius / width) + 1),
          width_(width),
          radius_(container_radius),
          head_(side_ * side_, none),
          next_(centres.size(), none) {
        for (std::size_t i = centres.size(); i-- > 0 && !deadline.ended();) {
            const std::size_t cell = row(centres[i].y) * side_ + row(centres[i].x);
            next_[i] = head_[cell];
            head_[cell] = i;
        }
    }
    template <class Visit>
    void near(const Vec2& p, Visit visit) const {
        const std::size_t cx = row(p.x), cy = row(p.y);
        for (std::size_t y = cy - (cy > 0); y <= cy + 1 && y < side_; ++y)
            for (std::size_t x = cx - (cx > 0); x <= cx + 1 && x < side_; ++x)
                for (std::size_t j = head_[y * side_ + x]; j != none; j = next_[j]) visit(j);
    }

  private:
    static constexpr std::size_t none = ~std::size_t{0};
    std::size_t row(double x) const {
        const double k = (x + radius_) / width_;
        return k <= 0.0 ? 0 : std::min(side_ - 1, static_cast<std::size_t>(k));
    }
    std::size_t side_;
    double width_, radius_;
    std::vector<std::size_t> head_, next_;
};

/// Pushes overlapping discs apart, and all discs into the container, until none overlaps. Each
/// sweep moves the two discs of an overlapping pair away from each other by half the overlap plus a
/// small margin. Returns false if the limit of sweeps, or of tested pairs, is not enough.
bool push_apart(std::vector<Vec2>& centres, const std::vector<double>& radii,
                double container_radius, Deadline& deadline) {
    long pairs = 300'000'000;  // some seconds of work
    constexpr int max_sweeps = 4000;
    const double largest = *std::max_element(radii.begin(), radii.end());
    const double margin = 1e-3 * *std::min_element(radii.begin(), radii.end());
    for (int sweep = 0; sweep < max_sweeps && pairs > 0 && !deadline.ended(); ++sweep) {
        bool overlap = false;
        // Cells are built once per sweep. A push is smaller than a cell, and a pair that is missed
        // is found in the next sweep.
        const Cells cells(centres, container_radius, 2.0 * (largest + margin), deadline);
        for (std::size_t i = 0; i < centres.size(); ++i) {
            if (i % 64 == 0 && (pairs < 0 || deadline.ended())) return false;
            cells.near(centres[i], [&](std::size_t j) {
                --pairs;
                if (j <= i) return;
                const double sum = radii[i] + radii[j];
                const Vec2 s = centres[j] - centres[i];
                const double d2 = dot(s, s);
                if (d2 >= sum * sum) return;
                overlap = true;
                const double d = square_root(d2);
                const Vec2 push = d > 0.0 ? (0.5 * (sum + margin - d) / d) * s : Vec2{sum, 0.0};
                centres[i] = centres[i] - push;
                centres[j] = centres[j] + push;
            });
            const double reach = container_radius - radii[i];
            const double d2 = dot(centres[i], centres[i]);
            if (d2 > reach * reach) {
                overlap = true;
                centres[i] = ((reach - smaller(margin, reach)) / square_root(d2)) * centres[i];
            }
        }
        if (!overlap) return true;
    }
    return false;
}

/// This length is added to the depth of every overlap, in radii of the smallest disc.
constexpr double relaxation_margin = 1e-5;

/// Minimises the energy of the overlaps of discs with each other and with the wall. It ends without
/// overlap, or in a local minimum.
class Relaxation {
  public:
    Relaxation(const std::vector<double>& radii, double container_radius, Random& random)
        : radii_(radii),
          container_radius_(container_radius),
          margin_(relaxation_margin * *std::min_element(radii.begin(), radii.end())),
          width_(2.0 * *std::max_element(radii.begin(), radii.end()) + margin_),
          force_(radii.size()),
          velocity_(radii.size()) {
        for (const double r : radii) centres_.push_back(random.in_disc(container_radius - r));
    }

    /// FIRE (Bitzek et al. 2006, doi:10.1103/PhysRevLett.97.170201): molecular dynamics whose
    /// velocity is turned towards the force while it goes downhill, and reset when it goes uphill.
    /// Subtracts its work from `budget`: one for each disc and step, or for each sixteen tested
    /// pairs.
    bool succeeds(long& budget, Deadline& deadline) {
        double step = 0.1, turn = 0.1;
        int downhill = 0;
        for (int k = 0; k < max_steps && budget > 0 && !deadline.ended(); ++k) {
            const bool overlap = find_forces(budget, deadline);
            budget -= std::max(static_cast<long>(radii_.size()), tested_pairs_ / 16);
            if (deadline.ended()) return false;
            if (!overlap) return true;
            double power = 0.0, force2 = 0.0, speed2 = 0.0;
            for (std::size_t i = 0; i < centres_.size(); ++i) {
                power += dot(force_[i], velocity_[i]);
                force2 += dot(force_[i], force_[i]);
                speed2 += dot(velocity_[i], velocity_[i]);
            }
            if (force2 < balanced * margin_ * margin_) return false;
            if (power > 0.0) {
                const double along = turn * square_root(speed2 / force2);
                for (std::size_t i = 0; i < centres_.size(); ++i)
                    velocity_[i] = (1.0 - turn) * velocity_[i] + along * force_[i];
                if (++downhill > 5) {
                    step = smaller(1.1 * step, 1.0);
                    turn *= 0.99;
                }
            } else {
                std::fill(velocity_.begin(), velocity_.end(), Vec2{0.0, 0.0});
                step *= 0.5;
                turn = 0.1;
                downhill = 0;
            }
            for (std::size_t i = 0; i < centres_.size(); ++i) {
                velocity_[i] = velocity_[i] + step * force_[i];
                centres_[i] = centres_[i] + step * velocity_[i];
            }
        }
        return false;
    }
    std::vector<Vec2> centres() const { return centres_; }

  private:
    static constexpr int max_steps = 20000;
    // Squared forces below this, in margins², are a local minimum.
    static constexpr double balanced = 1e-6;

    /// Computes the force on each disc: the depth of its overlaps plus the margin, so that none are
    /// left at the end. Returns whether there are overlaps; also true if the budget is used up or
    /// the deadline has ended.
    bool find_forces(long budget, Deadline& deadline) {
        bool overlap = false;
        tested_pairs_ = 0;
        std::fill(force_.begin(), force_.end(), Vec2{0.0, 0.0});
        const Cells cells(centres_, container_radius_, width_, deadline);
        for (std::size_t i = 0; i < centres_.size(); ++i) {
            if (i % 64 == 63 && (tested_pairs_ > 16 * budget || deadline.ended())) return true;
            cells.near(centres_[i], [&](std::size_t j) {
                ++tested_pairs_;
                if (j <= i) return;
                const Vec2 s = centres_[j] - centres_[i];
                const double touch = radii_[i] + radii_[j];
                const double d2 = dot(s, s), sum = touch + margin_;
                if (d2 >= sum * sum || d2 == 0.0) return;
                overlap |= d2 < touch * touch;
                const double d = square_root(d2);
                const Vec2 push = ((sum - d) / d) * s;
                force_[i] = force_[i] - push;
                force_[j] = force_[j] + push;
            });
            const double reach = container_radius_ - radii_[i];
            const double d2 = dot(centres_[i], centres_[i]);
            const double near = larger(reach - margin_, 0.0);
            if (d2 <= near * near) continue;
            overlap |= d2 > reach * reach;
            const double d = square_root(d2);
            force_[i] = force_[i] - (2.0 * (d - near) / d) * centres_[i];
        }
        return overlap;
    }

    const std::vector<double>& radii_;
    double container_radius_, margin_, width_;
    std::vector<Vec2> centres_, force_, velocity_;
    long tested_pairs_ = 0;  // tested pairs in the last call
};

/// The smallest container radius for these two discs side by side.
double sum_of_two_largest(const std::vector<double>& radii) {
    double first = 0.0, second = 0.0;
    for (const double r : radii) {
        second = larger(second, smaller(r, first));
        first = larger(first, r);
    }
    return first + second;
}

/// Relaxes random positions, again and again, until one attempt ends without overlap. The budget is
/// some seconds of work.
std::optional<std::vector<Vec2>> relax(const std::vector<double>& radii, double container_radius,
                                       Random& random, Deadline& deadline) {
    for (long budget = 100'000'000; budget > 0 && !deadline.ended();) {
        Relaxation relaxation(radii, container_radius, random);
        if (relaxation.succeeds(budget, deadline)) return relaxation.centres();
    }
    return std::nullopt;
}

/// Two discs of any size on a diameter; or discs of one size on a ring, from seven on with one in
/// the middle. For up to nine discs this is the densest arrangement (Pirl 1969,
/// doi:10.1002/mana.19690400110), so with a negative `slack` they do not fit.
struct FewDiscs {
    std::size_t on_ring;
    double slack;  // the container's radius minus the smallest that holds them
};

std::optional<FewDiscs> as_few_discs(const std::vector<double>& radii, double container_radius) {
    const std::size_t n = radii.size();
    if (n == 2) return FewDiscs{2, container_radius - (radii[0] + radii[1])};
    if (n < 2 || n > 9 ||
        std::any_of(radii.begin(), radii.end(), [&](double r) { return r != radii[0]; }))
        return std::nullopt;
    const std::size_t on_ring = n < 7 ? n : n - 1;
    const double ring = radii[0] / unit_circle(0.5 / static_cast<double>(on_ring)).y;
    return FewDiscs{on_ring, container_radius - (radii[0] + ring)};
}

/// Positions in which all gaps to neighbours and wall are equal, rotated by a random angle. The
/// slack may be zero, so if rounding makes two discs overlap another angle is tried.
std::optional<std::vector<Vec2>> place_few(const FewDiscs& few, const std::vector<double>& radii,
                                           double container_radius, Random& random) {
    for (int trial = 0; trial < 1000; ++trial) {
        const double turn = random.uniform();
        std::vector<Vec2> centres(radii.size(), {0.0, 0.0});
        bool fits = true;
        for (std::size_t i = 0; i < centres.size(); ++i) {
            if (i < few.on_ring) {
                const double reach = container_radius - radii[i];
                const double at = static_cast<double>(i) / static_cast<double>(few.on_ring);
                centres[i] = (reach - 0.5 * few.slack) * unit_circle(at - turn);
                fits &= dot(centres[i], centres[i]) <= reach * reach;
            }
            for (std::size_t j = 0; j < i; ++j) {
                const Vec2 s = centres[i] - centres[j];
                const double sum = radii[i] + radii[j];
                fits &= dot(s, s) >= sum * sum;
            }
        }
        if (fits) return centres;
    }
    return std::nullopt;
}

/// Discs smaller than the largest by this factor are put into the gaps between larger discs.
constexpr double very_unequal = 16.0;

/// Puts n discs, none larger than `radius`, on lattice sites where they overlap no other disc, and
/// displaces them at random. Appends them to `centres`. Returns false if there are too few sites.
bool fill_gaps(std::size_t n, double radius, double container_radius, std::vector<Vec2>& centres,
               const std::vector<double>& radii, Random& random, Deadline& deadline) {
    const double largest = *std::max_element(radii.begin(), radii.end());
    const double reach = container_radius - radius;
    const Cells cells(centres, container_radius, 2.0 * largest, deadline);
    const Vec2 turn = unit_circle(random.uniform());
    const auto is_free = [&](const Vec2& p) {
        bool free = dot(p, p) <= reach * reach;
        cells.near(p, [&](std::size_t j) {
            const Vec2 s = centres[j] - p;
            const double sum = (radii[j] + radius) * (1.0 + 1e-9);
            free &= dot(s, s) >= sum * sum;
        });
        return free;
    };
    const auto for_each_free_site = [&](double spacing, auto visit) {
        for_each_site(spacing, reach, deadline, [&](const Vec2& site) {
            if (deadline.ended()) return;
            const Vec2 p = turned(site, turn);
            if (is_free(p)) visit(p);
        });
    };
    const auto count = [&](double spacing) {
        std::size_t sites = 0;
        for_each_free_site(spacing, [&](const Vec2&) { ++sites; });
        return sites;
    };
    const double touching = 2.0 * radius * (1.0 + 1e-9);
    const auto widest = widest_spacing(n, larger(4.0 * reach / square_root(double(n)), touching),
                                       touching, count, deadline);
    if (!widest || deadline.ended()) return false;
    const double spacing = 0.5 * (touching + *widest);
    std::vector<Vec2> sites;
    for_each_free_site(spacing, [&](const Vec2& site) { sites.push_back(site); });
    if (deadline.ended() || sites.size() < n) return false;
    choose(n, sites, random, deadline);
    displace(sites, 0.49 * (spacing - touching), random, deadline, is_free);
    centres.insert(centres.end(), sites.begin(), sites.end());
    return true;
}

std::optional<std::vector<Vec2>> place(const std::vector<double>& radii, double container_radius,
                                       Random& random, Deadline& deadline);

/// Places the large discs first, then much smaller ones into the gaps, and so on. Returns nothing
/// if the discs of one size do not fit.
std::optional<std::vector<Vec2>> place_by_size(const std::vector<double>& radii,
                                               double container_radius, Random& random,
                                               Deadline& deadline) {
    std::vector<std::size_t> order(radii.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t i, std::size_t j) { return radii[i] > radii[j]; });
    std::vector<Vec2> placed;
    std::vector<double> of_placed;
    for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
        const double largest = radii[order[begin]];
        std::vector<double> alike;
        for (; end < order.size() && very_unequal * radii[order[end]] > largest; ++end)
            alike.push_back(radii[order[end]]);
        if (begin == 0) {
            const auto centres = place(alike, container_radius, random, deadline);
            if (!centres) return std::nullopt;
            placed = *centres;
        } else if (!fill_gaps(alike.size(), largest, container_radius, placed, of_placed, random,
                              deadline)) {
            return std::nullopt;
        }
        of_placed.insert(of_placed.end(), alike.begin(), alike.end());
    }
    std::vector<Vec2> centres(radii.size());
    for (std::size_t k = 0; k < order.size(); ++k) centres[order[k]] = placed[k];
    return centres;
}

/// Places discs that may fit, without overlap (placement.hpp describes the cases).
std::optional<std::vector<Vec2>> place(const std::vector<double>& radii, double container_radius,
                                       Random& random, Deadline& deadline) {
    const double largest = *std::max_element(radii.begin(), radii.end());
    const double smallest = *std::min_element(radii.begin(), radii.end());
    const double reach = container_radius - largest;
    const auto widest = widest_spacing(
        radii.size(), 4.0 * reach + 1.0, 0.0,
        [&](double spacing) { return count_sites(spacing, reach, deadline); }, deadline);
    if (!widest) return std::nullopt;
    if (*widest > 2.0 * largest) {
        // Halfway between touching and the widest lattice, so that there are empty sites and
        // freedom to displace. In a nearly empty container wider, with some hundred sites per disc.
        const double spacing =
            larger(largest + 0.5 * smaller(*widest, 3.0 * largest), min_relative_spacing * *widest);
        auto centres = choose_sites(radii.size(), spacing, reach, random, deadline);
        displace(centres, 0.49 * (spacing - 2.0 * largest), random, deadline,
                 [&](const Vec2& p) { return dot(p, p) <= reach * reach; });
        return centres;
    }
    // With less slack than the margin of the relaxation, the latter would not end.
    const auto few = as_few_discs(radii, container_radius);
    if (few && few->slack < relaxation_margin * smallest)
        return place_few(*few, radii, container_radius, random);
    if (very_unequal * smallest <= largest) {
        const auto centres = place_by_size(radii, container_radius, random, deadline);
        if (centres || deadline.ended()) return centres;
    }
    if (smallest < largest) {
        auto centres = choose_sites(radii.size(), *widest, reach, random, deadline);
        if (push_apart(centres, radii, container_radius, deadline)) return centres;
    }
    return relax(radii, container_radius, random, deadline);
}

/// Index along Morton's curve through a grid of 2¹⁶ by 2¹⁶ squares over the container. Near indices
/// are near positions, and mostly vice versa.
std::uint32_t index_on_curve(const Vec2& p, double container_radius) {
    const auto row = [&](double x) {
        const double share = 0.5 + 0.5 * (x / container_radius);
        return static_cast<std::uint32_t>(65535.0 * larger(0.0, smaller(share, 1.0)));
    };
    const auto with_gaps = [](std::uint32_t bits) {
        bits = (bits | bits << 8) & 0x00ff00ffu;
        bits = (bits | bits << 4) & 0x0f0f0f0fu;
        bits = (bits | bits << 2) & 0x33333333u;
        return (bits | bits << 1) & 0x55555555u;
    };
    return with_gaps(row(p.x)) | with_gaps(row(p.y)) << 1;
}

struct OnCurve {
    std::uint32_t index, disc;
};

constexpr std::size_t discs_per_poll = 1 << 10;

/// Radix sort, eleven bits at a time, from the lowest on.
void sort_by_index(std::vector<OnCurve>& all, Deadline& deadline) {
    constexpr std::uint32_t digits = 1u << 11;
    std::vector<OnCurve> sorted(all.size());
    for (int shift = 0; shift < 32; shift += 11) {
        const auto digit = [&](const OnCurve& one) { return one.index >> shift & (digits - 1); };
        std::vector<std::size_t> next(digits + 1, 0);
        for (const OnCurve& one : all) ++next[digit(one) + 1];
        for (std::size_t d = 1; d < digits; ++d) next[d] += next[d - 1];
        for (std::size_t k = 0; k < all.size(); ++k) {
            if (k % discs_per_poll == 0 && deadline.ended()) return;
            sorted[next[digit(all[k])]++] = all[k];
        }
        all.swap(sorted);
    }
}

/// Renumbers discs of one radius along the curve, so that the neighbours that an event reads are
/// near in memory.
std::vector<Vec2> numbered_along_curve(const std::vector<Vec2>& centres,
                                       const std::vector<double>& radii, double container_radius,
                                       Deadline& deadline) {
    std::vector<OnCurve> curve(centres.size());
    struct Numbers {
        std::vector<std::uint32_t> all;
        std::size_t given = 0;
    };
    std::map<double, Numbers> of_radius;
    for (std::uint32_t i = 0; i < centres.size(); ++i) {
        if (i % discs_per_poll == 0 && deadline.ended()) return {};
        curve[i] = {index_on_curve(centres[i], container_radius), i};
        of_radius[radii[i]].all.push_back(i);
    }
    sort_by_index(curve, deadline);
    std::vector<Vec2> numbered(centres.size());
    for (std::size_t k = 0; k < curve.size(); ++k) {
        if (k % discs_per_poll == 0 && deadline.ended()) return {};
        Numbers& numbers = of_radius[radii[curve[k].disc]];
        numbered[numbers.all[numbers.given++]] = centres[curve[k].disc];
    }
    return numbered;
}

/// The radii of the smallest known circles around N circles of radius 1000, from N = 10 on, rounded
/// down (Graham et al. 1998, doi:10.1016/S0012-365X(97)00050-2; E. Specht, "The best known packings
/// of equal circles in a circle", packomania.com).
constexpr std::int64_t first_known = 10;
constexpr std::uint16_t smallest_known_containers[] = {
    3813, 3923, 4029, 4236, 4328, 4521, 4615, 4792, 4863, 4863, 5122, 5252, 5439, 5545,
    5651, 5752, 5828, 5906, 6014, 6138, 6197, 6291, 6429, 6486, 6610, 6697, 6746, 6758,
    6961, 7057, 7123, 7260, 7346, 7419, 7498, 7572, 7650, 7724, 7791, 7886, 7947, 8027,
    8084, 8179, 8203, 8211, 8383, 8447, 8524, 8592, 8646, 8661, 8829, 8892, 8961, 9017};

/// Up to this many discs fit into the processor's nearest caches, so their order does not matter.
constexpr std::size_t max_in_any_order = 4000;

void require_radii(const std::vector<double>& radii, double container_radius,
                   const char* function) {
    if constexpr (preconditions_are_checked)
        stop_if(problem_with_radii(radii, container_radius), function);
}

}  // namespace

double max_discs_in_container(double radius, double container_radius) {
    require_radii({radius}, container_radius, "max_discs_in_container");
    const double rho = (container_radius - radius) / (2.0 * radius);
    return std::floor(pi * rho * rho / row_height + pi * rho + 1.0);
}

std::optional<std::int64_t> discs_in_densest_known_arrangement(double radius,
                                                               double container_radius) {
    require_radii({radius}, container_radius, "discs_in_densest_known_arrangement");
    // place_discs() finds no arrangement in a container narrower than this share of the smallest
    // known one, and finds one in a container wider by 0.4 %.
    constexpr double tolerance = 0.999;
    const double ratio = 1000.0 * container_radius / (tolerance * radius);
    const auto* const begin = std::begin(smallest_known_containers);
    const auto* const end = std::end(smallest_known_containers);
    const std::int64_t fit = std::upper_bound(begin, end, ratio) - begin;
    if (fit == 0 || begin + fit == end) return std::nullopt;
    return first_known - 1 + fit;
}

std::optional<std::vector<Vec2>> place_discs(const std::vector<double>& radii,
                                             double container_radius, std::uint64_t seed,
                                             const std::function<bool()>& is_stopped) {
    require_radii(radii, container_radius, "place_discs");
    if (radii.empty()) return std::vector<Vec2>{};
    const double largest = *std::max_element(radii.begin(), radii.end());
    const double smallest = *std::min_element(radii.begin(), radii.end());
    if (!(container_radius >= largest)) return std::nullopt;
    if (radii.size() > 1 && container_radius < sum_of_two_largest(radii)) return std::nullopt;
    double area = 0.0;
    for (const double r : radii) area += r * r;
    if (area > container_radius * container_radius) return std::nullopt;
    if (static_cast<double>(radii.size()) > max_discs_in_container(smallest, container_radius))
        return std::nullopt;
    Random random(seed);
    Deadline deadline(is_stopped);
    auto centres = place(radii, container_radius, random, deadline);
    if (centres && radii.size() > max_in_any_order)
        centres = numbered_along_curve(*centres, radii, container_radius, deadline);
    return deadline.ended() ? std::nullopt : std::move(centres);
}

}  // namespace swirl
