#include "swirl/simulation/placement.hpp"

#include <algorithm>
#include <cstddef>

#include "swirl/math/random.hpp"
#include "swirl/math/real.hpp"
#include "swirl/math/unit_circle.hpp"

namespace swirl {
namespace {

constexpr double row_height = 0.86602540378443864676;  // √3/2

/// Sites of the triangular lattice of the given spacing within `reach` of one of them.
template <class Visit>
void for_each_site(double spacing, double reach, Visit visit) {
    const auto rows = static_cast<long>(reach / (spacing * row_height)) + 1;
    for (long row = -rows; row <= rows; ++row) {
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

std::size_t count_sites(double spacing, double reach) {
    std::size_t count = 0;
    for_each_site(spacing, reach, [&](const Vec2&) { ++count; });
    return count;
}

/// The widest spacing that still has n sites within reach, to one part in 10⁶.
double widest_spacing(std::size_t n, double reach) {
    double enough = 0.0, too_wide = 4.0 * reach + 1.0;
    // Halve until it is narrow enough, then bisect.
    for (double guess = too_wide; enough == 0.0; guess *= 0.5)
        if (count_sites(guess, reach) >= n)
            enough = guess;
        else
            too_wide = guess;
    while (too_wide - enough > 1e-6 * enough) {
        const double middle = 0.5 * (enough + too_wide);
        (count_sites(middle, reach) >= n ? enough : too_wide) = middle;
    }
    return enough;
}

std::vector<Vec2> choose_sites(std::size_t n, double spacing, double reach, Random& random) {
    std::vector<Vec2> sites;
    for_each_site(spacing, reach, [&](const Vec2& site) { sites.push_back(site); });
    for (std::size_t k = 0; k < n; ++k)
        std::swap(sites[k], sites[k + random.below(sites.size() - k)]);
    sites.resize(n);
    const Vec2 turn = unit_circle(random.uniform());
    for (Vec2& site : sites)
        site = {turn.x * site.x - turn.y * site.y, turn.y * site.x + turn.x * site.y};
    return sites;
}

/// Moves each disc within its free space, keeping it inside the dish.
void shake(std::vector<Vec2>& centres, double freedom, double reach, Random& random) {
    for (Vec2& centre : centres) {
        const Vec2 moved = centre + random.in_disc(freedom);
        if (dot(moved, moved) <= reach * reach) centre = moved;
    }
}

/// Square cells no smaller than the largest disc, so that whoever overlaps is in a cell next door.
class Cells {
  public:
    Cells(const std::vector<Vec2>& centres, double container_radius, double width)
        : side_(static_cast<std::size_t>(2.0 * container_radius / width) + 1),
          width_(width),
          radius_(container_radius),
          head_(side_ * side_, none),
          next_(centres.size(), none) {
        for (std::size_t i = centres.size(); i-- > 0;) {
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

/// Pushes overlapping discs apart, and all of them into the dish, until none overlaps: each sweep
/// moves the two discs of an overlapping pair away from each other by half the overlap and a
/// little more. False if a thousand sweeps do not suffice.
bool push_apart(std::vector<Vec2>& centres, const std::vector<double>& radii,
                double container_radius) {
    const double largest = *std::max_element(radii.begin(), radii.end());
    const double margin = 1e-3 * *std::min_element(radii.begin(), radii.end());
    for (int sweep = 0; sweep < 4000; ++sweep) {
        bool overlap = false;
        // The cells are made for the centres as they are now; a push within the sweep is smaller
        // than the cells, and whoever is missed is found in the next one.
        const Cells cells(centres, container_radius, 2.0 * (largest + margin));
        for (std::size_t i = 0; i < centres.size(); ++i) {
            cells.near(centres[i], [&](std::size_t j) {
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

}  // namespace

std::optional<std::vector<Vec2>> place_discs(const std::vector<double>& radii,
                                             double container_radius, std::uint64_t seed) {
    if (radii.empty()) return std::vector<Vec2>{};
    Random random(seed);
    const double largest = *std::max_element(radii.begin(), radii.end());
    const double smallest = *std::min_element(radii.begin(), radii.end());
    if (!(container_radius >= largest)) return std::nullopt;
    double area = 0.0;
    for (const double r : radii) area += r * r;
    if (area > container_radius * container_radius) return std::nullopt;

    const double reach = container_radius - largest;
    const double widest = widest_spacing(radii.size(), reach);
    if (widest > 2.0 * largest) {
        // Halfway between touching and the widest lattice: empty sites, and room to shake.
        const double spacing = largest + 0.5 * smaller(widest, 3.0 * largest);
        auto centres = choose_sites(radii.size(), spacing, reach, random);
        shake(centres, 0.49 * (spacing - 2.0 * largest), reach, random);
        return centres;
    }
    if (smallest == largest) return std::nullopt;
    auto centres = choose_sites(radii.size(), widest, reach, random);
    if (!push_apart(centres, radii, container_radius)) return std::nullopt;
    return centres;
}

}  // namespace swirl
