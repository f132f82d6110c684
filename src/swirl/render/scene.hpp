// The dish and its discs at one instant, drawn in a view.
//
// Spheres whose orientation is known are drawn as balls (ball.hpp). Discs carry an orientation
// mark, the wall carries marks, so that what spins and what does not can be seen. On top lie the
// swirl centre S, the dish's centre C, the point M on the wall farthest from S, and the path of C.
// Over a camera's picture dish and discs are only outlined.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "swirl/physics/snapshot.hpp"
#include "swirl/render/canvas.hpp"
#include "swirl/render/image.hpp"
#include "swirl/render/theme.hpp"
#include "swirl/render/view.hpp"

namespace swirl {

/// What the colour of a disc says.
enum class Coloring : std::uint8_t {
    pinned,  // moves with the wall, or loose (measure/pinned_loose.hpp)
    spin,    // lab-frame spin ω_i, diverging about zero
    speed,   // in the frame that is shown
    slip,    // of spheres on the floor
    none,    // all alike
    id,      // seven hues in turn, to follow one disc with the eye
};

std::optional<Coloring> coloring_named(std::string_view name);

struct SceneStyle {
    Theme theme = dark_theme();
    Coloring coloring = Coloring::none;
    double full_spin = 1.0;   // |ω_i| at the end of the colour scale
    double full_speed = 1.0;  // speed, or slip, at the end of the colour scale
    bool orientation = true;  // marks on the discs
    bool points = true;       // S, C, M
    double point_type = 1.0;  // how large their letters are; 1 is as in a movie
    bool path = true;         // of C
    bool forces = false;      // centrifugal and Coriolis, per disc; M-frame only
    bool angles = false;      // θ at the wall; M-frame only
    /// Lights up the discs' floor around this θ; M-frame only (paper, Fig. 2a).
    std::optional<double> slice = {};
};

/// One instant, and what else is to be seen with it. All optional but `now`.
struct SceneContent {
    const Snapshot& now;
    /// Corners of the closed path of C in the lab frame, S at the origin.
    std::span<const Vec2> path = {};
    /// One per disc: 1 pinned, 0 loose. Empty: not known, all discs have the plain colour.
    std::span<const std::uint8_t> pinned = {};
    /// Earlier instants, oldest first: trails.
    std::span<const Snapshot* const> past = {};
    /// Instants drawn faintly beneath, oldest first: a stroboscopic picture.
    std::span<const Snapshot* const> ghosts = {};
    /// Whole and part turns of the cluster since some beginning, counter-clockwise: an arc round
    /// the dish shows it. Lab frame only.
    std::optional<double> turned = {};
    /// What a camera saw at this instant; drawn beneath, in the M-frame turned with it.
    const Backdrop* backdrop = nullptr;
    /// Names of the discs in `now` and in each instant of `past`, where discs come and go; empty:
    /// they are the same in all, in the same order.
    std::span<const std::int64_t> ids = {};
    std::span<const std::span<const std::int64_t>> past_ids = {};
};

/// Everything, back to front.
void draw_scene(const Canvas& canvas, const View& view, const SceneStyle& style,
                const SceneContent& content);

/// The parts of it, for pictures that are composed otherwise.
void draw_backdrop(const Canvas& canvas, const View& view, const SceneContent& content);
void draw_container(const Canvas& canvas, const View& view, const SceneStyle& style,
                    const Snapshot& now);
void draw_trails(const Canvas& canvas, const View& view, const SceneStyle& style,
                 const SceneContent& content);
void draw_ghosts(const Canvas& canvas, const View& view, const SceneStyle& style,
                 const SceneContent& content);
void draw_discs(const Canvas& canvas, const View& view, const SceneStyle& style,
                const SceneContent& content);
void draw_forces(const Canvas& canvas, const View& view, const SceneStyle& style,
                 const Snapshot& now, std::span<const std::size_t> discs);
void draw_points(const Canvas& canvas, const View& view, const SceneStyle& style,
                 const SceneContent& content);

void draw_turned(const Canvas& canvas, const View& view, const SceneStyle& style,
                 const SceneContent& content);

/// An arrow from `tail` to `tip`, on the page; with a rim, it stands out from anything beneath.
/// Nothing if it is too short to have a head.
void draw_arrow(const Canvas& canvas, Vec2 tail, Vec2 tip, double width, const Color& color,
                const std::optional<Color>& rim = std::nullopt);

}  // namespace swirl
