#include "swirl/io/trajectory.hpp"

#include <csignal>
#include <limits>
#include <numeric>
#include <set>
#include <string>

#include "io/scratch.hpp"
#include "swirl/io/atomic_file.hpp"
#include "swirl/io/export.hpp"
#include "swirl/io/file_error.hpp"

namespace swirl {
namespace {

constexpr std::size_t discs = 5;
constexpr std::uint64_t frames = 20;

void expect_same(const Snapshot& a, const Snapshot& b) {
    EXPECT_EQ(a.periods, b.periods);
    EXPECT_EQ(a.clock, b.clock);
    EXPECT_EQ(a.period, b.period);
    EXPECT_EQ(a.container_radius, b.container_radius);
    EXPECT_EQ(a.container_centre.x, b.container_centre.x);
    EXPECT_EQ(a.container_velocity.y, b.container_velocity.y);
    EXPECT_EQ(a.x, b.x);
    EXPECT_EQ(a.y, b.y);
    EXPECT_EQ(a.vx, b.vx);
    EXPECT_EQ(a.vy, b.vy);
    EXPECT_EQ(a.angle, b.angle);
    EXPECT_EQ(a.spin, b.spin);
    EXPECT_EQ(a.held_at, b.held_at);
    EXPECT_EQ(a.radius, b.radius);
    EXPECT_EQ(a.mass, b.mass);
    EXPECT_EQ(a.inertia, b.inertia);
    EXPECT_EQ(a.can_spin, b.can_spin);
}

std::filesystem::path known_trajectory(const Scratch& scratch,
                                       Snapshot (*frame)(std::size_t,
                                                         std::uint64_t) = known_frame) {
    const auto path = scratch / "known.h5";
    TrajectoryWriter writer(path, frame(discs, 0),
                            {{"version", "1.2.3"}, {"config", "discs = 5\n"}});
    for (std::uint64_t k = 0; k < frames; ++k) writer.write(frame(discs, k), 10 * k);
    writer.finish();
    return path;
}

TEST(Trajectory, RoundTripIsExact) {
    const Scratch scratch;
    TrajectoryReader reader(known_trajectory(scratch));
    ASSERT_EQ(reader.frames(), frames);
    EXPECT_TRUE(reader.complete());
    EXPECT_EQ(reader.provenance("config"), "discs = 5\n");
    EXPECT_EQ(reader.provenance("absent"), "");
    for (std::uint64_t k : {0u, 19u, 7u, 8u}) {
        expect_same(reader.frame(k), known_frame(discs, k));
        EXPECT_EQ(reader.events_before(k), 10 * k);
    }
    EXPECT_THROW(reader.frame(frames), FileError);
}

Snapshot frame_with_a_held_spin(std::size_t n, std::uint64_t k) {
    Snapshot s = known_frame(n, k);
    Disc disc = s.disc(2);
    disc.spin = disc.can_spin = 0.0;
    s.set(2, disc);
    return s;
}

TEST(Trajectory, KeepsWhichParticlesCannotSpin) {
    const Scratch scratch;
    TrajectoryReader reader(known_trajectory(scratch, frame_with_a_held_spin));
    expect_same(reader.frame(7), frame_with_a_held_spin(discs, 7));
    EXPECT_EQ(reader.frame(7).disc(2).can_spin, 0.0);
    EXPECT_EQ(reader.frame(7).disc(3).can_spin, 1.0);
}

TEST(Trajectory, SameFramesGiveTheSameBytes) {
    const Scratch a, b;
    EXPECT_EQ(read_whole_file(known_trajectory(a)), read_whole_file(known_trajectory(b)));
}

TEST(Export, CanBeStoppedWithinAFrame) {
    const Scratch scratch;
    constexpr std::size_t many = 20'000;
    TrajectoryWriter writer(scratch / "t.h5", known_frame(many, 0), {});
    writer.write(known_frame(many, 0), 0);
    writer.finish();
    const auto series = series_of(std::make_shared<TrajectoryReader>(scratch / "t.h5"));
    for (const char* format : {"lammps", "xyz", "csv", "table"}) {
        struct Stopped {};
        int questions = 0;
        ExportOptions options;
        options.check_stop = [&] {
            if (++questions == 4) throw Stopped();
        };
        EXPECT_THROW(export_series(series, *export_format(format), scratch / "out", options),
                     Stopped);
    }
    EXPECT_FALSE(std::filesystem::exists(scratch / "out"));
}

// A running simulation moves data whose position the reader has cached. The reader must report this
// instead of returning wrong frames.
TEST(Trajectory, ReaderRejectsAFileThatGrewSinceItWasOpened) {
    const Scratch scratch;
    TrajectoryWriter writer(scratch / "t.h5", known_frame(discs, 0), {});
    std::uint64_t written = 0;
    const auto grow = [&](std::uint64_t count) {
        for (; count > 0; --count, ++written) writer.write(known_frame(discs, written), 0);
        writer.flush();
    };
    grow(frames);
    TrajectoryReader reader(scratch / "t.h5.partial");
    expect_same(reader.frame(3), known_frame(discs, 3));
    grow(5000);
    std::string problem;
    try {
        TrajectoryReader late = std::move(reader);
        late.inconsistent_dataset();
    } catch (const FileError& error) {
        problem = error.what();
    }
    EXPECT_NE(problem.find("has changed while it was read"), std::string::npos) << problem;
    expect_same(TrajectoryReader(scratch / "t.h5.partial").frame(7), known_frame(discs, 7));
}

TEST(Trajectory, IsPublishedOnlyWhenComplete) {
    const Scratch scratch;
    const auto path = scratch / "t.h5";
    {
        TrajectoryWriter writer(path, known_frame(discs, 0), {});
        writer.write(known_frame(discs, 0), 0);
        writer.flush();
        EXPECT_FALSE(std::filesystem::exists(path));
        TrajectoryReader reader(scratch / "t.h5.partial");
        EXPECT_FALSE(reader.complete());
        EXPECT_EQ(reader.frames(), 1u);
    }
    auto writer = TrajectoryWriter::resume(path, 1);
    writer.finish();
    EXPECT_TRUE(TrajectoryReader(path).complete());
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(scratch.folder()), {}), 1);
}

