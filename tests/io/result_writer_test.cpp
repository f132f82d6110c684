#include "swirl/io/result_writer.hpp"

#include <sys/resource.h>
#include <sys/wait.h>

#include <csignal>

#include "io/scratch.hpp"
#include "swirl/io/atomic_file.hpp"
#include "swirl/io/file_error.hpp"
#include "swirl/io/journaled_file.hpp"

namespace swirl {
namespace {

std::size_t files_in(const std::filesystem::path& folder) {
    return std::size_t(std::distance(std::filesystem::directory_iterator(folder), {}));
}

TEST(ResultWriter, WritesMoreFilesThanDescriptorsAllow) {
    const Scratch scratch;
    rlimit before;
    ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &before), 0);
    rlimit few = before;
    few.rlim_cur = 250;
    ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &few), 0);
    int named = 0;
    {
        ResultWriter writer(scratch.folder());
        for (int k = 0; k < 2000; ++k)
            writer.write(std::to_string(k) + ".json", "{}", [&] { ++named; });
        EXPECT_NO_THROW(writer.finish());
    }
    ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &before), 0);
    EXPECT_EQ(named, 2000);
    EXPECT_EQ(files_in(scratch.folder()), 2000u);
}

TEST(ResultWriter, FinishRethrowsExceptionsOfItsThread) {
    const Scratch scratch;
    ResultWriter writer(scratch.folder());
    writer.write("a", "a", [] { throw std::bad_alloc(); });
    EXPECT_THROW(writer.finish(), std::bad_alloc);
}

TEST(AtomicFile, LeftoversOfKilledWritersAreRemovedButNotFilesInUse) {
    const Scratch scratch;
    const pid_t child = ::fork();
    if (child == 0) {
        AtomicFile killed(scratch / "f");
        killed.append("half");
        killed.flush_buffer();
        ::_exit(1);
    }
    ::waitpid(child, nullptr, 0);
    ASSERT_EQ(files_in(scratch.folder()), 1u);
    write_quickly(scratch / "f.my own.partial", "foreign");
    AtomicFile other(scratch / "other");
    EXPECT_EQ(files_in(scratch.folder()), 3u);  // a leftover belongs to one target
    AtomicFile alive(scratch / "f");
    EXPECT_EQ(files_in(scratch.folder()), 3u);
    AtomicFile second(scratch / "f");
    EXPECT_EQ(files_in(scratch.folder()), 4u);
    alive.append("whole");
    alive.finish();
    EXPECT_EQ(read_whole_file(scratch / "f"), "whole");
}

TEST(AtomicFile, LeftoversOfAFileThatIsRemovedAreRemoved) {
    const Scratch scratch;
    const std::string leftover = "f.0123456789abcdef.partial";
    for (const bool is_there : {false, true}) {
        const auto folder = scratch / (is_there ? "there" : "absent");
        std::filesystem::create_directory(folder);
        if (is_there) write_quickly(folder / "f", "whole");
        write_quickly(folder / leftover, "half");
        remove_atomic_file(folder / "f");
        EXPECT_EQ(files_in(folder), 0u);
    }
}

TEST(JournaledFile, NothingIsCommittedAfterAnError) {
    const Scratch scratch;
    rlimit before;
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
    ::signal(SIGXFSZ, SIG_IGN);
    JournaledFile file(scratch / "f", JournaledFile::Mode::create);
    file.write(0, "first", 5);
    file.commit();
    rlimit small = before;
    small.rlim_cur = 8192;
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
    EXPECT_THROW(file.write(100'000, "far", 3), FileError);
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
    // A caller that ignores the error cannot continue.
    EXPECT_THROW(file.write(0, "SECOND", 6), FileError);
    EXPECT_THROW(file.commit(), FileError);
    EXPECT_THROW(file.publish(scratch / "final"), FileError);
    file.abandon();
    EXPECT_EQ(read_whole_file(scratch / "f"), "first");
    EXPECT_FALSE(std::filesystem::exists(scratch / "final"));
}

}  // namespace
}  // namespace swirl
