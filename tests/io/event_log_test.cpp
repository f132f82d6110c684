#include "swirl/io/event_log.hpp"

#include "io/scratch.hpp"
#include "swirl/io/atomic_file.hpp"
#include "swirl/io/checkpoint.hpp"
#include "swirl/io/file_error.hpp"
#include "swirl/io/state_archive.hpp"
#include "swirl/measure/cluster_rotation.hpp"

namespace swirl {
namespace {

void expect_same_discs(const std::vector<Disc>& replayed, const Simulation& simulation) {
    for (std::size_t i = 0; i < replayed.size(); ++i) {
        const Disc &a = replayed[i], b = simulation.disc(i);
        ASSERT_EQ(a.position.x, b.position.x) << i;
        ASSERT_EQ(a.position.y, b.position.y) << i;
        ASSERT_EQ(a.velocity.x, b.velocity.x) << i;
        ASSERT_EQ(a.velocity.y, b.velocity.y) << i;
        ASSERT_EQ(a.angle, b.angle) << i;
        ASSERT_EQ(a.spin, b.spin) << i;
        ASSERT_EQ(a.time, b.time) << i;
        ASSERT_EQ(a.rolling_spin.x, b.rolling_spin.x) << i;
        ASSERT_EQ(a.rolling_spin.y, b.rolling_spin.y) << i;
    }
}

/// A mixture, because with radii, masses and inertias of 1 the test would not detect a missing
/// factor.
InitialState mixed_container() {
    InitialState scene = paper_container(20, 7);
    scene.disc_surface.mu = 0.3;
    scene.path = polygon_path(1.892, 10.7, 7);  // 7 · (10.7/7) is not 10.7
    for (std::size_t i = 0; i < scene.discs.size(); i += 3) {
        scene.discs[i].radius = 0.83;
        scene.discs[i].mass = 0.71;
        scene.discs[i].inertia = 1.9;
    }
    for (std::size_t i = 0; i < scene.discs.size(); i += 4)
        scene.discs[i].spin = scene.discs[i].can_spin = 0.0;
    return scene;
}

TEST(EventLog, ReplayIsBitwiseIdenticalToTheRun) {
    const Scratch scratch;
    const InitialState scene = mixed_container();
    Simulation simulation(scene);
    {
        EventLogWriter log(scratch / "events.h5", simulation.snapshot(),
                           scene.path.segments.back().end, {{"version", "1"}});
        for (int k = 0; k < 20'000; ++k) log.write(simulation.step());
        log.finish();
    }
    ASSERT_GT(simulation.periods(), 3);
    EventLogReader log(scratch / "events.h5");
    ASSERT_EQ(log.events(), 20'000u);
    EXPECT_TRUE(log.complete());
    Simulation again(scene);
    Replay replay(log.initial(), log.period_end());
    for (std::uint64_t first = 0; first < log.events(); first += 5'000)
        for (const Event& event : log.read(first, 5'000)) {
            const Event happened = again.step();
            ASSERT_EQ(event.clock, happened.clock);
            ASSERT_EQ(event.kind, happened.kind);
            ASSERT_EQ(event.impulse.sticks, happened.impulse.sticks);
            replay.apply(event);
            if (first % 10'000 == 0 && event.i % 7 == 0) expect_same_discs(replay.discs(), again);
        }
    EXPECT_EQ(replay.periods(), simulation.periods());
    expect_same_discs(replay.discs(), simulation);
}

TEST(EventLog, ReplayOfSpheresAndCoinsIsBitwiseIdenticalToTheRun) {
    for (const Floor floor :
         {Floor{.deceleration = 1.92}, Floor{.deceleration = 0.0},
          Floor{.deceleration = 1.92, .bodies_lie_flat = true},
          Floor{.deceleration = 1.92, .bodies_lie_flat = false, .rolling_resistance = 0.5}}) {
        const Scratch scratch;
        InitialState scene = mixed_container();
        scene.shape = floor.bodies_lie_flat ? Shape::coin : Shape::sphere;
        scene.floor = floor;
        scene.disc_surface.restitution = scene.wall_surface.restitution = 0.9;
        scene.disc_surface.contact_duration = scene.wall_surface.contact_duration = 1e-3;
        Simulation simulation(scene);
        {
            EventLogWriter log(scratch / "events.h5", simulation.snapshot(),
                               scene.path.segments.back().end, {}, default_compression,
                               moving_floor(scene.floor, scene.path));
            for (int k = 0; k < 20'000; ++k) log.write(simulation.step());
            log.finish();
        }
        ASSERT_GT(simulation.periods(), 3);
        EventLogReader log(scratch / "events.h5");
        Replay replay(log.initial(), log.period_end(), log.floor());
        for (const Event& event : log.read(0, 20'000)) replay.apply(event);
        EXPECT_EQ(simulation.events().begins_to_roll > 0, floor.deceleration > 0.0);
        expect_same_discs(replay.discs(), simulation);
    }
}

TEST(EventLog, ResumedLogEqualsUninterruptedLog) {
    const Scratch scratch;
    const InitialState scene = mixed_container();
    const double end = scene.path.segments.back().end;
    Simulation simulation(scene);
    std::vector<Event> happened;
    {
        EventLogWriter log(scratch / "e.h5", simulation.snapshot(), end, {});
        for (int k = 0; k < 9'000; ++k) {
            happened.push_back(simulation.step());
            log.write(happened.back());
        }
        log.flush();
    }
    auto log = EventLogWriter::resume(scratch / "e.h5", 5'000);
    for (int k = 5'000; k < 9'000; ++k) log.write(happened[std::size_t(k)]);
    log.finish();
    const auto events = EventLogReader(scratch / "e.h5").read(0, 9'000);
    for (std::size_t k = 0; k < events.size(); ++k) ASSERT_EQ(events[k].clock, happened[k].clock);
    EXPECT_THROW(EventLogWriter::resume(scratch / "absent.h5", 1), FileError);
}

TEST(StateArchive, RoundTripIsExact) {
    ClusterRotation rotation;
    Simulation simulation(paper_container(9, 3));
    for (int k = 0; k < 3'000; ++k) {
        const Event event = simulation.step();
        rotation.sample(simulation.snapshot(), event);
        rotation.sample_by_time(simulation.snapshot());
        if (event.kind == EventKind::path_vertex) rotation.close_block();
    }
    std::map<std::string, std::vector<bool>> flags{{"a", {true, false}}, {"", {}}};
    std::optional<double> nothing, something = 2.5;
    StateWriter writer;
    writer(rotation, flags, nothing, something);

    ClusterRotation rotation2;
    std::map<std::string, std::vector<bool>> flags2;
    std::optional<double> nothing2 = 1.0, something2;
    StateReader reader(writer.bytes());
    reader(rotation2, flags2, nothing2, something2);
    reader.expect_end();
    EXPECT_EQ(flags2, flags);
    EXPECT_EQ(nothing2, nothing);
    EXPECT_EQ(something2, something);
    const Estimate a = rotation.estimates().mean_by_event, b = rotation2.estimates().mean_by_event;
    EXPECT_EQ(a.mean, b.mean);
    EXPECT_EQ(a.error, b.error);
    EXPECT_GT(a.blocks, 10u);
    // Both continue identically, also between two vertices of the path.
    for (int k = 0; k < 200; ++k) {
        const Event event = simulation.step();
        ASSERT_TRUE(k > 0 || event.kind != EventKind::path_vertex);
        const Snapshot s = simulation.snapshot();
        ASSERT_EQ(rotation.sample(s, event).individual, rotation2.sample(s, event).individual) << k;
    }

    for (std::size_t cut = 0; cut < writer.bytes().size(); cut += 13) {
        StateReader shorter(std::string_view(writer.bytes()).substr(0, cut));
        EXPECT_THROW(shorter(rotation2, flags2, nothing2, something2), FileError) << cut;
    }
}

struct Plain {
    double a;
    std::int64_t b;
    friend bool operator==(const Plain&, const Plain&) = default;
};

TEST(StateArchive, VectorBytesEqualThoseOfSingleElements) {
    // Elements with a format of their own, such as std::optional, keep it in a vector.
    std::vector<Plain> plain{{0.5, -3}, {-0.0, 7}};
    std::vector<std::optional<double>> gaps{1.5, {}, 2.5};
    std::vector<std::pair<double, bool>> pairs{{1.0, true}, {2.0, false}};
    std::vector<std::array<std::optional<int>, 2>> arrays{{{1, {}}}};
    StateWriter many, single;
    many(plain, gaps, pairs, arrays);
    const auto one_by_one = [&](auto& values) {
        std::uint64_t n = values.size();
        single(n);
        for (auto& value : values) single(value);
    };
    one_by_one(plain), one_by_one(gaps), one_by_one(pairs), one_by_one(arrays);
    EXPECT_EQ(many.bytes(), single.bytes());

    std::vector<Plain> plain2;
    std::vector<std::optional<double>> gaps2;
    std::vector<std::pair<double, bool>> pairs2;
    std::vector<std::array<std::optional<int>, 2>> arrays2;
    StateReader reader(many.bytes());
    reader(plain2, gaps2, pairs2, arrays2);
    reader.expect_end();
    EXPECT_EQ(plain2, plain);
    EXPECT_EQ(gaps2, gaps);
    EXPECT_EQ(pairs2, pairs);
    EXPECT_EQ(arrays2, arrays);
}

TEST(StateArchive, AsTextReadsBackAsOneString) {
    double before = 1.0, inside = 2.0, after = 3.0;
    StateWriter writer;
    writer(before);
    writer.as_text([&](StateWriter& in) { in(inside, inside); });
    writer(after);

    double before2, inside2, after2;
    std::string text;
    StateReader reader(writer.bytes());
    reader(before2, text, after2);
    reader.expect_end();
    EXPECT_EQ(after2, after);
    StateReader in_text(text);
    in_text(inside2, inside2);
    in_text.expect_end();
    EXPECT_EQ(inside2, inside);
}

std::string rejection(const std::filesystem::path& path) {
    try {
        read_checkpoint(path);
    } catch (const FileError& error) {
        return error.what();
    }
    return "";
}

TEST(Checkpoint, RoundTripIsExact) {
    const Scratch scratch;
    const std::string state("a\0b", 3);
    write_checkpoint(scratch / "c", {"{\"discs\": 3}", state});
    const Checkpoint back = read_checkpoint(scratch / "c");
    EXPECT_EQ(back.about, "{\"discs\": 3}");
    EXPECT_EQ(back.state, state);
}

TEST(Checkpoint, EveryTruncationAndBitFlipIsRejected) {
    const Scratch scratch;
    write_checkpoint(scratch / "c", {"about", std::string(300, 'x')});
    const std::string whole = read_whole_file(scratch / "c");
    for (std::size_t cut = 0; cut < whole.size(); ++cut) {
        write_quickly(scratch / "d", whole.substr(0, cut));
        EXPECT_NE(rejection(scratch / "d"), "") << "cut at " << cut;
    }
    for (std::size_t at = 0; at < whole.size(); ++at) {
        std::string flipped = whole;
        flipped[at] = char(flipped[at] ^ 4);
        write_quickly(scratch / "d", flipped);
        EXPECT_NE(rejection(scratch / "d"), "") << "bit flipped at " << at;
    }
    write_quickly(scratch / "d", whole + "x");
    EXPECT_NE(rejection(scratch / "d").find("is damaged"), std::string::npos);
}

TEST(Checkpoint, ForeignAndOlderFilesAreRejected) {
    const Scratch scratch;
    write_file_atomically(scratch / "d", "{\"config\": 1}");
    EXPECT_NE(rejection(scratch / "d").find("is not a checkpoint of swirl"), std::string::npos);
    write_file_atomically(scratch / "d", "swirl checkpoint 0\n0123456789012345678901234567890");
    EXPECT_NE(rejection(scratch / "d").find("is a checkpoint of format 0"), std::string::npos);
    EXPECT_NE(rejection(scratch / "absent").find("could not be opened"), std::string::npos);
}

TEST(Checkpoint, SizePerDiscIsThatOfItsState) {
    const Scratch scratch;
    std::vector<Disc> discs(100'000, Disc{{1, 2}, {3, 4}, 5, 6, 7, 8, 9, 10});
    StateWriter state;
    state(discs);
    write_checkpoint(scratch / "c", {"", state.bytes()});
    // The number of discs, the first line of 20 bytes, two lengths, and the checksum.
    EXPECT_EQ(std::filesystem::file_size(scratch / "c"), 100'000 * sizeof(Disc) + 8 + 20 + 24);
}

TEST(EventLog, MoreVerticesThanPathSegmentsAreRejected) {
    Disc sphere{};
    sphere.radius = sphere.mass = sphere.inertia = 1.0;
    Replay replay({sphere}, 10.0, MovingFloor{{.deceleration = 2.0}, {{1.0, 0.0}, {0.0, 1.0}}});
    const auto vertex = [](double clock) {
        return Event{0, clock, EventKind::path_vertex, 0, 0, {}, {}, 0.0};
    };
    replay.apply(vertex(2.0));
    EXPECT_THROW(replay.apply(vertex(4.0)), FileError);
}

}  // namespace
}  // namespace swirl
