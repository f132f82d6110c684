#include "swirl/io/recording.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "swirl/io/atomic_file.hpp"
#include "swirl/io/file_error.hpp"
#include "swirl/io/h5md.hpp"

namespace swirl {
std::filesystem::path partial_name(const std::filesystem::path& path) {
    return path.string() + std::string(partial_suffix);
}

std::string recorded_entry(const std::filesystem::path& file, const std::string& name) {
    const Hdf5File recording(file, JournaledFile::Mode::read);
    h5md::require_known_format(recording, file);
    const std::string at = "/parameters/" + name;
    return recording.has(at) ? recording.read_text(at) : "";
}

void reject_recording_of_another(const std::filesystem::path& file, const std::string& run) {
    if (recorded_entry(file, run_entry) != run)
        throw FileError(fmt::format(
            "'{}' was recorded by another run than the checkpoint, and is left as it is; the run "
            "cannot go on without its own recording.",
            file.string()));
}

void reject_foreign_recording(const std::filesystem::path& path, const std::string& run) {
    const auto partial = partial_name(path);
    std::error_code ignored;
    if (!std::filesystem::exists(partial, ignored)) return;
    // Killed before its first commit: nothing was ever in there.
    if (JournaledFile(partial, JournaledFile::Mode::read).size() == 0) return;
    if (recorded_entry(partial, run_entry) != run)
        throw FileError(
            fmt::format("'{}' is the unfinished recording of another run; finish that one with "
                        "--resume, choose "
                        "another name, or give --overwrite to lose it.",
                        partial.string()));
}

Hdf5File reopen_recording(const std::filesystem::path& path, const std::string& run) {
    const auto partial = partial_name(path);
    std::error_code ignored;
    const bool finished =
        !std::filesystem::exists(partial, ignored) && std::filesystem::exists(path, ignored);
    const auto& there = finished ? path : partial;
    reject_recording_of_another(there, run);
    if (finished) give_final_name(path, partial);
    return {partial, JournaledFile::Mode::change};
}

std::uint64_t common_length(const std::filesystem::path& path, bool complete,
                            const std::vector<std::uint64_t>& lengths) {
    const auto [shortest, longest] = std::minmax_element(lengths.begin(), lengths.end());
    if (complete && *shortest != *longest)
        throw FileError(fmt::format(
            "'{}' contradicts itself: it says that it is complete, but its columns differ in "
            "length, from {} to {}.",
            path.string(), *shortest, *longest));
    return *shortest;
}

}  // namespace swirl
