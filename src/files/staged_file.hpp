// A file that grows for days and is readable after a kill at any moment. HDF5 changes its tables
// in place; a kill between two of those changes would leave a file that no reader opens.
//
// Between two commits nothing below the committed size is changed on the disk: such writes wait in
// memory, and reads see them. What lies beyond the committed size nobody refers to yet, so it is
// written at once. commit() then
//
//   1. writes the waiting pages to a journal beside the file (NAME.journal), with a checksum,
//   2. copies them into the file,
//   3. empties the journal.
//
// Killed before 1 is complete: the file is as it was at the last commit. Killed later: the journal
// is whole, and whoever opens the file next carries on from 2, which may be done any number of
// times. A full disk stops 1, and the file is as it was.
//
// Only one process may write to a file; the operating system's lock sees to that.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <vector>

namespace swirl {

class StagedFile {
  public:
    enum class Mode { create, change, read };

    /// Throws FileError. Finishes an interrupted commit (in memory only, when reading).
    StagedFile(const std::filesystem::path& path, Mode mode);
    ~StagedFile();
    StagedFile(const StagedFile&) = delete;
    StagedFile& operator=(const StagedFile&) = delete;

    /// Bytes never written read as zero.
    void read(std::uint64_t offset, void* bytes, std::size_t size) const;
    void write(std::uint64_t offset, const void* bytes, std::size_t size);
    std::uint64_t size() const { return size_; }
    /// Cuts the file off, or extends it with zeros, at the next commit.
    void resize(std::uint64_t size);

    /// Makes everything written so far the state that survives a kill; `durable`: a power cut too.
    void commit(bool durable);

    /// Forgets what was written since the last commit, and ignores all that follows: for closing a
    /// file after a failure.
    void abandon();

  private:
    static constexpr std::uint64_t page_size = 4096;
    using Page = std::vector<unsigned char>;

    void write_to_disk(std::uint64_t offset, const void* bytes, std::size_t size);
    void read_from_disk(std::uint64_t offset, void* bytes, std::size_t size) const;
    bool load_journal();
    void write_journal(bool durable);
    void copy_pages();

    std::filesystem::path path_, journal_path_;
    int file_ = -1, journal_ = -1;
    std::uint64_t committed_ = 0, size_ = 0;
    std::map<std::uint64_t, Page> waiting_;  // by page number; all below `committed_`
    std::uint64_t not_yet_sent_ = 0;         // written, but left to the system's own time
    bool abandoned_ = false;
};

}  // namespace swirl
