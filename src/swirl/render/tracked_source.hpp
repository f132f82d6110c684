// Tracks as a source of images and movies (render/frame_source.hpp), also over the camera's images.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "swirl/io/tracks.hpp"
#include "swirl/math/vec2.hpp"
#include "swirl/render/frame_source.hpp"
#include "swirl/render/image.hpp"

namespace swirl {

/// The motion of a camera, which was removed from tracks: in frame `first` + k, position p is seen
/// at origin + (a p.x - b p.y, b p.x + a p.y).
struct ImageMotion {
    struct Pose {
        Vec2 origin{0.0, 0.0};
        double a = 1.0, b = 0.0;
    };
    std::int64_t first = 0;
    std::vector<Pose> poses = {};  // empty: the camera was steady

    /// The backdrop of this frame; `backdrop` is that of a steady camera.
    Backdrop applied(Backdrop backdrop, std::int64_t frame) const;
};

/// Tracks of a camera or of another program. If discs come and go, or over camera images, the
/// nearest frame is shown without interpolation. `images` is a name as in numbered_frames.hpp, in
/// which frame 0 has number `first_image`; empty: no images. Throws Failure.
FrameSource tracked(Tracks tracks, const TrackScale& scale, const std::string& caption,
                    const std::string& images = "", std::int64_t first_image = 0,
                    const ImageMotion& motion = {});

}  // namespace swirl
