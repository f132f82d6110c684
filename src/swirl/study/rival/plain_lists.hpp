// The rival of many discs in `swirl bench`: event-driven dynamics with a list of neighbours for
// every disc and a calendar of events, as hard-sphere codes have it (Smallenburg, Eur. Phys. J. E
// 45, 22 (2022), doi:10.1140/epje/s10189-022-00180-8; the calendar: Paul, J. Comput. Phys. 221, 615
// (2007)), one disc after the other. As fast as such a code is made: what a prediction asks of a
// disc is one cache line, the rest stands apart; large arrays are on huge pages; what the next
// events need is fetched early; of the wall and the edge of its circle a √ and a ÷ are taken only
// where they may come first.
//
// A list holds whoever may be met while both discs stay within `skin` of where their lists were
// made, their homes; who leaves that circle has its own list renewed, and nobody else's. Every disc
// has one pending event; that a partner has collided in the meantime is found when the event is
// due. Homes rest, in a dish that swirls, too.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "swirl/physics/event.hpp"
#include "swirl/physics/initial_state.hpp"
#include "swirl/study/rival/huge_pages.hpp"
#include "swirl/study/rival/list_search.hpp"

namespace swirl {

class PlainLists {
  public:
    /// Of discs, not of spheres.
    PlainLists(const InitialState& initial, double skin, Width width = Width::best);

    /// Executes the event that comes first.
    Event step();

    Disc disc(std::size_t i) const;
    /// So far, for every event.
    std::uint64_t renewed_lists() const { return renewed_lists_; }

  private:
    using Number = std::uint32_t;
    static constexpr Number nobody = 0xffffffffu;
    static constexpr Number own_list = 0xfffffff0u;  // in the place of a partner: leaves its circle

    struct Cold {
        double angle, spin, mass, inertia, inverse_mass, inverse_inertia;
    };
    /// And the links of the calendar.
    struct alignas(32) Pending {
        double time;
        Number partner;  // the disc itself: the wall
        Number changes;  // of the partner, when it was predicted
        Number next, previous, bin;
    };
    struct alignas(32) Home {
        Vec2 place;
        double since;  // at which time it was there
        Number next, previous;
    };

    const Segment& segment() const { return path_.segments[segment_]; }
    Event collision(Number i, Number partner, double time);
    void move_to(Number i, double time);
    Event end_segment();
    void begin_segment();
    void begin_swirl();

    void predict(Number i);
    void reschedule(Number i);

    void renew_list(Number i, double time);
    void look_out_for_wall(Number i);
    void clear_list(Number i);
    void forget(Number i, Number j);
    void note(Number i, Number j);
    void widen_lists();
    std::size_t cell_at(const Vec2& place) const;
    void leave_cell(Number i);
    void enter_cell(Number i);

    void open_calendar();
    std::size_t bin_at(double time) const;
    void leave_bin(Number i);
    void enter_bin(Number i);
    /// Nobody, if nothing comes before the end of the leg.
    Number first_in_calendar();
    bool comes_before(Number i, Number j) const;
    void fetch_what_comes() const;

    ListSearch first_on_list_;
    ContainerPath path_;
    double container_radius_;
    Surface disc_surface_, wall_surface_;
    Number size_;
    std::size_t segment_ = 0;
    std::int64_t periods_ = 0;
    std::uint64_t renewed_lists_ = 0;

    double skin_, largest_radius_;
    double farthest_centre_;  // of the container, from the swirl centre

    OnHugePages<ListedDisc> hot_;
    OnHugePages<Cold> cold_;
    OnHugePages<Pending> pending_;
    OnHugePages<Home> homes_of_;
    std::size_t room_ = 16;  // of each list
    OnHugePages<Number> lists_;
    double half_width_, cells_per_length_;
    std::size_t cells_across_;
    OnHugePages<Number> first_in_cell_;

    double bin_width_ = 0.0, bins_per_time_ = 0.0, calendar_begin_ = 0.0;
    std::size_t now_ = 0;  // the bin that is being emptied
    OnHugePages<Number> first_in_bin_;
};

}  // namespace swirl
