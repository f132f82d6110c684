#include "swirl/io/track_smoothing.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "swirl/io/track_repair.hpp"
#include "swirl/math/unit_circle.hpp"

namespace swirl {
namespace {

constexpr std::size_t min_places = 400;  // for a noise known to some per cent
constexpr int rounds = 8;
constexpr double rarest_kick = 1e-6;
// A kick is of the speeds there are; those of many weak collisions count as three swirls'
// curvature.
constexpr double kick_in_speeds = 3.0, push_in_turns = 3.0;

/// What one disc does between two gaps, relative to the dish. Times are in steps between pictures.
struct Stretch {
    std::vector<std::size_t> frame, disc;                   // where in the tracks
    std::vector<double> elapsed;                            // to the next place
    std::vector<Vec2> place, velocity;                      // the latter per step
    std::vector<double> place_variance, velocity_variance;  // of a coordinate
    std::vector<double> kick;                               // variance of that to the next place

    std::size_t size() const { return place.size(); }
};

/// The dish's centre in the picture, and its velocity per unit of time.
class Course {
  public:
    Course(const TrackScale& scale, bool y_down)
        : scale_(scale), up_(y_down ? -1.0 : 1.0), sense_(scale.clockwise ? -1.0 : 1.0) {}
    Vec2 place(double time) const {
        const Vec2 d = direction(time);
        return scale_.swirl_centre + radius() * Vec2{d.x, up_ * d.y};
    }
    Vec2 velocity(double time) const {
        const Vec2 d = perpendicular(direction(time));
        return (sense_ * radius() * 2.0 * pi / scale_.period) * Vec2{d.x, up_ * d.y};
    }

  private:
    double radius() const { return scale_.amplitude * scale_.pixels_per_radius; }
    Vec2 direction(double time) const {
        return unit_circle(scale_.phase / (2.0 * pi) + sense_ * time / scale_.period);
    }
    const TrackScale& scale_;
    double up_, sense_;
};

std::vector<Stretch> stretches_of(const Tracks& tracks, const TrackScale& scale) {
    const auto step = static_cast<double>(commonest_step(tracks));
    const Course course(scale, tracks.y_down);
    std::map<std::int64_t, std::size_t> last;  // stretch of each disc
    std::vector<Stretch> stretches;
    for (std::size_t k = 0; k < tracks.frames.size(); ++k) {
        const TrackFrame& f = tracks.frames[k];
        const Vec2 centre = course.place(double(f.number) / scale.frames_per_time);
        for (std::size_t i = 0; i < f.id.size(); ++i) {
            const auto [known, fresh] = last.try_emplace(f.id[i], stretches.size());
            double elapsed = 0.0;
            if (!fresh)
                elapsed =
                    double(f.number - tracks.frames[stretches[known->second].frame.back()].number) /
                    step;
            if (fresh || elapsed > double(longest_gap + 1)) {
                known->second = stretches.size();
                stretches.emplace_back();
            } else {
                stretches[known->second].elapsed.push_back(elapsed);
            }
            Stretch& stretch = stretches[known->second];
            stretch.frame.push_back(k);
            stretch.disc.push_back(i);
            stretch.place.push_back(f.position[i] - centre);
        }
    }
    for (Stretch& stretch : stretches) stretch.elapsed.push_back(1.0);
    return stretches;
}

/// The variance of a coordinate's noise: 12σ² ln(4/3) is the lower quartile of |second
/// difference|².
double noise_of(const std::vector<Stretch>& stretches) {
    std::vector<double> squares;
    for (const Stretch& p : stretches)
        for (std::size_t k = 1; k + 1 < p.size(); ++k) {
            if (p.elapsed[k - 1] != 1.0 || p.elapsed[k] != 1.0) continue;
            const Vec2 d = p.place[k + 1] - 2.0 * p.place[k] + p.place[k - 1];
            squares.push_back(dot(d, d));
        }
    if (squares.size() < min_places) return -1.0;
    const auto quartile = squares.begin() + static_cast<std::ptrdiff_t>(squares.size() / 4);
    std::nth_element(squares.begin(), quartile, squares.end());
    return *quartile / (12.0 * std::log(4.0 / 3.0));
}

/// ⟨|step|²⟩ without what the noise of both ends adds.
double mean_square_step(const std::vector<Stretch>& stretches, double noise) {
    double sum = 0.0, count = 0.0;
    for (const Stretch& s : stretches)
        for (std::size_t k = 0; k + 1 < s.size(); ++k) {
            if (s.elapsed[k] != 1.0) continue;
            const Vec2 d = s.place[k + 1] - s.place[k];
            sum += dot(d, d);
            count += 1.0;
        }
    return sum / std::max(count, 1.0) - 4.0 * noise;
}

/// A symmetric matrix of place and velocity.
struct Square {
    double xx, xv, vv;
};

/// Of a kick: its square over both coordinates, and the variance of each with which that is told.
struct Told {
    double square, variance;
};

/// One stretch, filtered forwards and smoothed backwards. Both coordinates share their variances.
class Smoother {
  public:
    Smoother(Stretch& stretch, double noise, double velocity_variance)
        : stretch_(stretch), noise_(noise), first_{100.0 * noise, 0.0, velocity_variance} {}

