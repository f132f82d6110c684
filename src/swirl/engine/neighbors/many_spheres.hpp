// Speed only, changes no bit: the search for many spheres, or coins. On a floor everybody is
// predicted anew with every leg, so lists that last are not worth their making; whom a sphere may
// meet is looked up in cells, each time it is predicted.
//
// Time goes in stretches, none longer than a leg. From time t on, to the end of the stretch, a
// sphere to which nothing happens stays, seen from the floor with its constant velocity u, within
//
//     h = |v − u| (t_end − t) + ½ |a| (t_end − t)²
//
// of the place X where it is at t, its reach. Two with |X_i − X_k| > r_i + r_k + h_i + h_k do not
// meet in this stretch. What happens to a sphere gives it another X and h; so does the end of a
// stretch, to all of them. In the cells are the X, and the cells that can hold anybody in reach are
// those within r_i + h_i and the largest r + h that there has been.
//
// Short stretches predict too often, long ones look at too many. With h radii of reach some
// 4 φ (1 + h)² spheres are in reach at a packing φ; stretches are as long as makes that eight.
//
// The places are kept in single precision, and reaches are longer by what that may be wrong.
//
// Included by one file per vector width, like event_loop.hpp, and under the same rule.
#pragma once

#include "swirl/engine/neighbors/engine_state.hpp"
#include "swirl/engine/neighbors/engine_state_checks.hpp"
#include "swirl/engine/neighbors/prediction.hpp"
#include "swirl/engine/neighbors/sphere_contacts.hpp"
#include "swirl/engine/neighbors/tournament.hpp"
#include "swirl/engine/neighbors/verlet_skin.hpp"
#include "swirl/engine/pending_event.hpp"
#include "swirl/engine/resolve.hpp"
#include "swirl/math/lanes.hpp"

