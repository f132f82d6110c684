// Simulates a camera above the container: grey images with everything that makes tracking
// difficult, and the ground truth. It serves tests of `swirl track`, and estimates of the error of
// a set-up before it is built.
//
// x points right and y down; the centre of the pixel in column i and row j is at (i, j). Discs are
// drawn as spheres of their radius:
//
//     brightness = albedo(rotated point of the surface) · (ambient + diffuse n·l) + gloss (n·h)^p
//
// with l the direction of the light and h half way between light and line of sight. The texture is
// a sum of plane waves on the unit sphere, so it has no seam and rotates with the disc. With
// `rolls`, a sphere that moves at velocity v relative to the floor rotates with ω = ẑ × v / a.
//
// Lens: let q be the position of a pixel relative to the image centre, in units of half the height.
// The point seen there is at q (1 + k |q|²) in an ideal image: k > 0 is a barrel distortion.
//
// Camera: straight above and infinitely far away, unless a tilt θ or a view angle is given. Its
// axis goes through the image centre. In the plane of the discs' centres let u be the distance in
// pixels towards the side of the camera, v the distance across, and F the distance of the camera,
// (½ height)/tan(½ view angle). Then
//
//     q = (u cos θ, v) / (1 − u sin θ / F)
//
// Spheres are where their lines of sight hit them, so they look elongated away from the axis and
// hide each other. The rim is a circle `rim_height` above the discs' centres.
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
    std::optional<Vec2> centre = {};  // of the swirl, in ideal pixels [image centre]
    std::int64_t frames_per_period = 511;
    std::uint64_t seed = 1;

    // Grey levels from 0 to 255.
    double table = 40.0, floor = 60.0, rim = 130.0, disc = 190.0;
    double ambient = 0.55, diffuse = 0.45, gloss = 110.0, shininess = 40.0;
    /// Direction to the light: x points right, y up, z to the camera. Length 1.
    std::array<double, 3> light{-0.35, 0.35, 0.869};
    double texture = 0.35;    // relative variation of the albedo
    double glare = 0.0;       // of a reflection in front of everything
    double flicker = 0.0;     // relative standard deviation of the illumination
    double noise = 2.0;       // standard deviation
    double blur = 0.7;        // standard deviation of the point spread, in pixels
    double exposure = 0.1;    // in units of the time between two frames
    double distortion = 0.0;  // k
    double tilt = 0.0;        // of the camera's axis, degrees
    double towards = 0.0;     // side of the camera, degrees in the image
    double view_angle = 0.0;  // of the image's height, degrees; 0: infinitely far away
    double rim_height = 0.0;  // disc radii
    double clutter = 4.0;     // standard deviation of the grain of table and floor
    bool rolls = false;
    bool mirrored = false;  // as seen in a mirror, or from below

    // Faults of cheap cameras. Rows are read one after the other, or in two fields.
    double rolling_shutter = 0.0;  // time between the first and the last row, frame intervals
    bool interlaced = false;       // odd rows half a frame interval after even rows
    double auto_exposure = 0.0;    // relative amplitude of a slow variation of the brightness
    // Other discs and floors.
    double floor_pattern = 0.0;             // of squares on the floor, grey levels; moves with it
    double disc_variation = 0.0;            // relative, from disc to disc, as colours have in grey
    std::optional<double> other_disc = {};  // grey level of every second disc
    double shadow = 0.0;                    // of a shadow that moves over the table, grey levels
    double transparency = 0.0;  // of glass: the share of the floor seen through a sphere
    bool flat = false;          // coins: no shading, a bright edge
    // A dark hand covers a part of the container in the first and the last frames.
    std::int64_t hand_frames = 0, frames = 0;  // frames with a hand at either end; all frames
};

/// Direction to a light that comes from the side `from`, counter-clockwise from the right, at a
/// height of `elevation` above the plane of the discs. Degrees.
std::array<double, 3> light_direction(double from, double elevation);

/// Settings by name; nothing for any other name.
std::optional<CameraSettings> camera_preset(const std::string& name);
/// Their names.
std::vector<std::string> camera_presets();

class CameraView {
  public:
    explicit CameraView(const CameraSettings& settings);

    /// Times of the states that a frame shows, in frame intervals after its own, ascending. The one
    /// in the middle is 0.
    std::vector<double> delays() const;
    /// The next frame, of these states: rows from the top, one byte per pixel.
    const std::vector<std::uint8_t>& render(const std::vector<Snapshot>& states);

    /// The pixel position that an ideal lens shows, and the one that this lens shows.
    Vec2 ideal(const Vec2& lab) const;
    Vec2 seen(const Vec2& ideal) const;
    /// Rotation of disc i since the previous frame in radians, about x (right), y (up) and z (to
    /// the camera).
    const std::array<double, 3>& rotation(std::size_t i) const { return rotation_[i]; }

  private:
    struct Wave {
        std::array<double, 3> k;
        double phase;
    };

    /// The position without distortion, relative to the image centre, and the point of the discs'
    /// plane that is seen there.
    Vec2 undistorted(const Vec2& seen) const;
    Vec2 in_plane(const Vec2& undistorted) const;
    /// Horizontal displacement of the line of sight through this point, per unit of height.
    Vec2 lean(const Vec2& ideal) const;
    void sort_by_distance(const Snapshot& s);
    void rotate_discs(const Snapshot& s);
    /// Of positions in all states, that at the time of a row.
    Vec2 at_row(const std::vector<Vec2>& way, int row) const;
    double floor_level(const Vec2& from_container) const;
    void draw_background(const std::vector<Vec2>& container, double radius,
                         std::vector<float>& light) const;
    void draw_disc(const std::vector<Vec2>& way, double radius, const Rotation& orientation,
                   std::size_t i, std::vector<float>& light) const;
    void draw_hand();
    void draw_shadow();
    double brightness();
    void blur(std::vector<float>& light) const;

    CameraSettings settings_;
    Vec2 centre_, middle_;
    Vec2 side_;        // side of the camera, a unit vector
    double nearness_;  // 1/F
    Vec2 lean_at_middle_;
    double lean_per_pixel_;
    std::vector<std::size_t> order_;  // of drawing: discs that others may hide come first
    Random random_;
    std::vector<float> grain_;
    std::vector<Vec2> positions_;  // of every pixel, in ideal pixels
    std::vector<Rotation> orientations_;
    std::vector<std::array<double, 3>> rotation_;
    std::vector<double> last_angle_;
    std::vector<std::vector<Wave>> textures_;
    std::vector<float> light_, exposed_;
    std::int64_t frame_ = 0;  // number of the next frame
    std::vector<std::uint8_t> image_;
};

}  // namespace swirl