TEST(Trajectory, ResumedFileEqualsUninterruptedFile) {
    const Scratch scratch;
    const auto path = scratch / "t.h5";
    const std::size_t many = 400;  // several chunks
    {
        TrajectoryWriter writer(path, known_frame(many, 0), {});
        for (std::uint64_t k = 0; k < 70; ++k) writer.write(known_frame(many, k), k);
        writer.flush();
        for (std::uint64_t k = 70; k < 90; ++k) writer.write(known_frame(many, 1000 + k), k);
    }
    auto writer = TrajectoryWriter::resume(path, 61);
    for (std::uint64_t k = 61; k < 120; ++k) writer.write(known_frame(many, k), k);
    writer.finish();
    TrajectoryReader reader(path);
    ASSERT_EQ(reader.frames(), 120u);
    for (std::uint64_t k = 0; k < 120; ++k) expect_same(reader.frame(k), known_frame(many, k));
}

TEST(Trajectory, PublishedFileCanBeResumed) {
    const Scratch scratch;
    const auto path = known_trajectory(scratch);
    auto writer = TrajectoryWriter::resume(path, 5);
    EXPECT_FALSE(std::filesystem::exists(path));
    writer.flush();
    EXPECT_FALSE(TrajectoryReader(scratch / "known.h5.partial").complete());
    for (std::uint64_t k = 5; k < frames; ++k) writer.write(known_frame(discs, k), 10 * k);
    writer.finish();
    TrajectoryReader reader(path);
    EXPECT_TRUE(reader.complete());
    for (std::uint64_t k = 0; k < frames; ++k) expect_same(reader.frame(k), known_frame(discs, k));
}

