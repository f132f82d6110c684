// Everything that determines a trajectory: the discs at the beginning, the path of the container,
// and the surfaces.
#pragma once

#include <memory>
#include <vector>

#include "swirl/math/by_name.hpp"
#include "swirl/physics/contact.hpp"
#include "swirl/physics/container_path.hpp"
#include "swirl/physics/disc.hpp"
#include "swirl/physics/floor.hpp"

namespace swirl {

struct EventLoops;
struct Impact;

/// A contact law of your own (contact_law.hpp) with the event loops that apply it. own_law() makes
/// it (engine/own_law.hpp). Without one, the coefficients are those of the surfaces.
struct OwnLaw {
    std::shared_ptr<const void> law = {};  // the object that `surface_of` and the loops read
    Surface (*surface_of)(const void* law, const Surface& surface, const Impact& impact) = nullptr;
    const EventLoops* loops = nullptr;

    explicit operator bool() const { return loops != nullptr; }
};

/// Disc times count from the start of the first period.
struct InitialState {
    [[no_unique_address]] ByName by_name{};
    std::vector<Disc> discs = {};
    ContainerPath path = {};
    double container_radius = 0.0;
    Surface disc_surface{}, wall_surface{};
    Shape shape = Shape::disc;
    Floor floor{};  // used by spheres and coins
    OwnLaw law = {};
};

/// Moves all discs by the same vector. Without a shift, no bit changes.
inline void shift_discs(std::vector<Disc>& discs, const Vec2& shift) {
    if (shift.x == 0.0 && shift.y == 0.0) return;
    for (Disc& disc : discs) disc.position = disc.position + shift;
}

}  // namespace swirl
