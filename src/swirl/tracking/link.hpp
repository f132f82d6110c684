// Which disc in this picture is which in the last.
//
// The whole field turns by Ω between two pictures, so the nearest disc is the wrong one where they
// are few. A disc is expected where several ways of going on would have it, each of which counts by
// how well it has done for that disc so far: straight on in the lab (in flight), relative to the
// dish, or in the co-rotating M-frame (a cluster that goes round with the swirl); at rest in either
// of the latter, and as its neighbours do (where discs collide more often than they are seen, their
// own velocities tell little). A disc seen once moves as its neighbours do. For the very first step
// that all turn about the middle of the dish by one angle, the one that fits best.
//
// Expected places and circles found are then joined so that the sum of squared distances is least
// (assignment problem; Kuhn 1955, in the form of Jonker & Volgenant 1987), within a gate. There are
// only so many discs: nobody is born beyond their number, and one that was lost is taken up again
// by the circle that nobody else explains.
//
// Pixels, y down.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "swirl/math/vec2.hpp"
#include "swirl/tracking/tracked_path.hpp"

namespace swirl {

struct SeenDisc {
    Vec2 place{0.0, 0.0};
    std::size_t kind = 0;
    bool sure = true;
};

struct LinkSettings {
    std::vector<double> radii;         // of the kinds
    std::vector<std::size_t> numbers;  // of discs of each kind; empty: not known
    double gate = 1.4;                 // in radii
    std::function<void()> listen{};    // called often; throws to stop
};

struct Links {
    /// For each picture and each disc seen in it, the track it belongs to, or −1.
    std::vector<std::vector<int>> track;
    std::vector<std::size_t> kind;  // of each track
    std::uint64_t rejected = 0;     // sure discs that would have been one too many
    std::uint64_t crowded = 0;      // frames with at least one of these
};

/// Throws std::invalid_argument unless every picture has a finite time later than the one before.
Links link_discs(const std::vector<std::vector<SeenDisc>>& pictures,
                 const std::vector<double>& times, const TrackedPath& path,
                 const LinkSettings& settings);

/// The column assigned to each row, or -1. As many pairs as possible are assigned, and of these
/// choices the one with the least sum of costs is taken. A cost that is not finite, or beyond
/// ±1e100, forbids its pair. Any shape; terminates for any costs. `listen` is called for each row.
std::vector<int> best_assignment(const std::vector<std::vector<double>>& cost,
                                 const std::function<void()>& listen = {});

}  // namespace swirl
