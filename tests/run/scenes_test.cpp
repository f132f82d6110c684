// The scenes of tests/scenes.json, which the tests of the command line, of the Python module and of
// the page run as well: the engine equals the reference, for every vector width.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "engine/same_trajectory.hpp"
#include "swirl/run/config.hpp"

namespace swirl {
namespace {

using nlohmann::json;

/// The text of a parameter; a list is one value with colons.
std::string text_of(const json& value) {
    if (value.is_string()) return value.get<std::string>();
    if (!value.is_array()) return value.dump();
    std::string text;
    for (const json& part : value) text += (text.empty() ? "" : ":") + part.dump();
    return text;
}

TEST(Scenes, EqualTheReferenceForEveryWidth) {
    std::ifstream file(SWIRL_SOURCE_DIR "/tests/scenes.json");
    for (const json& scene : json::parse(file)) {
        ParameterTexts texts;
        for (const auto& [name, value] : scene.items()) texts[name] = text_of(value);
        SCOPED_TRACE(scene.dump());
        expect_same_for_every_width(make_initial_state(resolve(texts)), 400, tuning());
    }
}

}  // namespace
}  // namespace swirl
