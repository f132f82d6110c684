#include "swirl/engine/reference.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "baselines/all_pairs.hpp"
#include "baselines/neighbor_lists.hpp"
#include "engine/plain_grid.hpp"
#include "engine/same_trajectory.hpp"
#include "engine/scenes.hpp"

namespace swirl {
namespace {

class EveryWidth : public OfEveryWidth {
  protected:
    Tuning tuning(int cells = 0) const { return {cells, GetParam()}; }
    Tuning tuning(NeighbourSearch neighbours) const { return {0, GetParam(), neighbours}; }
};

/// The same discs in a dish that is swirled on a true circle.
InitialState on_circle(InitialState scene, double amplitude = paper_amplitude) {
    const Segment before = scene.path.segments[0];
    scene.path = circular_path(amplitude, paper_period);
    const Segment& segment = scene.path.segments[0];
    for (Disc& disc : scene.discs) {
        disc.position = disc.position + (segment.start - before.start);
        disc.velocity = disc.velocity + (segment.velocity - before.velocity);
    }
    return scene;
}

// Without a grid (0 cells), a few discs go by all pairs; one cell has neighbour lists.
TEST_P(EveryWidth, EngineIsTheReferenceBitForBitInThePaperDish) {
    for (const std::size_t n : {1u, 2u, 5u, 28u, 48u})
        expect_same_trajectory(paper_container(n), 100000, tuning());
}
TEST_P(EveryWidth, EngineIsTheReferenceBitForBitAtEveryNumberOfVectors) {
    for (const std::size_t n : {8u, 9u, 16u, 17u, 24u, 25u, 32u, 33u, 40u, 41u})
        expect_same_trajectory(paper_container(n), 3000, tuning());
}
// Their times are one row, two, four of which one is no_disc's, four, six and eight.
TEST_P(EveryWidth, EngineIsTheReferenceBitForBitWithListsWhereDiscsAreFew) {
    for (const std::size_t n : {1u, 2u, 5u, 12u, 20u, 28u, 40u, 52u})
        expect_same_trajectory(paper_container(n), 20000, tuning(1));
}
// A second level has two rows, four, six and eight.
TEST_P(EveryWidth, EngineIsTheReferenceBitForBitWithListsWhateverTheRowsOnTop) {
    for (const std::size_t n : {100u, 200u, 300u, 500u})
        expect_same_trajectory(gas_at_rest(n, 0.7), 400, tuning());
}
TEST_P(EveryWidth, EngineIsTheReferenceBitForBitWithoutFriction) {
    expect_same_trajectory(paper_container(40, 0.0, 0.0), 30000, tuning());
}
TEST_P(EveryWidth, EngineIsTheReferenceBitForBitForAMixture) {
    expect_same_trajectory(mixture_container(), 100000, tuning());
    expect_same_trajectory(mixture_container(), 30000, tuning(3));
    expect_same_trajectory(mixture_container(20), 30000, tuning());
}
TEST_P(EveryWidth, EngineIsTheReferenceBitForBitOnTheExactCircle) {
    for (const std::size_t n : {1u, 2u, 5u, 28u, 48u}) {
        const InitialState scene = on_circle(paper_container(n));
        expect_same_trajectory(scene, 10000, tuning());
        expect_same_trajectory(scene, 5000, tuning(1));
    }
    // With a grid, with discs that do not come near the wall, and with smooth ones, which slide
    // along it for long.
    expect_same_trajectory(on_circle(state_of({unit_disc()}, 200, 18.0, still_path(1.0), 1.0, 1.0)),
                           5000, tuning());
    expect_same_trajectory(on_circle(mixture_container()), 10000, tuning(3));
    expect_same_trajectory(on_circle(paper_container(20, 0.0, 0.0)), 10000, tuning());
}
// There the frame of the skins outlasts the corners; in the second, which shakes its discs together
// first, only at times.
TEST_P(EveryWidth, EngineIsTheReferenceBitForBitWithListsInAThinDish) {
    const int events = sanitized ? 500 : 5000;
    for (const double container_radius : {45.0, 18.0}) {
        const InitialState thin =
            state_of({unit_disc()}, 101, container_radius,
                     polygon_path(paper_amplitude, paper_period, paper_sides), 1.0, 1.0, 1.0);
        expect_same_trajectory(thin, events, tuning(NeighbourSearch::lists));
        expect_same_trajectory(on_circle(thin), events, tuning(NeighbourSearch::lists));
    }
}
// Centres of skins are in single precision. Driven far, discs are soon where that is coarser than a
// narrow skin is wide; and in a dish of ten million radii it is so everywhere.
TEST_P(EveryWidth, EngineIsTheReferenceBitForBitWithListsInADishMuchWiderThanItsDiscs) {
    Disc grain = unit_disc();
    grain.radius = 1e-6;
    for (const double container_radius : {0.03651, 10.0}) {
        const InitialState wide =
            state_of({grain}, 48, container_radius,
                     polygon_path(paper_amplitude, paper_period, paper_sides), 1.0, 1.0);
        expect_same_trajectory(wide, 1500, tuning(NeighbourSearch::lists));
    }
    // A crystal that melts: more discs within a rounding error than a list has room for elsewhere.
    InitialState heap = state_of({unit_disc()}, 48, 1e7, still_path(1.0), 1.0, 1.0, 0.1);
    for (std::size_t i = 0; i < heap.discs.size(); ++i)
        heap.discs[i].position = {3e6 + 2.001 * static_cast<double>(i % 7),
                                  2e6 + 2.001 * static_cast<double>(i / 7)};
    expect_same_trajectory(heap, 300, tuning(NeighbourSearch::lists));
}
// Far from the origin positions are known less well; a small turn is a long way.
TEST_P(EveryWidth, EngineIsTheReferenceBitForBitOnLongAndShortCircles) {
    for (const double amplitude : {1e-3, 30.0, 1e6}) {
        for (const std::size_t n : {28u, 48u}) {
            const InitialState scene = on_circle(paper_container(n), amplitude);
            expect_same_trajectory(scene, sanitized ? 500 : 3000, tuning());
            Simulation simulation(scene);
            double deepest = 0.0;
            for (int event = 0; event < 3000; ++event)
                deepest = larger(deepest, simulation.step().overlap);
            EXPECT_LT(deepest, 1e-13 * (amplitude + scene.container_radius)) << amplitude;
        }
    }
}
TEST_P(EveryWidth, EngineIsTheReferenceBitForBitWithRestitution) {
    InitialState scene = paper_container(40);
    scene.disc_surface = {0.5, 0.9, 0.4, 1e-3};
    scene.wall_surface = {0.8, 0.8, 0.2, 1e-3};
    expect_same_trajectory(scene, 30000, tuning());
    // Discs that stay together when they meet may meet again at once.
    InitialState sticky = paper_container(28);
    sticky.disc_surface = sticky.wall_surface = {1.0, 0.0, 0.0, 0.05};
    expect_same_trajectory(sticky, 30000, tuning());
}
TEST_P(EveryWidth, EngineIsTheReferenceBitForBitInAGas) {
    for (const NeighbourSearch neighbours : {NeighbourSearch::lists, NeighbourSearch::cells}) {
        expect_same_trajectory(gas_at_rest(200, 0.6), 8000, tuning(neighbours));
        expect_same_trajectory(gas_at_rest(200, 0.05), 4000, tuning(neighbours));
    }
}
/// Turns all discs about the centre of the dish, as if they were one body.
InitialState turning(InitialState scene, double angular_velocity) {
    for (Disc& disc : scene.discs) {
        const Vec2 from_centre = disc.position - scene.path.segments[0].start;
        disc.velocity = disc.velocity + angular_velocity * perpendicular(from_centre);
    }
    return scene;
}
// The frame of the skins turns with the pack, and stretches all distances while it does: where it
// is fast by a fiftieth with each leg, so that after ten it is begun again; and it does not turn
// where that would be too far in one leg.
TEST_P(EveryWidth, EngineIsTheReferenceBitForBitWithListsInAPackThatTurns) {
    const int events = sanitized ? 1500 : 6000;
    const InitialState pack = state_of({unit_disc()}, 41, 8.0, still_path(1.0), 0.0, 0.0, 0.1);
    for (const double angular_velocity : {0.02, -0.19, 1.0})
        for (const int cells : {1, 3})
            expect_same_trajectory(turning(pack, angular_velocity), events, tuning(cells));
    expect_same_trajectory(turning(mixture_container(), 0.1), events, tuning(3));
    expect_same_trajectory(on_circle(turning(paper_container(41, 0.3, 0.0), -0.1)), events,
                           tuning(3));
    expect_same_trajectory(turning(large_among_small(3, 100, 0.3, 5.5), 0.2), events / 4, tuning());
}
// In a frame that did not turn, the discs would fly ten times as fast as among each other; each
// list would be rebuilt three times. What the wall does to those beside it is left.
TEST(TurningPack, HardlyAnyListIsRebuilt) {
    const InitialState pack = state_of({unit_disc()}, 500, 28.0, still_path(1.0), 0.0, 0.0, 0.1);
    for (const double angular_velocity : {0.0, 0.02}) {
        Simulation simulation(turning(pack, angular_velocity));
        simulation.advance_to(8, 0.0);
        EXPECT_LT(simulation.loop_counts().list_rebuilds, 50u) << angular_velocity;
    }
}
// Over several swirls.
TEST_P(EveryWidth, EngineIsTheReferenceBitForBitWithCellsInThePaperDish) {
    for (const std::size_t n : {1u, 5u, 48u})
        expect_same_trajectory(paper_container(n), 20000, tuning(NeighbourSearch::cells));
    InitialState dissipative = paper_container(40);
    dissipative.disc_surface = {0.5, 0.9, 0.4, 1e-3};
    expect_same_trajectory(dissipative, 20000, tuning(NeighbourSearch::cells));
}
TEST_P(EveryWidth, EngineIsTheReferenceBitForBitWithCellsForUnequalDiscs) {
    Disc large = unit_disc();
    large.radius = 1.7;
    const InitialState two_sizes =
        state_of({unit_disc(), large}, 60, 20.0,
                 polygon_path(paper_amplitude, paper_period, paper_sides), 0.7, 0.4);
    expect_same_trajectory(two_sizes, 20000, tuning(NeighbourSearch::cells));
    expect_same_trajectory(mixture_container(), 5000, tuning(NeighbourSearch::cells));
    expect_same_trajectory(large_among_small(20, 20, 0.1, 10.0), 20000,
                           tuning(NeighbourSearch::cells));
    // A cell would have to hold eleven: lists take over at once.
    expect_same_trajectory(large_among_small(4, 60, 0.1, 3.0), 3000,
                           tuning(NeighbourSearch::cells));
}
/// An elastic gas in a dish that stands still, with the same mean energy for all.
InitialState gas_of_two_sizes(std::size_t large, std::size_t small, double small_radius,
                              double packing, double period = 10.0) {
    const double area = double(large) + double(small) * small_radius * small_radius;
    InitialState scene = large_among_small(large, small, small_radius, square_root(area / packing));
    const Segment before = scene.path.segments.front();
    scene.path = still_path(period);
    scene.disc_surface = scene.wall_surface = {0.0};
    for (Disc& disc : scene.discs) {
        disc.position = disc.position - before.start + scene.path.segments.front().start;
        disc.velocity = (10.0 / disc.radius) * (disc.velocity - before.velocity);
    }
    return scene;
}
// Cells of half a disc; and of five or ten, which have an annex. Over the ends of swirls.
TEST_P(EveryWidth, EngineIsTheReferenceBitForBitInAGasOfUnequalDiscs) {
    const int events = sanitized ? 1000 : 6000;
    for (const InitialState& scene :
         {gas_of_two_sizes(60, 60, 0.1, 0.2, 1.0), gas_of_two_sizes(60, 60, 0.5, 0.5, 2.0),
          gas_of_two_sizes(20, 180, 0.1, 0.4, 1.0), gas_of_two_sizes(3, 150, 0.05, 0.1, 1.0)})
        for (const NeighbourSearch search : {NeighbourSearch::lists, NeighbourSearch::cells})
            expect_same_trajectory(scene, events, tuning(search));
}
// Where lists would have to be made anew time and again; not in a denser gas, and not where cells
// would hold forty.
TEST(UnequalDiscs, GoByCellsWhereListsDoNotLast) {
    const auto bytes = [](const InitialState& scene, NeighbourSearch search) {
        return Simulation(scene, {}, {0, Width::best, search}).loop_counts().bytes;
    };
    const auto chosen = [&](const InitialState& scene) {
        const std::uint64_t best = bytes(scene, NeighbourSearch::best);
        EXPECT_NE(bytes(scene, NeighbourSearch::cells), bytes(scene, NeighbourSearch::lists));
        return best == bytes(scene, NeighbourSearch::cells) ? NeighbourSearch::cells
                                                            : NeighbourSearch::lists;
    };
    EXPECT_EQ(chosen(gas_of_two_sizes(500, 500, 0.1, 0.2)), NeighbourSearch::cells);
    EXPECT_EQ(chosen(gas_of_two_sizes(500, 500, 0.1, 0.6)), NeighbourSearch::cells);
    EXPECT_EQ(chosen(gas_of_two_sizes(100, 900, 0.1, 0.4)), NeighbourSearch::cells);
    EXPECT_EQ(chosen(gas_of_two_sizes(500, 500, 0.1, 0.72)), NeighbourSearch::lists);
    EXPECT_EQ(chosen(gas_of_two_sizes(50, 950, 0.3, 0.55)), NeighbourSearch::lists);
    const InitialState crowded = large_among_small(20, 2000, 0.1, 8.165);
    EXPECT_EQ(bytes(crowded, NeighbourSearch::best), bytes(crowded, NeighbourSearch::lists));
}
// One reference for all searches and widths: it looks at all pairs for every event.
void expect_same_trajectories(const InitialState& scene, int events) {
    std::vector<Simulation> engines;
    for (const Width width : {Width::baseline, Width::avx2, Width::avx512}) {
        if (!has_width(width)) continue;
        for (const int cells : {0, 1, 3, 7, 1000})
            engines.emplace_back(scene, Progress{}, Tuning{cells, width});
        engines.emplace_back(scene, Progress{}, Tuning{0, width, NeighbourSearch::cells});
        engines.emplace_back(scene, Progress{}, Tuning{0, width, NeighbourSearch::all_pairs});
    }
    Reference plain(scene);
    for (int k = 0; k < events; ++k) {
        const Event expected = plain.step();
        for (std::size_t e = 0; e < engines.size(); ++e) {
            const Event found = engines[e].step();
            ASSERT_TRUE(same_bits(expected.clock, found.clock)) << "event " << k << " of " << e;
            ASSERT_EQ(expected.i, found.i) << "event " << k << " of " << e;
            ASSERT_EQ(expected.j, found.j) << "event " << k << " of " << e;
            ASSERT_TRUE(same_bits(expected.impulse.normal, found.impulse.normal));
            ASSERT_TRUE(same_bits(expected.impulse.tangential, found.impulse.tangential));
        }
    }
    for (const Simulation& engine : engines)
        EXPECT_EQ(engine.state_hash(), engines.front().state_hash());
    // With the grids that are chosen by density, lists are rebuilt one at a time.
    EXPECT_LT(engines.front().loop_counts().full_rebuilds, 3u);
}
// In a tenth of a per cent of all events the large disc collides; its list has hundreds of others.
TEST(VeryUnequalDiscs, EngineIsTheReferenceBitForBitWithEverySearchAndWidth) {
    const int events = sanitized ? 100 : 2000;
    expect_same_trajectories(large_among_small(4, 250, 0.1, 3.0), events);
    expect_same_trajectories(large_among_small(1, 300, 0.01, 1.04), events);
    expect_same_trajectories(large_among_small(20, 60, 0.1, 5.3), events);
}
// Seventeen kinds of disc, each 1.4 times as large as the last: a grid for every second one.
TEST(VeryUnequalDiscs, EngineIsTheReferenceBitForBitForManySizes) {
    std::vector<Disc> kinds;
    for (double radius = 1.0; radius > 1.0 / 300.0; radius /= 1.4) {
        Disc disc = unit_disc();
        disc.radius = radius;
        disc.mass = radius * radius;
        disc.inertia = paper_inertia * disc.mass * disc.mass;
        kinds.push_back(disc);
    }
    expect_same_trajectories(
        state_of(kinds, 170, 6.0, polygon_path(paper_amplitude, paper_period, paper_sides), 0.7,
                 0.4),
        sanitized ? 100 : 2000);
}
TEST(VeryUnequalDiscs, EngineIsThePlainGridBitForBitAmongThousands) {
    if (sanitized) GTEST_SKIP() << "fifty thousand events";
    expect_same_trajectory<PlainGrid>(large_among_small(20, 2000, 0.1, 8.165), 50000, {});
    expect_same_trajectory<PlainGrid>(large_among_small(2, 3000, 0.01, 2.05), 20000, {});
}
// Discs have followed the container long before its next course; so do the lists.
TEST(FastDish, ListsAreRebuiltNoMoreOftenThanDiscsCollide) {
    InitialState scene = paper_container(48);
    scene.path = polygon_path(1e6, paper_period, paper_sides);
    const Segment& segment = scene.path.segments.front();
    for (Disc& disc : scene.discs) {
        disc.position = disc.position + (segment.start - Vec2{paper_amplitude, 0.0});
        disc.velocity = disc.velocity + segment.velocity;
    }
    expect_same_trajectory(scene, sanitized ? 1000 : 20000, {});
    Simulation simulation(scene);
    simulation.run(20000);
    EXPECT_LT(simulation.loop_counts().list_rebuilds, 20000u);
}
// Every loop over all discs asks, from the first on; and once it was told so, no_disc goes on.
TEST(Stop, EndsTheMakingOfASimulationWhereverItIs) {
    const InitialState scene = gas_at_rest(5000, 0.7);
    InitialState spheres = scene;
    spheres.shape = Shape::sphere;
    InitialState unequal = scene;  // one so large that its list goes on in a tail
    unequal.discs.front().radius *= 6.0;
    int questions = 0, last_question = 0;
    Tuning tuning;
    tuning.is_stopped = [&] { return ++questions >= last_question; };
    for (const InitialState& each : {scene, unequal, spheres})
        for (const NeighbourSearch search : {NeighbourSearch::lists, NeighbourSearch::cells})
            for (last_question = 1;; last_question += sanitized ? 7 : 2) {
                questions = 0;
                tuning.neighbours = search;
                const Simulation simulation(each, {}, tuning);
                if (questions < last_question) {
                    EXPECT_EQ(simulation.size(), 5000u);
                    EXPECT_GT(questions, 3 * 5000 / 1024);  // in three loops at least
                    break;
                }
                EXPECT_LE(questions, last_question + 10);
                EXPECT_EQ(simulation.size(), 0u);
                EXPECT_EQ(simulation.snapshot().size(), 0u);
                EXPECT_EQ(simulation.events().total(), 0u);
            }
}

// More discs on one spot than a cell has room for, flying apart: some are strays.
TEST_P(EveryWidth, EngineIsTheReferenceBitForBitWhereDiscsOverlapAtTheStart) {
    for (const std::size_t on_one_spot : {2u, 12u, 40u}) {
        InitialState scene = gas_at_rest(60, 0.2);
        for (std::size_t i = 0; i < on_one_spot; ++i)
            scene.discs[i].position = 0.01 * scene.discs[i].velocity;
        expect_same_trajectory(scene, 500, tuning(NeighbourSearch::cells));
    }
}
// A disc that flies along the edges of cells, or through their corners: sixteen cells lie across
// this dish, each for 0.6 discs, so there are edges in its middle.
TEST_P(EveryWidth, EngineIsTheReferenceBitForBitAlongTheEdgesOfCells) {
    const InitialState gas = gas_at_rest(60, 0.2);
    for (const double edges : {0.0, 1.0, 2.0})
        for (const Vec2 velocity :
             {Vec2{1.0, 0.0}, Vec2{0.0, -1.0}, Vec2{1.0, 1.0}, Vec2{-1.0, 1.0}}) {
            InitialState scene = gas;
            const double R = scene.container_radius;
            scene.discs.resize(60);
            const double width = square_root(0.6 * pi * R * R / 60.0);
            scene.discs[0].position = {edges * width, -edges * width};
            scene.discs[0].velocity = velocity;
            // Room for it, with as many discs as before.
            for (std::size_t i = 1; i < 60; ++i) {
                scene.discs[i].velocity = {0.0, 0.0};
                const Vec2 apart = scene.discs[i].position - scene.discs[0].position;
                if (dot(apart, apart) < 4.0)
                    std::swap(scene.discs[i].position.x, scene.discs[i].position.y);
            }
            expect_same_trajectory(scene, 500, tuning(NeighbourSearch::cells));
        }
}
// In a dish that swirls the cells rest and the wall passes over them. The second and third gather
// their discs, and cells of another width take over.
TEST_P(EveryWidth, EngineIsTheReferenceBitForBitWithCellsInAThinDish) {
    const int events = sanitized ? 500 : 8000;
    for (const double container_radius : {90.0, 45.0, 18.0}) {
        InitialState thin =
            state_of({unit_disc()}, 101, container_radius,
                     polygon_path(paper_amplitude, paper_period, paper_sides), 1.0, 1.0, 1.0);
        expect_same_trajectory(thin, events, tuning(NeighbourSearch::cells));
        thin.disc_surface = {0.5, 0.8, 0.4, 1e-3};
        expect_same_trajectory(thin, events, tuning(NeighbourSearch::cells));
    }
    // Far more of the path than of the dish.
    expect_same_trajectory(
        state_of({unit_disc()}, 60, 18.0, polygon_path(200.0, paper_period, paper_sides), 1.0, 1.0),
        2000, tuning(NeighbourSearch::cells));
}
// On the true circle, which is one leg: its cells are laid over all of it.
TEST_P(EveryWidth, EngineIsTheReferenceBitForBitWithCellsOnTheExactCircle) {
    const int events = sanitized ? 1000 : 10000;
    for (const InitialState& scene : {paper_container(5), paper_container(48), mixture_container(),
                                      large_among_small(20, 20, 0.1, 10.0)})
        expect_same_trajectory(on_circle(scene), events, tuning(NeighbourSearch::cells));
    for (const double container_radius : {60.0, 45.0, 18.0}) {
        InitialState thin = on_circle(
            state_of({unit_disc()}, 101, container_radius,
                     polygon_path(paper_amplitude, paper_period, paper_sides), 1.0, 1.0, 1.0));
        expect_same_trajectory(thin, events, tuning(NeighbourSearch::cells));
        thin.disc_surface = {0.5, 0.8, 0.4, 1e-3};
        expect_same_trajectory(thin, events, tuning(NeighbourSearch::cells));
    }
    // Far more of the path than of the dish; and backwards.
    InitialState far =
        state_of({unit_disc()}, 60, 18.0, polygon_path(200.0, paper_period, paper_sides), 1.0, 1.0);
    expect_same_trajectory(on_circle(far, 200.0), 2000, tuning(NeighbourSearch::cells));
    far = on_circle(far);
    Segment& segment = far.path.segments.front();
    segment.velocity = -1.0 * segment.velocity;
    segment.turning = -segment.turning;
    expect_same_trajectory(far, 2000, tuning(NeighbourSearch::cells));
}
/// Everybody flies to the centre, to be there at one time.
InitialState imploding(InitialState scene, double time) {
    for (Disc& disc : scene.discs) disc.velocity = (-1.0 / time) * disc.position;
    return scene;
}
// Twenty discs come to where seven have room, and then far more: narrower cells take over in the
// middle of a swirl, and in the thinnest gas lists, as cells that are narrow enough would be too
// many.
TEST_P(EveryWidth, EngineIsTheReferenceBitForBitWhileDiscsGather) {
    const int events = sanitized ? 1200 : 3000;  // it takes some 900 until cells are laid anew
    for (const double packing : {0.05, 0.003}) {
        const InitialState scene = imploding(gas_at_rest(300, packing), 7.0);
        expect_same_trajectory(scene, events, tuning(NeighbourSearch::cells));
        const auto simulate = [&](NeighbourSearch search) {
            Simulation simulation(scene, {}, tuning(search));
            simulation.run(static_cast<std::uint64_t>(events));
            return simulation;
        };
        const LoopCounts cells = simulate(NeighbourSearch::cells).loop_counts();
        const LoopCounts lists = simulate(NeighbourSearch::lists).loop_counts();
        EXPECT_GT(cells.full_rebuilds, 0u);
        EXPECT_EQ(cells.bytes == lists.bytes, packing < 0.01);
    }
}
// Cells for five discs, and all small ones come to one: they are more than its annex holds.
TEST_P(EveryWidth, EngineIsTheReferenceBitForBitWhileUnequalDiscsGather) {
    const int events = sanitized ? 600 : 2000;
    InitialState scene = imploding(gas_of_two_sizes(20, 180, 0.1, 0.2), 7.0);
    for (Disc& disc : scene.discs)
        if (disc.radius == 1.0) disc.velocity = {0.0, 0.0};
    expect_same_trajectory(scene, events, tuning(NeighbourSearch::cells));
    Simulation simulation(scene, {}, tuning(NeighbourSearch::cells));
    simulation.run(static_cast<std::uint64_t>(events));
    EXPECT_GT(simulation.loop_counts().full_rebuilds, 0u);
}
// All distances shrink alike, and small discs lie in a lattice: one meets two of them at the same
// instant, and what another of the three has pending is not what comes first in order.
TEST_P(EveryWidth, EngineIsTheReferenceBitForBitWhereADiscMeetsTwoAtOneInstant) {
    const InitialState scene = imploding(gas_of_two_sizes(20, 180, 0.1, 0.2), 7.0);
    for (const NeighbourSearch search : {NeighbourSearch::lists, NeighbourSearch::cells})
        expect_same_trajectory(scene, 300, tuning(search));
    expect_same_trajectory(imploding(gas_of_two_sizes(4, 28, 0.1, 0.2), 7.0), 300, tuning());
}
// A gas at rest whose discs lose their energy: its cells are laid anew a few times, not for ever.
TEST(ThinGas, CellsAreLaidAnewAFewTimesWhileItGathers) {
    InitialState scene = gas_at_rest(2000, 0.1);
    scene.disc_surface = scene.wall_surface = {0.5, 0.7, 0.4, 1e-3};
    Simulation simulation(scene);
    simulation.run(sanitized ? 20000 : 400000);
    EXPECT_LT(simulation.loop_counts().full_rebuilds, 10u);
}
// In a thin dish that swirls no_disc is carried from cell to cell by the container.
TEST(ThinDish, DiscsEnterCellsNoOftenerThanTheyFlyThere) {
    InitialState scene =
        state_of({unit_disc()}, 2000, 258.0,
                 polygon_path(paper_amplitude, paper_period, paper_sides), 1.0, 1.0, 0.1);
    for (Disc& disc : scene.discs) disc.velocity = disc.velocity - scene.path.segments[0].velocity;
    Simulation simulation(scene);
    simulation.advance_to(3, 0.0);
    // A disc flies 2.4 radii in that time at the mean speed it starts with, and the container 36;
    // cells are 8 wide.
    EXPECT_LT(simulation.loop_counts().list_rebuilds, 2000u);
}

// The baselines of the benchmark.

/// Events one by one, and everybody at the end.
template <class Baseline>
void expect_the_same(const InitialState& scene, Baseline baseline, int events) {
    Reference plain(scene);
    for (int k = 0; k < events; ++k) {
        const Event expected = plain.step(), found = baseline.step();
        ASSERT_TRUE(same_bits(expected.clock, found.clock)) << "event " << k;
        ASSERT_EQ(expected.periods, found.periods) << "event " << k;
        ASSERT_EQ(expected.kind, found.kind) << "event " << k;
        ASSERT_EQ(expected.i, found.i) << "event " << k;
        ASSERT_EQ(expected.j, found.j) << "event " << k;
        ASSERT_TRUE(same_bits(expected.impulse.normal, found.impulse.normal)) << "event " << k;
        ASSERT_TRUE(same_bits(expected.impulse.tangential, found.impulse.tangential));
    }
    for (std::size_t i = 0; i < scene.discs.size(); ++i)
        expect_same_state(plain.disc(i), baseline.disc(i));
}

TEST_P(EveryWidth, PlainLoopIsTheReferenceBitForBit) {
    for (const InitialState& scene :
         {paper_container(5), paper_container(28), paper_container(48), mixture_container(),
          gas_at_rest(101, 0.3), on_circle(paper_container(28))})
        expect_the_same(scene, AllPairsBaseline(scene, GetParam()), 5000);
}
TEST_P(EveryWidth, PlainListsAreTheReferenceBitForBitInAGas) {
    // Dense, thin, and with lists that hold nearly everybody; over the end of a swirl, too.
    for (const auto& [packing, skin] : {std::pair{0.7, 0.6}, {0.2, 2.0}, {0.02, 5.0}}) {
        InitialState scene = gas_at_rest(101, packing);
        scene.path = still_path(3.0);
        expect_the_same(scene, NeighborListBaseline(scene, skin, GetParam()),
                        sanitized ? 1000 : 10000);
    }
}
// Lists that are left at once, and that hold nearly everybody.
TEST_P(EveryWidth, PlainListsAreTheReferenceBitForBitInASwirledDish) {
    InitialState dissipative = paper_container(40);
    dissipative.disc_surface = {0.5, 0.9, 0.4, 1e-3};
    dissipative.wall_surface = {0.8, 0.8, 0.2, 1e-3};
    const InitialState thin =
        state_of({unit_disc()}, 101, 45.0, polygon_path(paper_amplitude, paper_period, paper_sides),
                 1.0, 1.0, 1.0);
    for (const InitialState& scene : {paper_container(5), paper_container(48), dissipative, thin,
                                      mixture_container(), large_among_small(4, 60, 0.1, 3.0)})
        for (const double skin : {0.05, 0.5, 3.0})
            expect_the_same(scene, NeighborListBaseline(scene, skin, GetParam()),
                            sanitized ? 300 : 3000);
}
TEST_P(EveryWidth, PlainListsAreTheReferenceBitForBitOnTheExactCircle) {
    for (const std::size_t n : {5u, 48u}) {
        const InitialState scene = on_circle(paper_container(n));
        expect_the_same(scene, NeighborListBaseline(scene, 0.4, GetParam()),
                        sanitized ? 300 : 5000);
    }
}

// Many discs, against a second plain loop that has cells and a queue (plain_grid.hpp); that one
// against the first, where that is possible.
TEST(PlainGrid, IsTheReferenceBitForBit) {
    const InitialState scene = paper_container(48);
    Reference all_pairs(scene);
    PlainGrid grid(scene);
    for (int k = 0; k < 20000; ++k) {
        const Event expected = all_pairs.step(), found = grid.step();
        ASSERT_TRUE(same_bits(expected.clock, found.clock)) << "event " << k;
        ASSERT_EQ(expected.i, found.i) << "event " << k;
        ASSERT_EQ(expected.j, found.j) << "event " << k;
    }
}
InitialState large_container(std::size_t n) {
    const double scale = square_root(static_cast<double>(n) / 48.0);
    return state_of({unit_disc()}, n, scale * paper_container_radius,
                    polygon_path(scale * paper_amplitude, scale * paper_period, paper_sides), 1.0,
                    1.0);
}
TEST_P(EveryWidth, EngineIsThePlainGridBitForBitInADenseGas) {
    if (sanitized) GTEST_SKIP() << "two hundred thousand events";
    expect_same_trajectory<PlainGrid>(gas_at_rest(10000, 0.7), 200000, tuning());
}
TEST_P(EveryWidth, EngineIsThePlainGridBitForBitInAThinGas) {
    for (const NeighbourSearch neighbours : {NeighbourSearch::lists, NeighbourSearch::cells})
        expect_same_trajectory<PlainGrid>(gas_at_rest(2000, 0.2), 20000, tuning(neighbours));
}
TEST_P(EveryWidth, EngineIsThePlainGridBitForBitInAGasOfUnequalDiscs) {
    if (sanitized) GTEST_SKIP() << "forty thousand events";
    for (const std::size_t large : {1000u, 200u})
        expect_same_trajectory<PlainGrid>(gas_of_two_sizes(large, 2000 - large, 0.1, 0.3, 3.0),
                                          20000, tuning(NeighbourSearch::cells));
}
InitialState thin_container(std::size_t n, double packing) {
    return state_of({unit_disc()}, n, square_root(static_cast<double>(n) / packing),
                    polygon_path(paper_amplitude, paper_period, paper_sides), 1.0, 1.0, 0.3);
}
TEST_P(EveryWidth, EngineIsThePlainGridBitForBitInAThinDish) {
    if (sanitized) GTEST_SKIP() << "fifty thousand events";
    for (const double packing : {0.2, 0.03}) {
        const InitialState scene = thin_container(2000, packing);
        expect_same_trajectory<PlainGrid>(scene, 50000, tuning());
        expect_same_trajectory<PlainGrid>(on_circle(scene), 50000, tuning(NeighbourSearch::cells));
    }
}
// Its discs gather in the third swirl, and fly again in the sixth: then the search is another.
TEST_P(EveryWidth, EngineIsThePlainGridBitForBitWhereListsTakeOverAndCellsComeBack) {
    if (sanitized) GTEST_SKIP() << "thirty thousand events";
    expect_same_trajectory<PlainGrid>(thin_container(500, 0.38), 32000, tuning());
}
TEST(ThinDish, GoesByListsWhileItsDiscsHaveGatheredAndByCellsElse) {
    const InitialState scene = thin_container(500, 0.38);
    const auto bytes = [&](NeighbourSearch search) {
        return Simulation(scene, {}, {0, Width::best, search}).loop_counts().bytes;
    };
    const std::uint64_t cells = bytes(NeighbourSearch::cells),
                        lists = bytes(NeighbourSearch::lists);
    ASSERT_NE(cells, lists);
    Simulation best(scene), by_cells(scene, {}, {0, Width::best, NeighbourSearch::cells});
    const auto advance = [&](std::uint64_t events) {
        best.run(events);
        by_cells.run(events);
        EXPECT_EQ(best.state_hash(), by_cells.state_hash());
    };
    EXPECT_EQ(best.loop_counts().bytes, cells);
    advance(22000);
    EXPECT_EQ(best.loop_counts().bytes, lists);
    advance(10000);
    EXPECT_EQ(best.loop_counts().bytes, cells);
    // Who is told to keep to cells does.
    EXPECT_EQ(by_cells.loop_counts().bytes, cells);
}
TEST_P(EveryWidth, EngineIsThePlainGridBitForBitInALargeDish) {
    if (sanitized) GTEST_SKIP() << "a million events";
    expect_same_trajectory<PlainGrid>(large_container(10000), 200000, tuning());
}
TEST(ManyDiscs, EngineIsThePlainGridBitForBitOverAMillionEventsOfTenThousand) {
    if (sanitized) GTEST_SKIP() << "a million events";
    expect_same_trajectory<PlainGrid>(gas_at_rest(10000, 0.7), 1000000, {});
}
TEST(ManyDiscs, EngineIsThePlainGridBitForBitOverAMillionEventsInAThinGasOfTenThousand) {
    if (sanitized) GTEST_SKIP() << "a million events";
    expect_same_trajectory<PlainGrid>(gas_at_rest(10000, 0.2), 1000000, {});
}
TEST(ManyDiscs, EngineIsThePlainGridBitForBitOverAMillionEventsOfAHundredThousand) {
    if (sanitized) GTEST_SKIP() << "a million events";
    expect_same_trajectory<PlainGrid>(large_container(100000), 1000000, {});
}

INSTANTIATE_TEST_SUITE_P(, EveryWidth, every_width(), width_name);

TEST(Grid, EveryGridGivesTheSameBits) {
    const InitialState scene = paper_container(48);
    Simulation all_pairs(scene, {}, {1, Width::best});
    all_pairs.run(100000);
    for (const int cells : {2, 3, 4, 5, 6, 7, 8, 1000}) {
        Simulation grid(scene, {}, {cells, Width::best});
        grid.run(100000);
        EXPECT_EQ(all_pairs.state_hash(), grid.state_hash()) << cells << " cells per side";
    }
}

TEST(Observation, LookingDoesNotChangeABit) {
    const InitialState scene = paper_container(48);
    Simulation alone(scene), watched(scene);
    alone.run(50000);
    Snapshot snapshot = watched.snapshot();
    std::int64_t frame = 0;
    while (watched.events().total() < 50000) {
        const double clock = paper_period * static_cast<double>(frame % 511) / 511.0;
        if (watched.events().total() + 500 < 50000)
            watched.advance_to(frame / 511, clock);
        else
            watched.step();
        snapshot = watched.snapshot();
        ++frame;
    }
    EXPECT_EQ(alone.state_hash(), watched.state_hash());
}

TEST(Observation, RefreshedSnapshotEqualsANewOne) {
    Simulation simulation(paper_container(28));
    Snapshot kept = simulation.snapshot();
    for (int k = 0; k < 5000; ++k) simulation.refresh(kept, simulation.step());
    const Snapshot fresh = simulation.snapshot();
    EXPECT_EQ(kept.x, fresh.x);
    EXPECT_EQ(kept.vy, fresh.vy);
    EXPECT_EQ(kept.spin, fresh.spin);
    EXPECT_EQ(kept.angle, fresh.angle);
    EXPECT_EQ(kept.held_at, fresh.held_at);
    EXPECT_EQ(kept.container_centre.x, fresh.container_centre.x);
}

TEST(Resume, FromTheDiscsAndTheProgressContinuesBitForBit) {
    expect_resumed_bit_for_bit(paper_container(48), 60000, 23456);
}

TEST(Resume, OfUnequalDiscsInCellsContinuesBitForBit) {
    expect_resumed_bit_for_bit(gas_of_two_sizes(50, 450, 0.1, 0.2, 3.0), 20000, 7654);
}

}  // namespace
}  // namespace swirl
