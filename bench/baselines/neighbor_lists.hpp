// The baseline for many discs: event-driven dynamics with neighbour lists and a calendar of events,
// as in other hard-sphere codes (Smallenburg, Eur. Phys. J. E 45, 22 (2022),
// doi:10.1140/epje/s10189-022-00180-8; the calendar: Paul, J. Comput. Phys. 221, 615 (2007)). It
// predicts one disc after the other and is optimised: a prediction reads one cache line of each
// disc; large arrays are on huge pages; the data of the next events are prefetched; contact times
// with the wall and with the edge of the disc's circle are computed only where they may come first.
//
// The list of a disc holds every disc that it can touch while both stay within `skin` of their
// homes (their positions when their lists were made). A disc that leaves this circle gets a new
// list; the others keep theirs. Every disc has one pending event. An event whose partner has
// collided in the meantime is recognised when it is due. Homes are at rest, also in a swirled
// container.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "baselines/huge_pages.hpp"
#include "baselines/list_search.hpp"
#include "swirl/physics/event.hpp"
#include "swirl/physics/initial_state.hpp"

namespace swirl {

class NeighborListBaseline {
  public:
    /// For discs only; spheres are not supported.
    NeighborListBaseline(const InitialState& initial, double skin, Width width = Width::best);

    /// Executes the event that comes first.
    Event step();

    Disc disc(std::size_t i) const;
    /// Number of lists renewed so far.
    std::uint64_t renewed_lists() const { return renewed_lists_; }

  private:
    using Number = std::uint32_t;
    static constexpr Number no_disc = 0xffffffffu;
    static constexpr Number own_list = 0xfffffff0u;  // instead of a partner: leaves its circle

    struct Cold {
        double angle, spin, mass, inertia, inverse_mass, inverse_inertia;
    };
    /// The pending event of a disc, with the links of the calendar.
    struct alignas(32) Pending {
        double time;
        Number partner;  // the disc itself: the wall
        Number changes;  // the partner's, when it was predicted
        Number next, previous, bin;
    };
    struct alignas(32) Home {
        Vec2 position;
        double since;  // time at which the disc was there
        Number next, previous;
    };

    const Segment& segment() const { return path_.segments[segment_]; }
    Event collision(Number i, Number partner, double time);
    void move_to(Number i, double time);
    Event end_segment();
    void begin_segment();
    void begin_period();

    void predict(Number i);
    void reschedule(Number i);

    void renew_list(Number i, double time);
    void update_at_wall(Number i);
    void clear_list(Number i);
    void remove_from_list(Number i, Number j);
    void add_to_list(Number i, Number j);
    void widen_lists();
    std::size_t cell_at(const Vec2& position) const;
    void leave_cell(Number i);
    void enter_cell(Number i);

    void open_calendar();
    std::size_t bin_at(double time) const;
    void leave_bin(Number i);
    void enter_bin(Number i);
    /// `no_disc` if no event comes before the end of the segment.
    Number first_in_calendar();
    bool comes_before(Number i, Number j) const;
    void prefetch_next_events() const;

    ListSearch first_on_list_;
    ContainerPath path_;
    double container_radius_;
    Surface disc_surface_, wall_surface_;
    Number size_;
    std::size_t segment_ = 0;
    std::int64_t periods_ = 0;
    std::uint64_t renewed_lists_ = 0;

    double skin_, largest_radius_;
    double farthest_centre_;  // largest distance of the container from the swirl centre

    OnHugePages<ListedDisc> hot_;
    OnHugePages<Cold> cold_;
    OnHugePages<Pending> pending_;
    OnHugePages<Home> homes_of_;
    std::size_t capacity_ = 16;  // capacity of each list
    OnHugePages<Number> lists_;
    double half_width_, cells_per_length_;
    std::size_t cells_across_;
    OnHugePages<Number> first_in_cell_;

    double bin_width_ = 0.0, bins_per_time_ = 0.0, calendar_begin_ = 0.0;
    std::size_t now_ = 0;  // the bin that is being emptied
    OnHugePages<Number> first_in_bin_;
};

}  // namespace swirl
