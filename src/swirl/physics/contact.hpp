// A contact, without the law: how two surfaces meet, and what they give each other. The law itself
// is collision_law.hpp; whoever only states the surfaces or reads an event does not need it.
#pragma once

namespace swirl {

/// How two surfaces meet: friction μ ≥ 0, normal restitution e ∈ [0, 1], tangential restitution
/// β ∈ [0, 1], and the duration t_c of a contact, which matters only for e < 1.
struct Surface {
    double mu = 1.0;
    double restitution = 1.0;
    double tangential_restitution = 0.0;
    double contact_duration = 0.0;
    double vertical_friction = 1.0;  // κ ∈ [0, 1], of spheres: 0 rubs horizontally alone
};

/// Impulses on body j, along n and along r; body i receives the opposite.
struct Impulse {
    double normal, tangential;
    bool sticks;            // friction sufficed to stop the slip
    double vertical = 0.0;  // of spheres: along z; for them `tangential` is the horizontal part
};

}  // namespace swirl
