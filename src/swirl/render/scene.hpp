// Draws the container and its discs at one instant.
//
// Spheres of known orientation are drawn as balls (ball.hpp). Discs carry an orientation mark and
// the wall carries marks, so that rotation is visible. In the lab frame, an arrow shows the
// direction of the swirl. On top are the path of C and, if they are asked for, the swirl centre S,
// the container's centre C, and the point M on the wall farthest from S. Over a camera image,
// container and discs are outlines only.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "swirl/physics/snapshot.hpp"
#include "swirl/render/canvas.hpp"
#include "swirl/render/image.hpp"
#include "swirl/render/theme.hpp"
#include "swirl/render/view.hpp"

namespace swirl {

/// The quantity that a disc's colour shows.
enum class Coloring : std::uint8_t {
    sector,  // sector of the cluster in which the disc was at the start
    pinned,  // pinned or loose (measure/pinned_loose.hpp)
    spin,    // lab-frame spin ω_i, diverging about zero
    speed,   // speed in the frame that is shown
    slip,    // slip of spheres against the floor
    none,    // one colour for all
    id,      // seven hues in turn, to follow a disc by eye
};

inline constexpr std::pair<std::string_view, Coloring> colorings[] = {
    {"sector", Coloring::sector}, {"pinned", Coloring::pinned}, {"spin", Coloring::spin},
    {"speed", Coloring::speed},   {"slip", Coloring::slip},     {"none", Coloring::none},
    {"id", Coloring::id}};

/// The number of turns is 0.00 below it: nothing has turned, so there is no arc, sign or colour.
/// The page has a copy (tests/render/look_test.cpp).
inline constexpr double least_turns = 0.005;

struct SceneStyle {
    Theme theme = dark_theme();
    Coloring coloring = Coloring::none;
    double full_spin = 1.0;   // |ω_i| at the end of the colour scale
    double full_speed = 1.0;  // speed or slip at the end of the colour scale
    bool orientation = true;  // marks on the discs
    bool points = true;       // S, C, M
    double point_size = 1.0;  // size of the letters S, C, M relative to that in a movie
    bool path = true;         // path of C
    bool swirl = false;       // an arrow in the direction of the swirl; lab frame only
    double swirl_size = 1.0;  // the size of that arrow
    bool forces = false;      // centrifugal and Coriolis force on each disc; M-frame only
    bool angles = false;      // θ at the wall; M-frame only
    /// Highlights the slice of the floor around this θ; M-frame only (paper, Fig. 2a).
    std::optional<double> slice = {};
};

/// One instant and what is drawn with it. Everything but `now` is optional.
struct SceneContent {
    const Snapshot& now;
    /// Vertices of the closed path of C in the lab frame. S is the origin.
    std::span<const Vec2> path = {};
    /// For each disc 1 (pinned) or 0 (loose). Empty if that is unknown.
    std::span<const std::uint8_t> pinned = {};
    /// For each disc its index in sector_colors. Empty if that is unknown.
    std::span<const std::uint8_t> sectors = {};
    /// Earlier instants for trails, oldest first.
    std::span<const Snapshot* const> past = {};
    /// Earlier instants drawn faintly beneath (a stroboscopic image), oldest first.
    std::span<const Snapshot* const> ghosts = {};
    /// Turns of the cluster since the start, counter-clockwise: drawn as an arc around the
    /// container. Lab frame only.
    std::optional<double> turns = {};
    /// The camera image of this instant. It is drawn beneath, and turned in the M-frame.
    const Backdrop* backdrop = nullptr;
    /// IDs of the discs in `now` and in each instant of `past`, ascending. Empty if all instants
    /// have the same discs in the same order.
    std::span<const std::int64_t> ids = {};
    std::span<const std::span<const std::int64_t>> past_ids = {};

    bool clockwise = false;  // the swirl

    /// Positive if the cluster turned with the swirl, 0 without turns.
    double turns_with_swirl() const {
        const double counter_clockwise = turns.value_or(0.0);
        return clockwise ? -counter_clockwise : counter_clockwise;
    }
};

/// Draws everything, back to front.
void draw_scene(const Canvas& canvas, const View& view, const SceneStyle& style,
                const SceneContent& content);

/// Parts of the scene, for drawings that are composed differently.
void draw_container(const Canvas& canvas, const View& view, const SceneStyle& style,
                    const Snapshot& now);
void draw_points(const Canvas& canvas, const View& view, const SceneStyle& style,
                 const SceneContent& content);

/// An arrow from `tail` to `tip` in pixels. A `rim` sets it off from what is beneath. Draws
/// nothing if the arrow is too short for its head.
void draw_arrow(const Canvas& canvas, Vec2 tail, Vec2 tip, double width, const Color& color,
                const std::optional<Color>& rim = std::nullopt);

}  // namespace swirl
