// Each test violates one of the engine's invariants (invariant.hpp); the program must stop in the
// function of that name. All other tests of this layer check the invariants of valid runs, in the
// build with checks.
#include "swirl/engine/invariant.hpp"

#include <gtest/gtest.h>

#include <utility>

#include "engine/scenes.hpp"
#include "swirl/engine/neighbors/engine_state_checks.hpp"

#if defined(SWIRL_INTERNAL_CHECKS)

// The sanitizer's stack trace contains the name of the invariant. This option turns the trace on;
// the sanitizer's library must be able to find it.
extern "C" __attribute__((visibility("default"))) const char* __asan_default_options() {
    return "handle_sigill=1";
}

namespace swirl {
namespace {

class InvariantViolation : public ::testing::Test {
  protected:
    InvariantViolation() { GTEST_FLAG_SET(death_test_style, "threadsafe"); }
};

void run(const InitialState& initial, const Progress& progress = {}) {
    for (const Width width : {Width::baseline, Width::avx2, Width::avx512})
        if (has_width(width)) Simulation(initial, progress, {0, width}).run(1000);
}

/// Runs a scene that the constructor would reject. A caller that has stopped the construction gets
/// no validation; this one has stopped it only for the first question.
void run_unvalidated(const InitialState& initial) {
    for (const Width width : {Width::baseline, Width::avx2, Width::avx512}) {
        if (!has_width(width)) continue;
        Tuning tuning{0, width};
        tuning.is_stopped = [asked = false]() mutable { return !std::exchange(asked, true); };
        Simulation(initial, {}, tuning).run(1000);
    }
}

TEST_F(InvariantViolation, ValidRunPasses) { run(paper_container(28)); }

TEST_F(InvariantViolation, GainOfEnergyIsDetected) {
    InitialState initial = paper_container(28);
    initial.disc_surface.restitution = 1.5;
    EXPECT_DEATH(run_unvalidated(initial), "energy_never_grows");
    initial = paper_container(5);
    initial.wall_surface.restitution = 1.5;
    EXPECT_DEATH(run_unvalidated(initial), "energy_never_grows");
}

TEST_F(InvariantViolation, NegativeFrictionIsDetected) {
    InitialState initial = paper_container(28);
    initial.disc_surface.mu = -0.5;
    EXPECT_DEATH(run_unvalidated(initial), "friction_obeys_coulombs_law");
}

TEST_F(InvariantViolation, EventBeforeTheClockIsDetected) {
    // The discs touch at time 5. At the clock they have passed through each other, and the scene is
    // valid again.
    InitialState two = gas_at_rest(60, 0.3);
    two.discs.resize(2);
    two.discs[0].position = {-6.0, 0.0};
    two.discs[0].velocity = {1.0, 0.0};
    two.discs[1].position = {6.0, 0.0};
    two.discs[1].velocity = {-1.0, 0.0};
    Progress late;
    late.clock = 9.0;
    EXPECT_DEATH(run(two, late), "time_never_goes_back");
}

/// Two discs with neighbour lists: the smallest state that can be corrupted.
struct TwoDiscs {
    alignas(64) double times[8], top_times[8];
    std::uint32_t winners[8];
    HotDisc discs[3];
    struct {
        ColdDisc cold;
        std::uint32_t neighbours[4];
    } cold[3];
    Skin skins[2];
    Segment segment{0.0, 10.0, {0.0, 0.0}, {0.0, 0.0}, 0.0};
    VerletListsState state{};

