#include "swirl/io/range_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <vector>

#include "swirl/io/file_error.hpp"
#include "swirl/physics/limits.hpp"

namespace swirl {
namespace {

class RangeCheck {
  public:
    RangeCheck(const Snapshot& snapshot, Spins spins, const std::string& file)
        : s_(snapshot), spins_(spins), file_(file) {}

    void container() const {
        between("number of periods", double(s_.periods), -max_periods, max_periods);
        between("period", s_.period, smallest_value, largest_value);
        // In a camera's tracks the clock is a rounded difference of times.
        const double rounding = 1e-6 * s_.period;
        between("clock", s_.clock, -rounding, s_.period + rounding);
        between("container radius", s_.container_radius, smallest_value, largest_value);
        within("container's position", s_.container_centre, largest_coordinate);
        within("container's velocity", s_.container_velocity, largest_magnitude);
    }
    void disc(std::size_t i) {
        disc_ = i;
        const double R = s_.container_radius;
        // The radius of a disc as large as its container may be rounded up.
        between("radius", s_.radius[i], smallest_value, R * (1.0 + 1e-9));
        between("mass", s_.mass[i], smallest_value, largest_value);
        within("velocity", s_.velocity(i), largest_magnitude);
        within("position", s_.position(i), largest_coordinate);
        if (is_available(s_.inertia[i]))
            between("moment of inertia", s_.inertia[i], smallest_inertia, largest_inertia);
        if (!s_.can_spin.empty()) one_or_zero("can_spin", s_.can_spin[i]);
        if (is_available(s_.angle[i])) within("angle", s_.angle[i], largest_magnitude);
        if (is_available(s_.spin[i])) within("spin", s_.spin[i], largest_magnitude);
        if (!s_.are_spheres()) return;
        within("rolling spin", Vec2{s_.spin_x[i], s_.spin_y[i]}, largest_magnitude);
        if (s_.turned.empty()) return;
        const Quaternion& q = s_.turned[i];
        // Unit length, up to the rounding of many products.
        between("orientation's length", q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z, 0.99, 1.01);
    }

  private:
    bool is_available(double value) const { return spins_ == Spins::known || !std::isnan(value); }
    void one_or_zero(const char* name, double value) const {
        if (value != 0.0) between(name, value, 1.0, 1.0);
    }
    void between(const char* name, double value, double from, double to) const {
        if (value >= from && value <= to) return;
        throw FileError(fmt::format("{}the {}{} is {} in period {}, but must be from {} to {}.",
                                    file_.empty() ? "" : fmt::format("'{}': ", file_), name,
                                    disc_ ? fmt::format(" of disc {}", *disc_) : "", value,
                                    s_.periods, from, to));
    }
    void within(const char* name, double value, double maximum) const {
        between(name, value, -maximum, maximum);
    }
    void within(const char* name, const Vec2& value, double maximum) const {
        within(name, value.x, maximum);
        within(name, value.y, maximum);
    }

    const Snapshot& s_;
    const Spins spins_;
    const std::string& file_;
    std::optional<std::size_t> disc_;
};

}  // namespace

void require_possible(const Snapshot& snapshot, Spins spins, const std::string& file) {
    RangeCheck check(snapshot, spins, file);
    check.container();
    for (std::size_t i = 0; i < snapshot.size(); ++i) check.disc(i);
}

void require_separate_bodies(const Snapshot& s, const std::string& file) {
    // A fraction of a distance. Bodies of a run overlap by less than 10⁻⁹.
    constexpr double tolerance = 1e-6;
    const auto reject = [&](const std::string& what) {
        throw FileError(fmt::format("'{}' is not a recording of a run: {} in period {}.", file,
                                    what, s.periods));
    };
    const auto distance = [](const Vec2& a, const Vec2& b) { return std::sqrt(dot(b - a, b - a)); };
    std::vector<std::size_t> order(s.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t i, std::size_t j) { return s.x[i] < s.x[j]; });
    const double largest =
        s.radius.empty() ? 0.0 : *std::max_element(s.radius.begin(), s.radius.end());
    for (std::size_t a = 0; a < order.size(); ++a) {
        const std::size_t i = order[a];
        const double room = s.container_radius - s.radius[i];
        if (distance(s.container_centre, s.position(i)) > room + tolerance * s.container_radius)
            reject(fmt::format("disc {} is outside of the container", i));
        for (std::size_t b = a + 1; b < order.size(); ++b) {
            const std::size_t j = order[b];
            if (s.x[j] - s.x[i] > s.radius[i] + largest) break;
            // Spheres of two sizes that touch on a floor are this far apart in the plane, discs
            // further.
            const double least = 2.0 * std::sqrt(s.radius[i] * s.radius[j]);
            if (distance(s.position(i), s.position(j)) < (1.0 - tolerance) * least)
                reject(fmt::format("discs {} and {} overlap", std::min(i, j), std::max(i, j)));
        }
    }
}

}  // namespace swirl
