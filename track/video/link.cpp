#include "track/video/link.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace swirl::tracking {

namespace {

double square(const Vec2& v) { return dot(v, v); }

Vec2 rotated(const Vec2& v, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    return {c * v.x - s * v.y, s * v.x + c * v.y};
}

constexpr int predictions = 6;           // uniform in three frames, at rest in two, with neighbours
constexpr double unsure_penalty = 0.25;  // share of the squared gate
constexpr double forgetting = 0.25;      // weight of the latest error of a prediction

/// True if a pair of this cost may be assigned. The bound keeps sums of costs finite.
bool is_allowed(double cost) { return std::abs(cost) <= 1e100; }

struct Track {
    std::size_t species = 0;
    Vec2 position{0.0, 0.0}, before{0.0, 0.0};  // the last two, in the lab
    double time = 0.0, time_before = 0.0;
    int seen = 0;     // number of positions since a jump, up to 2
    int missed = 0;   // frames in a row
    int doubted = 0;  // frames in a row in which it was missed or not sure
    std::array<double, predictions> errors{
        1.0, 1.0, 1.0, 1.0, 1.0, 1.0};  // mean squared error of each prediction, radii²
    std::array<Vec2, predictions> expected{};
};

/// Where a track was expected after `unsure` frames without a sure position, and where it was
/// found.
struct Expectation {
    Vec2 position{0.0, 0.0};
    int unsure = 0;
    std::optional<Vec2> found;
};

class Linker {
  public:
    Linker(const TrackedPath& path, const LinkSettings& settings)
        : path_(path), settings_(settings) {}

    /// Transforms a lab position to frame 0 (lab), 1 (container) or 2 (M-frame), and back.
    Vec2 to_frame(int frame, const Vec2& position, double time) const {
        if (frame == 0) return position;
        const Vec2 d = position - path_.at(time);
        // Angles are counter-clockwise with y up; y down reverses the sign of a rotation.
        return frame == 1 ? d : rotated(d, path_.angle(time));
    }
    Vec2 to_lab(int frame, const Vec2& p, double time) const {
        if (frame == 0) return p;
        return path_.at(time) + (frame == 1 ? p : rotated(p, -path_.angle(time)));
    }

    std::vector<int> step(const std::vector<DetectedDisc>& discs, double time);
    /// For each track, what the last step expected and found.
    std::vector<Expectation> last;
    /// After the first frame: follows its discs towards earlier ones. `next` is a step ahead.
    void turn_back(const Linker& next);
    std::vector<Track> tracks;

  private:
    Vec2 flow_at(const Vec2& position, double time_from, double time_to) const;
    Vec2 expect(Track& track, double time) const;
    void assign(std::size_t species, const std::vector<DetectedDisc>& discs,
                const std::vector<Vec2>& expected, std::vector<int>& of) const;
    void resume_lost(const std::vector<DetectedDisc>& discs, const std::vector<Vec2>& expected,
                     std::vector<int>& of);
    /// True if there are as many sure detections as discs; then the others are not discs.
    bool all_are_sure(const std::vector<DetectedDisc>& discs, std::size_t species) const {
        const auto counts = [&](const auto& d) { return d.sure && d.species == species; };
        return !settings_.numbers.empty() &&
               std::size_t(std::count_if(discs.begin(), discs.end(), counts)) >=
                   settings_.numbers[species];
    }
    bool may_start_track(std::size_t species) const {
        const auto counts = [&](const Track& t) { return t.species == species; };
        return settings_.numbers.empty() ||
               std::size_t(std::count_if(tracks.begin(), tracks.end(), counts)) <
                   settings_.numbers[species];
    }

