// The reference implementation: the paper's method (SI, "Finding the next event") in its simplest
// form. It computes the times of all possible events, takes the earliest and executes it, with one
// particle at a time and no memory of earlier predictions. The engine must agree with it bitwise.
// reference_bodies.hpp has the contact times and the collisions.
#pragma once

#include <cstddef>
#include <cstdint>

#include "swirl/engine/pending_event.hpp"
#include "swirl/engine/reference_bodies.hpp"
#include "swirl/physics/event.hpp"
#include "swirl/physics/initial_state.hpp"

namespace swirl {

class Reference {
  public:
    explicit Reference(const InitialState& initial)
        : path_(initial.path), bodies_(initial), size_(bodies_.size()) {}

    /// Executes and returns the next event; its normal and overlap stay empty.
    Event step() { return apply(first_of_all()); }

    PendingEvent first_of_all() const {
        PendingEvent first{never, size_, size_};
        const auto consider = [&](const PendingEvent& event) {
            if (precedes(event, first)) first = event;
        };
        for (std::uint32_t i = 0; i < size_; ++i) {
            consider({bodies_.wall_time(i, segment()), i, i});
            consider({bodies_.begins_to_roll(i), i, the_floor});
            for (std::uint32_t j = i + 1; j < size_; ++j)
                consider({bodies_.contact_time(i, j), i, j});
        }
        return segment().end <= first.time ? PendingEvent{segment().end, size_, size_} : first;
    }

    Event apply(const PendingEvent& event) {
        const auto [t, i, j] = event;
        if (i == size_) return end_segment();
        if (j == the_floor)
            return event_of(bodies_.begin_to_roll(i), EventKind::begins_to_roll, i, i);
        if (event.is_with_wall())
            return event_of(t, EventKind::disc_wall, i, i,
                            bodies_.collide_with_wall(i, t, segment()));
        return event_of(t, EventKind::disc_disc, i, j, bodies_.collide_pair(i, j, t, segment()));
    }

    /// Simulation::change_surroundings().
    void change_surroundings(InitialState scene) {
        scene.discs = bodies_.discs();
        shift_discs(scene.discs, scene.path.segments.front().start - path_.segments.front().start);
        bodies_ = ReferenceBodies(scene);
        path_ = scene.path;
    }

    const Disc& disc(std::size_t i) const { return bodies_.disc(i); }
    const Segment& segment() const { return path_.segments[segment_]; }

  private:
    Event event_of(double clock, EventKind kind, std::uint32_t i, std::uint32_t j,
                   const Impulse& impulse = {}) const {
        return {.periods = periods_,
                .clock = clock,
                .kind = kind,
                .i = i,
                .j = j,
                .normal = {},
                .impulse = impulse,
                .overlap = 0.0};
    }
    Event end_segment() {
        const Event event = event_of(segment().end, EventKind::path_vertex, 0, 0);
        segment_ = (segment_ + 1) % path_.segments.size();
        if (segment_ == 0) ++periods_;
        bodies_.end_segment(event.clock, segment(), segment_ == 0);
        return event;
    }

    ContainerPath path_;
    ReferenceBodies bodies_;
    std::uint32_t size_;
    std::size_t segment_ = 0;
    std::int64_t periods_ = 0;
};

}  // namespace swirl
