#include "swirl/io/track_repair.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace swirl {
namespace {

using Track = std::map<std::int64_t, Vec2>;  // positions by frame

struct Piece {
    std::int64_t id = 0;
    Track track;
};

double distance(const Vec2& a, const Vec2& b) { return std::hypot(a.x - b.x, a.y - b.y); }

std::map<std::int64_t, Track> by_id(const Tracks& tracks) {
    std::map<std::int64_t, Track> found;
    for (const TrackFrame& frame : tracks.frames)
        for (std::size_t i = 0; i < frame.id.size(); ++i)
            found[frame.id[i]][frame.number] = frame.position[i];
    return found;
}

/// True if at most one move in ten exceeds half a radius per frame.
bool is_densely_sampled(const std::map<std::int64_t, Track>& tracks, std::int64_t step,
                        double radius) {
    constexpr double far_move = 0.5;  // radii
    std::uint64_t moves = 0, far = 0;
    for (const auto& [id, track] : tracks)
        for (auto a = track.begin(), b = std::next(a); b != track.end(); a = b++)
            if (b->first - a->first == step) {
                ++moves;
                if (distance(a->second, b->second) > far_move * radius) ++far;
            }
    return far * 10 <= moves;
}

std::vector<Piece> cut_at_jumps(const std::map<std::int64_t, Track>& tracks, std::int64_t step,
                                double radius) {
    std::vector<Piece> pieces;
    for (const auto& [id, track] : tracks) {
        pieces.push_back({id, {}});
        const Vec2* last = nullptr;
        std::int64_t last_frame = 0;
        for (const auto& [frame, position] : track) {
            const double steps = last ? double(frame - last_frame) / double(step) : 0.0;
            if (last && steps <= longest_gap + 1 && distance(*last, position) > radius)
                pieces.push_back({id, {}});
            pieces.back().track[frame] = position;
            last = &position;
            last_frame = frame;
        }
    }
    return pieces;
}

/// Joins ends of pieces to beginnings of others; returns the number of joins that change an ID.
std::uint64_t join(std::vector<Piece>& pieces, std::int64_t step, double radius) {
    struct Joint {
        bool is_far;  // true beyond one radius: only joined because both pieces have the same ID
        std::int64_t frames;
        double distance;
        std::size_t end, beginning;
    };
    std::multimap<std::int64_t, std::size_t> beginnings;
    for (std::size_t k = 0; k < pieces.size(); ++k)
        beginnings.emplace(pieces[k].track.begin()->first, k);
    std::vector<Joint> joints;
    for (std::size_t k = 0; k < pieces.size(); ++k) {
        const auto& [frame, position] = *pieces[k].track.rbegin();
        const auto last = beginnings.upper_bound(frame + (longest_gap + 1) * step);
        for (auto b = beginnings.upper_bound(frame); b != last; ++b) {
            const Piece& follower = pieces[b->second];
            const double d = distance(position, follower.track.begin()->second);
            if (d < radius || follower.id == pieces[k].id)
                joints.push_back({d >= radius, b->first - frame, d, k, b->second});
        }
    }
    std::sort(joints.begin(), joints.end(), [](const Joint& a, const Joint& b) {
        return std::tie(a.is_far, a.frames, a.distance, a.end, a.beginning) <
               std::tie(b.is_far, b.frames, b.distance, b.end, b.beginning);
    });
    std::vector<bool> continues(pieces.size(), false), is_continuation(pieces.size(), false);
    std::vector<std::size_t> next(pieces.size(), pieces.size());
    std::uint64_t relabelled = 0;
    for (const Joint& joint : joints) {
        if (continues[joint.end] || is_continuation[joint.beginning]) continue;
        continues[joint.end] = is_continuation[joint.beginning] = true;
        next[joint.end] = joint.beginning;
        if (pieces[joint.end].id != pieces[joint.beginning].id) ++relabelled;
    }
    std::vector<Piece> joined;
    for (std::size_t k = 0; k < pieces.size(); ++k) {
        if (is_continuation[k]) continue;
        joined.push_back(std::move(pieces[k]));
        for (std::size_t n = next[k]; n < pieces.size(); n = next[n])
            joined.back().track.merge(pieces[n].track);
    }
    pieces = std::move(joined);
    return relabelled;
}

std::uint64_t fill_gaps(std::vector<Piece>& pieces, std::int64_t step) {
    std::uint64_t filled = 0;
    for (Piece& piece : pieces) {
        Track added;
        for (auto a = piece.track.begin(), b = std::next(a); b != piece.track.end(); a = b++) {
            const std::int64_t gap = b->first - a->first;
            if (gap > (longest_gap + 1) * step || gap % step != 0) continue;
            for (std::int64_t k = step; k < gap; k += step)
                added[a->first + k] = a->second + double(k) / double(gap) * (b->second - a->second);
        }
        filled += added.size();
        piece.track.merge(added);
    }
    return filled;
}

/// Removes positions without another one of their disc within the longest gap; returns how many.
std::uint64_t drop_isolated(std::vector<Piece>& pieces, std::int64_t step) {
    std::uint64_t dropped = 0;
    for (Piece& piece : pieces) {
        std::vector<std::int64_t> isolated;
        std::int64_t before = std::numeric_limits<std::int64_t>::min() / 2;
        for (auto at = piece.track.begin(); at != piece.track.end(); ++at) {
            const auto after = std::next(at);
            const std::int64_t reach = (longest_gap + 1) * step;
            const bool followed = after != piece.track.end() && after->first - at->first <= reach;
            if (at->first - before > reach && !followed) isolated.push_back(at->first);
            before = at->first;
        }
        for (const std::int64_t frame : isolated) piece.track.erase(frame);
        dropped += isolated.size();
    }
    std::erase_if(pieces, [](const Piece& piece) { return piece.track.empty(); });
    return dropped;
}

/// Pieces that still share an ID with an earlier piece get unused IDs.
void make_ids_unique(std::vector<Piece>& pieces) {
    std::int64_t unused = 0;
    for (const Piece& piece : pieces) unused = std::max(unused, piece.id + 1);
    std::set<std::int64_t> taken;
    for (Piece& piece : pieces)
        if (!taken.insert(piece.id).second) piece.id = unused++;
}

/// Applies `change` to the values of all discs of a frame, one vector for each quantity.
void change_columns(TrackFrame& frame, const auto& change) {
    change(frame.id);
    change(frame.position);
    if (!frame.velocity.empty()) change(frame.velocity);
    for (auto* column : {&frame.radius, &frame.mass, &frame.spin, &frame.velocity_error})
        if (!column->empty()) change(*column);
}

}  // namespace