    const TrackedPath& path_;
    const LinkSettings& settings_;
};

/// A time in steps of the track's latest one. That is almost zero while the container rests
/// (frame_times.cpp), and then says nothing about the motion that follows.
double steps_of(const Track& track, double time) {
    constexpr double most = 8.0;  // longer than any gap that is filled
    return std::min(most, time / (track.time - track.time_before));
}

/// Position at `time_to` of a disc at `position` that moves relative to the container like the
/// discs nearby did in the last step.
Vec2 Linker::flow_at(const Vec2& position, double time_from, double time_to) const {
    Vec2 sum{0.0, 0.0};
    double weights = 0.0;
    const double near = 3.0 * settings_.radii.front();
    for (const Track& t : tracks) {
        if (t.seen < 2 || t.missed > 0) continue;
        const Vec2 move = to_frame(1, t.position, t.time) - to_frame(1, t.before, t.time_before);
        const double w = std::exp(-square(t.position - position) / (2.0 * near * near)) + 1e-9;
        sum = sum + (w * steps_of(t, time_to - time_from)) * move;
        weights += w;
    }
    Vec2 at_container = to_frame(1, position, time_from);
    if (weights > 0.0) at_container = at_container + (1.0 / weights) * sum;
    return to_lab(1, at_container, time_to);
}

Vec2 Linker::expect(Track& track, double time) const {
    if (track.seen < 2 || track.missed > 0) {
        const Vec2 there = flow_at(track.position, track.time, time);
        track.expected.fill(there);
        return there;
    }
    const double ahead = steps_of(track, time - track.time);
    Vec2 sum{0.0, 0.0};
    double weights = 0.0;
    for (int way = 0; way < predictions; ++way) {
        const auto k = static_cast<std::size_t>(way);
        if (way == predictions - 1) {
            track.expected[k] = flow_at(track.position, track.time, time);
        } else {
            const int frame = way < 3 ? way : way - 2;
            const Vec2 last = to_frame(frame, track.position, track.time),
                       before = to_frame(frame, track.before, track.time_before);
            const double forward = way < 3 ? ahead : 0.0;
            track.expected[k] = to_lab(frame, last + forward * (last - before), time);
        }
        const double w = 1.0 / std::pow(track.errors[k] + 1e-4, 2.0);
        sum = sum + w * track.expected[k];
        weights += w;
    }
    return (1.0 / weights) * sum;
}

/// Assigns detections of one species to tracks with minimal cost. With as many sure detections as
/// discs, each belongs to a track: there is no gate, and costs grow linearly beyond it, so that one
/// long jump does not displace two other discs. Otherwise costs are squares within a gate.
void Linker::assign(std::size_t species, const std::vector<DetectedDisc>& discs,
                    const std::vector<Vec2>& expected, std::vector<int>& of) const {
    const bool complete = all_are_sure(discs, species);
    std::vector<std::size_t> rows, columns;
    for (std::size_t t = 0; t < tracks.size(); ++t)
        if (tracks[t].species == species) rows.push_back(t);
    for (std::size_t d = 0; d < discs.size(); ++d)
        if (discs[d].species == species && (discs[d].sure || !complete)) columns.push_back(d);
    if (rows.empty() || columns.empty()) return;
    const double unassigned = complete ? 1e6 : 1.0;
    std::vector<std::vector<double>> cost(rows.size(),
                                          std::vector<double>(columns.size(), unassigned));
    for (std::size_t r = 0; r < rows.size(); ++r) {
        const Track& t = tracks[rows[r]];
        const double gate = settings_.radii[species] *
                            std::min(settings_.gate + 0.15 * t.missed, 1.6 * settings_.gate);
        for (std::size_t c = 0; c < columns.size(); ++c) {
            const DetectedDisc& disc = discs[columns[c]];
            const double q = square(disc.position - expected[rows[r]]) / (gate * gate);
            if (complete)
                cost[r][c] = q < 1.0 ? q : 2.0 * std::sqrt(q) - 1.0;
            else if (q < 1.0)
                cost[r][c] = std::min(0.999, q + (disc.sure ? 0.0 : unsure_penalty));
        }
    }
    const std::vector<int> column = best_assignment(cost, settings_.throw_if_stopped);
    for (std::size_t r = 0; r < rows.size(); ++r)
        if (column[r] >= 0 && cost[r][static_cast<std::size_t>(column[r])] < unassigned)
            of[columns[static_cast<std::size_t>(column[r])]] = static_cast<int>(rows[r]);
}

/// Assigns unexplained sure detections to tracks that were lost or that follow something that is
/// not a disc. Minimises the sum of squares within a reach that grows with time.
void Linker::resume_lost(const std::vector<DetectedDisc>& discs, const std::vector<Vec2>& expected,
                         std::vector<int>& of) {
    std::vector<std::size_t> free_discs, free_tracks;
    std::vector<int> disc_of(tracks.size(), -1);
    for (std::size_t d = 0; d < discs.size(); ++d)
        if (of[d] >= 0)
            disc_of[static_cast<std::size_t>(of[d])] = static_cast<int>(d);
        else if (discs[d].sure)
            free_discs.push_back(d);
    for (std::size_t t = 0; t < tracks.size(); ++t)
        if (disc_of[t] < 0
                ? tracks[t].missed > 0
                : !discs[static_cast<std::size_t>(disc_of[t])].sure && tracks[t].doubted > 0)
            free_tracks.push_back(t);
    if (free_discs.empty() || free_tracks.empty()) return;
    constexpr double out_of_reach = 1e6;
    constexpr double reach_growth = 0.4;  // radii per frame
    std::vector<std::vector<double>> cost(free_tracks.size(),
                                          std::vector<double>(free_discs.size(), out_of_reach));
    for (std::size_t r = 0; r < free_tracks.size(); ++r) {
        const Track& t = tracks[free_tracks[r]];
        for (std::size_t c = 0; c < free_discs.size(); ++c) {
            const DetectedDisc& disc = discs[free_discs[c]];
            const double radius = settings_.radii[t.species];
            const double reach = radius * (1.0 + reach_growth * t.doubted);
            const double q = square(disc.position - expected[free_tracks[r]]);
            if (disc.species == t.species && q < reach * reach) cost[r][c] = q / (radius * radius);
        }
    }
    const std::vector<int> column = best_assignment(cost, settings_.throw_if_stopped);
    for (std::size_t r = 0; r < free_tracks.size(); ++r) {
        if (column[r] < 0 || cost[r][static_cast<std::size_t>(column[r])] >= out_of_reach) continue;
        const std::size_t t = free_tracks[r];
        if (disc_of[t] >= 0) of[static_cast<std::size_t>(disc_of[t])] = -1;
        of[free_discs[static_cast<std::size_t>(column[r])]] = static_cast<int>(t);
        tracks[t].seen = 0;  // its velocity is unknown after the jump
    }
}

std::vector<int> Linker::step(const std::vector<DetectedDisc>& discs, double time) {
    std::vector<int> of(discs.size(), -1);
    std::vector<Vec2> expected(tracks.size());
    for (std::size_t t = 0; t < tracks.size(); ++t) expected[t] = expect(tracks[t], time);
    for (std::size_t species = 0; species < settings_.radii.size(); ++species)
        assign(species, discs, expected, of);
    resume_lost(discs, expected, of);
    last.clear();
    for (const Track& t : tracks) last.push_back({expected[last.size()], t.doubted, {}});
    for (std::size_t d = 0; d < discs.size(); ++d) {
        if (of[d] < 0) continue;
        Track& t = tracks[static_cast<std::size_t>(of[d])];
        last[std::size_t(of[d])].found = discs[d].position;
        last[std::size_t(of[d])].unsure += discs[d].sure ? 0 : 1;
        if (t.seen == 2)
            for (std::size_t k = 0; k < predictions; ++k) {
                const double radius = settings_.radii[t.species];
                t.errors[k] =
                    (1.0 - forgetting) * t.errors[k] +
                    forgetting * square(discs[d].position - t.expected[k]) / (radius * radius);
            }
        t.before = t.position;
        t.time_before = t.time;
        t.position = discs[d].position;
        t.time = time;
        t.seen = std::min(t.seen + 1, 2);
        t.missed = 0;
        t.doubted = discs[d].sure ? 0 : t.doubted + 1;
    }
    for (std::size_t t = 0; t < last.size(); ++t) {
        if (last[t].found) continue;
        // A missed disc is placed at its expected position, which also keeps its velocity.
        ++tracks[t].missed;
        ++tracks[t].doubted;
        tracks[t].position = expected[t];
        tracks[t].time = time;
    }
    for (std::size_t d = 0; d < discs.size(); ++d) {
        if (of[d] >= 0 || !discs[d].sure) continue;
        if (!may_start_track(discs[d].species)) continue;
        of[d] = static_cast<int>(tracks.size());
        Track track;
        track.species = discs[d].species;
        track.position = discs[d].position;
        track.time = time;
        track.seen = 1;
        tracks.push_back(track);
    }
    return of;
}

void Linker::turn_back(const Linker& next) {
    for (std::size_t t = 0; t < tracks.size(); ++t) {
        if (next.tracks[t].missed > 0) continue;
        tracks[t].before = next.tracks[t].position;
        tracks[t].time_before = next.tracks[t].time;
        tracks[t].seen = 2;
    }
}

/// The frame from which discs are followed to both ends, in the middle of the longest run of frames
/// with all discs and nothing else: no circle on a hand at the beginning becomes a track.
std::size_t start_of_links(const std::vector<std::vector<DetectedDisc>>& frames,
                           const std::vector<std::size_t>& numbers) {
    std::size_t begin = 0, longest = 0, start = 0;
    for (std::size_t k = 0; k < frames.size(); ++k) {
        std::vector<std::size_t> sure(numbers.size(), 0);
        for (const DetectedDisc& d : frames[k])
            if (d.sure && d.species < sure.size()) ++sure[d.species];
        if (sure != numbers) begin = k + 1;
        if (const std::size_t run = k + 1 - begin; run > longest)
            longest = run, start = begin == 0 ? 0 : begin + run / 2;
    }
    return start;
}

/// The pairs of tracks for which the other assignment is hardly less likely. Errors of expected
/// positions are those of all tracks, and grow with the number of frames in which one was missed.
/// Links go from the frame `start` to both ends.
std::vector<PossibleSwap> possible_swaps(const std::vector<std::vector<Expectation>>& steps,
                                         const std::vector<std::size_t>& species,
                                         std::size_t start) {
    constexpr double max_log_odds = 3.0;
    double sum = 0.0, number = 0.0;
    for (const auto& step : steps)
        for (const Expectation& e : step)
            if (e.found && e.unsure == 0) sum += square(*e.found - e.position), number += 1.0;
    const double usual = sum / std::max(number, 1.0);
    const auto log_of = [&](const Expectation& e, const Vec2& at, bool hidden) {
        const double spread = std::max(usual * std::pow(1.0 + e.unsure, 2.0), 1e-12);
        const double q = square(at - e.position) / spread;
        return std::log(spread) + (hidden ? 2.0 * std::log1p(0.5 * q) : q);
    };
    std::vector<PossibleSwap> swaps;
    for (std::size_t k = 0; k < steps.size(); ++k)
        for (std::size_t a = 0; a < steps[k].size(); ++a)
            for (std::size_t b = 0; b < steps[k].size(); ++b) {
                const Expectation &one = steps[k][a], &other = steps[k][b];
                if (a == b || species[a] != species[b] || !one.found || (other.found && b < a))
                    continue;
                const bool hidden = one.unsure + other.unsure > 0 || !other.found;
                double odds = log_of(other, *one.found, hidden) - log_of(one, *one.found, hidden);
                if (other.found)
                    odds += log_of(one, *other.found, hidden) - log_of(other, *other.found, hidden);
                if (odds >= max_log_odds) continue;
                const std::size_t gap = 1 + std::size_t(std::max(one.unsure, other.unsure));
                const std::size_t from =
                    k < start ? std::min(k + gap, steps.size() - 1) : k - std::min(k, gap);
                const double chance = 1.0 / (1.0 + std::exp(odds));
                swaps.push_back(
                    {.frame = k, .first = a, .second = b, .from = from, .chance = chance});
            }
    std::stable_sort(swaps.begin(), swaps.end(),
                     [](const auto& a, const auto& b) { return a.chance > b.chance; });
    return swaps;
}

}  // namespace

