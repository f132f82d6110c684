#include "track/experiment/result_store.hpp"

#include <fmt/format.h>

#include <system_error>

#include "swirl/io/atomic_file.hpp"
#include "swirl/io/checksum.hpp"
#include "swirl/io/optional_file.hpp"
#include "swirl/run/failure.hpp"
#include "swirl/run/parse_json.hpp"
#include "swirl/run/version.hpp"

namespace swirl {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

std::string checksum_of(const Json& stored) {
    return fmt::format("{:016x}", checksum(stored["result"].dump() + stored["seconds"].dump()));
}

}  // namespace

ResultStore::ResultStore(const fs::path& out) : folder_(out / "parts") {
    std::error_code error;
    fs::create_directories(folder_, error);
    if (error)
        throw Failure(fmt::format("the folder '{}' cannot be created: {}.", folder_.string(),
                                  error.message()));
}

std::optional<Json> ResultStore::find(const std::string& key) const {
    if (key.empty()) return {};
    const std::optional<std::string> content = read_optional_file(file(key));
    if (!content) return {};
    const Json stored = parse_json(*content);
    const auto has = [&](const char* name, const std::string& text) {
        return stored.contains(name) && stored[name] == text;
    };
    if (!stored.is_object() || !has("key", key) || !has("version", version()) ||
        !stored.contains("result") || !stored.contains("seconds") ||
        !stored["seconds"].is_number() || !has("checksum", checksum_of(stored)))
        return {};
    return stored;
}

Json ResultStore::store(const std::string& key, const Json& result, double seconds) const {
    Json stored{{"key", key}, {"version", version()}, {"seconds", seconds}, {"result", result}};
    stored["checksum"] = checksum_of(stored);
    write_file_atomically(file(key), stored.dump() + "\n");
    return stored;
}

fs::path ResultStore::file(const std::string& key) const { return folder_ / (key + ".json"); }

}  // namespace swirl
