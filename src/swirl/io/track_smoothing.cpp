#include "swirl/io/track_smoothing.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "swirl/io/seen_container.hpp"
#include "swirl/io/track_repair.hpp"
#include "swirl/math/unit_circle.hpp"

namespace swirl {
namespace {

constexpr std::size_t min_samples = 400;  // gives the noise to a few per cent
constexpr int rounds = 8;                 // kicks and smoothing have converged by then
constexpr int undamped_rounds = 2;
constexpr double rarest_kick = 1e-6;  // keeps log odds finite
constexpr double initial_share = 0.1;
// A kick has the size of typical speeds. Many weak collisions count as a push of three times the
// change of velocity along the container's circle.
constexpr double kick_in_speeds = 3.0, push_in_turns = 3.0;

/// The track of one disc between two gaps, relative to the container. The unit of time is one
/// frame.
struct TrackSegment {
    std::vector<std::size_t> frame, disc;                      // indices into the tracks
    std::vector<double> elapsed;                               // time to the next position
    std::vector<Vec2> position, velocity;                      // velocity per frame
    std::vector<double> position_variance, velocity_variance;  // variances per coordinate
    std::vector<double> kick;  // variance of the kick before the next position

    std::size_t size() const { return position.size(); }
};

std::vector<TrackSegment> segments_of(const Tracks& tracks, const TrackScale& scale) {
    const auto step = static_cast<double>(commonest_step(tracks));
    const SeenContainer container(scale, tracks.y_down);
    std::map<std::int64_t, std::size_t> last;  // latest segment of each disc
    std::vector<TrackSegment> segments;
    for (std::size_t k = 0; k < tracks.frames.size(); ++k) {
        const TrackFrame& f = tracks.frames[k];
        const Vec2 centre = container.position(double(f.number) / scale.frames_per_time);
        for (std::size_t i = 0; i < f.id.size(); ++i) {
            const auto [known, fresh] = last.try_emplace(f.id[i], segments.size());
            double elapsed = 0.0;
            if (!fresh)
                elapsed =
                    double(f.number - tracks.frames[segments[known->second].frame.back()].number) /
                    step;
            if (fresh || elapsed > double(longest_gap + 1)) {
                known->second = segments.size();
                segments.emplace_back();
            } else {
                segments[known->second].elapsed.push_back(elapsed);
            }
            TrackSegment& segment = segments[known->second];
            segment.frame.push_back(k);
            segment.disc.push_back(i);
            segment.position.push_back(f.position[i] - centre);
        }
    }
    for (TrackSegment& segment : segments) segment.elapsed.push_back(1.0);
    return segments;
}

/// Noise variance per coordinate: 12σ² ln(4/3) is the lower quartile of |second difference|².
/// Negative if there are too few samples.
double noise_of(const std::vector<TrackSegment>& segments) {
    std::vector<double> squares;
    for (const TrackSegment& p : segments)
        for (std::size_t k = 1; k + 1 < p.size(); ++k) {
            if (p.elapsed[k - 1] != 1.0 || p.elapsed[k] != 1.0) continue;
            const Vec2 d = p.position[k + 1] - 2.0 * p.position[k] + p.position[k - 1];
            squares.push_back(dot(d, d));
        }
    if (squares.size() < min_samples) return -1.0;
    const auto quartile = squares.begin() + static_cast<std::ptrdiff_t>(squares.size() / 4);
    std::nth_element(squares.begin(), quartile, squares.end());
    return *quartile / (12.0 * std::log(4.0 / 3.0));
}

/// ⟨|step|²⟩ minus the contribution of the noise at both ends.
double mean_square_step(const std::vector<TrackSegment>& segments, double noise) {
    double sum = 0.0, count = 0.0;
    for (const TrackSegment& s : segments)
        for (std::size_t k = 0; k + 1 < s.size(); ++k) {
            if (s.elapsed[k] != 1.0) continue;
            const Vec2 d = s.position[k + 1] - s.position[k];
            sum += dot(d, d);
            count += 1.0;
        }
    return sum / std::max(count, 1.0) - 4.0 * noise;
}

/// Symmetric 2×2 matrix of position (x) and velocity (v).
struct Symmetric {
    double xx, xv, vv;
};

/// Estimate of a kick: its square over both coordinates, and the variance of each coordinate.
struct KickEstimate {
    double square, variance;
};

/// Filters one segment forwards and smooths it backwards. Both coordinates have equal variances.
class Smoother {
  public:
    Smoother(TrackSegment& segment, double noise, double velocity_variance)
        : segment_(segment), noise_(noise), first_{100.0 * noise, 0.0, velocity_variance} {}

