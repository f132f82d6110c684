#include "baselines/all_pairs.hpp"

namespace swirl {

AllPairsSearch all_pairs_search(Width width) {
    width = width_meant(width);
#if defined(SWIRL_HAS_AVX512)
    if (width == Width::avx512) return all_pairs_search_avx512;
#endif
#if defined(SWIRL_HAS_AVX2)
    if (width == Width::avx2) return all_pairs_search_avx2;
#endif
    return all_pairs_search_baseline;
}

AllPairsBaseline::AllPairsBaseline(const InitialState& initial, Width width)
    : discs_(initial),
      radius_of_container_(initial.container_radius),
      search_(all_pairs_search(width)),
      size_(initial.discs.size()) {
    const std::size_t capacity = (size_ + 7) / 8 * 8;
    for (auto* column : {&y_, &vx_, &vy_, &time_, &radius_, &wall_times_, &times_})
        column->resize(capacity);
    x_.resize(capacity, 1e100);
    copy_all();
}

Event AllPairsBaseline::step() {
    const FlightColumns columns{x_.data(),    y_.data(),      vx_.data(), vy_.data(),
                                time_.data(), radius_.data(), size_};
    const Event event = discs_.apply(search_(columns, discs_.segment(), radius_of_container_,
                                             wall_times_.data(), times_.data()));
    if (event.kind != EventKind::path_vertex) {
        copy(event.i);
        copy(event.j);
    } else if (discs_.segment().begin == 0.0) {
        copy_all();
    }
    return event;
}

void AllPairsBaseline::copy(std::size_t k) {
    const Disc& d = disc(k);
    x_[k] = d.position.x, y_[k] = d.position.y;
    vx_[k] = d.velocity.x, vy_[k] = d.velocity.y;
    time_[k] = d.time, radius_[k] = d.radius;
}
void AllPairsBaseline::copy_all() {
    for (std::size_t k = 0; k < size_; ++k) copy(k);
}

Event SphereBaseline::step() { return spheres_.step(); }

}  // namespace swirl