    /// Fills the stretch's velocities and variances, and its places if asked to.
    void run(bool smooth_places) {
        filter();
        smooth(smooth_places);
    }
    /// What all places say of the kick after place k, not knowing how large such kicks are.
    Told told_of_kick(std::size_t k) const {
        const double n = std::max(information_[k], 1e-12 / noise_);  // 0 behind the last place
        const Vec2 mean = (1.0 / n) * score_[k];
        return {dot(mean, mean), std::max(1.0 / n - stretch_.kick[k], 0.0)};
    }

  private:
    void filter() {
        const std::size_t n = stretch_.size();
        expected_.resize(n);
        Vec2 place = stretch_.place[0], velocity{0.0, 0.0};
        Square P = first_;
        for (std::size_t k = 0; k < n; ++k) {
            expected_[k] = {place, velocity, P};
            const double gain = P.xx / (P.xx + noise_), rate_gain = P.xv / (P.xx + noise_);
            const Vec2 surprise = stretch_.place[k] - place;
            const double t = stretch_.elapsed[k], q = stretch_.kick[k];
            velocity = velocity + rate_gain * surprise;
            place = place + gain * surprise + t * velocity;
            const Square now{P.xx * (1.0 - gain), P.xv * (1.0 - gain), P.vv - rate_gain * P.xv};
            P = {now.xx + t * (2.0 * now.xv + t * now.vv) + q * t * t / 3.0,
                 now.xv + t * now.vv + 0.5 * q * t, now.vv + q};
        }
    }
    void smooth(bool smooth_places) {
        const std::size_t n = stretch_.size();
        for (auto* column : {&information_, &stretch_.place_variance, &stretch_.velocity_variance})
            column->resize(n);
        score_.resize(n);
        stretch_.velocity.resize(n);
        Vec2 rx{0.0, 0.0}, rv{0.0, 0.0};  // of place and velocity, as they are expected next
        Square N{0.0, 0.0, 0.0};
        for (std::size_t k = n; k-- > 0;) {
            const double t = stretch_.elapsed[k];
            score_[k] = 0.5 * t * rx + rv;
            information_[k] = 0.25 * t * t * N.xx + t * N.xv + N.vv;
            const auto& [place, velocity, P] = expected_[k];
            const double F = P.xx + noise_, gain = P.xx / F, rate_gain = P.xv / F;
            const double lx = 1.0 - gain - t * rate_gain, lv = -rate_gain;
            const Vec2 seen = stretch_.place[k];
            const Vec2 before = rx;
            rx = (1.0 / F) * (seen - place) + lx * before + lv * rv;
            rv = t * before + rv;
            N = {lx * lx * N.xx + 2.0 * lx * lv * N.xv + lv * lv * N.vv + 1.0 / F,
                 lx * (t * N.xx + N.xv) + lv * (t * N.xv + N.vv),
                 t * t * N.xx + 2.0 * t * N.xv + N.vv};
            if (smooth_places) stretch_.place[k] = place + P.xx * rx + P.xv * rv;
            stretch_.velocity[k] = velocity + P.xv * rx + P.vv * rv;
            stretch_.place_variance[k] = reduced(P.xx, {P.xx, P.xv}, N);
            stretch_.velocity_variance[k] = reduced(P.vv, {P.xv, P.vv}, N);
        }
    }
    static double reduced(double variance, const Vec2& row, const Square& N) {
        return std::max(
            variance - (row.x * row.x * N.xx + 2.0 * row.x * row.y * N.xv + row.y * row.y * N.vv),
            0.0);
    }

    struct Expected {
        Vec2 place, velocity;
        Square variance;
    };
    Stretch& stretch_;
    double noise_;
    Square first_;
    std::vector<Expected> expected_;
    std::vector<Vec2> score_;
    std::vector<double> information_;
};

/// Between two pictures a disc is kicked, or only pushed a little: the variances of both.
struct Kicks {
    double push, kick;
    double share;  // of the pictures that are followed by a kick

