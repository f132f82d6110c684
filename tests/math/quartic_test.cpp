#include "swirl/math/quartic.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "swirl/math/random.hpp"

namespace swirl {
namespace {

__extension__ typedef __float128 Half;

/// A number with 67 digits: the sum of two numbers of 113 bits, where the second is a rounding
/// error of the first. Sums and products of such halves are exact (Dekker 1971,
/// doi:10.1007/BF01397083).
class Wide {
  public:
    Wide(double value = 0.0) : high_(value) {}
    explicit operator double() const { return double(high_); }

    friend Wide operator+(const Wide& a, const Wide& b) {
        const Wide s = sum(a.high_, b.high_), t = sum(a.low_, b.low_);
        const Wide u = ordered_sum(s.high_, s.low_ + t.high_);
        return ordered_sum(u.high_, u.low_ + t.low_);
    }
    friend Wide operator-(const Wide& a) { return {-a.high_, -a.low_}; }
    friend Wide operator-(const Wide& a, const Wide& b) { return a + -b; }
    friend Wide operator*(const Wide& a, const Wide& b) {
        const Half product = a.high_ * b.high_;
        const Wide x = split(a.high_), y = split(b.high_);
        const Half remainder =
            ((x.high_ * y.high_ - product) + x.high_ * y.low_ + x.low_ * y.high_) + x.low_ * y.low_;
        return ordered_sum(product, remainder + (a.high_ * b.low_ + a.low_ * b.high_));
    }
    friend bool operator>(const Wide& a, const Wide& b) {
        return a.high_ > b.high_ || (a.high_ == b.high_ && a.low_ > b.low_);
    }
    friend bool operator==(const Wide&, const Wide&) = default;

  private:
    Wide(Half high, Half low) : high_(high), low_(low) {}
    static Wide ordered_sum(Half a, Half b) {  // |a| ≥ |b|
        const Half s = a + b;
        return {s, b - (s - a)};
    }
    static Wide sum(Half a, Half b) {
        const Half s = a + b, of_b = s - a;
        return {s, (a - (s - of_b)) + (b - of_b)};
    }
    static Wide split(Half a) {  // halves of 56 bits have exact products
        const Half c = Half(0x1p57 + 1.0) * a;
        const Half high = c - (c - a);
        return {high, a - high};
    }

    Half high_, low_ = 0;
};

// An independent method in 67 digits, which shares only the polynomial with quartic.hpp.

struct WideQuartic {
    Wide c[5];
    double rough[5], unsure;
    /// For times up to `horizon`.
    explicit WideQuartic(const Quartic& f, double horizon, Wide added = 0.0)
        : c{f.c0 + added, f.c1, f.c2, f.c3, f.c4}, unsure(0.0) {
        for (int k = 4; k >= 0; --k) {
            rough[k] = double(c[k]);
            unsure = unsure * horizon + std::abs(rough[k]);
        }
        unsure *= 1e-12;
    }

