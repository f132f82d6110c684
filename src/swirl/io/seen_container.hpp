// Where the container is in the image, by the calibration of tracks.
#pragma once

#include "swirl/io/tracks.hpp"
#include "swirl/math/unit_circle.hpp"

namespace swirl {

/// The container's centre in the image, and its velocity per unit of time.
class SeenContainer {
  public:
    SeenContainer(const TrackScale& scale, bool y_down)
        : scale_(scale), up_(y_down ? -1.0 : 1.0), rotation_(scale.clockwise ? -1.0 : 1.0) {}
    Vec2 position(double time) const {
        const Vec2 d = direction(time);
        return scale_.swirl_centre + radius() * Vec2{d.x, up_ * d.y};
    }
    Vec2 velocity(double time) const {
        const Vec2 d = perpendicular(direction(time));
        return (rotation_ * radius() * 2.0 * pi / scale_.period) * Vec2{d.x, up_ * d.y};
    }

  private:
    double radius() const { return scale_.amplitude * scale_.pixels_per_radius; }
    Vec2 direction(double time) const {
        return unit_circle(scale_.phase / (2.0 * pi) + rotation_ * time / scale_.period);
    }
    const TrackScale& scale_;
    double up_, rotation_;  // signs: of y, and of the direction of rotation
};

}  // namespace swirl