    double mean(double probable) const { return probable * kick + (1.0 - probable) * push; }
    /// How probable a kick is where the others tell its square, with that variance.
    double probability(const Told& told) const {
        const double kicked = told.variance + kick, pushed = told.variance + push;
        const double odds = std::log((1.0 - share) / share) + std::log(kicked / pushed) -
                            0.5 * told.square * (1.0 / pushed - 1.0 / kicked);
        return 1.0 / (1.0 + std::exp(odds));
    }
};

/// One round: who was kicked after which place, given what the round before thought of the others.
void find_kicks(std::vector<Stretch>& stretches, Kicks& kicks, double noise, bool halfway) {
    double sum = 0.0, all = 0.0;
    for (Stretch& stretch : stretches) {
        Smoother smoother(stretch, noise, kicks.kick);
        smoother.run(false);
        for (std::size_t k = 0; k + 1 < stretch.size(); ++k) {
            const double probable = kicks.probability(smoother.told_of_kick(k));
            const double variance = kicks.mean(probable);
            // Half the way, lest neighbours take turns in having it.
            stretch.kick[k] = halfway ? std::sqrt(stretch.kick[k] * variance) : variance;
            sum += probable;
            all += 1.0;
        }
    }
    kicks.share = std::clamp(sum / std::max(all, 1.0), rarest_kick, 1.0 - rarest_kick);
}

/// Puts a smoothed stretch back; per step becomes per unit of time.
void put_back(const Stretch& stretch, const Course& course, const TrackScale& scale, double rate,
              Tracks& tracks) {
    for (std::size_t k = 0; k < stretch.size(); ++k) {
        TrackFrame& f = tracks.frames[stretch.frame[k]];
        const double time = double(f.number) / scale.frames_per_time;
        f.position[stretch.disc[k]] = course.place(time) + stretch.place[k];
        f.velocity[stretch.disc[k]] = course.velocity(time) + rate * stretch.velocity[k];
        f.velocity_error[stretch.disc[k]] = rate * std::sqrt(stretch.velocity_variance[k]);
    }
}

}  // namespace

TrackSmoothing smooth(Tracks& tracks, const TrackScale& scale) {
    TrackSmoothing found;
    const auto given = [](const TrackFrame& f) { return !f.velocity.empty(); };
    if (std::any_of(tracks.frames.begin(), tracks.frames.end(), given)) return found;
    const double rate = scale.frames_per_time / double(commonest_step(tracks));
    if (rate * scale.period < min_pictures) return found;
    std::vector<Stretch> stretches = stretches_of(tracks, scale);
    const double measured = noise_of(stretches);
    if (!(measured >= 0.0)) return found;
    const double square = mean_square_step(stretches, measured);
    if (!(square > 0.0)) return found;

    // In a step velocities turn by that much without a kick, as the swirl does.
    const double turn = 2.0 * pi / (rate * scale.period), coordinate = 0.5 * square;
    const double noise = std::max(measured, turn * turn * coordinate);
    Kicks kicks{push_in_turns * push_in_turns * turn * turn * coordinate,
                kick_in_speeds * kick_in_speeds * coordinate, 0.1};
    for (Stretch& stretch : stretches) stretch.kick.assign(stretch.size(), kicks.mean(kicks.share));
    for (int round = 0; round < rounds; ++round) find_kicks(stretches, kicks, noise, round >= 2);

    for (TrackFrame& f : tracks.frames) {
        f.velocity.resize(f.id.size());
        f.velocity_error.resize(f.id.size());
    }
    const Course course(scale, tracks.y_down);
    double places = 0.0, place_square = 0.0, velocity_square = 0.0;
    for (Stretch& stretch : stretches) {
        Smoother(stretch, noise, kicks.kick).run(true);
        put_back(stretch, course, scale, rate, tracks);
        for (std::size_t k = 0; k < stretch.size(); ++k) {
            places += 1.0;
            place_square += stretch.place_variance[k];
            velocity_square += stretch.velocity_variance[k];
        }
    }
    const double unit = rate / (scale.pixels_per_radius * scale.camera_time());
    found.done = true;
    found.noise = std::sqrt(measured);
    found.bend = turn * std::sqrt(coordinate);
    found.place_error = std::sqrt(place_square / places);
    found.window = noise / (place_square / places);
    found.kicks = kicks.share;
    found.missing_energy = unit * unit * velocity_square / places;
    return found;
}

}  // namespace swirl
