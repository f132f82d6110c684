// The rival that `swirl bench` holds the engine against: the paper's method, all times and the
// soonest for every event (simulation/reference.hpp), with the widest vectors the processor has.
#pragma once

#include <cstddef>
#include <vector>

#include "swirl/math/cpu_width.hpp"
#include "swirl/simulation/reference.hpp"
#include "swirl/study/rival/plain_search.hpp"

namespace swirl {

/// Of the width asked for, which the processor must have.
PlainSearch plain_search(Width width);

class PlainLoop {
  public:
    explicit PlainLoop(const InitialState& initial, Width width = Width::best)
        : discs_(initial),
          radius_of_container_(initial.container_radius),
          search_(plain_search(width)) {
        for (auto* column : {&x_, &y_, &vx_, &vy_, &time_, &radius_, &wall_times_, &times_})
            column->resize(initial.discs.size());
        copy_all();
    }

    Event step() {
        const FlightColumns columns{x_.data(),    y_.data(),      vx_.data(), vy_.data(),
                                    time_.data(), radius_.data(), x_.size()};
        const PendingEvent first =
            search_(columns, discs_.leg(), radius_of_container_, wall_times_.data(), times_.data());
        const Event event = discs_.apply(first);
        if (event.kind != EventKind::path_vertex) {
            copy(event.i);
            copy(event.j);
        } else if (discs_.leg().begin == 0.0) {
            copy_all();
        }
        return event;
    }

    const Disc& disc(std::size_t i) const { return discs_.disc(i); }

  private:
    void copy(std::size_t k) {
        const Disc& d = disc(k);
        x_[k] = d.position.x, y_[k] = d.position.y;
        vx_[k] = d.velocity.x, vy_[k] = d.velocity.y;
        time_[k] = d.time, radius_[k] = d.radius;
    }
    void copy_all() {
        for (std::size_t k = 0; k < x_.size(); ++k) copy(k);
    }

    Reference discs_;
    double radius_of_container_;
    PlainSearch search_;
    std::vector<double> x_, y_, vx_, vy_, time_, radius_, wall_times_, times_;
};

}  // namespace swirl
