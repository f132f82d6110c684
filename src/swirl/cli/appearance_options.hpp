// The options for the appearance of an image or a movie.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "swirl/cli/options.hpp"

namespace swirl {

struct Appearance;
struct Size;

/// Options as given; appearance() parses them.
struct AppearanceTexts {
    std::string view, color = "sector", theme = "light", title, size;
    std::optional<double> trail_length;
    bool trails = false, forces = false, plot = false, turned = false, angles = false, bare = false,
         captions = false;
};

std::shared_ptr<AppearanceTexts> add_appearance_options(Subcommand& subcommand);

/// Throws UsageError. `otherwise` is the size if none was given.
Appearance appearance(const AppearanceTexts& texts, Size otherwise);

}  // namespace swirl
