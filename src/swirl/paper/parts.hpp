// What an interrupted call of `swirl paper` has done already: OUT/parts/KEY.json, one file for each
// piece of work. Those of another version of the program do not count, nor those that have been cut
// or changed since.
#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <optional>
#include <string>

namespace swirl {

class PaperParts {
  public:
    /// Makes the folder if it is not there. Throws Failure.
    explicit PaperParts(const std::filesystem::path& out);

    /// The whole part: its "result", and the "seconds" that it took.
    std::optional<nlohmann::ordered_json> recall(const std::string& key) const;
    nlohmann::ordered_json remember(const std::string& key, const nlohmann::ordered_json& result,
                                    double seconds) const;

  private:
    std::filesystem::path file(const std::string& key) const;
    std::filesystem::path folder_;
};

}  // namespace swirl
