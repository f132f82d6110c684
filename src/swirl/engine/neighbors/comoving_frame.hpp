// Speed only; results stay bitwise identical. The co-moving frame (search_states.hpp), in which
// skins are at rest (verlet_skin.hpp): when it is renewed, and how it then moves.
#pragma once

#include "swirl/engine/neighbors/prediction.hpp"
#include "swirl/engine/neighbors/search_states.hpp"
#include "swirl/engine/neighbors/verlet_skin.hpp"
#include "swirl/math/lanes.hpp"

namespace swirl {
inline namespace SWIRL_TARGET {

/// How many times per turn the frame is renewed on an arc: as often as on the paper's polygon.
inline constexpr double intervals_per_turn = 30.0;

/// Sets the time until which the current predictions hold: the end of the segment, or on an arc the
/// next renewal of the frame.
static void begin_interval(VerletListsState& state, double t) {
    const Segment& segment = state.segments[state.segment];
    state.interval_end = segment.end;
    if (segment.turn_rate != 0.0)
        state.interval_end = smaller(
            segment.end, t + 2.0 * pi / (intervals_per_turn * magnitude(segment.turn_rate)));
}

/// The motion of the discs relative to the frame at one time: their mean velocity and rotation
/// about the centre of mass. Energies are for discs of mass 1.
struct MotionInFrame {
    Vec2 velocity, centre;
    double turn_rate, inertia;
    double lag;     // twice the energy of this common motion
    double random;  // twice the energy of all other motion
};

template <int W>
SWIRL_INLINE double sum_of_lanes(const Lanes<W>& a) {
    double sum = lane(a, 0);
    for (int k = 1; k < W; ++k) sum = sum + lane(a, k);
    return sum;
}

static MotionInFrame motion_in_frame(const ListsOrCellsState& state, double t) {
    using Eight = Lanes<8>;
    const ComovingFrame& frame = state.comoving_frame;
    const Vec2 origin = frame.origin.position_at(t);
    const Vec2 at_origin = frame.origin.velocity;
    const BasicVec2<Eight> rate = in_lanes<8>(frame.rate_at(t));
    const Eight zero(0.0);
    BasicVec2<Eight> momenta{zero, zero}, moments{zero, zero};
    Eight spins = zero, inertias = zero, squares = zero;
    for (std::uint32_t begin = 0; begin < state.size; begin += 8) {
        std::uint32_t ids[8];
        alignas(64) double mass[8];
        for (std::uint32_t k = 0; k < 8; ++k) {
            const bool exists = begin + k < state.size;
            ids[k] = exists ? begin + k : begin;
            mass[k] = exists ? 1.0 : 0.0;
        }
        const Eight m = Eight::load(mass);
        const Flight<Eight> discs = load_others<8>(state, ids).flight;
        const BasicVec2<Eight> y = discs.position_at(Eight(t)) - in_lanes<8>(origin);
        const BasicVec2<Eight> v =
            discs.velocity - in_lanes<8>(at_origin) - complex_product(rate, y);
        const BasicVec2<Eight> p = m * v;
        momenta = momenta + p;
        moments = moments + m * y;
        spins = spins + cross(y, p);
        inertias = inertias + m * dot(y, y);
        squares = squares + dot(v, p);
    }
    const Vec2 momentum{sum_of_lanes(momenta.x), sum_of_lanes(momenta.y)};
    const Vec2 moment{sum_of_lanes(moments.x), sum_of_lanes(moments.y)};
    const double share = 1.0 / state.size;
    const Vec2 velocity = share * momentum, centre = share * moment;
    const double spin = sum_of_lanes(spins) - cross(centre, momentum);
    const double inertia = sum_of_lanes(inertias) - dot(centre, moment);
    const double turn_rate = inertia > 0.0 ? spin / inertia : 0.0;
    const double together = dot(velocity, momentum) + turn_rate * spin;
    return {velocity, origin + centre, turn_rate,
            inertia,  together,        larger(sum_of_lanes(squares) - together, 0.0)};
}

/// The frame turns by at most this angle before it is renewed. A larger angle would separate what
/// moves uniformly in the frame from what turns.
inline constexpr double max_turn = 0.2;
/// The frame stretches distances by at most `max_stretch`. If they are stretched by more than
/// `max_stretch_at_period_end` when a period ends, a new frame begins.
inline constexpr double max_stretch = 1.4, max_stretch_at_period_end = 1.2;
/// Below this ratio of the rotation's energy to that of the random motion, turning the frame would
/// hardly make any skin last longer. A frame that has never turned needs less arithmetic.
inline constexpr double min_rotation = 0.01;

static bool pays_to_turn(const VerletListsState& state, const MotionInFrame& motion,
                         double turn_rate, double t) {
    return turn_rate * turn_rate * motion.inertia > min_rotation * motion.random &&
           magnitude(turn_rate) * (state.interval_end - t) < max_turn &&
           state.comoving_frame.scale < max_stretch;
}

/// From time t on the frame has the discs' mean motion. A cluster circles in the container, and a
/// large one turns about its own centre, so most discs stay near their place in this frame. In a
/// large container, where the wall is far, discs do not follow the container at all. Points at rest
/// in the old frame continue from where they are.
static void renew_comoving_frame(VerletListsState& state, const MotionInFrame& motion, double t) {
    ComovingFrame& frame = state.comoving_frame;
    const Vec2 origin = frame.origin.position_at(t), rate = frame.rate_at(t);
    const Vec2 centre = motion.centre - origin;
    const Vec2 velocity = frame.origin.velocity + complex_product(rate, centre) + motion.velocity;
    double turn_rate = rate.y + motion.turn_rate;
    if (!pays_to_turn(state, motion, turn_rate, t)) turn_rate = 0.0;
    const Vec2 turn = frame.turn_at(t);
    frame = {{origin, velocity - turn_rate * perpendicular(centre), t},
             turn,
             turn_rate,
             square_root(dot(turn, turn)),
             frame.has_turned || turn_rate != 0.0};
    state.rebuilds_in_frame = 0;
    state.collisions_at_frame_test = state.disc_disc + state.disc_wall;
}
/// Begins a new frame at the centre of the container. No skin is at rest in it yet.
static void begin_comoving_frame(VerletListsState& state, double t) {
    const Segment& segment = state.segments[state.segment];
    begin_interval(state, t);
    state.comoving_frame = {.origin = {segment.position_at(t), segment.velocity_at(t), t}};
    renew_comoving_frame(state, motion_in_frame(state, t), t);
}

/// True if the discs have left the frame, so that lists would be rebuilt without end. With a fast
/// container all discs follow it long before the next segment begins.
static bool frame_is_left_behind(const VerletListsState& state, double t) {
    const MotionInFrame motion = motion_in_frame(state, t);
    return motion.lag > motion.random;
}

/// At a path vertex (or when an interval ends) at time t, renews the frame if the discs have left
/// it. Returns whether it did; then each disc leaves its skin at another time. If discs hardly
/// follow the container, as in a dilute one, a renewal would be most of the work and change little:
/// the frame stays while lag/random is below `max_lag`. If hardly any events have happened, the
/// motion is not even measured.
inline constexpr double max_lag = 0.02;
inline constexpr std::uint32_t discs_per_event_at_test = 4;
static bool renew_frame_if_left(VerletListsState& state, double t) {
    const ComovingFrame& frame = state.comoving_frame;
    const bool may_remain =
        magnitude(frame.turn_rate) * (state.interval_end - frame.origin.time) < max_turn;
    const std::uint64_t since = state.disc_disc + state.disc_wall - state.collisions_at_frame_test;
    if (may_remain && discs_per_event_at_test * since < state.size) return false;
    const MotionInFrame motion = motion_in_frame(state, t);
    state.collisions_at_frame_test += since;
    if (may_remain && motion.lag < max_lag * motion.random) return false;
    renew_comoving_frame(state, motion, t);
    return true;
}

}  // namespace SWIRL_TARGET
}  // namespace swirl
