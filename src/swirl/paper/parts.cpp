#include "swirl/paper/parts.hpp"

#include <fmt/format.h>

#include <system_error>

#include "swirl/io/atomic_file.hpp"
#include "swirl/io/checksum.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/version.hpp"

namespace swirl {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

/// Of what the figures are drawn from, and of its time.
std::string checksum_of(const Json& part) {
    return fmt::format("{:016x}", checksum(part["result"].dump() + part["seconds"].dump()));
}

}  // namespace

PaperParts::PaperParts(const fs::path& out) : folder_(out / "parts") {
    std::error_code error;
    fs::create_directories(folder_, error);
    if (error)
        throw Failure(
            fmt::format("The folder '{}' cannot be made: {}.", folder_.string(), error.message()));
    remove_leftovers(out);
    remove_leftovers(folder_);
}

std::optional<Json> PaperParts::recall(const std::string& key) const {
    if (key.empty() || !fs::exists(file(key))) return {};
    const Json part = Json::parse(read_whole_file(file(key)), nullptr, false);
    const auto says = [&](const char* name, const std::string& text) {
        return part.contains(name) && part[name] == text;
    };
    if (!part.is_object() || !says("key", key) || !says("version", version()) ||
        !part.contains("result") || !part.contains("seconds") || !part["seconds"].is_number() ||
        !says("checksum", checksum_of(part)))
        return {};
    return part;
}

Json PaperParts::remember(const std::string& key, const Json& result, double seconds) const {
    Json part{{"key", key}, {"version", version()}, {"seconds", seconds}, {"result", result}};
    part["checksum"] = checksum_of(part);
    write_file_atomically(file(key), part.dump() + "\n");
    return part;
}

fs::path PaperParts::file(const std::string& key) const { return folder_ / (key + ".json"); }

}  // namespace swirl