std::vector<int> best_assignment(const std::vector<std::vector<double>>& cost,
                                 const std::function<void()>& throw_if_stopped) {
    const std::size_t rows = cost.size();
    if (rows == 0) return {};
    const std::size_t columns = cost.front().size();
    double maximum = 0.0, min_cost = 0.0;
    for (const auto& row : cost)
        for (const double c : row)
            if (is_allowed(c)) maximum = std::max(maximum, c), min_cost = std::min(min_cost, c);
    // Shortest augmenting paths need at least as many columns as rows; added columns cost more than
    // any allowed pair. A forbidden pair costs more than the largest possible difference between
    // two assignments without forbidden pairs. So the result has as few of them as possible, and
    // they are removed at the end. All costs of the search are finite, so every pass of its inner
    // loop adds a column, and it terminates.
    const std::size_t width = std::max(rows, columns);
    const double forbidden = (maximum - min_cost + 1.0) * static_cast<double>(width + 1);
    const auto at = [&](std::size_t r, std::size_t c) {
        if (c >= columns) return maximum + 1.0;
        return is_allowed(cost[r][c]) ? cost[r][c] : forbidden;
    };
    constexpr double infinite = std::numeric_limits<double>::infinity();
    std::vector<double> u(rows + 1, 0.0), v(width + 1, 0.0);
    std::vector<std::size_t> row_of(width + 1, 0), way(width + 1, 0);
    for (std::size_t r = 1; r <= rows; ++r) {
        if (throw_if_stopped) throw_if_stopped();
        row_of[0] = r;
        std::size_t c0 = 0;
        std::vector<double> minimum(width + 1, infinite);
        std::vector<char> used(width + 1, 0);
        do {
            used[c0] = 1;
            const std::size_t r0 = row_of[c0];
            double delta = infinite;
            std::size_t c1 = 0;
            for (std::size_t c = 1; c <= width; ++c) {
                if (used[c]) continue;
                const double reduced = at(r0 - 1, c - 1) - u[r0] - v[c];
                if (reduced < minimum[c]) minimum[c] = reduced, way[c] = c0;
                if (minimum[c] < delta) delta = minimum[c], c1 = c;
            }
            for (std::size_t c = 0; c <= width; ++c) {
                if (used[c]) {
                    u[row_of[c]] += delta;
                    v[c] -= delta;
                } else {
                    minimum[c] -= delta;
                }
            }
            c0 = c1;
        } while (row_of[c0] != 0);
        do {
            const std::size_t c1 = way[c0];
            row_of[c0] = row_of[c1];
            c0 = c1;
        } while (c0 != 0);
    }
    std::vector<int> column(rows, -1);
    for (std::size_t c = 1; c <= columns; ++c)
        if (row_of[c] != 0 && is_allowed(cost[row_of[c] - 1][c - 1]))
            column[row_of[c] - 1] = static_cast<int>(c - 1);
    return column;
}

