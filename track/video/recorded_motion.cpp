#include "track/video/recorded_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <optional>

#include "swirl/math/unit_circle.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/statistics/block_average.hpp"
#include "track/video/circles.hpp"
#include "track/video/container_path_fit.hpp"
#include "track/video/robust_statistics.hpp"

namespace swirl::tracking {

double RecordedMotion::period() const { return 2.0 * pi / omega; }
double RecordedMotion::period_error() const { return period() * omega_error / omega; }

Vec2 RecordedMotion::offset(double share) const {
    Vec2 sum{0.0, 0.0};
    for (std::size_t n = 0; n < cosine.size(); ++n) {
        const double angle = 2.0 * pi * double(n + 1) * share;
        sum = sum + std::cos(angle) * cosine[n] + std::sin(angle) * sine[n];
    }
    return sum;
}

Vec2 RecordedMotion::at(double time) const { return centre + offset((time - start) / period()); }

double RecordedMotion::amplitude() const {
    constexpr int points = 360;
    double largest = 0.0;
    for (int k = 0; k < points; ++k)
        largest = std::max(largest, length(offset(double(k) / points)));
    return largest;
}

namespace {

/// The centres and their weights; fits of harmonics to a part of them.
class MotionFit {
  public:
    MotionFit(const std::vector<Vec2>& centres, const std::vector<double>& times)
        : centres_(centres), times_(times), residuals_(centres.size()) {
        constexpr double far = 4.0;  // median distances: a wrong circle
        std::vector<double> distances;
        middle_ = median_point(centres);
        for (const Vec2& c : centres) distances.push_back(length(c - middle_));
        const double limit = far * median(distances);
        double sum = 0.0, square = 0.0;
        for (std::size_t k = 0; k < centres.size(); ++k) {
            weights_.push_back(distances[k] <= limit ? 1.0 : 0.0);
            sum += weights_[k];
            square += weights_[k] * distances[k] * distances[k];
        }
        extent_ = std::sqrt(square / std::max(sum, 1.0));
    }

    /// Rms distance of the centres from their middle.
    double extent() const { return extent_; }
    const std::vector<double>& weights() const { return weights_; }
    const std::vector<Vec2>& residuals() const { return residuals_; }

    /// Fits the frames from `begin` to before `end`; returns the weighted rms of the residuals.
    double fit(double omega, int harmonics, std::size_t begin, std::size_t end) {
        const int unknowns = 2 * harmonics + 1;
        cv::Mat normal = cv::Mat::zeros(unknowns, unknowns, CV_64F),
                right = cv::Mat::zeros(unknowns, 2, CV_64F);
        std::vector<double> row(static_cast<std::size_t>(unknowns));
        for (std::size_t k = begin; k < end; ++k) {
            if (weights_[k] == 0.0) continue;
            set_row(omega * (times_[k] - times_.front()), row);
            const Vec2 c = centres_[k] - middle_;
            for (int a = 0; a < unknowns; ++a) {
                const double wa = weights_[k] * row[std::size_t(a)];
                for (int b = 0; b <= a; ++b) normal.at<double>(a, b) += wa * row[std::size_t(b)];
                right.at<double>(a, 0) += wa * c.x;
                right.at<double>(a, 1) += wa * c.y;
            }
        }
        cv::completeSymm(normal, true);
        cv::solve(normal, right, solution_, cv::DECOMP_EIG);
        double sum = 0.0, square = 0.0;
        for (std::size_t k = begin; k < end; ++k) {
            set_row(omega * (times_[k] - times_.front()), row);
            Vec2 model = middle_;
            for (int a = 0; a < unknowns; ++a)
                model = model + row[std::size_t(a)] *
                                    Vec2{solution_.at<double>(a, 0), solution_.at<double>(a, 1)};
            residuals_[k] = centres_[k] - model;
            sum += weights_[k];
            square += weights_[k] * dot(residuals_[k], residuals_[k]);
        }
        return std::sqrt(square / std::max(sum, 1.0));
    }

