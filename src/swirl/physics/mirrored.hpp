// The mirror image at the x axis. A clockwise dish is measured in its mirror image, which runs
// counter-clockwise, so every rotation is positive with the swirl and the M-frame is the same one.
//
// The mirror plane contains x and z. Vectors change the sign of y; axial vectors (spins, the axes
// of orientations) that of x and z. The law's tangent (n_y, −n_x) is mirrored to minus the tangent
// of the mirrored normal, so tangential impulses change their sign.
#pragma once

#include <cstddef>

#include "swirl/math/vec2.hpp"
#include "swirl/physics/event.hpp"
#include "swirl/physics/orientation.hpp"
#include "swirl/physics/snapshot.hpp"

namespace swirl {

inline void mirror(Vec2& v) { v.y = -v.y; }

inline void mirror(Snapshot& s) {
    mirror(s.container_centre);
    mirror(s.container_velocity);
    for (auto* column : {&s.y, &s.vy, &s.angle, &s.spin, &s.spin_x, &s.ay})
        for (double& value : *column) value = -value;
    for (Quaternion& q : s.turned) q = {q.w, -q.x, q.y, -q.z};
}

inline Snapshot mirrored(Snapshot s) {
    mirror(s);
    return s;
}

inline Event mirrored(Event event) {
    mirror(event.normal);
    event.impulse.tangential = -event.impulse.tangential;
    return event;
}

}  // namespace swirl
