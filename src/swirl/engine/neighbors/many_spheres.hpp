// Speed only; results stay bitwise identical. The search for many spheres, or coins. On a floor all
// spheres are predicted again with every segment, so lists would not last long enough to be worth
// building. Each prediction finds the spheres that a sphere may collide with in cells.
//
// Time is divided into intervals, none longer than a segment. Seen from the floor, which moves with
// the constant velocity u, a sphere without an event stays from time t to the end of the interval
// within its reach
//
//     h = |v − u| (t_end − t) + ½ |a| (t_end − t)²
//
// of its position X at t. Two spheres with |X_i − X_k| > r_i + r_k + h_i + h_k do not collide in
// this interval. An event of a sphere gives it new values of X and h; the end of an interval does
// so for all spheres. Cells hold spheres by their X. All spheres in reach are in cells that are
// nearer than r_i + h_i plus the largest r + h so far.
//
// Short intervals predict too often, long ones test too many spheres. With a reach of h radii,
// about 4 φ (1 + h)² spheres are in reach at packing fraction φ. Intervals are chosen to make that
// eight.
//
// X and h are stored in single precision, and h is enlarged by the possible error.
#pragma once

#include "swirl/engine/neighbors/disc_grid.hpp"
#include "swirl/engine/neighbors/engine_state_checks.hpp"
#include "swirl/engine/neighbors/event_queue.hpp"
#include "swirl/engine/neighbors/neighbor_search.hpp"
#include "swirl/engine/neighbors/search_states.hpp"
#include "swirl/engine/neighbors/sphere_contacts.hpp"
#include "swirl/engine/pending_event.hpp"
#include "swirl/engine/resolve.hpp"
#include "swirl/math/lanes.hpp"

