#include "swirl/measure/pinned_loose.hpp"

#include <cmath>

#include "swirl/math/wide.hpp"

namespace swirl {
namespace {

// The running sums collect a rounding error with every frame, so they are summed again this often.
constexpr std::int64_t frames_between_sums = 1024;

/// Moves the window of the fit by one frame: Σ k r loses Σ r and the old end and gains the new
/// end.
SWIRL_WIDE void move_window(std::size_t n, double h, const double* __restrict now,
                            double* __restrict oldest, double* __restrict sum,
                            double* __restrict slope) {
    for (std::size_t i = 0; i < n; ++i) {
        slope[i] += (h + 1.0) * oldest[i] + h * now[i] - sum[i];
        sum[i] += now[i] - oldest[i];
        oldest[i] = now[i];
    }
}

/// Applies the criteria to every disc: (x, y) is its position, b the one in the frame before, a the
/// one in the frame after, s the path direction. A change takes more than `half_width` frames.
SWIRL_WIDE void classify(std::size_t n, double half_width, double sine_square, double jump_square,
                         const double* __restrict x, const double* __restrict y,
                         const double* __restrict bx, const double* __restrict by,
                         const double* __restrict ax, const double* __restrict ay,
                         const double* __restrict sx, const double* __restrict sy,
                         double* __restrict parallel_for, double* __restrict pinned,
                         double* __restrict loose_for, double* __restrict left_x,
                         double* __restrict left_y, double* __restrict freed,
                         double* __restrict turned_sharply) {
    for (std::size_t i = 0; i < n; ++i) {
        const double radial = sx[i] * x[i] + sy[i] * y[i];
        const double rotation = x[i] * sy[i] - y[i] * sx[i];
        const double bound =
            sine_square * (sx[i] * sx[i] + sy[i] * sy[i]) * (x[i] * x[i] + y[i] * y[i]);
        const double along = radial * radial <= bound ? 1.0 : 0.0;
        const double parallel = rotation < 0.0 ? along : 0.0;
        const double frames = parallel * (parallel_for[i] + 1.0);
        const double long_enough = frames > half_width ? 1.0 : 0.0;
        const double still_pinned = pinned[i] * parallel;
        const double now = long_enough > still_pinned ? long_enough : still_pinned;
        const double dx = ax[i] - 2.0 * x[i] + bx[i], dy = ay[i] - 2.0 * y[i] + by[i];
        const double sharp = dx * dx + dy * dy >= jump_square ? 1.0 : 0.0;
        // Counts from 1 at the frame where the disc leaves. If it is parallel again in time, it had
        // not left.
        const double leaving = pinned[i] * (1.0 - parallel);
        const double since = leaving > 0.0 ? 1.0 : loose_for[i] > 0.0 ? loose_for[i] + 1.0 : 0.0;
        const double loose = parallel > 0.0 ? 0.0 : since;
        freed[i] = loose > half_width ? 1.0 : 0.0;
        loose_for[i] = freed[i] > 0.0 ? 0.0 : loose;
        left_x[i] = leaving > 0.0 ? x[i] : left_x[i];
        left_y[i] = leaving > 0.0 ? y[i] : left_y[i];
        turned_sharply[i] = sharp * (1.0 - now);
        parallel_for[i] = frames;
        pinned[i] = now;
    }
}

}  // namespace

PinnedLoose::PinnedLoose(const FrameWindow& window, const PinningCriteria& criteria)
    : window_(window),
      sine_square_(std::sin(criteria.deviation) * std::sin(criteria.deviation)),
      sharp_turn_(criteria.sharp_turn) {}

void PinnedLoose::restart(std::size_t n) {
    frames_ = 0;
    for (auto* column : {&past_x_, &past_y_})
        column->assign(n * static_cast<std::size_t>(window_.width()), 0.0);
    for (auto* column : {&sum_x_, &sum_y_, &slope_x_, &slope_y_}) column->assign(n, 0.0);
    for (auto* column :
         {&parallel_for_, &is_pinned_, &freed_, &turned_sharply_, &loose_for_, &left_x_, &left_y_})
        column->assign(n, 0.0);
    pinned_.assign(n, 0);
}

void PinnedLoose::begin_tracks() {
    if (frames_ > 0) breaks_ += 1.0;
    frames_ = 0;
    pinned_.clear();  // the next frame restarts all columns
}

double* PinnedLoose::slot(std::vector<double>& past, std::int64_t frame) {
    return past.data() + static_cast<std::size_t>(frame % window_.width()) * pinned_.size();
}

void PinnedLoose::sum_window() {
    for (auto* column : {&sum_x_, &sum_y_, &slope_x_, &slope_y_})
        column->assign(pinned_.size(), 0.0);
    for (int k = -window_.half_width; k <= window_.half_width; ++k) {
        const std::int64_t frame = frames_ - 1 - window_.half_width + k;
        const double *const x = slot(past_x_, frame), *const y = slot(past_y_, frame);
        for (std::size_t i = 0; i < pinned_.size(); ++i) {
            sum_x_[i] += x[i];
            sum_y_[i] += y[i];
            slope_x_[i] += k * x[i];
            slope_y_[i] += k * y[i];
        }
    }
}

void PinnedLoose::sample(const MFrameView& view) {
    const std::size_t n = view.size();
    if (n == 0) return restart(0);
    const double step = view.time - last_time_;
    if (n != pinned_.size()) {
        restart(n);
    } else {
        const bool even = frames_ == 1 || std::abs(step - step_) <= 0.01 * step_;
        if (!(step > 0.0) || !even) {
            breaks_ += 1.0;
            restart(n);
        } else if (frames_ == 1) {
            step_ = step;
        }
    }
    last_time_ = view.time;

    double *const oldest_x = slot(past_x_, frames_), *const oldest_y = slot(past_y_, frames_);
    if (is_known() && frames_ % frames_between_sums != 0) {
        const double h = window_.half_width;
        move_window(n, h, view.x.data(), oldest_x, sum_x_.data(), slope_x_.data());
        move_window(n, h, view.y.data(), oldest_y, sum_y_.data(), slope_y_.data());
        ++frames_;
    } else {
        for (std::size_t i = 0; i < n; ++i) {
            oldest_x[i] = view.x[i];
            oldest_y[i] = view.y[i];
        }
        ++frames_;
        if (is_known()) sum_window();
    }
    if (is_known()) apply_criteria(view);
}

void PinnedLoose::apply_criteria(const MFrameView& view) {
    const std::size_t n = pinned_.size();
    const std::int64_t centre = frames_ - 1 - window_.half_width;
    const double *const x = slot(past_x_, centre), *const y = slot(past_y_, centre);
    const double *const bx = slot(past_x_, centre - window_.turn), *const by =
                                                                       slot(past_y_,
                                                                            centre - window_.turn);
    const double *const ax = slot(past_x_, centre + window_.turn), *const ay =
                                                                       slot(past_y_,
                                                                            centre + window_.turn);
    const double jump =
        sharp_turn_ * view.frame.omega * view.container_radius * step_ * window_.turn;
    classify(n, window_.half_width, sine_square_, jump * jump, x, y, bx, by, ax, ay,
             slope_x_.data(), slope_y_.data(), parallel_for_.data(), is_pinned_.data(),
             loose_for_.data(), left_x_.data(), left_y_.data(), freed_.data(),
             turned_sharply_.data());
    double pinned_now = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
        pinned_[i] = is_pinned_[i] != 0.0 ? 1 : 0;
        pinned_now += is_pinned_[i];
        if (freed_[i] != 0.0 && window_.knows_pinned) {
            const Vec2 position{left_x_[i], left_y_[i]};
            depinning_.add(position);
            free_positions_.add(position);
        }
        if (turned_sharply_[i] != 0.0) {
            const Vec2 position{x[i], y[i]};
            pinning_.add(position);
            pinned_positions_.add(position);
        }
    }
    if (window_.knows_pinned) share_.add(pinned_now / static_cast<double>(n));
}