    TwoDiscs() {
        for (std::uint32_t i = 0; i < 8; ++i) times[i] = top_times[i] = never, winners[i] = 0;
        for (std::uint32_t i = 0; i < 2; ++i) {
            discs[i] = {{3.0 * i, 0.0}, {0.0, 0.0}, 0.0, 1.0, 0.0, 0, 0, 1, 0};
            cold[i] = {{no_event, 0, 0.0}, {1 - i, 2, 2, 2}};
            skins[i] = {static_cast<float>(3.0 * i), 0.0f, 0.6f, 2};
            times[i] = 1.0 + i;
        }
        top_times[0] = 1.0;
        state.size = 2;
        state.list_capacity = 4;
        state.cold_bytes = sizeof cold[0];
        state.discs = discs;
        state.cold_discs = reinterpret_cast<unsigned char*>(cold);
        state.skins = skins;
        state.queue.levels = 2;
        state.queue.top_rows = 1;
        state.queue.first_time = 1.0;
        state.queue.level_times[0] = times;
        state.queue.level_times[1] = top_times;
        state.queue.level_winners[1] = winners;
        state.segments = &segment;
        state.segment_count = 1;
        state.container_radius = 10.0;
    }
    void check() const {
        check_lists(state, 0.0);
        check_tournament(state);
        check_discs(state, 0.0);
    }
};

TEST_F(InvariantViolation, ValidListsPass) { TwoDiscs().check(); }

TEST_F(InvariantViolation, AsymmetricListIsDetected) {
    TwoDiscs two;
    two.discs[1].list_length = 0;
    EXPECT_DEATH(two.check(), "neighbour_lists_are_symmetric");
}
TEST_F(InvariantViolation, MissingNeighbourIsDetected) {
    TwoDiscs two;
    two.discs[0].list_length = two.discs[1].list_length = 0;
    EXPECT_DEATH(two.check(), "neighbour_lists_are_complete");
}
TEST_F(InvariantViolation, DiscOutsideItsSkinIsDetected) {
    TwoDiscs two;
    two.discs[1].position.y = 0.7;
    EXPECT_DEATH(two.check(), "discs_are_within_their_skins");
}
TEST_F(InvariantViolation, WrongWinnerOfARowIsDetected) {
    TwoDiscs two;
    two.winners[0] = 1;
    EXPECT_DEATH(two.check(), "winners_are_the_first_of_their_rows");
}
TEST_F(InvariantViolation, WrongFirstEventIsDetected) {
    TwoDiscs two;
    two.state.queue.first_disc = 1;
    EXPECT_DEATH(two.check(), "the_first_event_is_stored");
}
TEST_F(InvariantViolation, OverlapIsDetected) {
    TwoDiscs two;
    two.discs[0].position.x = 0.5;
    two.discs[1].position.x = 2.49;
    EXPECT_DEATH(two.check(), "no_two_discs_overlap");
}
TEST_F(InvariantViolation, DiscOutsideTheContainerIsDetected) {
    TwoDiscs two;
    two.state.container_radius = 3.9;
    EXPECT_DEATH(two.check(), "no_disc_is_outside_the_container");
}
TEST_F(InvariantViolation, CollisionAtADistanceIsDetected) {
    const Body before{{0.0, 0.0}, 0.0, 1.0, 1.0, 1.0};
    const Collided still{before, before, {0.0, 0.0}};
    EXPECT_DEATH(check_disc_collision(still, still, {2.1, 0.0}, {}, {}, 0.0, false),
                 "discs_touch_at_contact");
}
TEST_F(InvariantViolation, WrongWorkOfAnImpulseIsDetected) {
    const Body before{{1.0, 0.0}, 0.0, 1.0, 1.0, 1.0}, after{{0.5, 0.0}, 0.0, 1.0, 1.0, 1.0};
    // One of two bodies loses momentum and energy without an impulse.
    EXPECT_DEATH(check_disc_collision({before, after, {0.0, 0.0}}, {before, before, {0.0, 0.0}},
                                      {2.0, 0.0}, {}, {}, 0.0, false),
                 "energy_changes_by_the_work_of_the_impulses");
}

}  // namespace
}  // namespace swirl

#else

namespace swirl {
TEST(InternalChecks, AreNotCompiledIntoTheReleaseBuild) { EXPECT_FALSE(internal_checks); }
}  // namespace swirl

#endif
