// What a camera above the dish would see of a run: grey pictures with everything that makes a
// tracker's life hard, and the truth beside them. For tests of `swirl track`, and for whoever wants
// to know the error of a set-up before building it.
//
// x goes right and y down, and the middle of the pixel in column i and row j lies at (i, j). Discs
// are drawn as spheres of their radius:
//
//     brightness = albedo(turned point of the surface) · (ambient + diffuse n·l) + gloss (n·h)^p
//
// with l the lamp's direction and h half way between lamp and line of sight. The texture is a sum
// of plane waves on the unit sphere, so it has no seam, turns with the disc, and rolls if it is
// asked to: a sphere that rolls on the floor at velocity v relative to it turns with ω = ẑ × v / a.
//
// Lens: with q the place of a pixel relative to the middle of the picture in half heights, what is
// seen there lies at q (1 + k |q|²) in an ideal picture: k > 0 is a barrel.
//
// Camera: straight above and very far away, unless a tilt θ or a view angle is given. Its axis goes
// through the middle of the picture; in pixels, with u the way in the plane of the discs' centres
// towards the side where it stands, v across and F the distance (½ height / tan ½ view angle),
//
//     q = (u cos θ, v) / (1 − u sin θ / F)
//
// Spheres are what their lines of sight meet, so they look longer away from the axis and hide each
// other; the rim is a circle `rim_height` above the discs' centres.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "swirl/math/random.hpp"
#include "swirl/physics/snapshot.hpp"
#include "swirl/render/canvas.hpp"
#include "swirl/render/rotation_matrix.hpp"

namespace swirl {

struct CameraSettings {
    Size size{640, 640};
    double scale = 26.0;              // pixels per disc radius
    std::optional<Vec2> centre = {};  // of the swirl, in ideal pixels; the middle otherwise
    std::int64_t frames_per_period = 511;
    std::uint64_t seed = 1;

    // Grey levels from 0 to 255.
    double table = 40.0, floor = 60.0, rim = 130.0, disc = 190.0;
    double ambient = 0.55, diffuse = 0.45, gloss = 110.0, shininess = 40.0;
    double texture = 0.35;    // share by which the albedo varies
    double glare = 0.0;       // a lamp's reflection in front of everything
    double flicker = 0.0;     // share by which the light varies, at random
    double noise = 2.0;       // standard deviation
    double blur = 0.7;        // standard deviation of the lens's spot, in pixels
    double exposure = 0.1;    // share of the time between two pictures
    double distortion = 0.0;  // k
    double tilt = 0.0;        // of the camera's axis, degrees
    double towards = 0.0;     // the side where it stands, degrees in the picture
    double view_angle = 0.0;  // of the picture's height, degrees; 0: from very far away
    double rim_height = 0.0;  // disc radii
    double clutter = 4.0;     // grain of table and floor
    bool rolls = false;
    bool mirrored = false;  // as seen in a mirror, or from below
};

/// Named sets of the above; nothing for any other name.
std::optional<CameraSettings> camera_preset(const std::string& name);
/// Their names, with commas.
std::string camera_presets();

class CameraView {
  public:
    explicit CameraView(const CameraSettings& settings);

    /// The next picture, of the state that its snapshot shows. Rows from the top, a byte a pixel.
    const std::vector<std::uint8_t>& take(const Snapshot& s);

    /// Of the picture just taken. Places as an ideal lens would show them, and as ours does.
    Vec2 ideal(const Vec2& lab) const;
    Vec2 seen(const Vec2& ideal) const;
    /// By how much disc i turned since the last picture: about x (right), y (up), z (to the
    /// camera), in radians.
    const std::array<double, 3>& turned(std::size_t i) const { return turned_[i]; }

  private:
    struct Wave {
        std::array<double, 3> k;
        double phase;
    };

    /// Where a picture without distortion has it, relative to the middle, and what lies there.
    Vec2 undistorted(const Vec2& seen) const;
    Vec2 in_plane(const Vec2& undistorted) const;
    /// Of the line of sight through there: how far it leans for a unit of height.
    Vec2 lean(const Vec2& ideal) const;
    void sort_by_distance(const Snapshot& s);
    void turn_discs(const Snapshot& s);
    void draw_background(const Vec2& container, double radius, std::vector<float>& light) const;
    void draw_disc(const Vec2& centre, double radius, const Rotation& orientation, std::size_t i,
                   std::vector<float>& light) const;
    void blur(std::vector<float>& light) const;

    CameraSettings settings_;
    Vec2 centre_, middle_;
    Vec2 side_;                       // where the camera stands, a unit vector
    double nearness_;                 // 1/F
    std::vector<std::size_t> order_;  // of drawing: whom others may hide first
    Random random_;
    std::vector<float> grain_;
    std::vector<Vec2> places_;  // of every pixel, in ideal pixels
    std::vector<Rotation> orientations_;
    std::vector<std::array<double, 3>> turned_;
    std::vector<double> last_angle_;
    std::vector<std::vector<Wave>> textures_;
    std::vector<float> light_, exposed_;
    std::vector<std::uint8_t> picture_;
};

}  // namespace swirl