    /// Sets the segment's velocities and variances, and its positions if `smooth_positions`.
    void run(bool smooth_positions) {
        filter();
        smooth(smooth_positions);
    }
    /// Estimate of the kick after position k from all positions, without a prior for its size.
    KickEstimate estimate_kick(std::size_t k) const {
        const double n = std::max(information_[k], 1e-12 / noise_);  // 0 after the last position
        const Vec2 mean = (1.0 / n) * score_[k];
        return {dot(mean, mean), std::max(1.0 / n - segment_.kick[k], 0.0)};
    }

  private:
    void filter() {
        const std::size_t n = segment_.size();
        expected_.resize(n);
        Vec2 position = segment_.position[0], velocity{0.0, 0.0};
        Symmetric P = first_;
        for (std::size_t k = 0; k < n; ++k) {
            expected_[k] = {position, velocity, P};
            const double gain = P.xx / (P.xx + noise_), rate_gain = P.xv / (P.xx + noise_);
            const Vec2 innovation = segment_.position[k] - position;
            const double t = segment_.elapsed[k], q = segment_.kick[k];
            velocity = velocity + rate_gain * innovation;
            position = position + gain * innovation + t * velocity;
            const Symmetric now{P.xx * (1.0 - gain), P.xv * (1.0 - gain), P.vv - rate_gain * P.xv};
            P = {now.xx + t * (2.0 * now.xv + t * now.vv) + q * t * t / 3.0,
                 now.xv + t * now.vv + 0.5 * q * t, now.vv + q};
        }
    }
    void smooth(bool smooth_positions) {
        const std::size_t n = segment_.size();
        for (auto* column :
             {&information_, &segment_.position_variance, &segment_.velocity_variance})
            column->resize(n);
        score_.resize(n);
        segment_.velocity.resize(n);
        Vec2 rx{0.0, 0.0}, rv{0.0, 0.0};  // residuals at the next position and velocity
        Symmetric N{0.0, 0.0, 0.0};
        for (std::size_t k = n; k-- > 0;) {
            const double t = segment_.elapsed[k];
            score_[k] = 0.5 * t * rx + rv;
            information_[k] = 0.25 * t * t * N.xx + t * N.xv + N.vv;
            const auto& [position, velocity, P] = expected_[k];
            const double F = P.xx + noise_, gain = P.xx / F, rate_gain = P.xv / F;
            const double lx = 1.0 - gain - t * rate_gain, lv = -rate_gain;
            const Vec2 seen = segment_.position[k];
            const Vec2 before = rx;
            rx = (1.0 / F) * (seen - position) + lx * before + lv * rv;
            rv = t * before + rv;
            N = {lx * lx * N.xx + 2.0 * lx * lv * N.xv + lv * lv * N.vv + 1.0 / F,
                 lx * (t * N.xx + N.xv) + lv * (t * N.xv + N.vv),
                 t * t * N.xx + 2.0 * t * N.xv + N.vv};
            if (smooth_positions) segment_.position[k] = position + P.xx * rx + P.xv * rv;
            segment_.velocity[k] = velocity + P.xv * rx + P.vv * rv;
            segment_.position_variance[k] = reduced(P.xx, {P.xx, P.xv}, N);
            segment_.velocity_variance[k] = reduced(P.vv, {P.xv, P.vv}, N);
        }
    }
    static double reduced(double variance, const Vec2& row, const Symmetric& N) {
        return std::max(
            variance - (row.x * row.x * N.xx + 2.0 * row.x * row.y * N.xv + row.y * row.y * N.vv),
            0.0);
    }

    struct Expected {
        Vec2 position, velocity;
        Symmetric variance;
    };
    TrackSegment& segment_;
    double noise_;
    Symmetric first_;
    std::vector<Expected> expected_;
    std::vector<Vec2> score_;
    std::vector<double> information_;
};

/// Variances of the velocity change between two frames, for a small push and for a kick.
struct KickModel {
    double push, kick;
    double share;  // fraction of frames that are followed by a kick

