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

TEST(WholeFile, OfManyWhoWriteANewFileAtOnceOneDoesAndTheOthersAreTold) {
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
    EXPECT_EQ(count, 20) << "something was left aside";
}

using Mode = JournaledFile::Mode;

std::string content(const std::filesystem::path& path) {
    JournaledFile file(path, Mode::read);
    std::string bytes(file.size(), '\0');
    file.read(0, bytes.data(), bytes.size());
    return bytes;
}

/// A file whose commits overwrite old bytes and add new ones: generation g is all letters 'a' + g.
void write_generation(JournaledFile& file, int g, std::size_t size) {
    const std::string bytes(size, char('a' + g));
    // In pieces, across page borders.
    for (std::size_t at = 0; at < size; at += 1000)
        file.write(at, bytes.data() + at, std::min<std::size_t>(1000, size - at));
}

TEST(Checksum, IsThePublishedCrc64) {
    EXPECT_EQ(checksum("123456789"), 0x995dc9bbdf1939fau);
    EXPECT_EQ(checksum(""), 0u);
    // Pieces of any length give the checksum of the whole.
    const std::string text = "The container centre runs counter-clockwise round the swirl centre.";
    for (std::size_t cut = 0; cut <= text.size(); ++cut) {
        Checksum c;
        c.add(text.data(), cut);
        c.add(text.data() + cut, text.size() - cut);
        EXPECT_EQ(c.value(), checksum(text));
    }
}

TEST(StagedFile, ReadsBackWhatWasWrittenBeforeAndAfterTheCommit) {
    const Scratch scratch;
    JournaledFile file(scratch / "f", Mode::create);
    write_generation(file, 0, 10'000);
    file.commit();
    file.write(4090, "0123456789", 10);
    char bytes[14];
    file.read(4088, bytes, 14);
    EXPECT_EQ(std::string_view(bytes, 14), "aa0123456789aa");
    file.commit();
    std::string wanted(10'000, 'a');
    wanted.replace(4090, 10, "0123456789");
    EXPECT_EQ(content(scratch / "f"), wanted);
    EXPECT_EQ(read_whole_file(scratch / "f"), wanted);
}

TEST(StagedFile, NothingOfAnUncommittedChangeReachesTheOldBytes) {
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

// Every state the disk can be in when the kill comes during a commit: any part of the journal
// written; all of the journal and any number of its pages copied.
TEST(StagedFile, AKillAtAnyMomentOfACommitLeavesTheOldStateOrTheNew) {
    const Scratch scratch;
    const std::size_t size = 3 * 4096;
    {
        JournaledFile file(scratch / "old", Mode::create);
        write_generation(file, 0, size);
        file.commit();
    }
    // The journal of the step from 'a' to 'b', caught by a child that dies before it is emptied.
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

// Also where it is not the one who created it who writes first.
TEST(StagedFile, IsEmptyUntilItsFirstCommitWhoeverOpensIt) {
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

TEST(StagedFile, SurvivesKillsAtRandomMoments) {
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
        // One generation, whole, except for the tail that a longer one before it left behind.
        const auto g = std::size_t(bytes.front() - 'a');
        ASSERT_EQ(bytes.find_first_not_of(bytes.front()) >= 50'000 + 5'000 * g, true);
    }
}

TEST(StagedFile, RefusesASecondWriter) {
    const Scratch scratch;
    JournaledFile file(scratch / "f", Mode::create);
    EXPECT_THROW(JournaledFile(scratch / "f", Mode::create), FileError);
    EXPECT_THROW(JournaledFile(scratch / "f", Mode::change), FileError);
    EXPECT_NO_THROW(JournaledFile(scratch / "f", Mode::read));
}

TEST(WholeFile, StandsUnderItsNameOnlyWhenItIsComplete) {
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

TEST(WholeFile, HoldsSmallAndLargePiecesInTheirOrder) {
    // Pieces wait in a buffer of a mebibyte; who does not fit goes past it.
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

TEST(WholeFile, SaysWhereItCouldNotBeWritten) {
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
