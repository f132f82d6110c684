#include "swirl/measure/contact_network.hpp"

#include <algorithm>

namespace swirl {

/// Returns the disc that represents the group of `disc`, and halves the path to it (union-find).
std::uint32_t ContactNetwork::root_of(std::uint32_t disc) {
    while (parent_[disc] != disc) disc = parent_[disc] = parent_[parent_[disc]];
    return disc;
}

void ContactNetwork::sample(const MFrameView& view) {
    if (skips_next() || view.size() == 0) return;
    const std::size_t count = view.size();
    const auto n = static_cast<double>(count);
    const double gap = gap_ * view.mean_radius();

    parent_.resize(count);
    for (std::size_t i = 0; i < count; ++i) parent_[i] = static_cast<std::uint32_t>(i);
    degree_.assign(count, 0);
    size_.assign(count, 0);
    const std::vector<Pair>& pairs = touching_.find(view, gap);
    double groups = n;
    for (const Pair& pair : pairs) {
        ++degree_[pair.i];
        ++degree_[pair.j];
        const std::uint32_t a = root_of(pair.i), b = root_of(pair.j);
        if (a == b) continue;
        parent_[std::max(a, b)] = std::min(a, b);
        groups -= 1.0;
    }
    double at_wall = 0.0, isolated = 0.0, rattlers = 0.0, largest = 0.0;
    contacts_.add_weight(n);
    for (std::size_t i = 0; i < count; ++i) {
        const Vec2 p = view.position(i);
        const bool wall = view.container_radius - view.radius[i] - square_root(dot(p, p)) < gap;
        const std::uint32_t contacts = degree_[i] + (wall ? 1 : 0);
        at_wall += wall ? 1.0 : 0.0;
        isolated += contacts == 0 ? 1.0 : 0.0;
        rattlers += contacts < 2 ? 1.0 : 0.0;
        contacts_.add(std::min<std::size_t>(degree_[i], max_contacts));
        largest = std::max(largest, double(++size_[root_of(static_cast<std::uint32_t>(i))]));
    }
    const auto links = static_cast<double>(pairs.size());
    coordination_.add(2.0 * links / n);
    wall_.add(at_wall / n);
    isolated_.add(isolated / n);
    rattlers_.add(rattlers / n);
    groups_.add(groups / n);
    largest_.add(largest / n);
    loops_.add((links - n + groups) / n);
}

}  // namespace swirl
