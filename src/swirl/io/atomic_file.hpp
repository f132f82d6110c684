// Atomic writes. The bytes go to a temporary file next to the target, then to the disk, and only
// then under the final name. So a reader, a second writer, a kill or a power cut finds the old file
// or the new one, never a part of it.
//
// Concurrent writers of one target use different temporary names, NAME.<random>.partial, and hold a
// lock on them while they write; the last rename wins. A temporary file without a lock was left by
// a writer that was killed. The next process that opens the target for writing, or removes it,
// removes these leftovers: it lists each folder once, at the first file that it writes there.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace swirl {

/// A file that is written piece by piece and then published. If a function throws FileError, the
/// target is unchanged.
class AtomicFile {
  public:
    /// Removes what killed processes left of this target.
    explicit AtomicFile(const std::filesystem::path& path);
    ~AtomicFile();  // removes the temporary file if it was not published
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    void append(std::string_view bytes);
    /// Overwrites bytes that have been appended.
    void replace(std::uint64_t offset, std::string_view bytes);
    std::uint64_t size() const { return size_; }
    /// Brings the bytes onto the disk and publishes the file.
    void finish();

    /// The two parts of finish(), for callers that sync many files at once in between.
    void flush_buffer();
    void publish();

    /// Like finish(), but never replaces a file: returns false if the target exists.
    bool finish_as_new();

  private:
    [[noreturn]] void fail();

    std::filesystem::path path_, temporary_;
    std::string buffer_;
    std::uint64_t size_ = 0;
    int file_ = -1;
};

void write_file_atomically(const std::filesystem::path& path, std::string_view bytes);
/// Removes a file that was written atomically, if it is there, and its leftovers.
void remove_atomic_file(const std::filesystem::path& path);

/// Writes atomically, but only if no file has this name: otherwise returns false. Of several
/// concurrent calls, one succeeds.
bool write_new_file(const std::filesystem::path& path, std::string_view bytes);
/// NAME, NAME-2, NAME-3, …: the first that does not exist.
std::filesystem::path unused_name(const std::string& name);

/// Reads a file to its end. Of a file longer than `maximum` it reads maximum + 1 bytes, since a
/// device may never end. Throws FileError.
std::string read_whole_file(const std::filesystem::path& path,
                            std::size_t maximum = std::string::npos - 1);
/// Like read_whole_file(), but also throws for pipes, devices and the like.
std::string read_regular_file(const std::filesystem::path& path);
/// The first eight bytes of a regular file (or fewer, if it is shorter), which identify its format.
/// Throws like read_regular_file().
std::string file_signature(const std::filesystem::path& path);

/// Suffix of the name of a file that is not complete yet.
inline constexpr std::string_view partial_suffix = ".partial";

/// Throws FileError if something other than a regular file has this name: a rename would replace a
/// device or a pipe for good. The writers here check it; check it before a long computation, too.
void require_replaceable(const std::filesystem::path& path);

/// Renames a file so that the new name survives a power cut. Throws FileError.
void rename_durably(const std::filesystem::path& from, const std::filesystem::path& to);

/// Brings all files of a file system onto the disk with one call. Create it before the files are
/// written, because the system reports a write error only to those who had it open then. Throws
/// FileError.
class FilesystemSync {
  public:
    explicit FilesystemSync(const std::filesystem::path& folder);
    ~FilesystemSync();
    FilesystemSync(const FilesystemSync&) = delete;
    FilesystemSync& operator=(const FilesystemSync&) = delete;
    void sync();

  private:
    [[noreturn]] void fail();
    std::filesystem::path folder_;
    int handle_;
};

/// Brings the names in the folder of `path` onto the disk. Throws FileError.
void sync_folder_of(const std::filesystem::path& path);

/// Throws FileError: `path` is a folder, a pipe or the like instead of a regular file.
[[noreturn]] void throw_not_regular(const std::filesystem::path& path);

/// The error message of the last system call.
std::string system_reason();

/// Writes all bytes, in as many system calls as it takes. Returns false on an error, with errno
/// set.
bool write_at(int file, std::uint64_t offset, std::string_view bytes);

}  // namespace swirl