namespace swirl {
inline namespace SWIRL_TARGET {
namespace many_spheres {

using spheres::EightOthers, spheres::EightTimes;

/// The centre of the container at time 0, if it had always gone as in this leg; X counts from it.
SWIRL_INLINE Vec2 origin(const EngineState& state) {
    const Segment& segment = state.segments[state.segment];
    return segment.start - segment.begin * segment.velocity;
}

/// X and reach of sphere i from time t on, in its Skin.
SWIRL_INLINE void find_place(EngineState& state, std::uint32_t i, double t) {
    const Parabola<double> flight = Spheres::flight(state, i);
    const Vec2 u = state.segments[state.segment].velocity;
    const Vec2 X = flight.position_at(t) - t * u - origin(state);
    const double way = spheres::way_over_floor(flight.velocity_at(t), flight.acceleration, u,
                                               state.stretch_end - t);
    const double reach = way + 0x1p-20 * state.container_radius;
    Skin& mine = state.skins[i];
    mine.X = static_cast<float>(X.x);
    mine.Y = static_cast<float>(X.y);
    mine.skin_radius = static_cast<float>(reach * 1.000001);
    const double farthest = mine.skin_radius + state.discs[i].radius;
    state.largest_skin_radius = larger(state.largest_skin_radius, farthest);
}

SWIRL_INLINE void put(EightOthers& others, int lane, const EngineState& state, std::uint32_t k) {
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
    others.who[lane] = k;
}

/// Whom sphere i meets first in this stretch.
static PendingEvent predict_meeting(const EngineState& state, std::uint32_t i) {
    const Skin& mine = state.skins[i];
    const Grid& grid = state.grids[0];
    const double X = mine.X, Y = mine.Y, own = mine.skin_radius + state.discs[i].radius;
    const double way = own + state.largest_skin_radius;
    const std::uint32_t left = cell_row(state, grid, X - way),
                        right = cell_row(state, grid, X + way);
    const std::uint32_t top = cell_row(state, grid, Y + way);
    const EightTimes asks(state, i);
    PendingEvent first{never, i, 0};
    EightOthers others;
    int count = 0;
    const auto ask = [&] {
        for (int lane = count; lane < 8; ++lane) put(others, lane, state, others.who[0]);
        first = spheres::earlier_meeting(state, asks, others, count, first);
        count = 0;
    };
    for (std::uint32_t row = cell_row(state, grid, Y - way); row <= top; ++row) {
        const std::uint32_t* const heads = grid.heads + row * grid.cells_per_side;
        for (std::uint32_t column = left; column <= right; ++column) {
            for (std::uint32_t k = heads[column]; k != state.size;
                 k = state.skins[k].next_in_cell) {
                const Skin& other = state.skins[k];
                const double dx = other.X - X, dy = other.Y - Y;
                const double reach = own + other.skin_radius + state.discs[k].radius;
                if (dx * dx + dy * dy > reach * reach || k == i) continue;
                put(others, count++, state, k);
                if (count == 8) ask();
            }
        }
    }
    if (count > 0) ask();
    return first;
}

/// When sphere i is at the wall, if it can be in this stretch.
SWIRL_INLINE double predict_wall(const EngineState& state, std::uint32_t i) {
    const Skin& mine = state.skins[i];
    const double room = state.container_radius - state.discs[i].radius - mine.skin_radius;
    const double X = mine.X, Y = mine.Y;
    if (room > 0.0 && X * X + Y * Y < room * room) return never;
    return spheres::wall_time(state, i);
}

/// What sphere i, which has no event pending, does next.
[[gnu::noinline]] static void predict(EngineState& state, std::uint32_t i) {
    PendingEvent first = predict_meeting(state, i);
    const PendingEvent wall{predict_wall(state, i), i, i};
    const PendingEvent rolls{spheres::begins_to_roll_at(state, i), i, the_floor};
    if (precedes(wall, first)) first = wall;
    if (precedes(rolls, first)) first = rolls;
    insert<true>(state, first);
}

/// How long a stretch is worth while, were everybody as fast over the floor as they are on average.
static double stretch_worth_while(const EngineState& state, double t) {
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
    // A thousandth of the leg at least, so that it comes to its end.
    return larger(reach / square_root(squares / state.size), 0.001 * (segment.end - segment.begin));
}

/// From time t on, all is known anew.
static void begin_stretch(EngineState& state, double t) {
    ++state.full_rebuilds;
    state.stretch_end =
        smaller(state.segments[state.segment].end, t + stretch_worth_while(state, t));
    state.largest_skin_radius = 0.0;
    const Grid& grid = state.grids[0];
    empty_cells(state, grid);
    for (std::uint32_t i = 0; i < state.size; ++i) {
        if (state.stops_at(i)) return;
        find_place(state, i, t);
        enter_cell(state, i);
    }
    empty_queue(state);
    for (std::uint32_t i = 0; i < state.size; ++i) {
        if (state.stops_at(i)) return;
        predict(state, i);
    }
}

}  // namespace many_spheres

struct ManySpheres {
    using Bodies = Spheres;

    SWIRL_INLINE static void start(EngineState& state) {
        many_spheres::begin_stretch(state, state.clock);
    }
    SWIRL_INLINE static PendingEvent next(const EngineState& state) { return next_pending(state); }
    SWIRL_INLINE static void reschedule(EngineState& state, const PendingEvent& event) {
        ++state.invalidated;
        swirl::remove<true>(state, event.disc);
        many_spheres::predict(state, event.disc);
    }
    SWIRL_INLINE static PendingEvent remove(EngineState& state, const PendingEvent& event) {
        swirl::remove<true>(state, event);
        return event;
    }
    template <int D>
    SWIRL_INLINE static void predict_changed(EngineState& state, const std::uint32_t (&who)[D],
                                             double t) {
        for (const std::uint32_t i : who) {
            leave_cell(state, i);
            many_spheres::find_place(state, i, t);
            enter_cell(state, i);
        }
        for (const std::uint32_t i : who) many_spheres::predict(state, i);
    }
    SWIRL_INLINE static void segment_ended(EngineState& state, double) {
        many_spheres::begin_stretch(state, state.clock);
    }
    SWIRL_INLINE static void segment_ended(EngineState& state) {
        many_spheres::begin_stretch(state, state.stretch_end);
    }
    static void check(const EngineState& state, double t) {
        spheres::check(state, t);
        check_tournament(state);
    }
};

}  // namespace SWIRL_TARGET
}  // namespace swirl