    double mean(double probable) const { return probable * kick + (1.0 - probable) * push; }
    /// Probability of a kick, given its estimate.
    double probability(const KickEstimate& estimate) const {
        const double kicked = estimate.variance + kick, pushed = estimate.variance + push;
        const double odds = std::log((1.0 - share) / share) + std::log(kicked / pushed) -
                            0.5 * estimate.square * (1.0 / pushed - 1.0 / kicked);
        return 1.0 / (1.0 + std::exp(odds));
    }
};

/// One round: updates the kick variance after each position, given those of the previous round.
void update_kicks(std::vector<TrackSegment>& segments, KickModel& kicks, double noise,
                  bool damped) {
    double sum = 0.0, all = 0.0;
    for (TrackSegment& segment : segments) {
        Smoother smoother(segment, noise, kicks.kick);
        smoother.run(false);
        for (std::size_t k = 0; k + 1 < segment.size(); ++k) {
            const double probable = kicks.probability(smoother.estimate_kick(k));
            const double variance = kicks.mean(probable);
            // Damping prevents neighbouring frames from exchanging a kick in alternate rounds.
            segment.kick[k] = damped ? std::sqrt(segment.kick[k] * variance) : variance;
            sum += probable;
            all += 1.0;
        }
    }
    kicks.share = std::clamp(sum / std::max(all, 1.0), rarest_kick, 1.0 - rarest_kick);
}

/// Stores a smoothed segment in the tracks; `rate` converts from per frame to per unit of time.
void store(const TrackSegment& segment, const SeenContainer& container, const TrackScale& scale,
           double rate, Tracks& tracks) {
    for (std::size_t k = 0; k < segment.size(); ++k) {
        TrackFrame& f = tracks.frames[segment.frame[k]];
        const double time = double(f.number) / scale.frames_per_time;
        f.position[segment.disc[k]] = container.position(time) + segment.position[k];
        f.velocity[segment.disc[k]] = container.velocity(time) + rate * segment.velocity[k];
        f.velocity_error[segment.disc[k]] = rate * std::sqrt(segment.velocity_variance[k]);
    }
}

}  // namespace

TrackSmoothing smooth(Tracks& tracks, const TrackScale& scale) {
    TrackSmoothing found;
    const auto given = [](const TrackFrame& f) { return !f.velocity.empty(); };
    if (std::any_of(tracks.frames.begin(), tracks.frames.end(), given)) return found;
    const double rate = scale.frames_per_time / double(commonest_step(tracks));
    if (rate * scale.period < min_frames_per_period) return found;
    std::vector<TrackSegment> segments = segments_of(tracks, scale);
    const double measured = noise_of(segments);
    if (!(measured >= 0.0)) return found;
    const double square = mean_square_step(segments, measured);
    if (!(square > 0.0)) return found;

    // Angle by which the velocity of the container turns per frame.
    const double turn = 2.0 * pi / (rate * scale.period), coordinate = 0.5 * square;
    const double noise = std::max(measured, turn * turn * coordinate);
    KickModel kicks{push_in_turns * push_in_turns * turn * turn * coordinate,
                    kick_in_speeds * kick_in_speeds * coordinate, initial_share};
    for (TrackSegment& segment : segments)
        segment.kick.assign(segment.size(), kicks.mean(kicks.share));
    for (int round = 0; round < rounds; ++round)
        update_kicks(segments, kicks, noise, round >= undamped_rounds);

    for (TrackFrame& f : tracks.frames) {
        f.velocity.resize(f.id.size());
        f.velocity_error.resize(f.id.size());
    }
    const SeenContainer container(scale, tracks.y_down);
    double samples = 0.0, position_square = 0.0, velocity_square = 0.0;
    for (TrackSegment& segment : segments) {
        Smoother(segment, noise, kicks.kick).run(true);
        store(segment, container, scale, rate, tracks);
        for (std::size_t k = 0; k < segment.size(); ++k) {
            samples += 1.0;
            position_square += segment.position_variance[k];
            velocity_square += segment.velocity_variance[k];
        }
    }
    const double unit = rate / (scale.pixels_per_radius * scale.camera_time());
    found.done = true, found.kicks = kicks.share;
    found.noise = std::sqrt(measured), found.bend = turn * std::sqrt(coordinate);
    found.position_error = std::sqrt(position_square / samples);
    found.window = noise / (position_square / samples);
    found.missing_energy = unit * unit * velocity_square / samples;
    return found;
}

}  // namespace swirl