TEST(Trajectory, FinishedFileWithColumnsOfDifferentLengthIsRejected) {
    for (const char* name : {"/particles/trajectory/velocity/value", "/observables/clock/value",
                             "/particles/trajectory/position/step"}) {
        for (const bool complete : {true, false}) {
            const Scratch scratch;
            const auto path = known_trajectory(scratch);
            {
                Hdf5File file(path, JournaledFile::Mode::change);
                file.column(name).resize(frames - 1);
                file.set_attribute("/parameters", "complete", std::vector<std::int64_t>{complete});
                file.flush();
            }
            if (complete)
                EXPECT_THROW(TrajectoryReader{path}, FileError) << name;
            else  // the common length counts
                EXPECT_EQ(TrajectoryReader(path).frames(), frames - 1) << name;
        }
    }
}

TEST(Trajectory, ResumeRejectsTooFewFrames) {
    const Scratch scratch;
    { TrajectoryWriter writer(scratch / "t.h5", known_frame(discs, 0), {}); }
    EXPECT_THROW(TrajectoryWriter::resume(scratch / "t.h5", 3), FileError);
    EXPECT_THROW(TrajectoryWriter::resume(scratch / "absent.h5", 0), FileError);
}

TEST(Trajectory, FlushedFramesSurviveKillsAtRandomMoments) {
    const Scratch scratch;
    for (int round = 0; round < 6; ++round) {
        const auto path = scratch / "t.h5", partial = scratch / "t.h5.partial";
        const auto begun = scratch / ("begun" + std::to_string(round));
        const pid_t child = ::fork();
        if (child == 0) {
            TrajectoryWriter writer(path, known_frame(48, 0), {});
            for (std::uint64_t k = 0;; ++k) {
                writer.write(known_frame(48, k), k);
                if (k % 50 == 49) writer.flush();
                if (k == 49) write_file_atomically(begun, "flushed once");
            }
        }
        // Waits for the child's first flush, which can take long on a busy machine.
        while (!std::filesystem::exists(begun)) ::usleep(1000);
        ::usleep(unsigned(60'000 + 7'001 * round));
        ::kill(child, SIGKILL);
        ::waitpid(child, nullptr, 0);
        TrajectoryReader reader(partial);
        EXPECT_FALSE(reader.complete());
        EXPECT_GE(reader.frames(), 50u);
        for (std::uint64_t k = 0; k < reader.frames(); k += 13)
            expect_same(reader.frame(k), known_frame(48, k));
    }
}

