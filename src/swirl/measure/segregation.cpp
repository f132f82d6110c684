#include "swirl/measure/segregation.hpp"

#include <algorithm>
#include <numeric>

#include "swirl/math/real.hpp"

namespace swirl {
namespace {

/// Adds one at `rank` of a Fenwick tree.
void count(std::vector<std::int64_t>& tree, std::size_t rank) {
    for (std::size_t k = rank + 1; k < tree.size(); k += k & (~k + 1)) ++tree[k];
}
/// The number of entries at ranks below `rank`.
std::int64_t count_below(const std::vector<std::int64_t>& tree, std::size_t rank) {
    std::int64_t sum = 0;
    for (std::size_t k = rank; k > 0; k -= k & (~k + 1)) sum += tree[k];
    return sum;
}

}  // namespace

double RadialSegregation::operator()(const std::vector<double>& size,
                                     const std::vector<double>& distance) {
    const std::size_t n = size.size();
    sizes_ = size;
    std::sort(sizes_.begin(), sizes_.end());
    sizes_.erase(std::unique(sizes_.begin(), sizes_.end()), sizes_.end());
    rank_.resize(n);
    for (std::size_t i = 0; i < n; ++i)
        rank_[i] = static_cast<std::uint32_t>(
            std::lower_bound(sizes_.begin(), sizes_.end(), size[i]) - sizes_.begin());
    order_.resize(n);
    std::iota(order_.begin(), order_.end(), 0u);
    std::sort(order_.begin(), order_.end(),
              [&](std::uint32_t a, std::uint32_t b) { return distance[a] < distance[b]; });
    tree_.assign(sizes_.size() + 1, 0);
    double larger_outside = 0.0, larger_inside = 0.0;
    for (std::size_t begin = 0; begin < n;) {
        std::size_t end = begin;  // end of the particles at the same distance
        while (end < n && distance[order_[end]] == distance[order_[begin]]) ++end;
        for (std::size_t k = begin; k < end; ++k) {
            const std::size_t rank = rank_[order_[k]];
            larger_outside += static_cast<double>(count_below(tree_, rank));
            larger_inside += static_cast<double>(static_cast<std::int64_t>(begin) -
                                                 count_below(tree_, rank + 1));
        }
        for (std::size_t k = begin; k < end; ++k) count(tree_, rank_[order_[k]]);
        begin = end;
    }
    const double pairs = larger_outside + larger_inside;
    return pairs > 0.0 ? (larger_outside - larger_inside) / pairs : not_available;
}

std::vector<bool> large_class(const std::vector<double>& size) {
    if (size.empty()) return {};
    std::vector<double> sorted = size;
    std::sort(sorted.begin(), sorted.end());
    if (sorted.front() == sorted.back()) return {};
    const double median = sorted[(sorted.size() - 1) / 2];
    const bool none_above = median == sorted.back();
    std::vector<bool> is_large(size.size());
    for (std::size_t i = 0; i < size.size(); ++i)
        is_large[i] = none_above ? size[i] == median : size[i] > median;
    return is_large;
}

/// Classes are found again only if the particles have changed.
void Segregation::set_sizes(const MFrameView& view) {
    const auto [least, most] = std::minmax_element(view.radius.begin(), view.radius.end());
    const bool by_mass = view.size() > 0 && *least == *most;
    const std::vector<double>& now = by_mass ? view.mass : view.radius;
    if (now == size_) return;
    size_ = now;
    is_large_ = large_class(size_);
}

void Segregation::sample(const MFrameView& view, const Voronoi& cells, PinnedFlags) {
    set_sizes(view);
    if (is_large_.empty()) return;
    distance_.resize(view.size());
    double ends = 0.0, large_ends = 0.0, unlike_ends = 0.0;
    for (std::size_t i = 0; i < view.size(); ++i) {
        const Vec2 p = view.position(i);
        distance_[i] = square_root(dot(p, p));
        (is_large_[i] ? large_ : small_).add(distance_[i]);
        for (const Voronoi::Border* b = cells.begin(i); b != cells.end(i); ++b) {
            ends += 1.0;
            large_ends += is_large_[i] ? 1.0 : 0.0;
            unlike_ends += is_large_[i] != is_large_[b->neighbour] ? 1.0 : 0.0;
        }
    }
    const double radial = radial_of_(size_, distance_);
    if (radial == radial) radial_.add(radial);
    const double n = static_cast<double>(view.size()), a = large_ends / ends;
    const double random = 2.0 * a * (1.0 - a) * n / (n - 1.0);
    if (random > 0.0) neighbours_.add(1.0 - unlike_ends / ends / random);
}

}  // namespace swirl
