#include "swirl/files/whole_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <system_error>
#include <utility>

#include "swirl/files/file_error.hpp"

namespace swirl {
namespace {

/// A number no other writer has: a second file of this process, or one on another machine that
/// shares the folder, gets another name.
std::string own_name() {
    static std::atomic<unsigned> count{0};
    char host[256] = "";
    gethostname(host, sizeof host - 1);
    return fmt::format("{}-{}-{}", host, getpid(), count++);
}

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

constexpr std::size_t buffer_size = 1 << 20;

void sync_folder_of(const std::filesystem::path& path) {
    const auto folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
    const int handle = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (handle < 0) return;  // the rename has happened; only its survival of a power cut is open
    ::fsync(handle);
    ::close(handle);
}

}  // namespace

std::string system_reason() { return std::generic_category().message(errno); }

void give_final_name(const std::filesystem::path& partial, const std::filesystem::path& path) {
    if (::rename(partial.c_str(), path.c_str()) != 0)
        throw FileError(fmt::format("'{}' could not be renamed to '{}': {}.", partial.string(),
                                    path.string(), system_reason()));
    sync_folder_of(path);
}

void take_back_name(const std::filesystem::path& partial, const std::filesystem::path& path) {
    std::error_code ignored;
    if (std::filesystem::exists(partial, ignored) || !std::filesystem::exists(path, ignored))
        return;
    give_final_name(path, partial);
}

WholeFile::WholeFile(const std::filesystem::path& path)
    : path_(path), aside_(path.string() + "." + own_name() + std::string(partial_suffix)) {
    file_ = ::open(aside_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file_ < 0) fail();
}

WholeFile::~WholeFile() {
    if (file_ < 0) return;
    ::close(file_);
    ::unlink(aside_.c_str());
}

void WholeFile::fail() {
    throw FileError(fmt::format("'{}' could not be written: {}.", path_.string(), system_reason()));
}

void WholeFile::empty_buffer() {
    if (!write_at(file_, size_ - buffer_.size(), buffer_)) fail();
    buffer_.clear();
}

void WholeFile::append(std::string_view bytes) {
    buffer_ += bytes;
    size_ += bytes.size();
    if (buffer_.size() >= buffer_size) empty_buffer();
}

void WholeFile::replace(std::uint64_t offset, std::string_view bytes) {
    empty_buffer();
    if (!write_at(file_, offset, bytes)) fail();
}

void WholeFile::finish() {
    empty_buffer();
    if (::fsync(file_) != 0) fail();
    give_name();
    sync_folder_of(path_);
}

void WholeFile::give_name() {
    if (::rename(aside_.c_str(), path_.c_str()) != 0) fail();
    ::close(std::exchange(file_, -1));
}

void write_whole_file(const std::filesystem::path& path, std::string_view bytes) {
    WholeFile file(path);
    file.append(bytes);
    file.finish();
}

std::string read_whole_file(const std::filesystem::path& path) {
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0)
        throw FileError(
            fmt::format("'{}' could not be opened: {}.", path.string(), system_reason()));
    std::string bytes;
    struct stat about;
    if (::fstat(file, &about) == 0 && about.st_size > 0)
        bytes.reserve(static_cast<std::size_t>(about.st_size));
    char block[65536];
    ssize_t got;
    while ((got = ::read(file, block, sizeof block)) != 0) {
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) {
            const std::string reason = system_reason();
            ::close(file);
            throw FileError(fmt::format("'{}' could not be read: {}.", path.string(), reason));
        }
        bytes.append(block, static_cast<std::size_t>(got));
    }
    ::close(file);
    return bytes;
}

}  // namespace swirl