TEST(Trajectory, FramesAreFlushedWithoutFurtherWrites) {
    const Scratch scratch;
    TrajectoryWriter writer(scratch / "t.h5", known_frame(discs, 0), {});
    const auto frames_on_disk = [&]() -> std::uint64_t {
        try {
            return TrajectoryReader(scratch / "t.h5.partial").frames();
        } catch (const FileError&) {
            return 0;  // the flush is in progress
        }
    };
    for (std::uint64_t k = 0; k < 3; ++k) writer.write(known_frame(discs, k), k);
    EXPECT_EQ(frames_on_disk(), 0u);
    while (frames_on_disk() == 0) ::usleep(10'000);
    EXPECT_EQ(frames_on_disk(), 3u);
}

/// Frames in which a velocity changes only every seventh time.
Snapshot repeating_frame(std::size_t n, std::uint64_t k) {
    Snapshot s = known_frame(n, k);
    for (std::size_t i = 0; i < n; ++i) s.vx[i] = s.vy[i] = double((k + i) / 7);
    return s;
}

// Several chunks of each column, with flushes and resumes in the middle of chunks.
TEST(Trajectory, RoundTripIsExactForEachCompressionAndAfterResume) {
    for (const int compression : {0, 1, 9}) {
        const Scratch scratch;
        const auto path = scratch / "t.h5";
        const std::size_t n = 100;
        {
            TrajectoryWriter writer(path, known_frame(n, 0), {}, compression);
            for (std::uint64_t k = 0; k < 1500; ++k) {
                writer.write(repeating_frame(n, k), k);
                if (k % 400 == 77) writer.flush();
            }
            writer.flush();
        }
        for (const std::uint64_t from : {1500u, 1111u, 978u, 0u}) {
            auto writer = TrajectoryWriter::resume(path, from);
            for (std::uint64_t k = from; k < 1500; ++k) writer.write(repeating_frame(n, k), k);
            writer.flush();
        }
        TrajectoryReader reader(scratch / "t.h5.partial");
        ASSERT_EQ(reader.frames(), 1500u);
        for (std::uint64_t k = 0; k < 1500; k += 7)
            expect_same(reader.frame(k), repeating_frame(n, k));
        EXPECT_EQ(reader.events_before(1234), 1234u);
    }
}

TEST(Trajectory, CompressionShrinksFilesWhoseVelocitiesRepeat) {
    const Scratch scratch;
    const auto size = [&](int compression) {
        const auto path = scratch / "t.h5";
        TrajectoryWriter writer(path, known_frame(48, 0), {}, compression);
        for (std::uint64_t k = 0; k < 1000; ++k) writer.write(repeating_frame(48, k), k);
        writer.finish();
        return double(std::filesystem::file_size(path));
    };
    // Two of the six columns repeat six times of seven, so at least 2/6 · 6/7 = 29 % is redundant.
    EXPECT_LT(size(1), 0.71 * size(0));
}

TEST(Trajectory, ForeignAndDamagedFilesAreRejected) {
    const Scratch scratch;
    const auto rejected = [&](const std::string& bytes) -> std::string {
        write_file_atomically(scratch / "f", bytes);
        try {
            TrajectoryReader reader(scratch / "f");
            for (std::uint64_t k = 0; k < reader.frames(); ++k) reader.frame(k);
        } catch (const FileError& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_NE(rejected("").find("is not an HDF5 file"), std::string::npos);
    EXPECT_NE(rejected("frame,particle,x,y\n").find("is not an HDF5 file"), std::string::npos);
    const std::string whole = read_whole_file(known_trajectory(scratch));
    for (std::size_t cut = 1; cut < whole.size(); cut += whole.size() / 40)
        EXPECT_NE(rejected(whole.substr(0, cut)), "") << cut;
    EXPECT_EQ(rejected(whole), "");
}

/// Files for other programs, of discs and of spheres.
class OfBodies : public ::testing::TestWithParam<const char*> {
  protected:
    std::string bodies() const { return GetParam(); }
    std::filesystem::path trajectory() const {
        return bodies() == "spheres" ? known_trajectory(scratch, known_frame_of_spheres)
                                     : known_trajectory(scratch);
    }
    std::filesystem::path exported(const std::string& format) const {
        const ExportFormat& chosen = *export_format(format);
        const auto path = scratch / (std::string("out") + chosen.ending);
        export_series(series_of(std::make_shared<TrajectoryReader>(trajectory())), chosen, path);
        return path;
    }
    const Scratch scratch;
};
class TrajectoryOf : public OfBodies {};
class ExportOf : public OfBodies {};

TEST_P(TrajectoryOf, OpensInH5py) {
    EXPECT_READER_AGREES("h5py", trajectory(), discs, frames, bodies());
}
TEST_P(TrajectoryOf, LoadsInMDAnalysis) {
    EXPECT_READER_AGREES("mdanalysis", trajectory(), discs, frames, bodies());
}
TEST_P(TrajectoryOf, OpensInXarrayAsNetCDF) {
    EXPECT_READER_AGREES("xarray", trajectory(), discs, frames, bodies());
}
TEST_P(ExportOf, LammpsDumpLoadsInMDAnalysis) {
    EXPECT_READER_AGREES("lammps", exported("lammps"), discs, frames, bodies());
}
TEST_P(ExportOf, ExtendedXyzLoadsInMDAnalysis) {
    EXPECT_READER_AGREES("xyz", exported("xyz"), discs, frames, bodies());
}
TEST_P(ExportOf, PolydataLoadsInVtk) {
    EXPECT_READER_AGREES("vtp", exported("vtp"), discs, frames, bodies());
}
TEST_P(ExportOf, TrackpyTableLoadsInPandas) {
    EXPECT_READER_AGREES("csv", exported("csv"), discs, frames, bodies());
}
TEST_P(ExportOf, GsdLoadsInGsd) {
    EXPECT_READER_AGREES("gsd", exported("gsd"), discs, frames, bodies());
}
TEST_P(ExportOf, TableLoadsInPandas) {
    EXPECT_READER_AGREES("table", exported("table"), discs, frames, bodies());
}
const auto body_name = [](const auto& body) { return std::string(body.param); };
const auto each_body = ::testing::Values("discs", "spheres");
INSTANTIATE_TEST_SUITE_P(, TrajectoryOf, each_body, body_name);
INSTANTIATE_TEST_SUITE_P(, ExportOf, each_body, body_name);

/// The distinct frame numbers in a table whose lines begin with the frame number.
std::vector<int> frames_in(const std::string& text) {
    std::vector<int> found;
    for (std::size_t line = text.find('\n') + 1; line < text.size();
         line = text.find('\n', line) + 1) {
        const int frame = std::stoi(text.substr(line));
        if (found.empty() || found.back() != frame) found.push_back(frame);
    }
    return found;
}

TEST(Export, ExportedFramesKeepTheirNumbers) {
    const Scratch scratch;
    const SnapshotSeries series =
        series_of(std::make_shared<TrajectoryReader>(known_trajectory(scratch)));
    ASSERT_EQ(series.frames, std::uint64_t(frames));
    const auto chosen = [&](std::uint64_t first, std::uint64_t last, std::uint64_t stride) {
        ExportOptions options;
        options.first = first;
        options.last = last;
        options.stride = stride;
        std::uint64_t reported = 0;
        options.on_frame = [&](std::uint64_t done) { reported = done; };
        export_series(series, *export_format("table"), scratch / "t.csv", options);
        EXPECT_EQ(reported, exported_frames(series.frames, options));
        return frames_in(read_whole_file(scratch / "t.csv"));
    };
    std::vector<int> all(frames);
    std::iota(all.begin(), all.end(), 0);
    constexpr auto end = std::numeric_limits<std::uint64_t>::max();
    EXPECT_EQ(chosen(0, end, 1), all);
    EXPECT_EQ(chosen(1, 6, 2), (std::vector<int>{1, 3, 5}));
    EXPECT_EQ(chosen(1, 5, 2), (std::vector<int>{1, 3, 5}));
    EXPECT_EQ(chosen(3, 3, 7), (std::vector<int>{3}));
    EXPECT_EQ(chosen(frames - 1, end, 1), (std::vector<int>{int(frames) - 1}));
    EXPECT_EQ(chosen(frames, end, 1), std::vector<int>{});
}

// The first exported frame contains the constants, also if it is not frame 0.
TEST(Export, EveryFormatCanStartAtALaterFrame) {
    const Scratch scratch;
    const SnapshotSeries series =
        series_of(std::make_shared<TrajectoryReader>(known_trajectory(scratch)));
    for (const ExportFormat& format : export_formats()) {
        ExportOptions options;
        options.first = 2;
        const auto path = scratch / (std::string("late") + format.name + format.ending);
        export_series(series, format, path, options);
        EXPECT_GT(std::filesystem::file_size(path), 100u) << format.name;
    }
    const auto ran = run_command("/usr/bin/python3 -c \"import gsd.hoomd as g; f = g.open('" +
                                 (scratch / "lategsd.gsd").string() +
                                 "')[0]; print(f.configuration.step, f.particles.mass[1], "
                                 "f.particles.types)\"");
    if (ran.output.find("ModuleNotFound") != std::string::npos) GTEST_SKIP() << ran.output;
    EXPECT_EQ(ran.output, "2 1.0 ['D1', 'D2']\n");
}

// Without --out, the ending gives the name. An export must not replace that of another format.
TEST(Export, FormatsHaveDifferentEndings) {
    std::set<std::string> endings;
    for (const ExportFormat& format : export_formats())
        EXPECT_TRUE(endings.insert(format.ending).second) << format.name;
}

TEST(Export, UnknownFormatIsNotFound) { EXPECT_FALSE(export_format("netcdf")); }

}  // namespace
}  // namespace swirl