    template <class Number>
    static Number value(const Number* f, Number t) {
        return (((f[4] * t + f[3]) * t + f[2]) * t + f[1]) * t + f[0];
    }
    /// A lower bound of the values from a to b: the polynomial about a with only its negative
    /// coefficients, at b.
    template <class Number>
    static Number lower_bound(const Number* f, Number a, Number b) {
        const Number w = b - a;
        const Number d1 = ((4.0 * f[4] * a + 3.0 * f[3]) * a + 2.0 * f[2]) * a + f[1];
        const Number d2 = (6.0 * f[4] * a + 3.0 * f[3]) * a + f[2];
        const Number d3 = 4.0 * f[4] * a + f[3];
        const auto down = [](const Number& x) { return x > 0.0 ? Number() : x; };
        return value(f, a) + w * (down(d1) + w * (down(d2) + w * (down(d3) + w * down(f[4]))));
    }
    /// Double precision decides where the value is far larger than its rounding errors, which are
    /// some hundred roundings of the largest term: `unsure` allows for 9000.
    bool positive(Wide t) const {
        const double near = value(rough, double(t));
        return std::abs(near) > unsure ? near > 0.0 : value(c, t) > 0.0;
    }
    bool positive(Wide a, Wide b) const {
        const double near = lower_bound(rough, double(a), double(b));
        return std::abs(near) > unsure ? near > 0.0 : lower_bound(c, a, b) > 0.0;
    }
    /// The first time at which it is 0 or less, to 10⁻²⁴ of the interval; −1 if it is positive
    /// everywhere.
    Wide first_zero(Wide a, Wide b, int depth = 0) const {
        if (positive(a, b)) return -1.0;
        if (!positive(a) || depth == 80) return a;
        const Wide middle = 0.5 * (a + b);
        const Wide left = first_zero(a, middle, depth + 1);
        return left == -1.0 ? first_zero(middle, b, depth + 1) : left;
    }
};

/// A bound of the rounding error of f up to time t: thirty roundings of the largest term.
double rounding_of(const Quartic& f, double t) {
    const double sum =
        std::abs(f.c0) +
        t * (std::abs(f.c1) + t * (std::abs(f.c2) + t * (std::abs(f.c3) + t * std::abs(f.c4))));
    return 30.0 * 0x1p-53 * sum;
}

/// Checks both directions: f is 0 at the result, and it is not negative before the result, or
/// before the horizon. Returns a description of the error.
std::string wrong(const Quartic& f, double horizon, double grain) {
    const double found = first_fall(f, horizon, grain);
    const double end = found == never ? horizon : found;
    // If f begins slightly below 0, by the rounding of a contact, the contact is where f is lower
    // by a grain.
    const double error = rounding_of(f, horizon) + 2.0 * grain + larger(-f.c0, 0.0);
    const std::string position = " at " + std::to_string(end) + " of " + std::to_string(horizon);
    if (end < 0.0 || end > horizon) return "outside" + position;
    // The result is 0 if the two touch, or overlap by any amount, and approach.
    if (found == 0.0 && f.c0 <= 0.0 && f.c1 < 0.0) return "";
    if (found != never &&
        std::abs(double(WideQuartic::value(WideQuartic(f, horizon).c, Wide(found)))) > error)
        return "no zero" + position;
    const Wide earlier = WideQuartic(f, horizon, 2.0 * error).first_zero(0.0, end);
    return earlier == -1.0 ? ""
                           : "one at " + std::to_string(double(earlier)) + " is before" + position;
}

struct Encounters {
    Random random;
    double between(double low, double high) { return low + (high - low) * random.uniform(); }
    Vec2 vector(double reach) { return random.in_disc(reach); }

    /// |s + v t + g t²|² − σ².
    static Quartic clearance_quartic(const Vec2& s, const Vec2& v, const Vec2& g, double square) {
        return {dot(s, s) - square, 2.0 * dot(s, v), dot(v, v) + 2.0 * dot(s, g), 2.0 * dot(v, g),
                dot(g, g)};
    }
    /// Accelerations from those of a rough floor down to a rounding error.
    double acceleration() { return 4.0 * std::pow(10.0, -between(0.0, 1.0) * between(0.0, 15.0)); }

