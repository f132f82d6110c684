#include "swirl/cli/output.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <system_error>

#include "swirl/cli/stop_signal.hpp"
#include "swirl/io/atomic_file.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/shell_word.hpp"

namespace swirl {
namespace {

std::string last_error() { return std::generic_category().message(errno); }

void reject_option(const std::filesystem::path& name, const char* kind) {
    if (name.native().starts_with('-'))
        throw UsageError(
            fmt::format("'{0}' looks like an option, but it must be the name of a {1}.\nhint: for "
                        "a {1} with this name, write {2}",
                        name.string(), kind, shell_word("./" + name.string())));
}

}  // namespace

void reject_unwritable(const std::filesystem::path& file) {
    std::error_code ignored;
    if (file.empty()) throw UsageError("the name of an output file is empty.");
    reject_option(file, "file");
    if (std::filesystem::is_directory(file, ignored))
        throw Failure(fmt::format("'{}' is a folder, but it must be a file.", file.string()));
    const auto folder = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
    if (!std::filesystem::is_directory(folder, ignored))
        throw Failure(fmt::format("'{}' cannot be written: there is no folder '{}'.", file.string(),
                                  folder.string()));
    // A pipe or a device is written in its place. Any other file is replaced, in the folder where
    // it is.
    const std::filesystem::file_status about = std::filesystem::status(file, ignored);
    const bool in_place = std::filesystem::status_known(about) &&
                          about.type() != std::filesystem::file_type::not_found &&
                          about.type() != std::filesystem::file_type::regular;
    if (in_place ? access(file.c_str(), W_OK) != 0
                 : access(canonical_name(file).parent_path().c_str(), W_OK | X_OK) != 0)
        throw Failure(fmt::format("'{}' cannot be written: {}.", file.string(), last_error()));
}

std::filesystem::path canonical_name(const std::filesystem::path& file) {
    std::error_code error;
    auto canonical = std::filesystem::weakly_canonical(std::filesystem::absolute(file), error);
    return error ? std::filesystem::absolute(file).lexically_normal() : canonical;
}

void reject_same_files(const std::vector<std::filesystem::path>& files) {
    if (std::count(files.begin(), files.end(), "-") > 1)
        throw UsageError(
            "only one output can be '-' (standard output).\nhint: use files for the others.");
    std::vector<std::filesystem::path> seen;
    for (const auto& file : files) {
        if (file.empty() || file == "-") continue;
        std::filesystem::path canonical = canonical_name(file);
        if (std::find(seen.begin(), seen.end(), canonical) != seen.end())
            throw UsageError(fmt::format("'{}' is the name of two different files of this call.",
                                         file.string()));
        seen.push_back(std::move(canonical));
    }
}

namespace {

constexpr int poll_interval_ms = 200;

[[noreturn]] void fail_to_write(const std::filesystem::path& file) {
    throw Failure(fmt::format("'{}' could not be written: {}.", file.string(), last_error()));
}

/// Lets the user stop the wait for a reader of a pipe, which has no limit.
void throw_if_stopped(const std::filesystem::path& file) {
    if (stop_signal().load())
        throw Interrupted(
            fmt::format("stopped while waiting for a reader of '{}'.", file.string()));
}

/// Opens a pipe or a device. O_NONBLOCK, because open() would otherwise block until a pipe has a
/// reader, and no signal would end that.
int open_for_writing(const std::filesystem::path& file) {
    for (;;) {
        const int stream = open(file.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC);
        if (stream >= 0) return stream;
        if (errno == EINTR) continue;
        const int open_error = errno;
        std::error_code ignored;
        const bool lacks_reader = open_error == ENXIO && std::filesystem::is_fifo(file, ignored);
        errno = open_error;
        if (!lacks_reader) fail_to_write(file);
        throw_if_stopped(file);
        poll(nullptr, 0, poll_interval_ms);
    }
}

void write_all(int stream, const std::filesystem::path& file, std::string_view text) {
    while (!text.empty()) {
        const ssize_t written = write(stream, text.data(), text.size());
        if (written >= 0) {
            text.remove_prefix(static_cast<std::size_t>(written));
            continue;
        }
        if (errno == EINTR) continue;
        if (errno != EAGAIN) fail_to_write(file);
        pollfd wait{stream, POLLOUT, 0};
        if (poll(&wait, 1, poll_interval_ms) == 0) throw_if_stopped(file);
    }
}

}  // namespace

void write_output(const std::filesystem::path& file, const std::string& text) {
    std::error_code ignored;
    // Writes to the target of a link: a link such as /dev/stdout must not be replaced.
    const auto target = std::filesystem::is_symlink(file, ignored)
                            ? std::filesystem::weakly_canonical(file, ignored)
                            : file;
    const auto kind = std::filesystem::status(file, ignored).type();
    if (kind == std::filesystem::file_type::regular ||
        kind == std::filesystem::file_type::not_found) {
        write_file_atomically(target.empty() ? file : target, text);
        return;
    }
    const int stream = open_for_writing(file);
    write_all(stream, file, text);
    if (close(stream) != 0) fail_to_write(file);
}

std::size_t terminal_width(int file, std::size_t otherwise) {
    winsize size{};
    return ioctl(file, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : otherwise;
}

void make_folder(const std::filesystem::path& folder) {
    reject_option(folder, "folder");
    std::error_code error;
    if (std::filesystem::is_regular_file(folder, error))
        throw Failure(fmt::format("'{}' is a file, but it must be a folder.", folder.string()));
    std::filesystem::create_directories(folder, error);
    if (error)
        throw Failure(
            fmt::format("folder '{}' cannot be created: {}.", folder.string(), error.message()));
    if (access(folder.c_str(), W_OK | X_OK) != 0)
        throw Failure(
            fmt::format("folder '{}' cannot be written to: {}.", folder.string(), last_error()));
}

namespace {

/// Adds a full stop to the first line if it ends without punctuation. Allocates nothing: it also
/// reports that memory ran out.
void print_message(const char* prefix, std::string_view text) {
    const std::string_view first = text.substr(0, text.find('\n')),
                           rest = text.substr(first.size());
    const bool ends = first.empty() || std::string_view(".!?:,;`").find(first.back()) != first.npos;
    std::fprintf(stderr, "%s: %.*s%s%.*s\n", prefix, static_cast<int>(first.size()), first.data(),
                 ends ? "" : ".", static_cast<int>(rest.size()), rest.data());
}

}  // namespace

void print_error(std::string_view text) { print_message("error", text); }
void print_warning(std::string_view text) { print_message("warning", text); }
void print_note(std::string_view text) { print_message("note", text); }

void print_all(const std::string& text) {
    if (std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0)
        return;
    throw Failure(fmt::format("writing to standard output failed: {}.", last_error()));
}

}  // namespace swirl
