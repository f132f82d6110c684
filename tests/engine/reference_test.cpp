#include "swirl/engine/reference.hpp"

#include <gtest/gtest.h>

#include <deque>
#include <map>
#include <string>
#include <vector>

#include "baselines/all_pairs.hpp"
#include "baselines/neighbor_lists.hpp"
#include "engine/grid_reference.hpp"
#include "engine/same_trajectory.hpp"
#include "engine/scenes.hpp"
#include "swirl/engine/partial_friction.hpp"

namespace swirl {
namespace {

/// The same discs in a container that moves on the exact circle.
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

// For few discs the engine tests all pairs (cells_per_side = 0); a given grid selects neighbour
// lists.
TEST(EngineEqualsReference, InThePaperContainer) {
    for (const std::size_t n : {1u, 2u, 5u, 28u, 48u})
        expect_same_for_every_width(paper_container(n), 100000, tuning());
}
TEST(EngineEqualsReference, WithAnyNumberOfVectors) {
    for (const std::size_t n : {8u, 9u, 16u, 17u, 24u, 25u, 32u, 33u, 40u, 41u})
        expect_same_for_every_width(paper_container(n), 3000, tuning());
}
// The event queue has one row, two, four (one of them empty), four, six and eight.
TEST(EngineEqualsReference, WithListsOfFewDiscs) {
    for (const std::size_t n : {1u, 2u, 5u, 12u, 20u, 28u, 40u, 52u})
        expect_same_for_every_width(paper_container(n), 20000, tuning(1));
}
// The second level of the event queue has two rows, four, six and eight.
TEST(EngineEqualsReference, WithAnyNumberOfRowsInTheQueue) {
    for (const std::size_t n : {100u, 200u, 300u, 500u})
        expect_same_for_every_width(gas_at_rest(n, 0.7), 400, tuning());
}
TEST(EngineEqualsReference, WithoutFriction) {
    expect_same_for_every_width(paper_container(40, 0.0, 0.0), 30000, tuning());
}
TEST(EngineEqualsReference, ForAMixture) {
    expect_same_for_every_width(mixture_container(), 100000, tuning());
    expect_same_for_every_width(mixture_container(), 30000, tuning(3));
    expect_same_for_every_width(mixture_container(20), 30000, tuning());
}
TEST(EngineEqualsReference, ForDiscsThatCannotSpin) {
    for (const std::size_t step : {1u, 3u}) {
        expect_same_for_every_width(with_held_spins(paper_container(28), step), 30000, tuning());
        expect_same_for_every_width(with_held_spins(mixture_container(), step), 30000, tuning(3));
        expect_same_for_every_width(with_held_spins(mixture_container(), step), 10000,
                                    tuning(SearchMethod::cells));
    }
}
TEST(EngineEqualsReference, OnTheExactCircle) {
    for (const std::size_t n : {1u, 2u, 5u, 28u, 48u}) {
        const InitialState scene = on_circle(paper_container(n));
        expect_same_for_every_width(scene, 10000, tuning());
        expect_same_for_every_width(scene, 5000, tuning(1));
    }
    // Scenes with a grid, with a mixture in which some discs stay away from the wall, and with
    // smooth discs that slide along the wall for a long time.
    expect_same_for_every_width(
        on_circle(state_of({unit_disc()}, 200, 18.0, still_path(1.0), 1.0, 1.0)), 5000, tuning());
    expect_same_for_every_width(on_circle(mixture_container()), 10000, tuning(3));
    expect_same_for_every_width(on_circle(paper_container(20, 0.0, 0.0)), 10000, tuning());
}
// Here the co-moving frame is not renewed at path vertices; in the second container, whose discs
// gather first, only sometimes.
TEST(EngineEqualsReference, WithListsInADiluteContainer) {
    const int events = 5000;
    for (const double container_radius : {45.0, 18.0}) {
        const InitialState dilute =
            state_of({unit_disc()}, 101, container_radius,
                     polygon_path(paper_amplitude, paper_period, paper_sides), 1.0, 1.0, 1.0);
        expect_same_for_every_width(dilute, events, tuning(SearchMethod::lists));
        expect_same_for_every_width(on_circle(dilute), events, tuning(SearchMethod::lists));
    }
}
// Centres of skins are in single precision. Far from the origin that is coarser than the radius of
// a narrow skin; in a container of ten million radii this is the case everywhere.
TEST(EngineEqualsReference, WithListsInAContainerMuchLargerThanItsDiscs) {
    Disc grain = unit_disc();
    grain.radius = 1e-6;
    for (const double container_radius : {0.03651, 10.0}) {
        const InitialState wide =
            state_of({grain}, 48, container_radius,
                     polygon_path(paper_amplitude, paper_period, paper_sides), 1.0, 1.0);
        expect_same_for_every_width(wide, 1500, tuning(SearchMethod::lists));
    }
    // A crystal that melts. More discs lie within a rounding error of a disc than lists usually
    // hold.
    InitialState heap = state_of({unit_disc()}, 48, 1e7, still_path(1.0), 1.0, 1.0, 0.1);
    for (std::size_t i = 0; i < heap.discs.size(); ++i)
        heap.discs[i].position = {3e6 + 2.001 * static_cast<double>(i % 7),
                                  2e6 + 2.001 * static_cast<double>(i / 7)};
    expect_same_for_every_width(heap, 300, tuning(SearchMethod::lists));
}
// Far from the origin, positions are less precise, and a small angle is a long distance.
TEST(EngineEqualsReference, OnLargeAndSmallCircles) {
    for (const double amplitude : {1e-3, 30.0, 1e6}) {
        for (const std::size_t n : {28u, 48u}) {
            const InitialState scene = on_circle(paper_container(n), amplitude);
            expect_same_for_every_width(scene, 3000, tuning());
            Simulation simulation(scene);
            double deepest = 0.0;
            for (int event = 0; event < 3000; ++event)
                deepest = larger(deepest, simulation.step().overlap);
            EXPECT_LT(deepest, 1e-13 * (amplitude + scene.container_radius)) << amplitude;
        }
    }
}
constexpr Frictionless kinds_without_friction[] = {Frictionless::wall, Frictionless::boundary,
                                                   Frictionless::bulk};

InitialState without_friction(InitialState scene, Frictionless contacts) {
    scene.law = without_friction_in(contacts);
    if (contacts == Frictionless::wall) scene.wall_surface.mu = 0.0;
    return scene;
}
TEST(EngineEqualsReference, WithoutFrictionInOneKindOfContact) {
    for (const Frictionless kind : kinds_without_friction) {
        for (const std::size_t n : {2u, 28u, 48u})
            expect_same_for_every_width(without_friction(paper_container(n), kind), 3000, tuning());
        expect_same_for_every_width(without_friction(on_circle(paper_container(48)), kind), 1000,
                                    tuning());
        expect_same_for_every_width(without_friction(mixture_container(), kind), 1000, tuning());
    }
    expect_same_for_every_width(without_friction(gas_at_rest(200, 0.05), Frictionless::bulk), 1000,
                                tuning());
}
// Checks the kinds of contact with the snapshots, not with the reference. All of them happen, and
// only the one named lacks friction.
TEST(Frictionless, OnlyTheNamedContactsHaveNoTangentialImpulse) {
    for (const Frictionless kind :
         {Frictionless::none, Frictionless::wall, Frictionless::boundary, Frictionless::bulk}) {
        Simulation simulation(without_friction(paper_container(44), kind));
        Snapshot s = simulation.snapshot();
        std::map<Frictionless, int> sliding, smooth;
        for (int k = 0; k < 30000; ++k) {
            const Event event = simulation.step();
            simulation.refresh(s, event);
            if (event.kind == EventKind::path_vertex) continue;
            const auto is_at_wall = [&](std::uint32_t i) {
                const Vec2 from_centre = s.position(i) - s.container_centre;
                return square_root(dot(from_centre, from_centre)) > s.container_radius - 1.5;
            };
            const Frictionless contact = event.kind == EventKind::disc_wall ? Frictionless::wall
                                         : is_at_wall(event.i) && is_at_wall(event.j)
                                             ? Frictionless::boundary
                                             : Frictionless::bulk;
            ++(event.impulse.tangential == 0.0 ? smooth : sliding)[contact];
        }
        for (const Frictionless contact : kinds_without_friction) {
            EXPECT_EQ(sliding[contact] == 0, contact == kind);
            EXPECT_EQ(smooth[contact] == 0, contact != kind);
            EXPECT_GT(sliding[contact] + smooth[contact], 1000);
        }
    }
}
TEST(EngineEqualsReference, WithRestitution) {
    InitialState scene = paper_container(40);
    scene.disc_surface = {
        .mu = 0.5, .restitution = 0.9, .tangential_restitution = 0.4, .contact_duration = 1e-3};
    scene.wall_surface = {
        .mu = 0.8, .restitution = 0.8, .tangential_restitution = 0.2, .contact_duration = 1e-3};
    expect_same_for_every_width(scene, 30000, tuning());
    // Discs that stick together may collide again at once.
    InitialState sticky = paper_container(28);
    sticky.disc_surface = sticky.wall_surface = {.mu = 1.0, .restitution = 0.05};
    expect_same_for_every_width(sticky, 30000, tuning());
}
TEST(EngineEqualsReference, InAGas) {
    for (const SearchMethod search : {SearchMethod::lists, SearchMethod::cells}) {
        expect_same_for_every_width(gas_at_rest(200, 0.6), 3000, tuning(search));
        expect_same_for_every_width(gas_at_rest(200, 0.05), 2000, tuning(search));
    }
}
/// Adds a rotation of all discs about the centre of the container, as of a rigid body.
InitialState rotating(InitialState scene, double angular_velocity) {
    for (Disc& disc : scene.discs) {
        const Vec2 from_centre = disc.position - scene.path.segments[0].start;
        disc.velocity = disc.velocity + angular_velocity * perpendicular(from_centre);
    }
    return scene;
}
// The co-moving frame turns with the cluster and stretches distances. With the second angular
// velocity they grow by a fiftieth per segment, so the frame is set up again after ten segments.
// With the third, the frame would turn too far within a segment, so it does not turn.
TEST(EngineEqualsReference, WithListsInARotatingCluster) {
    const int events = 6000;
    const InitialState pack = state_of({unit_disc()}, 41, 8.0, still_path(1.0), 0.0, 0.0, 0.1);
    for (const double angular_velocity : {0.02, -0.19, 1.0})
        for (const int cells : {1, 3})
            expect_same_for_every_width(rotating(pack, angular_velocity), events, tuning(cells));
    expect_same_for_every_width(rotating(mixture_container(), 0.1), events, tuning(3));
    expect_same_for_every_width(on_circle(rotating(paper_container(41, 0.3, 0.0), -0.1)), events,
                                tuning(3));
    expect_same_for_every_width(rotating(large_among_small(3, 100, 0.3, 5.5), 0.2), events / 4,
                                tuning());
}
// In a frame that does not turn, discs would be ten times as fast as relative to each other, and
// each of 500 lists would be rebuilt three times. The limit allows for discs at the wall.
TEST(RotatingCluster, RebuildsFewLists) {
    const InitialState pack = state_of({unit_disc()}, 500, 28.0, still_path(1.0), 0.0, 0.0, 0.1);
    for (const double angular_velocity : {0.0, 0.02}) {
        Simulation simulation(rotating(pack, angular_velocity));
        simulation.advance_to(8, 0.0);
        EXPECT_LT(simulation.loop_counts().list_rebuilds, 50u) << angular_velocity;
    }
}
// The runs cover several periods.
TEST(EngineEqualsReference, WithCellsInThePaperContainer) {
    for (const std::size_t n : {1u, 5u, 48u})
        expect_same_for_every_width(paper_container(n), 20000, tuning(SearchMethod::cells));
    InitialState dissipative = paper_container(40);
    dissipative.disc_surface = {
        .mu = 0.5, .restitution = 0.9, .tangential_restitution = 0.4, .contact_duration = 1e-3};
    expect_same_for_every_width(dissipative, 20000, tuning(SearchMethod::cells));
}
TEST(EngineEqualsReference, WithCellsForUnequalDiscs) {
    Disc large = unit_disc();
    large.radius = 1.7;
    const InitialState two_sizes =
        state_of({unit_disc(), large}, 60, 20.0,
                 polygon_path(paper_amplitude, paper_period, paper_sides), 0.7, 0.4);
    expect_same_for_every_width(two_sizes, 20000, tuning(SearchMethod::cells));
    expect_same_for_every_width(mixture_container(), 5000, tuning(SearchMethod::cells));
    expect_same_for_every_width(large_among_small(20, 20, 0.1, 10.0), 20000,
                                tuning(SearchMethod::cells));
    // A cell would have to hold eleven discs, so lists take over at once.
    expect_same_for_every_width(large_among_small(4, 60, 0.1, 3.0), 3000,
                                tuning(SearchMethod::cells));
}
/// An elastic gas in a container at rest, with the same mean energy for both sizes.
InitialState gas_of_two_sizes(std::size_t large, std::size_t small, double small_radius,
                              double packing, double period = 10.0) {
    const double area = double(large) + double(small) * small_radius * small_radius;
    InitialState scene = large_among_small(large, small, small_radius, square_root(area / packing));
    const Segment before = scene.path.segments.front();
    scene.path = still_path(period);
    scene.disc_surface = scene.wall_surface = {.mu = 0.0};
    for (Disc& disc : scene.discs) {
        disc.position = disc.position - before.start + scene.path.segments.front().start;
        disc.velocity = (10.0 / disc.radius) * (disc.velocity - before.velocity);
    }
    return scene;
}
// Cells that hold half a disc on average; and five or ten, so that they have overflow buckets. The
// runs cover several periods.
TEST(EngineEqualsReference, InAGasOfUnequalDiscs) {
    const int events = 3000;
    for (const InitialState& scene :
         {gas_of_two_sizes(60, 60, 0.1, 0.2, 1.0), gas_of_two_sizes(60, 60, 0.5, 0.5, 2.0),
          gas_of_two_sizes(20, 180, 0.1, 0.4, 1.0), gas_of_two_sizes(3, 150, 0.05, 0.1, 1.0)})
        for (const SearchMethod search : {SearchMethod::lists, SearchMethod::cells})
            expect_same_for_every_width(scene, events, tuning(search));
}
// The memory that a simulation uses shows which search it has chosen. The engine chooses cells if
// lists would be rebuilt too often. It does not choose them in a denser gas, or if a cell would
// hold forty discs.
TEST(ChooseSearch, CellsForUnequalDiscsWhoseListsDoNotLast) {
    const auto bytes = [](const InitialState& scene, SearchMethod search) {
        return Simulation(scene, {}, {0, Width::best, search}).loop_counts().bytes;
    };
    const auto chosen = [&](const InitialState& scene) {
        const std::uint64_t best = bytes(scene, SearchMethod::best);
        EXPECT_NE(bytes(scene, SearchMethod::cells), bytes(scene, SearchMethod::lists));
        return best == bytes(scene, SearchMethod::cells) ? SearchMethod::cells
                                                         : SearchMethod::lists;
    };
    EXPECT_EQ(chosen(gas_of_two_sizes(500, 500, 0.1, 0.2)), SearchMethod::cells);
    EXPECT_EQ(chosen(gas_of_two_sizes(500, 500, 0.1, 0.6)), SearchMethod::cells);
    EXPECT_EQ(chosen(gas_of_two_sizes(100, 900, 0.1, 0.4)), SearchMethod::cells);
    EXPECT_EQ(chosen(gas_of_two_sizes(500, 500, 0.1, 0.72)), SearchMethod::lists);
    EXPECT_EQ(chosen(gas_of_two_sizes(50, 950, 0.3, 0.55)), SearchMethod::lists);
    const InitialState crowded = large_among_small(20, 2000, 0.1, 8.165);
    EXPECT_EQ(bytes(crowded, SearchMethod::best), bytes(crowded, SearchMethod::lists));
}
void expect_same_trajectories(const InitialState& scene, int events) {
    std::deque<Simulation> engines;
    for (const Width width : every_width()) {
        for (const int cells : {0, 1, 3, 7, 1000})
            engines.emplace_back(scene, Progress{}, Tuning{cells, width});
        for (const SearchMethod search : {SearchMethod::cells, SearchMethod::all_pairs})
            engines.emplace_back(scene, Progress{}, Tuning{0, width, search});
    }
    expect_same_events(scene, Reference(scene), engines, events);
    for (const Simulation& engine : engines)
        EXPECT_EQ(engine.state_hash(), engines.front().state_hash());
    // With the grid that is chosen by density, lists are rebuilt one at a time.
    EXPECT_LT(engines.front().loop_counts().full_rebuilds, 3u);
}
// The large disc takes part in a tenth of a per cent of all events; its list holds hundreds of
// discs.
TEST(EngineWithVeryUnequalDiscs, EqualsReferenceWithEverySearchAndWidth) {
    const int events = sanitized ? 100 : 2000;
    expect_same_trajectories(large_among_small(4, 250, 0.1, 3.0), events);
    expect_same_trajectories(large_among_small(1, 300, 0.01, 1.04), events);
    expect_same_trajectories(large_among_small(20, 60, 0.1, 5.3), events);
}
// Seventeen species, each 1.4 times as large as the last, so every second one has a grid.
TEST(EngineWithVeryUnequalDiscs, EqualsReferenceForManySizes) {
    std::vector<Disc> species;
    for (double radius = 1.0; radius > 1.0 / 300.0; radius /= 1.4) {
        Disc disc = unit_disc();
        disc.radius = radius;
        disc.mass = radius * radius;
        disc.inertia = paper_inertia * disc.mass * disc.mass;
        species.push_back(disc);
    }
    expect_same_trajectories(
        state_of(species, 170, 6.0, polygon_path(paper_amplitude, paper_period, paper_sides), 0.7,
                 0.4),
        sanitized ? 100 : 700);
}
TEST(EngineWithVeryUnequalDiscs, EqualsGridReferenceForThousandsOfDiscs) {
    if (sanitized) GTEST_SKIP() << "twenty thousand events";
    expect_same_trajectory<GridReference>(large_among_small(20, 2000, 0.1, 8.165), 20000, {});
    expect_same_trajectory<GridReference>(large_among_small(2, 3000, 0.01, 2.05), 8000, {});
}
// Discs follow the container long before the next segment, and the frame of the lists must follow.
TEST(FastContainer, RebuildsFewerListsThanThereAreCollisions) {
    InitialState scene = paper_container(48);
    scene.path = polygon_path(1e6, paper_period, paper_sides);
    const Segment& segment = scene.path.segments.front();
    for (Disc& disc : scene.discs) {
        disc.position = disc.position + (segment.start - Vec2{paper_amplitude, 0.0});
        disc.velocity = disc.velocity + segment.velocity;
    }
    expect_same_trajectory(scene, 20000, {});
    Simulation simulation(scene);
    simulation.run(20000);
    EXPECT_LT(simulation.loop_counts().list_rebuilds, 20000u);
}
// Every loop over all discs polls is_stopped, and none continues after it has returned true.
TEST(IsStopped, EndsConstructionInEveryLoop) {
    const InitialState scene = gas_at_rest(5000, 0.7);
    InitialState spheres = scene;
    spheres.shape = Shape::sphere;
    InitialState unequal = scene;  // one disc so large that its list has a tail
    Disc& large = unequal.discs.front();
    large.radius *= 6.0;
    large.position = {0.0, 0.0};
    std::erase_if(unequal.discs, [](const Disc& disc) {
        return disc.radius == 1.0 && dot(disc.position, disc.position) < 7.0 * 7.0;
    });
    int polls = 0, stop_at = 0;
    Tuning tuning;
    tuning.is_stopped = [&] { return ++polls >= stop_at; };
    for (const InitialState& each : {scene, unequal, spheres})
        for (const SearchMethod search : {SearchMethod::lists, SearchMethod::cells})
            for (stop_at = 1;; stop_at += sanitized ? 97 : 2) {
                polls = 0;
                tuning.search = search;
                const Simulation simulation(each, {}, tuning);
                if (polls < stop_at) {
                    EXPECT_EQ(simulation.size(), each.discs.size());
                    EXPECT_GT(polls, 3 * 5000 / 1024);  // three loops or more poll
                    break;
                }
                EXPECT_LE(polls, stop_at + 10);
                EXPECT_EQ(simulation.size(), 0u);
                EXPECT_EQ(simulation.snapshot().size(), 0u);
                EXPECT_EQ(simulation.events().total(), 0u);
            }
}

// More discs in one cell than it holds, flying apart: some of them are unassigned. They are small,
// so that they do not overlap.
TEST(EngineEqualsReference, WithManySmallDiscsInOneCell) {
    for (const std::size_t in_one_cell : {2u, 12u, 40u}) {
        InitialState scene = gas_at_rest(60, 0.2);
        for (std::size_t i = 0; i < in_one_cell; ++i) {
            scene.discs[i].radius = 0.01;
            scene.discs[i].position = {0.03 * double(i % 7) - 0.09, 0.03 * double(i / 7) - 0.09};
            scene.discs[i].velocity = 10.0 * scene.discs[i].position;
        }
        std::erase_if(scene.discs, [](const Disc& disc) {
            return disc.radius == 1.0 && dot(disc.position, disc.position) < 1.5 * 1.5;
        });
        expect_same_for_every_width(scene, 500, tuning(SearchMethod::cells));
    }
}
// A disc flies along the edges of cells, or through their corners. This container has sixteen cells
// across, each for 0.6 discs, so there are edges in its middle.
TEST(EngineEqualsReference, AlongTheEdgesOfCells) {
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
            // Moves discs out of its way.
            for (std::size_t i = 1; i < 60; ++i) {
                scene.discs[i].velocity = {0.0, 0.0};
                const Vec2 apart = scene.discs[i].position - scene.discs[0].position;
                if (dot(apart, apart) < 4.0)
                    std::swap(scene.discs[i].position.x, scene.discs[i].position.y);
            }
            expect_same_for_every_width(scene, 500, tuning(SearchMethod::cells));
        }
}
// The cells rest while the container moves over them. In the second and third container discs
// gather, and cells of another width take over.
TEST(EngineEqualsReference, WithCellsInADiluteContainer) {
    const int events = 8000;
    for (const double container_radius : {90.0, 45.0, 18.0}) {
        InitialState dilute =
            state_of({unit_disc()}, 101, container_radius,
                     polygon_path(paper_amplitude, paper_period, paper_sides), 1.0, 1.0, 1.0);
        expect_same_for_every_width(dilute, events, tuning(SearchMethod::cells));
        dilute.disc_surface = {
            .mu = 0.5, .restitution = 0.8, .tangential_restitution = 0.4, .contact_duration = 1e-3};
        expect_same_for_every_width(dilute, events, tuning(SearchMethod::cells));
    }
    // A path much larger than the container.
    expect_same_for_every_width(
        state_of({unit_disc()}, 60, 18.0, polygon_path(200.0, paper_period, paper_sides), 1.0, 1.0),
        2000, tuning(SearchMethod::cells));
}
// The exact circle is one segment, and the cells cover all of it.
TEST(EngineEqualsReference, WithCellsOnTheExactCircle) {
    const int events = 4000;
    for (const InitialState& scene : {paper_container(5), paper_container(48), mixture_container(),
                                      large_among_small(20, 20, 0.1, 10.0)})
        expect_same_for_every_width(on_circle(scene), events, tuning(SearchMethod::cells));
    for (const double container_radius : {60.0, 45.0, 18.0}) {
        InitialState dilute = on_circle(
            state_of({unit_disc()}, 101, container_radius,
                     polygon_path(paper_amplitude, paper_period, paper_sides), 1.0, 1.0, 1.0));
        expect_same_for_every_width(dilute, events, tuning(SearchMethod::cells));
        dilute.disc_surface = {
            .mu = 0.5, .restitution = 0.8, .tangential_restitution = 0.4, .contact_duration = 1e-3};
        expect_same_for_every_width(dilute, events, tuning(SearchMethod::cells));
    }
    // A path much larger than the container, and a clockwise path.
    InitialState far =
        state_of({unit_disc()}, 60, 18.0, polygon_path(200.0, paper_period, paper_sides), 1.0, 1.0);
    expect_same_for_every_width(on_circle(far, 200.0), 2000, tuning(SearchMethod::cells));
    far = on_circle(far);
    Segment& segment = far.path.segments.front();
    segment.velocity = -1.0 * segment.velocity;
    segment.turn_rate = -segment.turn_rate;
    expect_same_for_every_width(far, 2000, tuning(SearchMethod::cells));
}
/// All discs fly to the centre and would reach it at the same time.
InitialState imploding(InitialState scene, double time) {
    for (Disc& disc : scene.discs) disc.velocity = (-1.0 / time) * disc.position;
    return scene;
}
// Twenty discs gather in a cell for seven, and then many more. Narrower cells take over within a
// period. In the most dilute gas lists do, because there would be too many cells of that width.
TEST(EngineEqualsReference, WhileDiscsGather) {
    const int events = sanitized ? 1200 : 3000;  // cells are rebuilt after about 900
    for (const double packing : {0.05, 0.003}) {
        const InitialState scene = imploding(gas_at_rest(300, packing), 7.0);
        expect_same_for_every_width(scene, events, tuning(SearchMethod::cells));
        const auto simulate = [&](SearchMethod search) {
            Simulation simulation(scene, {}, tuning(search));
            simulation.run(static_cast<std::uint64_t>(events));
            return simulation;
        };
        const LoopCounts cells = simulate(SearchMethod::cells).loop_counts();
        const LoopCounts lists = simulate(SearchMethod::lists).loop_counts();
        EXPECT_GT(cells.full_rebuilds, 0u);
        EXPECT_EQ(cells.bytes == lists.bytes, packing < 0.01);
    }
}
// Cells for five discs; all small discs gather in one, and they exceed its overflow bucket.
TEST(EngineEqualsReference, WhileUnequalDiscsGather) {
    const int events = sanitized ? 600 : 2000;
    InitialState scene = imploding(gas_of_two_sizes(20, 180, 0.1, 0.2), 7.0);
    for (Disc& disc : scene.discs)
        if (disc.radius == 1.0) disc.velocity = {0.0, 0.0};
    expect_same_for_every_width(scene, events, tuning(SearchMethod::cells));
    Simulation simulation(scene, {}, tuning(SearchMethod::cells));
    simulation.run(static_cast<std::uint64_t>(events));
    EXPECT_GT(simulation.loop_counts().full_rebuilds, 0u);
}
// All distances shrink alike, and small discs form a lattice, so one collides with two of them at
// the same instant. The pending event of another of the three is not the first in order.
TEST(EngineEqualsReference, WithSimultaneousCollisions) {
    const InitialState scene = imploding(gas_of_two_sizes(20, 180, 0.1, 0.2), 7.0);
    for (const SearchMethod search : {SearchMethod::lists, SearchMethod::cells})
        expect_same_for_every_width(scene, 300, tuning(search));
    expect_same_for_every_width(imploding(gas_of_two_sizes(4, 28, 0.1, 0.2), 7.0), 300, tuning());
}
// The discs of this gas lose their energy. Its cells are rebuilt a few times, not without end.
TEST(DiluteGas, RebuildsCellsAFewTimesWhileItGathers) {
    InitialState scene = gas_at_rest(2000, 0.1);
    scene.disc_surface = scene.wall_surface = {
        .mu = 0.5, .restitution = 0.7, .tangential_restitution = 0.4, .contact_duration = 1e-3};
    Simulation simulation(scene);
    simulation.run(sanitized ? 20000 : 400000);
    EXPECT_LT(simulation.loop_counts().full_rebuilds, 10u);
}
// The cells do not follow the container, so discs at rest stay in their cells.
TEST(DiluteContainer, DiscsEnterFewCells) {
    InitialState scene =
        state_of({unit_disc()}, 2000, 258.0,
                 polygon_path(paper_amplitude, paper_period, paper_sides), 1.0, 1.0, 0.1);
    for (Disc& disc : scene.discs) disc.velocity = disc.velocity - scene.path.segments[0].velocity;
    Simulation simulation(scene);
    simulation.advance_to(3, 0.0);
    // At its initial mean speed a disc moves 2.4 radii in that time, the container 36; cells are 8
    // wide. The limit is one change of cell per disc.
    EXPECT_LT(simulation.loop_counts().list_rebuilds, 2000u);
}

// The baselines of the benchmark.

/// The same for a baseline, which is constructed from a scene, options and a width.
template <class Baseline, class... Options>
void expect_equals_reference(const InitialState& scene, int events, Options... options) {
    std::deque<Baseline> baselines;
    for (const Width width : every_width()) baselines.emplace_back(scene, options..., width);
    expect_same_events(scene, Reference(scene), baselines, events);
}

TEST(BenchmarkBaselineEqualsReference, AllPairsBaseline) {
    for (const InitialState& scene :
         {paper_container(5), paper_container(28), paper_container(48), mixture_container(),
          gas_at_rest(101, 0.3), on_circle(paper_container(28))})
        expect_equals_reference<AllPairsBaseline>(scene, 5000);
}
TEST(BenchmarkBaselineEqualsReference, NeighborListsInAGas) {
    // Dense; dilute; and with lists that hold nearly all discs. The runs cover several periods.
    for (const auto& [packing, skin] : {std::pair{0.7, 0.6}, {0.2, 2.0}, {0.02, 5.0}}) {
        InitialState scene = gas_at_rest(101, packing);
        scene.path = still_path(3.0);
        expect_equals_reference<NeighborListBaseline>(scene, 10000, skin);
    }
}
// Skins that discs leave at once, and lists that hold nearly all discs.
TEST(BenchmarkBaselineEqualsReference, NeighborListsInASwirledContainer) {
    InitialState dissipative = paper_container(40);
    dissipative.disc_surface = {
        .mu = 0.5, .restitution = 0.9, .tangential_restitution = 0.4, .contact_duration = 1e-3};
    dissipative.wall_surface = {
        .mu = 0.8, .restitution = 0.8, .tangential_restitution = 0.2, .contact_duration = 1e-3};
    const InitialState dilute =
        state_of({unit_disc()}, 101, 45.0, polygon_path(paper_amplitude, paper_period, paper_sides),
                 1.0, 1.0, 1.0);
    for (const InitialState& scene : {paper_container(5), paper_container(48), dissipative, dilute,
                                      mixture_container(), large_among_small(4, 60, 0.1, 3.0)})
        for (const double skin : {0.05, 0.5, 3.0})
            expect_equals_reference<NeighborListBaseline>(scene, 3000, skin);
}
TEST(BenchmarkBaselineEqualsReference, NeighborListsOnTheExactCircle) {
    for (const std::size_t n : {5u, 48u}) {
        const InitialState scene = on_circle(paper_container(n));
        expect_equals_reference<NeighborListBaseline>(scene, 5000, 0.4);
    }
}

// Many discs are compared with a second reference, which has cells and a queue
// (grid_reference.hpp). That one is compared with the first for few discs.
TEST(GridReference, EqualsReference) {
    const InitialState scene = paper_container(48);
    Reference all_pairs(scene);
    GridReference grid(scene);
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
TEST(EngineEqualsGridReference, InADenseGas) {
    if (sanitized) GTEST_SKIP() << "two hundred thousand events";
    expect_same_for_every_width<GridReference>(gas_at_rest(10000, 0.7), 200000, tuning());
}
TEST(EngineEqualsGridReference, InADiluteGas) {
    for (const SearchMethod search : {SearchMethod::lists, SearchMethod::cells})
        expect_same_for_every_width<GridReference>(gas_at_rest(2000, 0.2), 20000, tuning(search));
}
TEST(EngineEqualsGridReference, InAGasOfUnequalDiscs) {
    if (sanitized) GTEST_SKIP() << "forty thousand events";
    for (const std::size_t large : {1000u, 200u})
        expect_same_for_every_width<GridReference>(
            gas_of_two_sizes(large, 2000 - large, 0.1, 0.3, 3.0), 20000,
            tuning(SearchMethod::cells));
}
InitialState dilute_container(std::size_t n, double packing) {
    return state_of({unit_disc()}, n, square_root(static_cast<double>(n) / packing),
                    polygon_path(paper_amplitude, paper_period, paper_sides), 1.0, 1.0, 0.3);
}
TEST(EngineEqualsGridReference, InADiluteContainer) {
    if (sanitized) GTEST_SKIP() << "fifty thousand events";
    for (const double packing : {0.2, 0.03}) {
        const InitialState scene = dilute_container(2000, packing);
        expect_same_for_every_width<GridReference>(scene, 50000, tuning());
        expect_same_for_every_width<GridReference>(on_circle(scene), 50000,
                                                   tuning(SearchMethod::cells));
    }
}
// Discs gather in the third period and disperse in the sixth, so the search changes twice.
TEST(EngineEqualsGridReference, WhileListsAndCellsReplaceEachOther) {
    if (sanitized) GTEST_SKIP() << "thirty thousand events";
    expect_same_for_every_width<GridReference>(dilute_container(500, 0.38), 32000, tuning());
}
// The memory that the simulation uses shows which search is in use.
TEST(DiluteContainer, UsesListsWhileDiscsHaveGatheredAndCellsOtherwise) {
    const InitialState scene = dilute_container(500, 0.38);
    const auto bytes = [&](SearchMethod search) {
        return Simulation(scene, {}, {0, Width::best, search}).loop_counts().bytes;
    };
    const std::uint64_t cells = bytes(SearchMethod::cells), lists = bytes(SearchMethod::lists);
    ASSERT_NE(cells, lists);
    Simulation best(scene), by_cells(scene, {}, {0, Width::best, SearchMethod::cells});
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
    // A search that was requested is never replaced.
    EXPECT_EQ(by_cells.loop_counts().bytes, cells);
}
TEST(EngineEqualsGridReference, InALargeContainer) {
    if (sanitized) GTEST_SKIP() << "a million events";
    expect_same_for_every_width<GridReference>(large_container(10000), 200000, tuning());
}
// EngineEqualsGridReference.InADenseGas compares the first fifth of this for every width.
TEST(EngineWithManyDiscs, Slow_EqualsGridReferenceInADenseGasOfTenThousand) {
    if (sanitized) GTEST_SKIP() << "a million events";
    expect_same_trajectory<GridReference>(gas_at_rest(10000, 0.7), 1000000, {});
}
TEST(EngineWithManyDiscs, EqualsGridReferenceInADiluteGasOfTenThousand) {
    if (sanitized) GTEST_SKIP() << "two hundred thousand events";
    expect_same_trajectory<GridReference>(gas_at_rest(10000, 0.2), 200000, {});
}
// The tests above with ten thousand discs use the same lists, cells and queue.
TEST(EngineWithManyDiscs, Slow_EqualsGridReferenceInAContainerOfAHundredThousand) {
    if (sanitized) GTEST_SKIP() << "a million events";
    expect_same_trajectory<GridReference>(large_container(100000), 1000000, {});
}

TEST(Grid, CellsPerSideDoNotChangeResults) {
    const InitialState scene = paper_container(48);
    const auto events = static_cast<std::uint64_t>(fewer_if_sanitized(100000));
    Simulation all_pairs(scene, {}, {1, Width::best});
    all_pairs.run(events);
    for (const int cells : {2, 3, 4, 5, 6, 7, 8, 1000}) {
        Simulation grid(scene, {}, {cells, Width::best});
        grid.run(events);
        EXPECT_EQ(all_pairs.state_hash(), grid.state_hash()) << cells << " cells per side";
    }
}

TEST(Observation, DoesNotChangeResults) {
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
    Snapshot refreshed = simulation.snapshot();
    for (int k = 0; k < 5000; ++k) simulation.refresh(refreshed, simulation.step());
    const Snapshot fresh = simulation.snapshot();
    EXPECT_EQ(refreshed.x, fresh.x);
    EXPECT_EQ(refreshed.vy, fresh.vy);
    EXPECT_EQ(refreshed.spin, fresh.spin);
    EXPECT_EQ(refreshed.angle, fresh.angle);
    EXPECT_EQ(refreshed.held_at, fresh.held_at);
    EXPECT_EQ(refreshed.container_centre.x, fresh.container_centre.x);
}

TEST(Resume, FromDiscsAndProgressIsBitwiseIdentical) {
    expect_bitwise_identical_after_resuming(paper_container(48), 60000, 23456);
}

TEST(Resume, OfUnequalDiscsInCellsIsBitwiseIdentical) {
    expect_bitwise_identical_after_resuming(gas_of_two_sizes(50, 450, 0.1, 0.2, 3.0), 20000, 7654);
}

}  // namespace
}  // namespace swirl
