// Files that are there whole or not at all. The bytes go to a file beside the target, onto the
// disk, and only then under the final name; so a reader, a second writer, a kill or a power cut
// finds the old file or the new one, never a part. Two writers at once each use a name of their
// own, NAME.<random>.partial, locked as long as they write, and the last rename wins. What a kill
// left behind under such a name has no lock any more: remove_leftovers().
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace swirl {

/// A file written piece by piece. Throws FileError, leaving what was there.
class AtomicFile {
  public:
    explicit AtomicFile(const std::filesystem::path& path);
    ~AtomicFile();  // unfinished: nothing is left
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    void append(std::string_view bytes);
    /// Changes bytes that have been appended.
    void replace(std::uint64_t offset, std::string_view bytes);
    std::uint64_t size() const { return size_; }
    /// Onto the disk, and under its name.
    void finish();

    /// The two halves of finish(), for who brings many files onto the disk at once in between.
    void empty_buffer();
    void give_name();

    /// As finish(), but under a name that nobody has: false if somebody has it.
    bool finish_as_new();

  private:
    [[noreturn]] void fail();

    std::filesystem::path path_, aside_;
    std::string buffer_;
    std::uint64_t size_ = 0;
    int file_ = -1;
};

/// All at once.
void write_file_atomically(const std::filesystem::path& path, std::string_view bytes);
/// The same for a file of which there are few in a folder, as somebody named it: what killed
/// writers left of it goes, too.
void write_named_file(const std::filesystem::path& path, std::string_view bytes);

/// The same under a name that nobody has: false, and nothing is done, if somebody has it, or came
/// first at the same instant.
bool write_new_file(const std::filesystem::path& path, std::string_view bytes);
/// NAME, or NAME-2, -3, …: the first that is not there.
std::filesystem::path free_name(const std::string& name);

/// Throws FileError when it cannot be read. Of a file that is longer it reads one byte more than
/// `most`, however long it is: a device may never end.
std::string read_whole_file(const std::filesystem::path& path,
                            std::size_t maximum = std::string::npos - 1);
/// The same, but throws for pipes, devices and the like, which may never end.
std::string read_regular_file(const std::filesystem::path& path);
/// What a file begins with, by which it is told what it is: eight bytes or as many as there are.
/// Throws as read_regular_file() does.
std::string first_bytes(const std::filesystem::path& path);

/// Removes what writers that were killed left in a folder.
void remove_leftovers(const std::filesystem::path& folder);
/// Only what was to become that file.
void remove_leftovers_of(const std::filesystem::path& path);

/// The end of the name under which a file is written until it is complete.
inline constexpr std::string_view partial_suffix = ".partial";

/// Throws FileError if something stands there that no file may take the place of: who is allowed to
/// would lose a device or a pipe for good. The writers here ask it; who computes for long before he
/// writes asks it at once.
void reject_to_replace(const std::filesystem::path& path);

/// Gives a finished file its final name, on the disk too. Throws FileError.
void give_final_name(const std::filesystem::path& partial, const std::filesystem::path& path);

/// Brings many files of a folder onto the disk at once. To be made before they are written: it is
/// told of every failure from then on. Throws FileError.
class SyncTogether {
  public:
    explicit SyncTogether(const std::filesystem::path& folder);
    ~SyncTogether();
    SyncTogether(const SyncTogether&) = delete;
    SyncTogether& operator=(const SyncTogether&) = delete;
    void sync();

  private:
    [[noreturn]] void fail();
    std::filesystem::path folder_;
    int handle_;
};

/// Brings the names in the folder of `path` onto the disk. Throws FileError.
void sync_folder_of(const std::filesystem::path& path);

/// Throws FileError that says what stands there in place of a regular file.
[[noreturn]] void reject_irregular(const std::filesystem::path& path);

/// Why the last system call failed, in words.
std::string system_reason();

/// All of it, however often the system has to be asked; false if it refuses, errno says why.
bool write_at(int file, std::uint64_t offset, std::string_view bytes);

}  // namespace swirl