void PinnedLoose::merge(const PinnedLoose& other) {
    BlockAverages::merge(other);
    pinned_positions_.merge(other.pinned_positions_);
    free_positions_.merge(other.free_positions_);
    breaks_ += other.breaks_;
}

void PinnedByCollisions::sample_event(const Event& event, const Snapshot& after) {
    if (event.kind != EventKind::disc_disc && event.kind != EventKind::disc_wall) return;
    if (last_.size() != after.size()) {
        last_.assign(after.size(), {});
        longest_.assign(after.size(), {});
    }
    const MFrame frame = m_frame(after);
    const double time = after.time();
    collide(event.i, time, frame.position(after.position(event.i)));
    if (event.kind == EventKind::disc_disc)
        collide(event.j, time, frame.position(after.position(event.j)));
}

void PinnedByCollisions::collide(std::size_t disc, double time, const Vec2& position) {
    Collision& last = last_[disc];
    if (time - last.time > longest_[disc].duration)
        longest_[disc] = {time - last.time, last.position, position};
    last = {time, position};
}

void PinnedByCollisions::close_block() {
    for (Flight& flight : longest_) {
        if (flight.duration > 0.0) {
            depinning_.add(flight.begin);
            pinning_.add(flight.end);
        }
        flight = {};
    }
    pinning_.close_block();
    depinning_.close_block();
}

}  // namespace swirl
