// A file that grows for days and is readable after a kill or a power cut at any moment. HDF5
// changes its tables in place; a stop between two of those changes would leave a file that no
// reader opens.
//
// Between two commits nothing below the committed size is changed on the disk: such writes wait in
// memory, and reads see them. What lies beyond the committed size nobody refers to yet, so it is
// written at once. commit() then
//
//   1. brings what was written at once onto the disk,
//   2. writes the waiting pages to a journal beside the file (NAME.journal), with a checksum, and
//      brings it onto the disk,
//   3. copies the pages into the file, and brings that onto the disk,
//   4. empties the journal.
//
// Stopped before 2 is complete: the file is as it was at the last commit. Stopped later: the
// journal is whole, and whoever opens the file next carries on from 3, which may be done any number
// of times. There is one kind of commit: a cheaper one that only a kill survives would change pages
// that a power cut needs.
//
// A new file is no exception: it is empty until its first commit, so an empty file is one in which
// nothing was ever kept.
//
// Once anything has failed, everything that follows fails with the same sentence. Nothing that a
// library forgets to report is ever committed, and after a failed step 3 the journal stays.
//
// Only one process may write to a file; the operating system's lock sees to that, and it is held
// until the file has its final name.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace swirl {

class JournaledFile {
  public:
    enum class Mode { create, change, read };

    /// Throws FileError, also for what is no regular file, and for a symbolic link that is to be
    /// written. Finishes an interrupted commit (in memory only, when reading).
    JournaledFile(const std::filesystem::path& path, Mode mode);
    /// Commits nothing.
    ~JournaledFile();
    JournaledFile(const JournaledFile&) = delete;
    JournaledFile& operator=(const JournaledFile&) = delete;

    /// Bytes never written read as zero.
    void read(std::uint64_t offset, void* bytes, std::size_t size);
    void write(std::uint64_t offset, const void* bytes, std::size_t size);
    std::uint64_t size() const { return size_; }
    /// Of a file that is only read: whether somebody has committed to it since. Then what was read
    /// of it may be half of one state and half of the next. Each commit that makes a file larger
    /// changes its first page, and before all others.
    bool is_overtaken() const;
    /// Cuts the file off, or extends it with zeros, at the next commit.
    void resize(std::uint64_t size);

    /// Makes everything written so far the state that survives.
    void commit();
    /// Gives the committed file its final name, and closes it.
    void rename_to(const std::filesystem::path& path);

    /// Forgets what was written since the last commit, and ignores all that follows: for closing a
    /// file after a failure.
    void abandon();

  private:
    static constexpr std::uint64_t page_size = 4096;
    using Page = std::vector<unsigned char>;

    [[noreturn]] void fail(std::string_view what);
    void reject_after_failure() const;
    void open(Mode mode);
    void begin_anew();
    void write_to_disk(std::uint64_t offset, const void* bytes, std::size_t size);
    void read_from_disk(std::uint64_t offset, void* bytes, std::size_t size);
    void sync();
    bool load_journal();
    void open_journal();
    void write_journal();
    void empty_journal();
    void copy_pages();
    bool waits(std::uint64_t offset) const;

    Page first_page() const;

    std::filesystem::path path_, journal_path_;
    Page first_page_when_opened_;  // of a file that is only read
    int file_ = -1, journal_ = -1;
    std::uint64_t committed_ = 0, size_ = 0;
    std::map<std::uint64_t, Page> waiting_;  // by page number; all below `committed_`
    std::uint64_t not_yet_sent_ = 0;         // written, but left to the system's own time
    bool new_ = false;                       // nothing has been committed yet
    bool journal_counts_ = false;            // it may hold a commit that the file does not
    bool abandoned_ = false;
    std::string failure_;  // the sentence of the first one
};

}  // namespace swirl