    /// The best ω between two, by the golden section.
    double refine(double low, double high, int harmonics, std::size_t end) {
        constexpr double golden = 0.6180339887498949;
        constexpr int steps = 30;  // the interval shrinks to 5e-7 of its length
        double a = high - golden * (high - low), b = low + golden * (high - low);
        double at_a = fit(a, harmonics, 0, end), at_b = fit(b, harmonics, 0, end);
        for (int k = 0; k < steps; ++k) {
            if (at_a < at_b) {
                high = b, b = a, at_b = at_a;
                a = high - golden * (high - low);
                at_a = fit(a, harmonics, 0, end);
            } else {
                low = a, a = b, at_a = at_b;
                b = low + golden * (high - low);
                at_b = fit(b, harmonics, 0, end);
            }
        }
        return 0.5 * (low + high);
    }

    /// Weights by the residuals of a fit to all frames; returns their standard deviation.
    double reweight() {
        constexpr double cutoff = 4.7, min_scale = 0.05;  // standard deviations; pixels
        std::vector<double> off;
        for (const Vec2& r : residuals_) off.push_back(length(r));
        const double deviation = median(off) / length_median;
        for (std::size_t k = 0; k < off.size(); ++k)
            weights_[k] = tukey_weight(off[k] / (cutoff * std::max(deviation, min_scale)));
        return deviation;
    }

    void set_result(int harmonics, RecordedMotion& motion) const {
        motion.cosine.clear(), motion.sine.clear();
        const auto pair = [&](int a) {
            return Vec2{solution_.at<double>(a, 0), solution_.at<double>(a, 1)};
        };
        motion.centre = middle_ + pair(0);
        for (int n = 1; n <= harmonics; ++n) {
            motion.cosine.push_back(pair(2 * n - 1));
            motion.sine.push_back(pair(2 * n));
        }
    }

  private:
    static void set_row(double angle, std::vector<double>& row) {
        row[0] = 1.0;
        const double c = std::cos(angle), s = std::sin(angle);
        double x = 1.0, y = 0.0;
        for (std::size_t a = 1; a + 1 < row.size(); a += 2) {
            const double next = x * c - y * s;
            y = x * s + y * c;
            x = next;
            row[a] = x, row[a + 1] = y;
        }
    }

