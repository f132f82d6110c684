// Results of tasks that are already done: OUT/parts/KEY.json, one file for each task, so that an
// interrupted call can be continued. A result of another version of the program is not used, nor
// one whose file is truncated or was changed.
#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <optional>
#include <string>

namespace swirl {

class ResultStore {
  public:
    /// Creates the folder OUT/parts. Throws Failure.
    explicit ResultStore(const std::filesystem::path& out);

    /// An object with the "result" of the task, and the "seconds" that it took.
    std::optional<nlohmann::ordered_json> find(const std::string& key) const;
    /// Returns the same object as find().
    nlohmann::ordered_json store(const std::string& key, const nlohmann::ordered_json& result,
                                 double seconds) const;

  private:
    std::filesystem::path file(const std::string& key) const;
    std::filesystem::path folder_;
};

}  // namespace swirl
