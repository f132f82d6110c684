#include "swirl/io/atomic_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <map>
#include <memory>
#include <mutex>
#include <system_error>
#include <utility>

#include "swirl/io/file_error.hpp"
#include "swirl/io/optional_file.hpp"
#include "swirl/io/system_calls.hpp"

namespace swirl {
namespace {

constexpr std::size_t random_digits = 16;
/// What follows the name of the target in a temporary name: a dot, random digits and the suffix.
constexpr std::size_t temporary_suffix_size = 1 + random_digits + partial_suffix.size();

/// Hexadecimal digits that differ between all processes on all machines that share a folder.
std::string random_name() {
    std::uint64_t bits = 0;
    if (!system::random_bytes(&bits, sizeof bits))
        throw FileError(fmt::format("the system gave no random number: {}.", system_reason()));
    return fmt::format("{:016x}", bits);
}

/// The target that a temporary file belongs to, "" if the name is not that of a temporary file.
std::string target_of(const std::string& name) {
    if (name.size() <= temporary_suffix_size || !name.ends_with(partial_suffix)) return "";
    const std::size_t end = name.size() - temporary_suffix_size;
    const std::string digits = name.substr(end + 1, random_digits);
    const bool is_temporary =
        name[end] == '.' && digits.find_first_not_of("0123456789abcdef") == digits.npos;
    return is_temporary ? name.substr(0, end) : "";
}

constexpr std::size_t buffer_size = 1 << 20;

/// The temporary files that were in each folder when this process first wrote a file there. Those
/// of other processes that are killed later are left to the next process: to list a folder of 10⁵
/// results for each of them would take longer than the runs.
class Leftovers {
  public:
    /// Removes those of a target that no process has locked.
    void remove(const std::filesystem::path& target) {
        const std::lock_guard lock(mutex_);
        const std::filesystem::path folder = target.parent_path();
        auto known = by_folder_.find(folder);
        if (known == by_folder_.end()) known = by_folder_.emplace(folder, found_in(folder)).first;
        const auto [begin, end] = known->second.equal_range(target.filename().string());
        for (auto it = begin; it != end; ++it) remove_unlocked(folder / it->second);
        known->second.erase(begin, end);
    }

  private:
    using ByTarget = std::multimap<std::string, std::string>;

    /// A folder that cannot be listed keeps its leftovers: it may still be written to.
    static ByTarget found_in(const std::filesystem::path& folder) {
        ByTarget found;
        std::error_code unknown;
        std::filesystem::directory_iterator it(folder, unknown);
        for (const std::filesystem::directory_iterator end; !unknown && it != end;
             it.increment(unknown)) {
            std::string name = it->path().filename().string(), target = target_of(name);
            if (!target.empty()) found.emplace(std::move(target), std::move(name));
        }
        return found;
    }

    /// A writer holds the lock of its file as long as it runs.
    static void remove_unlocked(const std::filesystem::path& file) {
        const int handle = ::open(file.c_str(), O_WRONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
        if (handle < 0) return;
        if (::flock(handle, LOCK_EX | LOCK_NB) == 0) ::unlink(file.c_str());
        ::close(handle);
    }

    std::mutex mutex_;
    std::map<std::filesystem::path, ByTarget> by_folder_;
};

void remove_leftovers_of(const std::filesystem::path& target) {
    static Leftovers leftovers;
    leftovers.remove(std::filesystem::absolute(target));
}

}  // namespace

bool write_at(int file, std::uint64_t offset, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t written =
            ::pwrite(file, bytes.data(), bytes.size(), static_cast<off_t>(offset));
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return false;
        bytes.remove_prefix(static_cast<std::size_t>(written));
        offset += static_cast<std::uint64_t>(written);
    }
    return true;
}

void throw_not_regular(const std::filesystem::path& path) {
    std::error_code ignored;
    throw FileError(fmt::format("'{}' is {}.", path.string(),
                                std::filesystem::is_directory(path, ignored)
                                    ? "a folder, but a file is needed"
                                    : "not a regular file"));
}

std::string system_reason() { return std::generic_category().message(errno); }

void sync_folder_of(const std::filesystem::path& path) {
    const auto folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
    const int handle = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    // Some file systems do not support this, and report EINVAL or ENOTSUP.
    const bool done =
        handle >= 0 && (system::sync_file(handle) || errno == EINVAL || errno == ENOTSUP);
    const std::string reason = system_reason();
    if (handle >= 0) ::close(handle);
    if (!done)
        throw FileError(fmt::format("'{}' could not be written to: {}.", folder.string(), reason));
}

FilesystemSync::FilesystemSync(const std::filesystem::path& folder)
    : folder_(folder), handle_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    if (handle_ < 0) fail();
}
FilesystemSync::~FilesystemSync() { ::close(handle_); }

void FilesystemSync::fail() {
    throw FileError(
        fmt::format("'{}' could not be written to: {}.", folder_.string(), system_reason()));
}

void FilesystemSync::sync() {
    if (!system::sync_filesystem(handle_)) fail();
}

void require_replaceable(const std::filesystem::path& path) {
    std::error_code unknown;
    const auto kind = std::filesystem::status(path, unknown).type();
    if (kind == std::filesystem::file_type::regular ||
        kind == std::filesystem::file_type::not_found || kind == std::filesystem::file_type::none)
        return;
    throw FileError(fmt::format("'{}' is {} and cannot be replaced by a file.", path.string(),
                                kind == std::filesystem::file_type::directory
                                    ? "a folder"
                                    : "a device, a pipe or a socket"));
}

