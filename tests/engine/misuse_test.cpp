// Wrong uses of the library: each ends with a sentence, works as documented, or is a precondition
// of docs/reference/cpp.md. The sanitizers run this test, too.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "swirl/engine/paper_scene.hpp"
#include "swirl/engine/placement.hpp"
#include "swirl/engine/simulation.hpp"
#include "swirl/engine/validate.hpp"

namespace swirl {
namespace {

using testing::HasSubstr;

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

InitialState ten_discs() { return paper_scene(10, 1.0, 1); }

InitialState ten_discs_with(const std::function<void(InitialState&)>& spoil) {
    InitialState scene = ten_discs();
    spoil(scene);
    return scene;
}

/// A call that stops the program, and words of its sentence.
struct WrongCall {
    const char* words;
    std::function<void()> call;
};

void expect_sentences(const std::vector<WrongCall>& calls) {
    GTEST_FLAG_SET(death_test_style, "fast");
    for (const WrongCall& wrong : calls) EXPECT_DEATH(wrong.call(), HasSubstr(wrong.words));
}

void simulate(const InitialState& scene, const Progress& progress = {}, const Tuning& tuning = {}) {
    Simulation simulation(scene, progress, tuning);
    simulation.run(10);
}

TEST(MisuseDeathTest, AWrongSceneStopsTheConstructor) {
    const auto with_mu = [](double mu) { return [mu] { simulate(paper_scene(10, mu, 1)); }; };
    expect_sentences({
        {"swirl::Simulation: the scene has no discs.", [] { simulate(paper_scene(0, 1.0, 1)); }},
        {"the scene has no discs.", [] { simulate(paper_scene(100, 1.0, 1)); }},
        {"mu of the discs is nan, but it must be from 0 to 1e+18.", with_mu(nan_value)},
        {"mu of the discs is -1, but it must be from 0 to 1e+18.", with_mu(-1.0)},
        {"mu of the discs is 1e+308, but it must be from 0 to 1e+18.", with_mu(1e308)},
        {"the period of the path is 0,", [] { simulate(InitialState{}); }},
        {"the radius of the container is inf, but it must be above 0 and at most 1e+18.",
         [] { simulate(ten_discs_with([](auto& s) { s.container_radius = infinite; })); }},
    });
}

TEST(MisuseDeathTest, WrongProgressStopsTheConstructor) {
    const auto with = [](const std::function<void(Progress&)>& spoil) {
        return [spoil] {
            Progress progress;
            spoil(progress);
            simulate(ten_discs(), progress);
        };
    };
    expect_sentences({
        {"swirl::Simulation: the number of periods is -7, but it must be from 0 to",
         with([](Progress& p) { p.periods = -7; })},
        {"the number of periods is 9223372036854775807, but it must be from 0 to 9007199254740992.",
         with([](Progress& p) { p.periods = std::numeric_limits<std::int64_t>::max(); })},
        {"the segment is 999, but the last one of the path is 29.",
         with([](Progress& p) { p.segment = 999; })},
        {"the clock is nan, but segment 0 of the path lasts from 0 to 0.395536.",
         with([](Progress& p) { p.clock = nan_value; })},
        {"the clock is 5, but segment 0", with([](Progress& p) { p.clock = 5.0; })},
        {"the number of path vertices is 0, but 60 segments have ended.",
         with([](Progress& p) { p.periods = 2; })},
        {"the number of collisions with the wall is 18446744073709551615,",
         with([](Progress& p) { p.events.disc_wall = ~std::uint64_t{0}; })},
    });
}

TEST(MisuseDeathTest, ADiscAtAWrongTimeStopsTheConstructor) {
    const auto disc_3 = [](const std::function<void(Disc&)>& spoil) {
        return [spoil] { simulate(ten_discs_with([&](auto& s) { spoil(s.discs[3]); })); };
    };
    expect_sentences({
        {"time of disc 3 is -1, but it must be from 0 to the clock, 0.",
         disc_3([](Disc& d) { d.time = -1.0; })},
        {"time of disc 3 is nan,", disc_3([](Disc& d) { d.time = nan_value; })},
        {"time of disc 3 is 0.5,", disc_3([](Disc& d) { d.time = 0.5; })},
        {"last_collision of disc 3 is inf,", disc_3([](Disc& d) { d.last_collision = infinite; })},
        {"disc 3 at (",
         [] {
             InitialState scene = ten_discs();
             scene.discs[3].velocity = {1e3, 0.0};
             Progress progress;
             progress.clock = 0.1;
             simulate(scene, progress);
         }},
    });
}

TEST(MisuseDeathTest, WrongTuningStopsTheConstructor) {
    const auto with = [](const Tuning& tuning) {
        return [tuning] { simulate(ten_discs(), {}, tuning); };
    };
    Tuning negative, many, width, search;
    negative.cells_per_side = -5;
    many.cells_per_side = 2'000'000'000;
    width.width = static_cast<Width>(99);
    search.search = static_cast<SearchMethod>(77);
    expect_sentences({
        {"cells_per_side is -5, but it must be from 0 to 30000.", with(negative)},
        {"cells_per_side is 2000000000, but it must be from 0 to 30000.", with(many)},
        {"width is 99, but this processor or this build has no loop of that width.", with(width)},
        {"search is 77, but the last search method is 3.", with(search)},
    });
}

TEST(MisuseDeathTest, AWrongTimeStopsAdvancing) {
    const auto to = [](std::int64_t periods, double clock) {
        return [=] {
            Simulation simulation(ten_discs());
            simulation.advance_to(1, 0.5);
            simulation.advance_to(periods, clock);
        };
    };
    expect_sentences({
        {"swirl::Simulation::advance_to: period 0 with the clock 0 is past, because the simulation "
         "is in period 1 and its clock is 0.5.",
         to(0, 0.0)},
        {"period 1 with the clock 0.25 is past", to(1, 0.25)},
        {"period -5 with the clock 0 is past", to(-5, 0.0)},
        {"the clock is nan, but it must be from 0 to the period, 11.8661.", to(2, nan_value)},
        {"the clock is inf,", to(2, infinite)},
        {"the clock is 1e+06,", to(2, 1e6)},
        {"the clock is -3,", to(2, -3.0)},
        {"the number of periods is 9223372036854775807,",
         to(std::numeric_limits<std::int64_t>::max(), 0.0)},
        {"swirl::Simulation::run_before: the clock is nan.",
         [] {
             EventSpan span;
             Simulation(ten_discs()).run_before(nan_value, 100, span);
         }},
        {"swirl::Simulation::observe_before: the clock is nan.",
         [] {
             EventSpan span;
             RotationSampling sampling{};
             Simulation(ten_discs()).observe_before(nan_value, 100, sampling, span);
         }},
        {"swirl::Simulation::observe_before: the rotation is one of another simulation.",
         [] {
             EventSpan span;
             RotationSampling sampling{};
             sampling.rotation.discs = 20;
             Simulation(ten_discs()).observe_before(1.0, 100, sampling, span);
         }},
    });
}

TEST(MisuseDeathTest, WrongSurroundingsStopTheChange) {
    const auto to = [](const InitialState& scene, std::uint64_t events) {
        return [=] {
            Simulation simulation(ten_discs());
            simulation.run(events);
            if (events == 0) simulation.advance_to(1, 0.0);
            simulation.change_surroundings(scene);
        };
    };
    InitialState circle = ten_discs(), narrow = ten_discs();
    circle.path = circular_path(paper_amplitude, paper_period);
    narrow.container_radius = 2.0;
    expect_sentences({
        {"swirl::Simulation::change_surroundings: the surroundings can change at the start of a "
         "period, but the clock is ",
         to(paper_scene(5, 1.0, 1), 500)},
        {"mu of the discs is nan", to(paper_scene(10, nan_value, 1), 0)},
        {"the path has no segments.", to(InitialState{}, 0)},
        {"the new path has 1 segments, but it must have as many as before, 30.", to(circle, 0)},
        {"beyond the container", to(narrow, 0)},
    });
}

TEST(Misuse, DiscsOfNewSurroundingsAreIgnored) {
    Simulation few(ten_discs()), same(ten_discs());
    few.advance_to(1, 0.0);
    same.advance_to(1, 0.0);
    few.change_surroundings(paper_scene(5, 1.0, 1));
    few.run(100);
    same.run(100);
    EXPECT_EQ(few.state_hash(), same.state_hash());
}

TEST(MisuseDeathTest, ADiscThatDoesNotExistStopsTheProgram) {
    const Simulation ten(ten_discs());
    expect_sentences({
        {"swirl::Simulation::disc: there is no disc of this number.", [&] { ten.disc(10); }},
        {"there is no disc of this number.", [&] { ten.disc(1'000'000); }},
        // The lower 32 bits of this number are those of disc 0.
        {"there is no disc of this number.", [&] { ten.disc(std::size_t{1} << 32); }},
    });
}

TEST(MisuseDeathTest, ASnapshotOfAnotherSimulationStopsTheProgram) {
    Simulation ten(ten_discs()), twenty(paper_scene(20, 1.0, 1));
    Snapshot of_ten = ten.snapshot(), empty, balls = of_ten;
    balls.resize_for_spheres(10);
    Event event = twenty.step();
    EventSpan span;
    twenty.run_before(1.0, 10, span);
    Event forged = event;
    forged.kind = EventKind::disc_disc;
    forged.i = 1000;
    forged.j = 2000;
    constexpr const char* words = "swirl::Simulation::refresh: the snapshot is one of another";
    expect_sentences({
        {words, [&] { twenty.refresh(of_ten, event); }},
        {words, [&] { twenty.refresh(of_ten, span); }},
        {words, [&] { twenty.refresh_angles(of_ten); }},
        {words, [&] { ten.refresh(empty, event); }},
        {words, [&] { ten.refresh(balls, event); }},
        {"the event names a disc that does not exist.", [&] { ten.refresh(of_ten, forged); }},
    });
}

TEST(Misuse, ASnapshotWithSkippedStepsKeepsEarlierStates) {
    Simulation simulation(ten_discs());
    Snapshot snapshot = simulation.snapshot();
    simulation.run(1000);
    const Event last = simulation.step();
    simulation.refresh(snapshot, last);
    EXPECT_EQ(snapshot.clock, simulation.clock());
    EXPECT_NE(snapshot.x, simulation.snapshot().x);
}

TEST(MisuseDeathTest, AWrongRadiusStopsThePlacement) {
    const auto place = [](const std::vector<double>& radii, double container_radius) {
        return [=] { place_discs(radii, container_radius, 1); };
    };
    expect_sentences({
        {"swirl::place_discs: the radius of disc 2 is nan, but it must be above 0 and at most "
         "1e+18.",
         place({1.0, 1.0, nan_value}, 8.6)},
        {"the radius of disc 1 is -1,", place({1.0, -1.0, 1.0}, 8.6)},
        {"the radius of disc 0 is 0,", place({0.0}, 8.6)},
        {"the radius of the container is nan,", place({1.0, 1.0}, nan_value)},
        {"the radius of the container is inf,", place({1.0, 1.0}, infinite)},
        {"swirl::max_discs_in_container: the radius of disc 0 is 0,",
         [] { max_discs_in_container(0.0, 1.0); }},
        {"the radius of disc 0 is -1,", [] { max_discs_in_container(-1.0, 1.0); }},
        {"the radius of disc 0 is nan,", [] { max_discs_in_container(nan_value, 1.0); }},
        {"the radius of the container is inf,", [] { max_discs_in_container(1.0, infinite); }},
        {"swirl::discs_in_densest_known_arrangement: the radius of disc 0 is 0,",
         [] { discs_in_densest_known_arrangement(0.0, 1.0); }},
        {"the radius of disc 0 is nan,",
         [] { discs_in_densest_known_arrangement(nan_value, 1.0); }},
    });
}

TEST(Misuse, ExtremeButValidSizesArePlaced) {
    EXPECT_THAT(place_discs({}, 8.6, 1), testing::Optional(testing::IsEmpty()));
    EXPECT_THAT(place_discs({1e-300, 1e-300}, 8.6, 1), testing::Optional(testing::SizeIs(2)));
    EXPECT_THAT(place_discs({1.0, 1e-300}, 8.6, 1), testing::Optional(testing::SizeIs(2)));
}

TEST(Misuse, MoreDiscsThanFitLeaveThePapersSceneEmpty) {
    for (const std::size_t discs : {std::size_t{100}, std::size_t{1'000'000'000}, ~std::size_t{0}})
        EXPECT_THAT(validate(paper_scene(discs, 1.0, 1)),
                    testing::Optional(HasSubstr("the scene has no discs")));
}

TEST(Misuse, ValidateNamesTheNumberThatIsWrong) {
    const std::vector<std::pair<const char*, std::function<void(InitialState&)>>> cases = {
        {"position.x of disc 0 is nan, but its magnitude must be at most 1e+18.",
         [](auto& s) {
             s.discs[0].position = {nan_value, 0.0};
         }},
        {"velocity.x of disc 0 is 1e+200, but its magnitude must be at most 1e+18.",
         [](auto& s) {
             s.discs[0].velocity = {1e200, 0.0};
         }},
        {"angle of disc 0 is inf,", [](auto& s) { s.discs[0].angle = infinite; }},
        {"spin of disc 0 is nan,", [](auto& s) { s.discs[0].spin = nan_value; }},
        {"discs 0 and 1 overlap", [](auto& s) { s.discs[1].position = s.discs[0].position; }},
    };
    for (const auto& [words, spoil] : cases)
        EXPECT_THAT(validate(ten_discs_with(spoil)), testing::Optional(HasSubstr(words)));
}

TEST(Misuse, RareButValidScenesRun) {
    Simulation one(paper_scene(1, 1.0, 1)), slow(ten_discs_with([](auto&s) {
        for (Disc& d : s.discs) d.velocity = {0.0, 0.0};
        s.discs[0].velocity = {1e-300, 0.0};
    }));
    one.run(10'000);
    slow.run(1'000);
    EXPECT_EQ(one.events().total(), 10'000u);
    EXPECT_EQ(slow.events().total(), 1'000u);
    one.run(0);
    EXPECT_EQ(one.events().total(), 10'000u);
}

TEST(Misuse, ThreadsWithSimulationsOfTheirOwnGetTheSameTrajectory) {
    std::array<std::uint64_t, 4> hashes{};
    std::vector<std::thread> threads;
    for (std::uint64_t& hash : hashes)
        threads.emplace_back([&hash] {
            Simulation simulation(paper_scene(48, 1.0, 1));
            simulation.run(5'000);
            hash = simulation.state_hash();
        });
    for (std::thread& thread : threads) thread.join();
    EXPECT_THAT(hashes, testing::Each(hashes[0]));
}

/// What is undefined cannot be executed in a test, so the page must say it.
TEST(Misuse, WhatIsNotCheckedIsDocumented) {
    std::ifstream file(SWIRL_SOURCE_DIR "/docs/reference/cpp.md");
    const std::string page{std::istreambuf_iterator<char>(file), {}};
    EXPECT_THAT(page, HasSubstr("a simulation that was moved from"));
    EXPECT_THAT(page, HasSubstr("a simulation whose construction `tuning.is_stopped` ended"));
    EXPECT_THAT(page, HasSubstr("two threads that use one simulation at the same time"));
}

}  // namespace
}  // namespace swirl