    Quartic any() {
        const Vec2 s = vector(4.0);
        return clearance_quartic(s, vector(2.0), vector(acceleration()), smaller(4.0, dot(s, s)));
    }
    /// The closest approach is σ, plus or minus a relative difference of 10⁻² to 10⁻¹⁶.
    Quartic grazing(double horizon) {
        const Vec2 s = vector(4.0), v = vector(2.0), g = vector(acceleration());
        const Quartic distance = clearance_quartic(s, v, g, 0.0);
        double closest = distance.c0;
        for (int k = 1; k < 64; ++k) closest = smaller(closest, distance.value(horizon * k / 64.0));
        const double more = std::pow(10.0, -between(2.0, 16.0)) * (random.bits() % 2 ? 1.0 : -1.0);
        return clearance_quartic(s, v, g, smaller(closest * (1.0 + more), distance.c0));
    }
    /// They touch up to a rounding error, and separate, approach, or hardly move.
    Quartic touching() {
        const Vec2 n = vector(1.0);
        const double length = square_root(dot(n, n));
        const Vec2 s{2.0 * n.x / length, 2.0 * n.y / length};
        const Vec2 along = between(-1.0, 1.0) * std::pow(10.0, -between(0.0, 12.0)) * s;
        return clearance_quartic(s, along + between(-1.0, 1.0) * perpendicular(s),
                                 vector(acceleration()), 4.0);
    }
    /// A sphere inside the container.
    Quartic wall() {
        const Quartic f =
            clearance_quartic(vector(7.6), vector(2.0), vector(acceleration()), 7.6 * 7.6);
        return {-f.c0, -f.c1, -f.c2, -f.c3, -f.c4};
    }
};

void expect_first_falls(int cases, std::uint64_t seed) {
    Encounters draw{Random(seed)};
    for (int k = 0; k < cases; ++k) {
        const double horizon = draw.between(0.001, 2.0);
        const double grain = 0x1p-50;
        ASSERT_EQ(wrong(draw.any(), horizon, grain), "") << "any, case " << k;
        ASSERT_EQ(wrong(draw.grazing(horizon), horizon, grain), "") << "grazing, case " << k;
        ASSERT_EQ(wrong(draw.touching(), horizon, grain), "") << "touching, case " << k;
        ASSERT_EQ(wrong(draw.wall(), horizon, grain), "") << "wall, case " << k;
    }
}

TEST(Quartic, ReferenceHasFiftyDigits) {
    const Wide third = 1.0 + Wide(0x1p-100) + Wide(0x1p-200);
    EXPECT_EQ(double(third * third - 1.0 - Wide(0x1p-99) - Wide(3.0 * 0x1p-200)), 0x1p-299);
}
TEST(Quartic, FirstFallAgreesWithHighPrecision) { expect_first_falls(3000, 1); }
TEST(Quartic, Slow_FirstFallAgreesWithHighPrecisionInManyCases) { expect_first_falls(100000, 2); }

// (τ − 1)(τ − 2)(τ − 3)(τ − 4) is negative between 1 and 2 and between 3 and 4.
TEST(Quartic, FirstFallIsTheFirstOfFourRoots) {
    const Quartic f{24.0, -50.0, 35.0, -10.0, 1.0};
    EXPECT_NEAR(first_fall(f, 10.0, 0.0), 1.0, 1e-14);
    EXPECT_EQ(first_fall(f, 0.9, 0.0), never);
    // The search starts between 1 and 2, where the quartic is negative and falls, or is negative
    // and rises.
    const auto later = [&](double by) {
        const double c1 = f.slope(by), c2 = 0.5 * f.curvature(by), c3 = 4.0 * by - 10.0;
        return Quartic{f.value(by), c1, c2, c3, 1.0};
    };
    EXPECT_EQ(first_fall(later(1.1), 10.0, 0.0), 0.0);
    EXPECT_NEAR(first_fall(later(1.9), 10.0, 0.0), 3.0 - 1.9, 1e-13);
    EXPECT_NEAR(first_fall(later(2.5), 10.0, 0.0), 3.0 - 2.5, 1e-13);
    EXPECT_EQ(first_fall(later(4.5), 10.0, 0.0), never);
}

// Accelerations press the bodies together: f rises from 0 and falls again, even if it is never
// positive.
TEST(Quartic, BodiesPressedTogetherTouchAgainLater) {
    EXPECT_NEAR(first_fall({0.0, 1e-3, -2.0, 0.0, 0.0}, 1.0, 0x1p-50), 5e-4, 1e-16);
    const double below = first_fall({-1e-16, 1e-12, -2.0, 0.0, 0.0}, 1.0, 0x1p-50);
    EXPECT_GT(below, 1e-9);
    EXPECT_LT(below, 1e-7);
    // f rises by less than a rounding error, and is back within a rounding error of the clock.
    const double hardly = first_fall({0.0, 5.6e-16, -7.0, 0.0, 0.0}, 1.0, 0x1p-50);
    EXPECT_NEAR(hardly, square_root(0x1p-50 / 7.0), 1e-12);
    // Exactly at rest on each other.
    const double resting = first_fall({0.0, 0.0, -2.0, 0.0, 0.0}, 1.0, 0x1p-50);
    EXPECT_NEAR(resting, square_root(0x1p-51), 1e-12);
}

}  // namespace
}  // namespace swirl