    const std::vector<Vec2>& centres_;
    const std::vector<double>& times_;
    Vec2 middle_{0.0, 0.0};
    double extent_ = 0.0;
    std::vector<double> weights_;
    std::vector<Vec2> residuals_;
    cv::Mat solution_;
};

/// The highest frequency at which the motion repeats. A multiple of the period fits as well, with
/// higher harmonics, so the smallest residual does not decide.
std::optional<double> repetition_rate(MotionFit& fit, const std::vector<double>& times) {
    constexpr int harmonics = 4;
    constexpr std::size_t scanned = 1500;      // frames: the scan takes their square
    constexpr double min_periods = 0.5;        // periods in the frames: fewer than two are reported
    constexpr double frames_per_period = 6.0;  // number at least
    constexpr double steps_per_peak = 8.0;     // a peak is 1/span wide
    constexpr double promising = 0.5;          // residual at a minimum of the scan, of the extent
    constexpr double repeats = 0.25;           // the same after refinement
    constexpr double as_good = 1.3, add = 0.02;  // factor of the best residual; of the extent
    const std::size_t end = std::min(times.size(), scanned);
    const double span = times[end - 1] - times.front();
    const double low = 2.0 * pi * min_periods / span,
                 high = 2.0 * pi * double(end) / (frames_per_period * span),
                 step = 2.0 * pi / (steps_per_peak * span);
    std::vector<double> rates, residuals;
    for (double omega = low; omega < high; omega += step) {
        rates.push_back(omega);
        residuals.push_back(fit.fit(omega, harmonics, 0, end));
    }
    struct Minimum {
        double omega, residual;
    };
    std::vector<Minimum> minima;
    for (std::size_t k = 0; k < rates.size(); ++k) {
        if ((k > 0 && residuals[k - 1] < residuals[k]) ||
            (k + 1 < rates.size() && residuals[k + 1] < residuals[k]) ||
            residuals[k] > promising * fit.extent())
            continue;
        const double omega = fit.refine(rates[k] - step, rates[k] + step, harmonics, end);
        minima.push_back({omega, fit.fit(omega, harmonics, 0, end)});
    }
    if (minima.empty()) return {};
    const auto best = std::min_element(
        minima.begin(), minima.end(),
        [](const Minimum& a, const Minimum& b) { return a.residual < b.residual; });
    if (best->residual > repeats * fit.extent()) return {};
    const double enough = std::max(as_good * best->residual, best->residual + add * fit.extent());
    for (auto m = minima.rbegin(); m != minima.rend(); ++m)
        if (m->residual <= enough) return m->omega;
    return best->omega;
}

/// Rms of a coordinate of the periods' own paths about the mean path. Also returns their number.
double scatter_of_periods(MotionFit& fit, const std::vector<double>& times, int harmonics,
                          const RecordedMotion& motion, std::size_t& counted_periods) {
    constexpr std::size_t per_unknown = 2;  // frames
    constexpr int points = 64;
    double square = 0.0;
    counted_periods = 0;
    for (std::size_t begin = 0; begin < times.size();) {
        const double until = motion.start + motion.period() * double(counted_periods + 1);
        std::size_t end = begin;
        while (end < times.size() && times[end] < until) ++end;
        const bool whole = end < times.size() || motion.periods >= double(counted_periods + 1);
        if (!whole || end - begin < per_unknown * std::size_t(2 * harmonics + 1)) break;
        fit.fit(motion.omega, harmonics, begin, end);
        RecordedMotion one = motion;
        fit.set_result(harmonics, one);
        for (int k = 0; k < points; ++k) {
            const double share = double(k) / points;
            const Vec2 off = one.centre + one.offset(share) - motion.centre - motion.offset(share);
            square += 0.5 * dot(off, off) / points;
        }
        ++counted_periods;
        begin = end;
    }
    return counted_periods < 2 ? 0.0 : std::sqrt(square / double(counted_periods - 1));
}

void require_every_phase(const std::vector<double>& times, const std::vector<double>& weights,
                         const RecordedMotion& motion) {
    constexpr double max_gap = 0.125;  // share of the period
    std::vector<double> phases;
    for (std::size_t k = 0; k < times.size(); ++k) {
        const double periods = (times[k] - motion.start) / motion.period();
        if (weights[k] > 0.0) phases.push_back(periods - std::floor(periods));
    }
    std::sort(phases.begin(), phases.end());
    for (std::size_t k = 0; k < phases.size(); ++k) {
        const double next = k + 1 < phases.size() ? phases[k + 1] : phases.front() + 1.0;
        if (next - phases[k] > max_gap)
            throw Failure(fmt::format(
                "no frame shows the container between {:.0f} % and {:.0f} % of its period, so the "
                "path has a gap there\nhint: use a longer video, or more frames per period",
                100.0 * phases[k], 100.0 * next));
    }
}

/// The error of Ω: the residuals against the motion along the path. Residuals of successive frames
/// may be correlated, for example where the rim is found with the same error in all of them. The
/// integrated autocorrelation time τ of the residuals along the path makes the error √τ times as
/// large.
double rate_error(const RecordedMotion& motion, const std::vector<double>& times,
                  const MotionFit& fit) {
    double sum = 0.0, first = 0.0, second = 0.0;
    std::vector<double> along;
    for (std::size_t k = 0; k < times.size(); ++k) {
        if (fit.weights()[k] == 0.0) continue;
        const double t = times[k] - motion.start, share = t / motion.period();
        Vec2 slope{0.0, 0.0};  // dC/d(Ωt)
        for (std::size_t n = 0; n < motion.cosine.size(); ++n) {
            const double order = double(n + 1), angle = 2.0 * pi * order * share;
            slope = slope + order * std::cos(angle) * motion.sine[n] -
                    order * std::sin(angle) * motion.cosine[n];
        }
        const double w = dot(slope, slope);
        sum += w, first += w * t, second += w * t * t;
        along.push_back(dot(slope, fit.residuals()[k]));
    }
    const double tau = estimate_of_series(along).autocorrelation_time;
    return motion.residual * std::sqrt(tau / (second - first * first / sum));
}

/// The highest harmonic above its error, from a fit of all of them.
int significant_harmonics(const RecordedMotion& motion, std::size_t frames) {
    constexpr double stands_out = 5.0;  // standard errors; four numbers have two of them by chance
    const double error = motion.residual * std::sqrt(2.0 / double(frames));
    int highest = 1;
    for (std::size_t n = 0; n < motion.cosine.size(); ++n) {
        const double square =
            dot(motion.cosine[n], motion.cosine[n]) + dot(motion.sine[n], motion.sine[n]);
        if (std::sqrt(square) > stands_out * error) highest = int(n) + 1;
    }
    return highest;
}

}  // namespace

RecordedMotion average_motion(const std::vector<Vec2>& centres, const std::vector<double>& times,
                              std::size_t frames) {
    constexpr std::size_t min_frames = 24;
    constexpr double min_share = 0.5;     // share of the frames
    constexpr double min_periods = 1.95;  // two, with the rounding of a frame
    constexpr int max_harmonics = 12, passes = 8, frames_per_harmonic = 4;
    if (centres.size() < min_frames || double(centres.size()) < min_share * double(frames))
        throw Failure(fmt::format(
            "the container's rim was found in {} of {} frames, but the average of its motion needs "
            "at least half of the frames and at least {}\nhint: keep the whole rim in the frame",
            centres.size(), frames, min_frames));
    MotionFit fit(centres, times);
    if (!(fit.extent() > min_path_amplitude))
        throw Failure(fmt::format(
            "the container stands still: its centre moves by {:.1f} pixels (rms), so there is no "
            "motion to record\nhint: fix the camera to the floor, not to the container",
            fit.extent()));
    const std::optional<double> rate = repetition_rate(fit, times);
    const double step = (times.back() - times.front()) / double(times.size() - 1);
    RecordedMotion motion;
    motion.start = times.front();
    if (rate) {
        motion.omega = *rate;
        motion.periods = (times.back() - times.front() + step) / motion.period();
    }
    if (!rate || motion.periods < min_periods)
        throw Failure(
            rate
                ? fmt::format("the video shows {:.2f} periods of the container's motion, but an "
                              "average needs at least two\nhint: record a longer video",
                              motion.periods)
                : std::string("the container's motion does not repeat: no period was found\nhint: "
                              "record at least two periods of a periodic motion, with at least six "
                              "frames per period, and fix the camera"));
    const auto per_period = int(motion.period() / step);
    const int limit = std::clamp(per_period / frames_per_harmonic, 1, max_harmonics);
    const double width = 0.25 * pi / (times.back() - times.front());  // a quarter of the peak
    const auto refit = [&](int harmonics) {
        for (int pass = 0; pass < passes; ++pass) {
            motion.omega =
                fit.refine(motion.omega - width, motion.omega + width, harmonics, times.size());
            fit.fit(motion.omega, harmonics, 0, times.size());
            fit.set_result(harmonics, motion);
            motion.residual = fit.reweight();
        }
    };
    refit(limit);
    const int harmonics = significant_harmonics(motion, centres.size());
    refit(harmonics);
    motion.used = double(std::count_if(fit.weights().begin(), fit.weights().end(),
                                       [](double w) { return w > 0.0; })) /
                  double(centres.size());
    require_every_phase(times, fit.weights(), motion);
    const double noise = motion.residual * std::sqrt(double(2 * harmonics + 1) /
                                                     (motion.used * double(centres.size())));
    motion.omega_error = rate_error(motion, times, fit);  // error of the residuals of all frames
    std::size_t whole = 0;
    motion.scatter = scatter_of_periods(fit, times, harmonics, motion, whole);
    motion.point_error =
        std::max(noise, whole < 2 ? 0.0 : motion.scatter / std::sqrt(double(whole)));
    return motion;
}

}  // namespace swirl::tracking
