#include "swirl/io/optional_file.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <cerrno>
#include <system_error>

#include "swirl/io/atomic_file.hpp"
#include "swirl/io/file_error.hpp"

namespace swirl {
namespace {

namespace fs = std::filesystem;

/// Besides ENOENT, two errors say that no file can have the name: a part of the path is a file, or
/// the name is longer than any.
bool is_absence(int error) { return error == ENOENT || error == ENOTDIR || error == ENAMETOOLONG; }

/// What the system knows about a file; nothing if there is none.
std::optional<struct stat> status_of(const fs::path& path) {
    struct stat about {};
    if (::stat(path.c_str(), &about) == 0) return about;
    if (is_absence(errno)) return {};
    throw FileError(fmt::format("'{}' could not be examined: {}.", path.string(), system_reason()));
}

}  // namespace

std::optional<std::string> read_optional_file(const fs::path& path) {
    if (!file_exists(path)) return {};
    return read_regular_file(path);
}

bool file_exists(const fs::path& path) { return status_of(path).has_value(); }

bool regular_file_exists(const fs::path& path) {
    const std::optional<struct stat> about = status_of(path);
    return about && S_ISREG(about->st_mode);
}

std::vector<std::string> names_in_folder(const fs::path& folder) {
    std::vector<std::string> names;
    if (!file_exists(folder)) return names;
    std::error_code error;
    fs::directory_iterator it(folder, error);
    for (const fs::directory_iterator end; !error && it != end; it.increment(error))
        names.push_back(it->path().filename().string());
    if (error == std::errc::not_a_directory)
        throw FileError(fmt::format("'{}' is a file, but it must be a folder.", folder.string()));
    if (error)
        throw FileError(
            fmt::format("'{}' could not be listed: {}.", folder.string(), error.message()));
    return names;
}

}  // namespace swirl
