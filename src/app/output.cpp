#include "swirl/app/output.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <system_error>

#include "swirl/files/whole_file.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/shell_word.hpp"

namespace swirl {
namespace {

std::string last_error() { return std::generic_category().message(errno); }

void refuse_option(const std::filesystem::path& name, const char* kind) {
    if (name.native().starts_with('-'))
        throw WrongCall(fmt::format(
            "'{0}' looks like an option, but here the name of a {1} must stand; a {1} of that "
            "name would be {2}.",
            name.string(), kind, shell_word("./" + name.string())));
}

}  // namespace

void refuse_unwritable(const std::filesystem::path& file) {
    std::error_code ignored;
    if (file.empty()) throw WrongCall("The name of an output file is empty.");
    refuse_option(file, "file");
    if (std::filesystem::is_directory(file, ignored))
        throw Failure(fmt::format("'{}' is a folder, but it must be the name of a file to write.",
                                  file.string()));
    const auto folder = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
    if (!std::filesystem::is_directory(folder, ignored))
        throw Failure(fmt::format("'{}' cannot be written: there is no folder '{}'.", file.string(),
                                  folder.string()));
    if (access(folder.c_str(), W_OK | X_OK) != 0)
        throw Failure(fmt::format("'{}' cannot be written: {}.", file.string(), last_error()));
}

std::filesystem::path whole_name(const std::filesystem::path& file) {
    std::error_code unknown;
    auto whole = std::filesystem::weakly_canonical(std::filesystem::absolute(file), unknown);
    return unknown ? std::filesystem::absolute(file).lexically_normal() : whole;
}

void refuse_same_files(const std::vector<std::filesystem::path>& files) {
    if (std::count(files.begin(), files.end(), "-") > 1)
        throw WrongCall(
            "Only one thing can go to standard output, which is what '-' stands for; give each of "
            "the others a file.");
    std::vector<std::filesystem::path> seen;
    for (const auto& file : files) {
        if (file.empty() || file == "-") continue;
        std::filesystem::path whole = whole_name(file);
        if (std::find(seen.begin(), seen.end(), whole) != seen.end())
            throw WrongCall(fmt::format(
                "'{}' is the name of two files; each needs a name of its own.", file.string()));
        seen.push_back(std::move(whole));
    }
}

void write_output(const std::filesystem::path& file, const std::string& text) {
    std::error_code ignored;
    // Through a link to what it stands for: /dev/stdout must stay what it is.
    const auto target = std::filesystem::is_symlink(file, ignored)
                            ? std::filesystem::weakly_canonical(file, ignored)
                            : file;
    const auto kind = std::filesystem::status(file, ignored).type();
    if (kind == std::filesystem::file_type::regular ||
        kind == std::filesystem::file_type::not_found) {
        write_named_file(target.empty() ? file : target, text);
        return;
    }
    std::FILE* const stream = std::fopen(file.c_str(), "w");
    const bool written = stream && std::fwrite(text.data(), 1, text.size(), stream) == text.size();
    const bool closed = stream && std::fclose(stream) == 0;
    if (!written || !closed)
        throw Failure(fmt::format("'{}' could not be written: {}.", file.string(), last_error()));
}

void make_folder(const std::filesystem::path& folder) {
    refuse_option(folder, "folder");
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error)
        throw Failure(
            fmt::format("The folder '{}' cannot be made: {}.", folder.string(), error.message()));
    if (access(folder.c_str(), W_OK | X_OK) != 0)
        throw Failure(fmt::format("The folder '{}' cannot be written to: {}.", folder.string(),
                                  last_error()));
}

void print_all(const std::string& text) {
    if (std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0)
        return;
    throw Failure(fmt::format("Writing to standard output failed: {}.", last_error()));
}

}  // namespace swirl
