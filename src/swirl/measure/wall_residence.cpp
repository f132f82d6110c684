#include "swirl/measure/wall_residence.hpp"

#include <cmath>

namespace swirl {

void WallResidences::sample(const MFrameView& view) {
    const std::size_t n = view.size();
    const double step = view.time - last_time_;
    const bool restarts = n != discs_ || !(step > 0.0);
    if (restarts) {
        discs_ = n;
        residences_.assign(n * layers.size(), {});
    }
    last_time_ = view.time;
    if (n == 0) return;
    const double period = view.frame.period(), count = static_cast<double>(n);
    for (std::size_t l = 0; l < layers.size(); ++l) {
        std::array<double, minimum.size()> pinned{};  // samples
        for (std::size_t i = 0; i < n; ++i) {
            const Vec2 p = view.position(i);
            Residence& residence = residences_[l * n + i];
            if (!in_wall_layer(view, i, layers[l])) {
                if (residence.samples > 0.0) end(l, residence, period);
                residence = {};
                continue;
            }
            if (residence.samples == 0.0) residence = {0.0, view.time, restarts ? 0.0 : 1.0, p, p};
            residence.samples += 1.0;
            residence.last = p;
            const double lasted = view.time - residence.begin_time;
            for (std::size_t d = 0; d < minimum.size(); ++d) {
                const double required = least_length(minimum[d], step, period);
                if (restarts || lasted < required) continue;
                // When a residence becomes long enough, its earlier samples are counted as well.
                pinned[d] += lasted - step < required ? residence.samples : 1.0;
            }
        }
        for (std::size_t d = 0; d < minimum.size(); ++d)
            averages_[l][d].share.add(pinned[d] / count);
    }
}

void WallResidences::end(std::size_t layer, const Residence& residence, double period) {
    // The present sample is one step after its last.
    const double step = (last_time_ - residence.begin_time) / residence.samples;
    const double seen = (residence.samples - 1.0) * step;
    const double length = larger(seen + missing_length(step, period), 0.0);
    if (layer == standard && residence.knows_begin != 0.0) {
        const double bin = std::floor(length / (length_bin * period));
        lengths_.add(static_cast<std::size_t>(smaller(bin, length_bins - 1.0)));
        lengths_.add_weight();
    }
    for (std::size_t d = 0; d < minimum.size(); ++d) {
        if (seen < least_length(minimum[d], step, period)) continue;
        Averages& a = averages_[layer][d];
        if (residence.knows_begin != 0.0) a.begin.add(residence.begin);
        a.end.add(residence.last);
        if (layer != standard || d != standard) continue;
        length_.add(length / period);
        if (residence.knows_begin != 0.0) begins_.add(residence.begin);
        ends_.add(residence.last);
    }
}

void WallResidences::close_block() {
    for (auto& layer : averages_)
        for (Averages& a : layer) a.close_block();
    length_.close_block();
    lengths_.close_block();
}

void WallResidences::merge(const WallResidences& other) {
    for (std::size_t l = 0; l < layers.size(); ++l)
        for (std::size_t d = 0; d < minimum.size(); ++d)
            averages_[l][d].merge(other.averages_[l][d]);
    length_.merge(other.length_);
    lengths_.merge(other.lengths_);
    begins_.merge(other.begins_);
    ends_.merge(other.ends_);
}

}  // namespace swirl
