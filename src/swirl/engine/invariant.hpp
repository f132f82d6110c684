// The engine's invariants. They are checked while it runs if SWIRL_INTERNAL_CHECKS is defined
// (CMake preset `sanitize`); otherwise none of this is compiled.
//
// Each invariant is a function that takes whether it holds, and stops the program if it does not.
// The engine does not print. The stack trace of a sanitizer or debugger shows which invariant was
// violated: its top frame is the function of that name.
#pragma once

namespace swirl {

#if defined(SWIRL_INTERNAL_CHECKS)
inline constexpr bool internal_checks = true;
#else
inline constexpr bool internal_checks = false;
#endif

namespace invariant {

#define SWIRL_INVARIANT(name)                                      \
    [[gnu::noinline, maybe_unused]] static void name(bool holds) { \
        if (!holds) __builtin_trap();                              \
    }
// In a collision.
SWIRL_INVARIANT(discs_touch_at_contact)
SWIRL_INVARIANT(momentum_is_conserved)
SWIRL_INVARIANT(angular_momentum_is_conserved)
SWIRL_INVARIANT(energy_never_grows)
SWIRL_INVARIANT(energy_changes_by_the_work_of_the_impulses)
SWIRL_INVARIANT(friction_obeys_coulombs_law)
// In the order of events.
SWIRL_INVARIANT(time_never_goes_back)
SWIRL_INVARIANT(the_next_event_is_the_first_of_all)
SWIRL_INVARIANT(winners_are_the_first_of_their_rows)
SWIRL_INVARIANT(the_first_event_is_stored)
// For all discs and the search.
SWIRL_INVARIANT(no_two_discs_overlap)
SWIRL_INVARIANT(no_disc_is_outside_the_container)
SWIRL_INVARIANT(discs_are_within_their_skins)
SWIRL_INVARIANT(neighbour_lists_are_symmetric)
SWIRL_INVARIANT(neighbour_lists_are_complete)
SWIRL_INVARIANT(discs_are_in_their_cells)
SWIRL_INVARIANT(columns_are_copies_of_the_discs)
#undef SWIRL_INVARIANT

}  // namespace invariant
}  // namespace swirl
