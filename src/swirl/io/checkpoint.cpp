#include "swirl/io/checkpoint.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <cstring>
#include <string_view>

#include "swirl/io/atomic_file.hpp"
#include "swirl/io/checksum.hpp"
#include "swirl/io/file_error.hpp"

namespace swirl {
namespace {

constexpr std::string_view signature = "swirl checkpoint ";
constexpr std::string_view first_line = "swirl checkpoint 12\n";

std::string number(std::uint64_t n) { return {reinterpret_cast<const char*>(&n), sizeof n}; }

std::uint64_t number_at(std::string_view bytes) {
    std::uint64_t n;
    std::memcpy(&n, bytes.data(), sizeof n);
    return n;
}

}  // namespace

void write_checkpoint(const std::filesystem::path& path, const Checkpoint& checkpoint) {
    Checksum sum;
    AtomicFile file(path);
    const auto add = [&](std::string_view bytes) {
        sum.add(bytes.data(), bytes.size());
        file.append(bytes);
    };
    add(first_line);
    for (const std::string* part : {&checkpoint.about, &checkpoint.state}) {
        add(number(part->size()));
        add(*part);
    }
    file.append(number(sum.value()));
    file.finish();
}

Checkpoint read_checkpoint(const std::filesystem::path& path) {
    const std::string bytes = read_regular_file(path);
    std::string_view rest = bytes;
    const auto reject = [&](const std::string& problem) {
        throw FileError(fmt::format("'{}' {}.", path.string(), problem));
    };
    const auto reject_damaged = [&] {
        throw DamagedFile(fmt::format(
            "'{}' is damaged: its checksum does not match its content.\nhint: remove it to start "
            "its run again.",
            path.string()));
    };
    if (first_line.starts_with(rest)) reject_damaged();
    if (!rest.starts_with(signature)) reject("is not a checkpoint of swirl");
    const std::size_t line = rest.find('\n');
    if (rest.substr(0, line + 1) != first_line)
        reject(fmt::format(
            "is a checkpoint of format {}, but this program reads format {}.\nhint: resume it with "
            "the program that wrote it",
            rest.substr(signature.size(), std::min<std::size_t>(line, 40) - signature.size()),
            first_line.substr(signature.size(), first_line.size() - signature.size() - 1)));
    constexpr std::size_t numbers_size = 3 * sizeof(std::uint64_t);  // two lengths, checksum
    if (rest.size() < first_line.size() + numbers_size) reject_damaged();
    const std::uint64_t written = number_at(rest.substr(rest.size() - 8));
    rest.remove_suffix(8);
    if (checksum(rest) != written) reject_damaged();
    rest.remove_prefix(first_line.size());
    Checkpoint checkpoint;
    for (std::string* part : {&checkpoint.about, &checkpoint.state}) {
        if (rest.size() < 8 || number_at(rest) > rest.size() - 8) reject_damaged();
        *part = rest.substr(8, number_at(rest));
        rest.remove_prefix(8 + part->size());
    }
    return checkpoint;
}

}  // namespace swirl
