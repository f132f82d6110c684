#include "swirl/io/h5md.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdint>
#include <map>
#include <vector>

#include "swirl/io/file_error.hpp"

namespace swirl::h5md {

void write_format(Hdf5File& file) {
    file.set_attribute(parameters, "format", std::vector<std::int64_t>{recording_format});
}

void require_known_format(const Hdf5File& file, const std::filesystem::path& path) {
    if (!file.has(parameters) || !file.has_attribute(parameters, "format")) return;
    const auto format = file.integers_attribute(parameters, "format");
    if (format == std::vector<std::int64_t>{recording_format}) return;
    const std::string by = parameters + "/version";
    throw FileError(fmt::format(
        "'{}' has format {} of swirl {}, but this program reads format {}.\nhint: use the program "
        "that wrote it, or a newer one.",
        path.string(), fmt::join(format, ","), file.has(by) ? file.read_text(by) : "?",
        recording_format));
}

void create_head(Hdf5File& file, const std::string& group) {
    file.create_group("/h5md");
    file.set_attribute("/h5md", "version", std::vector<std::int64_t>{1, 1});
    file.create_group("/h5md/author");
    file.set_attribute("/h5md/author", "name", std::string("unknown"));
    file.create_group("/h5md/creator");
    file.set_attribute("/h5md/creator", "name", std::string("swirl"));
    file.create_group("/particles");
    file.create_group(group);
    file.create_group(group + "/box");
    file.set_attribute(group + "/box", "dimension", std::vector<std::int64_t>{3});
    file.set_attribute(group + "/box", "boundary",
                       std::vector<std::string>{"none", "none", "none"});
}

void create_parameters(Hdf5File& file,
                       const std::vector<std::pair<std::string, std::string>>& provenance) {
    file.create_group(parameters);
    write_format(file);
    for (const auto& [name, text] : provenance) {
        file.write(parameters + "/" + name, text);
        if (name == "version") file.set_attribute("/h5md/creator", "version", text);
    }
    if (!file.has_attribute("/h5md/creator", "version"))
        file.set_attribute("/h5md/creator", "version", std::string("unknown"));
}

std::vector<std::int64_t> species_of(const std::vector<double>& radius,
                                     const std::vector<double>& mass) {
    std::map<std::pair<double, double>, std::int64_t> numbers;
    std::vector<std::int64_t> species;
    for (std::size_t i = 0; i < radius.size(); ++i)
        species.push_back(
            numbers.try_emplace({radius[i], mass[i]}, std::int64_t(numbers.size())).first->second);
    return species;
}

void link_times(Hdf5File& file, const std::string& from, const std::string& group) {
    file.link(from + "/step", group + "/step");
    file.link(from + "/time", group + "/time");
}

}  // namespace swirl::h5md