void cut(Tracks& tracks, std::vector<UncertainLink> links) {
    std::int64_t unused = 0;
    for (const TrackFrame& frame : tracks.frames)
        for (const std::int64_t id : frame.id) unused = std::max(unused, id + 1);
    // Later links first, so that earlier ones still find the given ID.
    std::sort(links.begin(), links.end(),
              [](const UncertainLink& a, const UncertainLink& b) { return a.to > b.to; });
    for (const UncertainLink& link : links) {
        for (TrackFrame& frame : tracks.frames) {
            const auto at = std::lower_bound(frame.id.begin(), frame.id.end(), link.id);
            if (frame.number <= link.from || at == frame.id.end() || *at != link.id) continue;
            const auto i = at - frame.id.begin();
            if (frame.number < link.to) {
                change_columns(frame, [i](auto& values) { values.erase(values.begin() + i); });
                continue;
            }
            *at = unused;
            change_columns(frame, [i](auto& values) {
                std::rotate(values.begin() + i, values.begin() + i + 1, values.end());
            });
        }
        ++unused;
    }
}

std::int64_t commonest_step(const Tracks& tracks) {
    std::map<std::int64_t, std::uint64_t> steps;
    for (std::size_t k = 1; k < tracks.frames.size(); ++k)
        ++steps[tracks.frames[k].number - tracks.frames[k - 1].number];
    std::pair<std::int64_t, std::uint64_t> commonest{1, 0};
    for (const auto& [step, count] : steps)
        if (count > commonest.second) commonest = {step, count};
    return commonest.first;
}

void repair(Tracks& tracks, double radius) {
    if (tracks.frames.size() < 2) return;
    for (const TrackFrame& f : tracks.frames)
        if (!(f.velocity.empty() && f.radius.empty() && f.mass.empty() && f.spin.empty())) return;
    const std::int64_t step = commonest_step(tracks);
    const auto given = by_id(tracks);
    std::vector<Piece> pieces;
    if (is_densely_sampled(given, step, radius)) {
        pieces = cut_at_jumps(given, step, radius);
        tracks.repaired.relabelled = join(pieces, step, radius);
    } else {
        for (const auto& [id, track] : given) pieces.push_back({id, track});
    }
    tracks.repaired.filled = fill_gaps(pieces, step);
    tracks.repaired.dropped = drop_isolated(pieces, step);
    make_ids_unique(pieces);
    std::sort(pieces.begin(), pieces.end(),
              [](const Piece& a, const Piece& b) { return a.id < b.id; });
    std::map<std::int64_t, TrackFrame> frames;
    for (const Piece& piece : pieces)
        for (const auto& [number, position] : piece.track) {
            TrackFrame& frame = frames[number];
            frame.number = number;
            frame.id.push_back(piece.id);
            frame.position.push_back(position);
        }
    tracks.frames.clear();
    for (auto& [number, frame] : frames) tracks.frames.push_back(std::move(frame));
}

}  // namespace swirl
