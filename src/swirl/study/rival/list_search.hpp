// Whom a disc meets first of those on its list, eight of them at a time.
//
// Compiled once for each width of vectors (cmake/engine.cmake), like the engine's event loop.
#pragma once

#include <cstdint>

#include "swirl/math/cpu_width.hpp"
#include "swirl/math/lanes.hpp"
#include "swirl/physics/contact_time.hpp"

namespace swirl {

/// What others' predictions ask of a disc: one cache line.
struct alignas(64) ListedDisc {
    Flight<double> flight;
    double radius;
    std::uint32_t changes;  // collisions so far
    std::uint32_t listed;   // the length of its list
    bool at_wall;           // may reach it from within its circle
};

struct FirstMeeting {
    double time;
    std::uint32_t partner;
};

/// Lists go on with the disc's own number up to a multiple of this: nobody meets himself.
inline constexpr std::uint32_t listed_at_once = 8;

/// Of those at one instant the partner with the smaller number; `nobody` if there is none.
SWIRL_INLINE FirstMeeting find_first_on_list(const ListedDisc* discs, std::uint32_t i,
                                             const std::uint32_t* list, std::uint32_t nobody) {
    using Eight = Lanes<listed_at_once>;
    const ListedDisc& me = discs[i];
    const auto everywhere = [](const Vec2& v) { return BasicVec2<Eight>{Eight(v.x), Eight(v.y)}; };
    const Flight<Eight> mine{everywhere(me.flight.position), everywhere(me.flight.velocity),
                             Eight(me.flight.time)};
    FirstMeeting first{never, nobody};
    for (std::uint32_t begin = 0; begin < me.listed; begin += listed_at_once) {
        const double *places[listed_at_once], *times[listed_at_once];
        for (std::uint32_t k = 0; k < listed_at_once; ++k) {
            const ListedDisc& other = discs[list[begin + k]];
            places[k] = &other.flight.position.x;
            times[k] = &other.flight.time;  // the radius is beside it
        }
        Eight columns[4], held, radii;
        load_fours<listed_at_once>(places, columns);
        load_pairs<listed_at_once>(times, held, radii);
        const Flight<Eight> others{{columns[0], columns[1]}, {columns[2], columns[3]}, held};
        const Eight contacts = time_of_contact(mine, others, Eight(me.radius) + radii);
        const double time = smallest(contacts);
        if (time > first.time || time == never) continue;
        for (unsigned equal = lanes_equal(contacts, time); equal != 0; equal &= equal - 1) {
            const std::uint32_t partner = list[begin + unsigned(__builtin_ctz(equal))];
            if (time < first.time || partner < first.partner) first = {time, partner};
        }
    }
    return first;
}

using ListSearch = FirstMeeting (*)(const ListedDisc* discs, std::uint32_t i,
                                    const std::uint32_t* list, std::uint32_t nobody);
FirstMeeting list_search_baseline(const ListedDisc*, std::uint32_t, const std::uint32_t*,
                                  std::uint32_t);
FirstMeeting list_search_avx2(const ListedDisc*, std::uint32_t, const std::uint32_t*,
                              std::uint32_t);
FirstMeeting list_search_avx512(const ListedDisc*, std::uint32_t, const std::uint32_t*,
                                std::uint32_t);

}  // namespace swirl
