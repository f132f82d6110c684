#include "swirl/render/theme.hpp"

namespace swirl {

std::optional<Theme> theme_named(std::string_view name) {
    if (name == "dark") return dark_theme();
    if (name == "light") return light_theme();
    return std::nullopt;
}

}  // namespace swirl
