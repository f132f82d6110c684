#include "swirl/io/recording.hpp"

#include <sys/stat.h>

#include "io/scratch.hpp"
#include "swirl/io/atomic_file.hpp"
#include "swirl/io/event_log.hpp"
#include "swirl/io/file_error.hpp"
#include "swirl/io/trajectory.hpp"

namespace swirl {
namespace {

Provenance of_run(const std::string& name) { return {{run_entry, name}}; }

void write_frames(TrajectoryWriter& writer, std::uint64_t from, std::uint64_t to) {
    for (std::uint64_t k = from; k < to; ++k) writer.write(known_frame(5, k), k);
}

template <class Action>
std::string rejection_of(Action&& action) {
    try {
        action();
    } catch (const FileError& error) {
        return error.what();
    }
    return "";
}

// Run A is killed, run B completes under the same name, and A is resumed.
TEST(Recording, FinishedFileOfAnotherRunIsNeitherContinuedNorChanged) {
    const Scratch scratch;
    const auto path = scratch / "t.h5";
    {
        TrajectoryWriter b(path, known_frame(5, 0), of_run("b"));
        write_frames(b, 0, 20);
        b.finish();
    }
    const std::string before = read_whole_file(path);
    EXPECT_NE(rejection_of([&] { TrajectoryWriter::resume(path, 10, "a"); }).find("by another run"),
              std::string::npos);
    EXPECT_EQ(read_whole_file(path), before);
    EXPECT_EQ(rejection_of([&] { TrajectoryWriter::resume(path, 10, "b").finish(); }), "");
    EXPECT_EQ(TrajectoryReader(path).frames(), 10u);
}

TEST(Recording, UnfinishedFileOfAnotherRunIsNotOverwritten) {
    const Scratch scratch;
    const auto path = scratch / "t.h5";
    {
        TrajectoryWriter a(path, known_frame(5, 0), of_run("a"));
        write_frames(a, 0, 20);
        a.flush();
    }
    EXPECT_NE(rejection_of([&] { reject_foreign_recording(path, "b"); }).find("--overwrite"),
              std::string::npos);
    EXPECT_EQ(rejection_of([&] { reject_foreign_recording(path, "a"); }), "");
    EXPECT_EQ(rejection_of([&] { reject_foreign_recording(scratch / "absent.h5", "b"); }), "");
    // An empty file was left by a run that was killed before its first commit.
    write_quickly(scratch / "new.h5.partial", "");
    EXPECT_EQ(rejection_of([&] { reject_foreign_recording(scratch / "new.h5", "b"); }), "");
    std::filesystem::resize_file(scratch / "t.h5.partial", 5000);
    EXPECT_NE(rejection_of([&] { reject_foreign_recording(path, "a"); }).find("--overwrite"),
              std::string::npos);
}

TEST(Recording, EventLogOfAnotherRunIsRejected) {
    const Scratch scratch;
    Simulation simulation(paper_container(9, 3));
    {
        EventLogWriter log(scratch / "e.h5", simulation.snapshot(), 11.0, of_run("a"));
        for (int k = 0; k < 100; ++k) log.write(simulation.step());
        log.flush();
    }
    EXPECT_NE(rejection_of([&] { EventLogWriter::resume(scratch / "e.h5", 50, "b"); }), "");
    EXPECT_EQ(rejection_of([&] { EventLogWriter::resume(scratch / "e.h5", 50, "a"); }), "");
}

/// A trajectory of 5 discs, with dataset `name` replaced by a list of `count` numbers.
std::filesystem::path with_column_of(const Scratch& scratch, const std::string& name,
                                     std::size_t count) {
    const auto path = scratch / "whole.h5", hostile = scratch / "hostile.h5";
    TrajectoryWriter writer(path, known_frame(5, 0), {});
    write_frames(writer, 0, 3);
    writer.finish();
    const auto ran = run_command("/usr/bin/python3 -c \"import h5py; f = h5py.File('" +
                                 path.string() + "', 'r+'); del f['" + name + "']; f['" + name +
                                 "'] = [1.0] * " + std::to_string(count) + "\"");
    if (ran.code == 0) std::filesystem::rename(path, hostile);
    return hostile;
}

TEST(Recording, ColumnsOfDifferentLengthAreRejected) {
    for (const char* name : {"mass", "radius", "moment_of_inertia", "angle/value"})
        for (const std::size_t count : {0u, 2u, 6u}) {
            const Scratch scratch;
            const auto hostile =
                with_column_of(scratch, std::string("particles/trajectory/") + name, count);
            if (!std::filesystem::exists(hostile)) GTEST_SKIP() << "h5py is not installed.";
            EXPECT_NE(
                rejection_of([&] { TrajectoryReader reader(hostile); }).find("columns differ in"),
                std::string::npos)
                << name << " " << count;
        }
}

TEST(Recording, ColumnLargerThanTheFileIsRejectedBeforeAllocation) {
    const Scratch scratch;
    {
        Hdf5File file(scratch / "f.partial", JournaledFile::Mode::create);
        file.create_column<double>("/long", {}, {1024}, 0).resize(std::uint64_t(1) << 45);
        file.finish(scratch / "f");
    }
    const Hdf5File file(scratch / "f", JournaledFile::Mode::read);
    EXPECT_NE(rejection_of([&] { file.column("/long").read<double>(); }).find("is damaged"),
              std::string::npos);
}

TEST(Recording, LinksAndPipesWithThePartialNameAreRejected) {
    const Scratch scratch;
    write_quickly(scratch / "precious", "precious");
    std::filesystem::create_symlink(scratch / "precious", scratch / "t.h5.partial");
    ASSERT_EQ(::mkfifo((scratch / "pipe.h5.partial").c_str(), 0600), 0);
    for (const char* name : {"t.h5", "pipe.h5"})
        EXPECT_NE(rejection_of([&] { TrajectoryWriter(scratch / name, known_frame(5, 0), {}); }),
                  "");
    EXPECT_EQ(read_whole_file(scratch / "precious"), "precious");
    EXPECT_NE(rejection_of([&] { read_regular_file(scratch / "pipe.h5.partial"); }).find("regular"),
              std::string::npos);
}

}  // namespace
}  // namespace swirl