namespace swirl {
inline namespace SWIRL_TARGET {
namespace many_spheres {

using spheres::EightOthers, spheres::EightTimes;

/// The container's centre at time 0 if it had always moved as on this segment. X is relative to it.
SWIRL_INLINE Vec2 origin(const ManySpheresState& state) {
    const Segment& segment = state.segments[state.segment];
    return segment.start - segment.begin * segment.velocity;
}

/// Stores X and the reach of sphere i from time t on, in its Skin.
SWIRL_INLINE void update_reach(ManySpheresState& state, std::uint32_t i, double t) {
    const Parabola<double> flight = Spheres::flight(state, i);
    const Vec2 u = state.segments[state.segment].velocity;
    const Vec2 X = flight.position_at(t) - t * u - origin(state);
    const double distance = spheres::max_distance_over_floor(
        flight.velocity_at(t), flight.acceleration, u, state.interval_end - t);
    const double reach = distance + 0x1p-20 * state.container_radius;
    Skin& mine = state.skins[i];
    mine.X = static_cast<float>(X.x);
    mine.Y = static_cast<float>(X.y);
    mine.radius = static_cast<float>(reach * 1.000001);
    const double farthest = mine.radius + state.discs[i].radius;
    state.largest_reach = larger(state.largest_reach, farthest);
}

SWIRL_INLINE void put(EightOthers& others, int lane, const ManySpheresState& state,
                      std::uint32_t k) {
    const HotDisc& d = state.discs[k];
    const FloorMotion& motion = state.spheres[k].motion;
    others.x[lane] = d.position.x;
    others.y[lane] = d.position.y;
    others.vx[lane] = d.velocity.x;
    others.vy[lane] = d.velocity.y;
    others.ax[lane] = motion.acceleration.x;
    others.ay[lane] = motion.acceleration.y;
    others.time[lane] = d.time;
    others.radius[lane] = d.radius;
    others.rolls[lane] = motion.begins_to_roll;
    others.ids[lane] = k;
}

/// The first contact of sphere i within this interval.
static PendingEvent predict_contact(const ManySpheresState& state, std::uint32_t i) {
    const Skin& mine = state.skins[i];
    const DiscGrid& grid = state.grid;
    const double X = mine.X, Y = mine.Y, own = mine.radius + state.discs[i].radius;
    const double distance = own + state.largest_reach;
    const std::uint32_t left = grid.row_of(X - distance), right = grid.row_of(X + distance);
    const std::uint32_t top = grid.row_of(Y + distance);
    const EightTimes sphere(state, i);
    PendingEvent first{never, i, 0};
    EightOthers others;
    int count = 0;
    const auto flush = [&] {
        for (int lane = count; lane < 8; ++lane) put(others, lane, state, others.ids[0]);
        first = spheres::earlier_contact(state, sphere, others, count, first);
        count = 0;
    };
    for (std::uint32_t row = grid.row_of(Y - distance); row <= top; ++row) {
        const std::uint32_t* const heads = grid.heads + row * grid.cells_per_side;
        for (std::uint32_t column = left; column <= right; ++column) {
            for (std::uint32_t k = heads[column]; k != state.size;
                 k = state.skins[k].next_in_cell) {
                const Skin& other = state.skins[k];
                const double dx = other.X - X, dy = other.Y - Y;
                const double reach = own + other.radius + state.discs[k].radius;
                if (dx * dx + dy * dy > reach * reach || k == i) continue;
                put(others, count++, state, k);
                if (count == 8) flush();
            }
        }
    }
    if (count > 0) flush();
    return first;
}

/// When sphere i reaches the wall, if that is possible within this interval.
SWIRL_INLINE double predict_wall(const ManySpheresState& state, std::uint32_t i) {
    const Skin& mine = state.skins[i];
    const double limit = state.container_radius - state.discs[i].radius - mine.radius;
    const double X = mine.X, Y = mine.Y;
    if (limit > 0.0 && X * X + Y * Y < limit * limit) return never;
    return spheres::wall_time(state, i);
}

/// Predicts the next event of sphere i, which has none pending.
[[gnu::noinline]] static void predict(ManySpheresState& state, std::uint32_t i) {
    PendingEvent first = predict_contact(state, i);
    const PendingEvent wall{predict_wall(state, i), i, i};
    const PendingEvent rolls{spheres::begins_to_roll_at(state, i), i, the_floor};
    if (precedes(wall, first)) first = wall;
    if (precedes(rolls, first)) first = rolls;
    insert<true>(state, first);
}

/// The best length of an interval, if all spheres had the mean speed relative to the floor.
static double best_interval(const ManySpheresState& state, double t) {
    const Segment& segment = state.segments[state.segment];
    double squares = 0.0, areas = 0.0;
    for (std::uint32_t i = 0; i < state.size; ++i) {
        const Vec2 v = Spheres::flight(state, i).velocity_at(t) - segment.velocity;
        squares += dot(v, v);
        areas += state.discs[i].radius * state.discs[i].radius;
    }
    const double packing = areas / (state.container_radius * state.container_radius);
    const double radius = square_root(areas / state.size);
    const double reach = radius * larger(square_root(2.0 / packing) - 1.0, 0.25);
    // At least a thousandth of the segment, so that its end is reached.
    return larger(reach / square_root(squares / state.size), 0.001 * (segment.end - segment.begin));
}

/// Begins an interval at time t: all spheres are predicted again.
static void begin_interval(ManySpheresState& state, double t) {
    ++state.full_rebuilds;
    state.interval_end = smaller(state.segments[state.segment].end, t + best_interval(state, t));
    state.largest_reach = 0.0;
    const DiscGrid& grid = state.grid;
    empty_cells(state, grid);
    for (std::uint32_t i = 0; i < state.size; ++i) {
        if (state.stops_at(i)) return;
        update_reach(state, i, t);
        enter_cell(state, state.grid, i);
    }
    clear_queue(state);
    for (std::uint32_t i = 0; i < state.size; ++i) {
        if (state.stops_at(i)) return;
        predict(state, i);
    }
}

}  // namespace many_spheres

struct ManySpheres {
    using State = ManySpheresState;
    using Bodies = Spheres;

    SWIRL_INLINE static void start(ManySpheresState& state) {
        many_spheres::begin_interval(state, state.clock);
    }
    SWIRL_INLINE static PendingEvent next(const ManySpheresState& state) {
        return next_pending(state);
    }
    SWIRL_INLINE static void reschedule(ManySpheresState& state, const PendingEvent& event) {
        ++state.invalidated;
        swirl::remove<true>(state, event.disc);
        many_spheres::predict(state, event.disc);
    }
    SWIRL_INLINE static PendingEvent remove(ManySpheresState& state, const PendingEvent& event) {
        swirl::remove<true>(state, event);
        return event;
    }
    template <int D>
    SWIRL_INLINE static void predict_changed(ManySpheresState& state, const std::uint32_t (&ids)[D],
                                             double t) {
        for (const std::uint32_t i : ids) {
            leave_cell(state, state.grid, i);
            many_spheres::update_reach(state, i, t);
            enter_cell(state, state.grid, i);
        }
        for (const std::uint32_t i : ids) many_spheres::predict(state, i);
    }
    SWIRL_INLINE static void segment_ended(ManySpheresState& state, double) {
        many_spheres::begin_interval(state, state.clock);
    }
    SWIRL_INLINE static void interval_ended(ManySpheresState& state) {
        many_spheres::begin_interval(state, state.interval_end);
    }
    static void check(const ManySpheresState& state, double t) {
        spheres::check(state, t);
        check_tournament(state);
    }
};
static_assert(NeighborSearch<ManySpheres> && RenewsWithinSegment<ManySpheres>);

}  // namespace SWIRL_TARGET
}  // namespace swirl
