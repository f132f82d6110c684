#include "swirl/io/tracks.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "io/scratch.hpp"
#include "swirl/io/file_error.hpp"
#include "swirl/io/track_repair.hpp"

namespace swirl {
namespace {

Tracks tracks_in(const std::string& text) {
    const Scratch scratch;
    write_quickly(scratch / "tracks.csv", text);
    return read_track_table(scratch / "tracks.csv");
}
Tracks repaired(const std::string& text, double radius) {
    Tracks tracks = tracks_in(text);
    repair(tracks, radius);
    return tracks;
}
Tracks dump_in(const std::string& text) {
    const Scratch scratch;
    write_quickly(scratch / "a.dump", text);
    return read_lammps_dump(scratch / "a.dump");
}
template <class Read>
std::string error_message(Read read, const std::string& text) {
    try {
        read(text);
    } catch (const FileError& error) {
        return error.what();
    }
    return "";
}

/// One frame of one disc at (x, y) pixels.
Snapshot seen(double x, double y, const TrackScale& scale, int frame = 0) {
    const std::string text = "frame,particle,x,y\n" + std::to_string(frame) + ",0," +
                             std::to_string(x) + "," + std::to_string(y) + "\n";
    return series_of(tracks_in(text), scale).frame(0);
}

TEST(TrackpyTable, ColumnsAndRowsMayHaveAnyOrder) {
    const Tracks tracks = tracks_in(
        "mass,y,x,frame,particle,ep\n"
        "9,20.5,10,1.0,7,\n"
        "9,4,3,0,7,\n"
        "9,2,1,0,3,\n"
        "9,8,7,1,3,nan\r\n"
        "\n");
    ASSERT_EQ(tracks.frames.size(), 2u);
    EXPECT_TRUE(tracks.y_down);
    for (const auto& frame : tracks.frames) EXPECT_EQ(frame.id, (std::vector<std::int64_t>{3, 7}));
    EXPECT_EQ(tracks.frames[0].number, 0);
    EXPECT_EQ(tracks.frames[1].number, 1);
    EXPECT_EQ(tracks.frames[0].position[1].x, 3.0);
    EXPECT_EQ(tracks.frames[1].position[1].y, 20.5);
    EXPECT_EQ(tracks.frames[1].position[0].x, 7.0);
}

TEST(TrackpyTable, AcceptsSpreadsheetExports) {
    const Tracks tracks = tracks_in(
        "\xef\xbb\xbf\"frame\",\"particle\", x ,\"y\",\"note\"\r\n"
        "\"0\",\"7\",1.5, 2.5,\"near, the wall\"\r\n");
    ASSERT_EQ(tracks.frames.size(), 1u);
    EXPECT_EQ(tracks.frames[0].id.at(0), 7);
    EXPECT_EQ(tracks.frames[0].position.at(0).x, 1.5);
    EXPECT_EQ(tracks.frames[0].position.at(0).y, 2.5);
}

/// One table as each tracker writes it: frames 0 and 1 of the particles 3 and 7, of which 7 has no
/// position in frame 1.
struct Dialect {
    const char* name;
    std::string frame, particle, x, y;  // columns
    std::string units{};                // rows below the header
};
std::string table_in(const Dialect& dialect, char separator, const std::string& missing,
                     bool y_up) {
    const auto row = [&](const std::vector<std::string>& cells) {
        std::string line = cells.front();
        for (std::size_t k = 1; k < cells.size(); ++k) line += separator + cells[k];
        return line + "\n";
    };
    const std::string sign = y_up ? "-" : "";
    return row({dialect.x, "spare", dialect.frame, dialect.particle, dialect.y}) + dialect.units +
           row({"1.5", "a", "0", "3", sign + "4"}) + row({"2.5", "b", "0", "7", sign + "5"}) +
           row({"3.5", "c", "1", "3", sign + "6"}) + row({missing, "d", "1", "7", sign + "7"}) +
           row({"9.5", "e", "1", missing, sign + "8"});
}

TEST(TrackTable, AnyTrackersColumnsSeparatorsGapsAndDirectionsAreRead) {
    const Dialect dialects[] = {
        {"trackpy", "frame", "particle", "x", "y"},
        {"TrackMate", "FRAME", "TRACK_ID", "POSITION_X", "POSITION_Y",
         "X\tz\tFrame\tTrack ID\tY\n(mm)\tz\t \t \t(mm)\n"},
        {"MOSAIC", "Frame", "Trajectory", "x", "y"},
        {"Manual Tracking", "Slice n°", "Track n°", "X", "Y"},
        {"named", "Bild", "Spur", "Ort", "Hoehe"},
    };
    for (const Dialect& dialect : dialects)
        for (const char separator : {'\t', ',', ';'})
            for (const std::string missing : {"", "nan", "NA"})
                for (const bool y_up : {false, true}) {
                    Dialect written = dialect;
                    std::replace(written.units.begin(), written.units.end(), '\t', separator);
                    TableLayout layout{.y_up = y_up};
                    if (dialect.name == std::string("named"))
                        layout = {.frame = "bild",
                                  .particle = "Spur",
                                  .x = "Ort",
                                  .y = "Hoehe",
                                  .y_up = y_up};
                    const Scratch scratch;
                    write_quickly(scratch / "a.csv", table_in(written, separator, missing, y_up));
                    const Tracks tracks = read_track_table(scratch / "a.csv", layout);
                    const std::string about =
                        fmt::format("{} '{}' '{}' {}", dialect.name, separator, missing, y_up);
                    ASSERT_EQ(tracks.frames.size(), 2u) << about;
                    EXPECT_EQ(tracks.frames[0].id, (std::vector<std::int64_t>{3, 7})) << about;
                    EXPECT_EQ(tracks.frames[1].id, (std::vector<std::int64_t>{3})) << about;
                    // Both directions of y are the same place in the dish.
                    TrackScale scale;
                    scale.pixels_per_radius = 2.0;
                    scale.container_radius = 10.0;
                    const Snapshot frame = series_of(tracks, scale).frame(1);
                    EXPECT_EQ(frame.position(0).x, 1.75) << about;
                    EXPECT_EQ(frame.position(0).y, -3.0) << about;
                }
}

TEST(TrackpyTable, ErrorsNameTheLine) {
    const auto rejected = [](const std::string& text) { return error_message(tracks_in, text); };
    const std::string head = "frame,particle,x,y\n";
    EXPECT_NE(rejected("").find("has no rows"), std::string::npos);
    EXPECT_NE(rejected(head).find("holds no positions"), std::string::npos);
    for (const char* missing : {"particle,x,y\n0,1,2\n", "frame,x,y\n0,1,2\n",
                                "frame,particle,y\n0,0,1\n", "frame:particle:x:y\n0:0:1:2\n"})
        EXPECT_NE(rejected(missing).find("line 1: the header must name the columns"),
                  std::string::npos)
            << missing;
    for (const char* name : {"frame", "particle", "x", "y"})
        EXPECT_NE(rejected(fmt::format("frame,particle,x,y,{}\n0,0,1,2,0\n", name))
                      .find(fmt::format("line 1: there are two columns '{}'", name)),
                  std::string::npos);
    // Columns that are not read may be without a name, as spreadsheets write them.
    EXPECT_EQ(tracks_in("frame,particle,x,y,,\n0,0,1,2,,\n").frames.size(), 1u);
    EXPECT_NE(rejected(head + "0,0,1,2\n0,1,inf,2\n")
                  .find("line 3: column 'x' is 'inf', but it must be a finite number"),
              std::string::npos);
    EXPECT_NE(rejected(head + "0,0,,2\n").find("holds no positions"), std::string::npos);
    EXPECT_NE(rejected(head + "0,0,1e999,2\n").find("line 2"), std::string::npos);
    EXPECT_NE(rejected(head + "0.5,0,1,2\n")
                  .find("column 'frame' is '0.5', but it must be a whole number"),
              std::string::npos);
    EXPECT_NE(rejected(head + "0,0,1\n").find("line 2: 3 fields, but the first line has 4"),
              std::string::npos);
    EXPECT_NE(rejected(head + "0,5,1,2\n1,5,1,2\n0,5,1,2\n")
                  .find("line 4: particle 5 appears twice "
                        "in frame 0"),
              std::string::npos);
}

TEST(TrackpyTable, TimesAscendAndEachFrameHasOne) {
    const auto rejected = [](const std::string& text) { return error_message(tracks_in, text); };
    const std::string head = "frame,particle,x,y,seen,time,radius,spin\n";
    EXPECT_EQ(tracks_in(head + "7,1,1,2,1,0.1,3,\n8,1,1,2,1,0.2,3,\n").frames.size(), 2u);
    EXPECT_NE(rejected(head + "7,1,1,2,1,0.2,3,\n8,1,1,2,1,0.1,3,\n")
                  .find("the time of frame 8 is 0.1, which is not after the time 0.2 of frame 7"),
              std::string::npos);
    // A duplicate of a frame.
    EXPECT_NE(rejected(head + "7,1,1,2,1,0.2,3,\n8,1,1,2,1,0.2,3,\n").find("is not after"),
              std::string::npos);
    EXPECT_NE(rejected(head + "7,1,1,2,1,0.2,3,\n7,2,9,2,1,0.3,3,\n")
                  .find("line 3: the time of frame 7 is 0.3, but 0.2 in an earlier line"),
              std::string::npos);
}

TEST(RepairedTracks, OnlyShortGapsAreInterpolated) {
    // Missing in frames 2 … 6, and then in six frames.
    const Tracks tracks = repaired(
        "frame,particle,x,y\n0,0,-1,14\n1,0,0,12\n7,0,6,0\n8,0,6,0\n15,0,6,0\n16,0,6,0\n", 100.0);
    EXPECT_EQ(tracks.repaired.filled, 5u);
    EXPECT_EQ(tracks.repaired.relabelled, 0u);
    ASSERT_EQ(tracks.frames.size(), 11u);
    for (int k = 1; k <= 7; ++k) {
        EXPECT_EQ(tracks.frames[std::size_t(k)].number, k);
        // The steps are thirds and sixths, which are rounded once.
        EXPECT_NEAR(tracks.frames[std::size_t(k)].position[0].x, k - 1, 1e-14);
        EXPECT_NEAR(tracks.frames[std::size_t(k)].position[0].y, 14 - 2 * k, 1e-14);
    }
    EXPECT_EQ(tracks.frames[9].number, 15);
}

TEST(RepairedTracks, EverySecondFrameIsNoGap) {
    const Tracks tracks =
        repaired("frame,particle,x,y\n0,0,0,0\n2,0,1,0\n4,0,2,0\n8,0,4,0\n10,0,5,0\n", 10.0);
    EXPECT_EQ(tracks.repaired.filled, 1u);  // frame 6
    ASSERT_EQ(tracks.frames.size(), 6u);
    EXPECT_EQ(tracks.frames[3].number, 6);
    EXPECT_EQ(tracks.frames[3].position[0].x, 3.0);
}

/// Two discs that move to the right, 20 pixels apart, for 40 frames.
std::string two_discs(int (*id)(int frame, int disc), int (*lost)(int frame, int disc)) {
    std::string text = "frame,particle,x,y\n";
    for (int k = 0; k < 40; ++k)
        for (int disc = 0; disc < 2; ++disc)
            if (!lost(k, disc))
                text += std::to_string(k) + "," + std::to_string(id(k, disc)) + "," +
                        std::to_string(k + 20 * disc) + ",0\n";
    return text;
}

void expect_two_whole_discs(const Tracks& tracks) {
    ASSERT_EQ(tracks.frames.size(), 40u);
    for (const TrackFrame& frame : tracks.frames) {
        EXPECT_EQ(frame.id, (std::vector<std::int64_t>{3, 8}));
        EXPECT_NEAR(frame.position[0].x, double(frame.number), 1e-12);
        EXPECT_NEAR(frame.position[1].x, double(frame.number) + 20.0, 1e-12);
    }
}

TEST(RepairedTracks, IdentitySwapsAreUndone) {
    const Tracks tracks =
        repaired(two_discs([](int k, int d) { return (k < 17) == (d == 0) ? 3 : 8; },
                           [](int, int) { return 0; }),
                 10.0);
    expect_two_whole_discs(tracks);
    EXPECT_EQ(tracks.repaired.relabelled, 2u);
    EXPECT_EQ(tracks.repaired.filled, 0u);
}

TEST(RepairedTracks, ADiscThatReappearsWithAnotherIdKeepsItsOwn) {
    const Tracks tracks =
        repaired(two_discs([](int k, int d) { return d == 0   ? 3
                                                     : k < 20 ? 8
                                                              : 11; },
                           [](int k, int d) { return int(d == 1 && k >= 20 && k < 24); }),
                 10.0);
    expect_two_whole_discs(tracks);
    EXPECT_EQ(tracks.repaired.relabelled, 1u);
    EXPECT_EQ(tracks.repaired.filled, 4u);
}

TEST(RepairedTracks, ADiscLostForLongerGetsANewId) {
    const Tracks tracks =
        repaired(two_discs([](int k, int d) { return d == 0   ? 3
                                                     : k < 20 ? 8
                                                              : 11; },
                           [](int k, int d) { return int(d == 1 && k >= 20 && k < 26); }),
                 10.0);
    EXPECT_EQ(tracks.repaired.relabelled, 0u);
    EXPECT_EQ(tracks.frames[22].id, (std::vector<std::int64_t>{3}));
    EXPECT_EQ(tracks.frames[30].id, (std::vector<std::int64_t>{3, 11}));
    EXPECT_EQ(series_of(tracks, {}).breaks, (std::vector<std::uint64_t>{20, 26}));
}

TEST(RepairedTracks, IsolatedPositionsAreDropped) {
    const Tracks tracks = repaired(
        "frame,particle,x,y\n0,0,0,0\n1,0,1,0\n2,0,2,0\n9,0,9,0\n16,0,16,0\n17,0,17,0\n", 10.0);
    EXPECT_EQ(tracks.repaired.dropped, 1u);
    ASSERT_EQ(tracks.frames.size(), 5u);
    EXPECT_EQ(tracks.frames[3].number, 16);
}

TEST(RepairedTracks, TracksWithMoreThanPositionsAreUnchanged) {
    Tracks tracks = tracks_in("frame,particle,x,y\n0,0,0,0\n1,0,1,0\n3,0,3,0\n4,0,3,0\n");
    for (TrackFrame& frame : tracks.frames) frame.mass = {1.0};
    repair(tracks, 10.0);
    EXPECT_EQ(tracks.frames.size(), 4u);
}

TEST(RepairedTracks, ADetectionInASingleFrameIsDropped) {
    const Tracks tracks =
        repaired(two_discs([](int, int d) { return d == 0 ? 3 : 8; }, [](int, int) { return 0; }) +
                     "12,99,300,0\n",
                 10.0);
    expect_two_whole_discs(tracks);
    EXPECT_EQ(tracks.repaired.dropped, 1u);
}

TEST(RepairedTracks, GivenIdsAreKeptIfMovesAreLarge) {
    std::string text = "frame,particle,x,y\n";
    for (int k = 0; k < 40; ++k)
        text += std::to_string(k) + ",3," + std::to_string(15 * k) + ",0\n";
    const Tracks tracks = repaired(text, 10.0);
    EXPECT_EQ(tracks.frames.size(), 40u);
    EXPECT_TRUE(series_of(tracks, {}).same_discs());
}

TEST(UncertainLinks, TheDiscHasAnotherIdAfterALinkAndNoPositionInBetween) {
    Tracks tracks = tracks_in(
        "frame,particle,x,y,seen,radius\n"
        "0,3,0,0,1,5\n0,7,9,0,1,6\n"
        "1,3,1,0,1,5\n1,7,9,1,1,6\n"
        "2,3,2,0,0,5\n2,7,9,2,1,6\n"
        "3,3,3,0,1,5\n3,7,9,3,1,6\n"
        "4,3,4,0,1,5\n4,7,9,4,1,6\n");
    // Links of one disc may be given in any order.
    cut(tracks, {{.id = 3, .from = 1, .to = 3}, {.id = 3, .from = 3, .to = 4}});
    const std::vector<std::vector<std::int64_t>> ids{{3, 7}, {3, 7}, {7}, {7, 9}, {7, 8}};
    for (std::size_t k = 0; k < ids.size(); ++k) {
        ASSERT_EQ(tracks.frames[k].id, ids[k]) << k;
        // The values of a disc stay together.
        for (std::size_t i = 0; i < ids[k].size(); ++i)
            EXPECT_EQ(tracks.frames[k].radius[i], tracks.frames[k].position[i].x == 9.0 ? 6.0 : 5.0)
                << k;
    }
}

TEST(TrackScale, ConvertsPixelsToRadiiWithYUp) {
    TrackScale scale{.container_radius = 8.5};
    scale.pixels_per_radius = 20.0;
    scale.swirl_centre = {500.0, 400.0};
    const Snapshot s = seen(540.0, 370.0, scale);
    EXPECT_EQ(s.position(0).x, 2.0);
    EXPECT_EQ(s.position(0).y, 1.5);
    EXPECT_TRUE(std::isnan(s.spin[0]));
    scale.clockwise = true;  // mirrored, so that the swirl runs counter-clockwise
    EXPECT_EQ(seen(540.0, 370.0, scale).position(0).x, -2.0);
    EXPECT_EQ(seen(540.0, 370.0, scale).position(0).y, 1.5);
}

TEST(TrackScale, ClockFollowsFromFrameRateAndPeriod) {
    TrackScale scale{.container_radius = 8.5};
    scale.frames_per_time = 10.0;
    scale.period = 4.0;
    const Snapshot s = seen(0.0, 0.0, scale, 93);  // time 9.3
    EXPECT_EQ(s.periods, 2);
    EXPECT_DOUBLE_EQ(s.clock, 1.3);
    EXPECT_EQ(s.period, 4.0);
}

TEST(TrackScale, ContainerPositionFollowsFromTheSwirl) {
    TrackScale scale;
    scale.frames_per_time = 8.0;
    scale.period = 1.0;
    scale.amplitude = 3.0;
    scale.phase = pi / 2.0;
    scale.container_radius = 8.5;
    // A quarter of a period after having been at the top: to the left, moving down.
    const Snapshot s = seen(0.0, 0.0, scale, 2);
    EXPECT_EQ(s.container_radius, 8.5);
    EXPECT_NEAR(s.container_centre.x, -3.0, 1e-14);
    EXPECT_NEAR(s.container_centre.y, 0.0, 1e-14);
    // Its speed is the unit of speed.
    EXPECT_NEAR(s.container_velocity.x, 0.0, 1e-14);
    EXPECT_NEAR(s.container_velocity.y, -1.0, 1e-14);
    EXPECT_NEAR(s.period, 6.0 * pi, 1e-14);
    EXPECT_NEAR(s.clock, s.period / 4.0, 1e-14);
}

// --phase is the angle in the image, mirrored or not.
TEST(TrackScale, PhaseIsMeasuredInTheImageForBothDirections) {
    TrackScale scale;
    scale.amplitude = 3.0;
    scale.container_radius = 8.5;
    scale.pixels_per_radius = 10.0;
    for (const bool clockwise : {false, true})
        for (const double degrees : {0.0, 70.0, 200.0}) {
            scale.clockwise = clockwise;
            scale.phase = degrees * pi / 180.0;
            // A disc at the centre of the container, in pixels with y down.
            const Snapshot s =
                seen(30.0 * std::cos(scale.phase), -30.0 * std::sin(scale.phase), scale);
            EXPECT_NEAR(s.position(0).x, s.container_centre.x, 1e-6);  // six digits in the text
            EXPECT_NEAR(s.position(0).y, s.container_centre.y, 1e-6);
        }
}

// A disc at rest relative to the container has its velocity, for any camera unit of time.
TEST(TrackScale, VelocitiesAreInUnitsOfTheContainersSpeed) {
    for (const double fps : {1.0, 960.0}) {
        TrackScale scale{.container_radius = 8.5};
        scale.frames_per_time = fps;
        scale.period = 400.0 / fps;  // 400 frames
        scale.amplitude = 2.0;
        scale.pixels_per_radius = 1e5;
        std::string text = "frame,particle,x,y\n";
        for (int k = 0; k < 3; ++k)
            text += std::to_string(k) + ",0," + std::to_string(2e5 * std::cos(k * pi / 200.0)) +
                    "," + std::to_string(-2e5 * std::sin(k * pi / 200.0)) + "\n";
        const Snapshot s = series_of(tracks_in(text), scale).frame(1);
        EXPECT_NEAR(std::hypot(s.vx[0], s.vy[0]), 1.0, 1e-4);  // (ΩΔt)²/6 = 4e-5
        EXPECT_NEAR(s.vx[0], s.container_velocity.x, 1e-4);
        EXPECT_NEAR(s.vy[0], s.container_velocity.y, 1e-4);
    }
}

TEST(TrackScale, VelocitiesAndSpinsOfADumpAreConverted) {
    TrackScale scale{.container_radius = 8.5};
    scale.period = pi;  // Ω = 2
    scale.amplitude = 4.0;
    scale.pixels_per_radius = 10.0;  // so the container moves at 80 of the dump's units
    const Snapshot s =
        series_of(dump_in("ITEM: TIMESTEP\n4\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS ff ff pp\n"
                          "-1 1\n-1 1\n-1 1\nITEM: ATOMS id x y vx vy omegaz\n1 0 0 80 -40 6\n"),
                  scale)
            .frame(0);
    EXPECT_NEAR(s.vx[0], 1.0, 1e-14);
    EXPECT_NEAR(s.vy[0], -0.5, 1e-14);
    EXPECT_NEAR(s.spin[0] * s.period / (2.0 * pi), 3.0, 1e-13);  // three times Ω
}

TEST(TrackScale, NoVelocityIsComputedAcrossALongGap) {
    TrackScale scale{.container_radius = 8.5};
    const auto series = series_of(
        tracks_in("frame,particle,x,y\n0,0,0,0\n1,0,1,0\n2,0,2,0\n50,0,80,0\n51,0,81,0\n"), scale);
    for (const std::uint64_t k : {2u, 3u}) EXPECT_NEAR(series.frame(k).vx[0], 960.0, 1e-9);
}

TEST(TrackScale, VelocitiesAreCentralDifferencesAndOneSidedAtTheEnds) {
    TrackScale scale{.container_radius = 8.5};
    scale.frames_per_time = 2.0;
    scale.pixels_per_radius = 10.0;
    const auto series = series_of(
        tracks_in("frame,particle,x,y\n0,0,0,0\n1,0,10,-20\n2,0,40,-20\n2,1,5,5\n"), scale);
    ASSERT_EQ(series.frames, 3u);
    EXPECT_FALSE(series.same_discs());
    EXPECT_EQ(series.frame(0).vx[0], 2.0);
    EXPECT_EQ(series.frame(0).vy[0], 4.0);  // up
    EXPECT_EQ(series.frame(1).vx[0], 4.0);
    EXPECT_EQ(series.frame(1).vy[0], 2.0);
    EXPECT_EQ(series.frame(2).vx[0], 6.0);
    EXPECT_EQ(series.frame(2).vx[1], 0.0);  // seen once only
}

// (ΩΔt)²/6 is what a central difference misses of a circular motion.
TEST(TrackScale, ErrorOfCircularMotionIsAsDocumented) {
    std::string text = "frame,particle,x,y\n";
    const double step = 2.0 * pi / 50.0;
    for (int k = 0; k < 3; ++k)
        text += std::to_string(k) + ",0," + std::to_string(1e6 * std::cos(k * step)) + "," +
                std::to_string(-1e6 * std::sin(k * step)) + "\n";
    TrackScale scale{.container_radius = 8.5};
    scale.frames_per_time = 50.0;
    scale.pixels_per_radius = 1e6;
    const Snapshot s = series_of(tracks_in(text), scale).frame(1);
    const double speed = std::hypot(s.vx[0], s.vy[0]) / (2.0 * pi);
    EXPECT_NEAR(1.0 - speed, step * step / 6.0, 1e-5);  // the next term is (ΩΔt)⁴/120 = 2e-6
}

const std::string dump_head =
    "ITEM: TIMESTEP\n4\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS ff ff pp\n-1 1\n-1 1\n-1 1\n";

TEST(LammpsDump, ReadsAllColumns) {
    const Tracks tracks = dump_in(dump_head +
                                  "ITEM: ATOMS id type x y vx vy radius mass omegaz\n"
                                  "9 1 1.5 2.5 3.5 4.5 1.25 7 -1\n"
                                  "2 1 0 1 2 3 1 6 0.5\n");
    ASSERT_EQ(tracks.frames.size(), 1u);
    const TrackFrame& f = tracks.frames[0];
    EXPECT_FALSE(tracks.y_down);
    EXPECT_EQ(f.number, 4);
    EXPECT_EQ(f.id, (std::vector<std::int64_t>{2, 9}));
    EXPECT_EQ(f.position[1].x, 1.5);
    EXPECT_EQ(f.velocity[1].y, 4.5);
    EXPECT_EQ(f.radius, (std::vector<double>{1.0, 1.25}));
    EXPECT_EQ(f.mass, (std::vector<double>{6.0, 7.0}));
    EXPECT_EQ(f.spin, (std::vector<double>{0.5, -1.0}));
    EXPECT_TRUE(dump_in(dump_head + "ITEM: ATOMS id xu yu\n1 0 0\n2 1 1\n").frames[0].mass.empty());
}

TEST(LammpsDump, ErrorsNameTheLine) {
    const auto rejected = [](const std::string& text) { return error_message(dump_in, text); };
    EXPECT_NE(rejected("").find("holds no frames"), std::string::npos);
    EXPECT_NE(rejected("1,2,3\n").find("line 1: this is not a LAMMPS text dump"),
              std::string::npos);
    EXPECT_NE(rejected(dump_head + "ITEM: ATOMS type x y\n").find("columns id, x and y"),
              std::string::npos);
    EXPECT_NE(rejected(dump_head + "ITEM: ATOMS id x y\n1 0 0\n").find("but an atom was expected"),
              std::string::npos);
    EXPECT_NE(
        rejected(dump_head + "ITEM: ATOMS id x y\n1 0 0\n1 1 1\n").find("atom 1 appears twice"),
        std::string::npos);
    EXPECT_NE(rejected(dump_head + "ITEM: ATOMS id x y\n1 0 inf\n2 1 1\n")
                  .find("line 10: column 'y' is 'inf'"),
              std::string::npos);
    const std::string frame = dump_head + "ITEM: ATOMS id x y\n1 0 0\n2 1 1\n";
    EXPECT_NE(rejected(frame + frame).find("frame 4 follows frame 4, but frames must ascend"),
              std::string::npos);
    EXPECT_NE(rejected("ITEM: TIMESTEP\n0\nITEM: ATOMS id x y\n").find("is missing before"),
              std::string::npos);
}

}  // namespace
}  // namespace swirl
