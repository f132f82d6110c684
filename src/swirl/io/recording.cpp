#include "swirl/io/recording.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "swirl/io/atomic_file.hpp"
#include "swirl/io/file_error.hpp"
#include "swirl/io/h5md.hpp"
#include "swirl/io/optional_file.hpp"

namespace swirl {

std::filesystem::path partial_name(const std::filesystem::path& path) {
    return path.string() + std::string(partial_suffix);
}

std::string recorded_entry(const std::filesystem::path& file, const std::string& name) {
    const Hdf5File recording(file, JournaledFile::Mode::read);
    h5md::require_known_format(recording, file);
    const std::string path = h5md::parameters + "/" + name;
    return recording.has(path) ? recording.read_text(path) : "";
}

void reject_foreign_recording(const std::filesystem::path& path, const std::string& run) {
    const auto partial = partial_name(path);
    if (!file_exists(partial)) return;
    // A run that is killed before its first commit leaves an empty file.
    if (JournaledFile(partial, JournaledFile::Mode::read).size() == 0) return;
    std::string recorded;
    try {
        recorded = recorded_entry(partial, run_entry);
    } catch (const DamagedFile& error) {
        throw DamagedFile(fmt::format("{}\nhint: use --overwrite to replace it.", error.what()));
    }
    if (recorded != run)
        throw FileError(
            fmt::format("'{}' is the unfinished recording of another run.\nhint: complete that run "
                        "with --resume, choose another name, or use --overwrite to replace it.",
                        partial.string()));
}

Hdf5File reopen_recording(const std::filesystem::path& path, const std::string& run,
                          const std::string& dataset) {
    const auto partial = partial_name(path);
    const bool is_finished = !file_exists(partial) && file_exists(path);
    if (!is_finished && !file_exists(partial))
        throw DamagedFile(
            fmt::format("'{}' is missing, but the checkpoint continues it.", partial.string()));
    const auto file = is_finished ? path : partial;
    if (recorded_entry(file, run_entry) != run)
        throw DamagedFile(
            fmt::format("'{}' was recorded by another run than the checkpoint; it was left "
                        "unchanged.",
                        file.string()));
    if (!Hdf5File(file, JournaledFile::Mode::read).has(dataset))
        throw DamagedFile(fmt::format("'{}' is a recording of another kind: it has no {}.",
                                      file.string(), dataset));
    if (is_finished) rename_durably(path, partial);
    return {partial, JournaledFile::Mode::change};
}

void require_recorded(const std::filesystem::path& path, const char* items, std::uint64_t recorded,
                      std::uint64_t in_checkpoint) {
    if (recorded < in_checkpoint)
        throw DamagedFile(fmt::format(
            "'{}' has {} {}, but the checkpoint was made when it had {}; it does not belong to the "
            "checkpoint, or was changed since.",
            path.string(), recorded, items, in_checkpoint));
}

std::uint64_t common_length(const std::filesystem::path& path, bool complete,
                            const std::vector<std::uint64_t>& lengths) {
    const auto [shortest, longest] = std::minmax_element(lengths.begin(), lengths.end());
    if (complete && *shortest != *longest)
        throw_inconsistent(path, fmt::format("it is marked as complete, but its columns differ in "
                                             "length, from {} to {}",
                                             *shortest, *longest));
    return *shortest;
}

void throw_inconsistent(const std::filesystem::path& path, const std::string& what) {
    throw FileError(fmt::format("'{}' is inconsistent: {}.", path.string(), what));
}

}  // namespace swirl