Links link_discs(const std::vector<std::vector<DetectedDisc>>& frames,
                 const std::vector<double>& times, const TrackedPath& path,
                 const LinkSettings& settings) {
    if (times.size() != frames.size()) throw std::invalid_argument("every frame needs a time.");
    for (std::size_t k = 0; k < times.size(); ++k)
        if (!std::isfinite(times[k]) || (k > 0 && !(times[k] > times[k - 1])))
            throw std::invalid_argument(
                fmt::format("the times of frames must be finite and ascend, but frame {} has {}.",
                            k, times[k]));
    Links links;
    links.track.resize(frames.size());
    std::vector<std::vector<Expectation>> steps(frames.size());
    const auto link = [&](Linker& linker, std::size_t k) {
        if (settings.throw_if_stopped) settings.throw_if_stopped();
        links.track[k] = linker.step(frames[k], times[k]);
        steps[k] = std::move(linker.last);
        const auto sure = std::size_t(std::count_if(frames[k].begin(), frames[k].end(),
                                                    [](const auto& d) { return d.sure; }));
        if (sure <= linker.tracks.size()) return;
        ++links.crowded;
        links.rejected += sure - linker.tracks.size();
        for (std::size_t d = 0; d < frames[k].size() && !links.extra; ++d)
            if (frames[k][d].sure && links.track[k][d] < 0)
                links.extra = ExtraDisc{k, frames[k][d].position};
    };
    const std::size_t start = start_of_links(frames, settings.numbers);
    Linker forward(path, settings);
    if (start < frames.size()) link(forward, start);
    Linker backward = forward;
    for (std::size_t k = start + 1; k < frames.size(); ++k) {
        link(forward, k);
        if (k == start + 1) backward.turn_back(forward);
    }
    for (std::size_t k = start; k-- > 0;) link(backward, k);
    for (const Track& t : forward.tracks) links.species.push_back(t.species);
    links.swaps = possible_swaps(steps, links.species, start);
    return links;
}

}  // namespace swirl::tracking
