// The earliest contact of a disc with the discs of its list, eight at a time.
//
// Compiled once for each vector width (cmake/engine.cmake), like the engine's event loop.
#pragma once

#include <cstdint>

#include "swirl/math/cpu_width.hpp"
#include "swirl/math/lanes.hpp"
#include "swirl/physics/contact_time.hpp"

namespace swirl {

/// What the predictions of other discs read of a disc: one cache line.
struct alignas(64) ListedDisc {
    Flight<double> flight;
    double radius;
    std::uint32_t changes;  // collisions so far
    std::uint32_t listed;   // the length of its list
    bool at_wall;           // may reach the wall from within its circle
};

struct FirstContact {
    double time;
    std::uint32_t partner;
};

/// Lists are padded to a multiple of this with the disc's own number; a disc never touches itself.
inline constexpr std::uint32_t listed_at_once = 8;
using ListLanes = Lanes<listed_at_once>;

/// At equal times, the partner with the smaller number; `no_disc` if there is no contact.
SWIRL_INLINE FirstContact find_first_on_list(const ListedDisc* discs, std::uint32_t i,
                                             const std::uint32_t* list, std::uint32_t no_disc) {
    const ListedDisc& me = discs[i];
    const auto everywhere = [](const Vec2& v) {
        return BasicVec2<ListLanes>{ListLanes(v.x), ListLanes(v.y)};
    };
    const Flight<ListLanes> mine{everywhere(me.flight.position), everywhere(me.flight.velocity),
                                 ListLanes(me.flight.time)};
    FirstContact first{never, no_disc};
    for (std::uint32_t begin = 0; begin < me.listed; begin += listed_at_once) {
        const double *positions[listed_at_once], *times[listed_at_once];
        for (std::uint32_t k = 0; k < listed_at_once; ++k) {
            const ListedDisc& other = discs[list[begin + k]];
            positions[k] = &other.flight.position.x;
            times[k] = &other.flight.time;  // the radius follows in memory
        }
        ListLanes columns[4], held, radii;
        load_fours<listed_at_once>(positions, columns);
        load_pairs<listed_at_once>(times, held, radii);
        const Flight<ListLanes> others{{columns[0], columns[1]}, {columns[2], columns[3]}, held};
        const ListLanes contacts = time_of_contact(mine, others, ListLanes(me.radius) + radii);
        const double time = smallest(contacts);
        if (time > first.time || time == never) continue;
        for (unsigned equal = lanes_equal(contacts, time); equal != 0; equal &= equal - 1) {
            const std::uint32_t partner = list[begin + unsigned(__builtin_ctz(equal))];
            if (time < first.time || partner < first.partner) first = {time, partner};
        }
    }
    return first;
}

using ListSearch = FirstContact (*)(const ListedDisc* discs, std::uint32_t i,
                                    const std::uint32_t* list, std::uint32_t no_disc);
FirstContact list_search_baseline(const ListedDisc*, std::uint32_t, const std::uint32_t*,
                                  std::uint32_t);
FirstContact list_search_avx2(const ListedDisc*, std::uint32_t, const std::uint32_t*,
                              std::uint32_t);
FirstContact list_search_avx512(const ListedDisc*, std::uint32_t, const std::uint32_t*,
                                std::uint32_t);

}  // namespace swirl
