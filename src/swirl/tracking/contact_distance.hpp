// Where hard discs stop each other, from distances that err.
//
// The gaps of neighbours in a crowd begin at nothing, where they are commonest, and fall off about
// exponentially. Seen with normal errors their distances are spread as
//
//     f(d) = w EMG(d; contact, σ, λ) + (1 − w) (d > contact) / (farthest − contact)
//
// with EMG a normal deviate plus an exponential one. The four numbers that make a histogram of the
// distances likeliest tell the distance of contact better than a single place is known, and the
// error of a distance as well. The wall stops discs in the same way: take the distances from the
// dish's centre negative.
//
// Then discs are moved to where they are to be expected, hard as they are. Of a pair alone, whose
// gap was seen as g with an error s, that is g + s h(g/s), h(x) = φ(x)/Φ(x): nothing where they are
// far from each other, and a little out of contact where they seem to lie in each other. In a crowd
// every gap is what all others leave of it, and round for round each gets its share; the wall acts
// as a disc that does not move. Where errors are small nothing is moved.
#pragma once

#include <optional>
#include <vector>

#include "swirl/math/vec2.hpp"
#include "swirl/tracking/lens.hpp"

namespace swirl {

struct Contact {
    double at = 0.0;     // the distance of contact
    double error = 0.0;  // standard deviation of a distance
    double worth = 0.0;  // logarithm of the likelihood, by distance
};
/// From the distances between `nearest` and `farthest`; nothing where they do not tell.
std::optional<Contact> contact_of(const std::vector<double>& distances, double nearest,
                                  double farthest);

/// Two discs that were seen near each other in one picture.
struct SeenPair {
    Vec2 one, other;
    double radii;  // their sum
};
/// The distortion with which discs in contact are equally far apart all over the dish.
struct Distortion {
    double k = 0.0, error = 0.0;
};
std::optional<Distortion> distortion_of(const std::vector<SeenPair>& pairs, const Vec2& middle,
                                        double half);

/// What is moved apart.
struct HardDisc {
    Vec2 centre{0.0, 0.0};
    double variance = 1.0;  // of a coordinate
    double radius = 1.0;
    double reach = 1e300;  // from the dish's centre, where the wall stops it
};
/// `closest`: of the sum of radii, at contact.
void move_apart(std::vector<HardDisc>& discs, double closest, const Vec2& container);

}  // namespace swirl
