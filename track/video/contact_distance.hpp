// The contact distance of hard discs, from distances with errors.
//
// The gaps between neighbours in a crowd are most frequent at zero and fall off about
// exponentially. With normal errors the distances d are distributed as
//
//     f(d) = w EMG(d; contact, σ, λ) + (1 − w) (d > contact) / (farthest − contact)
//
// where EMG is the distribution of the sum of a normal and an exponential deviate. Maximum
// likelihood of a histogram gives the contact distance more accurately than single positions, and
// the error σ of a distance.
#pragma once

#include <optional>
#include <vector>

#include "swirl/math/vec2.hpp"
#include "track/video/lens.hpp"

namespace swirl::tracking {

/// Density of the sum of a normal and an exponential deviate. `x` counts from the mean of the
/// normal one, `error` is its standard deviation, and `decay` is the mean of the exponential one.
double normal_and_exponential(double x, double error, double decay);

struct Contact {
    double at = 0.0;              // the contact distance
    double error = 0.0;           // standard deviation of a distance
    double log_likelihood = 0.0;  // mean per distance
};
/// Uses distances between `nearest` and `farthest`; none if they do not determine the contact.
/// `outliers`: the share of wrong distances in each bin of their histogram.
std::optional<Contact> contact_of(const std::vector<double>& distances, double nearest,
                                  double farthest, double outliers = 1e-9);

/// The contact distance with its standard error, of discs that are seldom in contact. An encounter
/// is all distances within `few_range` of 1 while two discs are near each other, which counts once.
/// `error` is that of a distance. None if the distances do not determine the contact to 1 %.
struct FewContacts {
    double at = 0.0, error = 0.0;
};
inline constexpr double few_range = 0.1;
std::optional<FewContacts> contact_of_few(const std::vector<std::vector<double>>& encounters,
                                          double error);

/// The contact of discs, from distances in sums of radii: near 1, or farther off if their edges are
/// soft and their radii wrong. Uses distances within `contact_range` of 1. A contact far off that
/// is not sharp counts if it is near `at_wall`, which the positions of discs at the wall imply.
std::optional<Contact> contact_of_discs(const std::vector<double>& ratios, double at_wall = 0.0,
                                        double outliers = 1e-9);
inline constexpr double contact_range = 0.5;
/// A contact that is farther from 1 implies another radius.
inline constexpr double max_contact_off = 0.05;

/// Two neighbouring discs of one frame.
struct DiscPair {
    Vec2 one, other;
    double radii;  // sum
};
/// The lens distortion for which the contact distance is uniform over the image.
struct Distortion {
    double k = 0.0, error = 0.0;
};
std::optional<Distortion> distortion_of(const std::vector<DiscPair>& pairs, const Vec2& middle,
                                        double half);

}  // namespace swirl::tracking
