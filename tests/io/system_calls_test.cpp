// The calls to the system. tests/platforms/system_calls_test.py also runs this file with the
// branches for macOS and for other POSIX systems.
#include "swirl/io/system_calls.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

#include "io/scratch.hpp"

namespace swirl {
namespace {

namespace fs = std::filesystem;

fs::path write(const fs::path& file, const char* text) {
    std::ofstream(file) << text;
    return file;
}
std::string read(const fs::path& file) {
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), {}};
}

bool is_inherited(int file) { return (::fcntl(file, F_GETFD) & FD_CLOEXEC) == 0; }

TEST(SystemCalls, RandomBytesDiffer) {
    std::array<unsigned char, 32> first{}, second{};
    ASSERT_TRUE(system::random_bytes(first.data(), first.size()));
    ASSERT_TRUE(system::random_bytes(second.data(), second.size()));
    EXPECT_NE(first, second);
}

TEST(SystemCalls, RenamingToANewNameNeverReplaces) {
    const Scratch scratch;
    const fs::path a = write(scratch / "a", "A"), b = write(scratch / "b", "B");
    errno = 0;
    EXPECT_FALSE(system::rename_to_new_name(a, b));
    EXPECT_EQ(errno, EEXIST);
    EXPECT_EQ(read(a), "A");
    EXPECT_EQ(read(b), "B");
    EXPECT_TRUE(system::rename_to_new_name(a, scratch / "c"));
    EXPECT_FALSE(fs::exists(a));
    EXPECT_EQ(read(scratch / "c"), "A");
    EXPECT_FALSE(system::rename_to_new_name(a, scratch / "d"));
    EXPECT_EQ(errno, ENOENT);
}

TEST(SystemCalls, SyncReportsAWrongDescriptor) {
    const Scratch scratch;
    const int file = ::open(write(scratch / "a", "A").c_str(), O_WRONLY);
    const int folder = ::open(scratch.folder().c_str(), O_RDONLY | O_DIRECTORY);
    EXPECT_TRUE(system::sync_file(file));
    EXPECT_TRUE(system::sync_file(folder) || errno == EINVAL);
    EXPECT_TRUE(system::sync_file_data(file));
    EXPECT_TRUE(system::sync_filesystem(folder));
    system::start_writeback(file);
    ::close(file);
    ::close(folder);
    EXPECT_FALSE(system::sync_file(-1));
    EXPECT_EQ(errno, EBADF);
    EXPECT_FALSE(system::sync_file_data(-1));
    EXPECT_FALSE(system::sync_filesystem(-1));
}

TEST(SystemCalls, AnUnnamedFileIsReadableAndNotInherited) {
    const Scratch scratch;
    ::setenv("TMPDIR", scratch.folder().c_str(), 1);
    const int file = system::open_unnamed_file();
    ::unsetenv("TMPDIR");
    ASSERT_GE(file, 0);
    EXPECT_FALSE(is_inherited(file));
    EXPECT_TRUE(fs::is_empty(scratch.folder()));
    ASSERT_EQ(::write(file, "text", 4), 4);
    std::array<char, 8> text{};
    EXPECT_EQ(::pread(file, text.data(), text.size(), 0), 4);
    EXPECT_EQ(std::string_view(text.data()), "text");
    ::close(file);
}

TEST(SystemCalls, PipesAndSocketsAreNotInherited) {
    int ends[2];
    ASSERT_TRUE(system::open_pipe(ends));
    EXPECT_FALSE(is_inherited(ends[0]) || is_inherited(ends[1]));
    char byte = 'x';
    EXPECT_EQ(::write(ends[1], &byte, 1), 1);
    EXPECT_EQ(::read(ends[0], &byte, 1), 1);
    ::close(ends[0]);
    ::close(ends[1]);
    ASSERT_TRUE(system::open_socket_pair(ends));
    EXPECT_FALSE(is_inherited(ends[0]) || is_inherited(ends[1]));
    EXPECT_EQ(system::send(ends[0], "text", 4), 4);
    std::array<char, 8> text{};
    EXPECT_EQ(::recv(ends[1], text.data(), text.size(), 0), 4);
    ::close(ends[1]);
    // A signal would end this program.
    errno = 0;
    EXPECT_EQ(system::send(ends[0], "text", 4), -1);
    EXPECT_EQ(errno, EPIPE);
    ::close(ends[0]);
}

TEST(SystemCalls, ReportsTheProgramAndItsEnvironment) {
    const fs::path program = system::program_file();
    // The POSIX branch finds the program on NetBSD only.
    if (!program.empty()) {
        EXPECT_TRUE(fs::equivalent(program, "/proc/self/exe")) << program;
    }
    ::setenv("SWIRL_TEST_VARIABLE", "1", 1);
    bool found = false;
    for (char** entry = system::environment(); *entry != nullptr; ++entry)
        found = found || std::string_view(*entry) == "SWIRL_TEST_VARIABLE=1";
    ::unsetenv("SWIRL_TEST_VARIABLE");
    EXPECT_TRUE(found);
    EXPECT_LE(system::granted_cores(), 1u << 20);
}

}  // namespace
}  // namespace swirl
