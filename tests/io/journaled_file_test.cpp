#include "swirl/io/journaled_file.hpp"

#include <algorithm>
#include <csignal>
#include <cstring>
#include <map>
#include <thread>

#include "io/scratch.hpp"
#include "swirl/io/atomic_file.hpp"
#include "swirl/io/checksum.hpp"
#include "swirl/io/file_error.hpp"

namespace swirl {
namespace {

TEST(AtomicFile, OneOfSeveralConcurrentWritersOfANewFileSucceeds) {
    const Scratch scratch;
    for (int round = 0; round < 20; ++round) {
        const auto path = scratch / ("new-" + std::to_string(round));
        std::vector<int> wrote(4, -1);
        std::vector<std::thread> writers;
        for (int k = 0; k < 4; ++k)
            writers.emplace_back([&, k] { wrote[k] = write_new_file(path, std::to_string(k)); });
        for (std::thread& writer : writers) writer.join();
        ASSERT_EQ(std::count(wrote.begin(), wrote.end(), 1), 1);
        const auto winner = std::find(wrote.begin(), wrote.end(), 1) - wrote.begin();
        EXPECT_EQ(read_whole_file(path), std::to_string(winner));
    }
    const auto count = std::distance(std::filesystem::directory_iterator(scratch.folder()), {});
    EXPECT_EQ(count, 20) << "temporary files are left";
}

using Mode = JournaledFile::Mode;

std::string content(const std::filesystem::path& path) {
    JournaledFile file(path, Mode::read);
    std::string bytes(file.size(), '\0');
    file.read(0, bytes.data(), bytes.size());
    return bytes;
}

/// Fills the file with the letter 'a' + g. The next generation overwrites old bytes and adds new
/// ones.
void write_generation(JournaledFile& file, int g, std::size_t size) {
    const std::string bytes(size, char('a' + g));
    // In pieces that cross page borders.
    for (std::size_t at = 0; at < size; at += 1000)
        file.write(at, bytes.data() + at, std::min<std::size_t>(1000, size - at));
}

TEST(Checksum, EqualsPublishedCrc64) {
    EXPECT_EQ(checksum("123456789"), 0x995dc9bbdf1939fau);
    EXPECT_EQ(checksum(""), 0u);
    // The checksum does not depend on how the bytes are divided.
    const std::string text = "The container centre runs counter-clockwise round the swirl centre.";
    for (std::size_t cut = 0; cut <= text.size(); ++cut) {
        Checksum c;
        c.add(text.data(), cut);
        c.add(text.data() + cut, text.size() - cut);
        EXPECT_EQ(c.value(), checksum(text));
    }
}

TEST(JournaledFile, ReadsCommittedAndUncommittedBytes) {
    const Scratch scratch;
    JournaledFile file(scratch / "f", Mode::create);
    write_generation(file, 0, 10'000);
    file.commit();
    file.write(4090, "0123456789", 10);
    char bytes[14];
    file.read(4088, bytes, 14);
    EXPECT_EQ(std::string_view(bytes, 14), "aa0123456789aa");
    file.commit();
    std::string expected(10'000, 'a');
    expected.replace(4090, 10, "0123456789");
    EXPECT_EQ(content(scratch / "f"), expected);
    EXPECT_EQ(read_whole_file(scratch / "f"), expected);
}

TEST(JournaledFile, UncommittedChangesLeaveCommittedBytesOnDisk) {
    const Scratch scratch;
    JournaledFile file(scratch / "f", Mode::create);
    write_generation(file, 0, 10'000);
    file.commit();
    write_generation(file, 1, 30'000);
    EXPECT_EQ(read_whole_file(scratch / "f").substr(0, 10'000), std::string(10'000, 'a'));
    file.abandon();
    file.write(0, "zzz", 3);
    file.commit();
    EXPECT_EQ(read_whole_file(scratch / "f"), std::string(10'000, 'a'));
}

// The states of the disk after a kill during a commit: any part of the journal written, or all of
// the journal written and any number of pages copied.
TEST(JournaledFile, KillDuringCommitLeavesOldOrNewState) {
    const Scratch scratch;
    const std::size_t size = 3 * 4096;
    {
        JournaledFile file(scratch / "old", Mode::create);
        write_generation(file, 0, size);
        file.commit();
    }
    // The journal of a commit that replaces 'a' by 'b'.
    const std::string old_bytes = read_whole_file(scratch / "old");
    std::string journal(32, '\0');
    std::memcpy(journal.data(), "swirljn1", 8);
    for (std::uint64_t page = 0; page < 3; ++page) {
        journal.append(reinterpret_cast<const char*>(&page), 8);
        journal.append(4096, 'b');
    }
    const std::uint64_t numbers[] = {3, size, checksum(std::string_view(journal).substr(32))};
    std::memcpy(journal.data() + 8, numbers, sizeof numbers);

    const auto opened = [&](std::size_t journal_size, std::size_t copied) {
        write_quickly(scratch / "f", std::string(copied, 'b') + old_bytes.substr(copied));
        write_quickly(scratch / "f.journal", journal.substr(0, journal_size));
        const std::string seen = content(scratch / "f");
        JournaledFile file(scratch / "f", Mode::change);  // repairs
        EXPECT_EQ(content(scratch / "f"), seen);
        return seen;
    };
    for (std::size_t cut = 0; cut < journal.size(); cut += 97)
        EXPECT_EQ(opened(cut, 0), std::string(size, 'a')) << "journal cut at " << cut;
    for (std::size_t copied = 0; copied <= size; copied += 512)
        EXPECT_EQ(opened(journal.size(), copied), std::string(size, 'b')) << copied << " copied";
}

// This holds even if the object that writes first is not the one that created the file.
TEST(JournaledFile, IsEmptyUntilFirstCommit) {
    const Scratch scratch;
    const auto path = scratch / "f";
    { JournaledFile(path, Mode::create).commit(); }
    for (const std::size_t size : {20'000u, 50'000u}) {
        JournaledFile file(path, Mode::change);
        write_generation(file, 0, size);
        EXPECT_EQ(std::filesystem::file_size(path), 0u);
    }
    EXPECT_EQ(content(path), "");
    {
        JournaledFile file(path, Mode::change);
        write_generation(file, 1, 20'000);
        file.commit();
    }
    EXPECT_EQ(content(path), std::string(20'000, 'b'));
}

TEST(JournaledFile, SurvivesKillsAtRandomMoments) {
    const Scratch scratch;
    const auto path = scratch / "f";
    { JournaledFile(path, Mode::create).commit(); }
    for (int round = 0; round < 20; ++round) {
        const pid_t child = ::fork();
        if (child == 0) {
            JournaledFile file(path, Mode::change);
            for (int g = 0;; g = (g + 1) % 26) {
                write_generation(file, g, 50'000 + 5'000 * std::size_t(g));
                file.commit();
            }
        }
        ::usleep(unsigned(2000 + 731 * round));
        ::kill(child, SIGKILL);
        ::waitpid(child, nullptr, 0);
        const std::string bytes = content(path);
        if (bytes.empty()) continue;
        // One complete generation, perhaps followed by the tail of a longer earlier one.
        const auto g = std::size_t(bytes.front() - 'a');
        ASSERT_EQ(bytes.find_first_not_of(bytes.front()) >= 50'000 + 5'000 * g, true);
    }
}

TEST(JournaledFile, SecondWriterIsRejected) {
    const Scratch scratch;
    JournaledFile file(scratch / "f", Mode::create);
    EXPECT_THROW(JournaledFile(scratch / "f", Mode::create), FileError);
    EXPECT_THROW(JournaledFile(scratch / "f", Mode::change), FileError);
    EXPECT_NO_THROW(JournaledFile(scratch / "f", Mode::read));
}

TEST(AtomicFile, IsPublishedOnlyWhenComplete) {
    const Scratch scratch;
    write_file_atomically(scratch / "f", "old");
    {
        AtomicFile file(scratch / "f");
        file.append(std::string(3'000'000, 'x'));
        EXPECT_EQ(read_whole_file(scratch / "f"), "old");
    }
    EXPECT_EQ(read_whole_file(scratch / "f"), "old");
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(scratch.folder()), {}), 1);
    {
        AtomicFile file(scratch / "f");
        file.append("new......");
        file.replace(0, "NEW");
        file.finish();
    }
    EXPECT_EQ(read_whole_file(scratch / "f"), "NEW......");
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(scratch.folder()), {}), 1);
}

TEST(AtomicFile, KeepsTheOrderOfSmallAndLargePieces) {
    // Small pieces are buffered, up to a mebibyte; large ones bypass the buffer.
    const Scratch scratch;
    std::string all;
    AtomicFile file(scratch / "f");
    for (const std::size_t size : {3, 1 << 20, 5, (1 << 20) - 5, 4, 3 << 20, 0, 700'000, 700'000}) {
        const std::string piece(size, char('a' + all.size() % 23));
        file.append(piece);
        all += piece;
        EXPECT_EQ(file.size(), all.size());
    }
    file.replace(2, "changed");
    all.replace(2, 7, "changed");
    file.finish();
    EXPECT_TRUE(read_whole_file(scratch / "f") == all);
}

TEST(AtomicFile, ErrorNamesTheFile) {
    const Scratch scratch;
    try {
        write_file_atomically(scratch / "absent/f", "x");
        FAIL();
    } catch (const FileError& error) {
        EXPECT_NE(std::string(error.what()).find("absent/f' could not be written: No such file"),
                  std::string::npos)
            << error.what();
    }
}

}  // namespace
}  // namespace swirl
