// The rival of large gases in `swirl bench`: event-driven dynamics with a list of neighbours for
// every disc and a calendar of events, as hard-sphere codes have it (Smallenburg, Eur. Phys. J. E
// 45, 22 (2022), doi:10.1140/epje/s10189-022-00180-8; the calendar: Paul, J. Comput. Phys. 221, 615
// (2007)). Written plainly, one disc after the other; places and velocities stand together and
// apart from the rest.
//
// A list holds whoever may be met while both discs stay within `skin_` of where their lists were
// made; who leaves that circle has its own list renewed, and nobody else's. Every disc has one
// pending event; that a partner has collided in the meantime is found when the event is due. Only
// for discs of one size in a dish at rest.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "swirl/simulation/reference.hpp"

namespace swirl {

class PlainLists {
  public:
    /// Two bodies are on each other's lists while their centres are closer than `reach` diameters.
    PlainLists(const InitialState& initial, double reach);

    /// Executes the event that comes first.
    Event step();

    const Disc& disc(std::size_t i) const { return discs_.disc(i); }

  private:
    using Number = std::uint32_t;
    static constexpr Number nobody = 0xffffffffu;
    static constexpr Number own_list = 0xfffffff0u;  // in the place of a partner: leaves its circle

    struct Expected {
        double time;
        Number partner;  // the disc itself: the wall
        Number changes;  // of the partner, when it was predicted
    };

    void begin_swirl();
    void predict(Number i);
    void take_over(Number i);
    void renew_list(Number i, const Vec2& centre);
    void forget(Number i, Number j);
    void note(Number i, Number j);
    void widen_lists();
    std::size_t cell_at(const Vec2& place) const;
    void leave_cell(Number i);
    void enter_cell(Number i);

    std::size_t bin_at(double time) const;
    void leave_bin(Number i);
    void enter_bin(Number i);
    /// Nobody, if nothing comes before the end of the leg.
    Number first_in_calendar();
    bool comes_before(Number i, Number j) const;

    Reference discs_;  // executes events
    Number size_;
    double radius_, container_radius_, reach_, skin_;
    std::vector<Flight<double>> flights_;
    std::vector<Number> changes_;
    std::vector<Expected> expected_;

    std::vector<Vec2> centres_;  // where lists were made
    std::vector<char> at_wall_;  // may reach it from there
    std::size_t room_ = 16;      // of each list
    std::vector<Number> lists_, lengths_;
    double cell_width_;
    std::size_t cells_across_;
    std::vector<Number> first_in_cell_, next_in_cell_, previous_in_cell_;

    double bin_width_ = 0.0, calendar_begin_ = 0.0;
    std::size_t now_ = 0;  // the bin that is being emptied
    std::vector<Number> first_in_bin_, next_in_bin_, previous_in_bin_, bin_of_;
};

}  // namespace swirl
