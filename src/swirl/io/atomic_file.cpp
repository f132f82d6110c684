#include "swirl/io/atomic_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <fstream>
#include <memory>
#include <system_error>
#include <utility>

#include "swirl/io/file_error.hpp"
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

void write_file_and_clean_up(const std::filesystem::path& path, std::string_view bytes) {
    write_file_atomically(path, bytes);
    remove_leftovers_of(path);
}

namespace {

std::string read_to_the_end(int file, const std::filesystem::path& path, std::size_t maximum) {
    std::string bytes;
    struct stat about;
    if (::fstat(file, &about) == 0 && about.st_size > 0)
        bytes.reserve(std::min(static_cast<std::size_t>(about.st_size), maximum));
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
    std::error_code unknown;
    if (std::filesystem::exists(path, unknown) && !std::filesystem::is_regular_file(path, unknown))
        throw_not_regular(path);
    if (!std::filesystem::exists(path, unknown) && !unknown)
        throw FileError(fmt::format("'{}' does not exist.", path.string()));
    constexpr std::size_t size = 8;
    std::ifstream stream(path, std::ios::binary);
    if (!stream) throw FileError(fmt::format("'{}' could not be opened.", path.string()));
    std::string bytes(size, '\0');
    stream.read(bytes.data(), size);
    bytes.resize(static_cast<std::size_t>(stream.gcount()));
    return bytes;
}

namespace {

/// Removes the leftovers of one target, or of all if `target` is empty.
void remove_leftovers_in(const std::filesystem::path& folder, std::string_view target) {
    std::error_code error;
    for (std::filesystem::directory_iterator it(folder.empty() ? "." : folder, error), end;
         !error && it != end; it.increment(error)) {
        const std::string found = target_of(it->path().filename().string());
        if (found.empty() || (!target.empty() && found != target)) continue;
        const int file = ::open(it->path().c_str(), O_WRONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
        if (file < 0) continue;
        // The lock of a file is held as long as its writer runs.
        if (::flock(file, LOCK_EX | LOCK_NB) == 0) ::unlink(it->path().c_str());
        ::close(file);
    }
}

}  // namespace

void remove_leftovers(const std::filesystem::path& folder) { remove_leftovers_in(folder, {}); }
void remove_leftovers_of(const std::filesystem::path& path) {
    remove_leftovers_in(path.parent_path(), path.filename().string());
}

}  // namespace swirl
