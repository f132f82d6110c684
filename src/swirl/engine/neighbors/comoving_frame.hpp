// Speed only, changes no bit: the frame in which the skins rest (verlet_skin.hpp), and when it is
// renewed.
//
// Included by one file per vector width, like event_loop.hpp, and under the same rule.
#pragma once

#include "swirl/engine/neighbors/engine_state.hpp"
#include "swirl/engine/neighbors/prediction.hpp"
#include "swirl/engine/neighbors/verlet_skin.hpp"
#include "swirl/math/lanes.hpp"

namespace swirl {
inline namespace SWIRL_TARGET {

/// On a turning leg the frame is renewed this often per turn, as on the paper's polygon.
inline constexpr double stretches_per_turn = 30.0;

static void begin_stretch(EngineState& state, double t) {
    const Segment& segment = state.segments[state.segment];
    state.stretch_end = segment.end;
    if (segment.turning != 0.0)
        state.stretch_end =
            smaller(segment.end, t + 2.0 * pi / (stretches_per_turn * magnitude(segment.turning)));
}

/// How the discs move against the frame, at one time: their mean velocity, and how fast they turn
/// about their centre of mass.
struct MotionInFrame {
    Vec2 velocity, centre;
    double turning, inertia;
    double lag;     // twice the energy of that, for discs of mass 1
    double random;  // and of the rest, in which they all move as they like
};

template <int W>
SWIRL_INLINE double sum_of_lanes(const Lanes<W>& a) {
    double sum = lane(a, 0);
    for (int k = 1; k < W; ++k) sum = sum + lane(a, k);
    return sum;
}

static MotionInFrame motion_in_frame(const EngineState& state, double t) {
    using Eight = Lanes<8>;
    const ComovingFrame& frame = state.comoving_frame;
    const Vec2 origin = frame.origin.position_at(t);
    const Vec2 at_origin = frame.origin.velocity;
    const BasicVec2<Eight> rate = in_lanes<8>(frame.rate_at(t));
    const Eight zero(0.0);
    BasicVec2<Eight> momenta{zero, zero}, moments{zero, zero};
    Eight spins = zero, inertias = zero, squares = zero;
    for (std::uint32_t begin = 0; begin < state.size; begin += 8) {
        std::uint32_t who[8];
        alignas(64) double mass[8];
        for (std::uint32_t k = 0; k < 8; ++k) {
            const bool somebody = begin + k < state.size;
            who[k] = somebody ? begin + k : begin;
            mass[k] = somebody ? 1.0 : 0.0;
        }
        const Eight m = Eight::load(mass);
        const Flight<Eight> discs = load_others<8>(state, who).flight;
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
    const double turning = inertia > 0.0 ? spin / inertia : 0.0;
    const double together = dot(velocity, momentum) + turning * spin;
    return {velocity, origin + centre, turning,
            inertia,  together,        larger(sum_of_lanes(squares) - together, 0.0)};
}

/// A frame does not turn by more than this before it is renewed, so that what moves uniformly in it
/// stays near what turns.
inline constexpr double max_turn = 0.2;
/// Nor does it stretch distances by more than so many times; where it has by less, it is begun
/// again with the next swirl.
inline constexpr double max_stretch = 1.4, bearable_stretch = 1.2;
/// If the energy of the rotation is less than this, over that of the random motion, hardly any skin
/// would last longer, and all that is asked of the frame is less work where it has never turned.
inline constexpr double min_rotation = 0.01;

static bool pays_to_turn(const EngineState& state, const MotionInFrame& motion, double turning,
                         double t) {
    return turning * turning * motion.inertia > min_rotation * motion.random &&
           magnitude(turning) * (state.stretch_end - t) < max_turn &&
           state.comoving_frame.scale < max_stretch;
}

/// From time t on the co-moving frame has the discs' mean motion. The pack circles in the dish with
/// the swirl, and a large one turns about its centre, so this is where most discs stay near; and in
/// a large dish, where the wall is far, they do not follow the container at all. What was at rest
/// in it goes on from where it is.
static void renew_comoving_frame(EngineState& state, const MotionInFrame& motion, double t) {
    ComovingFrame& frame = state.comoving_frame;
    const Vec2 origin = frame.origin.position_at(t), rate = frame.rate_at(t);
    const Vec2 centre = motion.centre - origin;
    const Vec2 velocity = frame.origin.velocity + complex_product(rate, centre) + motion.velocity;
    double turning = rate.y + motion.turning;
    if (!pays_to_turn(state, motion, turning, t)) turning = 0.0;
    const Vec2 turn = frame.turn_at(t);
    frame = {{origin, velocity - turning * perpendicular(centre), t},
             turn,
             turning,
             square_root(dot(turn, turn)),
             frame.has_turned || turning != 0.0};
    state.rebuilds_in_frame = 0;
    state.events_when_asked = state.disc_disc + state.disc_wall;
}
/// The frame begins in the centre of the container, and nothing rests in it.
static void begin_comoving_frame(EngineState& state, double t) {
    const Segment& segment = state.segments[state.segment];
    begin_stretch(state, t);
    state.comoving_frame = {.origin = {segment.position_at(t), segment.velocity_at(t), t}};
    renew_comoving_frame(state, motion_in_frame(state, t), t);
}

/// Then lists would be rebuilt for ever: in a fast dish all have followed the container long before
/// the next leg.
static bool frame_is_left_behind(const EngineState& state, double t) {
    const MotionInFrame motion = motion_in_frame(state, t);
    return motion.lag > motion.random;
}

/// At a corner of the path the frame is renewed, and with it when each disc leaves its skin. Where
/// discs hardly follow the container, as in a thin dish, that is most of the work and changes
/// little; then it is left as it is. Nor is anybody asked whether they do while hardly anything has
/// happened. At time t a stretch has begun; says whether the frame is another.
inline constexpr double bearable_lag = 0.02;
inline constexpr std::uint32_t discs_per_event_till_asked = 4;
static bool renew_frame_if_left(EngineState& state, double t) {
    const ComovingFrame& frame = state.comoving_frame;
    const bool may_stay =
        magnitude(frame.turning) * (state.stretch_end - frame.origin.time) < max_turn;
    const std::uint64_t since = state.disc_disc + state.disc_wall - state.events_when_asked;
    if (may_stay && discs_per_event_till_asked * since < state.size) return false;
    const MotionInFrame motion = motion_in_frame(state, t);
    state.events_when_asked += since;
    if (may_stay && motion.lag < bearable_lag * motion.random) return false;
    renew_comoving_frame(state, motion, t);
    return true;
}

}  // namespace SWIRL_TARGET
}  // namespace swirl
