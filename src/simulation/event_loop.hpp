// The loop: take the event that comes first, execute it, predict again for those it changed.
//
// Each disc has one pending event, its earliest (Lubachevsky 1991; Smallenburg 2022). When i and k
// are due to meet, at least one of them, the one that changed last, has seen the other as it is
// now; so the soonest of all meetings is on somebody's card. A card whose partner has changed
// since, `changes` tells, is too early rather than too late: when its time comes, its owner
// predicts again.
//
// Each disc keeps the state it had after its last collision, at its own time, until the next; no
// prediction and no list touches it.
//
// Included by one file per vector width, and compiled with that width's instructions. So that the
// linker cannot mix them up, nothing in here may leave a symbol of its own: functions are inlined
// or static, and a test looks at the objects.
#pragma once

#include "swirl/simulation/resolve.hpp"
#include "swirl/simulation/search/state.hpp"
#include "swirl/simulation/search/tournament.hpp"

namespace swirl {
inline namespace SWIRL_TARGET {

/// Whether the disc's card is an event that happens.
SWIRL_INLINE bool is_due(const Machine& m, const Plan& plan) {
    return plan.partner < m.size && m.discs[plan.partner].changes == plan.partner_changes;
}

/// Writes a new card for a disc whose card is no event.
template <class Whom>
SWIRL_INLINE void renew_card(Machine& m, const Next& next) {
    const bool leaves = m.plan(next.disc).partner >= leaves_place;
    take_out(m, next.disc);
    if (leaves) {
        Whom::renew_place(m, next.disc, next.time);
    } else {
        ++m.stale;
        Whom::predict(m, next.disc, next.time);
    }
}

/// Brings the cards in order until the first one is an event that happens, and says when.
template <class Whom>
SWIRL_INLINE Next next_event(Machine& m) {
    for (;;) {
        const Next next = next_pending(m);
        if (next.time >= m.legs[m.leg].end) return {m.legs[m.leg].end, m.size};
        if (is_due(m, m.plan(next.disc))) return next;
        renew_card<Whom>(m, next);
    }
}

SWIRL_INLINE void take_out_both(Machine& m, std::uint32_t disc, std::uint32_t partner) {
    if (partner != disc) take_out(m, partner);
    take_out(m, disc);
}

/// If several events come at the same instant: their first, in order. The discs of the one that was
/// found have been taken out and are put back; those of the first are taken out.
template <class Whom>
[[gnu::noinline]] static Next first_of_simultaneous(Machine& m, const Next& found,
                                                    double partner_pending) {
    put_in(m, m.plan(found.disc).partner, partner_pending);
    put_in(m, found.disc, found.time);
    for (;;) {
        const Next next{found.time, first_of_equals(m, found.time, m.levels - 1, 0, m.size)};
        if (is_due(m, m.plan(next.disc))) {
            take_out_both(m, next.disc, m.plan(next.disc).partner);
            return next;
        }
        renew_card<Whom>(m, next);
    }
}

/// Takes the discs of an event out of the queue.
template <class Whom>
SWIRL_INLINE Next take_event(Machine& m, const Next& next) {
    const std::uint32_t partner = m.plan(next.disc).partner;
    const double partner_pending = pending_time(m, partner);
    take_out_both(m, next.disc, partner);
    if (next_pending(m).time == next.time) [[unlikely]]
        return first_of_simultaneous<Whom>(m, next, partner_pending);
    return next;
}

template <class Whom>
SWIRL_INLINE Event execute(Machine& m, const Next& due) {
    if (due.disc == m.size) return Whom::end_leg(m);
    m.clock = due.time;
    const Next next = take_event<Whom>(m, due);
    const std::uint32_t partner = m.plan(next.disc).partner;
    if (partner == next.disc) {
        const Event event = collide_with_wall(m, partner, next.time);
        Whom::template predict_changed<1>(m, {partner}, next.time);
        return event;
    }
    if (m.prefetches) prefetch_neighbours(m, partner);
    const std::uint32_t i = next.disc < partner ? next.disc : partner;
    const std::uint32_t j = next.disc < partner ? partner : next.disc;
    const Event event = collide_discs(m, i, j, next.time);
    Whom::template predict_changed<2>(m, {i, j}, next.time);
    return event;
}

template <class Whom>
static Event step(Machine& m) {
    return execute<Whom>(m, next_event<Whom>(m));
}

template <class Whom>
static std::uint64_t run(Machine& m, std::uint64_t count, std::int64_t swirls, double clock) {
    for (std::uint64_t done = 0; done < count; ++done) {
        const Next next = next_event<Whom>(m);
        if (m.swirls > swirls || (m.swirls == swirls && next.time > clock)) return done;
        execute<Whom>(m, next);
    }
    return count;
}

/// `Whom` says who may meet whom: Lists (verlet_lists.hpp) or Cells (linked_cells.hpp).
template <class Whom>
constexpr EventLoop event_loop(const char* width, void (*start)(Machine&)) {
    return {width, start, step<Whom>, run<Whom>};
}

}  // namespace SWIRL_TARGET
}  // namespace swirl
