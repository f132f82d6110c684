// Invariants of the discs and of every search (invariant.hpp). A check is as much work as the
// paper's method, so it is only done now and then.
#pragma once

#include "swirl/engine/collision_checks.hpp"
#include "swirl/engine/invariant.hpp"
#include "swirl/engine/neighbors/search_states.hpp"
#include "swirl/engine/pending_event.hpp"
#include "swirl/physics/contact_time.hpp"

namespace swirl {
inline namespace SWIRL_TARGET {

/// True at intervals of 64 + 4 N events, because the check is expensive with many discs.
SWIRL_INLINE bool is_time_to_check(const EngineState& state) {
    const std::uint64_t events = state.disc_disc + state.disc_wall + state.path_vertex;
    return events % (64 + 4 * static_cast<std::uint64_t>(state.size)) == 0;
}

/// The paper's method: compute the times of all events and take the earliest.
[[maybe_unused]] static PendingEvent first_of_all(const EngineState& state) {
    const Segment& segment = state.segments[state.segment];
    PendingEvent first{never, state.size, state.size};
    for (std::uint32_t i = 0; i < state.size; ++i) {
        const HotDisc& disc = state.discs[i];
        const double wall =
            time_of_wall_contact(disc.flight(), segment, state.container_radius - disc.radius);
        if (precedes({wall, i, i}, first)) first = {wall, i, i};
        for (std::uint32_t k = i + 1; k < state.size; ++k) {
            const HotDisc& other = state.discs[k];
            const double time =
                time_of_contact(disc.flight(), other.flight(), disc.radius + other.radius);
            if (precedes({time, i, k}, first)) first = {time, i, k};
        }
    }
    return segment.end <= first.time ? PendingEvent{segment.end, state.size, state.size} : first;
}

[[maybe_unused]] static void check_order(const EngineState& state, const PendingEvent& next) {
    invariant::time_never_goes_back(next.time >= state.clock);
    if (!is_time_to_check(state)) return;
    const PendingEvent first = first_of_all(state);
    invariant::the_next_event_is_the_first_of_all(next.time == first.time &&
                                                  next.first() == first.first() &&
                                                  next.second() == first.second());
}

/// True if two discs overlap at time t by more than rounding errors. These are the errors that an
/// earlier contact left, and the errors of a contact that was predicted not to happen.
[[maybe_unused]] static bool overlap(const EngineState& state, const HotDisc& i, const HotDisc& k,
                                     double t) {
    const Vec2 s = k.flight().position_at(t) - i.flight().position_at(t);
    const double contact = i.radius + k.radius;
    const double rounding =
        larger(state.largest_rounding, rounding_of_contact(i.flight(), k.flight(), contact, t));
    return square_root(dot(s, s)) < contact * (1.0 - allowed_rounding) - rounding;
}
/// True if a disc extends beyond the wall at time t by more than rounding errors.
[[maybe_unused]] static bool is_outside(const EngineState& state, const HotDisc& disc, double t) {
    const Segment& segment = state.segments[state.segment];
    const Vec2 s = disc.flight().position_at(t) - segment.position_at(t);
    const double distance = square_root(dot(s, s));
    const double rounding =
        larger(state.largest_rounding,
               rounding_of_wall_contact(disc.flight(), segment, state.container_radius, t));
    return distance + disc.radius > state.container_radius * (1.0 + allowed_rounding) + rounding;
}

[[maybe_unused]] static bool all_discs_are_apart(const EngineState& state, double t) {
    for (std::uint32_t i = 0; i < state.size; ++i) {
        if (is_outside(state, state.discs[i], t)) return false;
        for (std::uint32_t k = i + 1; k < state.size; ++k)
            if (overlap(state, state.discs[i], state.discs[k], t)) return false;
    }
    return true;
}

[[maybe_unused]] static void check_discs(const EngineState& state, double t) {
    if (state.overlapped_at_start) return;
    for (std::uint32_t i = 0; i < state.size; ++i) {
        invariant::no_disc_is_outside_the_container(!is_outside(state, state.discs[i], t));
        for (std::uint32_t k = i + 1; k < state.size; ++k)
            invariant::no_two_discs_overlap(!overlap(state, state.discs[i], state.discs[k], t));
    }
}

template <class State>
SWIRL_INLINE void check_tournament(const State& state) {
    const EventQueue& queue = state.queue;
    for (std::uint32_t level = 1; level < queue.levels; ++level) {
        const std::uint32_t rows = ((state.size - 1) >> (3 * level)) + 1;
        for (std::uint32_t row = 0; row < rows; ++row) {
            double first = never;
            for (std::uint32_t k = 8 * row; k < 8 * row + 8; ++k)
                first = smaller(first, queue.level_times[level - 1][k]);
            const std::uint32_t winner = queue.level_winners[level][row];
            invariant::winners_are_the_first_of_their_rows(queue.level_times[level][row] == first &&
                                                           queue.level_times[0][winner] == first);
        }
    }
    double first = never;
    for (std::uint32_t i = 0; i < state.size; ++i) first = smaller(first, queue.level_times[0][i]);
    invariant::the_first_event_is_stored(queue.first_time == first &&
                                         queue.level_times[0][queue.first_disc] == first);
}

SWIRL_INLINE bool is_on_list(const VerletListsState& state, std::uint32_t i, std::uint32_t k) {
    const std::uint32_t* const list = state.cold(i).neighbours();
    for (std::uint32_t slot = 0; slot < state.discs[i].list_length; ++slot)
        if (list[slot] == k) return true;
    if (state.tails == nullptr) return false;
    const ListTail& tail = state.tail(i);
    for (std::uint32_t slot = 0; slot < tail.length; ++slot)
        if (tail.neighbours()[slot] == k) return true;
    return false;
}
/// Offset of the disc from `centre`, a point of the co-moving frame, at time t.
SWIRL_INLINE Vec2 offset_in_frame(const ListsOrCellsState& state, std::uint32_t i,
                                  const Vec2& centre, double t) {
    return state.discs[i].flight().position_at(t) -
           state.comoving_frame.flight_of(centre).position_at(t);
}

[[maybe_unused]] static void check_lists(const VerletListsState& state, double t) {
    const Vec2 turn = state.comoving_frame.turn_at(t);
    const double scale = square_root(dot(turn, turn));
    for (std::uint32_t i = 0; i < state.size; ++i) {
        const Skin& skin = state.skins[i];
        const Vec2 offset = offset_in_frame(state, i, skin.centre(), t);
        invariant::discs_are_within_their_skins(square_root(dot(offset, offset)) <= skin.radius);
        for (std::uint32_t k = i + 1; k < state.size; ++k) {
            const Skin& other = state.skins[k];
            const double dx = scale * (double(other.X) - skin.X);
            const double dy = scale * (double(other.Y) - skin.Y);
            const double reach =
                state.discs[i].radius + state.discs[k].radius + double(skin.radius) + other.radius;
            const bool listed = is_on_list(state, i, k);
            invariant::neighbour_lists_are_symmetric(listed == is_on_list(state, k, i));
            invariant::neighbour_lists_are_complete(listed || dx * dx + dy * dy >= reach * reach);
        }
    }
}

/// A disc may be on the edge of its cell. It may be outside by the distance for the minimum wait in
/// linked_cells.hpp, and by the rounding of the cell's centre to single precision. Cells are wide
/// enough for that.
[[maybe_unused]] static void check_cells(const LinkedCellsState& state, double t) {
    const double half =
        0.5 / state.grid.cells_per_length * (1.0 + 1e-8) + 0x1p-22 * state.container_radius;
    for (std::uint32_t i = 0; i < state.size; ++i) {
        const CellPosition& position = state.positions[i];
        const Vec2 offset = offset_in_frame(state, i, position.centre(), t);
        const Cell& cell = state.cells[position.cell];
        bool found = false;
        for (std::uint32_t slot = 0; slot < cell.count; ++slot)
            found |= state.disc_in_cell(position.cell, slot) == i;
        for (std::uint32_t k = 0; k < state.unassigned_count; ++k)
            found |= state.unassigned[k] == i;
        const HotDisc& disc = state.discs[i];
        found &= disc.far_from_wall != 0 || state.near_wall[position.near_wall] == i;
        invariant::discs_are_in_their_cells(found && magnitude(offset.x) <= half &&
                                            magnitude(offset.y) <= half);
    }
}

[[maybe_unused]] static void check_columns(const AllPairsState& state) {
    const DiscColumns& all = state.columns;
    for (std::uint32_t i = 0; i < state.size; ++i) {
        const HotDisc& disc = state.discs[i];
        invariant::columns_are_copies_of_the_discs(
            all.x[i] == disc.position.x && all.y[i] == disc.position.y &&
            all.vx[i] == disc.velocity.x && all.vy[i] == disc.velocity.y &&
            all.time[i] == disc.time && all.radius[i] == disc.radius);
    }
}

}  // namespace SWIRL_TARGET
}  // namespace swirl
