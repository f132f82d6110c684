#include "swirl/measure/wall_residence.hpp"

#include <cmath>

namespace swirl {

void WallResidences::sample(const MFrameView& view) {
    const std::size_t n = view.size();
    const double step = view.time - last_time_;
    const bool begins = n != discs_ || !(step > 0.0);
    if (begins) {
        discs_ = n;
        residences_.assign(n * layers.size(), {});
    }
    last_time_ = view.time;
    if (n == 0) return;
    const double period = 2.0 * pi / view.frame.omega, count = static_cast<double>(n);
    for (std::size_t l = 0; l < layers.size(); ++l) {
        std::array<double, minimum.size()> held{};
        for (std::size_t i = 0; i < n; ++i) {
            const Vec2 p = view.position(i);
            Residence& residence = residences_[l * n + i];
            if (!in_wall_layer(view, i, layers[l])) {
                if (residence.samples > 0.0) end(l, residence, period);
                residence = {};
                continue;
            }
            if (residence.samples == 0.0) residence = {0.0, view.time, begins ? 0.0 : 1.0, p, p};
            residence.samples += 1.0;
            residence.last = p;
            const double lasted = view.time - residence.begin_time;
            for (std::size_t d = 0; d < minimum.size(); ++d) {
                // Half a step, since times are rounded.
                const double wanted = minimum[d] * period - 0.5 * step;
                if (begins || lasted < wanted) continue;
                // With the sample that makes it long enough, all those before it count too.
                held[d] += lasted - step < wanted ? residence.samples : 1.0;
            }
        }
        for (std::size_t d = 0; d < minimum.size(); ++d) kinds_[l][d].share.add(held[d] / count);
    }
}

void WallResidences::end(std::size_t layer, const Residence& residence, double period) {
    // From its first sample to its last; now is one step later.
    const double step = (last_time_ - residence.begin_time) / residence.samples;
    const double length = (residence.samples - 1.0) * step;
    for (std::size_t d = 0; d < minimum.size(); ++d) {
        if (length < minimum[d] * period - 0.5 * step) continue;
        Kind& kind = kinds_[layer][d];
        if (residence.knows_begin != 0.0) kind.begin.add(residence.begin);
        kind.end.add(residence.last);
        if (layer != standard || d != standard) continue;
        length_.add(length / period);
        if (residence.knows_begin != 0.0) begins_.add(residence.begin);
        ends_.add(residence.last);
    }
}

void WallResidences::close_block() {
    for (auto& layer : kinds_)
        for (Kind& kind : layer) {
            kind.begin.close_block();
            kind.end.close_block();
            kind.share.close_block();
        }
    length_.close_block();
}

void WallResidences::merge(const WallResidences& other) {
    for (std::size_t l = 0; l < layers.size(); ++l)
        for (std::size_t d = 0; d < minimum.size(); ++d) {
            kinds_[l][d].begin.merge(other.kinds_[l][d].begin);
            kinds_[l][d].end.merge(other.kinds_[l][d].end);
            kinds_[l][d].share.merge(other.kinds_[l][d].share);
        }
    length_.merge(other.length_);
    begins_.merge(other.begins_);
    ends_.merge(other.ends_);
}

}  // namespace swirl