void rename_durably(const std::filesystem::path& from, const std::filesystem::path& to) {
    require_replaceable(to);
    if (::rename(from.c_str(), to.c_str()) != 0)
        throw FileError(fmt::format("'{}' could not be renamed to '{}': {}.", from.string(),
                                    to.string(), system_reason()));
    sync_folder_of(to);
}

AtomicFile::AtomicFile(const std::filesystem::path& path) : path_(path) {
    require_replaceable(path);
    remove_leftovers_of(path);
    // Tries again if the name is taken, or if another process removed the file as a leftover before
    // it was locked.
    constexpr int max_attempts = 100;
    for (int attempt = 0; attempt < max_attempts && file_ < 0; ++attempt) {
        temporary_ = path.string() + "." + random_name() + std::string(partial_suffix);
        file_ =
            ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
        if (file_ < 0 && errno != EEXIST) fail();
        struct stat about;
        if (file_ >= 0 && ::flock(file_, LOCK_EX | LOCK_NB) == 0 && ::fstat(file_, &about) == 0 &&
            about.st_nlink == 0)
            ::close(std::exchange(file_, -1));
    }
    if (file_ < 0) fail();
}

AtomicFile::~AtomicFile() {
    if (file_ < 0) return;
    ::unlink(temporary_.c_str());
    ::close(file_);
}

void AtomicFile::fail() {
    throw FileError(fmt::format("'{}' could not be written: {}.", path_.string(), system_reason()));
}

void AtomicFile::flush_buffer() {
    if (!write_at(file_, size_ - buffer_.size(), buffer_)) fail();
    buffer_.clear();
}

void AtomicFile::append(std::string_view bytes) {
    if (buffer_.size() + bytes.size() < buffer_size) {
        buffer_ += bytes;
        size_ += bytes.size();
        return;
    }
    flush_buffer();
    if (!write_at(file_, size_, bytes)) fail();
    size_ += bytes.size();
}

void AtomicFile::replace(std::uint64_t offset, std::string_view bytes) {
    flush_buffer();
    if (!write_at(file_, offset, bytes)) fail();
}

void AtomicFile::finish() {
    flush_buffer();
    if (!system::sync_file(file_)) fail();
    publish();
    sync_folder_of(path_);
}

void AtomicFile::publish() {
    if (::rename(temporary_.c_str(), path_.c_str()) != 0) fail();
    if (::close(std::exchange(file_, -1)) != 0) fail();
}

bool AtomicFile::finish_as_new() {
    flush_buffer();
    if (!system::sync_file(file_)) fail();
    if (!system::rename_to_new_name(temporary_, path_)) {
        if (errno != EEXIST) fail();
        return false;
    }
    if (::close(std::exchange(file_, -1)) != 0) fail();
    sync_folder_of(path_);
    return true;
}

void write_file_atomically(const std::filesystem::path& path, std::string_view bytes) {
    AtomicFile file(path);
    file.append(bytes);
    file.finish();
}

bool write_new_file(const std::filesystem::path& path, std::string_view bytes) {
    AtomicFile file(path);
    file.append(bytes);
    return file.finish_as_new();
}

std::filesystem::path unused_name(const std::string& first) {
    std::filesystem::path name = first;
    std::error_code ignored;
    for (int k = 2; std::filesystem::exists(name, ignored); ++k)
        name = fmt::format("{}-{}", first, k);
    return name;
}

void remove_atomic_file(const std::filesystem::path& path) {
    if (::unlink(path.c_str()) != 0 && errno != ENOENT)
        throw FileError(
            fmt::format("'{}' could not be removed: {}.", path.string(), system_reason()));
    remove_leftovers_of(path);
}

namespace {

std::string read_to_the_end(int file, const std::filesystem::path& path, std::size_t maximum) {
    std::string bytes;
    struct stat about;
    if (::fstat(file, &about) == 0 && about.st_size > 0)
        bytes.reserve(std::min(static_cast<std::size_t>(about.st_size), maximum + 1));
    char block[65536];
    ssize_t got;
    while (bytes.size() <= maximum && (got = ::read(file, block, sizeof block)) != 0) {
        if (got < 0 && errno == EINTR) continue;
        if (got < 0)
            throw FileError(
                fmt::format("'{}' could not be read: {}.", path.string(), system_reason()));
        bytes.append(block, static_cast<std::size_t>(got));
    }
    return bytes;
}

std::string read_file(const std::filesystem::path& path, bool regular_only,
                      std::size_t maximum = std::string::npos - 1) {
    // Without O_NONBLOCK, open() waits for a writer if the file is a pipe.
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | (regular_only ? O_NONBLOCK : 0));
    if (file < 0)
        throw FileError(
            fmt::format("'{}' could not be opened: {}.", path.string(), system_reason()));
    const auto close = [](const int* open) { ::close(*open); };
    const std::unique_ptr<const int, decltype(close)> closed_on_return(&file, close);
    struct stat about;
    const bool known = ::fstat(file, &about) == 0;
    if (known && (S_ISDIR(about.st_mode) || (regular_only && !S_ISREG(about.st_mode))))
        throw_not_regular(path);
    return read_to_the_end(file, path, maximum);
}

}  // namespace

std::string read_whole_file(const std::filesystem::path& path, std::size_t maximum) {
    return read_file(path, false, maximum);
}
std::string read_regular_file(const std::filesystem::path& path) { return read_file(path, true); }

std::string file_signature(const std::filesystem::path& path) {
    if (!file_exists(path)) throw FileError(fmt::format("'{}' does not exist.", path.string()));
    constexpr std::size_t size = 8;
    return read_file(path, true, size).substr(0, size);
}

}  // namespace swirl
