#include "measure/pinned_loose.hpp"

#include <cmath>

namespace swirl {
namespace {

// The running sums lose a last bit with every frame; now and then they are added up afresh.
constexpr std::int64_t frames_between_sums = 1024;

}  // namespace

PinnedLoose::PinnedLoose(const PinningCriteria& criteria)
    : sine_square_(std::sin(criteria.deviation) * std::sin(criteria.deviation)),
      sharp_turn_(criteria.sharp_turn) {}

void PinnedLoose::begin_tracks(std::size_t n) {
    frames_ = 0;
    past_x_.assign(n * width, 0.0);
    past_y_.assign(n * width, 0.0);
    for (auto* column : {&sum_x_, &sum_y_, &slope_x_, &slope_y_}) column->assign(n, 0.0);
    parallel_for_.assign(n, 0);
    pinned_.assign(n, 0);
}

double* PinnedLoose::slot(std::vector<double>& past, std::int64_t frame) {
    return past.data() + static_cast<std::size_t>(frame % width) * pinned_.size();
}

void PinnedLoose::sum_window() {
    for (auto* column : {&sum_x_, &sum_y_, &slope_x_, &slope_y_})
        column->assign(pinned_.size(), 0.0);
    for (int k = -half_width; k <= half_width; ++k) {
        const std::int64_t frame = frames_ - 1 - half_width + k;
        const double *const x = slot(past_x_, frame), *const y = slot(past_y_, frame);
        for (std::size_t i = 0; i < pinned_.size(); ++i) {
            sum_x_[i] += x[i];
            sum_y_[i] += y[i];
            slope_x_[i] += k * x[i];
            slope_y_[i] += k * y[i];
        }
    }
}

void PinnedLoose::look(const MFrameView& view) {
    const std::size_t n = view.size();
    const double step = view.time - last_time_;
    if (n != pinned_.size()) {
        begin_tracks(n);
    } else if (frames_ > 0) {
        const bool even = frames_ == 1 || std::abs(step - step_) <= 0.01 * step_;
        if (!(step > 0.0) || !even) {
            breaks_ += 1.0;
            begin_tracks(n);
        } else if (frames_ == 1) {
            step_ = step;
        }
    }
    last_time_ = view.time;
    if (n == 0) return;

    double *const oldest_x = slot(past_x_, frames_), *const oldest_y = slot(past_y_, frames_);
    if (frames_ >= width && frames_ % frames_between_sums != 0) {
        // The window moves on by one frame: Σ k r loses Σ r and the old end and gains the new one.
        double *const sx = sum_x_.data(), *const sy = sum_y_.data();
        double *const kx = slope_x_.data(), *const ky = slope_y_.data();
        const double *const x = view.x.data(), *const y = view.y.data();
        for (std::size_t i = 0; i < n; ++i) {
            kx[i] += (half_width + 1) * oldest_x[i] + half_width * x[i] - sx[i];
            ky[i] += (half_width + 1) * oldest_y[i] + half_width * y[i] - sy[i];
            sx[i] += x[i] - oldest_x[i];
            sy[i] += y[i] - oldest_y[i];
            oldest_x[i] = x[i];
            oldest_y[i] = y[i];
        }
        ++frames_;
    } else {
        for (std::size_t i = 0; i < n; ++i) {
            oldest_x[i] = view.x[i];
            oldest_y[i] = view.y[i];
        }
        ++frames_;
        if (frames_ >= width) sum_window();
    }
    if (frames_ >= width) judge(view);
}

void PinnedLoose::judge(const MFrameView& view) {
    const std::size_t n = pinned_.size();
    const std::int64_t centre = frames_ - 1 - half_width;
    const double *const x = slot(past_x_, centre), *const y = slot(past_y_, centre);
    const double *const bx = slot(past_x_, centre - 1), *const by = slot(past_y_, centre - 1);
    const double *const ax = slot(past_x_, centre + 1), *const ay = slot(past_y_, centre + 1);
    const double jump = sharp_turn_ * view.frame.omega * view.container_radius * step_;
    const double jump_square = jump * jump;
    double pinned_now = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
        const Vec2 p{x[i], y[i]}, s{slope_x_[i], slope_y_[i]};
        const double radial = dot(s, p);
        const bool parallel =
            cross(p, s) < 0.0 && radial * radial <= sine_square_ * dot(s, s) * dot(p, p);
        parallel_for_[i] = parallel ? parallel_for_[i] + 1 : 0;
        if (pinned_[i] != 0 && !parallel) becoming_free_.add(p);
        pinned_[i] = parallel_for_[i] > half_width || (pinned_[i] != 0 && parallel) ? 1 : 0;
        pinned_now += pinned_[i];
        if (pinned_[i] != 0) continue;
        const Vec2 bend{ax[i] - 2.0 * x[i] + bx[i], ay[i] - 2.0 * y[i] + by[i]};
        if (dot(bend, bend) >= jump_square) becoming_pinned_.add(p);
    }
    share_.add(pinned_now / static_cast<double>(n));
}

void PinnedLoose::close_block() {
    becoming_pinned_.close_block();
    becoming_free_.close_block();
    share_.close_block();
}

void PinnedLoose::merge(const PinnedLoose& other) {
    becoming_pinned_.merge(other.becoming_pinned_);
    becoming_free_.merge(other.becoming_free_);
    share_.merge(other.share_);
    breaks_ += other.breaks_;
}

void PinnedByCollisions::look(const Event& event, const Snapshot& after) {
    if (event.kind == EventKind::path_vertex) return;
    if (last_.size() != after.size()) last_.assign(after.size(), {});
    const MFrame frame = m_frame(after);
    const double time = after.time();
    collide(event.i, time, after.period, frame.position(after.position(event.i)));
    if (event.kind == EventKind::disc_disc)
        collide(event.j, time, after.period, frame.position(after.position(event.j)));
}

void PinnedByCollisions::collide(std::size_t disc, double time, double period,
                                 const Vec2& position) {
    Collision& last = last_[disc];
    if (time - last.time > flight_ * period) {
        becoming_free_.add(last.position);
        becoming_pinned_.add(position);
    }
    last = {time, position};
}

}  // namespace swirl
