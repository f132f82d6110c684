// A file that can grow for days and is readable after a kill or a power cut at any moment. HDF5
// changes its tables in place; without a journal, a stop between two such changes would leave a
// file that no reader opens.
//
// Between two commits nothing below the committed size changes on the disk: such writes are kept in
// memory as pending pages, and reads see them. Nothing refers to bytes beyond the committed size
// yet, so they are written at once. commit() then
//
//   1. syncs what was written beyond the committed size,
//   2. writes the pending pages with a checksum to a journal, NAME.journal, and syncs it,
//   3. copies the pages into the file, and syncs it,
//   4. empties the journal.
//
// After a stop before the end of step 2 the file is in the state of the last commit. After a later
// stop the journal is complete; the process that opens the file next resumes at step 3, which can
// be repeated any number of times. There is no cheaper kind of commit that survives only a kill:
// it would change pages that recovery from a power cut needs.
//
// A new file stays empty until its first commit. So an empty file is one without any committed
// data.
//
// After an error every further call fails with the same message. So an error that a library ignores
// is never committed, and after an error in step 3 the journal stays.
//
// Only one process can write to a file. A lock of the operating system enforces this; it is held
// until the file is published.
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

    /// Throws FileError, also if this is not a regular file, or is a symbolic link and is to be
    /// written. Completes an interrupted commit; in mode `read` only in memory.
    JournaledFile(const std::filesystem::path& path, Mode mode);
    /// Does not commit.
    ~JournaledFile();
    JournaledFile(const JournaledFile&) = delete;
    JournaledFile& operator=(const JournaledFile&) = delete;

    /// Bytes that were never written are zero.
    void read(std::uint64_t offset, void* bytes, std::size_t size);
    void write(std::uint64_t offset, const void* bytes, std::size_t size);
    std::uint64_t size() const { return size_; }
    /// In mode `read`: whether another process has committed since the file was opened. What was
    /// read may then mix two states. Each commit that enlarges an HDF5 file changes its first page,
    /// and copies that page first.
    bool is_overtaken() const;
    /// Truncates the file, or extends it with zeros, at the next commit.
    void resize(std::uint64_t size);

    /// After this call everything written so far survives a kill and a power cut.
    void commit();
    /// Gives the committed file its final name, and closes it.
    void publish(const std::filesystem::path& path);

    /// Drops everything since the last commit and ignores all further writes: for closing a file
    /// after an error.
    void abandon();

  private:
    static constexpr std::uint64_t page_size = 4096;
    using Page = std::vector<unsigned char>;

    [[noreturn]] void fail(std::string_view problem);
    void reject_after_failure() const;
    void open(Mode mode);
    void start_empty();
    void write_to_disk(std::uint64_t offset, const void* bytes, std::size_t size);
    void read_from_disk(std::uint64_t offset, void* bytes, std::size_t size);
    void sync();
    bool load_journal();
    void open_journal();
    void write_journal();
    void empty_journal();
    void copy_pages();
    bool must_be_journaled(std::uint64_t offset) const;

    Page first_page() const;

    std::filesystem::path path_, journal_path_;
    Page first_page_when_opened_;  // used in mode `read`
    int file_ = -1, journal_ = -1;
    std::uint64_t committed_ = 0, size_ = 0;
    std::map<std::uint64_t, Page> pending_;    // key: page number, below `committed_`
    std::uint64_t bytes_since_writeback_ = 0;  // written, but still in the system's cache
    bool is_new_ = false;                      // nothing has been committed yet
    bool journal_is_needed_ = false;           // it may hold a commit that the file does not
    bool is_abandoned_ = false;
    std::string failure_;  // message of the first error
};

}  // namespace swirl
