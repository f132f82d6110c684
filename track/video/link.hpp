// Links the discs detected in consecutive frames to tracks.
//
// The whole field turns by ΩΔt between two frames, so if frames are few the nearest disc is often
// the wrong one. The expected position of a disc is a mean over several predictions, each weighted
// by its past accuracy for that disc: uniform motion in the lab (in flight), relative to the
// container, or in the co-rotating M-frame; rest in one of the latter two; and the mean motion of
// the neighbours, as of a disc that was seen once. In the first step discs move with the container.
//
// Expected and detected positions are then assigned such that the sum of squared distances is
// minimal (assignment problem; Kuhn 1955, in the form of Jonker & Volgenant 1987), within a gate.
// The number of tracks is limited to the number of discs. They start where exactly as many are
// detected, and are followed from there to the end and to the beginning. A lost track resumes at a
// detection that no other track explains. Pixels, y down.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "swirl/math/vec2.hpp"
#include "track/video/tracked_path.hpp"

namespace swirl::tracking {

struct DetectedDisc {
    Vec2 position{0.0, 0.0};
    std::size_t species = 0;
    bool sure = true;
};

struct LinkSettings {
    std::vector<double> radii;                 // radii of the species
    std::vector<std::size_t> numbers;          // numbers of discs of each species; empty if unknown
    double gate = 1.4;                         // gate in radii
    std::function<void()> throw_if_stopped{};  // called once per frame and row
};

/// Two tracks that may continue each other in `frame`, to which they were linked from the frame
/// `from`: the one before, or the one after if links go back, or farther if a disc was hidden.
struct PossibleSwap {
    std::size_t frame = 0, first = 0, second = 0, from = 0;
    double chance = 0.0;  // that they do
};

/// A sure detection beyond the number of discs.
struct ExtraDisc {
    std::size_t frame = 0;
    Vec2 position{0.0, 0.0};
};

struct Links {
    /// The track of each detected disc of each frame, or −1.
    std::vector<std::vector<int>> track;
    std::vector<std::size_t> species;  // species of each track
    std::optional<ExtraDisc> extra;    // one of them
    std::uint64_t rejected = 0;        // number of these
    std::uint64_t crowded = 0;         // frames with at least one
    std::vector<PossibleSwap> swaps;   // the most likely ones first
};

/// Throws std::invalid_argument unless times are finite and strictly ascending.
Links link_discs(const std::vector<std::vector<DetectedDisc>>& frames,
                 const std::vector<double>& times, const TrackedPath& path,
                 const LinkSettings& settings);

/// The column assigned to each row, or −1. Assigns as many pairs as possible and minimises the sum
/// of their costs. A cost that is not finite, or beyond ±1e100, forbids its pair. Any shape;
/// terminates for any costs. Calls `throw_if_stopped` for each row.
std::vector<int> best_assignment(const std::vector<std::vector<double>>& cost,
                                 const std::function<void()>& throw_if_stopped = {});

}  // namespace swirl::tracking
