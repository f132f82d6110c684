// An observer of your own within the event loop, compiled as a contact law of your own is.
#include "swirl/engine/event_observer.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "engine/scenes.hpp"
#include "swirl/engine/own_law.hpp"
#include "swirl/engine/paper_scene.hpp"
#include "swirl/engine/simulation.hpp"

namespace swirl {
namespace {

struct Seen {
    std::uint64_t before = 0, after = 0;
    bool in_order = true;
    double announced = 0.0;  // the time of the next event
};

/// Counts the events. It stops the loop before event `stop_before`.
struct Counter {
    Seen* seen;
    std::uint64_t stop_before = ~std::uint64_t{0};

    bool before(const EngineState& state, double t) {
        seen->in_order &= t >= state.clock && seen->before == seen->after;
        if (seen->before == stop_before) return false;
        seen->announced = t;
        ++seen->before;
        return true;
    }
    void after(const EngineState&, const Event& event) {
        seen->in_order &= event.clock == seen->announced;
        ++seen->after;
    }
};
static_assert(EventObserver<Counter, EngineState>);

// A class that nearly matches is none.
struct BeforeReturnsNothing : Counter {
    void before(const EngineState&, double) {}
};
struct AfterWantsNoState {
    bool before(const EngineState&, double) { return true; }
    void after(const Event&) {}
};
struct CountsAfterOnly {
    void after(const EngineState&, const Event&) {}
};
static_assert(!EventObserver<BeforeReturnsNothing, EngineState>);
static_assert(!EventObserver<AfterWantsNoState, EngineState>);
static_assert(!EventObserver<CountsAfterOnly, EngineState>);

Counter counter{};  // that of the loop below

void run_counted(EngineState& shared, EventSpan& span, std::uint64_t count, std::int64_t to_periods,
                 double clock) {
    auto& state = static_cast<VerletLists::State&>(shared);
    run_observed<VerletLists>(state, counter, span, count, to_periods, clock);
}
const EventLoops counted_loops = {
    .lists = {baseline_name, start<VerletLists>, run_counted, observe<VerletLists>},
    .cells = {},
    .all_pairs = {},
    .all_pairs_up_to_packing = {},
    .few_spheres = {},
    .many_spheres = {}};

Simulation counted_simulation() {
    InitialState scene = paper_scene(20, 1.0, 3);
    scene.law = {.law = std::make_shared<int>(0), .surface_of = nullptr, .loops = &counted_loops};
    return Simulation(scene);
}

TEST(EventObserver, SeesEveryEventOnceAndInOrder) {
    Seen seen;
    counter = {&seen};
    Simulation observed = counted_simulation(), plain(paper_scene(20, 1.0, 3));
    observed.run(5'000);
    plain.run(5'000);
    EXPECT_EQ(seen.before, 5'000u);
    EXPECT_EQ(seen.after, 5'000u);
    EXPECT_TRUE(seen.in_order);
    EXPECT_EQ(observed.state_hash(), plain.state_hash());
}

TEST(EventObserver, StopsTheLoopBeforeAnEvent) {
    Seen seen;
    counter = {&seen, 1'234};
    Simulation observed = counted_simulation(), plain(paper_scene(20, 1.0, 3));
    observed.run(5'000);
    plain.run(1'234);
    EXPECT_EQ(seen.after, 1'234u);
    EXPECT_EQ(observed.state_hash(), plain.state_hash());
}

}  // namespace
}  // namespace swirl
